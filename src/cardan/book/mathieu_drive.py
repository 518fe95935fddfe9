"""What Mathieu's equation says of a drive with elastic shafts, and the exact drive behind it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeAlias

import numpy as np
import scipy

from cardan.errors import CardanError, InputError, Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.mathieu import boundaries
from cardan.texts import _

# What Mathieu's equation says of a drive with elastic shafts: the book's parameters, put right.
#
# Two inertias at the ends, n joints, n + 1 springs and nothing heavy between them. The twist y between the ends obeys
# y'' + (a - 2q cos 2(φ + δ_0)) y = forcing. The book's q is half of what it should be: it lets the first joint turn
# evenly, where it is the common centre of inertia that does.

REPEATS = 200
"""Repetitions at most that find where a ray crosses a boundary."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MathieuReduction:
    """Parameters of Mathieu's equation of a drive with massless joints."""

    joint_angle: Array  # joint_angle, phase (n,) [rad]: α_k and ψ_k of the joints
    phase: Array  # (n,) [rad]
    springs: Array  # (n + 1,) [N·m/rad]: c_1 … c_(n+1), before, between and behind the joints
    first_inertia: float  # first_inertia, last_inertia [kg m²]: J_1, J_(n+1)
    last_inertia: float  # [kg m²]
    speed: float  # [rad/s]: mean speed ω_1

    @property
    def tau(self) -> Array:
        """c_k1 = tan²(α_k/2), array (n,)."""
        return np.tan(0.5 * self.joint_angle) ** 2

    @property
    def arms(self) -> Array:
        """c_k1 e^(2iψ̄_k), complex array (n,): what each joint adds to A + iB."""
        turned = np.concatenate(([0.0], np.cumsum(self.tau * np.sin(2.0 * self.phase))[:-1]))
        return np.asarray(self.tau * np.exp(2j * (self.phase - turned)))

    @property
    def lag(self) -> float:
        """Θ_n: by how much the output falls back from its start position on the mean [rad]."""
        return float(np.sum(self.tau * np.sin(2.0 * self.phase)))

    @property
    def forcing(self) -> complex:
        """A + iB = s_n1 e^(2iδ_1) [rad]."""
        return complex(np.sum(self.arms))

    @property
    def play(self) -> complex:
        """D + iF [rad/(N·m)]."""
        return complex(2.0 * np.sum(self.arms * np.cumsum(1.0 / self.springs)[:-1]))

    @property
    def amplitude(self) -> float:
        """s_n1 [rad]: the joints' sway of second order at the output, were the shafts rigid."""
        return abs(self.forcing)

    @property
    def forcing_phase(self) -> float:
        """δ_1 [rad]."""
        return float(0.5 * np.angle(self.forcing))

    @property
    def stiffness(self) -> float:
        """Stiffness c of all springs in a row [N·m/rad]."""
        return float(1.0 / np.sum(1.0 / self.springs))

    @property
    def inertia(self) -> float:
        """J_0 = J_1 J_(n+1)/(J_1 + J_(n+1)) [kg m²]."""
        return self.first_inertia * self.last_inertia / (self.first_inertia + self.last_inertia)

    @property
    def natural_frequency(self) -> float:
        """ω_e = √(c/J_0) [rad/s]."""
        return float(np.sqrt(self.stiffness / self.inertia))

    @property
    def a(self) -> float:
        """Parameter a = c/(J_0 ω_1²)."""
        return (self.natural_frequency / self.speed) ** 2

    @property
    def share(self) -> Array:
        """Share σ_k of the twist that lies before each joint, array (n,)."""
        return self.stiffness * np.cumsum(1.0 / self.springs)[:-1]

    @property
    def off_node(self) -> Array:
        """κ_k: where each joint stands from the node of the elastic mode, a share of the twist, array (n,)."""
        return self.share - self.last_inertia / (self.first_inertia + self.last_inertia)

    @property
    def wave(self) -> complex:
        """Phasor q e^(2iδ_0) as it should be."""
        return complex(2.0 * self.a * np.sum(self.arms * self.off_node))

    @property
    def q(self) -> float:
        """Parameter q as it should be: twice the book's."""
        return abs(self.wave)

    @property
    def q_book(self) -> float:
        """Parameter q by Book (196)."""
        return 0.5 * abs(self.wave)

    @property
    def wave_phase(self) -> float:
        """δ_0 [rad]."""
        return float(0.5 * np.angle(self.wave))

    def zone_speeds(self, zone: int = 1) -> tuple[float, float]:
        """Return the speeds between which steady running is unstable without damping [rad/s].

        zone: 1 is the principal zone, about ω_e; zone r lies about ω_e/r.
        Another speed moves (a, q) along the ray through the origin: a = a_r(q), b_r(q) with q = a (q/a), found by
        repetition.
        """
        return zone_speeds(self.natural_frequency, self.q / self.a, zone)


