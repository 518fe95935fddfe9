"""Commands on shafts that whirl."""
