"""Where the pieces of a sweep are worked on."""
