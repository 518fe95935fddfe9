"""Critical speeds of the shafts of a design: of the whole line where the drive says enough, else shaft by shaft."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from cardan.checks.design import Design
from cardan.checks.strength.section import Section, modulus, sections
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.paths import place, with_values
from cardan.errors import InputError
from cardan.maths.arrays import Array
from cardan.questions.bending.bending import SPLINED, bending_speeds

MOVES = r"(shafts|joints|supports)\[|input\.|output\."
"""Paths that may change the speeds of the line."""

STEP = 0.02
"""Share of a size by which it is changed to see how the speeds of the line go with it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Whirl:
    """How fast a shaft may turn until it whirls.

    Attributes
    ----------
    shaft : int
        Counted from 0.
    speed : array (...) or None [rad/s]
        Critical speed as computed; None where something is missing, or the shaft cannot be rated alone.
    wear : float or array (...)
        k_n, real over computed critical speed.
    exact : bool
        Whether it is that of the whole line, with supports, masses and stretches.
    missing, design_variables : tuple of str
        Paths that lack, and those that move it.
    """

    shaft: int
    speed: Array | None
    wear: Array | float
    exact: bool = False
    missing: tuple[str, ...] = ()
    design_variables: tuple[str, ...] = ()


def whirls(design: Design) -> list[Whirl]:
    """Return the lowest critical speed of every shaft between two joints, and of end shafts that whirl in the line.

    Parameters
    ----------
    design : Design
        Where sizes vary, the speed of the line changes as that of the shaft alone between its joints, that of an end
        shaft with the power of each size that holds near the drive as it is.

    Notes
    -----
    The line as a whole: `cardan.questions.bending.bending`. A tube alone: Book (257), ω = (π/L)² √(E(D² + d²)/(16ρ)).
    """
    line = _line(design.drive)
    plain = Design(drive=design.drive, duty=design.duty, known=design.known)
    found = []
    for k in range(1, design.joints):
        alone = _alone(design, k)
        if alone.speed is not None and k in line:
            before = _alone(plain, k).speed
            speed = line[k] * (alone.speed / before)
            alone = Whirl(shaft=k, speed=speed, wear=alone.wear, exact=True, design_variables=alone.design_variables)
        elif k not in line and line:
            continue
        found.append(alone)
    return [*found, *(_end(design, plain, k, line[k]) for k in (0, design.joints) if k in line)]


@lru_cache(maxsize=64)
def _line(drive: Drive) -> dict[int, float]:
    """Return the lowest critical speed of each shaft in the whole line, by index; none where the file lacks some."""
    try:
        found = bending_speeds(drive, modes=len(drive.joints))
    except InputError:
        return {}
    speeds: dict[int, float] = {}
    for part, speed in zip(found.part, found.speed, strict=True):
        if part.kind == "shaft":
            speeds.setdefault(part.number - 1, float(speed))
    return speeds


def _end(design: Design, plain: Design, k: int, speed: float) -> Whirl:
    """Return the critical speed of an end shaft on its supports: that of the line.

    Where sizes vary it goes with a power of each, found from the line itself: bearings and joints bend too.
    """
    longest = _longest(list(sections(design, k)))
    varied = np.asarray(speed)
    for path, values in design.varied.items():
        now = plain.value(path)
        if re.match(MOVES, path) and isinstance(now, float):
            power = _power(design.drive, path, k)
            varied = varied * (np.maximum(values / now, 1e-9) ** power if now > 0.0 else np.exp(power * (values - now)))
    design_variables = design.design_variables(*longest.design_variables, f"shafts[{k}].wear_factor")
    return Whirl(shaft=k, speed=varied, wear=_wear(design, k), exact=True, design_variables=design_variables)


@lru_cache(maxsize=256)
def _power(drive: Drive, path: str, k: int) -> float:
    """Return d ln ω/d ln value of the speed of a shaft in the line by a positive value, else d ln ω/d value."""
    key = spelled(path)
    unit = place(drive, key).factor
    now = float(Design(drive=drive, duty=drive.duty).value(path))
    step = STEP * now if now > 0.0 else STEP * 0.1
    found = []
    for value in (now - step, now, now + step):
        try:
            speed = _line(with_values(drive, {key: value / unit})).get(k)
        except InputError:
            continue  # beyond the range of the field, on this side
        if speed is not None:
            found.append((math.log(value) if now > 0.0 else value, math.log(speed)))
    if len(found) < 2:
        return 0.0
    (first, low), (last, high) = found[0], found[-1]
    return (high - low) / (last - first)


def _longest(found: list[Section]) -> Section:
    """Return the longest of the stretches of a shaft."""
    return max(found, key=lambda one: 0.0 if one.length is None else float(np.max(np.asarray(one.length))))


def _swiftness(design: Design, section: Section) -> Array:
    """Return what critical speeds of shafts of one length are proportional to: √(E/ρ) √(D² + d²)."""
    stiff, heavy = (np.asarray(modulus(design, section, name)) for name in ("youngs", "density"))
    found: Array = np.sqrt(stiff / heavy) * np.hypot(section.outer, section.inner)
    return found


def _wear(design: Design, k: int) -> Array | float:
    """Return real over computed critical speed of a shaft."""
    given: Array | float | None = design.value(f"shafts[{k}].wear_factor")
    usual = SPLINED if design.drive.shafts[k].spline is not None else 1.0
    return usual if given is None else given


def _alone(design: Design, k: int) -> Whirl:
    """Return the critical speed of a shaft between its joints, one like its longest stretch."""
    found = list(sections(design, k))
    length = design.length(k)
    lacking = [] if found else [f"shafts[{k}].outer"]
    lacking += [] if length is not None else [f"shafts[{k}].length"]
    wear = _wear(design, k)
    if lacking or length is None:
        return Whirl(shaft=k, speed=None, wear=wear, missing=tuple(lacking))
    section = _longest(found)
    speed: Array = 0.25 * _swiftness(design, section) * (math.pi / length) ** 2
    design_variables = [*section.design_variables, f"shafts[{k}].wear_factor"]
    design_variables += [f"shafts[{k}].length"] if design.drive.form != "points" and len(found) == 1 else []
    return Whirl(shaft=k, speed=speed, wear=wear, design_variables=design.design_variables(*design_variables))
