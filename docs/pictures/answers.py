"""What commands draw of shipped examples with ``--plot``, for the pages that show how to use them."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

EXAMPLES = Path(__file__).parents[2] / "examples"
COMMANDS = {
    "phasing": "phasing truck-printed-angles.toml",
    "articulation": "articulation pto-hitch.toml",
    "assembly": "assembly overconstrained-pump.toml",
    "graph": "mobility overconstrained-pump.toml",
    "verdicts": "check truck-duty-cycle.toml",
    "life": "life truck-duty-cycle.toml",
    "modes": "bending two-piece-rubber-bearing.toml",
    "slider": "motion mechanisms/crank-slider.toml",
    "boom": "motion mechanisms/boom-cylinder.toml",
    "differentiator": "sweep sweeps/differentiator.toml",
    "tubes": "strength car-propshaft.toml --size tube:2",
    "thompson": "motion thompson-drive.toml",
    "mixed": "motion double-cardan-propshaft.toml",
}


def _drawer(command: str) -> Callable[[], bytes]:
    def draw() -> bytes:
        with TemporaryDirectory() as folder:
            place = Path(folder) / "answer.svg"
            line = [sys.executable, "-m", "cardan", *command.split(), "--plot", str(place)]
            done = subprocess.run(line, cwd=EXAMPLES, capture_output=True, text=True)
            if done.returncode > 1:  # 1: a check fails, as it is to be shown
                raise RuntimeError(done.stderr)
            return place.read_bytes()

    return draw


PICTURES = {f"answer-{name}": _drawer(command) for name, command in COMMANDS.items()}
