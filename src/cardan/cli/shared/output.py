"""What a command writes: to standard output, and files, whole or not at all; refusals before any work is done."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from math import isfinite
from pathlib import Path

from cardan.errors import refuse
from cardan.files import write_text as write
from cardan.reading.ranges import HUGE
from cardan.texts import _
from cardan.units import rpm

SUFFIXES = (".toml", ".json", ".glb")
FIGURE_SUFFIXES = (".svg", ".png", ".pdf", ".html")


def check_common(*, json: bool, csv: bool, plot: Path | None = None) -> None:
    """Refuse common options that contradict each other or that cannot be met, before any work is done."""
    if json and csv:
        raise refuse("--csv", _("choose --json or --csv, not both"))
    if plot is not None:
        check_figure_target(plot)


def print_text(text: str) -> None:
    """Write to standard output."""
    print_lines((text,))


def print_lines(texts: Iterable[str]) -> None:
    """Write piece by piece to standard output."""
    for text in texts:
        sys.stdout.write(text)
    sys.stdout.flush()


def check_figure_target(path: Path) -> None:
    """Refuse a figure file of an unknown kind or in a place that cannot be written, before any work is done."""
    if path.suffix.lower() not in FIGURE_SUFFIXES:
        known = ", ".join(FIGURE_SUFFIXES)
        raise refuse("--plot", _("{path} should end in one of {known}").format(path=path, known=known))
    check_target(path, "--plot")


def check_target(path: Path, option: str) -> None:
    """Refuse a file that cannot be written, in words, before any work is done."""
    folder = path.parent
    if path.is_dir():
        raise refuse(option, _("{path} is a folder").format(path=path))
    if not folder.exists():
        raise refuse(
            option, _("{path} cannot be written: there is no folder {folder}").format(path=path, folder=folder)
        )
    if not folder.is_dir():
        raise refuse(option, _("{path} cannot be written: {folder} is not a folder").format(path=path, folder=folder))
    if not os.access(path if path.exists() else folder, os.W_OK):
        raise refuse(option, _("{path} cannot be written: permission denied").format(path=path))


def check_new(path: Path, *, force: bool, field: str = "FILE") -> None:
    """Refuse to overwrite a file unless told to."""
    if path.exists() and not path.is_dir() and not force:
        raise refuse(field, _("{path} exists; --force overwrites it").format(path=path))
    check_target(path, field)


def write_text(path: Path, text: str, option: str) -> None:
    """Write a text file, whole or not at all."""
    check_target(path, option)
    write(path, text)


def check_speed(speed_rpm: float | None) -> None:
    """Refuse a speed that is not a finite number, or one that no drive has."""
    if speed_rpm is None:
        return
    if not isfinite(speed_rpm):
        raise refuse("--speed-rpm", _("{value} is not a finite number").format(value=speed_rpm))
    if abs(speed_rpm) * rpm > HUGE:
        raise refuse("--speed-rpm", _("{value} is not allowed; no drive has such a number").format(value=speed_rpm))
