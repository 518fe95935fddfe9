"""Closing a hyperbolic polygon: windows, diagonals, folds, on arrays and on plain numbers."""

import array_api_strict
import numpy as np
import pytest
from scipy.optimize import linprog

from cardan.maths.kernel import mobius, polygon

RANDOM = np.random.default_rng(20)


def hooke_sides(joint_angles):
    return [mobius.hooke(joint_angles[..., i]) for i in range(joint_angles.shape[-1])]


@pytest.mark.parametrize("n", range(1, 8))
def test_closes_as_near_as_the_triangle_inequality_allows(n):
    sides = hooke_sides(RANDOM.uniform(0.0, 0.9, (2000, n)))
    low, _high = polygon.reach([mobius.length(side) for side in sides])
    left = mobius.speed_fluctuation(polygon.close(sides).pair)
    # rounding of the product, a few units in the last place of numbers of order one
    assert np.abs(left - 2.0 * np.sinh(low)).max() < 4e-15


@pytest.mark.parametrize("n", range(2, 7))
def test_reaches_every_distance_in_its_range(n):
    sides = hooke_sides(RANDOM.uniform(0.02, 0.9, (1000, n)))
    low, high = polygon.reach([mobius.length(side) for side in sides])
    end = low + RANDOM.uniform(0.0, 1.0, 1000) * (high - low)
    pair = polygon.close(sides, end=end).pair
    # the length of a far end has the rounding of cosh L
    assert np.abs(mobius.length(pair) - end).max() < 1e-13


def test_no_turns_end_nearer_than_the_bound():
    joint_angles = RANDOM.uniform(0.02, 0.8, (300, 4))
    sides = hooke_sides(joint_angles)
    low, high = polygon.reach([mobius.length(side) for side in sides])
    for _ in range(200):
        here = sides[0]
        for side in sides[1:]:
            here = mobius.compose(side, mobius.compose(mobius.turn(RANDOM.uniform(0, np.pi, 300)), here))
        assert (mobius.length(here) > low - 1e-14).all()
        assert (mobius.length(here) < high + 1e-14).all()


def test_every_fold_closes_and_the_mirror_has_the_same_corners():
    sides = hooke_sides(RANDOM.uniform(0.3, 0.5, (200, 6)))
    folds = [1.0, 1.0, -1.0, 1.0, -1.0, 1.0]
    way = polygon.close(sides, folds=folds)
    mirror = polygon.close(sides, folds=[-f for f in folds])
    for closure, sign in ((way, 1), (mirror, -1)):
        assert mobius.speed_fluctuation(closure.pair).max() < 4e-15
        corners = walked(sides, closure.turns)
        np.testing.assert_allclose(
            [c.imag * sign for c in corners], [c.imag for c in walked(sides, way.turns)], atol=1e-14
        )


def walked(sides, turns):
    """Return the corners of a polygon, its first side along the real axis."""
    here, corners = sides[0], []
    for side, turn in zip(sides[1:], turns, strict=True):
        corners.append(mobius.vertex(here))
        here = mobius.compose(side, mobius.compose(mobius.turn(turn), here))
    return corners


def test_the_aims_give_the_least_sum_of_diagonals():
    """Against a linear programme on short sides, where sinh D = D to 1e-8 and the polytope is the same."""
    n, weights = 7, [1.0, 0.3, 2.0, 0.7, 1.5, 1.0, 0.0]
    for _ in range(40):
        lengths = RANDOM.uniform(0.1, 1.0, n) * 1e-4
        if polygon.reach(list(lengths))[0] > 0:
            continue
        aims = polygon.shortest_diagonals(list(lengths), weights, 0.0)
        got, found = lengths[0], [lengths[0]]
        room = polygon.windows(list(lengths), 0.0)
        for k in range(1, n):
            low = max(abs(got - lengths[k]), room[k][0])
            got = min(max(aims[k], low), min(got + lengths[k], room[k][1]))
            found.append(got)
        rows, bounds = [], []
        for k in range(1, n):
            for one, two, limit in ((1, -1, lengths[k]), (-1, 1, lengths[k]), (-1, -1, -lengths[k])):
                row = np.zeros(n)
                row[k], row[k - 1] = one, two
                rows.append(row)
                bounds.append(limit)
        fixed = np.zeros((2, n))
        fixed[0, 0] = fixed[1, -1] = 1
        best = linprog(
            weights, A_ub=np.array(rows), b_ub=np.array(bounds) * 1e4, A_eq=fixed, b_eq=[lengths[0] * 1e4, 0.0]
        )
        # sums of about 2 in units of 1e-4; linprog keeps its constraints to 1e-7
        assert np.dot(weights, found) * 1e4 == pytest.approx(best.fun, abs=2e-6)


@pytest.mark.parametrize("n", range(2, 7))
def test_plain_numbers_give_what_arrays_give(n):
    joint_angles = RANDOM.uniform(0.0, 0.7, (50, n))
    sides = hooke_sides(joint_angles)
    lengths = [mobius.length(side) for side in sides]
    aims = polygon.shortest_diagonals(lengths, [1.0] * n, polygon.reach(lengths)[0])
    together = polygon.close(sides, aims=aims)
    for row, joint_angle in enumerate(joint_angles.tolist()):
        one_sides = [mobius.hooke(angle) for angle in joint_angle]
        one_lengths = [mobius.length(side) for side in one_sides]
        one_aims = polygon.shortest_diagonals(one_lengths, [1.0] * n, polygon.reach(one_lengths)[0])
        one = polygon.close(one_sides, aims=one_aims)
        assert all(type(turn) is float for turn in one.turns)
        # NumPy's sinh and atan2 differ from Python's in the last place, and a corner that is stretched shows the root
        # of that: the closure itself does not
        assert np.abs(np.sin(np.asarray([t[row] for t in together.turns]) - one.turns)).max() < 1e-6
        assert abs(mobius.speed_fluctuation(one.pair) - mobius.speed_fluctuation(together.pair)[row]) < 4e-15


def test_runs_on_any_array_library():
    joint_angles = RANDOM.uniform(0.1, 0.6, (20, 5))
    strict = [mobius.hooke(array_api_strict.asarray(joint_angles[:, i])) for i in range(5)]
    lengths = [mobius.length(side) for side in strict]
    aims = polygon.shortest_diagonals(lengths, [1.0] * 5, polygon.reach(lengths)[0])
    got = polygon.close(strict, aims=aims)
    np.testing.assert_allclose(
        np.asarray(mobius.speed_fluctuation(got.pair)), 2 * np.sinh(np.asarray(polygon.reach(lengths)[0])), atol=4e-15
    )


def test_a_turn_without_effect_is_kept():
    sides = [mobius.hooke(angle) for angle in (0.3, 0.3, 0.0, 0.2, 0.2)]
    closure = polygon.close(sides, keep=[0.1, 0.2, 0.3, 0.4])
    assert closure.turns[1:3] == [0.2, 0.3]
    assert closure.loose[1:3] == [True, True]
    assert mobius.speed_fluctuation(closure.pair) < 1e-15


def test_long_chains_stay_closed():
    sides = [mobius.hooke(0.3) for _ in range(400)]
    closure = polygon.close(sides)
    # rounding grows with the square root of the number of joints
    assert mobius.speed_fluctuation(closure.pair) < 1e-13
