import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan.maths.kernel import loops
from cardan.maths.kernel.loops import Status
from cardan.units import deg
from tests.builders.loop_newton import solved

RIGHT = 0.5 * np.pi


def random_loops(count, seed=1):
    rng = np.random.default_rng(seed)
    return (
        rng.uniform(0.2, 2.9, (count, 4)),
        rng.uniform(-7.0, 7.0, count),
        rng.uniform(-1.0, 1.0, (count, 4)),
        rng.uniform(-1.0, 1.0, count),
    )


def joint_loops(joint_angle, errors=0.0):
    return np.asarray([RIGHT, RIGHT, RIGHT, joint_angle]) + errors


@pytest.mark.parametrize("branch", [-1.0, 1.0])
def test_random_loops_close(branch):
    alpha, phi, length, slide = random_loops(20_000)
    found = loops.rccc(alpha, phi, length=length, slide=slide, branch=branch)
    ok = found.status == Status.CLOSED
    assert 0.3 < ok.mean() < 0.7
    left = loops.closure(
        alpha[ok],
        np.concatenate((phi[ok, None], found.angle[ok]), axis=-1),
        length[ok],
        np.concatenate((slide[ok, None], found.slide[ok]), axis=-1),
    )
    # Rounding alone, though slides reach hundreds of the lengths near dead positions.
    assert left.max() < 1e-12


@pytest.mark.slow
@pytest.mark.parametrize("branch", [-1.0, 1.0])
def test_a_newton_solution_of_the_matrix_equation_agrees(branch):
    alpha, phi, length, slide = random_loops(60, seed=2)
    found = loops.rccc(alpha, phi, length=length, slide=slide, branch=branch)
    rng = np.random.default_rng(3)
    checked = 0
    for k in np.flatnonzero(found.status == Status.CLOSED):
        mine = np.concatenate((found.angle[k], found.slide[k]))
        if np.max(np.abs(mine)) > 10.0:  # a start this near a dead position runs to the other branch
            continue
        other, left = solved(alpha[k], length[k], phi[k], slide[k], mine + rng.uniform(-0.02, 0.02, 6))
        assert left < 1e-13
        assert other == pytest.approx(mine, abs=1e-11)
        checked += 1
    assert checked > 10


@pytest.mark.slow
def test_the_newton_solution_is_one_of_both_branches_from_any_start():
    alpha, phi, length, slide = random_loops(40, seed=5)
    both = loops.rccc(
        alpha[:, None], phi[:, None], length=length[:, None], slide=slide[:, None], branch=np.asarray([-1.0, 1.0])
    )
    rng = np.random.default_rng(6)
    met = 0
    for k in np.flatnonzero(both.status[:, 0] == Status.CLOSED):
        other, left = solved(alpha[k], length[k], phi[k], slide[k], rng.uniform(-3, 3, 6))
        if left > 1e-12:
            continue
        off = np.abs(np.exp(1j * both.angle[k]) - np.exp(1j * other[:3])).max(axis=-1)
        assert off.min() < 1e-9
        met += 1
    assert met > 5


@given(st.floats(0.0, 80.0), st.floats(-400.0, 400.0))
def test_the_perfect_loop_is_a_universal_joint(joint_angle, angle):
    found = loops.rccc(joint_loops(joint_angle * deg), angle * deg)
    # tan θ' = tan θ / cos α with θ' = π/2 - φ_4, on the branch where both vanish together.
    theta = RIGHT - found.angle[2]
    expected = np.arctan2(np.sin(angle * deg), np.cos(angle * deg) * np.cos(joint_angle * deg))
    assert np.cos(theta - expected) == pytest.approx(1.0, abs=1e-14)
    assert np.sin(theta - expected) == pytest.approx(0.0, abs=1e-14)
    assert np.max(np.abs(found.slide)) == 0.0


@given(st.floats(0.0, 80.0), st.floats(-400.0, 400.0), st.sampled_from([-1.0, 1.0]))
def test_the_closed_table_is_that_of_the_perfect_loop(joint_angle, angle, branch):
    table = loops.influence(joint_angle * deg, angle * deg, branch=branch)
    loop = loops.rccc(joint_loops(joint_angle * deg), angle * deg, branch=branch)
    # Entries reach 1/cos²80° = 33.
    assert table == pytest.approx(loop.coefficient, abs=2e-13)


@pytest.mark.slow
@given(st.floats(1.0, 60.0), st.floats(-200.0, 200.0), st.sampled_from([-1.0, 1.0]))
@settings(max_examples=50)
def test_the_table_is_the_derivative_of_the_angles(joint_angle, angle, branch):
    """Fourth-order differences of the exact loop: steps of 1e-3 leave about 1e-12/1e-3 and 1e-12 · bound of f⁗."""
    table = loops.influence(joint_angle * deg, angle * deg, branch=branch)

    def shifted(seat, step):
        change = np.zeros(5)
        change[seat] = step
        return loops.rccc(joint_loops(joint_angle * deg, change[1:]), angle * deg + change[0], branch=branch).angle

    h = 1e-3
    for seat in range(5):
        at = np.stack([shifted(seat, k * h) for k in (-2, -1, 1, 2)])
        off = np.angle(np.exp(1j * (at - at[1])))
        slope = (off[0] - 8 * off[1] + 8 * off[2] - off[3]) / (12 * h)
        assert slope == pytest.approx(table[:, seat], abs=1e-7 / np.cos(joint_angle * deg) ** 4)


