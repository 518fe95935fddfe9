"""Test settings: property tests draw the same examples everywhere; what workers share is made once.

A property that fails tells the example that was drawn; ``pytest --hypothesis-profile smallest`` looks for the smallest,
which takes minutes.
"""

import fcntl
import os
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, settings

# Workers share the processors; a library of linear algebra that starts threads of its own in each makes them wait.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

for name, phases in (("fixed", [Phase.explicit, Phase.generate]), ("smallest", list(Phase))):
    settings.register_profile(
        name,
        phases=phases,
        derandomize=True,
        max_examples=60,
        deadline=None,
        database=None,
        suppress_health_check=[HealthCheck.too_slow],
    )
settings.load_profile("fixed")


SLOW = {"chromium", "site"}
"""What makes a test slow that asks for it: a browser, a build of the documentation."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests by what they ask for; others say themselves that they take half a second or more."""
    for item in items:
        if not SLOW.isdisjoint(getattr(item, "fixturenames", ())):
            item.add_marker(pytest.mark.slow)


@pytest.fixture(scope="session")
def one_at_a_time(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], AbstractContextManager[Path]]:
    """Return what yields a folder that all workers of this run share, to one of them at a time."""
    base = tmp_path_factory.getbasetemp()
    root = base.parent if "PYTEST_XDIST_WORKER" in os.environ else base

    @contextmanager
    def alone(name: str) -> Iterator[Path]:
        (root / name).mkdir(exist_ok=True)
        with (root / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield root / name

    return alone
