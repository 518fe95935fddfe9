"""Which torque, couple and force does every part of a drive carry?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import nullcontext
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.dynamics_model import Train, length_problems, mass_problems, place_of, train
from cardan.drive.models.geometry import geometry
from cardan.drive.models.kinematics_model import Chain, refuse_kinds
from cardan.drive.models.machine_held import machine_held, tables_proposed
from cardan.drive.movement import Movement
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.paths import Path
from cardan.maths.kernel import frames
from cardan.questions.motion.length import slip_ends, slipping
from cardan.questions.motion.motion import motion, positions
from cardan.questions.motion.moving_chain import moving_centres
from cardan.questions.motion.moving_points import moving_path, start_time
from cardan.texts import _

from .elastic import elastic, redundancy, refuse_soft
from .kinetostatics import Couples, KinematicState, couples, resisted, standing, swinging
from .reactions import (
    Determinacy,
    Frame,
    Load,
    forces_of,
    frame,
    pulled,
    right_side,
    shoves,
    solved,
    thrusts,
    weights,
    whole_balance,
)
from .turn_loads import turns
from .wobbling import wobbling_state

__all__ = ["Forces", "forces", "kinetostatics"]

ROUNDS = 100
"""Rounds between torques and forces where pins stand apart, at most."""

RESTS = 1e-14
"""Change of a force over the largest one at which they are found."""


def forces(
    drive: Drive | Train,
    duty: Duty | None = None,
    angle: ArrayLike | None = None,
    *,
    movement: Movement | Sequence[Movement] | Path | None = None,
) -> Forces:
    """Return torques, secondary couples, journal loads and reactions of a drive over the input angle, exactly.

    Parameters
    ----------
    drive : Drive or Train (...)
        One drive, or the arrays of many that are held alike.
    duty : Duty, optional
        Torque, speed and acceleration; those of the drive by default.
    angle : array (p,) [rad], optional
        Input angle φ_1 from the start position; in steps of a degree by default over one turn, or over as many as the
        swinging parts of the torque take to repeat.
    movement : Movement, sequence of Movement or function, optional
        What moves the joint centres meanwhile, the input angle zero at its start; they stand still when not given.

    Returns
    -------
    Forces
        shaft_torque : array (..., n+1, p), secondary_couple : array (..., n+1, p, 3), reaction : array (..., k, p, 3).

    Raises
    ------
    InputError
        No torque, a shaft that is not held, more supports than statics can tell and no stiffness given, a joint that
        friction locks, or something that would need a speed.

    See Also
    --------
    moving_forces, assembly, losses

    Notes
    -----
    End shafts on which no support stands are held by their machines, where the drive has any supports. Rigid shafts
    and crosses; Coulomb friction in the joints and splines where the drive gives it. Torques go from the load
    backwards, forces follow from one linear system for the whole drive (statics of Book p. 129-150). Supports without
    friction: what they take is small beside the torque, see `losses`. The couple of a joint of another kind works on no
    motion that the joint allows; one that turns by a law without a Möbius map counts by the nearest map.

    Examples
    --------
    >>> from cardan import Drive, forces
    >>> from cardan.parts import Duty
    >>> from cardan.units import deg
    >>> found = forces(Drive.from_angles([20 * deg]), Duty(torque=100.0), [0.0, 90 * deg])
    >>> found.input_torque
    array([106.41777725,  93.96926208])
    >>> found.bending_couple[1].round(6)
    array([36.397023,  0.      ])
    """
    with tables_proposed(drive) if isinstance(drive, Drive) else nullcontext():
        return _forces(drive, duty, angle, movement)


def _forces(
    drive: Drive | Train,
    duty: Duty | None,
    angle: ArrayLike | None,
    movement: Movement | Sequence[Movement] | Path | None,
) -> Forces:
    if isinstance(drive, Drive):
        used = drive.duty if duty is None else duty
        refuse_kinds(drive, _("forces"), "forces")
        drive = machine_held(drive)
        whole = train(drive, kinds=True)
        if drive.supports:
            check(mass_problems(drive))
    else:
        used, whole = Duty() if duty is None else duty, drive
    if used.torque is None:
        raise refuse("duty.torque", _("missing; forces follow from the torque that the drive carries"), "missing")
    if used.speed == 0.0 and whole.rubs:
        raise refuse("duty.speed", _("at standstill the sense of friction is open; give the speed of running, or none"))
    xp = namespace(whole.points, angle)
    phi = positions(angle, xp, turns=turns(used.harmonics))
    if isinstance(drive, Drive) and movement is None:
        _refuse_locked(whole, np.asarray(whole.chain.joint_angle))
    if isinstance(drive, Drive) and any(joint.ball is not None for joint in drive.joints):
        if movement is not None:
            i = next(i for i, joint in enumerate(drive.joints) if joint.ball is not None)
            text = _("the ball behind it stands in the frame, and no movement says where it goes with its drive")
            raise refuse(f"joints[{i}].kind", text, "unknown_kind")
        return _wobbling(drive, whole, used, phi)
    if movement is None:

        def asked(one: Train) -> Forces:
            return kinetostatics(
                one,
                phi,
                torque=used.torque or 0.0,
                torque_at=used.torque_at,
                speed=used.speed,
                acceleration=used.acceleration,
                harmonics=tuple((one.order, one.torque, one.phase) for one in used.harmonics),
            )

        found = asked(whole)
        back = _slid_back(drive, whole) if isinstance(drive, Drive) else None
        return found if back is None else replace(found, reverse=asked(back))
    if not isinstance(drive, Drive):
        raise refuse("movement", _("one drive at a time can move; a batch of drives stands still"))
    return _moving(drive, whole, used, phi, movement)


def _wobbling(drive: Drive, whole: Train, duty: Duty, angle: Array) -> Forces:
    """Return the forces of a drive with pins that stand apart: its shafts wobble with the turn.

    A force in such a joint turns its shafts, so that torques and forces follow from each other, round by round: each
    leaves the distance of the pins over the length of the shaft.
    """
    check(length_problems(drive))
    if not whole.bearings:
        text = _(
            "missing; where pins stand apart the forces between the shafts turn them too, and they follow from what "
            "holds the shafts"
        )
        raise refuse("supports", text, "missing")
    still = duty.speed is None
    if still:
        whole = replace(whole, inertia=None, transverse_inertia=None, cross_inertia=None)
    moved, points, acceleration = wobbling_state(drive, angle, duty.speed or 1.0, 0.0 if still else duty.acceleration)
    given = (duty.torque or 0.0) + _harmonics(
        [(one.order, one.torque, one.phase) for one in duty.harmonics], duty.torque_at, drive, angle
    )
    force, found = np.zeros((*angle.shape, whole.joints, 3)), None
    for _round in range(ROUNDS):
        carried = _carried(whole, moved, given, duty.torque_at, force)
        found = forces_from(
            whole, moved, points, None if still else acceleration, angle, carried, still=still, field="supports"
        )
        assert found.joint_force is not None
        new = np.moveaxis(found.joint_force, 0, 1)
        change, force = np.max(np.abs(new - force)), new
        if not change > RESTS * np.max(np.abs(force)):
            return found
    text = _("the forces between its pins that stand apart do not settle: they stand too far apart for its ball")
    raise refuse("joints", text, "out_of_range")


def kinetostatics(
    whole: Train,
    angle: Array,
    *,
    torque: ArrayLike,
    torque_at: str = "output",
    speed: ArrayLike | None = None,
    acceleration: ArrayLike = 0.0,
    harmonics: Sequence[tuple[float, float, float]] = (),
    field: str = "supports",
) -> Forces:
    """Return the forces of drives whose axes stand still; many drives and positions in one call; nan where they lock.

    whole (...): points, masses and supports; angle (p,) [rad]: φ_1 from the start position.
    torque (...) or (..., p) [N·m]: resists positive turning at the output, or drives at the input (`torque_at`); its
    last axis is that of the positions only where it has one axis more than the drives.
    speed, acceleration (...) [rad/s, rad/s²]: ω_1, ε_1; without a speed no inertia counts.
    harmonics: (order [1/turn], amplitude [N·m], phase [rad]) of swinging parts, by the angle of the shaft.
    field: what an error about the supports names.
    """
    xp = namespace(whole.points, angle)
    place = place_of(whole)
    still = speed is None
    moved = standing(
        whole.chain,
        place.axis,
        place.normal,
        angle,
        speed=1.0 if speed is None else speed,
        acceleration=0.0 if speed is None else acceleration,
    )
    outer = tuple(place.joint_angle.shape[:-1])
    given = real(torque, xp)
    if given.ndim and given.ndim == len(outer):
        given = given[..., None]
    used = replace(whole, inertia=None, cross_inertia=None) if still else whole
    if used.drag is not None:
        hold = used.drag * xp.tan(place.joint_angle)
        used = replace(used, drag=xp.where(hold < 1.0, used.drag + 0.0 * hold, xp.full_like(hold, xp.nan)))
    wave = _harmonics(harmonics, torque_at, whole.chain, angle)
    carried = _carried(used, moved, given + wave + xp.zeros((*outer, angle.shape[0]), dtype=xp.float64), torque_at)
    return forces_from(used, moved, whole.points[..., None, :, :], None, angle, carried, still=still, field=field)


def _refuse_locked(whole: Train, joint_angle: Array) -> None:
    """Refuse a drive that does not turn, as the friction of a joint reaches what turns it; bends (..., n)."""
    if whole.drag is None:
        return
    steepest = np.max(np.reshape(joint_angle, (-1, whole.joints)), axis=0)
    hold = np.asarray(whole.drag) * np.tan(steepest)
    text = _("friction locks joint {number}: over the journals it reaches {share:.3g} of what turns it")
    check(
        Problem(f"joints[{i}].friction", text.format(number=i + 1, share=float(hold[i])))
        for i in np.flatnonzero(hold >= 1.0)
    )


def _slid_back(drive: Drive, whole: Train) -> Train | None:
    """Return the train with the splines that slide both ways sliding the other way; None where none of them rubs."""
    both = [shaft.spline is not None and shaft.spline.sliding == "both" for shaft in drive.shafts]
    turned = np.asarray([both[s] for s in whole.splines], dtype=bool)
    if whole.grip is None or whole.sliding is None or not bool(np.any(turned & (np.asarray(whole.grip) > 0.0))):
        return None
    return replace(whole, sliding=np.where(turned, -whole.sliding, whole.sliding))


def _harmonics(
    harmonics: Sequence[tuple[float, float, float]], torque_at: str, turning: Drive | Chain, angle: Array
) -> Array:
    """Return the swinging part of the torque, array (..., p)."""
    xp = namespace(angle)
    if not harmonics:
        return xp.zeros_like(angle)
    at = angle if torque_at == "input" else motion(turning, angle).output_angle
    return sum(size * xp.cos(order * at + phase) for order, size, phase in harmonics)


def _carried(
    whole: Train, stand: KinematicState, given: Array, torque_at: str, force: Array | None = None
) -> tuple[Couples, Array]:
    """Return the couples for a torque at either end, and the torque that resists the output; force as of `couples`."""
    load = given if torque_at == "output" else resisted(whole, stand, given, force)
    return couples(whole, stand, load, force), load


def _moving(
    drive: Drive, whole: Train, duty: Duty, angle: Array, movement: Movement | Sequence[Movement] | Path
) -> Forces:
    """Return the forces while the points move: the input turns evenly meanwhile."""
    if duty.speed is None or duty.speed == 0.0:
        raise refuse(
            "duty.speed", _("missing; how fast the axes move counts only beside how fast the shafts turn"), "missing"
        )
    if duty.acceleration:
        raise refuse("duty.acceleration", _("while the points move the input turns uniformly; leave this out"))
    if duty.harmonics:
        raise refuse("duty.harmonics", _("while the points move the torque is constant; leave this out"))
    moves = (movement,) if isinstance(movement, Movement) else movement
    place = geometry(drive)
    path = moves if callable(moves) else moving_path(place.points, moves)
    start = 0.0 if callable(moves) else start_time(moves)
    found = moving_centres(
        path,
        start + angle / duty.speed,
        yoke_angle=whole.chain.yoke_angle,
        speed=duty.speed,
        start_phase=drive.input.start_phase,
        start=start,
        normal=place.normal[0],
        kinds=drive.joints,
    )
    _refuse_locked(whole, np.asarray(found.shafts.joint_angle))
    stand = swinging(found.axes, found.spins)
    points = np.asarray(found.points[0]).copy()
    points[:, 0] = points[:, 1] - place.length[0] * found.shafts.axis[:, 0]
    slid = slipping(found.shafts, place.length, slip_ends(drive))
    sense = -np.sign(slid.length_rate[:, list(whole.splines)])
    torque = np.zeros(angle.shape) + (duty.torque or 0.0)
    carried = _carried(whole, stand, torque, duty.torque_at)
    whole = replace(whole, normal=None)
    return forces_from(
        whole, stand, points, found.points[2], angle, carried, still=False, field="supports", sense=sense
    )


# What the four journals of each cross carry.

SIDES = (1.0, -1.0)
"""Journals of an arm: on its positive end, on its negative end."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JournalLoads:
    """Loads of the journals of crosses; leading axes (...) are those of drives, joints and positions."""

    # (..., 4, 3) [N]: force across each journal: on the cross at +u and -u, on the driven yoke at +v and -v
    load: Array
    # (..., 2) [N]: force along u and along v that one of the two journals of the arm, or both together, pass on
    thrust: Array

    @property
    def size(self) -> Array:
        """Size of the force across each journal, array (..., 4) [N]."""
        return frames.norm(self.load)


