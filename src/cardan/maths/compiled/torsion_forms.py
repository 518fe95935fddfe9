"""Formulas of torsional motion in fixed steps, on arrays or on lanes: joints, elements, torques, sums over a step.

Written on the array-API standard: the same lines serve the plain form and the kernel.
"""

from __future__ import annotations

from collections.abc import Callable

from cardan.maths.arrays import Array, namespace

from .approximations import ARCTANGENT, COSINE, SINE, argument_right

HALF_TURN = (3.1415926218032837, 3.1786509424591713e-08, 1.2246467991473532e-16)
"""π in three parts; a whole number below 2²⁶ times each of the first two is exact."""

LARGEST_ANGLE = 2e8
"""Angles [rad] up to this one are reduced exactly."""

MILD = 0.38
"""Largest τ of a follower whose lead stays below π/8, the range of the short arctangent."""

_ROUND = 1.5 * 2.0**52


def reduced(angle: Array) -> Array:
    """Return the angle less a whole number of half turns, in [-π/2, π/2]; for \\|angle\\| ≤ `LARGEST_ANGLE`.

    >>> import numpy as np
    >>> float(reduced(np.asarray(1e8)))
    -1.1988...
    """
    count = (angle * (1.0 / (HALF_TURN[0] + HALF_TURN[1])) + _ROUND) - _ROUND
    return ((angle - count * HALF_TURN[0]) - count * HALF_TURN[1]) - count * HALF_TURN[2]


def _polynomial(coefficients: tuple[float, ...], powers: tuple[Array, ...]) -> Array:
    """Return Σ c_k z^k from z, z², z⁴, z⁸: pairs first (Estrin), so that few steps wait for each other."""
    terms: list[Array] = list(coefficients)
    for power in powers:
        paired = [one + two * power for one, two in zip(terms[::2], terms[1::2], strict=False)]
        terms = paired + terms[2 * len(paired) :]
    return terms[0]


def _powers(z: Array) -> tuple[Array, Array, Array, Array]:
    square = z * z
    fourth = square * square
    return z, square, fourth, fourth * fourth


def waves(q: Array) -> tuple[Array, Array]:
    """Return sin 2q and cos 2q."""
    r = reduced(q)
    z = r * r
    powers = _powers(z)
    s = r + r * z * _polynomial(SINE, powers)
    c = 1.0 - (0.5 * z - z * z * _polynomial(COSINE, powers))
    return 2.0 * s * c, 1.0 - 2.0 * (s * s)


def _arctangent(u: Array) -> Array:
    z = u * u
    return u + u * z * _polynomial(ARCTANGENT, _powers(z))


def swing(angle: Array) -> Array:
    """Return the sine of an angle of any size."""
    return waves(0.5 * angle)[0]


def _turned(s2: Array, c2: Array, tau: Array, c: Array, s: Array) -> tuple[Array, Array, Array, Array]:
    """Return y/x of x + iy = 1 - τ e^(-2iθ), y/x's parts and 1/(x² + y²), with one division."""
    y = tau * (s2 * c + c2 * s)
    x = 1.0 - tau * (c2 * c - s2 * s)
    square = x * x + y * y
    inverse = 1.0 / (x * square)
    return y * (square * inverse), x, y, x * inverse


def follower(
    s2: Array, c2: Array, q: Array, v: Array, tau: Array, c: Array, s: Array, ahead: Array
) -> tuple[Array, Array, Array]:
    """Return angle, speed and F' of a driven yoke whose lead stays below π/8.

    s2, c2: sin 2q and cos 2q of its coordinate; q, v [rad, rad/s].
    tau, c, s, ahead: of the one joint it follows by: τ, cos 2ψ, sin 2ψ and its lead at the start.
    """
    tangent, _x, _y, below = _turned(s2, c2, tau, c, s)
    first = (1.0 - tau * tau) * below
    return q + (_arctangent(tangent) - ahead), first * v, first


