"""How long do the joints of a drive last?"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Duty
from cardan.drive.models.laws import refuse_kinds
from cardan.drive.models.train import train
from cardan.errors import Problem, check, refuse
from cardan.formulas.joint_rating import POWER, book_life, lasting, nominal_torque
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.ties import foremost
from cardan.texts import _

from .bearing_life import MILLION, RELIABILITIES, maker_life, reliability_factor
from .bearing_loads import BearingLoads, bearing_loads
from .duty_cycle import combined_life, damage_shares, equivalent_torque
from .joint_bearings import JointBearings, Missing, joint_bearings
from .life_cautions import Caution, cautions
from .rainflow import Cycles, Levels, rainflow, time_at_level

METHODS = ("iso", "simple", "maker", "book")
"""Ways to a life: ISO 281 exactly and by the mean load, the maker's formula, the book's."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Life:
    """Life of the joints of a drive in its duty cycle.

    Attributes
    ----------
    parts : tuple of Block (b,)
        Parts of the duty cycle; one for a steady duty, one a level for a measured torque.
    share : array (b,)
        Their shares of the time.
    joint_angle : array (b, n) [rad]
        Bend of each joint in each part.
    torque : array (b, n) [N·m]
        Mean torque that enters each joint, without the factor for shocks.
    journal_force : array (b, n) [N]
        Largest load of a journal in a turn, with the factor for shocks; nan without a span.
    bearings : JointBearings
        Capacities and ratings of the joints.
    driving, driven : arrays (b, n) [s]
        Life by ISO 281 of the bearings in the driving and in the driven yoke, exactly over the turn.
    simple, maker, book : arrays (b, n) [s]
        Life of the joints by the mean load, by the maker's formula and by the book's. All lives are those that the
        share ``reliability`` reaches; infinite where nothing is damaged, nan where a key misses.
    shock_factor, reliability, reliability_factor : float
        f_d, share of joints that last, a_1.
    demanded : float or None [s]
        Life that the duty asks for.
    method : str
        Which of `METHODS` the properties go by.
    history : Levels or None
        Time at each level of the measured torque.
    cycles : Cycles or None
        Its cycles by rainflow.
    cautions : tuple of Caution
        What to mind.
    uncounted : tuple of Missing
        Lives left out, each with the key to add.
    assumed : tuple of str
        Paths of what the drive does not say and the answer assumes.
    """

    parts: tuple[Block, ...]
    share: Array
    joint_angle: Array
    torque: Array
    journal_force: Array
    bearings: JointBearings
    driving: Array
    driven: Array
    simple: Array
    maker: Array
    book: Array
    shock_factor: float
    reliability: float
    reliability_factor: float
    demanded: float | None
    method: str
    history: Levels | None = None
    cycles: Cycles | None = None
    cautions: tuple[Caution, ...] = ()
    uncounted: tuple[Missing, ...] = ()
    assumed: tuple[str, ...] = ()

    @property
    def iso(self) -> Array:
        """Life of the joints by ISO 281 in each part, the shorter of both yokes, array (b, n) [s]."""
        return np.minimum(self.driving, self.driven)

    def of(self, method: str) -> Array:
        """Return the life of every joint in the whole duty cycle by one of `METHODS`, array (n,) [s].

        Parameters
        ----------
        method : str
            ``iso``: the shorter of both yokes, each with the damage of its own parts.
        """
        if method == "iso":
            return np.minimum(self.combined(self.driving), self.combined(self.driven))
        return self.combined(getattr(self, method))

    def combined(self, lives: Array) -> Array:
        """Return lives (b, n) in the parts put together over the duty cycle, array (n,) [s]."""
        return combined_life(lives.T, self.share)

    @property
    def joints(self) -> Array:
        """Life of every joint by the chosen method, array (n,) [s]; nan where a key misses."""
        return self.of(self.method)

    @property
    def drive(self) -> float:
        """Life of the joint that fails first [s]."""
        return float(np.nanmin(self.joints))

    @property
    def governing(self) -> int:
        """Number of the joint that fails first."""
        return int(foremost(self.joints, least=True)) + 1

    @property
    def damage(self) -> Array:
        """Share of each part in the damage of each joint, array (b, n); zeros where nothing is damaged."""
        if self.method == "iso":
            side = self.combined(self.driving) <= self.combined(self.driven)
            lives = np.where(side, self.driving, self.driven)
        else:
            lives = getattr(self, self.method)
        return np.matrix_transpose(damage_shares(np.matrix_transpose(lives), self.share))

    @property
    def equivalent_torque(self) -> Array:
        """Constant torque that damages each joint as much at its mean speed times bend, array (n,) [N·m]."""
        speed = np.asarray([part.speed for part in self.parts])
        return equivalent_torque(self.torque.T, self.share, speed=speed, joint_angle=self.joint_angle.T)

    @property
    def speed_angle(self) -> Array:
        """Mean of speed times bend of each joint, array (n,) [rad²/s]."""
        speed = np.asarray([abs(part.speed) for part in self.parts])
        found: Array = np.sum((self.share * speed)[:, None] * self.joint_angle, axis=0)
        return found

    @property
    def enough(self) -> bool | None:
        """Whether the drive lasts as long as the duty asks for; None where it asks for nothing."""
        return None if self.demanded is None else self.drive >= self.demanded

    @property
    def needed_capacity(self) -> Array:
        """Dynamic capacity that each joint needs for the life demanded, by ISO 281, array (n,) [N]; nan without one."""
        if self.demanded is None:
            return np.full(self.bearings.capacity.shape, np.nan)
        with np.errstate(divide="ignore"):
            return self.bearings.capacity * (self.demanded / self.of("iso")) ** (1.0 / POWER)

    @property
    def torque_margin(self) -> float:
        """By which factor all torques may grow until the drive lasts just as long as demanded; nan without a demand."""
        return math.nan if self.demanded is None else float((self.drive / self.demanded) ** (1.0 / POWER))

    def loaded(self, factor: ArrayLike) -> Array:
        """Return the life of every joint by the chosen method with all loads times a factor, array (f, n) [s].

        Parameters
        ----------
        factor : array (f,)
            Above zero.
        """
        return self.joints / np.asarray(factor, dtype=float)[:, None] ** POWER


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
