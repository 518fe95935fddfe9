"""The machine half of a drive: where its points lie, what its parts weigh and how they are held, as arrays."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

import numpy as np

from cardan.drive.accuracy import Error
from cardan.drive.body import body_length, pieces, softness, weight
from cardan.drive.drive import Drive
from cardan.drive.fields.parts import known_lengths, spline_place
from cardan.drive.joints import Joint
from cardan.drive.shaft import Shaft
from cardan.drive.support import Support
from cardan.drive.yokes import with_yokes
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _

from .geometry import Geometry, geometry, geometry_from_points
from .kinematics_model import Chain, chain, given_chain, turning

Hold: TypeAlias = Literal["radial", "axial", "tilt"]

HOLDS: tuple[Hold, ...] = ("radial", "axial", "tilt")

FIT = {"new": 0.5 * math.pi, "run_in": 4.0 / math.pi}
"""Reduced coefficient of friction of plain journals over that of their materials."""

SLIDING = {"out": -1.0, "in": 1.0, "both": -1.0}
"""Sense of the friction thrust on the part of a shaft behind its spline."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Train:
    """Points, masses and supports of one drive or of many that are held alike; leading axes (...) are the drives'.

    Whatever is None is not there: no inertia, no mass, no friction, no supports.
    """

    points: Array  # (..., n+2, 3) [m]: B_0 … B_{n+1}
    chain: Chain  # kinematic half of the drives
    # (..., n, 3): normals N_i of the joints' planes, for drives given by angles: points do not tell those of straight
    # joints. From the points when not given.
    normal: Array | None = None
    inertia: Array | None = None  # (..., n+1) [kg m²]: J_i of each shaft about its axis
    # (..., n+1) [kg m²]: moment of inertia of each shaft across, about its centre of mass
    transverse_inertia: Array | None = None
    mass: Array | None = None  # (..., n+1) [kg]: m_i
    centre_of_mass: Array | None = None  # (..., n+1) [m]: from the beginning of the shaft, B_{i-1}, along it
    resisting_torque: Array | None = None  # (..., n+1) [N·m]: L_i
    cross_inertia: Array | None = None  # (..., n, 3) [kg m²]: of each cross about u, v and u×v
    cross_mass: Array | None = None  # (..., n) [kg]
    span: Array | None = None  # (..., n) [m]: d of each cross; nan where it is not known
    drag: Array | None = None  # (..., n): κ = μ d_c/d of each joint
    gravity: Array | None = None  # (3,) [m/s²]: acceleration of free fall
    # tuple of (int, tuple of Hold): shaft of each support, counted from 0, and what it holds
    bearings: tuple[tuple[int, tuple[Hold, ...]], ...] = ()
    # (..., k) [m]: places of the supports from the beginning of their shafts; they may lie beyond the ends
    position: Array | None = None
    # per joint, whether no force acts along each of three directions: of a cross its driving and driven journals and
    # its normal, of any other joint those in which it is free, `Joint.freed`
    slides: tuple[tuple[bool, ...], ...] = ()
    kinds: tuple[Joint, ...] = ()  # the joints; all of them crosses when empty
    crossed: tuple[bool, ...] = ()  # which joints are crosses of Hooke joints; all of them when empty
    splines: tuple[int, ...] = ()  # shafts with a spline, counted from 0
    cut: Array | None = None  # (..., number of splines) [m]: places of the splines from the beginning of their shafts
    grip: Array | None = None  # (..., number of splines) [1/m]: thrust over torque, 2 μ/d
    # (..., number of splines, 3) [kg, m, kg m²]: of the part of each shaft behind its spline: mass, place of its centre
    # of mass as drawn, inertia about the axis; a splined shaft is one body when not given
    behind: Array | None = None
    # (..., number of splines): +1 where friction pushes the parts apart, as when the shaft grows shorter, -1 where it
    # pulls them together
    sliding: Array | None = None
    # (..., k, 3) [N/m, N/m, N·m/rad]: of each support: radial, axial, against tilting; nan where it is not given
    stiffness: Array | None = None
    offset: Array | None = None  # (..., k, 3) [m]: how far the housing of each support is off
    # (..., n+1, s) [m]: where each stretch of the shafts begins, from the beginning of the shaft; the first reaches
    # back beyond it
    stretch_start: Array | None = None
    bending: Array | None = None  # (..., n+1, s) [1/(N m²)]: 1/EI of each stretch; zero where it counts as rigid
    stretching: Array | None = None  # (..., n+1, s) [1/N]: 1/EA of each stretch; zero where it counts as rigid
    error: Array | None = None  # (..., n, 5) [m]: errors of length of each joint: s_1, a_1, a_2, a_3, a_4
    assumed: tuple[str, ...] = ()  # paths of what the drive does not say and the answers assume

    @property
    def joints(self) -> int:
        """Number of joints n."""
        return int(self.points.shape[-2]) - 2

    @property
    def rubs(self) -> bool:
        """Whether friction in any joint counts."""
        return self.drag is not None or any(kind.rubs for kind in self.kinds)


