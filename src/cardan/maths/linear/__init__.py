"""Linear systems: chains, beams and their modes."""
