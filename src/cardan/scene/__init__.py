"""The drive in space: bodies, lines and loads that move."""