def train_of_points(
    points: Array, *, yoke_angle: Array | None = None, start_phase: Array | float = 0.0, **parts: object
) -> Train:
    """Return the train of drives through points of their axes.

    points (..., n+2, 3) [m]: a point of the input axis, the joint centres, a point of the output axis.
    yoke_angle (..., n-1) [rad]: γ of shafts 2 to n; zero when not given.
    start_phase (...) [rad]: ψ_1; **parts: any other attribute of `Train`.
    """
    place = geometry_from_points(points)
    xp = place.joint_angle.__array_namespace__()
    gamma = xp.zeros_like(place.plane_twist) if yoke_angle is None else yoke_angle
    whole = Chain(
        joint_angle=place.joint_angle,
        plane_twist=place.plane_twist,
        yoke_angle=xp.broadcast_to(xp.asarray(gamma, dtype=xp.float64), place.plane_twist.shape),
        start_phase=xp.broadcast_to(xp.asarray(start_phase, dtype=xp.float64), place.joint_angle.shape[:-1]),
    )
    return Train(points=points, chain=whole, **parts)  # type: ignore[arg-type]


def place_of(whole: Train) -> Geometry:
    """Return where the shafts of a train lie, with the planes from which its angles count.

    whole (...): one drive or many.
    """
    found = geometry_from_points(whole.points)
    return found if whole.normal is None else replace(found, normal=whole.normal)


