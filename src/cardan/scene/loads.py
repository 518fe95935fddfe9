"""Forces and couples of a drive as arrows over the turn."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from cardan.answers.quantity import Quantity
from cardan.answers.reader import reader
from cardan.drive.bodies.assembly import extent
from cardan.drive.bodies.build import Build
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import geometry
from cardan.drive.models.machine_held import machine_held
from cardan.errors import InputError
from cardan.figures import palette
from cardan.figures.turning import shaft_name
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.forces.forces import forces
from cardan.texts import _

from .parts import SceneArrow, SceneGroup

LONGEST = 0.16
"""Length of the largest arrow over the size of the whole."""

LEAST = 1e-9
"""Forces and couples below this share of the largest are none."""

Loads = tuple[tuple[SceneArrow, ...], tuple[SceneGroup, ...], dict[str, str]]


def loads(drive: Drive, build: Build, size: float) -> Loads:
    """Return arrows of the forces and couples of a drive as drawn, their switches, and why there are none.

    build: its bodies; in a pose or while it moves no arrows are drawn that belong to another place.
    size [m].
    """
    if not np.allclose(build.place.points, geometry(drive).points, rtol=0.0, atol=1e-9 * size):
        return (), (), _both(_("Forces are shown for the drive as drawn and in its poses, not while it moves."))
    angle = np.arange(build.frames) * (2.0 * np.pi / build.frames)
    try:
        found = forces(drive, angle=angle)
    except InputError as error:
        return (), (), _both(sentence(error))
    missing: dict[str, str] = {}
    arrows: list[SceneArrow] = []
    groups: list[SceneGroup] = []
    pushes: list[tuple[str, Array, Array, str]] = []
    if found.reaction is None:
        missing["forces"] = _("supports: missing; forces of bearings and joints need [[supports]] that hold the shafts")
    else:
        for number, one in enumerate(machine_held(drive).supports):
            foot = build.centre(max(one.shaft - 2, 0)) + one.position * build.axis(one.shaft)
            name = one.name or _("support {number}").format(number=number + 1)
            pushes.append((name, foot, np.asarray(found.reaction)[number], "accent"))
        assert found.joint_force is not None
        for i in range(build.count):
            text = _("joint {number}, on the driven shaft").format(number=i + 1)
            pushes.append((text, build.centre(i), np.asarray(found.joint_force)[i], "second order"))
    whole, text = _scaled(pushes, "forces", "N", LONGEST * size, curl=False)
    if whole:
        arrows += whole
        groups.append(SceneGroup(name="forces", title=_("Forces"), on=True, text=text))
    turning = list(_torques(build, np.asarray(found.shaft_torque), np.asarray(found.output_torque)))
    bent = [
        (
            _("secondary couple of {shaft}").format(shaft=shaft_name(k, build.count + 1)),
            _middle(build, k),
            np.asarray(found.secondary_couple)[k - 1],
            "first order",
        )
        for k in range(1, build.count + 2)
    ]
    whole, text = _scaled([*turning, *bent], "couples", "Nm", LONGEST * size, curl=True)
    if whole:
        arrows += whole
        groups.append(SceneGroup(name="couples", title=_("Couples"), on=False, text=text))
    return tuple(arrows), tuple(groups), missing


def _both(text: str) -> dict[str, str]:
    return {"forces": text, "couples": text}


def sentence(error: InputError) -> str:
    """Return what is missing, with the keys that would allow the answer."""
    return "; ".join(f"{one.field}: {one.message}" if one.field else one.message for one in error.problems)


def _middle(build: Build, k: int) -> Array:
    low, high = extent(build, k)
    found: Array = build.centre(max(k - 2, 0)) + 0.5 * (low + high) * build.axis(k)
    return found


def _torques(build: Build, torque: Array, output: Array) -> list[tuple[str, Array, Array, str]]:
    """Return the torque that drives the input, and the one that resists the output."""
    last = build.count + 1
    low, high = extent(build, 1)[0], extent(build, last)[1]
    return [
        (
            _("torque that drives the input"),
            build.centre(0) + 1.08 * low * build.axis(1),
            torque[0][:, None] * build.axis(1),
            "good",
        ),
        (
            _("torque that resists the output"),
            build.centre(build.count - 1) + 1.08 * high * build.axis(last),
            -np.broadcast_to(output, torque[0].shape)[:, None] * build.axis(last),
            "failed",
        ),
    ]


def _scaled(
    rows: Sequence[tuple[str, Array, Array, str]], group: str, unit: str, longest: float, *, curl: bool
) -> tuple[list[SceneArrow], str]:
    """Return rows of (name, foot, vector over the turn, role) as arrows to one scale, and that scale in words."""
    sizes = [frames.norm(vector) for _name, _foot, vector, _role in rows]
    most = max((float(np.max(one)) for one in sizes), default=0.0)
    if not most > 0.0 or not math.isfinite(most):
        return [], ""
    made = []
    for (name, foot, vector, role), one in zip(rows, sizes, strict=True):
        low, high = float(np.min(one)), float(np.max(one))
        if high <= LEAST * most:
            continue
        low = low if low > LEAST * high else 0.0
        text = _("{name}: {low} to {high}") if high - low > 1e-3 * high else _("{name}: {high}")
        text = text.format(name=name, low=amount(low, unit), high=amount(high, unit))
        colour = palette.colour(role)
        made.append(
            SceneArrow(group=group, text=text, colour=colour, curl=curl, start=foot, vector=longest / most * vector)
        )
    return made, _("The longest arrow is {size}; all are drawn to one scale.").format(size=amount(most, unit))


def amount(value: float, unit: str) -> str:
    """Return a force [N] or couple [N·m] as who reads here is told it.

    >>> amount(2314.0, "N"), amount(0.04, "Nm")
    ('2.31 kN', '0.0400 N·m')
    """
    usual = f"k{unit}" if abs(value) >= 1e3 else unit
    return Quantity(value, "force" if unit == "N" else "torque", 3, unit=usual).told(reader())
