"""The table of a sweep: kept in a folder, read, summed up."""
