"""What the commands of ``cardan torsion`` share: options, names of elements, how to stop long work and keep it."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, TypeAlias

import numpy as np

from cardan.cli.shared.options import option
from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.questions.torsion.stability.torsion_stability import PACE
from cardan.register import QUESTIONS
from cardan.texts import _
from cardan.units import rpm

Speeds: TypeAlias = Annotated[
    str | None,
    option("--speeds", "LOW:HIGH[:COUNT]", _("Input speeds in rpm, from the lowest to the highest, instead of one.")),
]
Pieces: TypeAlias = Annotated[
    int,
    option(
        "--pieces", "N", _("Stretches into which the body of a shaft is divided between two stations."), min=1, max=1000
    ),
]

RUNNING = replace(
    QUESTIONS["orders"],
    name="torsion-response",
    module="cardan.questions.torsion.steady.running",
    gathered=("pose", "movement", "error"),
)
"""The question of `torsion response` at one speed: of the drive as drawn, in each of its load cases."""

COUNT = 121  # values of a list where no number is given
MOST = 1_000_000  # values of a list at most


def at_speed(drive: Drive, speed_rpm: float | None) -> Drive:
    """Return a drive with the speed of the command line [rpm] instead of its own, in all of its load cases too."""
    if speed_rpm is None:
        return drive
    speed = speed_rpm * rpm
    cases = tuple(replace(one, speed=None, speed_range=None) for one in drive.duty.cases)
    blocks = tuple(replace(one, speed=abs(speed)) for one in drive.duty.blocks)
    return replace(drive, duty=replace(drive.duty, speed=speed, cases=cases, blocks=blocks))


def values(text: str, option: str, *, count: int = COUNT, low: float | None = None) -> Any:
    """Return the values of LOW:HIGH[:COUNT].

    count: how many, where the text does not say; low: the values are above this.
    """
    parts = text.split(":")
    try:
        first, last = (float(part) for part in parts[:2])
        many = int(parts[2]) if len(parts) > 2 else count
    except ValueError:
        first = last = float("nan")
        many = 0
    if len(parts) > 3 or not (np.isfinite(first) and np.isfinite(last)):
        raise refuse(option, _("{text} is not a range; write LOW:HIGH or LOW:HIGH:COUNT").format(text=text))
    if not first < last or many < 2:
        raise refuse(option, _("{text} is empty; the second value is above the first, two at least").format(text=text))
    if low is not None and first <= low:
        raise refuse(option, _("{first:g} is not allowed; allowed is more than {low:g}").format(first=first, low=low))
    if many > MOST:
        said = _("{count:,} values would take about {hours:,.0f} h; at most {most:,} are done")
        said = said.format(count=many, hours=many * PACE / 3600.0, most=MOST)
        raise refuse(option, said.replace(",", "\u202f"))
    return np.linspace(first, last, many)
