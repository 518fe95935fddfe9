"""Checks of the bearings of supports."""