def steep_follower(
    s2: Array, c2: Array, q: Array, v: Array, tau: Array, c: Array, s: Array, ahead: Array
) -> tuple[Array, Array, Array]:
    """Return the same as `follower` for any bend."""
    _tangent, x, y, below = _turned(s2, c2, tau, c, s)
    first = (1.0 - tau * tau) * below
    return q + (argument_right(y, x) - ahead), first * v, first


def spun(q: Array, v: Array, tau: Array, c: Array, s: Array, ahead: Array) -> tuple[Array, ...]:
    """Return sin 2q and cos 2q, and what `follower` gives at once."""
    s2, c2 = waves(q)
    return s2, c2, *follower(s2, c2, q, v, tau, c, s, ahead)


def swelling(s2: Array, c2: Array, tau: Array, c: Array, s: Array, first: Array) -> Array:
    """Return F'' of a driven yoke: -4 τ sin 2θ F'²/(1 - τ²)."""
    return -4.0 * tau * (s2 * c + c2 * s) * (first * first) / (1.0 - tau * tau)


def weight(first: Array, second: Array, v: Array, inertia: Array, mass: Array, force: Array) -> tuple[Array, Array]:
    """Add a follower's inertia to mass and force of its coordinate: J F'² and -J F' F'' q̇²."""
    carried = inertia * first
    return mass + carried * first, force - carried * (second * (v * v))


def drag(speed: Array, damping: Array, force: Array, power: Array) -> tuple[Array, Array]:
    """Add damping to ground to a torque and to the power."""
    taken = damping * speed
    return force - taken, power - taken * speed


def element(
    xa: Array, xb: Array, va: Array, vb: Array, c: Array, b: Array, rest: Array, ta: Array, tb: Array, power: Array
) -> tuple[Array, Array, Array, Array]:
    """Return the torque of an element without play, the torques on its ends and the power."""
    turning = va - vb
    lost = b * turning
    carried = c * ((xa - xb) - rest) + lost
    return carried, ta - carried, tb + carried, power - lost * turning


def loose_element(
    xa: Array,
    xb: Array,
    va: Array,
    vb: Array,
    c: Array,
    b: Array,
    rest: Array,
    ta: Array,
    tb: Array,
    power: Array,
    half: Array,
) -> tuple[Array, Array, Array, Array]:
    """Return the same with a play of twice ``half``."""
    xp = namespace(xa)
    twist, turning = (xa - xb) - rest, va - vb
    past, touching = _touch(xp, twist, half)
    lost = b * turning * touching
    carried = c * past + lost
    return carried, ta - carried, tb + carried, power - lost * turning


def _touch(xp: object, twist: Array, half: Array) -> tuple[Array, Array]:
    """Return how far a twist is past its play, and 1 where it is; without play it always is."""
    where, size = xp.where, xp.abs  # type: ignore[attr-defined]
    over = size(twist) - half
    touching = where(over > 0.0, 1.0, where(half > 0.0, 0.0, 1.0))
    signed = where(twist < 0.0, -1.0, 1.0)
    return signed * over * touching, touching


def constant(value: Array, speed: Array, torque: Array, power: Array) -> tuple[Array, Array]:
    """Add a torque to what acts on a station, and to the power."""
    return torque + value, power + value * speed


def falling(standstill: Array, slope: Array, speed: Array, torque: Array, power: Array) -> tuple[Array, Array]:
    """Add M0 - slope·Ḟ."""
    return constant(standstill - slope * speed, speed, torque, power)


def kloss(
    synchronous: Array, pullout: Array, slip_pullout: Array, speed: Array, torque: Array, power: Array
) -> tuple[Array, Array]:
    """Add 2 M_p s s_p/(s² + s_p²) at the slip s = 1 - Ḟ/ω_sync; ``synchronous`` is 1/ω_sync."""
    slip = 1.0 - speed * synchronous
    value = 2.0 * pullout * slip_pullout * slip / (slip * slip + slip_pullout * slip_pullout)
    return constant(value, speed, torque, power)


def swinging(
    amplitude: Array, order: Array, phase: Array, angle: Array, speed: Array, torque: Array, power: Array
) -> tuple[Array, Array]:
    """Add a sin(order·F + phase)."""
    return constant(amplitude * swing(order * angle + phase), speed, torque, power)


