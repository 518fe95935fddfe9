"""Absorbers: which, where, how large."""