def train(drive: Drive, *, kinds: bool = False) -> Train:
    """Return the machine half of a drive.

    kinds: take joints of other kinds too, as the Hooke joints that turn alike or nearly so; a drive that has any is
    refused else.
    """
    drive = with_yokes(drive)
    place = geometry(drive)
    known = known_lengths(drive)
    if drive.supports:
        check(length_problems(drive))
    length = [float(one) for one in place.length]
    assumed = [*place.assumed]
    bodies = [weight(shaft, body_length(shaft, known.get(shaft.number))) for shaft in drive.shafts]
    for shaft, (_mass, inertia, _across, _centre) in zip(drive.shafts, bodies, strict=True):
        if inertia is None:
            assumed.append(f"shafts[{shaft.number - 1}].inertia")
    mass, inertia, across = (_numbers([body[k] for body in bodies]) for k in range(3))
    offset = [length[0], *[0.0] * len(drive.joints)]
    centre = [0.0 if body[3] is None else body[3] + start for body, start in zip(bodies, offset, strict=True)]
    splined = [shaft for shaft in drive.shafts if shaft.spline is not None]
    cuts = [spline_place(drive, shaft.number, length[shaft.number - 1]) + offset[shaft.number - 1] for shaft in splined]
    behind = [_behind(shaft, length[shaft.number - 1], cut) for shaft, cut in zip(splined, cuts, strict=True)]
    for shaft, (heavy, far, _own) in zip(splined, behind, strict=True):
        # Both parts are moved by themselves, so what they add to the inertia across by their distance does not count.
        k = shaft.number - 1
        near = mass[k] - heavy
        if near > 0.0:
            across[k] -= mass[k] * heavy / near * (far - centre[k]) ** 2
    crosses = [joint.cross for joint in drive.joints]
    cross_inertia = np.asarray([cross.inertia if cross else (0.0, 0.0, 0.0) for cross in crosses])
    cross_mass = np.asarray([cross.mass if cross else 0.0 for cross in crosses])
    drag = np.asarray([_drag(joint) for joint in drive.joints])
    heavy = bool(np.any(mass)) or bool(np.any(cross_mass))
    return Train(
        points=place.points,
        chain=turning(given_chain(drive), drive.joints, near=True) if kinds else chain(drive),
        normal=place.normal,
        inertia=_unless_zero(inertia),
        transverse_inertia=_unless_zero(across),
        mass=mass if heavy else None,
        centre_of_mass=np.asarray(centre),
        resisting_torque=_unless_zero(np.asarray([shaft.resisting_torque for shaft in drive.shafts])),
        cross_inertia=_unless_zero(cross_inertia),
        cross_mass=_unless_zero(cross_mass),
        span=np.asarray([cross.span if cross and cross.span is not None else math.nan for cross in crosses]),
        drag=_unless_zero(drag),
        gravity=np.asarray(drive.settings.gravity),
        bearings=tuple((s.shaft - 1, tuple(hold for hold in HOLDS if getattr(s, hold))) for s in drive.supports),
        position=np.asarray([s.position + offset[s.shaft - 1] for s in drive.supports]),
        slides=tuple(_slides(joint) for joint in drive.joints),
        crossed=tuple(joint.single_cross for joint in drive.joints),
        kinds=tuple(drive.joints),
        splines=tuple(shaft.number - 1 for shaft in splined),
        cut=np.asarray(cuts),
        grip=np.asarray([_grip(shaft) for shaft in splined]),
        behind=np.asarray(behind) if splined else None,
        sliding=np.asarray([SLIDING[shaft.spline.sliding] for shaft in splined if shaft.spline is not None]),
        stiffness=np.asarray([_stiffness(support) for support in drive.supports]),
        offset=np.asarray([support.offset for support in drive.supports]),
        **_stretches(drive, known, length),
        error=lengths_off([joint.error for joint in drive.joints]),
        assumed=tuple(assumed),
    )


def lengths_off(errors: Sequence[Error | None]) -> Array:
    """Return the errors of length of each joint, array (n, 5) [m]."""
    given = [one or Error() for one in errors]
    return np.asarray([[one.s1, one.a1, one.a2, one.a3, one.a4] for one in given])


def _stiffness(support: Support) -> list[float]:
    given = support.stiffness, support.axial_stiffness, support.tilt_stiffness
    return [math.nan if one is None else one for one in given]


def _stretches(drive: Drive, known: dict[int, float], length: Sequence[float]) -> dict[str, Array]:
    """Return how the shafts give way, all with as many stretches as the one with most: its last stands for the rest."""
    soft = []
    for shaft in drive.shafts:
        body = body_length(shaft, known.get(shaft.number))
        one = softness(shaft, body)
        origin = length[0] - body if shaft.number == 1 and body is not None else 0.0
        soft.append((tuple(start + origin for start in one.start), one.bending, one.stretching))
    most = max(len(one[0]) for one in soft)
    names = ("stretch_start", "bending", "stretching")
    return {
        name: np.asarray([one[k] + one[k][-1:] * (most - len(one[k])) for one in soft]) for k, name in enumerate(names)
    }


def _numbers(values: list[float | None]) -> Array:
    return np.asarray([0.0 if value is None else value for value in values])


def _unless_zero(values: Array) -> Array | None:
    return values if bool(np.any(values)) else None


