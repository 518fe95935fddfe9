"""How long do the joints of a drive last?"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Duty
from cardan.drive.models.laws import refuse_kinds
from cardan.drive.models.train import train
from cardan.errors import Problem, check, refuse
from cardan.formulas.joint_rating import POWER, book_life, lasting, nominal_torque
from cardan.maths.arrays import Array
from cardan.texts import _

from .bearing_life import MILLION, RELIABILITIES, maker_life, reliability_factor
from .bearing_loads import BearingLoads, bearing_loads
from .joint_bearings import JointBearings, Missing, joint_bearings
from .life_cautions import cautions
from .lives import METHODS, Life
from .rainflow import Cycles, Levels, rainflow, time_at_level


def life(drive: Drive, duty: Duty | None = None, *, method: str | None = None) -> Life:
    """Return how long the joints of a drive last: ISO 281 exactly, makers' formulas and the book's beside it.

    Parameters
    ----------
    drive : Drive
        With spans and capacities of needle bearings, or what to compute these from; ratings of makers.
    duty : Duty, optional
        Torque and speed, or blocks, or a measured torque; life demanded, factor for shocks, reliability. Those of the
        drive by default.
    method : str, optional
        One of `METHODS`, by which the joint that fails first is found; ``iso`` by default where any joint has a
        capacity, else ``maker`` or ``book``.

    Returns
    -------
    Life

    Raises
    ------
    InputError
        No speed, no torque, no joint whose life could be told: with the keys to add.

    Notes
    -----
    ISO 281: L = a_1 10^6 turns/D, D = (1/2π) ∮ \\|dδ/dφ\\| (f_d Q/C)^(10/3) dφ, with the swing δ and the load
    Q = K/d of the journals over the turn from the torque flow of the whole drive, friction and inertia counted. Makers
    and the book take the mean torque and the joint angle, at least 3°. Parts of a duty cycle add their damage, Book
    (268).

    Examples
    --------
    >>> from cardan.drive.cross import Cross
    >>> from cardan.drive.joint_parts import Needles
    >>> from cardan.drive.joints import Hooke
    >>> from cardan.units import deg, mm, rpm
    >>> joint = Hooke(joint_angle=12 * deg, cross=Cross(span=80 * mm), needles=Needles(capacity=20e3))
    >>> found = life(Drive(joints=(joint,)), Duty(speed=1000 * rpm, torque=800.0))
    >>> for name in ("driving", "driven", "simple", "book"):
    ...     print(f"{name} {getattr(found, name)[0, 0] / 3600:.1f} h")
    driving 1199.2 h
    driven 1229.2 h
    simple 1259.9 h
    book 1015.0 h
    """
    refuse_kinds(drive, _("bearing life"), "life")
    used = drive.duty if duty is None else duty
    if method is not None and method not in METHODS:
        names = ", ".join(METHODS)
        raise refuse("method", _("{value} is none of {choices}").format(value=repr(method), choices=names))
    parts, asked, history, cycles = duty_parts(used)
    bearings, missing = joint_bearings(drive)
    check(_nothing(bearings, missing))
    machine = train(drive)
    loads = bearing_loads(drive, machine, asked, parts)
    factor = float(reliability_factor(used.reliability))
    share = np.asarray([part.share for part in parts])
    lives = _lives(loads, bearings, parts, used.shock_factor, factor)
    chosen = method or _first(bearings)
    found = Life(
        parts=parts,
        share=share / np.sum(share),
        joint_angle=loads.joint_angle,
        torque=loads.torque,
        journal_force=used.shock_factor * loads.couple / bearings.span,
        bearings=bearings,
        **lives,
        shock_factor=used.shock_factor,
        reliability=used.reliability,
        reliability_factor=factor,
        demanded=used.life,
        method=chosen,
        history=history,
        cycles=cycles,
        uncounted=missing,
        assumed=(*bearings.assumed, *machine.assumed),
    )
    if bool(np.all(np.isnan(found.joints))):
        raise refuse("method", _("no joint has what {method} needs").format(method=chosen))
    return replace(found, cautions=tuple(cautions(found, beyond=used.reliability > max(RELIABILITIES))))


def duty_parts(duty: Duty) -> tuple[tuple[Block, ...], Duty, Levels | None, Cycles | None]:
    """Return the parts of a duty cycle, the duty they are of, and the levels and cycles of a measured torque.

    Parameters
    ----------
    duty : Duty
        Its blocks count before its measured torque, and this before its steady torque.

    Raises
    ------
    InputError
        A speed or a torque misses.
    """
    if duty.blocks:
        return duty.blocks, replace(duty, torque_at="output"), None, None
    history = duty.torque_history
    problems = []
    if not duty.speed:
        zero = Problem("duty.speed", _("is zero; at standstill bearings do not wear"))
        lacks = Problem("duty.speed", _("missing; how long a joint lasts depends on it"), "missing")
        problems.append(zero if duty.speed == 0.0 else lacks)
    if history is None and duty.torque is None:
        problems.append(Problem("duty.torque", _("missing; how long a joint lasts depends on it"), "missing"))
    if history is not None and len(history.times) < 2:
        problems.append(Problem("duty.torque_history", _("has no rows; it comes from a CSV file"), "empty"))
    check(problems)
    speed = duty.speed or 0.0
    if history is None:
        return (Block(torque=duty.torque or 0.0, speed=speed, share=1.0),), duty, None, None
    levels = time_at_level(history.times, history.torques)
    rows = zip(levels.value.tolist(), levels.share.tolist(), strict=True)
    parts = tuple(Block(torque=torque, speed=speed, share=share) for torque, share in rows if share > 0.0)
    return parts, replace(duty, torque_at="output", harmonics=()), levels, rainflow(history.torques)


def _lives(
    loads: BearingLoads, bearings: JointBearings, parts: tuple[Block, ...], shock: float, factor: float
) -> dict[str, Array]:
    """Return the lives of every joint in every part by every method, arrays (b, n) [s]."""
    speed = np.abs(np.asarray([part.speed for part in parts]))[:, None]
    whole = factor * MILLION * 2.0 * math.pi / speed
    strength = (bearings.span * bearings.capacity / shock) ** POWER
    mean = (np.abs(loads.torque)) ** POWER * 2.0 * loads.joint_angle / math.pi
    maker = np.full(loads.joint_angle.shape, np.nan)
    for i, convention in enumerate(bearings.convention):
        if convention in ("Tc", "CR"):
            case = {
                "speed": speed[:, 0],
                "joint_angle": loads.joint_angle[:, i],
                "convention": convention,
                "shock": shock,
            }
            maker[:, i] = maker_life(bearings.rating[i], loads.torque[:, i], **case)
    own = np.asarray([convention == "book" for convention in bearings.convention])
    nominal = np.where(own, bearings.rating, nominal_torque(bearings.capacity, 0.5 * bearings.span))
    return {
        "driving": lasting(whole * strength, loads.driving),
        "driven": lasting(whole * strength, loads.driven),
        "simple": lasting(whole * strength, mean),
        "maker": factor * maker,
        "book": factor * book_life(nominal, loads.torque, speed=speed, joint_angle=loads.joint_angle, shock=shock),
    }


def _first(bearings: JointBearings) -> str:
    """Return the best method that any joint has the figures for."""
    if bool(np.any(bearings.rated)):
        return "iso"
    return "maker" if any(convention in ("Tc", "CR") for convention in bearings.convention) else "book"


def _nothing(bearings: JointBearings, missing: tuple[Missing, ...]) -> list[Problem]:
    """Return what misses where no joint has anything to tell its life from."""
    if bool(np.any(bearings.rated)) or any(bearings.convention):
        return []
    return [Problem(one.field, one.message, "missing") for one in missing]
