"""Closed forms that questions use."""
