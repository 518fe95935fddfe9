"""Comparisons with the literature, and formulas that nothing else uses."""
