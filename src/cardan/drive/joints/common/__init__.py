"""What kinds of joints are told with: where they stand, their pairs, their bodies, what moves in them."""