def zone_speeds(natural_frequency: float, slope: float, zone: int = 1) -> tuple[float, float]:
    """Return the speeds between which a mode is unstable without damping [rad/s], the slower one first.

    natural_frequency [rad/s]; slope: q/a, the same at all speeds; zone: zone r lies about the natural frequency over r.
    """
    ends = []
    for which in (0, 1):
        a = float(zone * zone)
        for _round in range(REPEATS):
            before, a = a, float(boundaries(slope * a, zone)[which][-1])
            if abs(a - before) <= 1e-14 * a:
                break
        ends.append(natural_frequency / np.sqrt(a))
    return float(ends[0]), float(ends[1])


def mathieu_reduction(
    joint_angle: ArrayLike,
    phase: ArrayLike,
    springs: ArrayLike,
    *,
    first_inertia: float,
    last_inertia: float,
    speed: float,
) -> MathieuReduction:
    """Return the parameters of Mathieu's equation of a drive with massless joints between two inertias.

    Parameters
    ----------
    joint_angle, phase : arrays (n,) [rad]
        α_k and ψ_k of the joints.
    springs : array (n + 1,) [N·m/rad]
        c_1 … c_(n+1).
    first_inertia, last_inertia : float [kg m²]
        J_1, J_(n+1).
    speed : float [rad/s]
        Mean speed ω_1.

    Returns
    -------
    MathieuReduction

    Raises
    ------
    InputError
        Lists that do not fit one another, bends outside [0°, 90°), values that are not positive.

    Notes
    -----
    Book (195), (196): A + iB = Σ c_k1 e^(2iψ̄_k), ψ̄_k = ψ_k - Θ_(k-1), c_k1 = tan²(α_k/2). The book's X and Y come to
    q_book e^(2iδ_0) = a Σ c_k1 κ_k e^(2iψ̄_k) with κ_k = Σ_{i≤k} c/c_i - J_(n+1)/(J_1 + J_(n+1)); q is twice that.
    A joint in the node of the elastic mode, κ_k = 0, gives nothing to q. Of first order in c_k1, the static twist
    neglected.

    Examples
    --------
    >>> from cardan.units import deg, rpm
    >>> values = {"first_inertia": 1.0, "last_inertia": 0.4, "speed": 500 * rpm}
    >>> found = mathieu_reduction([20 * deg], [0.0], [1000.0, 4000.0], **values)
    >>> print(f"{found.a:.4f} {found.q_book:.5f} {found.q:.5f} {found.off_node}")
    1.0213 0.01633 0.03266 [0.51428571]
    """
    alpha, psi, springs = (np.atleast_1d(np.asarray(value, dtype=float)) for value in (joint_angle, phase, springs))
    check(
        [
            *([] if alpha.size else [Problem("joint_angle", _("an empty list has no joint"))]),
            *_fits("phase", psi.size, alpha.size),
            *_fits("springs", springs.size, alpha.size + 1),
            *_within(
                "joint_angle", alpha, (alpha >= 0.0) & (alpha < 0.5 * np.pi), _("a joint angle lies in [0°, 90°)")
            ),
            *_within("phase", psi, np.isfinite(psi), _("needs to be finite")),
            *_within("springs", springs, (springs > 0.0) & np.isfinite(springs), _("needs to be positive")),
            *(
                Problem(name, _("needs to be positive"))
                for name, value in (("first_inertia", first_inertia), ("last_inertia", last_inertia), ("speed", speed))
                if not (np.isfinite(value) and value > 0.0)
            ),
        ]
    )
    return MathieuReduction(
        joint_angle=alpha,
        phase=psi,
        springs=springs,
        first_inertia=float(first_inertia),
        last_inertia=float(last_inertia),
        speed=float(speed),
    )


def _fits(name: str, given: int, wanted: int) -> list[Problem]:
    text = _("{given} values given, {wanted} needed")
    return [] if given == wanted else [Problem(name, text.format(given=given, wanted=wanted))]


