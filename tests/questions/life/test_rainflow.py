"""Rainflow against the example of the standard and a plainer way to count; time at level against sums."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import InputError
from cardan.questions.life.duty_cycle import combined_life, damage_shares, equivalent_torque
from cardan.questions.life.rainflow import rainflow, time_at_level, turning_points

P = 10.0 / 3.0


def four_point(values):
    """Return closed cycles and what is left, by striking inner ranges out of the list again and again."""
    points = [values[k] for k in turning_points(values)]
    closed = []
    k = 0
    while k + 3 < len(points):
        a, b, c, d = points[k : k + 4]
        if min(a, d) <= min(b, c) and max(b, c) <= max(a, d):
            closed.append((abs(b - c), 0.5 * (b + c)))
            del points[k + 1 : k + 3]
            k = 0
        else:
            k += 1
    return closed, points


def tally(found):
    sizes = np.round(found.range, 9)
    return {float(size): float(found.count[sizes == size].sum()) for size in np.unique(sizes)}


def test_the_example_of_astm_e1049():
    """-2 1 -3 5 -1 3 -4 4 -2, by hand: 3 half, 4 once and a half (closed -1 to 3), 6 half, 8 two halves, 9 half."""
    found = rainflow([-2, 1, -3, 5, -1, 3, -4, 4, -2])
    assert tally(found) == {3.0: 0.5, 4.0: 1.5, 6.0: 0.5, 8.0: 1.0, 9.0: 0.5}
    whole = found.count == 1.0
    assert found.mean[whole].tolist() == [1.0]
    assert (found.start[whole].tolist(), found.end[whole].tolist()) == ([4], [5])


@given(st.lists(st.integers(-9, 9), min_size=1, max_size=40))
@settings(max_examples=200, deadline=None)
def test_every_swing_is_half_a_cycle(values):
    points = [values[k] for k in turning_points(values)]
    assert rainflow(values).total == 0.5 * (len(points) - 1)


@pytest.mark.slow
@given(st.lists(st.integers(-9, 9), min_size=2, max_size=40))
@settings(max_examples=300, deadline=None)
def test_begun_at_its_largest_value_a_history_is_counted_as_by_the_four_point_rule(values):
    """The rules differ in nothing but what they leave open; there every swing is half a cycle."""
    top = int(np.argmax(np.abs(values)))
    turned = values[top:] + values[: top + 1]
    closed, rest = four_point(turned)
    halves = {}
    for size, count in [(size, 1.0) for size, _mean in closed] + [(size, 0.5) for size in np.abs(np.diff(rest))]:
        halves[float(size)] = halves.get(float(size), 0.0) + count
    assert tally(rainflow(turned)) == halves


def test_level_stretches_and_constants_turn_nothing():
    assert turning_points([2.0, 2.0, 2.0]).tolist() == [0]
    assert rainflow([2.0, 2.0]).total == 0.0
    assert rainflow([2.0, 2.0]).equivalent_range(5.0) == 0.0
    assert rainflow([0, 1, 1, 0]).range.tolist() == [1.0, 1.0]
    with pytest.raises(InputError, match="finite"):
        rainflow([0.0, np.nan])
    with pytest.raises(InputError, match="empty"):
        rainflow([])


def test_the_equivalent_range_damages_as_much():
    found = rainflow([0, 10, 0, 4, 0, 10, 0])
    same = found.equivalent_range(5.0, cycles=100.0)
    assert 100.0 * same**5 == pytest.approx(np.sum(found.count * found.range**5))


HISTORY = np.asarray([0.0, 0.7, 1.0, 1.1, 4.0, 4.5, 9.0]), np.asarray([-40.0, 90.0, 90.0, 250.0, 251.0, -10.0, 120.0])


def test_time_at_level_is_what_fine_steps_count():
    """A million points on the straight stretches, sorted into the levels: right to about 1e-6."""
    t, x = HISTORY
    fine = np.interp((np.arange(1_000_000) + 0.5) * 9e-6, t, x)
    found = time_at_level(t, x, edges=12)
    np.testing.assert_allclose(found.share, np.histogram(fine, found.edge)[0] / fine.size, atol=3e-6)
    assert np.any(found.edge == 0.0)
    assert found.mean == pytest.approx(np.mean(fine), rel=1e-6)
    assert found.equivalent == pytest.approx(np.mean(np.abs(fine) ** P) ** (1 / P), rel=1e-6)
    assert (found.duration, found.low, found.high) == (9.0, -40.0, 251.0)


def test_what_a_history_damages_does_not_depend_on_levels_nor_on_sampling():
    t, x = HISTORY
    finer = np.linspace(0.0, 9.0, 9001)
    same = np.union1d(finer, t)
    values = [time_at_level(t, x, edges=count).equivalent for count in (1, 2, 7, 400)]
    values.append(time_at_level(same, np.interp(same, t, x)).equivalent)
    np.testing.assert_allclose(values, values[0], rtol=1e-12)


def test_a_constant_history_is_one_level():
    for value in (300.0, -300.0, 0.0):
        found = time_at_level([0.0, 1.0, 5.0], [value] * 3)
        assert found.share.tolist() == [1.0]
        assert found.equivalent == pytest.approx(abs(value), rel=1e-14)


@pytest.mark.parametrize(
    ("times", "values", "edges"),
    [
        ([0.0], [1.0], 3),
        ([0.0, 0.0], [1.0, 2.0], 3),
        ([0.0, 1.0], [1.0, np.inf], 3),
        ([0, 1], [1, 2], [1.5, 3.0]),
        ([0, 1], [1, 2], 0),
    ],
)
def test_histories_that_are_none_are_refused(times, values, edges):
    with pytest.raises(InputError):
        time_at_level(times, values, edges=edges)


def test_duty_cycles_by_hand():
    """1000 h in a fifth of the time, 4000 h in the rest: 1/(0.2/1000 + 0.8/4000) = 2500 h, half the damage each."""
    assert combined_life([1000.0, 4000.0], [0.2, 0.8]) == pytest.approx(2500.0)
    assert combined_life([1000.0, 4000.0], [20.0, 80.0]) == pytest.approx(2500.0)
    np.testing.assert_allclose(damage_shares([1000.0, 4000.0], [0.2, 0.8]), [0.5, 0.5])
    assert combined_life([np.inf, np.inf], [0.5, 0.5]) == np.inf
    assert np.isnan(combined_life([1.0, np.nan], [0.5, 0.5]))
    assert not np.any(damage_shares([np.inf, np.inf], [0.5, 0.5]))


def test_the_equivalent_torque_lasts_as_long_as_the_cycle():
    """Lives of M_i at n_i α_i add up as one torque at the mean n α does."""
    torque, share = np.asarray([1500.0, 700.0, 0.0]), np.asarray([0.05, 0.35, 0.6])
    speed, joint_angle = np.asarray([30.0, 90.0, 240.0]), np.asarray([0.1, 0.1, 0.05])
    lives = 1.0 / (speed * joint_angle * np.maximum(torque, 1e-9) ** P)
    same = equivalent_torque(torque, share, speed=speed, joint_angle=joint_angle)
    assert combined_life(lives, share) == pytest.approx(1.0 / (np.sum(share * speed * joint_angle) * same**P))
    assert equivalent_torque([5.0], [1.0], speed=[0.0]) == 0.0
