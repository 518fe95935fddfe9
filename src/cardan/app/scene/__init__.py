"""The 3-D view: an element of the page in Python, and what draws it in the browser."""