def _within(name: str, values: Array, right: Array, text: str) -> list[Problem]:
    return [
        Problem(f"{name}[{k}]", _("{value:g} given; {text}").format(value=values[k], text=text))
        for k in np.flatnonzero(~right)
    ]


# The exact drive behind Mathieu's equation: its steady motion and stability.
#
# Two inertias with springs and massless joints between them: the angles between follow from those of the ends by the
# balance of torques.

ROUNDS = 12
"""Steps of Newton's method at most."""

RESTS = 1e-13
"""Change of an angle at which the joints are in balance [rad], a share of one and the angle."""

CLOSED = 1e-11
"""How far the ends of a steady motion may be apart [rad]."""

LEAST_STEP = 1 / 32
"""Smallest step of the joint angle by which a steady motion is followed up, or of the twist by which a balance is, a
share of the whole."""

FAR = 0.5
"""A motion further than this from where it is looked for is another one [rad, or a share of the speed]."""

FROM_AFAR = 0.4
"""How far off, a share of the speed, a motion in resonance is looked for first."""

TOLERANCE = 1e-12
"""Error of a step of the integration."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Balance:
    """What lies between the two inertias at an instant."""

    yokes: tuple[float, ...]  # tuple of n floats [rad]: angles of the driving yokes
    torques: tuple[float, ...]  # tuple of n + 1 floats [N·m]: torques in the springs, positive when they carry power on
    # tuple of 3 floats [N·m/rad]: K_11, K_12, K_22: derivatives of the torques that hold the two inertias
    stiffness: tuple[float, float, float]


_Held: TypeAlias = tuple[list[float], list[tuple[float, float, float]], list[float], list[float], list[float]]


def _angle_error(theta: float, tau: float) -> float:
    return theta + math.atan2(tau * math.sin(2.0 * theta), 1.0 - tau * math.cos(2.0 * theta))


def _law(angle: float, joint: tuple[float, float, float, float, float]) -> tuple[float, float, float]:
    """Return the output angle of a joint and its first two derivatives by the input angle."""
    tau, cos, sin2, psi, start = joint
    theta = angle + psi
    under = 1.0 - sin2 * math.cos(theta) ** 2
    return _angle_error(theta, tau) - start, cos / under, -cos * sin2 * math.sin(2.0 * theta) / under**2


def _solved(pivots: list[float], beside: list[float], right: list[float]) -> list[float]:
    """Return the solution of a symmetric tridiagonal system that is eliminated already."""
    n = len(pivots)
    x = list(right)
    for k in range(1, n):
        x[k] -= beside[k] / pivots[k - 1] * x[k - 1]
    x[-1] /= pivots[-1]
    for k in range(n - 2, -1, -1):
        x[k] = (x[k] - beside[k + 1] * x[k + 1]) / pivots[k]
    return x


def _snapped() -> InputError:
    return refuse("torque", _("the torque snaps a joint through: no stable balance of the joints is left"))


@dataclass(frozen=True, eq=False, kw_only=True)
class MasslessDrive:
    """Two inertias with springs and massless joints between them."""

    reduction: MathieuReduction  # the drive's numbers
    torque: float = 0.0  # [N·m]: constant drive torque on the first inertia; the last one is held back by the same

    @cached_property
    def _joints(self) -> tuple[tuple[float, float, float, float, float], ...]:
        """Return τ, cos α, sin²α, ψ and the lead at the start of each joint, as plain numbers."""
        found = []
        for alpha, psi, tau in zip(self.reduction.joint_angle, self.reduction.phase, self.reduction.tau, strict=True):
            start = _angle_error(float(psi), float(tau))
            found.append((float(tau), math.cos(alpha), math.sin(alpha) ** 2, float(psi), start))
        return tuple(found)

    @cached_property
    def _springs(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        return tuple(map(float, self.reduction.springs)), tuple(map(float, self.reduction.share))

    def balance(self, first: float, last: float) -> Balance:
        """Return angles and torques between the inertias, and how stiff they hold together.

        first, last [rad]: angles of the two inertias.
        c_k (F_(k-1) - f_k) = F_k' c_(k+1) (F_k - f_(k+1)) at each joint, by Newton's method; its matrix is tridiagonal
        and symmetric, and positive where the balance is stable. Where that fails the twist is raised from nought.
        """
        joints, (c, share) = self._joints, self._springs
        n = len(joints)
        angles, ahead = [first], first
        for k in range(n):  # as if the shafts were rigid
            angles.append(ahead)
            ahead = _law(ahead, joints[k])[0]
        angles.append(ahead)
        done, step = 0.0, 1.0
        while done < 1.0:
            moved = step * (last - ahead)
            tried = self._newton([one + by * moved for one, by in zip(angles, (0.0, *share, 1.0), strict=True)])
            if tried is not None:
                found, done, angles = tried, done + step, tried[0]
                step = min(2.0 * step, 1.0 - done)
            elif step > LEAST_STEP:
                step *= 0.5
            else:
                raise _snapped()
        angles, laws, torque, pivots, beside = found
        one = _solved(pivots, beside, [c[0]] + [0.0] * (n - 1))
        pull = c[n] * laws[-1][1]
        two = _solved(pivots, beside, [0.0] * (n - 1) + [pull])
        stiffness = (c[0] - c[0] * one[0], -pull * one[-1], c[n] - pull * two[-1])
        return Balance(yokes=tuple(angles[1:-1]), torques=tuple(torque), stiffness=stiffness)

    def _newton(self, angles: list[float]) -> _Held | None:
        """Return the balance near some angles, None where Newton's method does not lead to a stable one."""
        c, joints = self._springs[0], self._joints
        n = len(joints)
        rests = RESTS * (1.0 + abs(angles[0]))
        moved = math.inf
        for _round in range(ROUNDS):
            laws = [_law(angles[k + 1], joints[k]) for k in range(n)]
            torque = [c[0] * (angles[0] - angles[1])]
            torque += [c[k + 1] * (laws[k][0] - angles[k + 2]) for k in range(n)]
            pivots: list[float] = []
            beside = [0.0]
            for k, (_out, slope, bent) in enumerate(laws):
                direct = c[k] + c[k + 1] * slope * slope + torque[k + 1] * bent
                pivots.append(direct - beside[k] ** 2 / pivots[k - 1] if k else direct)
                beside.append(-c[k + 1] * slope)
                if pivots[k] <= 0.0:
                    return None
            if moved < rests:
                return angles, laws, torque, pivots, beside
            step = _solved(pivots, beside, [torque[k] - laws[k][1] * torque[k + 1] for k in range(n)])
            moved = max(map(abs, step))
            angles = [angles[0], *(angle + one for angle, one in zip(angles[1:-1], step, strict=True)), angles[-1]]
        return None

    def _rate(self, _angle: float, y: Array) -> Array:
        """Return the derivative by the mean angle φ of ends, speeds over Ω, and the course of small changes."""
        first, last, w1, w2 = y[:4]
        red = self.reduction
        square = red.speed**2
        found = self.balance(float(first), float(last))
        one, two = 1.0 / (red.first_inertia * square), 1.0 / (red.last_inertia * square)
        k11, k12, k22 = found.stiffness
        out = np.empty(20)
        out[:4] = w1, w2, one * (self.torque - found.torques[0]), two * (found.torques[-1] - self.torque)
        out[4:12] = y[12:]
        out[12:16] = -one * (k11 * y[4:8] + k12 * y[8:12])
        out[16:] = -two * (k12 * y[4:8] + k22 * y[8:12])
        return out

    def half_turn(self, start: Array) -> tuple[Array, Array]:
        """Return the state (4,) half a turn on, and its derivatives (4, 4) by the state before.

        start (4,): angles of the two inertias [rad], their speeds over the mean speed.
        """
        begin = np.concatenate((start, np.eye(4).ravel()))
        scale = max(1.0, float(np.max(np.abs(start))))
        found = scipy.integrate.solve_ivp(
            self._rate, (0.0, np.pi), begin, method="DOP853", rtol=TOLERANCE, atol=1e-2 * TOLERANCE * scale
        )
        return found.y[:4, -1], found.y[4:, -1].reshape(4, 4)