def journal_loads(
    driving: Array,
    driven: Array,
    driving_arm: Array,
    driven_arm: Array,
    span: Array,
    driving_force: Array | None = None,
    driven_force: Array | None = None,
) -> JournalLoads:
    """Return the loads of the journals.

    driving, driven (..., 3) [N·m]: K⁻, couple of the driving yoke on the cross; K⁺, of the cross on the driven yoke.
    driving_arm, driven_arm (..., 3): u and v; span (...) [m]: d, between the middles of opposite bearings.
    driving_force, driven_force (..., 3) [N]: force of the driving yoke on the cross, and of the cross on the driven
    yoke, in the joint centre; none when not given.
    R = ±(K×u)/d + ½[F - (F·u)u] at ±(d/2) u, the same with v, Book (101)-(105); thrust F·u and F·v, Book (109).
    """
    xp = namespace(driving, driving_arm, span)
    rows, thrusts = [], []
    for couple, arm, force in ((driving, driving_arm, driving_force), (driven, driven_arm, driven_force)):
        turn = frames.cross(couple, arm) / span[..., None]
        pull = 0.0 * turn if force is None else force + 0.0 * turn
        along = frames.dot(pull, arm)
        half = 0.5 * (pull - along[..., None] * arm)
        rows += [side * turn + half for side in SIDES]
        thrusts.append(along)
    return JournalLoads(load=xp.stack(rows, axis=-2), thrust=xp.stack(thrusts, axis=-1))


