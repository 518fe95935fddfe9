"""Recordings: signals, rotation, orders, spectra."""
