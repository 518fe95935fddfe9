"""Hot questions, one a file, each measured against a yardstick of the same run: ``python -m benchmarks``."""
