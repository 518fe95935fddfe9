"""Minimise torsional vibration: yokes, stiffnesses and inertias, and what a drive is excited by."""
