"""Cold starts: what each command costs beside ``python -c "import numpy"``."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from .harness import Figure, fastest

EXAMPLE = Path(__file__).parent.parent / "examples" / "truck-printed-angles.toml"
SINGLE = "from cardan import Drive, motion; motion(Drive.from_angles([0.3, 0.3])).ratio"


KEPT = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""Compiled modules are kept, as an installation keeps them."""


def run(*arguments: str) -> None:
    subprocess.run([sys.executable, *arguments], check=True, stdout=subprocess.DEVNULL, env=KEPT)


def figures(quick: bool) -> Iterator[Figure]:
    with tempfile.TemporaryDirectory() as folder:
        page = str(Path(folder) / "report.html")
        jobs = {
            "import numpy": lambda: run("-c", "import numpy"),
            "import cardan": lambda: run("-c", "import cardan"),
            "motion of one drive from Python": lambda: run("-c", SINGLE),
            "cardan --help": lambda: run("-m", "cardan", "--help"),
        }
        if EXAMPLE.exists():
            jobs["cardan motion FILE"] = lambda: run("-m", "cardan", "motion", str(EXAMPLE))
            jobs["cardan phasing FILE"] = lambda: run("-m", "cardan", "phases", str(EXAMPLE))
        best = fastest(jobs, rounds=3 if quick else 11)
        if EXAMPLE.exists():
            report = fastest({"": lambda: run("-m", "cardan", "report", str(EXAMPLE), "-o", page)}, rounds=3)[""]
    base = best.pop("import numpy")
    aims = {"cardan --help": ", aim ≤ 2"}
    for name, seconds in best.items():
        yield Figure(
            bench=f"start-up, {name}",
            value=seconds,
            unit="s",
            yardstick=f"import numpy, {base:.3g} s{aims.get(name, '')}",
            ratio=seconds / base,
        )
    if EXAMPLE.exists():
        yield Figure(bench="cardan report FILE", value=report, unit="s", yardstick="4 s, aim ≤ 1", ratio=report / 4.0)
