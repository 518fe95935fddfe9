"""How near do the classical approximations come? The book's series for a chain, and the rule of practice.

The exact motion needs none of this. It is here to be compared with, by name.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.models.kinematics_model import Chain
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real, unit_complex
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import TURN, initial_phases, motion
from cardan.texts import _

Amplitude: TypeAlias = Literal["quarter", "tau"]
"""Amplitude c_i1 of a joint: book's α²/4, or the exact tan²(α/2)."""

Phases: TypeAlias = Literal["exact", "mean", "without_theta"]
"""Which angles ν_i the series takes: ψ_i - Θ_{i-1} with exact ψ_i, mean phases Ψ_i, or ψ_i alone as in Book (90)."""

_Wave: TypeAlias = tuple[float, Array, Array]


@dataclass(frozen=True, eq=False, kw_only=True)
class BookSeries:
    """A chain's output angle as a short Fourier sum; leading axes are those of the drives."""

    constant: Array  # (...) [rad]: Θ_n
    a1: Array  # a1, b1 (...) [rad]: coefficients of sin 2φ_1 and cos 2φ_1
    b1: Array  # (...) [rad]
    a2: Array  # a2, b2 (...) [rad]: coefficients of sin 4φ_1 and cos 4φ_1; zero in the first order
    b2: Array  # (...) [rad]

    @property
    def amplitude(self) -> Array:
        """s_n1, array (...) [rad]; Book (70)."""
        xp = namespace(self.a1)
        return xp.hypot(self.a1, self.b1)

    @property
    def phase(self) -> Array:
        """δ_n1 of s_n1 sin 2(φ_1 + δ_n1), array (...) [rad]; Book (70)."""
        xp = namespace(self.a1)
        return 0.5 * xp.atan2(self.b1, self.a1)

    @property
    def speed_fluctuation(self) -> Array:
        """δ ≈ 4 s_n1, array (...); Book (80)."""
        return 4.0 * self.amplitude

    def angle_error(self, angle: ArrayLike) -> Array:
        """Return φ_{n+1} - φ_1 at input angles (p,) [rad], array (..., p) [rad]; Book (59), (63), (69), (71)."""
        one, two, phi, xp = self._waves(angle)
        return -self.constant[..., None] + sum(
            a[..., None] * xp.sin(k * phi) + b[..., None] * xp.cos(k * phi) for k, a, b in (one, two)
        )

    def ratio(self, angle: ArrayLike) -> Array:
        """Return ω_{n+1}/ω_1 at input angles (p,) [rad], array (..., p); Book (73)."""
        one, two, phi, xp = self._waves(angle)
        return 1.0 + sum(
            k * (a[..., None] * xp.cos(k * phi) - b[..., None] * xp.sin(k * phi)) for k, a, b in (one, two)
        )

    def slope(self, angle: ArrayLike) -> Array:
        """Return ε_{n+1}/ω_1² of uniform input at input angles (p,) [rad], array (..., p); Book (74)."""
        one, two, phi, xp = self._waves(angle)
        return -sum(k * k * (a[..., None] * xp.sin(k * phi) + b[..., None] * xp.cos(k * phi)) for k, a, b in (one, two))

    def _waves(self, angle: ArrayLike) -> tuple[_Wave, _Wave, Array, Any]:
        xp = namespace(self.a1, angle)
        return (2.0, self.a1, self.b1), (4.0, self.a2, self.b2), real(angle, xp), xp


