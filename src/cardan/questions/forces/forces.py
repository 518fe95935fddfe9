"""Which torque, couple and force does every part of a drive carry?"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import nullcontext
from dataclasses import replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.geometry import geometry
from cardan.drive.models.laws import refuse_kinds
from cardan.drive.models.machine_held import machine_held, tables_proposed
from cardan.drive.models.train import Train, mass_problems, place_of, train
from cardan.drive.movement import Movement
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.paths import Path
from cardan.questions.motion.motion import motion, positions
from cardan.questions.motion.moving_chain import moving_centres
from cardan.questions.motion.moving_points import moving_path, start_time
from cardan.texts import _

from .drive_forces import Forces, forces_from
from .kinetostatics import Couples, Stand, couples, resisted, standing, swinging

__all__ = ["Forces", "forces", "kinetostatics"]


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

    See Also
    --------
    moving_forces, assembly, losses

    Notes
    -----
    End shafts on which no support stands are held by their machines, where the drive has any supports. Rigid shafts
    and crosses; Coulomb friction in the journals and splines where the drive gives it. Torques go from the load
    backwards, forces follow from one linear system for the whole drive (statics of Book p. 129-150). Supports without
    friction: what they take is small beside the torque, see `losses`. The couple of a joint of another kind works on no
    motion that the joint allows; one that turns by a law without a Möbius map counts by the nearest map.

    Examples
    --------
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
    if used.speed == 0.0 and whole.drag is not None:
        raise refuse("duty.speed", _("at standstill the sense of friction is open; give the speed of running, or none"))
    xp = namespace(whole.points, angle)
    phi = positions(angle, xp)
    if isinstance(drive, Drive) and movement is None:
        _refuse_locked(whole, np.asarray(whole.chain.joint_angle))
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
    wave = _harmonics(harmonics, torque_at, whole, angle)
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


def _harmonics(harmonics: Sequence[tuple[float, float, float]], torque_at: str, whole: Train, angle: Array) -> Array:
    """Return the swinging part of the torque, array (..., p)."""
    xp = namespace(angle)
    if not harmonics:
        return xp.zeros_like(angle)
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
    refuse_kinds(drive, _("forces while the points move"), "moving forces")
    if duty.speed is None or duty.speed == 0.0:
        raise refuse(
            "duty.speed", _("missing; how fast the axes move counts only beside how fast the shafts turn"), "missing"
        )
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
    _refuse_locked(whole, np.asarray(found.shafts.joint_angle))
    stand = swinging(found.axes, found.spins)
    points = np.asarray(found.points[0]).copy()
    points[:, 0] = points[:, 1] - place.length[0] * found.shafts.axis[:, 0]
    sense = -np.sign(np.asarray(found.shafts.length_rate)[:, list(whole.splines)])
    torque = np.zeros(angle.shape) + (duty.torque or 0.0)
    carried = _carried(whole, stand, torque, duty.torque_at)
    whole = replace(whole, normal=None)
    return forces_from(
        whole, stand, points, found.points[2], angle, carried, still=False, field="supports", sense=sense
    )
