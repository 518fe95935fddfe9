"""Checks of how far and how evenly joints turn."""
