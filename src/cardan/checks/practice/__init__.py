"""Checks by rules of practice: sizes, places, accuracy, upkeep."""
