"""Tables of what shafts, joints and supports carry: the largest over a turn, and everything at every position."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import Column, Depth, Table, heads
from cardan.answers.palette import colour, shaft
from cardan.answers.quantity import Joined, Quantity, numbered
from cardan.drive.drive import Drive
from cardan.drive.joints.joint import Joint
from cardan.drive.shaft import Shaft
from cardan.maths.arrays import Array
from cardan.maths.curves.cycle_statistics import Turn, harmonics, over_turn
from cardan.maths.kernel import frames
from cardan.maths.ties import TIE, foremost
from cardan.texts import _

from .forces import Forces
from .inner_loads import InnerLoad


def shaft_heads(drive: Drive) -> tuple[Column, ...]:
    """Return the columns that head a table of shafts; people are told which are input and output."""
    chips = [colour(shaft(one.number)) for one in drive.shafts]
    shown = heads(_("shaft"), [called(one, len(drive.shafts)) for one in drive.shafts], chips=chips)
    return (shown[0], *heads("", [one.name for one in drive.shafts])[1:])


def joint_heads(drive: Drive) -> tuple[Column, ...]:
    """Return the columns that head a table of joints."""
    return heads(_("joint"), [one.name for one in drive.joints])


def support_heads(drive: Drive) -> tuple[Column, ...]:
    """Return the columns that head a table of supports, in the colours of their shafts."""
    chips = [colour(shaft(one.shaft)) for one in drive.supports]
    return (
        *heads(_("support"), support_names(drive), chips=chips),
        Column(key="shaft", heading=_("shaft"), values=[one.shaft for one in drive.supports]),
    )


def shaft_table(drive: Drive, found: Forces) -> Table:
    """Return torque and secondary couple of every shaft."""
    torque, bent = turn(found.angle, found.shaft_torque), turn(found.angle, found.bending_couple)
    twice = harmonics(found.angle, tidy(found.shaft_torque)).amplitude[:, 2]
    twice = np.where(np.abs(twice) <= ROUNDING * np.abs(torque.high), 0.0, twice)
    when = [from_start(at) if most > 0.0 else None for at, most in zip(bent.high_angle, bent.high, strict=True)]
    return Table(
        name="shafts",
        records=True,
        columns=(
            *shaft_heads(drive),
            Column(key="torque_min", heading=_("torque, least"), values=torque.low, dimension="torque"),
            Column(key="torque_max", heading=_("largest"), values=torque.high, dimension="torque"),
            Column(key="torque_order_2", heading=_("2nd order, ±"), values=twice, dimension="torque"),
            Column(key="secondary_couple_max", heading=_("secondary couple"), values=bent.high, dimension="torque"),
            Column(key="secondary_couple_max_at", heading=_("at"), values=when, dimension="angle", decimals=1),
        ),
        note=_(
            "Extremes over a turn. The secondary couple is that of both ends of a shaft together, which its supports "
            "balance."
        ),
    )


def joint_table(drive: Drive, found: Forces) -> Table:
    """Return the loads in the centre and in the journals of every joint, and its power loss."""
    known = [bool(np.all(np.isfinite(sides))) for sides in found.journals.size]
    ways = senses(found)
    force: list[float | None] = [None] * len(drive.joints)
    if found.joint_force is not None:
        centre = np.max([np.max(size(one.joint_force), axis=-1) for one in ways], axis=0)
        scale = np.max([journal_peaks(one) for one in ways])
        force = np.where(centre <= ROUNDING * scale, 0.0, centre).tolist()
    peaks = np.max([journal_peaks(one) for one in ways], axis=0)
    sides = [[float(most) if given else None for most, given in zip(row, known, strict=True)] for row in peaks]
    loss = _mean_loss(drive, found)
    empty = not any(one is not None for one in (*force, *sides[0], *loss))
    depth: Depth = "data" if empty else "brief"
    return Table(
        name="joints",
        records=True,
        depth=depth,
        columns=(
            *joint_heads(drive),
            Column(key="force_max", heading=_("joint force"), values=force, dimension="force"),
            Column(key="driving_journal_max", heading=_("driving yoke"), values=sides[0], dimension="force"),
            Column(key="driven_journal_max", heading=_("driven yoke"), values=sides[1], dimension="force"),
            Column(key="power_loss_mean", heading=_("power loss"), values=loss, dimension="power"),
        ),
        note=_(
            "Largest force in the joint centre, and largest load of a journal in the driving and in the driven yoke; "
            "mean power loss."
        ),
    )


def journal_peaks(found: Forces) -> tuple[Array, Array]:
    """Return the largest load of the journals in the driving and in the driven yoke of each joint, arrays (n,) [N]."""
    loads = np.nan_to_num(found.journals.size)
    return np.max(loads[..., :2], axis=(-1, -2)), np.max(loads[..., 2:], axis=(-1, -2))


def rubs(joint: Joint) -> bool:
    """Return whether friction in a joint counts."""
    if joint.rubbing:
        return joint.rubs
    given = joint.friction is not None or joint.material_friction is not None
    return given and joint.cross is not None and None not in (joint.cross.span, joint.cross.journal)


def _mean_loss(drive: Drive, found: Forces) -> list[float | None]:
    """Return the mean power loss of each joint [W]; None where the drive does not say how fast it turns or rubs."""
    mean = np.mean(found.loss[:, :-1], axis=-1)
    known = "duty.speed" not in found.assumed
    return [float(one) if known and rubs(joint) else None for one, joint in zip(mean, drive.joints, strict=True)]


def inner_table(drive: Drive, loads: Sequence[InnerLoad]) -> Table:
    """Return what the parts inside of the joints carry."""
    several = any(one.low < one.high * (1.0 - ROUNDING) for one in loads)
    turned = any(one.couple for one in loads)
    pressed = any(one.pressure is not None for one in loads)
    return Table(
        name="inside_joints",
        title=_("Inside the joints"),
        records=True,
        columns=(
            Column(key="joint", heading=_("joint"), values=[one.joint for one in loads]),
            Column(key="part", heading=_("part"), values=[part_name(one) for one in loads]),
            Column(key="count", values=[one.count for one in loads], depth="data"),
            Column(key="force_max", heading=_("force"), values=[one.high for one in loads], dimension="force"),
            Column(
                key="force_min",
                heading=_("least"),
                values=[one.low for one in loads],
                dimension="force",
                depth="brief" if several else "data",
            ),
            Column(
                key="couple_max",
                heading=_("couple"),
                values=[one.couple for one in loads],
                dimension="torque",
                depth="brief" if turned else "data",
            ),
            Column(
                key="contact_pressure",
                heading=_("contact pressure"),
                values=[one.pressure for one in loads],
                dimension="stress",
                depth="brief" if pressed else "data",
            ),
            Column(
                key="pressure_velocity",
                heading=_("pressure × speed"),
                values=[one.heating for one in loads],
                dimension="pressure_velocity",
                depth="brief" if any(one.heating is not None for one in loads) else "data",
            ),
        ),
        note=_(
            "Largest over a turn of any of the parts alike, and the least force of any; rigid, without clearance. "
            "Pressure by Hertz where parts touch in a point, else force over the area of a bearing."
        ),
    )


def part_name(one: InnerLoad) -> str:
    """Return what parts alike inside of a joint are called."""
    count = f"1–{one.count}" if one.count > 1 else "1"
    return _(one.name).format(number=one.joint, count=count)


def support_table(drive: Drive, found: Forces) -> Table:
    """Return radial force, axial force and couple of every support, of both ways of sliding."""
    ways = senses(found)
    across = [turn(one.angle, one.radial) for one in ways]
    along = [turn(one.angle, along_axis(one)) for one in ways]
    whole = np.max([turn(one.angle, size(one.reaction)).high for one in ways], axis=0)
    high, low = np.max([one.high for one in across], axis=0), np.min([one.low for one in across], axis=0)
    low = np.where(low <= ROUNDING * high, 0.0, low)
    mean = tidy(np.max([one.mean for one in across], axis=0))
    push, pull = np.min([one.low for one in along], axis=0), np.max([one.high for one in along], axis=0)
    couple = tidy(np.max([np.max(size(one.support_couple), axis=-1) for one in ways], axis=0))
    place = foremost(np.stack([one.high for one in across], axis=-1))
    when = [from_start(across[way].high_angle[k]) if high[k] > 0.0 else None for k, way in enumerate(place)]
    pushed = bool(np.any(push) or np.any(pull))

    def where(hold: str, values: Any) -> list[Any]:
        return [one if getattr(support, hold) else None for one, support in zip(values, drive.supports, strict=True)]

    tilted = any(one.tilt for one in drive.supports)
    text = _("Forces on the shaft; axial ones are positive along the power flow.")
    return Table(
        name="supports",
        records=True,
        columns=(
            *support_heads(drive),
            Column(key="radial_min", heading=_("radial, least"), values=where("radial", low), dimension="force"),
            Column(key="radial_max", heading=_("largest"), values=where("radial", high), dimension="force"),
            Column(key="radial_max_at", heading=_("at"), values=where("radial", when), dimension="angle", decimals=1),
            Column(key="radial_mean", heading=_("mean"), values=where("radial", mean), dimension="force", depth="full"),
            Column(key="axial_min", heading=_("axial, from"), values=where("axial", push), dimension="force"),
            Column(key="axial_max", heading=_("to"), values=where("axial", pull), dimension="force"),
            Column(
                key="force_max",
                heading=_("in all"),
                values=whole,
                dimension="force",
                depth="full" if pushed else "data",
            ),
            *(
                (Column(key="couple_max", heading=_("couple"), values=where("tilt", couple), dimension="torque"),)
                if tilted
                else ()
            ),
        ),
        note=text,
    )


def trace(found: Forces, name: str = "forces") -> Table:
    """Return everything at every position."""
    return Table(name=name, columns=tuple(_trace(found)), depth="data")


def _trace(found: Forces) -> Iterator[Column]:
    yield curve("angle", found.angle, "angle")
    for k, torque in enumerate(found.shaft_torque):
        yield curve(f"shaft_{k + 1}_torque", torque, "torque")
        yield curve(f"shaft_{k + 1}_secondary_couple", found.bending_couple[k], "torque")
        yield from vector(f"shaft_{k + 1}_secondary_couple", found.secondary_couple[k], "torque")
    for i, couple in enumerate(found.joint_torque):
        yield curve(f"joint_{i + 1}_torque", couple, "torque")
        for j, side in enumerate(("driving_a", "driving_b", "driven_a", "driven_b")):
            yield curve(f"joint_{i + 1}_{side}_journal", found.journals.size[i, :, j], "force")
        yield curve(f"joint_{i + 1}_driving_thrust", found.journals.thrust[i, :, 0], "force")
        yield curve(f"joint_{i + 1}_driven_thrust", found.journals.thrust[i, :, 1], "force")
        if "duty.speed" not in found.assumed:
            yield curve(f"joint_{i + 1}_power_loss", found.loss[i], "power")
        if found.joint_force is not None:
            yield from vector(f"joint_{i + 1}_force", found.joint_force[i], "force")
    for k, thrust in enumerate(found.spline_thrust):
        yield curve(f"spline_{k + 1}_thrust", thrust, "force")
    if found.reaction is not None and found.support_couple is not None:
        for k, force in enumerate(found.reaction):
            yield curve(f"support_{k + 1}_radial", found.radial[k], "force")
            yield curve(f"support_{k + 1}_axial", found.axial[k], "force")
            yield from vector(f"support_{k + 1}", force, "force")
            if found.support_couple[k].any():
                yield from vector(f"support_{k + 1}_couple", found.support_couple[k], "torque")


# What answers about forces share: extremes over a turn without rounding, parts that are loaded alike, curves.

ROUNDING = 1e-9
"""Share of the largest value below which a value is nothing but rounding, and which a balance may leave."""


def senses(found: Forces) -> tuple[Forces, ...]:
    """Return the forces, and those with the splines sliding back where that differs."""
    return (found,) if found.reverse is None else (found, found.reverse)


def tidy(values: Any) -> Array:
    """Return values with what is nothing but rounding set to zero.

    >>> tidy([1.0, 1e-15]).tolist()
    [1.0, 0.0]
    """
    table = np.asarray(values, dtype=float)
    largest = np.max(np.abs(table), initial=0.0, where=np.isfinite(table))
    return np.where(np.abs(table) <= ROUNDING * largest, 0.0, table)


def turn(angle: Array, values: Any) -> Turn:
    """Return least and largest of quantities (..., p) over a turn, rounding left out."""
    return over_turn(angle, tidy(values))


def size(vectors: Any) -> Array:
    """Return the sizes of vectors (..., 3)."""
    return np.asarray(frames.norm(np.asarray(vectors, dtype=float)))


def from_start(angle: float) -> float:
    """Return an input angle [rad] within a turn to 1e-9 degrees, as exactly as extremes are found; a whole turn is 0.

    >>> from_start(2.0 * math.pi - 1e-13), round(from_start(0.5), 9)
    (0.0, 0.5)
    """
    return math.radians(round(math.degrees(float(angle)), 9) % 360.0)


def along_axis(found: Forces) -> Array:
    """Return the axial reactions; beside the radial ones, what is nothing but rounding is zero."""
    axial = np.asarray(found.axial)
    return np.where(np.abs(axial) <= ROUNDING * np.max(size(found.reaction), initial=0.0), 0.0, axial)


def together(names: Sequence[str], places: Sequence[int]) -> Joined:
    """Return the parts at some places, counted from 0, as a sentence names them.

    >>> from cardan.answers.reader import USUAL
    >>> together(["left", "right", ""], [1, 2]).told(USUAL)
    '2 (right) and 3'
    """
    return Joined([numbered(k + 1, names[k]) for k in places], last=_(" and "))


def span(low: float, high: float, dimension: str, digits: int = 4) -> dict[str, Any]:
    """Return the places ``{low:bare}`` and ``{high}`` of a sentence."""
    return {"low": Quantity(low, dimension, digits), "high": Quantity(high, dimension, digits)}


def constant(low: float, high: float) -> bool:
    """Tell whether a quantity is the same over a turn but for rounding."""
    return high - low <= TIE * max(abs(low), abs(high))


def called(shaft: Shaft, shafts: int) -> str:
    """Return the name of a shaft; input and output where it has none."""
    ends = {1: _("input"), shafts: _("output")}
    return shaft.name or ends.get(shaft.number, "")


def support_names(drive: Drive) -> list[str]:
    """Return the names of the supports."""
    return [one.name for one in drive.supports]


def curve(key: str, values: Any, dimension: str = "", unit: str = "") -> Column:
    """Return a column for programs."""
    return Column(key=key, values=values, dimension=dimension, unit=unit)


def vector(key: str, values: Any, dimension: str, unit: str = "") -> tuple[Column, ...]:
    """Return the columns of the parts of a vector (p, 3)."""
    table = np.asarray(values)
    return tuple(curve(f"{key}_{way}", table[:, k], dimension, unit) for k, way in enumerate("xyz"))


def largest_left(*parts: Array | None) -> float:
    """Return the largest of what balances leave."""
    return max(float(np.max(np.asarray(part))) for part in parts if part is not None)
