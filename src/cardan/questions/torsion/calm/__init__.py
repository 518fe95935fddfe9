"""Designs with the least torsional vibration."""
