"""Reports with small maps: the pages are the same, and their time is not; one report for each example."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from cardan.questions.torsion.stability import answer as stability
from cardan.questions.torsion.steady import answer as steady


@pytest.fixture(autouse=True, scope="session")
def small_maps() -> Iterator[None]:
    """Sweep over a handful of speeds, and judge stability at few of them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(steady, "SWEEP", 5)
        for name, count in (("ACROSS", 9), ("UP", 4), ("COARSE_ACROSS", 5), ("COARSE_UP", 3)):
            patch.setattr(stability, name, count)
        yield