# All that follows from the couples of a drive's joints: forces, what supports hold, what the balances leave.


@dataclass(frozen=True, eq=False, kw_only=True)
class Forces:
    """Torques, couples and forces of a drive over the input angle; leading axes are those of the drives.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angle φ_1 from the start position.
    speed, acceleration : arrays (..., n+1, p) [rad/s, rad/s²]
        ω_i and ε_i of every shaft; for ω_1 = 1 and without inertia when the drive does not say how fast it turns.
    shaft_torque : array (..., n+1, p) [N·m]
        τ_i, torque that must enter every shaft; that of shaft 1 drives the drive.
    output_torque : array (..., p) [N·m]
        Torque that resists the output.
    joint_torque : array (..., n, p) [N·m]
        T_i, part of the couple along the normal of each cross.
    driving_couple, driven_couple : arrays (..., n, p, 3) [N·m]
        Couple of the driving yoke on the cross, and of the cross on the driven yoke.
    secondary_couple : array (..., n+1, p, 3) [N·m]
        Couple across every shaft, which bends it in the planes of its yokes and which its supports must balance.
    driving_arm, driven_arm : arrays (..., n, p, 3)
        Directions of the arms of each cross.
    axis : array (..., n+1, p, 3)
        Directions of the shafts.
    joint_force : array (..., n, p, 3) [N] or None
        Force in each joint centre on the driven shaft, on the driving shaft the opposite; None without supports.
    reaction, support_couple : arrays (..., k, p, 3) [N, N·m] or None
        Force and couple of every support on its shaft.
    support_shaft : tuple of int
        Number of the shaft of every support.
    journals : JournalLoads
        Of each cross, axes (..., n, p); nan where the span is not known.
    spline_thrust : array (..., number of splines, p) [N]
        Friction thrust in every spline, positive where it pushes the two parts apart.
    loss : array (..., n, p) [W]
        Power lost in the journals of each joint.
    power_left : array (..., p)
        What the power balance leaves, over the largest power in it.
    force_left, moment_left : arrays (..., p) or None
        What the external forces and moments on the whole drive leave, over the largest of them.
    status : array of int (...)
        `Held`: whether the supports hold the drive just enough; what is held too much shares by stiffness.
    equations, unknowns : int
        Of the balance of all shafts.
    reverse : Forces or None
        The same with the splines sliding the other way, where they slide both ways and rub.
    assumed : tuple of str
        Paths of what the drive does not say and this answer assumes.
    """

    angle: Array
    speed: Array
    acceleration: Array
    shaft_torque: Array
    output_torque: Array
    joint_torque: Array
    driving_couple: Array
    driven_couple: Array
    secondary_couple: Array
    driving_arm: Array
    driven_arm: Array
    axis: Array
    joint_force: Array | None
    reaction: Array | None
    support_couple: Array | None
    support_shaft: tuple[int, ...]
    journals: JournalLoads
    spline_thrust: Array
    loss: Array
    power_left: Array
    force_left: Array | None
    moment_left: Array | None
    status: Array
    equations: int
    unknowns: int
    reverse: Forces | None = None
    assumed: tuple[str, ...] = ()

    @property
    def input_torque(self) -> Array:
        """Torque that drives the input shaft, array (..., p) [N·m]."""
        return self.shaft_torque[..., 0, :]

    @property
    def bending_couple(self) -> Array:
        """Size of the secondary couple of every shaft, array (..., n+1, p) [N·m]."""
        return frames.norm(self.secondary_couple)

    @property
    def support_axis(self) -> Array:
        """Direction of the shaft at every support, array (..., k, p, 3)."""
        xp = namespace(self.axis)
        return xp.stack([self.axis[..., number - 1, :, :] for number in self.support_shaft], axis=-3)

    @property
    def axial(self) -> Array:
        """Axial part of the reactions, positive along the power flow, array (..., k, p) [N]; needs supports."""
        return frames.dot(self._held, self.support_axis)

    @property
    def radial(self) -> Array:
        """Size of the radial part of the reactions, array (..., k, p) [N]; needs supports."""
        return frames.norm(self._held - self.axial[..., None] * self.support_axis)

    @property
    def _held(self) -> Array:
        if self.reaction is None:
            raise refuse("supports", _("missing; reactions need [[supports]] that hold the shafts"))
        return self.reaction


