"""Checks of what joints carry."""
