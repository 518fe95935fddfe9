"""Files that would hold the app up: how soon they are refused."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from cardan.app.state.document import read
from cardan.files import Enclosed

from .harness import Figure, fastest

FILES = {
    "one key of 50,000 parts": "format = 1\n" + ".".join(["a"] * 50_000) + " = 1\n",
    "3,000 joints": "format = 1\n" + "[[joints]]\njoint_angle_deg = 1\n" * 3000,
}


def figures(quick: bool) -> Iterator[Figure]:
    """Yield the time until each file is refused."""
    folder = Enclosed(Path.cwd())
    for text in FILES.values():
        assert read(text, folder).problems
    jobs = {name: lambda text=text: read(text, folder) for name, text in FILES.items()}
    for name, took in fastest(jobs, rounds=2 if quick else 7).items():
        yield Figure(bench=f"app, {name} refused", value=took, unit="s", yardstick="0.5 s, aim ≤ 1", ratio=took / 0.5)