def forces_from(
    whole: Train,
    stand: KinematicState,
    points: Array,
    acceleration: Array | None,
    angle: Array,
    carried: tuple[Couples, Array],
    *,
    still: bool,
    field: str,
    sense: Array | None = None,
) -> Forces:
    """Return all forces of drives whose couples are known.

    whole (...): masses and supports; stand (..., p): how shafts and crosses stand and turn.
    points (..., p or 1, n+2, 3) [m]: B_0 … B_{n+1}.
    acceleration (p, n+2, 3) [m/s²]: of the points; None where they stand still.
    angle (p,) [rad]: φ_1 from the start position.
    carried (Couples, array (..., p) [N·m]): couples of the joints, and the torque that resists the output.
    still: whether no speed is known, so that inertia does not count; field: what an error about the supports names.
    sense (p, number of splines): sense of the friction thrust of each spline; that of the train when not given.
    """
    xp = namespace(points, angle)
    found, output = carried
    n = whole.joints
    shape = found.shaft_torque.shape[:-1]
    push = thrusts(whole, stand, found, sense)
    joint_force = reaction = turn = force_left = moment_left = None
    power = found.power
    status = xp.zeros(shape[:-1], dtype=xp.int64)
    equations = unknowns = 0
    carried_by: list[Array | None] = [None, None]
    if whole.bearings:
        held = frame(whole, stand, points)
        equations, unknowns = held.equations, held.unknowns
        loads = weights(whole, held, stand, acceleration)
        shoved = shoves(whole, held, stand, found.shaft_torque[..., 1:], found.pushed)
        known = right_side(held, found.secondary, loads, push, shoved)
        amounts, status = _amounts(
            whole, held, known, field, lambda: elastic(whole, held, stand, found, loads, push, known)
        )
        joint_force, reaction, turn = forces_of(held, amounts)
        force_left, moment_left = whole_balance(whole, held, stand, found, loads, (reaction, turn), output)
        if stand.head_rate is not None:
            power = power + pulled(held, stand, loads, n if whole.cross_mass is not None else 0, push)
        carried_by = [joint_force - _cross_pull(whole, loads, joint_force), joint_force]
    span = xp.asarray(whole.span)[..., None, :] if whole.span is not None else xp.full((1, n), xp.nan)
    journals = journal_loads(found.driving, found.driven, stand.driving_arm, stand.driven_arm, span, *carried_by)

    def turned(table: Array | None, width: int = 1) -> Array | None:
        """Put the axis of the positions behind that of the parts."""
        return None if table is None else xp.moveaxis(table, -1 - width, -width)

    flow = xp.where(found.flow > 0.0, found.flow, 1.0)
    axis = xp.broadcast_to(stand.axis, (*shape, n + 1, 3))
    return Forces(
        angle=angle,
        speed=turned(stand.speed),
        acceleration=turned(stand.acceleration),
        shaft_torque=turned(found.shaft_torque),
        output_torque=output,
        joint_torque=turned(found.joint_torque),
        driving_couple=turned(found.driving, 2),
        driven_couple=turned(found.driven, 2),
        secondary_couple=turned(found.secondary, 2),
        driving_arm=turned(stand.driving_arm, 2),
        driven_arm=turned(stand.driven_arm, 2),
        axis=turned(axis, 2),
        joint_force=turned(joint_force, 2),
        reaction=turned(reaction, 2),
        support_couple=turned(turn, 2),
        support_shaft=tuple(shaft + 1 for shaft, _holds in whole.bearings),
        journals=JournalLoads(load=turned(journals.load, 3), thrust=turned(journals.thrust, 2)),
        spline_thrust=turned(push),
        loss=turned(found.loss),
        power_left=xp.abs(power) / flow,
        force_left=force_left,
        moment_left=moment_left,
        status=status,
        equations=equations,
        unknowns=unknowns,
        assumed=whole.assumed + (("duty.speed",) if still else ()),
    )


