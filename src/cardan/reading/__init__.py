"""Keys with units, read into SI: every problem at once, on the path the user wrote, with the nearest key."""