def test_the_general_table_is_the_derivative_of_the_angles():
    alpha, phi, _length, _slide = random_loops(400, seed=7)
    found = loops.rccc(alpha, phi)
    calm = (found.status == Status.CLOSED) & (np.max(np.abs(found.coefficient), axis=(-2, -1)) < 5)
    alpha, phi, table = alpha[calm], phi[calm], found.coefficient[calm]
    assert len(phi) > 50
    h = 1e-4
    for seat in range(5):
        at = []
        for k in (-1, 1):
            changed = alpha.copy()
            if seat:
                changed[:, seat - 1] += k * h
            at.append(loops.rccc(changed, phi + (0 if seat else k * h)).angle)
        slope = np.angle(np.exp(1j * (at[1] - at[0]))) / (2 * h)
        assert slope == pytest.approx(table[..., seat], abs=1e-4)  # h² times a third derivative below 1e4


def test_the_book_s_equations_hold_for_the_table():
    """(167), (170): three linear relations between slides and lengths."""
    joint_angle, phi = 0.7, np.linspace(0.1, 6.0, 13)
    table = loops.influence(joint_angle, phi)
    f2, f4 = (loops.rccc(joint_loops(joint_angle), phi).angle[:, k] for k in (0, 2))
    s, c, cp, sp = np.sin(joint_angle), np.cos(joint_angle), np.cos(phi), np.sin(phi)
    two, three, four = (table[:, k] for k in range(3))
    zero, one = np.zeros_like(phi), np.ones_like(phi)
    left = sp[:, None] * two + np.sin(f4)[:, None] * three
    right = np.stack((zero, -cp, -cp * np.cos(f2), -np.cos(f4), -one), axis=-1)
    assert left == pytest.approx(right, abs=1e-14)
    left = -cp[:, None] * two + (c * np.cos(f4))[:, None] * three + s * four
    right = np.stack((zero, -sp, -sp * np.cos(f2), c * np.sin(f4), zero), axis=-1)
    assert left == pytest.approx(right, abs=1e-14)
    left = -s * np.cos(f4)[:, None] * three + c * four
    right = np.stack((-one, zero, -np.sin(f2), -s * np.sin(f4), zero), axis=-1)
    assert left == pytest.approx(right, abs=1e-14)


def test_slides_are_linear_in_lengths_and_angles_do_not_feel_them():
    alpha, phi, length, slide = random_loops(500, seed=8)
    bare = loops.rccc(alpha, phi)
    full = loops.rccc(alpha, phi, length=length, slide=slide)
    ok = bare.status == Status.CLOSED
    assert np.array_equal(bare.angle, full.angle, equal_nan=True)
    assert np.all(bare.slide[ok] == 0.0)
    twice = loops.rccc(alpha, phi, length=2 * length, slide=2 * slide)
    assert np.array_equal(twice.slide[ok], 2 * full.slide[ok])


@pytest.mark.slow
@settings(max_examples=200)
@given(st.lists(st.floats(5.0, 175.0), min_size=4, max_size=4))
def test_the_range_is_where_loops_close(alpha):
    angles = np.asarray(alpha) * deg
    found = loops.turning_range(angles)
    phi = np.linspace(0.0, np.pi, 181)
    status = loops.rccc(angles, phi).status
    inside = (np.cos(phi) >= found.lowest + 1e-9) & (np.cos(phi) <= found.highest - 1e-9)
    outside = (np.cos(phi) < found.lowest - 1e-9) | (np.cos(phi) > found.highest + 1e-9)
    assert np.all(status[inside] != Status.OPEN)
    assert np.all(status[outside] == Status.OPEN)
    assert bool(found.full) == (found.lowest <= -1 + 1e-12 and found.highest >= 1 - 1e-12)


def test_the_end_of_the_range_is_a_dead_position_where_both_branches_meet():
    alpha = np.asarray([30, 40, 45, 70]) * deg
    end = np.arccos(loops.turning_range(alpha).highest)
    both = loops.rccc(alpha, end, branch=np.asarray([-1.0, 1.0]))
    assert list(both.status) == [Status.DEAD, Status.DEAD]
    # The square root at the end of the range makes 1e-8 of 1e-16.
    assert both.angle[0] == pytest.approx(both.angle[1], abs=1e-7)
    assert np.all(np.isnan(both.slide))
    beyond = loops.rccc(alpha, end - 1e-6)
    assert beyond.status == Status.OPEN
    assert np.all(np.isnan(beyond.angle))


