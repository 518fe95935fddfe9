"""Checks of speeds."""