def hinge(value: Array, speed: Array, place: Array, joint_angle: Array) -> Array:
    """Add to a value that is straight in the speed a joint angle at a place: bend·max(0, Ḟ - place)."""
    xp = namespace(speed)
    over = speed - place
    return value + joint_angle * xp.where(over > 0.0, over, 0.0)


def forced(time: Array, angle: Array, speed: Array, acceleration: Array) -> tuple[Array, Array]:
    """Return angle and speed of a forced coordinate whose speed runs straight."""
    return angle + (speed + 0.5 * acceleration * time) * time, speed + acceleration * time


def reaction(mass: Array, acceleration: Array, force: Array, speed: Array, power: Array) -> Array:
    """Add the power of what forces a coordinate."""
    return power + (mass * acceleration - force) * speed


def element_rate(
    va: Array, vb: Array, aa: Array, ab: Array, c: Array, b: Array, touching: Array | float = 1.0
) -> Array:
    """Return the rate at which the torque of an element changes: c ẋ + b ẍ."""
    return (c * (va - vb) + b * (aa - ab)) * touching


def touch(xa: Array, xb: Array, rest: Array, half: Array) -> Array:
    """Return 1 where an element touches."""
    return _touch(namespace(xa), (xa - xb) - rest, half)[1]


def follower_rate(first: Array, second: Array, v: Array, a: Array) -> Array:
    """Return the acceleration of a driven yoke, F' q̈ + F'' q̇²."""
    return first * a + second * (v * v)


def highest(
    now: Array,
    rate: Array,
    before: Array,
    rate_before: Array,
    high: Array,
    low: Array,
    high_time: Array,
    low_time: Array,
    time: Array,
    h: Array,
) -> tuple[Array, Array, Array, Array]:
    """Return the extremes of a curve with those of one more step: of the cubic by values and slopes at its ends.

    now, rate, before, rate_before: value and slope at the end and at the start of the step.
    high, low, high_time, low_time: extremes so far and when they were.
    time, h [s]: end and length of the step; times are not negative.
    """
    xp = namespace(now)
    d0, d1, rise = h * rate_before, h * rate, now - before
    b, c = 3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise
    inverse = 1.0 / (d0 - d1)
    place = d0 * inverse  # where the slope is 0 if it runs straight; then once closer on the cubic
    place = place + (d0 + place * (2.0 * b + 3.0 * c * place)) * inverse
    turns = xp.where(d0 * d1 < 0.0, xp.where(place > 0.0, xp.where(place < 1.0, 1.0, 0.0), 0.0), 0.0) > 0.5
    between = xp.where(turns, before + place * (d0 + place * (b + place * c)), now)
    moment = xp.where(turns, time - h * (1.0 - place), time)
    top, bottom = xp.maximum(between, now), xp.minimum(between, now)
    top_time, bottom_time = xp.where(between < now, time, moment), xp.where(between > now, time, moment)
    # The size of a time that is never negative: without it the optimiser stores by masks, which is slow.
    return (
        xp.maximum(top, high),
        xp.minimum(bottom, low),
        xp.where(top > high, top_time, xp.abs(high_time)),
        xp.where(bottom < low, bottom_time, xp.abs(low_time)),
    )


def bounded(speed: Array, limit: Array, alive: Array) -> Array:
    """Return 0 from the first moment on at which a number leaves its bounds or is none, else what it was."""
    xp = namespace(speed)
    return xp.where(xp.abs(speed) < limit, alive, 0.0)


def lasted(ended: Array, alive: Array, now: Array) -> Array:
    """Return until when a drive kept within bounds."""
    xp = namespace(ended)
    return xp.where(alive > 0.5, now + 0.0 * ended, ended)


# Dormand and Prince's explicit Runge-Kutta method of order eight, and what it makes of second derivatives.
#
# For q̈ = f(t, q, q̇) the angles of a stage follow from the accelerations of the stages before: with Ā = A², b̄ = bA,
#
#     q_i = q + c_i h q̇ + h² Σ ā_ij q̈_j,   q̇_i = q̇ + h Σ a_ij q̈_j.
#
# Coefficients: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, code DOP853.

