"""Critical speeds of the shafts of a design: of the whole line where the drive says enough, else shaft by shaft."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TypeAlias

import numpy as np

from cardan.answers.quantity import Quantity, Text, say
from cardan.checks.design import Design, row_of
from cardan.checks.strength.section import Section, modulus, sections
from cardan.checks.verdict import Verdict
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.paths import place, with_values
from cardan.errors import InputError
from cardan.formulas.damping import LOSS
from cardan.maths.arrays import Array
from cardan.questions.bending.bending import SPLINED, bending_speeds, length_powers, passing
from cardan.texts import _

MOVES = r"(shafts|joints|supports)\[|input\.|output\."
"""Paths that may change the speeds of the line."""

FEWEST = 3
"""Modes of the line asked for at least, as many as the answer about bending has."""

STEP = 0.02
"""Share of a size by which it is changed to see how the speeds of the line go with it."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Whirl:
    """How fast a shaft may turn until it whirls, or until it bounces on a support."""

    shaft: int  # counted from 0: the shaft that whirls, or the one that bends most where a support gives way
    # (...) [rad/s]: critical speed as computed; None where something is missing, or the shaft cannot be rated alone
    speed: Array | None
    wear: Array | float  # (...): k_n, real over computed critical speed
    exact: bool = False  # whether it is that of the whole line, with supports, masses and stretches
    missing: tuple[str, ...] = ()  # missing, design_variables: paths that lack, and those that move it
    design_variables: tuple[str, ...] = ()
    support: int | None = None  # counted from 0, where a support gives way
    sideways: bool = False  # whether it does so sideways, where it is stiffer or softer that way

    @property
    def actual(self) -> Array:
        """Critical speed of the real shaft, array (...) [rad/s]."""
        return np.asarray(self.wear * np.asarray(self.speed))


def whirls(design: Design) -> list[Whirl]:
    """Return the lowest critical speed of every shaft between two joints, and of end shafts that whirl in the line.

    design: where sizes vary, the speed of the line changes as that of the shaft alone between its joints, that of an
    end shaft with the power of each size that holds near the drive as it is.
    The line as a whole: `cardan.questions.bending.bending`. A tube alone: Book (257), ω = (π/L)² √(E(D² + d²)/(16ρ)).
    """
    line = {k: speed for (kind, k, nth, _aside), (speed, _s) in _lowest(design).items() if kind == "shaft" and not nth}
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
    return [*found, *(_in_line(design, ("shaft", k, 0, False)) for k in (0, design.joints) if k in line)]


def bounces(design: Design) -> list[Whirl]:
    """Return the critical speeds at which supports give way, lowest first; see `whirls`."""
    return [_in_line(design, part) for part in _lowest(design) if part[0] == "support"]


Part: TypeAlias = tuple[str, int, int, bool]
"""What moves in a mode: shaft or support, which one from 0, how many modes of the same lie below, whether sideways."""


def _lowest(design: Design) -> dict[Part, tuple[float, int]]:
    """Return the critical speeds of the line as far as speeds of running come near to them."""
    return _line(design.drive, _top(design))


def _top(design: Design) -> float:
    return 0.0 if design.top_speed is None else float(np.max(design.top_speed))


@lru_cache(maxsize=64)
def _line(drive: Drive, top: float) -> dict[Part, tuple[float, int]]:
    """Return the critical speeds of the whole line with the shaft that bends most; none where the file lacks some."""
    try:
        found = bending_speeds(drive, Duty(speed=top or None), modes=max(len(drive.joints), FEWEST))
        if found.deciding is not None and found.deciding >= len(found.speed):  # below it only supports give way
            found = bending_speeds(drive, Duty(speed=top or None), modes=found.deciding + 1)
    except InputError:
        return {}
    modes: dict[Part, tuple[float, int]] = {}
    for part, speed, share in zip(found.part, found.speed, found.shaft_share, strict=True):
        own = part.kind, part.number - 1, part.sideways
        nth = sum((key[0], key[1], key[3]) == own for key in modes)
        modes[part.kind, part.number - 1, nth, part.sideways] = float(speed), int(np.argmax(share))
    return modes