def book_series(
    drive: Drive | Drives | Chain,
    order: Literal[1, 2] = 1,
    *,
    amplitude: Amplitude = "quarter",
    phases: Phases = "exact",
) -> BookSeries:
    """Return the classical series of a chain, of first or second order in the joints' amplitudes.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.
    order : 1 or 2
        2 adds the fourth harmonic of the turn and corrects Θ_n.
    amplitude : "quarter" or "tau"
        c_i1 = α_i²/4 as in the book, or tan²(α_i/2).
    phases : "exact", "mean" or "without_theta"
        What stands for ν_i. "mean" and "without_theta" are forms of the first order.

    Returns
    -------
    BookSeries
        arrays (...).

    Raises
    ------
    ValueError
        The second order with phases other than "exact".

    Notes
    -----
    Book (47)-(62), (69), (70); second order (63)-(68), (71), (72) with c_i2 = c_i1²/2, the sign of the b term in (64)
    put right and (67), (68) derived anew. With mean phases s_n1 e^(2iδ_n1) = Σ c_i1 e^(2iΨ_i), whatever the start.

    Examples
    --------
    >>> from cardan.units import deg
    >>> series = book_series(Drive.from_angles([12 * deg, 20 * deg]))
    >>> round(float(series.speed_fluctuation), 6)
    0.077982
    """
    if order == 2 and phases != "exact":
        raise ValueError("the second order takes exact phases")
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle)
    psi = mean_phases(chain) if phases == "mean" else initial_phases(chain)
    c = 0.25 * chain.joint_angle**2 if amplitude == "quarter" else xp.tan(0.5 * chain.joint_angle) ** 2
    zero = 0.0 * c[..., 0]
    theta, a1, b1, a2, b2 = zero, zero, zero, zero, zero
    for i in range(chain.joints):
        c1, angle = c[..., i], psi[..., i]
        c2 = 0.5 * c1 * c1
        nu = angle - theta if phases == "exact" else angle
        sine, cosine = xp.sin(2.0 * nu), xp.cos(2.0 * nu)
        theta = theta + c1 * xp.sin(2.0 * angle)
        if order == 2:
            theta = theta + c2 * xp.sin(4.0 * angle) + c1 * (a1 * sine - b1 * cosine)
            a2 = a2 + c2 * xp.cos(4.0 * nu) + c1 * (a1 * cosine - b1 * sine)
            b2 = b2 + c2 * xp.sin(4.0 * nu) + c1 * (a1 * sine + b1 * cosine)
        a1 = a1 + c1 * cosine
        b1 = b1 + c1 * sine
    return BookSeries(constant=b1 if phases == "mean" else theta, a1=a1, b1=b1, a2=a2, b2=b2)


def mean_phases(drive: Drive | Drives | Chain) -> Array:
    """Return the mean phases Ψ_i = ψ_1 + Σ_{k≤i} (π/2 - γ_k - β_k) of the joints, array (..., n) [rad]."""
    turn = kinematics(drive).turn_before
    xp = namespace(turn)
    sums = [turn[..., 0]]
    for i in range(1, turn.shape[-1]):
        sums.append(sums[-1] + turn[..., i])
    return xp.stack(sums, axis=-1)


def rule_of_practice(drive: Drive | Drives | Chain) -> Array:
    """Return the equivalent angle by the rule of practice, α_eq² ≈ |Σ α_i² e^(2iΨ_i)|; array (...) [rad].

    Notes
    -----
    For collinear phases this is the workshop's √\\|Σ ±α_i²\\|: + where the yokes of a joint stand as those of the first
    joint, - where they are a quarter turn off. First order in α²; `equivalent_joint` is exact.

    Examples
    --------
    >>> from cardan.units import deg
    >>> round(float(rule_of_practice(Drive.from_angles([12 * deg, 20 * deg])) / deg), 3)
    16.0
    """
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle)
    arms = chain.joint_angle**2 * unit_complex(2.0 * mean_phases(chain))
    return xp.sqrt(xp.abs(xp.sum(arms, axis=-1)))


def collinear_joint_angle(joint_angle: ArrayLike, sign: ArrayLike) -> Array:
    """Return the exact equivalent angle of joints with collinear phases, array (...) [rad].

    Parameters
    ----------
    joint_angle : array (..., n) [rad]
        α_i.
    sign : array (..., n)
        +1 where a joint works like the first one, -1 where it works against it.

    Notes
    -----
    cos α_eq = Π cos^{±1} α_i, or its inverse where that is above 1; no dearer than the rule of practice. Evaluated as
    α_eq = 2 atan √tanh(L/2) with L = |Σ ± ln cos α_i|, accurate for small angles.

    Examples
    --------
    >>> from cardan.units import deg
    >>> round(float(collinear_joint_angle([10 * deg, 20 * deg, 30 * deg], [1, -1, 1]) / deg), 3)
    24.824
    """
    xp = namespace(joint_angle, sign)
    length = xp.abs(xp.sum(real(sign, xp) * xp.log(xp.cos(real(joint_angle, xp))), axis=-1))
    return 2.0 * xp.atan(xp.sqrt(xp.tanh(0.5 * length)))


