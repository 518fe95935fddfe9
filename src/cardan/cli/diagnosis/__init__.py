"""Commands on recordings of a drive."""
