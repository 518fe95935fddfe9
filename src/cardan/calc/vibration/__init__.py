"""Capabilities about vibration."""
