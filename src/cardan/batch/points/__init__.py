"""Which points a sweep has: how fields vary."""