@dataclass(frozen=True, eq=False, kw_only=True)
class BookComparison:
    """Exact motion of the output beside the classical approximations; leading axes are those of the drives.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angle φ_1.
    exact, first_order, second_order : array (..., p) [rad]
        Angle error φ_{n+1} - φ_1: exact; Book (59) with c = α²/4; Book (63) with c = tan²(α/2).
    speed_fluctuation : array (...)
        δ, exact.
    speed_fluctuation_80 : array (...)
        δ ≈ 4 s_n1 by Book (80), exact phase angles.
    speed_fluctuation_mean_phases : array (...)
        The same with mean phases, independent of the start position.
    speed_fluctuation_without_theta : array (...)
        The same without Θ, as the book works in (90).
    joint_angle : array (...) [rad]
        Equivalent angle, exact.
    rule_of_practice : array (...) [rad]
        Equivalent angle √|Σ ±α_i²|.
    """

    angle: Array
    exact: Array
    first_order: Array
    second_order: Array
    speed_fluctuation: Array
    speed_fluctuation_80: Array
    speed_fluctuation_mean_phases: Array
    speed_fluctuation_without_theta: Array
    joint_angle: Array
    rule_of_practice: Array

    @property
    def worst_first_order(self) -> Array:
        """Largest error of the first order over the given angles, array (...) [rad]."""
        xp = namespace(self.exact)
        return xp.max(xp.abs(self.first_order - self.exact), axis=-1)

    @property
    def worst_second_order(self) -> Array:
        """Largest error of the second order over the given angles, array (...) [rad]."""
        xp = namespace(self.exact)
        return xp.max(xp.abs(self.second_order - self.exact), axis=-1)


def book_comparison(drive: Drive | Drives | Chain, angle: ArrayLike | None = None) -> BookComparison:
    """Return the exact angle error of the output beside the book's series, and what each says of the speed fluctuation.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.
    angle : array (p,) [rad], optional
        Input angle φ_1; one turn in steps of a degree by default.

    Returns
    -------
    BookComparison
        Curves (..., p) and numbers (...).

    See Also
    --------
    motion, extremes

    Notes
    -----
    The second order takes c = tan²(α/2): with α²/4 the neglected rest of the amplitude is itself of second order.

    Examples
    --------
    >>> from cardan import Drive
    >>> from cardan.methods import book_comparison
    >>> from cardan.units import deg
    >>> drive = Drive.from_angles([20 * deg, 15 * deg, 10 * deg])
    >>> seen = book_comparison(drive)
    >>> bool(seen.worst_second_order < seen.worst_first_order)
    True
    """
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle, angle)
    phi = xp.linspace(0.0, 2.0 * xp.pi, TURN, dtype=xp.float64) if angle is None else real(angle, xp)
    phi = phi if phi.ndim else phi[None]
    first = book_series(chain)
    joint = equivalent_joint(chain)
    return BookComparison(
        angle=phi,
        exact=motion(chain, phi).angle_error[..., -1, :],
        first_order=first.angle_error(phi),
        second_order=book_series(chain, 2, amplitude="tau").angle_error(phi),
        speed_fluctuation=joint.speed_fluctuation,
        speed_fluctuation_80=first.speed_fluctuation,
        speed_fluctuation_mean_phases=book_series(chain, phases="mean").speed_fluctuation,
        speed_fluctuation_without_theta=book_series(chain, phases="without_theta").speed_fluctuation,
        joint_angle=joint.joint_angle,
        rule_of_practice=rule_of_practice(chain),
    )


# The book's closed forms: Blokh's chain, and the double joint in the arrangements of Fig. 62.

Arrangement: TypeAlias = Literal["a", "b", "c", "d"]
"""Letter of a double joint in Fig. 62."""


@dataclass(frozen=True, eq=False, kw_only=True)
class OutputMotion:
    """Motion of the output shaft alone, over the input angle.

    Attributes
    ----------
    angle : array (p,) [rad]
        φ_1.
    angle_error : array (..., p) [rad]
        φ_{n+1} - φ_1, continuous over any number of turns.
    ratio : array (..., p)
        ω_{n+1}/ω_1.
    slope : array (..., p) [1/rad]
        Derivative of the ratio by φ_1; ε_{n+1}/ω_1² at uniform input.
    """

    angle: Array
    angle_error: Array
    ratio: Array
    slope: Array

    @property
    def output_angle(self) -> Array:
        """φ_{n+1}, array (..., p) [rad]."""
        return self.angle + self.angle_error


