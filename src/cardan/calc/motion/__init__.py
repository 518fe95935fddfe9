"""Capabilities about motion and mechanisms."""
