"""Commands on what a drive carries, how long it lasts, and whether it is right."""
