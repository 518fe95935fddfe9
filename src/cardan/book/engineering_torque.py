"""What torque does the last shaft take? The book's engineering formulas, and Mathieu's equation solved beside them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.mathieu_forced import forced
from cardan.texts import _

from .dynamic_book import TOO_FAR
from .mathieu_reduction import MathieuReduction


@dataclass(frozen=True, eq=False, kw_only=True)
class EngineeringTorque:
    """Torque in the last shaft by Book (246), the parametric term neglected."""

    mean: float  # [N·m]: its mean, without sign
    order2: float  # [N·m]: amplitude of second order, from the joints
    drive: Array  # drive, load (m,) [N·m]: amplitudes of the orders of the drive torque and of the load
    load: Array  # (m,) [N·m]
    speed: float  # [rad/s]: ω_1 that belongs to a


def engineering_torque(
    *,
    stiffness: float,
    amplitude: float,
    a: float,
    first_inertia: float,
    last_inertia: float,
    mean: float,
    drive_order: ArrayLike = (),
    drive_torque: ArrayLike = (),
    load_order: ArrayLike = (),
    load_torque: ArrayLike = (),
) -> EngineeringTorque:
    """Return the torque in the last shaft by the book's formula for sizing.

    Parameters
    ----------
    stiffness : float [N·m/rad]
        c of all springs in a row.
    amplitude : float [rad]
        s_n1 of the joints.
    a : float
        (ω_e/ω_1)².
    first_inertia, last_inertia : float [kg m²]
        J_1, J_(n+1).
    mean : float [N·m]
        Mean torque.
    drive_order, load_order : arrays (m,)
        Orders of the harmonics per turn of shaft 1.
    drive_torque, load_torque : arrays (m,) [N·m]
        Their amplitudes, on J_1 and on J_(n+1).

    Returns
    -------
    EngineeringTorque

    Raises
    ------
    InputError
        a is not positive, or an order is in resonance.

    Notes
    -----
    Book (246): 4cs/\\|a - 4\\| of the joints, (J_0/J_1) M_k a/\\|a - k²ξ²\\| of each harmonic of the drive, J_0/J_(n+1)
    for those of the load. For sizing, not for proof: first order in tan²(α/2), no damping, no inertia between the ends.

    Examples
    --------
    >>> found = engineering_torque(stiffness=900.0, amplitude=0.0513, a=0.774, first_inertia=2.0, last_inertia=0.64,
    ...                            mean=150.0, drive_order=[6.8], drive_torque=[72.0])
    >>> print(f"{found.order2:.3f} {found.drive[0]:.4f} {found.speed:.3f}")
    57.247 0.2971 48.972
    """
    orders = {"drive_order": np.asarray(drive_order, dtype=float), "load_order": np.asarray(load_order, dtype=float)}
    text = _("order {order:g} is in resonance: without damping nothing bounds the torque")
    positive = {"a": a, "stiffness": stiffness, "first_inertia": first_inertia, "last_inertia": last_inertia}
    check(
        [
            *(Problem(name, _("needs to be positive")) for name, value in positive.items() if not value > 0.0),
            *([Problem("a", text.format(order=2.0))] if a == 4.0 and amplitude else []),
            *(
                Problem(f"{name}[{k}]", text.format(order=value))
                for name, values in orders.items()
                for k, value in enumerate(values)
                if value * value == a
            ),
        ]
    )
    inertia = first_inertia * last_inertia / (first_inertia + last_inertia)
    drive, load = (
        np.abs(np.asarray(torque, dtype=float)) * inertia / own * a / np.abs(a - orders[name] ** 2)
        for name, torque, own in (
            ("drive_order", drive_torque, first_inertia),
            ("load_order", load_torque, last_inertia),
        )
    )
    order2 = 4.0 * stiffness * abs(amplitude) / abs(a - 4.0) if amplitude else 0.0
    speed = float(np.sqrt(stiffness / (inertia * a)))
    return EngineeringTorque(mean=abs(mean), order2=order2, drive=drive, load=load, speed=speed)


@dataclass(frozen=True, eq=False, kw_only=True)
class TorqueCourse:
    """Torque in the last shaft over a turn, by the book's formulas and solved; positive as it carries power on."""

    angle: Array  # (p,) [rad]: φ of shaft 1, its mean
    simple: Array  # (p,) [N·m]: Book (246): the parametric term neglected
    book: Array  # (p,) [N·m]: Book (245) with y solved for the book's q
    solved: Array  # (p,) [N·m]: with y solved for the true q, the joints where the twist takes them

    @property
    def worst(self) -> float:
        """Largest difference of simple and solved, a share of the largest torque."""
        return float(np.max(np.abs(self.simple - self.solved)) / np.max(np.abs(self.solved)))

    @property
    def too_far(self) -> bool:
        """Whether the simplified torque misses the solved one by more than 5 %."""
        return self.worst > TOO_FAR


def torque_course(reduction: MathieuReduction, angle: ArrayLike, mean: float) -> TorqueCourse:
    """Return the torque in the last shaft over a turn, by the book's formulas and solved.

    Parameters
    ----------
    reduction : MathieuReduction
        The drive.
    angle : array (p,) [rad]
        φ.
    mean : float [N·m]
        Constant drive torque, and load.

    Returns
    -------
    TorqueCourse

    Raises
    ------
    InputError
        Order 0 or 2 is in resonance.

    Notes
    -----
    Book (196): y'' + (a - 2q cos 2(φ + δ_0)) y = Q_1 + a s sin 2(φ + δ_1), Q_1 = -mean/(J_0 ω_1²). (245): the torque
    -c (y - A sin 2φ - B cos 2φ)/(1 + cD cos 2φ - cF sin 2φ). In the solved form φ is the angle of the common centre of
    inertia, and cD, cF come from σ_k + κ_k instead of σ_k, as the twist moves the joints.

    Examples
    --------
    >>> from cardan.book.mathieu_reduction import mathieu_reduction
    >>> values = {"first_inertia": 1.0, "last_inertia": 0.4, "speed": 80.0}
    >>> red = mathieu_reduction([0.35], [0.0], [1000.0, 4000.0], **values)
    >>> found = torque_course(red, np.linspace(0.0, np.pi, 181), 40.0)
    >>> print(f"{np.ptp(found.simple):.2f} {np.ptp(found.solved):.2f} {found.too_far}")
    56.16 56.82 True
    """
    phi = np.asarray(angle, dtype=float)
    c, a, s = reduction.stiffness, reduction.a, reduction.amplitude
    constant = -mean / (reduction.inertia * reduction.speed**2)
    shift, angle_error = reduction.wave_phase, reduction.forcing_phase
    sway = (reduction.forcing * np.exp(2j * phi)).imag

    def twist(q: float) -> Array:
        phases = [0.5 * np.pi, 2.0 * (angle_error - shift)]
        found = forced(a, q, order=[0.0, 2.0], amplitude=[constant, a * s], phase=phases)
        return found.at(phi + shift)

    moved = 2.0 * np.sum(reduction.arms * (reduction.share + reduction.off_node))
    return TorqueCourse(
        angle=phi,
        simple=-c * (twist(0.0) - sway),
        book=-c * (twist(reduction.q_book) - sway) / (1.0 + c * (reduction.play * np.exp(2j * phi)).real),
        solved=-c * (twist(reduction.q) - sway) / (1.0 + (moved * np.exp(2j * phi)).real),
    )