@pytest.mark.parametrize(
    ("alpha", "phi"), [((90, 0, 90, 30), 40), ((90, 90, 180, 30), 40), ((90, 180, 90, 30), 0), ((60, 90, 90, -60), 0)]
)
def test_parallel_axes_leave_an_angle_free(alpha, phi):
    found = loops.rccc(np.asarray(alpha) * deg, phi * deg)
    assert found.status == Status.FREE
    assert np.all(np.isnan(found.angle))


@pytest.mark.parametrize(
    ("alpha", "closes"), [((0, 90, 90, 30), True), ((90, 90, 90, 0), True), ((0, 10, 20, 80), False)]
)
def test_a_straight_link_leaves_the_range_without_bounds_or_empty(alpha, closes):
    found = loops.turning_range(np.asarray(alpha) * deg)
    assert bool(found.full) is closes
    assert np.isinf(found.highest) if closes else np.isnan(found.highest)
    assert np.all((loops.rccc(np.asarray(alpha) * deg, np.linspace(0.1, 6, 7)).status == Status.OPEN) != closes)


@pytest.mark.parametrize("branch", [-1.0, 1.0])
def test_angles_are_continuous_over_a_turn_on_one_branch(branch):
    alpha = random_loops(400, seed=4)[0]
    bounds = loops.turning_range(alpha)
    alpha = alpha[(bounds.lowest < -1.05) & (bounds.highest > 1.05)]
    assert len(alpha) > 30
    phi = np.linspace(0.0, 2 * np.pi, 2001)
    found = loops.rccc(alpha[:, None, :], phi, branch=branch)
    turned = np.unwrap(np.moveaxis(found.angle, -1, 1))
    steepest = np.max(np.abs(found.coefficient[..., 0]), axis=1)
    # A step is at most the steepest slope times the step of the input, and a bit for the curvature between.
    assert np.all(np.max(np.abs(np.diff(turned)), axis=-1) < 1.05 * steepest * phi[1])
    turns = (turned[..., -1] - turned[..., 0]) / (2 * np.pi)
    assert turns == pytest.approx(np.round(turns), abs=1e-12)


def test_negative_angles_between_axes_are_mirror_images():
    alpha, phi, length, slide = random_loops(300, seed=9)
    for flip in range(4):
        signs = np.where(np.arange(4) == flip, -1.0, 1.0)
        for branch in (-1.0, 1.0):
            found = loops.rccc(alpha * signs, phi, length=length, slide=slide, branch=branch)
            ok = found.status == Status.CLOSED
            left = loops.closure(
                (alpha * signs)[ok],
                np.concatenate((phi[ok, None], found.angle[ok]), axis=-1),
                length[ok],
                np.concatenate((slide[ok, None], found.slide[ok]), axis=-1),
            )
            assert left.max() < 1e-12


@given(st.floats(0.0, 70.0), st.floats(-400.0, 400.0), st.lists(st.floats(-3.0, 3.0), min_size=4, max_size=4))
def test_the_short_way_to_the_driven_shaft_is_that_of_the_loop(joint_angle, angle, errors):
    alpha = joint_loops(joint_angle * deg, np.asarray(errors) * deg)
    loop = loops.rccc(alpha, angle * deg)
    along, across, carried = loops.driven(np.cos(alpha), np.sin(alpha), np.cos(angle * deg), np.sin(angle * deg))
    assert along == pytest.approx(np.sin(loop.angle[2]), abs=1e-14)
    assert across == pytest.approx(np.cos(loop.angle[2]), abs=1e-14)
    assert np.stack(carried) == pytest.approx(-loop.coefficient[2], rel=1e-12, abs=1e-13)


def test_the_short_way_is_lost_where_the_loop_does_not_close():
    alpha = joint_loops(80 * deg, np.asarray([0, 20, 0, 0]) * deg)
    phi = np.linspace(0, 2 * np.pi, 37)
    along = loops.driven(np.cos(alpha), np.sin(alpha), np.cos(phi), np.sin(phi))[0]
    status = loops.rccc(alpha, phi).status
    assert np.array_equal(np.isnan(along), status != Status.CLOSED)
    assert 0 < np.isnan(along).sum() < 37


def test_loops_run_on_the_standard_alone():
    xp = pytest.importorskip("array_api_strict")
    alpha, phi, length, slide = random_loops(50)
    plain = loops.rccc(alpha, phi, length=length, slide=slide)
    strict = loops.rccc(*(xp.asarray(x) for x in (alpha, phi)), length=xp.asarray(length), slide=xp.asarray(slide))
    assert np.array_equal(np.asarray(strict.status), plain.status)
    assert np.allclose(np.asarray(strict.slide), plain.slide, rtol=1e-12, atol=0, equal_nan=True)
    spread = loops.turning_range(xp.asarray(alpha))
    assert np.array_equal(np.asarray(spread.full), loops.turning_range(alpha).full)
    table = loops.influence(xp.asarray(0.5), xp.asarray(phi))
    assert np.allclose(np.asarray(table), loops.influence(0.5, phi), rtol=0, atol=1e-15)
    left = loops.closure(*(xp.asarray(x) for x in (alpha, alpha, length, length)))
    assert left.shape == (50,)
