"""Checks of what parts carry, and how much a drive may carry."""
