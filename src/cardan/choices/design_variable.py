"""Keys that may be changed to make a check pass: how far each may go, in which steps, and how it is rounded."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from cardan.catalogue import Catalogue, material
from cardan.catalogue.completion import SIZED
from cardan.catalogue.rows import Grade, JointSize
from cardan.checks.design import Design
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import key_of
from cardan.drive.fields.paths import place, read
from cardan.drive.material import Material
from cardan.drive.models.geometry import geometry
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.units import Key, deg

STEPS = 64
"""Places looked at in each direction, close together near what stands there."""

FIRST, FARTHEST = 0.002, math.log(8.0)
"""Logarithms of the first and the last of these over what stands there: up to eight times, down to an eighth."""

TURN = {
    "yoke_angle": 90 * deg,
    "joint_angle": 40 * deg,
    "plane_twist": 90 * deg,
    "side_slope": 15 * deg,
    "plan_slope": 15 * deg,
}
"""How far an angle is turned at most [rad]; yokes repeat themselves after half a turn."""

SHIFT = 0.2
"""How far a centre is moved at most, over the mean length of the shafts."""

ROUGH = {
    "mm": 0.5,
    "deg": 0.1,
    "rpm": 10.0,
    "Nm": 1.0,
    "MPa": 5.0,
    "h": 10.0,
    "N": 100.0,
    "g_mm": 1.0,
    "rpm_deg": 100.0,
}
"""Steps that a drawing or a duty has, by unit."""


@dataclass(frozen=True, eq=False, kw_only=True)
class DesignVariable:
    """A key that holds a number."""

    bare: str  # bare, path: without and with its unit
    path: str
    unit: str
    factor: float  # from the unit to SI
    now: float  # what stands there, in SI
    whole: bool  # whether it is a count
    key: Key  # its allowed range
    # how much has to be redone: 0 a part, 1 the place of joints between the ends, 2 that of the ends, 3 what is asked
    # of the drive
    effort: int = 0
    reach: float | None = None  # how far it goes at most, in SI; None where it grows and shrinks by a factor
    pitch: float | None = None  # step in which it can be changed, in SI: a yoke on a spline goes from tooth to tooth

    @property
    def stepped(self) -> bool:
        """Whether there is nothing between its values."""
        return self.whole or self.pitch is not None

    def ladder(self, side: float) -> Array:
        """Return the values to look at, upwards (+1) or downwards (-1), from what stands there on, array (k,)."""
        if self.whole:
            values = self.now + side * np.arange(1.0, max(8.0, self.now))
        elif self.reach is not None and self.pitch is not None:
            values = self.now + side * self.pitch * np.arange(1.0, math.floor(self.reach / self.pitch + 1e-9) + 1.0)
        elif self.reach is not None:
            values = self.now + side * np.geomspace(self.reach / 2000.0, self.reach, STEPS)
        else:
            values = self.now * np.exp(side * np.geomspace(FIRST, FARTHEST, STEPS))
        return np.asarray([value for value in values if self.key.allows(float(value))])

    def beyond(self, value: float) -> Iterator[float | int]:
        """Yield round figures from a value on, away from what stands there, in the unit of the path."""
        side = 1.0 if value >= self.now else -1.0
        shown = value / self.factor
        if self.whole:
            yield from (int(math.ceil(shown) if side > 0 else math.floor(shown)) + int(side) * k for k in range(4))
            return
        if self.pitch is not None:
            yield round(shown, 10)
            return
        step = self._step(shown)
        first = math.ceil(shown / step - 1e-9) if side > 0 else math.floor(shown / step + 1e-9)
        for k in (0, 1, 2, 3, 5, 8, 12, 20):
            found = round((first + side * k) * step, 10)
            if self.key.allows(found * self.factor):
                yield found

    def _step(self, shown: float) -> float:
        """Return the step to round to: as a drawing has it, but no coarser than a twentieth of the value."""
        rough = ROUGH.get(self.unit, 0.0)
        if self.reach is not None:
            return rough or 0.01 * abs(self.reach / self.factor)
        size = abs(shown)
        wanted = min(max(0.01 * size, rough), 0.05 * size)
        power = 10.0 ** math.floor(math.log10(wanted))
        return power * (5.0 if wanted >= 5.0 * power else 1.0)


def design_variables_of(drive: Drive, paths: Iterable[str], known: Catalogue) -> Iterator[DesignVariable]:
    """Yield the design variables among some paths without units; sizes that a maker sets are none.

    drive: with grades and sizes filled in.
    """
    for bare in paths:
        owner, _dot, _name = bare.rpartition(".")
        if is_sized(drive, bare, known) or (owner.endswith("material") and graded(drive, owner, known) is not None):
            continue
        path = key_of(bare)
        try:
            there, shown = place(drive, path), read(drive, path)
        except InputError:
            continue
        if isinstance(shown, bool) or not isinstance(shown, int | float):
            continue
        now = float(shown) * there.factor
        reach = _reach(drive, bare)
        if reach is None and now == 0.0:
            continue
        yield DesignVariable(
            bare=bare,
            path=path,
            unit=there.field.unit(there.spelling),
            factor=there.factor,
            now=now,
            whole=isinstance(shown, int),
            key=there.field.key,
            effort=_effort(drive, bare),
            reach=reach,
            pitch=_pitch(drive, bare),
        )


def is_sized(drive: Drive, bare: str, known: Catalogue) -> bool:
    """Tell whether a maker's size sets what stands at a path."""
    part = re.match(r"joints\[(\d+)\]\.(\w+)", bare)
    return part is not None and part[2] in SIZED and drive.joints[int(part[1])].size in known.rows(JointSize)


def graded(drive: Drive, path: str, known: Catalogue) -> Grade | None:
    """Return the grade of the catalogue that stands at a path; None where the drive gives its figures itself."""
    here: Material | None = Design(drive=drive, duty=drive.duty).value(path)
    if here is None or not here.grade:
        return None
    try:
        row = known.grade(here.grade)
    except InputError:
        return None
    return row if here == material(here.grade, known=known) else None


def _effort(drive: Drive, bare: str) -> int:
    if bare.startswith("duty."):
        return 3
    joint = re.match(r"joints\[(\d+)\]\.centre", bare)
    ends = (0, len(drive.joints) - 1)
    if bare.startswith(("input.", "output.")) or (joint is not None and int(joint[1]) in ends):
        return 2
    return 1 if re.search(r"\.(centre|joint_angle|plane_twist|side_slope|plan_slope|length)(\[|$)", bare) else 0


def _pitch(drive: Drive, bare: str) -> float | None:
    """Return the angle from tooth to tooth of the spline whose yokes a path turns against each other [rad]."""
    yoke = re.fullmatch(r"shafts\[(\d+)\]\.yoke_angle", bare)
    spline = drive.shafts[int(yoke[1])].spline if yoke else None
    return 2.0 * math.pi / spline.teeth if spline is not None and spline.teeth else None


def _reach(drive: Drive, bare: str) -> float | None:
    name = re.sub(r"\[\d+\]$", "", bare.rpartition(".")[2])
    if name in TURN:
        return TURN[name]
    if name in ("centre", "point"):
        return SHIFT * float(np.mean(geometry(drive).length))
    return None