# fmt: off
SPEED: tuple[dict[int, float], ...] = (
    {},
    {0: 0.05260015195876773},
    {0: 0.0197250569845379, 1: 0.0591751709536137},
    {0: 0.02958758547680685, 2: 0.08876275643042054},
    {0: 0.2413651341592667, 2: -0.8845494793282861, 3: 0.924834003261792},
    {0: 0.037037037037037035, 3: 0.17082860872947386, 4: 0.12546768756682242},
    {0: 0.037109375, 3: 0.17025221101954405, 4: 0.06021653898045596, 5: -0.017578125},
    {0: 0.03709200011850479, 3: 0.17038392571223998, 4: 0.10726203044637328, 5: -0.015319437748624402,
     6: 0.008273789163814023},
    {0: 0.6241109587160757, 3: -3.3608926294469414, 4: -0.868219346841726, 5: 27.59209969944671,
     6: 20.154067550477894, 7: -43.48988418106996},
    {0: 0.47766253643826434, 3: -2.4881146199716677, 4: -0.590290826836843, 5: 21.230051448181193,
     6: 15.279233632882423, 7: -33.28821096898486, 8: -0.020331201708508627},
    {0: -0.9371424300859873, 3: 5.186372428844064, 4: 1.0914373489967295, 5: -8.149787010746927,
     6: -18.52006565999696, 7: 22.739487099350505, 8: 2.4936055526796523, 9: -3.0467644718982196},
    {0: 2.273310147516538, 3: -10.53449546673725, 4: -2.0008720582248625, 5: -17.9589318631188,
     6: 27.94888452941996, 7: -2.8589982771350235, 8: -8.87285693353063, 9: 12.360567175794303,
     10: 0.6433927460157636},
)
"""a_ij by stage i: stage j -> coefficient; what is left out is zero."""
SPEED_WEIGHTS: dict[int, float] = {
    0: 0.054293734116568765, 5: 4.450312892752409, 6: 1.8915178993145003, 7: -5.801203960010585,
    8: 0.3111643669578199, 9: -0.1521609496625161, 10: 0.20136540080403034, 11: 0.04471061572777259,
}
# fmt: on
"""b_j."""

STAGES = len(SPEED)

PLACES: tuple[float, ...] = tuple(sum(row.values()) for row in SPEED)
"""c_i."""


def _squared(row: dict[int, float]) -> dict[int, float]:
    """Return a row of coefficients times the matrix A."""
    found: dict[int, float] = {}
    for k, one in row.items():
        for j, other in SPEED[k].items():
            found[j] = found.get(j, 0.0) + one * other
    return {j: one for j, one in sorted(found.items()) if abs(one) > 1e-14}  # what is left of zeros is rounding


ANGLE: tuple[dict[int, float], ...] = tuple(_squared(row) for row in SPEED)
"""ā_ij."""

ANGLE_WEIGHTS: dict[int, float] = _squared(SPEED_WEIGHTS)
"""b̄_j."""


def stage(i: int) -> Callable[..., tuple[Array, Array]]:
    """Return the formula of angle and speed at a stage: of q, q̇, the accelerations of the stages before, h."""

    def formula(*given: Array) -> tuple[Array, Array]:
        (q, v), a, h = given[:2], given[2:-1], given[-1]
        way, push = PLACES[i] * v, _sum(SPEED[i], a)
        if ANGLE[i]:
            way = way + h * _sum(ANGLE[i], a)
        return q + h * way, v + h * push

    return formula


def end(*given: Array) -> tuple[Array, Array]:
    """Return angle and speed at the end of a step, of q, q̇, the accelerations of all stages, h."""
    (q, v), a, h = given[:2], given[2:-1], given[-1]
    return q + h * (v + h * _sum(ANGLE_WEIGHTS, a)), v + h * _sum(SPEED_WEIGHTS, a)


def _sum(row: dict[int, float], terms: tuple[Array, ...]) -> Array:
    total = None
    for j, share in row.items():
        total = share * terms[j] if total is None else total + share * terms[j]
    return total
