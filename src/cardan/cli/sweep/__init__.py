"""Commands on many drives at once."""
