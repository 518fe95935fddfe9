"""Only the pages are tests here; the code that builds them is run by ``tests/docs``."""

collect_ignore_glob = ["conf.py", "extensions/*", "pictures/*", "_build/*", "reference/generated/*"]
