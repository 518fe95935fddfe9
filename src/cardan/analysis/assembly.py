"""Do the parts of a drive that is held too much strain each other?"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.drive.accuracy import Error
from cardan.drive.chain import chain
from cardan.drive.drive import Drive
from cardan.drive.geometry import Geometry, geometry
from cardan.drive.material import Material
from cardan.drive.parts import known_lengths
from cardan.drive.shaft import Shaft
from cardan.drive.solids import arms
from cardan.drive.support import Support
from cardan.drive.validity import wrong_count
from cardan.errors import Problem, check, refuse
from cardan.maths import frames
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.peaks import peaks
from cardan.texts import _

from .held import HOLDS, Actions, Hold, Layout, actions, shaft_flexibility
from .misfit import Crosses, Misfit, conditions, crosses, joint_gap, misfit
from .motion import positions
from .redundancy import Redundancy, redundancy

STIFFNESS: dict[Hold, str] = {"radial": "stiffness", "axial": "axial_stiffness", "tilt": "tilt_stiffness"}
"""Key of a support that says how stiff it holds."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Peak:
    """The largest value over a turn.

    Attributes
    ----------
    value : float
        How much, in SI.
    angle : float [rad]
        Input angle φ_1 from the start position where it occurs.
    """

    value: float
    angle: float


@dataclass(frozen=True, eq=False, kw_only=True)
class AssemblyForces:
    """Forces that a drive without load carries because its parts do not fit.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angle φ_1 from the start position.
    joint_force : array (n, p, 3) [N]
        Force in the centre of joint i on shaft i+1; on shaft i the opposite.
    reaction : array (k, p, 3) [N]
        Force of each support on its shaft.
    couple : array (k, p, 3) [N·m]
        Couple of each support on its shaft; zero where it does not hold the slope.
    axis : array (k, 3)
        Direction of the shaft at each support.
    gap : array (n, p, 3) [m]
        How far the end of shaft i lies from that of shaft i+1 in each joint, by the errors of the joint alone.
    energy : array (p,) [J]
        Stored in what gives way.
    torque : array (p,) [N·m]
        Torque at the input, beside all others, that turning against the stored energy needs; without friction.
    joint_peak, radial_peak, axial_peak, couple_peak : tuple of Peak
        Largest force in each joint, largest radial and axial force and couple of each support.
    energy_peak, torque_peak : Peak
        Largest stored energy and largest torque to either side.
    degree : int
        Degree of statical indeterminacy; at 0 no misfit causes any force.
    strained, spare : tuple of str
        Keys of what misfit can load, and of what could be let go, all at once, to make the drive determinate.
    rigid : tuple of int
        Numbers of the shafts taken as rigid, as their outer diameter is not given.
    residual : float
        Largest sum of forces or moments on a shaft, or on the whole drive, as a share of the largest force.
    """

    angle: Array
    joint_force: Array
    reaction: Array
    couple: Array
    axis: Array
    gap: Array
    energy: Array
    torque: Array
    joint_peak: tuple[Peak, ...]
    radial_peak: tuple[Peak, ...]
    axial_peak: tuple[Peak, ...]
    couple_peak: tuple[Peak, ...]
    energy_peak: Peak
    torque_peak: Peak
    degree: int
    strained: tuple[str, ...]
    spare: tuple[str, ...]
    rigid: tuple[int, ...]
    residual: float

    @property
    def axial(self) -> Array:
        """Axial part of the reactions, positive along the power flow, array (k, p) [N]."""
        return frames.dot(self.reaction, self.axis[:, None, :])

    @property
    def radial(self) -> Array:
        """Size of the radial part of the reactions, array (k, p) [N]."""
        return frames.norm(self.reaction - self.axial[..., None] * self.axis[:, None, :])


