"""Questions asked of many drives: one at a time, or all at once as arrays."""
