"""Checks of torsional vibration."""
