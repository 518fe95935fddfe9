"""Curves: their extremes, their sums over a turn, what is best on them."""
