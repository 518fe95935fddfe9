"""Do the parts of a drive that is held too much strain each other?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.accuracy import Error
from cardan.drive.drive import Drive
from cardan.drive.fields.validity import wrong_count
from cardan.drive.models.dynamics_model import Train, lengths_off, train
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.models.machine_held import machine_held, tables_proposed
from cardan.errors import check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import peaks
from cardan.maths.kernel import frames
from cardan.questions.motion.motion import positions
from cardan.texts import _

from .elastic import Redundancy, compliance, gaps, housing_gap, redundancy, refuse_soft
from .kinetostatics import standing
from .reactions import Frame, arms_of, forces_of, frame
from .support_statics import WIDTH, Hold, Misalignment, misalignment


@dataclass(frozen=True, kw_only=True, slots=True)
class Peak:
    """The largest value over a turn."""

    value: float  # how much, in SI
    angle: float  # [rad]: input angle φ_1 from the start position where it occurs


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
    support_shaft : tuple of int
        Number of the shaft of every support.
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
        Degree of statical indeterminacy; at 0 no misalignment causes any force.
    strained, spare : tuple of str
        Keys of what misalignment can load, and of what could be let go, all at once, to make the drive determinate; see
        `kept` for what stays too many where no more can go.
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
    support_shaft: tuple[int, ...]
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
    def kept(self) -> int:
        """Degree that stays when all of `spare` is let go; nought where nothing can bind then."""
        return self.degree - sum(width for hold, width in WIDTH.items() for key in self.spare if key.endswith(hold))

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

    See Also
    --------
    forces, repairs

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
    >>> from cardan import Drive, assembly
    >>> from cardan.parts import Support
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
    with tables_proposed(drive):
        question = _question(drive, errors)
    drive = machine_held(drive)
    phi = positions(angle, np)
    answer, gap, joint_force, reaction, couple = question.forces(phi)
    highest, place = _peaks(question, phi)
    n, k = len(drive.joints), len(drive.supports)
    found = [Peak(value=float(value), angle=float(at)) for value, at in zip(highest, place, strict=True)]
    return AssemblyForces(
        angle=phi,
        joint_force=joint_force,
        reaction=reaction,
        couple=couple,
        axis=question.bearing_axes,
        support_shaft=tuple(support.shaft for support in drive.supports),
        gap=gap,
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
        rigid=tuple(shaft.number for shaft in drive.shafts if not shaft.has_body),
        residual=question.residual(joint_force, reaction, couple),
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class _Question:
    """A drive as the arrays its assembly forces follow from, to be asked for any angles."""

    whole: Train
    place: Geometry
    redundancy: Redundancy
    strained: bool

    @property
    def bearing_axes(self) -> Array:
        """Direction of the shaft at each support, array (k, 3)."""
        return self.place.axis[[shaft for shaft, _holds in self.whole.bearings]]

    def answer(self, angle: Array) -> tuple[Misalignment, Array, Frame]:
        """Return forces and gaps at the angles (p,), and the frame they belong to."""
        stand = standing(self.whole.chain, self.place.axis, self.place.normal, angle, speed=1.0)
        held = frame(self.whole, stand, self.whole.points[None])
        arms = arms_of(self.whole, stand, rates=True)
        gap = gaps(self.whole, held, arms)
        if not self.strained:
            none = np.zeros(angle.shape)
            zero = np.zeros((angle.size, held.matrix.shape[-1]))
            return Misalignment(unknowns=zero, energy=none, torque=none), gap[0], held
        soft, housing = compliance(self.whole, held), housing_gap(self.whole, held)
        return misalignment(held.acting, held.layout, arms, soft, gap, housing), gap[0], held

    def forces(self, angle: Array) -> tuple[Misalignment, Array, Array, Array, Array]:
        """Return energy and torque, gaps, joint forces, reactions and couples, parts before positions."""
        answer, gap, held = self.answer(angle)
        tables = (gap, *forces_of(held, answer.unknowns))
        gap, joint, reaction, couple = (np.moveaxis(table, 0, 1) for table in tables)
        return answer, gap, joint, reaction, couple

    def residual(self, joint_force: Array, reaction: Array, couple: Array) -> float:
        """Return what is left of the balance, by plain sums about the first point of the drive."""
        points, shafts = self.place.points, self.whole.joints + 1
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
        for k, (s, _holds) in enumerate(self.whole.bearings):
            force[s] += reaction[k]
            at = arm[s] + np.asarray(self.whole.position)[k] * self.place.axis[s]
            moment[s] += couple[k] + np.cross(at, reaction[k])
        reach = float(np.max(np.abs(arm)))
        rests = [force, moment / reach, force.sum(axis=0), moment.sum(axis=0) / reach]
        return max(float(np.max(np.abs(rest))) for rest in rests) / largest


def _keys(holds: tuple[tuple[int, Hold], ...]) -> tuple[str, ...]:
    return tuple(f"supports[{k}].{hold}" for k, hold in holds)


def _question(drive: Drive, errors: Sequence[Error | None] | None) -> _Question:
    if not drive.supports:
        raise refuse("supports", _("missing; assembly forces come from how the shafts are held"))
    drive = machine_held(drive)
    given = [joint.error for joint in drive.joints] if errors is None else list(errors)
    check(wrong_count("errors", given, len(drive.joints)))
    whole = replace(train(drive, kinds=True), error=lengths_off(given))
    place = geometry(drive)
    slides = any(map(any, whole.slides))
    stand = standing(
        whole.chain, place.axis, place.normal, positions(None, np)[::8] if slides else np.zeros(1), speed=1.0
    )
    held = frame(whole, stand, whole.points[None])
    found = redundancy(held.matrix, held.layout)
    off = bool(np.any(whole.error)) or bool(np.any(whole.offset))
    if off:
        refuse_soft(whole, found)
    return _Question(whole=whole, place=place, redundancy=found, strained=off and found.degree > 0)


def _peaks(question: _Question, angle: Array) -> tuple[Array, Array]:
    """Return the largest of every curve over the angles and where: joints, radial, axial, couples, energy, torque."""

    def curves(phi: Array) -> Array:
        answer, _gap, joint_force, force, couple = question.forces(phi)
        along = frames.dot(force, question.bearing_axes[:, None, :])
        across = frames.norm(force - along[..., None] * question.bearing_axes[:, None, :])
        rows = (
            frames.norm(joint_force),
            across,
            np.abs(along),
            frames.norm(couple),
            answer.energy[None],
            np.abs(answer.torque)[None],
        )
        return np.concatenate(rows)

    place, value = peaks(curves, angle, curves(angle))
    return value, place
