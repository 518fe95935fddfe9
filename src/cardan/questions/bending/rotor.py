"""What of a shaft of a drive decides how it whirls: its lowest mode of bending as one mass on one spring."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from operator import itemgetter

import numpy as np

from cardan.drive.body import body_length, pieces, weight
from cardan.drive.conditions import used_speeds
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.parts import known_lengths
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import given_chain, turning
from cardan.drive.shaft import Shaft
from cardan.drive.yokes import with_yokes
from cardan.errors import InputError, Problem, check, refuse
from cardan.formulas.run_up import Progress
from cardan.formulas.unbalance_behind_joint import UnbalanceBehindJoint, unbalance_behind_joint
from cardan.later import later
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.ties import summed
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import motion
from cardan.texts import _

from .balance import balance
from .bending import CriticalSpeeds, bending_speeds
from .cracked_rotor import UNCRACKED, Crack, CrackedRotor, cracked_rotor
from .cracked_run import CrackedRun, cracked_run
from .cracked_shafts import CrackedShafts, WhirlingShaft, cracked_shafts
from .line_whirl import LineWhirl, turning_marks
from .whirl_line import crack_hinge, crack_place, cracked_piece

interpolate = later("scipy.interpolate")

DAMPING = 0.02
"""Damping ratio of bending where nothing says another; measured drives have 0.01 to 0.05."""

MODES = (3, 8)
"""Modes among which that of the shaft is looked for, then looked for again."""

SAMPLES = 200
"""Places of a stretch at which the shape is summed."""

FEWEST = 6
"""Places of a stretch that tell how it bends; where it has fewer, those of the nearest other stretch do."""


@dataclass(frozen=True, kw_only=True)
class Rotor:
    """A shaft in its lowest mode of bending: a mass on a spring where it bows most."""

    shaft: int
    mass: float  # [kg]: ∫ μφ² dx over the line, φ = 1 where the shaft bows most
    stiffness: float  # [N/m]: mass times the square of the real critical speed
    gravity: float  # [m/s²]: weight across the shaft that pushes the mode, over that mass
    unbalance: float  # [kg·m]: of the mode
    unbalance_angle: float  # [rad]: about the axis, from the driving yoke of the shaft
    crack: Crack  # its losses of stiffness; none for a sound shaft
    crack_angle: float  # [rad]: about the axis, from the driving yoke of the shaft
    damping_ratio: float  # of the mode
    rises: bool = False  # whether the weight of the line pushes it up where it bows most
    stretched_above: bool = False  # whether the weight stretches the upper side at its crack, as over a bearing
    assumed: tuple[str, ...] = ()  # key paths of what the drive does not say

    @property
    def critical(self) -> float:
        """Real critical speed of the sound shaft [rad/s]."""
        return math.sqrt(self.stiffness / self.mass)

    @property
    def sag(self) -> float:
        """How far the sound shaft hangs down where it bows most [m]."""
        return self.gravity / self.critical**2

    @property
    def unbalance_turned(self) -> float:
        """Angle of its unbalance from the way in which the weight pushes it [rad], as its driving yoke hangs down."""
        return self.unbalance_angle + math.pi * self.rises

    @property
    def crack_turned(self) -> float:
        """The same of its crack, which opens where the weight stretches it [rad]."""
        return self.crack_angle + math.pi * self.stretched_above

    @property
    def cracked(self) -> bool:
        """Whether it has a crack."""
        return max(self.crack.losses) > 0.0


def rotor(drive: Drive, shaft: int | None = None, *, damping_ratio: float = DAMPING) -> Rotor:
    """Return a shaft of a drive as a mass on a spring, in its lowest mode of bending.

    drive: with a body for each shaft between two joints.
    shaft: number of the shaft; the cracked one when not given, else the one with the largest unbalance, else the one
    whose critical speed is the lowest.
    damping_ratio: ζ of the mode.

    Rayleigh's quotients with the shape φ of `bending_speeds`: mass M = ∫ μφ² dx, stiffness M ω², push of the weight
    g⊥ ∫ μφ dx, unbalance Σ U_j φ(x_j) e^(iχ_j). For a uniform shaft between two joints M is half its mass and the push
    4/π of M g. Losses of a crack count as of this stiffness; by its `depth_ratio` it is a hinge of compliance c where
    the shape bends with the moment m, and takes c m²/K to 1 + c m²/K of the stiffness K. Where no unbalance is given,
    the allowed one counts, amid the shaft.
    """
    if not 0.0 <= damping_ratio < 1.0:
        text = _("{value:.6g} is not at least 0 and below 1")
        raise refuse("damping_ratio", text.format(value=damping_ratio), "out_of_range")
    found, chosen, mode = _mode(drive, shaft)
    shape = found.deflection[mode]
    begin, end = (float(one) for one in found.shaft_span[chosen.number - 1])
    inside = (found.place >= begin - 1e-9) & (found.place <= end + 1e-9)
    shape = shape / shape[inside][int(np.argmax(np.abs(shape[inside])))]
    mass, push = _summed(drive, found, shape)
    if mass == 0.0:
        text = _("missing; the mass of shaft {number} follows from the lengths of its body")
        raise refuse(f"shafts[{chosen.number - 1}].segments", text.format(number=chosen.number), "missing")
    axis = geometry(drive).axis[chosen.number - 1]
    pull = np.asarray(drive.settings.gravity, dtype=float)
    across = float(np.linalg.norm(pull - np.dot(pull, axis) * axis))
    unbalance, assumed = _unbalance(drive, chosen, found, shape, (begin, end))
    stiffness = mass * float(found.actual[mode]) ** 2
    crack, bent = _crack(chosen, found, mode, shape, stiffness)
    return Rotor(
        shaft=chosen.number,
        mass=mass,
        stiffness=stiffness,
        gravity=across * abs(push) / mass,
        unbalance=abs(unbalance),
        unbalance_angle=cmath.phase(unbalance),
        crack=crack,
        crack_angle=0.0 if chosen.crack is None else chosen.crack.angle,
        damping_ratio=damping_ratio,
        rises=push < 0.0,
        stretched_above=bent * push > 0.0,
        assumed=(*found.assumed, *assumed),
    )


def _mode(drive: Drive, shaft: int | None) -> tuple[CriticalSpeeds, Shaft, int]:
    """Return the modes, the shaft, and the lowest mode in which it bows."""
    for count in MODES:
        found = bending_speeds(drive, modes=count)
        chosen = _chosen(drive, found, shaft)
        for k, one in enumerate(found.part):
            if one.kind == "shaft" and one.number == chosen.number:
                return found, chosen, k
    text = _("shaft {number} does not bend in any of the lowest {count} modes")
    raise refuse("shaft", text.format(number=chosen.number, count=MODES[-1]), "out_of_range")


def _chosen(drive: Drive, found: CriticalSpeeds, number: int | None) -> Shaft:
    if number is not None:
        known = {one.number: one for one in drive.shafts}
        if number not in known:
            text = _("there is no shaft {number}; the drive has {count}")
            raise refuse("shaft", text.format(number=number, count=len(drive.shafts)), "out_of_range")
        if math.isnan(found.shaft_span[number - 1, 0]):
            raise refuse("shaft", _("shaft {number} has no body").format(number=number), "missing")
        return known[number]
    cracked = [one for one in drive.shafts if one.crack is not None]
    unbalanced = [one for one in drive.shafts if one.unbalance]
    if cracked:
        return cracked[0]
    if unbalanced:
        return max(unbalanced, key=lambda one: sum(part.amount for part in one.unbalance))
    lowest = next((one.number for one in found.part if one.kind == "shaft"), 2)
    return next(one for one in drive.shafts if one.number == lowest)


def _summed(drive: Drive, found: CriticalSpeeds, shape: Array) -> tuple[float, float]:
    """Return ∫ μφ² and ∫ μφ over all shafts of the line."""
    lengths = known_lengths(drive)
    mass = push = 0.0
    for one in with_yokes(drive).shafts:
        begin, end = found.shaft_span[one.number - 1]
        if math.isnan(begin):
            continue
        body = pieces(one, body_length(one, lengths.get(one.number)))
        whole = sum(piece.mass for piece in body)
        scale = one.mass / whole if one.mass is not None and whole else 1.0
        for piece in body:
            at = begin + piece.start + piece.length * (np.arange(SAMPLES) + 0.5) / SAMPLES
            phi = np.interp(at, found.place, shape)
            mass += scale * piece.mass * float(np.mean(phi**2))
            push += scale * piece.mass * float(np.mean(phi))
        origin = end if one.number == 1 else begin
        for lump in one.masses:
            phi = float(np.interp(origin + lump.position, found.place, shape))
            mass += lump.mass * phi**2
            push += lump.mass * phi
    return mass, push


def _unbalance(
    drive: Drive, shaft: Shaft, found: CriticalSpeeds, shape: Array, span: tuple[float, float]
) -> tuple[complex, tuple[str, ...]]:
    """Return the unbalance of the mode, and what was assumed for it."""
    if not shaft.unbalance:
        try:
            allowed = next((one.allowed for one in balance(drive).shafts if one.number == shaft.number), math.nan)
        except InputError:
            allowed = math.nan
        return complex(allowed if math.isfinite(allowed) else 0.0), (f"shafts[{shaft.number - 1}].unbalance",)
    origin = span[1] if shaft.number == 1 else span[0]
    parts = [
        one.amount * float(np.interp(origin + one.position, found.place, shape)) * cmath.exp(1j * one.angle)
        for one in shaft.unbalance
    ]
    return complex(summed(parts, scale=sum(one.amount for one in shaft.unbalance))), ()


def _crack(shaft: Shaft, found: CriticalSpeeds, mode: int, shape: Array, stiffness: float) -> tuple[Crack, float]:
    """Return what a crack takes of the stiffness of a mode, and how the shape bends there [1/m²].

    As given, or as a hinge by its depth in the bent shaft.
    """
    given = shaft.crack
    if given is None:
        return UNCRACKED, 0.0
    begin, end = (float(one) for one in found.shaft_span[shaft.number - 1])
    length = end - begin
    piece = cracked_piece(shaft, length)
    stiff = piece.material.youngs * piece.second_moment
    bent = _moment(shaft, found, shape, (begin, end), crack_place(shaft, length)) / stiff
    if given.losses:
        xi, eta = given.losses
        return Crack(loss_xi=xi, loss_eta=eta, breathing=given.breathing), bent
    moment = float(found.wear[mode]) ** 2 * stiff * bent
    softer = (one * moment**2 / stiffness for one in crack_hinge(shaft, length))
    xi, eta = (one / (1.0 + one) for one in softer)
    return Crack(loss_xi=xi, loss_eta=eta, breathing=given.breathing), bent


def _moment(shaft: Shaft, found: CriticalSpeeds, shape: Array, span: tuple[float, float], place: float) -> float:
    """Return E I φ'' at a place of a shaft [N·m per m], which goes on over shoulders and short grooves as φ'' does not.

    By the nearest of the stretches of one section that have places enough to tell how they bend.
    """
    begin, end = span
    x, reach = place + (end if shaft.number == 1 else begin), 1e-9
    told: list[tuple[float, float, Array]] = []
    for one in pieces(shaft, end - begin):
        low, high = begin + one.start, begin + one.start + one.length
        inside = np.flatnonzero((found.place >= low - reach) & (found.place <= high + reach))
        if len(inside) >= FEWEST:
            told.append((max(low - x, x - high, 0.0), one.material.youngs * one.second_moment, inside))
    if not told:
        piece = cracked_piece(shaft, end - begin)
        whole = np.flatnonzero((found.place >= begin - reach) & (found.place <= end + reach))
        told.append((0.0, piece.material.youngs * piece.second_moment, whole))
    _far, stiff, inside = min(told, key=itemgetter(0, 1))
    return stiff * float(interpolate().CubicSpline(found.place[inside], shape[inside])(x, 2))


# How does a shaft of a drive whirl with its unbalance and a crack: steadily, while running up, joined to the next?

SPEEDS = 181
"""Speeds of a response where none are given; those about a half and a third of the critical speed come on top."""

SLOWEST, FASTEST = 0.15, 1.25
"""Ends of the speeds over the critical speed, where the drive uses none beyond."""


@dataclass(frozen=True, eq=False, kw_only=True)
class RotorResponse:
    """Steady whirling of a shaft over the speed.

    Attributes
    ----------
    rotor : Rotor
        The shaft as a mass on a spring.
    steady : CrackedRotor
        Orders, stability and orbits over the speeds, X down and Y 90° ahead in the sense of rotation.
    used : (float, float) or None [rad/s]
        Lowest and highest speed of running; None where the drive says none.
    behind : UnbalanceBehindJoint or None
        Orders that the uneven turning adds to the force of the unbalance; None for the input shaft.
    line : LineWhirl or None
        The shaft among all others on their supports, where that is asked too and can be told.
    """

    rotor: Rotor
    steady: CrackedRotor
    used: tuple[float, float] | None
    behind: UnbalanceBehindJoint | None
    line: LineWhirl | None = None

    def peak(self, order: int) -> tuple[float, float]:
        """Return speed [rad/s] and amplitude [m] where an order is largest, within the speeds of running.

        Parameters
        ----------
        order : int
            Negative ones run backward.
        """
        size = np.array(self.steady.order_amplitude(order))
        if self.used is not None:
            low, high = self.used
            inside = (self.steady.speed >= low * (1 - 1e-9)) & (self.steady.speed <= high * (1 + 1e-9))
            size = np.where(inside, size, np.nan) if np.any(inside) else size
        if np.all(np.isnan(size)):
            return math.nan, math.nan
        k = int(np.nanargmax(size))
        return float(self.steady.speed[k]), float(size[k])

    @property
    def unstable(self) -> tuple[tuple[float, float], ...]:
        """Ranges of speed [rad/s] in which whirling grows by itself."""
        bad = np.concatenate([[False], ~self.steady.stable, [False]]).astype(int)
        change = np.diff(bad)
        pairs = zip(np.flatnonzero(change == 1), np.flatnonzero(change == -1), strict=True)
        return tuple((float(self.steady.speed[a]), float(self.steady.speed[b - 1])) for a, b in pairs)


def rotor_response(
    drive: Drive,
    duty: Duty | None = None,
    *,
    shaft: int | None = None,
    speed: ArrayLike | None = None,
    damping_ratio: float = DAMPING,
    progress: Progress | None = None,
) -> RotorResponse:
    """Return how a shaft of a drive whirls with its unbalance and its crack, over the speed.

    Parameters
    ----------
    drive : Drive
        With bodies of its shafts; `crack` and `unbalance` of the shaft.
    duty : Duty, optional
        Speeds of running; those of the drive by default.
    shaft : int, optional
        Number of the shaft, as in `rotor`.
    speed : array (k,), optional [rad/s]
        Speeds; by default up to the highest in use or beyond the critical speed.
    damping_ratio : float
        ζ of the mode.
    progress : function, optional
        Told the share done; when it answers "stop" the work ends.

    Returns
    -------
    RotorResponse
        Orders, orbits and stability; unstable ranges with their half orders.

    Raises
    ------
    InputError
        The drive does not say enough, or a speed is out of range.

    See Also
    --------
    bending_speeds, balance

    Notes
    -----
    `rotor` reduces the shaft, `cracked_rotor.cracked_rotor` solves it. The unbalance of a shaft behind
    joints has further odd orders, `UnbalanceBehindJoint` of the joint that all joints before it are equal to.

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import example, rotor_response
    >>> from cardan.parts import ShaftCrack
    >>> drive = example("car-propshaft")
    >>> bad = replace(drive.shafts[1], crack=ShaftCrack(losses=(0.1, 0.02)))
    >>> found = rotor_response(replace(drive, shafts=(drive.shafts[0], bad, drive.shafts[2])))
    >>> speed, size = found.peak(3)
    >>> print(f"{1e6 * size:.1f} μm at {speed / found.rotor.critical:.2f} of the critical speed", found.unstable)
    4.7 μm at 0.33 of the critical speed ()
    """
    one = rotor(drive, shaft, damping_ratio=damping_ratio)
    used = used_speeds(drive.duty if duty is None else duty)
    at = _speeds(one, used) if speed is None else np.atleast_1d(np.asarray(speed, dtype=float))
    steady = cracked_rotor(
        one.mass,
        one.stiffness,
        at,
        crack=one.crack,
        damping_ratio=one.damping_ratio,
        unbalance=one.unbalance,
        unbalance_phase=one.unbalance_turned - one.crack_turned,
        gravity=one.gravity,
        progress=progress,
    )
    behind = None
    if one.shaft > 1:
        before = float(
            abs(equivalent_joint(turning(given_chain(drive), drive.joints, near=True)).vertex[one.shaft - 1])
        )
        behind = unbalance_behind_joint(2.0 * math.atan(math.sqrt(before)), reach=5)
    return RotorResponse(rotor=one, steady=steady, used=used, behind=behind)


def _speeds(one: Rotor, used: tuple[float, float] | None) -> Array:
    high = max(FASTEST * one.critical, 1.05 * used[1] if used else 0.0)
    near = [one.critical / n * np.linspace(0.94, 1.06, 41) for n in (1, 2, 3)]
    ends = [speed for speed in used or () if speed > 0.0]
    return np.unique(np.concatenate([np.linspace(SLOWEST * one.critical, high, SPEEDS), *near, ends]))


def rotor_run(
    drive: Drive, *, shaft: int | None = None, damping_ratio: float = DAMPING, progress: Progress | None = None
) -> tuple[Rotor, CrackedRun]:
    """Return how a shaft whirls while the speed changes as the `run_up` of the duty says.

    drive: with bodies of its shafts and the `run_up` of its duty; shaft: number of the shaft, as in `rotor`.
    damping_ratio: ζ of the mode.
    Returns Rotor: the shaft as a mass on a spring; CrackedRun: its motion in time.
    """
    course = drive.duty.run_up
    if course is None:
        raise refuse("duty.run_up", _("missing: start, end and duration of a change of speed"), "missing")
    one = rotor(drive, shaft, damping_ratio=damping_ratio)
    found = cracked_run(
        one.mass,
        one.stiffness,
        course.start,
        (course.end - course.start) / course.duration,
        course.duration,
        crack=one.crack,
        damping_ratio=one.damping_ratio,
        unbalance=one.unbalance,
        unbalance_phase=one.unbalance_turned - one.crack_turned,
        gravity=one.gravity,
        progress=progress,
    )
    return one, found


def joined_rotors(
    drive: Drive,
    joint: int,
    *,
    speed: float | None = None,
    turns: float = 40.0,
    damping_ratio: float = DAMPING,
    progress: Progress | None = None,
) -> tuple[Rotor, Rotor, CrackedShafts]:
    """Return the motion in time of the two shafts that a joint joins, with their cracks and all angles.

    drive: with bodies of both shafts.
    joint: number of the joint, counted from 1; both shafts beside it need bodies.
    speed [rad/s]: of the first shaft; that of the duty by default.
    turns: how long, in turns; damping_ratio: ζ of both modes.
    Returns Rotor, Rotor: the shafts as masses on springs.
    `cracked_shafts.cracked_shafts` with the modes of both shafts; the motor turns the first shaft
    through its own torsional stiffness, Σ L/(G J).
    """
    if not 1 <= joint <= len(drive.joints):
        text = _("there is no joint {number}; the drive has {count}")
        raise refuse("joint", text.format(number=joint, count=len(drive.joints)), "out_of_range")
    first = rotor(drive, joint, damping_ratio=damping_ratio)
    second = rotor(drive, joint + 1, damping_ratio=damping_ratio)
    turning = drive.duty.speed if speed is None else speed
    if not turning:
        raise refuse("duty.speed", _("missing: the speed"), "missing")
    check(_no_stiffness(drive, first, second))
    place = geometry(drive)
    shafts = [_whirling(drive, one) for one in (first, second)]
    stiffness = _turning_stiffness(drive, first.shaft)
    inertia = shafts[0].inertia
    found = cracked_shafts(
        shafts[0],
        shafts[1],
        float(place.joint_angle[joint - 1]),
        abs(float(turning)),
        turns * 2.0 * math.pi / abs(float(turning)),
        phase=_yoke_position(drive, joint),
        drive_stiffness=stiffness,
        drive_damping=2.0 * damping_ratio * math.sqrt(stiffness * inertia),
        gravity=first.gravity,
        progress=progress,
    )
    return first, second, found


def _no_stiffness(drive: Drive, *rotors: Rotor) -> Iterator[Problem]:
    for one in rotors:
        found = weight(drive.shafts[one.shaft - 1], body_length(drive.shafts[one.shaft - 1], _length(drive, one.shaft)))
        if not found.inertia:
            text = _("missing: the moment of inertia about its axis, or a body that gives it")
            yield Problem(f"shafts[{one.shaft - 1}].inertia", text, "missing")


def _length(drive: Drive, number: int) -> float | None:
    return known_lengths(drive).get(number)


def _whirling(drive: Drive, one: Rotor) -> WhirlingShaft:
    shaft = with_yokes(drive).shafts[one.shaft - 1]
    inertia = weight(shaft, body_length(shaft, _length(drive, one.shaft))).inertia or 0.0
    start = float(np.angle(turning_marks(drive)[-1][one.shaft - 1, 0]))  # of the driving yoke, from X down
    radius = 0.5 * (shaft.outer or max((part.outer for part in shaft.segments), default=0.1))
    return WhirlingShaft(
        mass=one.mass,
        stiffness=one.stiffness,
        inertia=inertia,
        damping=2.0 * one.damping_ratio * math.sqrt(one.stiffness * one.mass),
        unbalance_mass=one.unbalance / radius,
        unbalance_radius=radius,
        unbalance_angle=start + one.unbalance_turned,
        crack=one.crack,
        crack_angle=start + one.crack_turned,
    )


def _yoke_position(drive: Drive, joint: int) -> float:
    """Return ψ of a joint, its driving yoke from the plane of its shafts at the start [rad]."""
    return float(np.asarray(motion(drive, [0.0]).yoke_rotation)[joint - 1, 0])


def _turning_stiffness(drive: Drive, number: int) -> float:
    """Return the torsional stiffness of a shaft from end to end [N·m/rad]."""
    shaft = drive.shafts[number - 1]
    if shaft.stiffness is not None:
        return shaft.stiffness
    body = pieces(shaft, body_length(shaft, _length(drive, number)))
    return 1.0 / sum(one.length / (one.material.shear_modulus * one.torsion_constant) for one in body)
