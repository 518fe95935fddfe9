"""Which torque, couple and force does every part of a drive carry?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.geometry import geometry
from cardan.drive.movement import Movement
from cardan.drive.train import Train, mass_problems, place_of, train
from cardan.errors import Problem, check, refuse
from cardan.maths import frames
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.paths import Path
from cardan.texts import _

from .cross_loads import JournalLoads, journal_loads
from .elastic import elastic, refuse_soft
from .kinetostatics import Couples, Stand, couples, resisted, standing, swinging
from .motion import positions
from .moving_chain import moving_centres
from .moving_points import moving_path, start_time
from .reactions import Frame, Held, Load, forces_of, frame, right_side, solved, thrusts, weights, whole_balance
from .redundancy import redundancy


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
        Input angle φ_1 from the start position; one turn in steps of a degree by default.
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

    Notes
    -----
    Rigid shafts and crosses; Coulomb friction in the journals and splines where the drive gives it. Torques go from
    the load backwards, forces follow from one linear system for the whole drive (statics of Book p. 129-150). Supports
    without friction: what they take is small beside the torque, see `losses`.

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = forces(Drive.from_angles([20 * deg]), Duty(torque=100.0), [0.0, 90 * deg])
    >>> found.input_torque
    array([106.41777725,  93.96926208])
    >>> found.bending_couple[1].round(6)
    array([36.397023,  0.      ])
    """
    if isinstance(drive, Drive):
        used = drive.duty if duty is None else duty
        whole = train(drive)
        if drive.supports:
            check(mass_problems(drive))
    else:
        used, whole = Duty() if duty is None else duty, drive
    if used.torque is None:
        raise refuse("duty.torque", _("missing; forces follow from the torque that the drive carries"))
    if used.speed == 0.0 and whole.drag is not None:
        raise refuse("duty.speed", _("at standstill the sense of friction is open; give the speed of running, or none"))
    xp = namespace(whole.points, angle)
    phi = positions(angle, xp)
    if isinstance(drive, Drive) and movement is None:
        _refuse_locked(whole, np.asarray(whole.chain.bend))
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
    """Return the forces of drives whose axes stand still; many drives and positions in one call.

    Parameters
    ----------
    whole : Train (...)
        Points, masses and supports.
    angle : array (p,) [rad]
        φ_1 from the start position.
    torque : float or array (...) or (..., p) [N·m]
        Torque at the output, positive when it resists positive turning; or at the input, where it drives. The last
        axis is that of the positions only where the array has one axis more than the drives.
    torque_at : str
        ``output`` or ``input``.
    speed, acceleration : float or array (...) [rad/s, rad/s²]
        ω_1, ε_1; without a speed no inertia counts.
    harmonics : sequence of (order, amplitude, phase)
        Swinging parts of the torque [1/turn, N·m, rad], by the angle of the shaft where it is given.
    field : str
        What an error about the supports names.

    Returns
    -------
    Forces

    Examples
    --------
    >>> from cardan.drive.train import train_of_points
    >>> many = train_of_points(np.asarray([[[0.0, 0, 0], [1, 0, 0], [2, 0, z]] for z in (0.0, 0.5)]))
    >>> kinetostatics(many, np.zeros(1), torque=1.0).input_torque
    array([[1.        ],
           [1.11803399]])
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
    lead = tuple(place.bend.shape[:-1])
    given = real(torque, xp)
    if given.ndim and given.ndim == len(lead):
        given = given[..., None]
    used = replace(whole, inertia=None, cross_inertia=None) if still else whole
    wave = _harmonics(harmonics, torque_at, whole, angle)
    carried = _carried(used, moved, given + wave + xp.zeros((*lead, angle.shape[0]), dtype=xp.float64), torque_at)
    return _answer(used, moved, whole.points[..., None, :, :], None, angle, carried, still=still, field=field)


def _refuse_locked(whole: Train, bend: Array) -> None:
    """Refuse a drive that does not turn, as the friction of a joint reaches what turns it; bends (..., n)."""
    if whole.drag is None:
        return
    steepest = np.max(np.reshape(bend, (-1, whole.joints)), axis=0)
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


def _harmonics(harmonics: Sequence[tuple[float, float, float]], torque_at: str, whole: Train, angle: Array) -> Array:
    """Return the swinging part of the torque, array (..., p)."""
    xp = namespace(angle)
    if not harmonics:
        return xp.zeros_like(angle)
    from .motion import motion

    at = angle if torque_at == "input" else motion(whole.chain, angle).output_angle
    return sum(size * xp.cos(order * at + phase) for order, size, phase in harmonics)


def _carried(whole: Train, stand: Stand, given: Array, torque_at: str) -> tuple[Couples, Array]:
    """Return the couples for a torque at either end, and the torque that resists the output."""
    if torque_at == "output":
        return couples(whole, stand, given), given
    load = resisted(whole, stand, given)
    return couples(whole, stand, load), load


def _moving(
    drive: Drive, whole: Train, duty: Duty, angle: Array, movement: Movement | Sequence[Movement] | Path
) -> Forces:
    """Return the forces while the points move: the input turns evenly meanwhile."""
    if duty.speed is None or duty.speed == 0.0:
        raise refuse("duty.speed", _("missing; how fast the axes move counts only beside how fast the shafts turn"))
    if duty.acceleration:
        raise refuse("duty.acceleration", _("while the points move the input turns evenly; leave this out"))
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
    )
    _refuse_locked(whole, np.asarray(found.shafts.bend))
    stand = swinging(found.axes, found.spins)
    points = np.asarray(found.points[0]).copy()
    points[:, 0] = points[:, 1] - place.length[0] * found.shafts.axis[:, 0]
    sense = -np.sign(np.asarray(found.shafts.length_rate)[:, list(whole.splines)])
    torque = np.zeros(angle.shape) + (duty.torque or 0.0)
    carried = _carried(whole, stand, torque, duty.torque_at)
    whole = replace(whole, normal=None)
    return _answer(whole, stand, points, found.points[2], angle, carried, still=False, field="supports", sense=sense)


def _answer(
    whole: Train,
    stand: Stand,
    points: Array,
    acceleration: Array | None,
    angle: Array,
    carried: tuple[Couples, Array],
    *,
    still: bool,
    field: str,
    sense: Array | None = None,
) -> Forces:
    xp = namespace(points, angle)
    found, output = carried
    n = whole.joints
    shape = found.shaft_torque.shape[:-1]
    push = thrusts(whole, found, sense)
    joint_force = reaction = turn = force_left = moment_left = None
    status = xp.zeros(shape[:-1], dtype=xp.int64)
    equations = unknowns = 0
    carried_by: list[Array | None] = [None, None]
    if whole.bearings:
        held = frame(whole, stand, points)
        equations, unknowns = held.equations, held.unknowns
        loads = weights(whole, held, stand, acceleration)
        known = right_side(held, found.secondary, loads, push)
        amounts, status = _amounts(
            whole, held, known, field, lambda: elastic(whole, held, stand, found, loads, push, known)
        )
        joint_force, reaction, turn = forces_of(held, amounts)
        force_left, moment_left = whole_balance(whole, held, stand, found, loads, (reaction, turn), output)
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
        power_left=xp.abs(found.power) / flow,
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
        return share() if many.degree else amounts, _status(fits, Held.INDETERMINATE)
    if columns > rows and whole.stiffness is not None:
        amounts = share()
    return amounts, _status(fits, Held.LOOSE if columns <= rows else Held.INDETERMINATE)


def _status(fits: Array, otherwise: Held) -> Array:
    xp = namespace(fits)
    return xp.astype(~fits, xp.int64) * int(otherwise)
