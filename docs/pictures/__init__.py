"""Pictures of these pages, one function each; `build` draws all of them."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

import matplotlib

MODULES = (
    "conventions",
    "theory",
    "constant_velocity",
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
)


def build(folder: Path, only: str = "") -> list[Path]:
    """Draw every picture as SVG into a folder and return the files."""
    from .kit import STYLE

    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for module in MODULES:
        for name, draw in import_module(f".{module}", __name__).PICTURES.items():
            if only and only not in name:
                continue
            with matplotlib.rc_context(STYLE):
                files.append(folder / f"{name}.svg")
                draw().savefig(files[-1], metadata={"Date": None}, dpi=200, bbox_inches="tight", pad_inches=0.06)
    return files