@dataclass(frozen=True, eq=False, kw_only=True)
class SteadyTwist:
    """Steady motion of a drive with massless joints."""

    drive: MasslessDrive
    # (4,): angles of the two inertias [rad] and their speeds over the mean speed, where the first angle is zero
    start: Array
    monodromy: Array  # (4, 4): what becomes of a small change over half a turn
    gap: float  # [rad]: how far the motion is from closing

    @property
    def half_trace(self) -> float:
        """½(ρ + 1/ρ) of the elastic pair of multipliers: ½(tr P - 2); the other pair is 1, 1."""
        return 0.5 * (float(np.trace(self.monodromy)) - 2.0)

    @property
    def residual(self) -> float:
        """How far the determinant of the monodromy matrix is from 1: a check, as nothing damps."""
        return abs(float(np.linalg.det(self.monodromy)) - 1.0)


def steady_twist(reduction: MathieuReduction, torque: float = 0.0) -> SteadyTwist:
    """Return the exact steady motion of a drive with massless joints, and its stability.

    Parameters
    ----------
    reduction : MathieuReduction
        The drive; its speed is the mean speed of the motion.
    torque : float [N·m]
        Constant drive torque on the first inertia, and load on the last.

    Returns
    -------
    SteadyTwist

    Raises
    ------
    InputError
        No steady motion is found from that of the straight drive, or the torque snaps a joint through.

    Notes
    -----
    Shooting over half a turn with Newton's method; derivatives by the variational equations, integrated beside the
    motion (Dormand and Prince, order 8). Where the first try fails the joint angle is raised from nought, then the
    speed changed from one well off.

    Examples
    --------
    >>> from cardan.book.mathieu_drive import mathieu_reduction
    >>> values = {"first_inertia": 1.0, "last_inertia": 0.4, "speed": np.sqrt(2800.0)}
    >>> found = steady_twist(mathieu_reduction([0.3], [0.0], [1000.0, 4000.0], **values))
    >>> print(f"{found.half_trace:.8f}")
    -1.00068073
    """
    if not np.isfinite(torque):
        raise refuse("torque", _("{value} is not a finite number").format(value=torque))
    for way in (_bent, _slowed, _sped):
        found = _followed(reduction, torque, way)
        if found is not None:
            return found
    raise refuse("speed", _("no steady motion is found, neither from the straight drive nor from other speeds"))