def blokh(drive: Drive | Drives | Chain, angle: ArrayLike) -> OutputMotion:
    """Return the output motion by Blokh's closed form, freed of its poles.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.
    angle : array (p,) [rad]
        Input angle φ_1 from the start position.

    Returns
    -------
    OutputMotion
        angle_error, ratio, slope : arrays (..., p).

    Notes
    -----
    Book (35)-(37) with every factor multiplied by cos² ψ_i, so that ψ_i = ±90° is as good as any other, and with the
    phase angles of (38) exact: tan φ_{n+1} = A sin φ_1/(B sin φ_1 + C cos φ_1). The lead stays within ±π, so the angle
    between the vectors (cos φ_1, sin φ_1) and (B sin φ_1 + C cos φ_1, A sin φ_1) is the lead itself, unwrapped.

    Examples
    --------
    >>> from cardan.units import deg
    >>> blokh(Drive.from_angles([30 * deg]), [0.0, 90 * deg]).ratio
    array([1.15470054, 0.8660254 ])
    """
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle, angle)
    phi = real(angle, xp)
    big_a, big_b, big_c = blokh_coefficients(chain)
    return _of_tangent(phi, big_a[..., None], big_b[..., None], big_c[..., None])


def blokh_coefficients(drive: Drive | Drives | Chain) -> tuple[Array, Array, Array]:
    """Return A, B, C of tan φ_{n+1} = A sin φ_1/(B sin φ_1 + C cos φ_1), arrays (...); Book (35) without poles."""
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle)
    psi = initial_phases(chain)
    cosine, sine = xp.cos(psi), xp.sin(psi)
    a = xp.cos(chain.joint_angle)
    b = xp.sin(chain.joint_angle) ** 2 * sine * cosine
    c = (a * cosine) ** 2 + sine**2
    big_a, big_b, big_c = a[..., 0], b[..., 0], c[..., 0]
    for i in range(1, chain.joints):
        big_b = big_b * c[..., i] + big_a * b[..., i]
        big_a = big_a * a[..., i]
        big_c = big_c * c[..., i]
    return big_a, big_b, big_c


def _of_tangent(phi: Array, big_a: Array, big_b: Array, big_c: Array) -> OutputMotion:
    """Return the motion of tan φ' = A sin φ/(B sin φ + C cos φ); Book (36), (37)."""
    xp = namespace(phi, big_a)
    sine, cosine = xp.sin(phi), xp.cos(phi)
    up = big_a * sine
    along = big_b * sine + big_c * cosine
    square = up * up + along * along
    twice = 2.0 * phi
    change = (big_a**2 + big_b**2 - big_c**2) * xp.sin(twice) + 2.0 * big_b * big_c * xp.cos(twice)
    return OutputMotion(
        angle=phi,
        angle_error=xp.atan2(up * cosine - along * sine, along * cosine + up * sine),
        ratio=big_a * big_c / square,
        slope=-big_a * big_c * change / square**2,
    )


def arrangement_phase(
    arrangement: Arrangement, *, plane_twist: float | None = None, yoke_angle: float | None = None
) -> float:
    """Return the phase angle ψ_2 of a double joint arranged as in Fig. 62, with ψ_1 = 0.

    Parameters
    ----------
    arrangement : "a", "b", "c" or "d"
        a: one plane, yokes crossed; b: one plane, any yoke angle; c: two planes, yokes in line; d: anything.
    plane_twist : float [rad], optional
        β_2, for c and d.
    yoke_angle : float [rad], optional
        γ_2, for b and d.

    Returns
    -------
    float [rad]

    Raises
    ------
    InputError
        A letter that is none of the four, or an angle that the arrangement needs or does not leave free.

    Examples
    --------
    >>> arrangement_phase("a")
    0.0
    """
    free = {"a": (), "b": ("yoke_angle",), "c": ("plane_twist",), "d": ("plane_twist", "yoke_angle")}
    if arrangement not in free:
        raise refuse("arrangement", _("{given} is none of a, b, c, d").format(given=repr(arrangement)))
    for name, value in (("plane_twist", plane_twist), ("yoke_angle", yoke_angle)):
        if name in free[arrangement] and value is None:
            raise refuse(name, _("missing; arrangement {letter} needs it").format(letter=arrangement))
        if name not in free[arrangement] and value is not None:
            raise refuse(name, _("arrangement {letter} leaves no choice of it").format(letter=arrangement))
    gamma = 0.5 * math.pi if arrangement == "a" else yoke_angle or 0.0
    return 0.5 * math.pi - gamma - (plane_twist or 0.0)


