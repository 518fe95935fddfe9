"""The parts of the page, one a file: each shows what a `Session` holds and changes it by its methods alone."""
