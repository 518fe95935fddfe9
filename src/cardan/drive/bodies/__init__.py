"""What the parts of a drive look like: surfaces in proportion to what its file says, and how each of them moves."""
