"""Answers that speak of the same quantity, side by side: of all examples, and of drives at random."""
