"""What a drive gives that is possible but hardly meant: sizes in another unit, angles in radians, signs."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, is_dataclass
from itertools import pairwise
from typing import Any

from cardan.answers.quantity import Quantity, Text, say
from cardan.drive.described import Described
from cardan.reading.fields import fields_of
from cardan.texts import _

from .keys import spelled

USUAL: tuple[tuple[str, float, float], ...] = (
    (r".*\.(error|tolerance)\.\w+", 0.0, math.inf),
    (r"shafts\[\d+\]\.length|shafts\[\d+\]\.segments\[\d+\]\.length", 2e-3, 40.0),
    (r".*\.(outer|inner|root|mean_diameter|span|driving_distance|driven_distance|groove_radius)", 1e-3, 4.0),
    (r".*\.(wall|journal|journal_length|journal_bore|bending_arm|torsion_arm|height|width|tooth_width)", 1e-4, 1.0),
    (r".*\.needles\.(diameter|length)", 2e-4, 0.3),
    (r".*\.spline\.(length|engaged|gap)", 5e-4, 3.0),
    (r".*\.(youngs|shear)", 1e8, 2e12),
    (r".*\.(yield_strength|ultimate_strength)", 5e6, 6e9),
    (r".*\.density", 100.0, 25e3),
    (r"limits\.(shear_stress|spline_pressure)", 1e5, 5e9),
    (r"duty\.torque|duty\.(blocks|cases)\[\d+\]\.torque|.*\.rating\.(max_)?torque", 1e-4, 5e7),
    (r"duty\.((blocks|cases)\[\d+\]\.)?speed(_range\[\d\])?|.*\.rating\.max_speed", 1e-3, 2e4),
    (r"duty\.life", 60.0, 3.6e9),
    (r".*\.(mass|masses\[\d+\]\.mass)", 1e-6, 2e5),
    (r".*\.(inertia|polar_inertia|transverse_inertia|diametral_inertia)", 1e-10, 1e6),
    (r".*\.capacity|.*\.static_capacity", 10.0, 1e8),
    (r".*\.to_next\.friction", 1e-4, 5e7),
    (r".*\.friction|.*\.material_friction", 0.0, 1.0),
)
"""Pattern of a path, and between which magnitudes in SI its value lies in drives that are built."""

SHIFTS = (1e-3, 1e3, 1e-6, 1e6)
"""By which a value in another unit is off: millimetres and metres, megapascals and pascals."""

APART = 100.0  # distance of neighbouring points of the axis [m] beyond which they are hardly meant

RADIANS = (math.radians(0.05), math.radians(0.9))
"""Joint angles between which all of a drive look like radians that were given as degrees."""

QUARTERS = tuple(k * math.pi / 4.0 for k in (1, 2, 3, 4))  # angles in radians that are common; as many degrees are not


@dataclass(frozen=True, kw_only=True)
class Doubt:
    """A value that is hardly meant."""

    path: str  # where it stands, without a unit
    text: Text  # what is odd about it, in a sentence


def doubts(drive: Described) -> Iterator[Doubt]:
    """Yield what a drive gives that is hardly meant; nothing is changed for it."""
    for path, value, dimension in _numbers(drive, ""):
        yield from _magnitude(path, value, dimension)
    yield from _distances(drive)
    yield from _radians(drive)
    torque, speed = drive.duty.torque, drive.duty.speed
    if torque is not None and torque < 0.0:
        text = _("{key} is {value}, less than zero: the load drives the output instead of resisting it.")
        yield _doubt(text, "duty.torque", torque, "torque")
    if speed is not None and speed < 0.0:
        text = _("{key} is {value}, less than zero: the input turns the other way.")
        yield _doubt(text, "duty.speed", speed, "angular_speed")


def _doubt(text: str, path: str, value: float, dimension: str, **more: Text) -> Doubt:
    return Doubt(path=path, text=say(text, key=spelled(path), value=Quantity(value, dimension, 6, trim=True), **more))


def _numbers(thing: Any, before: str) -> Iterator[tuple[str, float, str]]:
    """Yield path, value and dimension of every number that stands in a thing."""
    for name, one in fields_of(type(thing)).items():
        value = getattr(thing, name)
        rows = enumerate(value) if isinstance(value, tuple) else ((None, value),)
        for k, item in rows:
            path = f"{before}{name}" if k is None else f"{before}{name}[{k}]"
            if is_dataclass(item) and not isinstance(item, type):
                yield from _numbers(item, f"{path}.")
            elif isinstance(item, float) and item != one.default:
                yield path, item, one.key.dimension or ""


def _magnitude(path: str, value: float, dimension: str) -> Iterator[Doubt]:
    """Yield a value whose magnitude no built drive has, with the one that it has in another unit."""
    low, high = next(((low, high) for form, low, high in USUAL if re.fullmatch(form, path)), (0.0, math.inf))
    size = abs(value)
    if size == 0.0 or low <= size <= high or not math.isfinite(size):
        return
    meant = next((value * shift for shift in SHIFTS if dimension and low <= size * shift <= high), None)
    if meant is None:
        yield _doubt(_("{key} is {value}; is that so?"), path, value, dimension)
    else:
        other = Quantity(meant, dimension, 6, trim=True)
        yield _doubt(_("{key} is {value}; did you mean {other}?"), path, value, dimension, other=other)


def _distances(drive: Described) -> Iterator[Doubt]:
    """Yield a distance of neighbouring joints that no drive has."""
    centres = [one.centre for one in drive.joints]
    for k, (one, other) in enumerate(pairwise(centres), start=1):
        if one is None or other is None:
            continue
        apart = math.dist(one, other)
        if apart > APART or 0.0 < apart < 1e-3:
            shift = 1e-3 if apart > APART else 1e3
            text = _("joints {one} and {two} are {value} apart; did you mean {other}?")
            said = {
                "value": Quantity(apart, "length", 6, trim=True),
                "other": Quantity(shift * apart, "length", 6, trim=True),
            }
            yield Doubt(path=f"joints[{k}].centre", text=say(text, one=k, two=k + 1, **said))


def _radians(drive: Described) -> Iterator[Doubt]:
    """Yield angles that look like radians which were given as degrees."""
    joint_angles = [(i, one.joint_angle) for i, one in enumerate(drive.joints) if one.joint_angle]
    if joint_angles and all(RADIANS[0] <= joint_angle <= RADIANS[1] for _i, joint_angle in joint_angles):
        for i, joint_angle in joint_angles:
            text = _("{key} is {value}, which looks like radians; did you mean {other}?")
            other = Quantity(math.degrees(joint_angle), "angle", 4, trim=True)
            yield _doubt(text, f"joints[{i}].joint_angle", joint_angle, "angle", other=other)
    for k, shaft in enumerate(drive.shafts):
        angle = abs(math.degrees(shaft.yoke_angle or 0.0))
        if any(abs(angle - quarter) < 2e-3 for quarter in QUARTERS):
            text = _("{key} is {value}, which looks like radians; did you mean {other}?")
            other = Quantity(math.degrees(shaft.yoke_angle or 0.0), "angle", 4, trim=True)
            yield _doubt(text, f"shafts[{k}].yoke_angle", shaft.yoke_angle or 0.0, "angle", other=other)
