"""Fields of the drive file: their keys, their paths, and what they must satisfy."""
