"""Arctangent, sine and cosine as polynomials without branches, for lanes that have no mathematical library.

Written on the array-API standard like everything else, so the same lines run on NumPy arrays in the tests and on the
registers of a kernel. Coefficients: ``tests/builders/polynomials.py``. Each stays within 4e-15 of the exact value on
its range, most of it within two units in the last place; the tests judge them against mpmath.
"""

from __future__ import annotations

from cardan.maths.arrays import Array, namespace

# fmt: off
ARCTANGENT = (
    -0.3333333333333333, 0.1999999999999552, -0.14285714284666542, 0.11111111015256361, -0.09090904578123903,
    0.07692183190826087, -0.06664511447381948, 0.0585814891280221, -0.0508544973794026, 0.03923165829558719,
    -0.01917688711906226,
)
SINE = (
    -0.16666666666666666, 0.008333333333333333, -0.00019841269841269806, 2.7557319223971264e-06,
    -2.5052108382391406e-08, 1.605904347941901e-10, -7.647139121983424e-13, 2.8104687777073216e-15,
    -8.006069886350886e-18,
)
COSINE = (
    0.041666666666666664, -0.001388888888888889, 2.4801587301587285e-05, -2.755731922397923e-07,
    2.0876756986479165e-09, -1.1470745434999399e-11, 4.779466128305698e-14, -1.5614707523569033e-16,
    4.0126841356251555e-19,
)
# fmt: on
HALF_TURN = (3.1415926535846666, 5.1266883031679116e-12, 2.1125998133974855e-23)
"""π in three parts; a whole number below 2¹⁵ times each of the first two is exact."""

RIGHT_ANGLE = (1.5707963267948966, 6.123233995736766e-17)
"""π/2 in two parts."""

LARGEST_ANGLE = 1e5
"""Angles [rad] up to this one are reduced exactly; reduce larger ones before."""

_ROUND = 1.5 * 2.0**52
"""Added and taken away again it leaves the nearest whole number."""


def _polynomial(coefficients: tuple[float, ...], z: Array) -> Array:
    value = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        value = value * z + coefficient
    return value


def arctangent(u: Array) -> Array:
    """Return atan u for \\|u\\| ≤ tan(π/8)."""
    z = u * u
    return u + u * z * _polynomial(ARCTANGENT, z)


def arctangent_unit(u: Array) -> Array:
    """Return atan u for \\|u\\| ≤ 1, by halving the angle once."""
    xp = namespace(u)
    return 2.0 * arctangent(u / (1.0 + xp.sqrt(1.0 + u * u)))


def argument_right(y: Array, x: Array) -> Array:
    """Return the argument of x + iy for x > 0, by halving the angle twice."""
    xp = namespace(y)
    return 2.0 * arctangent_unit(y / (x + xp.sqrt(x * x + y * y)))


def argument(y: Array, x: Array) -> Array:
    """Return the argument of x + iy in [-π, π]; nan at the origin."""
    xp = namespace(y)
    across, along = xp.abs(y), xp.abs(x)
    steep = across > along
    angle = arctangent_unit(xp.where(steep, along, across) / xp.where(steep, across, along))
    angle = xp.where(steep, RIGHT_ANGLE[0] - (angle - RIGHT_ANGLE[1]), angle)
    angle = xp.where(x < 0.0, 2.0 * RIGHT_ANGLE[0] - (angle - 2.0 * RIGHT_ANGLE[1]), angle)
    return xp.where(y < 0.0, -angle, angle)


def sine(r: Array) -> Array:
    """Return sin r for \\|r\\| ≤ π/2."""
    z = r * r
    return r + r * z * _polynomial(SINE, z)


def cosine(r: Array) -> Array:
    """Return cos r for \\|r\\| ≤ π/2, with an absolute error only near the ends."""
    z = r * r
    return 1.0 - (0.5 * z - z * z * _polynomial(COSINE, z))


def joint_angle_cosine(joint_angle: Array) -> Array:
    """Return cos α for 0 ≤ α < π/2, with full relative accuracy near π/2."""
    xp = namespace(joint_angle)
    small = joint_angle < 0.5 * RIGHT_ANGLE[0]
    return xp.where(small, cosine(joint_angle), sine((RIGHT_ANGLE[0] - joint_angle) + RIGHT_ANGLE[1]))


def within_half_turn(angle: Array) -> Array:
    """Return the angle less a whole number of half turns, in [-π/2, π/2]; for \\|angle\\| ≤ `LARGEST_ANGLE`.

    Two turns of a Möbius pair that differ by half a turn differ in sign only, which no result shows.
    """
    count = (angle * (1.0 / (2.0 * RIGHT_ANGLE[0])) + _ROUND) - _ROUND
    return ((angle - count * HALF_TURN[0]) - count * HALF_TURN[1]) - count * HALF_TURN[2]
