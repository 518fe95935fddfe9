"""Links and pairs in general: what a mechanism is, whether it is a drive or not."""