def _slides(joint: Joint) -> tuple[bool, bool, bool]:
    if not joint.single_cross:
        return joint.free_ways > 0, joint.free_ways > 1, joint.free_ways > 2
    along = joint.cross.slides if joint.cross else False
    return along is True or along == "driving", along is True or along == "driven", False


def _behind(shaft: Shaft, length: float, cut: float) -> tuple[float, float, float]:
    """Return mass [kg], centre of mass [m] and inertia [kg m²] of a shaft behind its spline, parts it carries included.

    cut [m]: place of the spline from the beginning of the shaft, from which the centre of mass counts too.
    A stretch that the spline parts counts on both sides. Where mass and centre of mass are given, or no body, each part
    is uniform, and both together have them.
    """
    whole, origin = weight(shaft, length), length if shaft.number == 1 else 0.0
    lumps = [one for one in shaft.masses if one.position + origin >= cut]
    body = [
        (one, max(one.start, cut), one.start + one.length)
        for one in pieces(shaft, length)
        if one.start + one.length > cut
    ]
    if body and shaft.centre_of_mass is None:
        total = sum(one.mass for one in pieces(shaft, length))
        scale = 1.0 if shaft.mass is None else shaft.mass / total
        parts = [(scale * one.mass * (end - start) / one.length, 0.5 * (start + end)) for one, start, end in body]
    else:
        bare = weight(replace(shaft, masses=()), length)
        mass, centre = bare.mass or 0.0, 0.5 * length if bare.centre is None else bare.centre + origin
        far = min(max((2.0 * centre - cut) / length, 0.0), 1.0)
        parts = [(far * mass, 0.5 * (cut + length) if 0.0 < far < 1.0 else centre)]
    parts += [(one.mass, one.position + origin) for one in lumps]
    mass = sum(part for part, _place in parts)
    centre = sum(part * place for part, place in parts) / mass if mass else length
    bare_inertia = (whole.inertia or 0.0) - sum(one.polar_inertia for one in shaft.masses)
    weighing = (whole.mass or 0.0) - sum(one.mass for one in shaft.masses)
    share = (mass - sum(one.mass for one in lumps)) / weighing if weighing else 0.5
    return mass, centre, share * bare_inertia + sum(one.polar_inertia for one in lumps)


def _grip(shaft: Shaft) -> float:
    spline = shaft.spline
    if spline is None or spline.friction is None or spline.pitch_diameter is None:
        return 0.0
    return spline_grip(spline.friction, spline.pitch_diameter, spline.pressure_angle)


def spline_grip(friction: float, mean_diameter: float, pressure_angle: float = 0.0) -> float:
    """Return the friction thrust of a spline over its torque, 2 μ/(d cos of the pressure angle), Book (123) [1/m]."""
    return 2.0 * friction / (mean_diameter * math.cos(pressure_angle))


def _drag(joint: Joint) -> float:
    """Return κ of a joint, zero where its friction or its cross is not known."""
    cross = joint.cross
    reduced = joint.friction
    if reduced is None and joint.material_friction is not None:
        reduced = FIT[joint.fit] * joint.material_friction
    if reduced is None or cross is None or cross.span is None or cross.journal is None:
        return 0.0
    return reduced * cross.journal / cross.span


def length_problems(drive: Drive) -> Iterator[Problem]:
    """Yield shafts between two joints whose length is not given."""
    known = known_lengths(drive)
    for number in range(2, len(drive.joints) + 1):
        if number not in known:
            yield Problem(f"shafts[{number - 1}].length", _("missing; the balance of moments needs it"))


def mass_problems(drive: Drive) -> Iterator[Problem]:
    """Yield end shafts whose weight stands nowhere: their mass is given and its place is not."""
    known = known_lengths(drive)
    for shaft in drive.shafts:
        if shaft.mass and shaft.centre_of_mass is None and body_length(shaft, known.get(shaft.number)) is None:
            yield Problem(
                f"shafts[{shaft.number - 1}].centre_of_mass",
                _("missing; the shaft has a mass, and the balance of moments needs its place"),
            )
