"""Questions asked of a drive: one file each, the result beside the function."""
