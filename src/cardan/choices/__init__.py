"""Choices: what the drive should be."""
