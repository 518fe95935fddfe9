"""Torsional vibration of a drive whose joint angles change while it runs."""