_Way: TypeAlias = Callable[[MathieuReduction, float], MathieuReduction]
"""From a drive and a share of the way to it to a drive on that way."""


def _bent(reduction: MathieuReduction, share: float) -> MathieuReduction:
    return replace(reduction, joint_angle=2.0 * np.arctan(np.sqrt(share * reduction.tau)))


def _slowed(reduction: MathieuReduction, share: float) -> MathieuReduction:
    return replace(reduction, speed=reduction.speed * (1.0 + FROM_AFAR * (1.0 - share)))


def _sped(reduction: MathieuReduction, share: float) -> MathieuReduction:
    return replace(reduction, speed=reduction.speed / (1.0 + FROM_AFAR * (1.0 - share)))


def _followed(reduction: MathieuReduction, torque: float, way: _Way) -> SteadyTwist | None:
    """Return the steady motion followed up along a way: at once if that works, else from its beginning."""
    found = _closed(reduction, torque, _straight(reduction, torque)) if way is _bent else None
    reached, step = 0.0, 0.5
    begin = way(reduction, 0.0)
    at = _straight(begin, torque)
    if found is None and way is not _bent:
        first = _closed(begin, torque, at)
        if first is None:
            return None
        at = first.start
    while found is None:
        share = min(1.0, reached + step)
        tried = _closed(way(reduction, share), torque, at)
        if tried is not None:
            reached, at = share, tried.start
            found = tried if share == 1.0 else None
        elif step < LEAST_STEP:
            break
        else:
            step *= 0.5
    return found


def _straight(reduction: MathieuReduction, torque: float) -> Array:
    """Return where the drive would be, were its joints straight but for their mean lag."""
    return np.asarray([0.0, -torque / reduction.stiffness - reduction.lag, 1.0, 1.0])


def _closed(reduction: MathieuReduction, torque: float, start: Array) -> SteadyTwist | None:
    """Return the steady motion near a start, None where Newton's method does not find one."""
    drive = MasslessDrive(reduction=reduction, torque=torque)
    before, begin = np.inf, start
    for _round in range(ROUNDS - 4):
        try:
            end, change = drive.half_turn(start)
        except CardanError:
            return None
        rest = end - start - np.asarray([np.pi, np.pi, 0.0, 0.0])
        gap = float(np.max(np.abs(rest)))
        if np.max(np.abs(start - begin)) > FAR:
            return None
        if gap < CLOSED or (gap < 1e3 * CLOSED and gap > 0.5 * before):
            return SteadyTwist(drive=drive, start=start, monodromy=change, gap=gap)
        if not np.isfinite(gap) or gap > 1e3 * max(1.0, before):
            return None
        before = gap
        step = np.linalg.lstsq((change - np.eye(4))[:, 1:], -rest, rcond=1e-13)[0]
        start = start + np.concatenate(([0.0], step))
    return None
