"""How do two shafts joined by a Hooke joint move when the first is cracked and both are out of balance?

A motor drives the first disc through a shaft that twists; the joint makes the second disc turn unevenly; both discs
hang on shafts that bend.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from cardan.errors import Problem, check
from cardan.formulas.run_up import Progress, bad_times, instants, negative, not_finite, not_positive
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import mobius
from cardan.maths.periodic.turning_spring import energy_slope, pull
from cardan.texts import _

from .cracked_rotor import GRAVITY, UNCRACKED, Crack
from .cracked_run import fitted_orders, followed, longest_step


@dataclass(frozen=True, kw_only=True, slots=True)
class WhirlingShaft:
    """A disc on a shaft that bends, out of balance.

    Attributes
    ----------
    mass : float [kg]
        M of the disc, without the mass that unbalances it.
    stiffness : float [N/m]
        k of the sound shaft at the disc.
    inertia : float [kg·m²]
        J of the disc about its axis.
    damping : float [N·s/m]
        c of the bending.
    unbalance_mass : float [kg]
        u.
    unbalance_radius : float [m]
        e, at the angle of the disc.
    unbalance_angle : float [rad]
        Of the unbalance from the mark of the disc, its driving yoke.
    crack : Crack
        Of the shaft; none by default.
    crack_angle : float [rad]
        Of the crack's direction from the mark of the disc.
    """

    mass: float
    stiffness: float
    inertia: float
    damping: float = 0.0
    unbalance_mass: float = 0.0
    unbalance_radius: float = 0.0
    unbalance_angle: float = 0.0
    crack: Crack = UNCRACKED
    crack_angle: float = 0.0

    @property
    def whole(self) -> float:
        """Mass of disc and unbalance [kg]."""
        return self.mass + self.unbalance_mass

    @property
    def unbalance(self) -> float:
        """Mass times radius of the unbalance [kg·m]."""
        return self.unbalance_mass * self.unbalance_radius

    def elastic(self, deflection: Any, edge: Any) -> tuple[Any, Any]:
        """Return the elastic force [N], complex, and the moment about the axis [N·m] that a turn works against.

        deflection (...) [m], complex: of the disc; edge (...): e^(iθ) of the crack's direction.
        """
        opened, slope = self.crack.opening(edge)
        lateral = self.stiffness * pull(deflection, edge, opened, self.crack.losses)
        return lateral, self.stiffness * energy_slope(deflection, edge, opened, slope, self.crack.losses)


@dataclass(frozen=True, eq=False, kw_only=True)
class CrackedShafts:
    """Motion in time of two shafts joined by a Hooke joint, X down, Y 90° ahead in the sense of rotation."""

    joint_angle: float  # [rad]: α
    phase: float  # [rad]: ψ of the driving yoke at the start
    speed: float  # [rad/s]: Ω of the motor
    crack: Crack  # on the first shaft; open side down where its angle and that of the crack add up to 0
    time: Array  # (t,) [s]: instants
    angle: Array  # (t, 2) [rad]: θ_1, θ_2 of the discs
    rate: Array  # (t, 2) [rad/s]: their speeds
    deflection: Array  # (t, 2) [m], complex: X + iY of the discs
    velocity: Array  # (t, 2) [m/s], complex: its rates
    torque: Array  # (t,) [N·m]: of the motor on the first disc
    energy: Array  # (t,) [J]: of motion, springs and weight
    # how much of the energy is missing or too much at an instant, over the largest change of kinetic, elastic or
    # supplied energy
    residual: float
    cancelled: bool = False  # whether ``progress`` stopped the run; the curves end there

    def orders(self, shaft: int, *, turns: int = 8, reach: int = 4, parts: int = 1) -> tuple[Array, Array]:
        """Return orders (N,) and amplitudes [m] (N,), complex, of a shaft's whirling in the last turns.

        shaft: 0 or 1; its own angle counts.
        turns: how many of the last whole turns; fewer where there are no more.
        parts: 2 for half orders too.
        Least squares of Σ Z_n e^(inθ), each instant with its share of the angle.
        """
        return fitted_orders(self.angle[:, shaft], self.deflection[:, shaft], turns=turns, reach=reach, parts=parts)


def cracked_shafts(
    first: WhirlingShaft,
    second: WhirlingShaft,
    joint_angle: float,
    speed: float,
    end: float,
    *,
    phase: float = 0.0,
    crack: Crack | None = None,
    drive_stiffness: float,
    drive_damping: float = 0.0,
    gravity: float = GRAVITY,
    time: ArrayLike | None = None,
    progress: Progress | None = None,
) -> CrackedShafts:
    """Return the motion of two unbalanced shafts joined by a Hooke joint, any of them cracked.

    Parameters
    ----------
    first, second : WhirlingShaft
        The driving and the driven one.
    joint_angle : float [rad]
        α in [0, π/2).
    speed : float [rad/s]
        Ω of the motor, positive.
    end : float [s]
        Until when.
    phase : float [rad]
        ψ, angle of the driving yoke from the plane of the shafts at the start.
    crack : Crack, optional
        Of the first shaft, in place of its own.
    drive_stiffness : float [N·m/rad]
        K_1T between motor and first disc.
    drive_damping : float [N·m·s/rad]
        C_1T.
    gravity : float [m/s²]
        g.
    time : array (t,), optional [s]
        Instants of the curves, up to the end; evenly by default. The start is always among them.
    progress : function, optional
        Told the share done; when it answers "stop" the run ends.

    Returns
    -------
    CrackedShafts

    Raises
    ------
    InputError
        Values out of range, times out of the run, or a run of too many steps.

    Notes
    -----
    Lagrange's equations of the article's model (6)-(25), restored: θ_2 = T(θ_1 + ψ) - T(ψ) with the exact joint T. The
    run starts at θ_1 = 0 with the speed Ω, the discs at rest where their weight bends the sound shafts. Lateral
    accelerations are eliminated, which leaves one equation in θ̈_1. The account of energy is the check.

    Examples
    --------
    >>> one = WhirlingShaft(mass=0.617, stiffness=18875.0, inertia=6e-4, damping=4.0)
    >>> found = cracked_shafts(one, one, 0.1, 80.0, 0.1, crack=Crack(loss_xi=0.1, loss_eta=0.02), drive_stiffness=120.0)
    >>> print(f"{1e6 * found.deflection[-1, 0].real:.1f} μm", found.residual < 1e-9)
    291.5 μm True
    """
    positive = {"speed": speed, "end": end, "drive_stiffness": drive_stiffness}
    others = {"drive_damping": drive_damping, "gravity": gravity}
    problems = _problems((first, second), positive, others, joint_angle)
    problems += not_finite({"phase": phase})
    check(problems + ([] if time is None else bad_times(time, end)))
    first = first if crack is None else replace(first, crack=crack)
    model = _Model(
        shafts=(first, second),
        joint_angle=float(joint_angle),
        phase=float(phase),
        speed=float(speed),
        drive=(float(drive_stiffness), float(drive_damping)),
        gravity=float(gravity),
    )
    sag = [one.whole * gravity / one.stiffness for one in (first, second)]
    free = [math.sqrt(one.stiffness / one.whole) for one in (first, second)]
    stiff = [math.sqrt(drive_stiffness / first.inertia), drive_damping / first.inertia]
    stiff += [one.damping / one.whole for one in (first, second)]
    breathing = max(first.crack.breathing, second.crack.breathing)
    uneven = speed * max(2.0 / math.cos(joint_angle), math.sqrt(1.0 + breathing))
    at = np.sort(instants(time, end, max(*free, speed) / (2.0 * math.pi)))
    grid = np.union1d(0.0, at)
    states, cancelled = followed(
        model.rates(),
        np.array([0.0, speed, sag[0], 0.0, sag[1], 0.0, *([0.0] * 5)]),
        grid,
        np.array([1e-12, 1e-12 * speed, *([1e-15] * 4), *([1e-15 * max(free)] * 4), 1e-13]),
        longest_step(*free, *stiff, uneven),
        progress,
    )
    return model.result(grid[: len(states)], states, cancelled)


def _problems(
    shafts: tuple[WhirlingShaft, WhirlingShaft],
    positive: dict[str, float],
    others: dict[str, float],
    joint_angle: float,
) -> list[Problem]:
    """Return what is wrong with the numbers."""
    problems = not_positive(positive)
    for name, shaft in zip(("first", "second"), shafts, strict=True):
        problems += not_positive({f"{name}.{key}": getattr(shaft, key) for key in ("mass", "stiffness", "inertia")})
        others |= {f"{name}.{key}": getattr(shaft, key) for key in ("damping", "unbalance_mass", "unbalance_radius")}
    if not 0.0 <= joint_angle < 0.5 * math.pi:
        problems.append(Problem("joint_angle", _("needs to be at least 0 and below 90°"), "out_of_range"))
    return problems + negative(others)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Model:
    """The equations; a state is θ, θ̇, x and y of both discs, their rates, and the energy brought in."""

    shafts: tuple[WhirlingShaft, WhirlingShaft]
    joint_angle: float
    phase: float
    speed: float
    drive: tuple[float, float]
    gravity: float

    def rates(self) -> Callable[[float, Array], Array]:
        """Return the function from time and state to the rates of the state."""
        (one, two), (spring, damper), g, motor = self.shafts, self.drive, self.gravity, self.speed
        turned = [(cmath.exp(1j * one.unbalance_angle), cmath.exp(1j * one.crack_angle)) for one in self.shafts]
        a, b = (complex(part) for part in mobius.hooke(np.asarray(self.joint_angle)))
        share, size = b.conjugate() / a.conjugate(), abs(a) ** 2
        start, begin = cmath.exp(2j * self.phase), cmath.phase(1.0 + share * cmath.exp(2j * self.phase))
        out_1, out_2, whole_1, whole_2 = one.unbalance, two.unbalance, one.whole, two.whole
        solid_1 = one.inertia + out_1 * one.unbalance_radius - out_1**2 / whole_1
        solid_2 = two.inertia + out_2 * two.unbalance_radius

        def rate(time: float, state: Array) -> Array:
            theta, turning, x_1, y_1, x_2, y_2, vx_1, vy_1, vx_2, vy_2, _work = state.tolist()
            z_1, z_2, v_1, v_2 = complex(x_1, y_1), complex(x_2, y_2), complex(vx_1, vy_1), complex(vx_2, vy_2)
            unit = cmath.exp(1j * theta)
            kernel = 1.0 + share * start * unit * unit
            ratio = 1.0 / (size * (kernel.real**2 + kernel.imag**2))
            bent = 4.0 * size * kernel.imag * ratio * ratio
            other = cmath.exp(1j * (theta - cmath.phase(kernel) + begin))
            arm_1, edge_1, arm_2, edge_2 = (
                at * by for at, pair in zip((unit, other), turned, strict=True) for by in pair
            )
            square = turning * turning
            lateral_1, about_1 = one.elastic(z_1, edge_1)
            lateral_2, about_2 = two.elastic(z_2, edge_2)
            force_1 = out_1 * square * arm_1 + whole_1 * g - one.damping * v_1 - lateral_1
            force_2 = out_2 * square * (ratio * ratio - 1j * bent) * arm_2 + whole_2 * g - two.damping * v_2 - lateral_2
            twist, slip = motor * time - theta, motor - turning
            moment = (
                spring * twist
                + damper * slip
                - about_1
                - ratio * about_2
                - g * (out_1 * arm_1.imag + out_2 * ratio * arm_2.imag)
                - solid_2 * ratio * bent * square
            )
            # Sideways accelerations, force - out θ̈ along the tangent, put into the balance of moments.
            along_1 = (force_1 * (1j * arm_1).conjugate()).real / whole_1
            along_2 = (force_2 * (1j * arm_2).conjugate()).real / whole_2
            inertia = solid_1 + (solid_2 - out_2**2 / whole_2) * ratio * ratio
            rise = (moment - out_1 * along_1 - out_2 * ratio * along_2) / inertia
            a_1 = (force_1 - out_1 * rise * 1j * arm_1) / whole_1
            a_2 = (force_2 - out_2 * ratio * rise * 1j * arm_2) / whole_2
            brought = (
                (spring * twist + damper * slip) * motor
                - damper * slip * slip
                - one.damping * abs(v_1) ** 2
                - two.damping * abs(v_2) ** 2
            )
            return np.array([turning, rise, vx_1, vy_1, vx_2, vy_2, a_1.real, a_1.imag, a_2.real, a_2.imag, brought])

        return rate

    def result(self, time: Array, states: Array, cancelled: bool) -> CrackedShafts:
        """Return the curves, and the account of energy."""
        theta, turning = states[:, 0], states[:, 1]
        pair, shift = mobius.hooke(np.asarray(self.joint_angle)), np.exp(2j * self.phase)
        angle_error, ratio, _slope = mobius.course(pair, shift * np.exp(2j * theta))
        second = theta + angle_error - mobius.angle_error(pair, np.asarray(shift))
        angle, rate = np.column_stack((theta, second)), np.column_stack((turning, ratio * turning))
        z, v = (states[:, k : k + 4 : 2] + 1j * states[:, k + 1 : k + 4 : 2] for k in (2, 6))
        kinetic, elastic, weight = np.zeros(time.size), np.zeros(time.size), np.zeros(time.size)
        for k, one in enumerate(self.shafts):
            arm = np.exp(1j * (angle[:, k] + one.unbalance_angle))
            lateral, _about = one.elastic(z[:, k], np.exp(1j * (angle[:, k] + one.crack_angle)))
            at_mass = v[:, k] + 1j * one.unbalance_radius * rate[:, k] * arm
            kinetic += 0.5 * one.inertia * rate[:, k] ** 2 + 0.5 * one.mass * np.abs(v[:, k]) ** 2
            kinetic += 0.5 * one.unbalance_mass * np.abs(at_mass) ** 2
            elastic += 0.5 * np.real(np.conj(z[:, k]) * lateral)
            weight -= self.gravity * (one.whole * z[:, k].real + one.unbalance * arm.real)
        twist = self.speed * time - theta
        elastic += 0.5 * self.drive[0] * twist**2
        total, brought = kinetic + elastic + weight, states[:, -1]
        changes = [float(np.max(np.abs(one - one[0]))) for one in (kinetic, elastic, brought)]
        missing = float(np.max(np.abs(total - total[0] - brought)))
        scale = max(*changes, 1e-6 * float(kinetic[0]))
        return CrackedShafts(
            joint_angle=self.joint_angle,
            phase=self.phase,
            speed=self.speed,
            crack=self.shafts[0].crack,
            time=time,
            angle=angle,
            rate=rate,
            deflection=z,
            velocity=v,
            torque=self.drive[0] * twist + self.drive[1] * (self.speed - turning),
            energy=total,
            residual=missing / scale,
            cancelled=cancelled,
        )
