"""Where a command takes a recording from: its file, and what its options say of the channels."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem
from cardan.io.signals import load_recording
from cardan.questions.diagnosis.signals.signal import DIRECTIONS, Signal
from cardan.texts import _

from .failure import RefusedError, about
from .options import option
from .source import read

Tacho: TypeAlias = Annotated[
    str | None, option("--tacho", "CHANNEL", _("Channel that tells how the shaft turns: pulses, a speed or an angle."))
]
Pulses: TypeAlias = Annotated[float, option("--pulses-per-turn", "N", _("Pulses of the tacho in a turn of the shaft."))]
Rate: TypeAlias = Annotated[
    float | None, option("--rate-hz", "HZ", _("Values a second, for files that do not say it."))
]
Titles: TypeAlias = Annotated[
    list[str] | None,
    option(
        "--title",
        "NAME=TITLE",
        _("What a channel measures, as left=tacho or right=acceleration_front_z_g; may be repeated."),
    ),
]
Places: TypeAlias = Annotated[
    list[str] | None,
    option("--place", "NAME=PLACE", _("Where a sensor sits and looks, as front=supports[0]:axial; may be repeated.")),
]
FullScale: TypeAlias = Annotated[
    list[float] | None,
    option(
        "--full-scale", "VALUE", _("What the greatest number of a WAV file stands for; once, or once for each channel.")
    ),
]


@dataclass(frozen=True, kw_only=True, slots=True)
class Reading:
    """What the options say of a recording."""

    tacho: str | None = None
    pulses_per_turn: float = 1.0
    rate: float | None = None
    titles: tuple[str, ...] = ()
    places: tuple[str, ...] = ()
    full_scale: tuple[float, ...] = ()

    @property
    def arguments(self) -> tuple[str, ...]:
        """The same on the command line."""
        found: list[tuple[str, object]] = [("--tacho", self.tacho)]
        found.append(("--pulses-per-turn", None if self.pulses_per_turn == 1.0 else f"{self.pulses_per_turn:g}"))
        found.append(("--rate-hz", None if self.rate is None else f"{self.rate:g}"))
        found += [("--title", one) for one in self.titles]
        found += [("--place", one) for one in self.places]
        found += [("--full-scale", f"{one:g}") for one in self.full_scale]
        return tuple(str(part) for option, value in found if value is not None for part in (option, value))


OPTIONS = {
    "rate": "--rate-hz", "pulses_per_turn": "--pulses-per-turn", "tacho": "--tacho", "titles": "--title",
    "full_scale": "--full-scale",
}  # fmt: skip
"""Argument of `cardan.recordings.load_recording` -> option."""


def recorded(path: Path, how: Reading, progress: Callable[[float], object] | None = None) -> Signal:
    """Return the recording in a file."""
    titles = _pairs(how.titles, "--title")
    with about(str(path)):
        try:
            return load_recording(
                path,
                tacho=how.tacho,
                pulses_per_turn=how.pulses_per_turn,
                titles=titles,
                rate=how.rate,
                full_scale=how.full_scale,
                progress=progress,
            )
        except InputError as error:
            raise error.renamed(lambda field: OPTIONS.get(field, "" if field == path.name else field)) from error


def read_both(
    path: Path,
    drive_path: Path,
    how: Reading,
    catalogues: tuple[Path, ...] = (),
    progress: Callable[[float], object] | None = None,
) -> tuple[Signal, Drive]:
    """Return a recording and its drive."""
    try:
        signal = recorded(path, how, progress)
    except RefusedError as first:
        try:
            read(drive_path, catalogues)
        except RefusedError as second:
            problems = [
                Problem(f"{error.subject}: {one.field}".removesuffix(": "), one.message, one.code)
                for error in (first, second)
                for one in error.problems
            ]
            raise InputError(problems) from first
        raise
    return signal, read(drive_path, catalogues)


def _pairs(given: Sequence[str], option: str) -> dict[str, str]:
    """Return name -> value of ``name=value``, all that are none at once."""
    split = [one.partition("=") for one in given]
    text = _("{text} is not NAME=…, with the name of a channel")
    bad = [
        Problem(option, text.format(text=repr(one)))
        for one, (name, _sign, value) in zip(given, split, strict=True)
        if not name or not value
    ]
    if bad:
        raise InputError(bad)
    return {name: value for name, _sign, value in split}


def placed(recording: Signal, places: Sequence[str], drive: Drive) -> Signal:
    """Return a recording with its sensors where the options say."""
    said = _pairs(places, "--place")
    problems = list(_bad_places(recording, said, drive))
    if problems:
        raise InputError(problems)

    def moved(one: Any) -> Any:
        if one.name not in said:
            return one
        place, _sign, way = said[one.name].partition(":")
        return replace(one, place=place or one.place, direction=way or one.direction)

    return replace(recording, channels=tuple(moved(one) for one in recording.channels))


def _bad_places(recording: Signal, said: dict[str, str], drive: Drive) -> Iterator[Problem]:
    for name, value in said.items():
        try:
            recording.channel(name)
        except InputError as error:
            yield Problem("--place", error.problems[0].message, "unknown_key")
        place, sign, way = value.partition(":")
        if place and not _there(place, drive):
            text = _("{place} is not a part of the drive; it has {parts}")
            yield Problem("--place", text.format(place=repr(place), parts=_parts(drive)), "out_of_range")
        if sign and way not in DIRECTIONS[:-1]:
            text = _("{value} is none of {choices}")
            yield Problem("--place", text.format(value=repr(way), choices=", ".join(DIRECTIONS[:-1])), "out_of_range")


def _counts(drive: Drive) -> dict[str, int]:
    return {"supports": len(drive.supports), "shafts": len(drive.shafts), "joints": len(drive.joints)}


def _there(place: str, drive: Drive) -> bool:
    found = re.fullmatch(r"(supports|shafts|joints)\[(\d+)\]", place)
    return found is not None and int(found[2]) < _counts(drive)[found[1]]


def _parts(drive: Drive) -> str:
    named = [(name, count) for name, count in _counts(drive).items() if count]
    return ", ".join(f"{name}[0]" if count == 1 else f"{name}[0…{count - 1}]" for name, count in named)
