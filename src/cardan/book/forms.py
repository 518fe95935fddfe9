"""The book's closed forms: Blokh's chain, and the double joint in the arrangements of Fig. 62."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, TypeAlias

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.models.chain import Chain
from cardan.errors import refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.questions.motion.motion import initial_phases
from cardan.texts import _

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