def double_joint(first: ArrayLike, second: ArrayLike, phase: ArrayLike, angle: ArrayLike) -> OutputMotion:
    """Return the output motion of double joints that start with ψ_1 = 0.

    Parameters
    ----------
    first, second : array (...) [rad]
        Bends α_1, α_2.
    phase : array (...) [rad]
        ψ_2; zero is the worst, π/2 the best.
    angle : array (p,) [rad]
        Input angle φ_1.

    Returns
    -------
    OutputMotion
        angle_error, ratio, slope : arrays (..., p).

    Notes
    -----
    Book (27), (28), (30): tan φ_3 = cos α_2 tan φ_1/[cos α_1 (cos² α_2 cos² ψ_2 + sin² ψ_2) + sin² α_2 sin ψ_2 cos ψ_2
    tan φ_1]; (26) is ψ_2 = 0, (29) is ψ_2 = π/2.

    Examples
    --------
    >>> import numpy as np
    >>> double_joint(0.3, 0.3, np.pi / 2, [1.0]).ratio
    array([1.])
    """
    xp = namespace(first, second, phase, angle)
    one, two, psi, phi = (real(value, xp) for value in (first, second, phase, angle))
    cosine, sine = xp.cos(psi), xp.sin(psi)
    # Book's A and C, both divided by cos α_1: numerator and denominator of the tangent.
    up = xp.cos(two)
    across = xp.sin(two) ** 2 * sine * cosine
    along = xp.cos(one) * ((xp.cos(two) * cosine) ** 2 + sine**2)
    up, across, along = xp.broadcast_arrays(up + 0.0 * along, across + 0.0 * along, along)
    return _of_tangent(phi, up[..., None], across[..., None], along[..., None])


@dataclass(frozen=True, eq=False, kw_only=True)
class DoubleJoint:
    """What a double joint amounts to."""

    length: Array  # (...): hyperbolic length L_eq = -ln cos α_eq

    @property
    def speed_fluctuation(self) -> Array:
        """δ = 2 sinh L_eq, array (...)."""
        xp = namespace(self.length)
        return 2.0 * xp.sinh(self.length)

    @property
    def joint_angle(self) -> Array:
        """Equivalent angle α_eq, array (...) [rad], accurate for small ones."""
        xp = namespace(self.length)
        return 2.0 * xp.atan(xp.sqrt(xp.tanh(0.5 * self.length)))


def double_joint_law(first: ArrayLike, second: ArrayLike, phase: ArrayLike) -> DoubleJoint:
    """Return what double joints amount to, by the hyperbolic law of cosines.

    Parameters
    ----------
    first, second : array (...) [rad]
        Bends α_1, α_2.
    phase : array (...) [rad]
        ψ_2 at ψ_1 = 0; its mean value for other start phases.

    Returns
    -------
    DoubleJoint
        arrays (...).

    Notes
    -----
    cosh L_eq = cosh L_1 cosh L_2 + sinh L_1 sinh L_2 cos 2ψ_2, L = -ln cos α, written for half of L_eq so that no
    digits cancel: sinh²(L_eq/2) = sinh²((L_1 - L_2)/2) + sinh L_1 sinh L_2 cos² ψ_2.

    Examples
    --------
    >>> import numpy as np
    >>> law = double_joint_law(0.2, 0.3, np.pi / 2)
    >>> print(f"{np.cos(law.joint_angle):.6f} {np.cos(0.3) / np.cos(0.2):.6f}")
    0.974767 0.974767
    """
    xp = namespace(first, second, phase)
    one, two, psi = (real(value, xp) for value in (first, second, phase))
    one, two = -xp.log(xp.cos(one)), -xp.log(xp.cos(two))
    square = xp.sinh(0.5 * (one - two)) ** 2 + xp.sinh(one) * xp.sinh(two) * xp.cos(psi) ** 2
    return DoubleJoint(length=2.0 * xp.asinh(xp.sqrt(square)))
