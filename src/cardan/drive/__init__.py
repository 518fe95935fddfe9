"""What a drive is: a chain of shafts and joints, described once, in SI."""
