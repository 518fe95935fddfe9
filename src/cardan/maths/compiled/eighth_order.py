"""Dormand and Prince's explicit Runge-Kutta method of order eight, and what it makes of second derivatives.

For q̈ = f(t, q, q̇) the angles of a stage follow from the accelerations of the stages before: with Ā = A², b̄ = bA,

    q_i = q + c_i h q̇ + h² Σ ā_ij q̈_j,   q̇_i = q̇ + h Σ a_ij q̈_j.

Coefficients: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, code DOP853.
"""

from __future__ import annotations

from collections.abc import Callable

from cardan.maths.arrays import Array

SPEED: tuple[dict[int, float], ...] = (
    {},
    {0: 0.05260015195876773},
    {0: 0.0197250569845379, 1: 0.0591751709536137},
    {0: 0.02958758547680685, 2: 0.08876275643042054},
    {0: 0.2413651341592667, 2: -0.8845494793282861, 3: 0.924834003261792},
    {0: 0.037037037037037035, 3: 0.17082860872947386, 4: 0.12546768756682242},
    {0: 0.037109375, 3: 0.17025221101954405, 4: 0.06021653898045596, 5: -0.017578125},
    {
        0: 0.03709200011850479,
        3: 0.17038392571223998,
        4: 0.10726203044637328,
        5: -0.015319437748624402,
        6: 0.008273789163814023,
    },
    {
        0: 0.6241109587160757,
        3: -3.3608926294469414,
        4: -0.868219346841726,
        5: 27.59209969944671,
        6: 20.154067550477894,
        7: -43.48988418106996,
    },
    {
        0: 0.47766253643826434,
        3: -2.4881146199716677,
        4: -0.590290826836843,
        5: 21.230051448181193,
        6: 15.279233632882423,
        7: -33.28821096898486,
        8: -0.020331201708508627,
    },
    {
        0: -0.9371424300859873,
        3: 5.186372428844064,
        4: 1.0914373489967295,
        5: -8.149787010746927,
        6: -18.52006565999696,
        7: 22.739487099350505,
        8: 2.4936055526796523,
        9: -3.0467644718982196,
    },
    {
        0: 2.273310147516538,
        3: -10.53449546673725,
        4: -2.0008720582248625,
        5: -17.9589318631188,
        6: 27.94888452941996,
        7: -2.8589982771350235,
        8: -8.87285693353063,
        9: 12.360567175794303,
        10: 0.6433927460157636,
    },
)
"""a_ij by stage i: stage j -> coefficient; what is left out is zero."""

SPEED_WEIGHTS: dict[int, float] = {
    0: 0.054293734116568765,
    5: 4.450312892752409,
    6: 1.8915178993145003,
    7: -5.801203960010585,
    8: 0.3111643669578199,
    9: -0.1521609496625161,
    10: 0.20136540080403034,
    11: 0.04471061572777259,
}
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