def _cross_pull(whole: Train, loads: list[Load], like: Array) -> Array:
    """Return the weight of every cross, which its driving journals carry, array (..., p, n, 3)."""
    xp = namespace(like)
    if whole.cross_mass is None or whole.gravity is None:
        return xp.zeros_like(like)
    rows = [xp.broadcast_to(load.force, (*like.shape[:-2], 3)) for load in loads[-whole.joints :]]
    return xp.stack(rows, axis=-2)


def _amounts(whole: Train, held: Frame, known: Array, field: str, share: Callable[[], Array]) -> tuple[Array, Array]:
    """Return the unknowns, and whether each drive is held just enough; what is held too much shares by stiffness.

    A single drive that is loose, or whose forces follow from a stiffness not given, is refused.
    """
    xp = namespace(known)
    rows, columns = held.matrix.shape[-2:]
    fits = xp.zeros(known.shape[:-2], dtype=xp.bool)
    amounts = xp.full((*known.shape[:-1], columns), xp.nan)
    if rows == columns:
        amounts, regular = solved(held, known)
        fits = xp.all(regular, axis=-1)
        if bool(xp.all(fits)):
            return amounts, xp.zeros(fits.shape, dtype=xp.int64)
    if known.ndim == 2:
        many = redundancy(np.asarray(held.matrix), held.layout, field=field)
        refuse_soft(whole, many, field)
        return share() if many.degree else amounts, _status(fits, Determinacy.INDETERMINATE)
    if columns > rows and whole.stiffness is not None:
        amounts = share()
    return amounts, _status(fits, Determinacy.LOOSE if columns <= rows else Determinacy.INDETERMINATE)


def _status(fits: Array, otherwise: Determinacy) -> Array:
    xp = namespace(fits)
    return xp.astype(~fits, xp.int64) * int(otherwise)
