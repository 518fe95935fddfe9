"""A drive as arrays: the forms in which questions compute with it."""
