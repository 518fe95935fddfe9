"""Bearings, splines and joints that would hold a drive just enough: found by its graph, kept by rank and turning."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths
from cardan.drive.joints import Joint
from cardan.drive.joints.constant_velocity import ConstantVelocity
from cardan.drive.joints.tracta import Tracta
from cardan.drive.joints.tripod import Tripod
from cardan.drive.models.geometry import geometry
from cardan.drive.shaft import Shaft, Spline
from cardan.drive.support import Support
from cardan.errors import InputError
from cardan.maths.kernel import screws
from cardan.maths.ties import tidied
from cardan.mechanism.constraints import constraints
from cardan.mechanism.layouts import Layout, layouts, number_of_layouts
from cardan.mechanism.mechanism import Mechanism
from cardan.questions.forces.forces import forces
from cardan.questions.mobility.drive_mechanism import joint_freedoms, mechanism_of
from cardan.questions.mobility.finite_mobility import locks_at
from cardan.questions.mobility.mobility import left
from cardan.questions.motion.motion import motion

LOOKED_AT = 96
"""Layouts with the fewest parts whose constraints are ranked."""

TOLD = 8
"""Layouts that are turned all round, drawn and told, best first."""

GENERAL = (0.0, 0.61)
"""Input angles [rad] from the start at which constraints are ranked: no quarter of a turn lies between them."""

APART = 0.2
"""Distance of two bearings in line over the length of their shaft."""

ALIKE = 1.1
"""Forces count in steps of this: by a little more force nobody buys a bearing more."""

ROUNDING = 1e-9
"""Share of a step that is rounding."""

PLACES = 72
"""Input angles of a turn at which forces on bearings are looked at."""

OTHERS: dict[int, Joint] = {2: ConstantVelocity(), 3: Tripod(), 5: Tracta()}
"""Ways that a joint leaves free -> what may stand for it: holding its centre, sliding too, holding the torque alone."""

KEPT = ("name", "centre", "joint_angle", "plane_twist", "move_within")
"""Fields of a joint that say where it is."""


@dataclass(frozen=True, eq=False, kw_only=True)
class HeldDrive:
    """A layout on a drive."""

    layout: Layout
    drive: Drive  # with its bearings, splines and joints
    speed_fluctuation: float  # largest less smallest speed ratio of the output
    force: float | None  # largest force on a bearing [N]; None without torque and lengths


@dataclass(frozen=True, eq=False, kw_only=True)
class BearingLayouts:
    """The layouts of a drive."""

    freedoms: tuple[int, ...]  # ways that each joint of the drive leaves free
    own: bool  # whether the joints of the drive stay
    number: int  # held just enough by their graph
    unlike: int | None  # of these, how many are no mirror images of each other; None where not all were looked at
    ranked: int  # of these, how many were looked at, those with the fewest parts
    regular: int  # of these, how many are by the rank of their constraints too
    best: tuple[HeldDrive, ...]  # those that turn all round, best first, not more than `TOLD`
    locked: int = 0  # how many before them lock in a turn


def bearing_layouts(drive: Drive, *, other_joints: bool = False) -> BearingLayouts:
    """Return the layouts of bearings, splines and joints that hold a drive just enough.

    other_joints: whether joints may be of another kind than they are, see `OTHERS`.
    Those with the fewest parts are ranked, by evenness, forces and number of parts.
    """
    own = joint_freedoms(replace(drive, supports=()))
    ways = [sorted({one, *OTHERS}) if other_joints else [one] for one in own]
    looked, number = list(islice(layouts(ways), LOOKED_AT)), number_of_layouts(ways)
    made = [(one, with_layout(drive, one, own)) for one in looked]
    regular = [(one, held) for one, held in made if is_regular(held)]
    uneven: dict[tuple[Joint, ...], float] = {}
    told = []
    for one, held in regular:
        if held.joints not in uneven:
            ratio = np.asarray(motion(replace(drive, joints=held.joints, supports=())).ratio)
            uneven[held.joints] = tidied(float(np.ptp(ratio)))
        told.append(HeldDrive(layout=one, drive=held, speed_fluctuation=uneven[held.joints], force=_force(drive, held)))
    least = min((one.force for one in told if one.force), default=1.0)
    told.sort(key=lambda one: _rank(one, least))
    best: list[HeldDrive] = []
    locked = 0
    for candidate in told:
        if locks_at(mechanism_of(candidate.drive)) is None:
            best.append(candidate)
        else:
            locked += 1
        if len(best) == TOLD:
            break
    return BearingLayouts(
        freedoms=own,
        own=not other_joints,
        number=number,
        unlike=len({_unlike(one) for one in looked}) if len(looked) == number else None,
        ranked=len(looked),
        regular=len(regular),
        best=tuple(best),
        locked=locked,
    )


def _unlike(one: Layout) -> tuple[object, ...]:
    """Return what a layout and its mirror image have in common."""
    sides = [one] if one.mirrored is None else [one, one.mirrored]
    return min((side.joints, side.shafts) for side in sides)


def _rank(one: HeldDrive, least: float) -> tuple[float, float, int, float]:
    """Return by what layouts are ranked: evenness, force in steps, number of parts; forces nobody knows come last.

    least [N]: the smallest of their forces.
    """
    force = math.inf if one.force is None else max(one.force, least)
    steps = force if one.force is None else math.floor(math.log(force / least) / math.log(ALIKE) + ROUNDING)
    return float(f"{one.speed_fluctuation:.6g}"), steps, one.layout.parts, float(f"{force:.6g}")


def is_regular(drive: Drive) -> bool:
    """Tell whether a drive is held just enough, and moves in one way, that of its input, at general positions."""
    return all(_regular(mechanism_of(drive, angle)) for angle in GENERAL)


def _regular(mechanism: Mechanism) -> bool:
    system = constraints(mechanism)
    matrix = system.matrix()
    rows, columns = matrix.shape
    rank = screws.rank(matrix).value
    held = [mechanism.links.index(mechanism.input_link)]
    return rank == rows == columns - 1 and left(system, matrix, held) == 0


def with_layout(drive: Drive, layout: Layout, own: tuple[int, ...]) -> Drive:
    """Return a drive with the bearings, splines and joints of a layout.

    own: ways that its joints leave free; a joint that leaves others is replaced, see `OTHERS`.
    A bearing stands where one of the drive stands on its shaft, else in the middle of what it holds.
    """
    place, known = geometry(drive), known_lengths(drive)
    joints = tuple(
        joint if free == was else replace(OTHERS[free], **{name: getattr(joint, name) for name in KEPT})
        for joint, free, was in zip(drive.joints, layout.joints, own, strict=True)
    )
    shafts: list[Shaft] = []
    supports: list[Support] = []
    for k, (shaft, parts) in enumerate(zip(drive.shafts, layout.shafts, strict=True)):
        length = float(place.length[k])
        low, high = (-length, 0.0) if k == 0 else (0.0, length)
        spline = None
        ends = [(low, high)]
        if len(parts) == 2:
            spline = shaft.spline or Spline()
            cut = 0.5 * (low + high) if spline.position is None else spline.position
            spline, ends = replace(spline, position=cut), [(low, cut), (cut, high)]
        between = 0 < k < len(drive.joints)
        said = replace(shaft, length=length) if between and k + 1 not in known else shaft
        shafts.append(replace(said, spline=spline))
        stood = [one.position for one in drive.supports if one.shaft == k + 1 and one.radial]
        for bearing, (start, end) in zip(parts, ends, strict=True):
            inside = [one for one in stood if start < one < end]
            supports += _supports(bearing, k + 1, start, end, inside)
    limits = drive.limits if layout.splines else replace(drive.limits, spline_overlap=None)
    held = replace(drive, poses=(), movements=(), limits=limits)
    return replace(held, joints=joints, shafts=tuple(shafts), supports=tuple(supports))


def _supports(bearing: str, shaft: int, start: float, end: float, stood: list[float]) -> Iterator[Support]:
    """Yield the supports of a part of a shaft from start to end [m]; two in line for R and C."""
    middle = stood[0] if stood else 0.5 * (start + end)
    located = bearing in ("S", "R")
    if bearing in ("SG", "S"):
        yield Support(shaft=shaft, position=middle, axial=located)
    elif bearing:
        half = 0.5 * APART * (end - start)
        places = sorted(stood[:2]) if len(stood) > 1 else [0.5 * (start + end) - half, 0.5 * (start + end) + half]
        for k, one in enumerate(places):
            yield Support(shaft=shaft, position=one, axial=located and k == 0)


def _force(drive: Drive, made: Drive) -> float | None:
    """Return the largest force on a bearing [N]; None where torque or a length is not known, or a joint tells none."""
    if made.duty.torque is None or len(known_lengths(drive)) < len(drive.joints) - 1:
        return None
    try:
        reaction = forces(made, angle=np.arange(PLACES) * (2.0 * np.pi / PLACES)).reaction
    except InputError:
        return None
    return None if reaction is None else float(np.max(np.linalg.norm(reaction, axis=-1), initial=0.0))
