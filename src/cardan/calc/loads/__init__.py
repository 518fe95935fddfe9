"""Capabilities about forces, strength, life and losses."""
