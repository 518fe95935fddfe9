"""Pictures of these pages, one function each; `build` draws all of them."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from importlib import import_module
from pathlib import Path

import matplotlib

MODULES = (
    "conventions",
    "theory",
    "constant_velocity",
    "steering",
    "accuracy",
    "couplings",
    "joint_gallery",
    "movements",
    "absorbers",
    "cracked",
    "recordings",
    "calm",
    "parametric",
    "torsion",
    "transient",
    "stability",
    "sweeps",
    "bending",
    "gallery",
    "answers",
)


def build(folder: Path, only: str = "") -> list[Path]:
    """Draw every picture as SVG into a folder and return the files."""
    return [draw(folder, *one) for one in names(only)]


def names(only: str = "") -> list[tuple[str, str]]:
    """Return module and name of every picture, or of those with a text in their name."""
    return [
        (module, name)
        for module in MODULES
        for name in import_module(f".{module}", __name__).PICTURES
        if not only or only in name
    ]


def draw(folder: Path, module: str, name: str) -> Path:
    """Draw one picture into a folder and return its file."""
    from .kit import STYLE

    folder.mkdir(parents=True, exist_ok=True)
    file = folder / f"{name}.svg"
    with matplotlib.rc_context(STYLE):
        figure = import_module(f".{module}", __name__).PICTURES[name]()
        if isinstance(figure, bytes):  # drawn already, by the program itself
            file.write_bytes(figure)
            return file
        figure.savefig(file, metadata={"Date": None}, dpi=200, bbox_inches="tight", pad_inches=0.06)
    return file


def drawn(folder: Path, workers: int) -> Iterator[str]:
    """Draw every picture in several processes, and yield the name of each as it is there."""
    with ProcessPoolExecutor(workers) as pool:
        for done in as_completed([pool.submit(draw, folder, *one) for one in names()]):
            yield done.result().stem
