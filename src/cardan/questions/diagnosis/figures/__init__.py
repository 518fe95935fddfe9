"""Figures of the results made beside this folder."""