def assembly(
    drive: Drive, errors: Sequence[Error | None] | None = None, *, angle: ArrayLike | None = None
) -> AssemblyForces:
    """Return the forces that misaligned housings and errors of the joints put on a drive without load.

    Parameters
    ----------
    drive : Drive
        The drive with its supports: what they hold, how stiff, and how far their housings are off.
    errors : sequence of Error, optional
        Errors of each joint; those of the drive's joints by default.
    angle : array (p,) [rad], optional
        Input angle φ_1 from the start position; one turn in steps of a degree by default. Peaks are those of the turn
        or of the range given.

    Returns
    -------
    AssemblyForces
        joint_force : array (n, p, 3), reaction : array (k, p, 3).

    Raises
    ------
    InputError
        No supports, a shaft that is not held, a length that is not given, or a drive held too much whose supports do
        not say how stiff they are.

    Notes
    -----
    Least complementary energy (Book p. 190 calls it a spatial frame): of all forces that balance every shaft, those
    with the least ½ X·C X - d·X. C holds the compliances of the supports and, where their bodies are given, of the
    shafts in bending and tension; d the offsets of the housings and the gaps in the joints. Crosses and yokes are
    rigid. Only the errors of length of a joint cause forces; those of angles are free to turn.

    Examples
    --------
    Three bearings in a row, each as stiff as 10 kN/mm, the middle one 0.1 mm too low; the outer two share its force:

    >>> from dataclasses import replace
    >>> from cardan.drive.support import Support
    >>> far = Support(shaft=1, position=-0.4, axial=True, stiffness=1e7)
    >>> middle = Support(shaft=1, position=-0.2, stiffness=1e7, offset=(0.0, 0.0, -1e-4))
    >>> near = Support(shaft=1, position=0.0, stiffness=1e7)
    >>> single = Drive.from_angles([0.2])
    >>> found = assembly(replace(single, supports=(far, middle, near, Support(shaft=2, position=0.3))))
    >>> found.degree, found.spare
    (2, ('supports[1].radial',))
    >>> (found.reaction[:3, 0, 2]).round(3)
    array([ 333.333, -666.667,  333.333])
    """
    question = _question(drive, errors)
    phi = positions(angle, np)
    answer, gap = question.answer(phi)
    layout = question.layout
    reaction, couple = question.reactions(answer)
    joint_force = question.joint_forces(answer)
    highest, place = _peaks(question, phi)
    n, k = layout.joints, len(layout.bearings)
    found = [Peak(value=float(value), angle=float(at)) for value, at in zip(highest, place, strict=True)]
    return AssemblyForces(
        angle=phi,
        joint_force=joint_force,
        reaction=reaction,
        couple=couple,
        axis=question.bearing_axes,
        gap=np.moveaxis(gap, 0, 1),
        energy=answer.energy,
        torque=answer.torque,
        joint_peak=tuple(found[:n]),
        radial_peak=tuple(found[n : n + k]),
        axial_peak=tuple(found[n + k : n + 2 * k]),
        couple_peak=tuple(found[n + 2 * k : n + 3 * k]),
        energy_peak=found[-2],
        torque_peak=found[-1],
        degree=question.redundancy.degree,
        strained=_keys(question.redundancy.strained),
        spare=_keys(question.redundancy.spare),
        rigid=question.rigid,
        residual=question.residual(joint_force, reaction, couple),
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class _Question:
    """A drive as the arrays its assembly forces follow from, to be asked for any angles."""

    drive: Drive
    place: Geometry
    layout: Layout
    acting: Actions
    position: Array
    error: Array
    compliance: Array
    housing: Array
    redundancy: Redundancy
    strained: bool
    rigid: tuple[int, ...]

    @property
    def bearing_axes(self) -> Array:
        """Direction of the shaft at each support, array (k, 3)."""
        return self.place.axis[[shaft for shaft, _holds in self.layout.bearings]]

    def answer(self, angle: Array) -> tuple[Misfit, Array]:
        """Return forces and gaps at the angles (p,)."""
        stand = _stand(self.drive, self.place, angle)
        gap = joint_gap(self.place.axis, self.place.normal, stand, self.error)
        if not self.strained:
            none = np.zeros(angle.shape)
            return Misfit(unknowns=np.zeros((angle.size, self.housing.size)), energy=none, torque=none), gap[0]
        return misfit(self.acting, self.layout, stand, self.compliance, gap, self.housing), gap[0]

    def joint_forces(self, answer: Misfit) -> Array:
        """Return the joint forces, array (n, p, 3)."""
        forces = answer.unknowns[:, : 3 * self.layout.joints]
        return np.moveaxis(forces.reshape(len(forces), -1, 3), 0, 1)

    def reactions(self, answer: Misfit) -> tuple[Array, Array]:
        """Return forces and couples of the supports on their shafts, arrays (k, p, 3)."""
        count = len(self.layout.bearings)
        force = np.zeros((count, len(answer.unknowns), 3))
        couple = np.zeros_like(force)
        for k, (shaft, holds) in enumerate(self.layout.bearings):
            for hold in holds:
                columns = self.layout.columns(k, hold)
                table = self.acting.couple if hold == "tilt" else self.acting.force
                amount = answer.unknowns[:, columns] @ table[shaft, columns]
                (couple if hold == "tilt" else force)[k] += amount
        return force, couple

    def residual(self, joint_force: Array, reaction: Array, couple: Array) -> float:
        """Return what is left of the balance, by plain sums about the first point of the drive."""
        points, shafts = self.place.points, self.layout.joints + 1
        largest = max(float(np.max(np.abs(joint_force))), float(np.max(np.abs(reaction))))
        if largest == 0.0:
            return 0.0
        arm = points - points[0]
        force = np.zeros((shafts, joint_force.shape[1], 3))
        moment = np.zeros_like(force)
        for i, pull in enumerate(joint_force):
            turn = np.cross(arm[i + 1], pull)
            for s, sign in ((i, -1.0), (i + 1, 1.0)):
                force[s] += sign * pull
                moment[s] += sign * turn
        for k, (s, _holds) in enumerate(self.layout.bearings):
            force[s] += reaction[k]
            at = arm[s] + self.position[k] * self.place.axis[s]
            moment[s] += couple[k] + np.cross(at, reaction[k])
        reach = float(np.max(np.abs(arm)))
        rests = [force, moment / reach, force.sum(axis=0), moment.sum(axis=0) / reach]
        return max(float(np.max(np.abs(rest))) for rest in rests) / largest


def _keys(holds: tuple[tuple[int, Hold], ...]) -> tuple[str, ...]:
    return tuple(f"supports[{k}].{hold}" for k, hold in holds)


def _stand(drive: Drive, place: Geometry, angle: Array) -> Crosses:
    stand = arms(place, chain(drive), angle)
    return crosses(place.axis, np.moveaxis(stand.driving, 0, 1), np.moveaxis(stand.driven, 0, 1))


def _question(drive: Drive, errors: Sequence[Error | None] | None) -> _Question:
    if not drive.supports:
        raise refuse("supports", _("missing; assembly forces come from how the shafts are held"))
    given = [joint.error for joint in drive.joints] if errors is None else list(errors)
    check(wrong_count("errors", given, len(drive.joints)))
    known = known_lengths(drive)
    check(
        Problem(f"shafts[{number - 1}].length", _("missing; the balance of moments needs it"))
        for number in range(2, len(drive.joints) + 1)
        if number not in known
    )
    place = geometry(drive)
    layout = Layout(
        joints=len(drive.joints),
        bearings=tuple((s.shaft - 1, tuple(h for h in HOLDS if getattr(s, h))) for s in drive.supports),
        slides=tuple(_slides(joint.cross.slides if joint.cross else False) for joint in drive.joints),
        splines=tuple(shaft.number - 1 for shaft in drive.shafts if shaft.spline),
    )
    position = np.asarray([s.position + (place.length[0] if s.shaft == 1 else 0.0) for s in drive.supports])
    cuts = [_cut(shaft, float(place.length[shaft.number - 1])) for shaft in drive.shafts if shaft.spline]
    acting = actions(place.axis, place.length, layout, position, np.asarray(cuts))
    error = np.asarray([[e.s1, e.a1, e.a2, e.a3, e.a4] if e else [0.0] * 5 for e in given])
    stand = _stand(drive, place, positions(None, np)[::8] if any(map(any, layout.slides)) else np.zeros(1))
    found = redundancy(conditions(acting, layout, stand), layout)
    off = bool(np.any(error)) or any(any(s.offset) for s in drive.supports)
    if off:
        check(_soft(drive.supports, found))
    bends, pulls = np.asarray([_body(shaft) for shaft in drive.shafts]).T
    return _Question(
        drive=drive,
        place=place,
        layout=layout,
        acting=acting,
        position=position,
        error=error,
        compliance=_bearing_compliance(drive.supports, layout) + shaft_flexibility(acting, bends, pulls),
        housing=_housing(drive.supports, layout, acting),
        redundancy=found,
        strained=off and found.degree > 0,
        rigid=tuple(shaft.number for shaft in drive.shafts if shaft.outer is None),
    )


def _slides(along: bool | str) -> tuple[bool, bool]:
    return along is True or along == "driving", along is True or along == "driven"


def _cut(shaft: Shaft, length: float) -> float:
    given = shaft.spline.position if shaft.spline else None
    return 0.5 * length if given is None else given


def _soft(supports: Sequence[Support], found: Redundancy) -> list[Problem]:
    """Return which stiffness is missing of what takes part in the forces."""
    text = _("missing; the drive is held by {degree} more than statics can tell, so forces follow from stiffness")
    return [
        Problem(f"supports[{k}].{STIFFNESS[hold]}", text.format(degree=found.degree))
        for k, hold in found.strained
        if getattr(supports[k], STIFFNESS[hold]) is None
    ]


def _bearing_compliance(supports: Sequence[Support], layout: Layout) -> Array:
    size = np.zeros(len(layout.unknowns))
    for k, (_shaft, holds) in enumerate(layout.bearings):
        for hold in holds:
            size[layout.columns(k, hold)] = 1.0 / (getattr(supports[k], STIFFNESS[hold]) or math.inf)
    return np.diag(size)


def _housing(supports: Sequence[Support], layout: Layout, acting: Actions) -> Array:
    """Return the offsets of the housings in the directions of the unknowns, array (u,) [m]."""
    off = np.zeros(len(layout.unknowns))
    for k, (shaft, holds) in enumerate(layout.bearings):
        for hold in holds:
            columns = layout.columns(k, hold)
            off[columns] = acting.force[shaft, columns] @ np.asarray(supports[k].offset)
    return off


def _body(shaft: Shaft) -> tuple[float, float]:
    """Return 1/EI and 1/EA of a shaft, zero where its body is not given."""
    if shaft.outer is None:
        return 0.0, 0.0
    inner = shaft.inner if shaft.inner is not None else shaft.outer - 2.0 * (shaft.wall or 0.5 * shaft.outer)
    youngs = (shaft.material or Material()).youngs
    area = 0.25 * math.pi * (shaft.outer**2 - inner**2)
    return 64.0 / (math.pi * youngs * (shaft.outer**4 - inner**4)), 1.0 / (youngs * area)


def _peaks(question: _Question, angle: Array) -> tuple[Array, Array]:
    """Return the largest of every curve over the angles and where: joints, radial, axial, couples, energy, torque."""

    def curves(phi: Array) -> Array:
        answer, _gap = question.answer(phi)
        force, couple = question.reactions(answer)
        along = frames.dot(force, question.bearing_axes[:, None, :])
        across = frames.norm(force - along[..., None] * question.bearing_axes[:, None, :])
        joints = frames.norm(question.joint_forces(answer))
        rows = (joints, across, np.abs(along), frames.norm(couple), answer.energy[None], np.abs(answer.torque)[None])
        return np.concatenate(rows)

    place, value = peaks(curves, angle, curves(angle))
    return value, place
