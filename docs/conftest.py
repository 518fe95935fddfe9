"""Only the pages are tests here; the code that builds them is run by ``tests/docs``."""

import pytest

collect_ignore_glob = ["conf.py", "extensions/*", "pictures/*", "_build/*", "reference/generated/*"]

SLOW = {
    "absorbers",
    "calm-running",
    "check-a-drive",
    "cracked-shafts",
    "mechanisms",
    "motion-in-time",
    "parametric-resonance",
    "steady-and-stability",
    "sweep-on-a-cluster",
    "synthesis",
    "torsional-vibration",
    "where-the-book-errs",
}
"""Pages whose examples take half a second or more."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark slow pages."""
    for item in items:
        if item.path.suffix == ".md" and item.path.stem in SLOW:
            item.add_marker(pytest.mark.slow)
