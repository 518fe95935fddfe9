"""Many drives at once: what varies, what is asked, on which machines."""