def _in_line(design: Design, part: Part) -> Whirl:
    """Return a critical speed of the line: of an end shaft on its supports, or of a support that gives way.

    Where sizes vary it goes with a power of each, found from the line itself: bearings and joints bend too.
    """
    speed, bent = _lowest(design)[part]
    kind, k, _nth, sideways = part
    longest = _longest(list(sections(design, bent)))
    plain, varied = Design(drive=design.drive, duty=design.duty, known=design.known), np.asarray(speed)
    for path, values in design.varied.items():
        now = plain.value(path)
        if re.match(MOVES, path) and isinstance(now, float) and row_of(path, design.joints) is None:
            power = _power(design.drive, path, part, _top(design))
            varied = varied * (np.maximum(values / now, 1e-9) ** power if now > 0.0 else np.exp(power * (values - now)))
    if design.drive.form == "points":
        varied = varied * _stretched(design, plain, part)
    bounce = kind == "support"
    own = (
        [f"supports[{k}].{'side_stiffness' if sideways else 'stiffness'}", f"supports[{k}].tilt_stiffness"]
        if bounce
        else longest.design_variables
    )
    return Whirl(
        shaft=bent if bounce else k,
        speed=varied,
        wear=1.0 if bounce else _wear(design, k),
        exact=True,
        design_variables=design.design_variables(*own, *(() if bounce else (f"shafts[{k}].wear_factor",))),
        support=k if bounce else None,
        sideways=sideways,
    )


def _stretched(design: Design, plain: Design, part: Part) -> Array:
    """Return by what a critical speed of the line changes with the lengths of its shafts, array (...)."""
    factor = np.asarray(1.0)
    for k in range(1, design.joints):
        length, drawn = (np.asarray(one.length(k), dtype=float) for one in (design, plain))
        if length.ndim:
            nth = list(_lowest(design)).index(part)
            factor = factor * (length / drawn) ** _length_powers(design.drive, nth + 1)[k - 1, nth]
    return factor


_length_powers = lru_cache(maxsize=64)(length_powers)


@lru_cache(maxsize=256)
def _power(drive: Drive, path: str, part: Part, top: float) -> float:
    """Return d ln ω/d ln value of a critical speed of the line by a positive value, else d ln ω/d value."""
    key = spelled(path)
    unit = place(drive, key).factor
    now = float(Design(drive=drive, duty=drive.duty).value(path))
    step = STEP * now if now > 0.0 else STEP * 0.1
    found = []
    for value in (now - step, now, now + step):
        try:
            speed = _line(with_values(drive, {key: value / unit}), top).get(part)
        except InputError:
            continue  # beyond the range of the field, on this side
        if speed is not None:
            found.append((math.log(value) if now > 0.0 else value, math.log(speed[0])))
    if len(found) < 2:
        return 0.0
    (first, low), (last, high) = found[0], found[-1]
    return (high - low) / (last - first)


def nearest(speeds: list[Array], middle: Array) -> Array:
    """Return of some speeds the one whose ratio to the middle is nearest to 1, array (...) [rad/s]."""
    rows = np.stack(np.broadcast_arrays(*speeds, middle)[:-1])
    off = np.abs(np.log(np.maximum(rows, 1e-9) / middle))
    found: Array = np.take_along_axis(rows, np.argmin(off, axis=0)[None], axis=0)[0]
    return found


def clearances(
    design: Design, one: Whirl, share: float, width: float, texts: tuple[str, str], source: Text
) -> Iterator[Verdict]:
    """Yield how far the speeds held keep off a share of a critical speed, and whether running up passes it.

    one: a support that gives way; share: 1, or one half where the joints excite twice a turn.
    width: half the width of the band to keep out of, over its middle; texts: what is judged: speeds held, and passing.
    source: where the band comes from.
    """
    subject = f"supports[{one.support}]"
    if design.top_speed is None:
        yield Verdict(subject=subject, title=texts[0], missing=design.unmoved)
        return
    middle = share * one.actual
    low, high = middle * (1.0 - width), middle * (1.0 + width)
    running = design.held_speeds
    common = Verdict(
        subject=subject, limit=(low, high), sense="outside", dimension="angular_speed", unit="rpm", source=source
    )
    if running:
        design_variables = (
            *one.design_variables,
            *(path for path in design.speed_design_variables if "range" not in path),
        )
        yield replace(
            common, title=texts[0], value=nearest(running, np.sqrt(low * high)), design_variables=design_variables
        )
    value = np.minimum(middle, design.top_speed)
    passed = np.ndim(value) == 0 and bool(value > low)
    note = hurry(float(one.actual), "support", width) if passed else ""
    yield replace(common, title=texts[1], value=value, design_variables=one.design_variables, note=note, advice=True)


def hurry(critical: float, kind: str, width: float) -> Text:
    """Return how fast to pass a critical speed [rad/s], or half of it."""
    half, full = (Quantity(time, "time", 2) for time in passing(critical, kind, width))
    text = _("pass it quickly: in {half} half of the resonance builds up, in {full} all of it (η = {loss})")
    return say(text, half=half, full=full, loss=Quantity(LOSS[kind], digits=2, trim=True))


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
