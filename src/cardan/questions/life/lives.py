"""Life of the joints of a drive, as it was found."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from cardan.answers.quantity import Text
from cardan.drive.conditions import LoadCase
from cardan.formulas import ball_bearing
from cardan.formulas.joint_rating import POWER
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.ties import foremost

from .duty_cycle import combined_life, damage_shares, equivalent_torque
from .joint_bearings import JointBearings, Missing
from .rainflow import Cycles, Levels
from .support_loads import SupportLives

METHODS = ("iso", "simple", "maker", "book")
"""Ways to a life: ISO 281 exactly and by the mean load, the maker's formula, the book's."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Caution:
    """Something to mind."""

    # ``small_oscillation``, ``angle_clamped_3deg``, ``extrapolated``, ``no_swing``, ``heavy_load`` or ``heavy_thrust``
    code: str
    joint: int  # number of the joint; 0 where it is the duty or a support
    message: Text  # in one sentence


@dataclass(frozen=True, eq=False, kw_only=True)
class Life:
    """Life of the joints of a drive in its duty cycle, in all poses and while it moves.

    Attributes
    ----------
    parts : tuple of LoadCase (b,)
        Parts of the duty cycle in each pose; one for a steady duty, one a level for a measured torque.
    share : array (b,)
        Their shares of the time.
    joint_angle : array (b, n) [rad]
        Joint angle of each joint in each part, the mean over a movement.
    torque : array (b, n) [N·m]
        Mean torque that enters each joint, without the factor for shocks; over a movement what damages as much.
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
    worst_pose : str
        Where no share of the poses is known: the pose in which a joint fails first, of which alone this is the life.
    moving : bool
        Whether the drive moves, and damage is summed over its movements.
    vibration : tuple of float (b,)
        Largest alternating torque over its mean in each part, torsional vibration counted; nan where it is not.
    assumed : tuple of str
        Paths of what the drive does not say and the answer assumes.
    supports : SupportLives or None
        The ball bearings of the supports; None where none of them is rated.
    """

    parts: tuple[LoadCase, ...]
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
    worst_pose: str = ""
    moving: bool = False
    vibration: tuple[float, ...] = ()
    assumed: tuple[str, ...] = ()
    supports: SupportLives | None = None

    @property
    def named(self) -> bool:
        """Whether its parts have names: poses, load cases."""
        return any(part.name and not part.path.startswith("duty.blocks") for part in self.parts)

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
    def of_supports(self) -> Array:
        """Life of the ball bearing of every support that has one, array (m,) [s]."""
        return np.zeros(0) if self.supports is None else self.combined(self.supports.loads.life)

    @property
    def drive(self) -> float:
        """Life of the joint or support that fails first [s]."""
        return float(np.nanmin(np.append(self.joints, self.of_supports)))

    @property
    def governing(self) -> int:
        """Number of the joint that fails first among the joints."""
        return int(foremost(self.joints, least=True)) + 1

    @property
    def governing_support(self) -> int:
        """Number of the support that fails before every joint; 0 where a joint fails first."""
        if self.supports is None:
            return 0
        place = int(foremost(np.append(self.joints, self.of_supports), least=True)) - self.joints.size
        return self.supports.number[place] if place >= 0 else 0

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
    def support_damage(self) -> Array:
        """Share of each part in the damage of the bearing of each support that has one, array (b, m)."""
        if self.supports is None:
            return np.zeros((len(self.parts), 0))
        return np.matrix_transpose(damage_shares(np.matrix_transpose(self.supports.loads.life), self.share))

    @property
    def first_damage(self) -> Array:
        """Share of each part in the damage of the joint or support that fails first, array (b,)."""
        if self.supports is not None and self.governing_support:
            found: Array = self.support_damage[:, self.supports.number.index(self.governing_support)]
            return found
        return self.damage[:, self.governing - 1]

    @property
    def equivalent_torque(self) -> Array:
        """Constant torque that damages each joint as much at its mean speed times joint angle, array (n,) [N·m]."""
        speed = np.asarray([part.speed for part in self.parts])
        more = np.asarray([part.shock_factor for part in self.parts]) / self.shock_factor
        return equivalent_torque(self.torque.T * more, self.share, speed=speed, joint_angle=self.joint_angle.T)

    @property
    def speed_angle(self) -> Array:
        """Mean of speed times joint angle of each joint, array (n,) [rad²/s]."""
        speed = np.asarray([abs(part.speed or 0.0) for part in self.parts])
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
        """By which factor all loads may grow until the drive lasts just as long as demanded; nan without a demand."""
        if self.demanded is None:
            return math.nan
        joints = (self.joints / self.demanded) ** (1.0 / POWER)
        return float(np.nanmin(np.append(joints, (self.of_supports / self.demanded) ** (1.0 / ball_bearing.POWER))))

    def loaded(self, factor: ArrayLike) -> Array:
        """Return the life of every joint by the chosen method with all loads times a factor, array (f, n) [s].

        Parameters
        ----------
        factor : array (f,)
            Above zero.
        """
        return self.joints / np.asarray(factor, dtype=float)[:, None] ** POWER

    def supports_loaded(self, factor: ArrayLike) -> Array:
        """Return the life of every bearing of a support with all loads times a factor, array (f, m) [s].

        Parameters
        ----------
        factor : array (f,)
            Above zero.
        """
        return self.of_supports / np.asarray(factor, dtype=float)[:, None] ** ball_bearing.POWER
