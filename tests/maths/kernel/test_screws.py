import numpy as np
import pytest

from cardan.maths.kernel import screws

X, Y, Z = np.eye(3)


def test_what_a_hinge_holds_does_no_work_on_what_it_leaves():
    hinge = screws.rotation(Z, np.array([0.3, -0.2, 0.7]))
    held = screws.reciprocal(hinge[None])
    assert held.shape == (5, 6)
    assert np.max(np.abs(held @ hinge)) < 1e-15
    assert np.max(np.abs(held @ held.T - np.eye(5))) < 1e-14


def test_nothing_free_holds_everything_and_the_other_way_round():
    assert screws.reciprocal(np.zeros((0, 6))).shape == (6, 6)
    assert screws.reciprocal(np.eye(6)).shape == (0, 6)


@pytest.mark.parametrize(
    ("sizes", "rank", "certain"),
    [([1, 2e-5, 1e-15], 2, True), ([1, 2e-5, 5e-8], 3, False), ([1, 2e-6, 5e-9], 2, False), ([0.0, 0.0], 0, True)],
)
def test_a_rank_tells_whether_it_is_certain(sizes, rank, certain):
    found = screws.rank(np.diag(sizes))
    assert (found.value, found.certain) == (rank, certain)


def test_null_spaces_are_what_they_say():
    rng = np.random.default_rng(1)
    matrix = rng.normal(size=(7, 3)) @ rng.normal(size=(3, 9))
    rank, left, right = screws.null_spaces(matrix)
    assert (rank.value, left.shape, right.shape) == (3, (4, 7), (6, 9))
    assert max(np.max(np.abs(left @ matrix)), np.max(np.abs(matrix @ right.T))) < 1e-13


def test_a_displacement_is_the_limit_of_many_small_ones():
    rng = np.random.default_rng(2)
    twist, amount = rng.normal(size=6), 1.3
    small = np.eye(4)
    small[:3, :3] += screws.hat(twist[:3]) * amount / 2**20
    small[:3, 3] = twist[3:] * amount / 2**20
    whole = small
    for _k in range(20):
        whole = whole @ whole
    # Euler's rule with 2**20 steps is off by about |twist|² amount² / 2**21.
    assert np.max(np.abs(screws.exponential(twist, np.asarray(amount)) - whole)) < 1e-4


def test_displacements_undo_carry_twists_and_tell_their_turn():
    rng = np.random.default_rng(3)
    twist, other = rng.normal(size=(2, 6))
    move = screws.exponential(twist, np.asarray(0.4))
    assert np.max(np.abs(move @ screws.inverse(move) - np.eye(4))) < 1e-15
    assert np.max(np.abs(screws.moved(move, twist) - twist)) < 1e-14  # a screw is not moved by its own motion
    carried = screws.exponential(screws.moved(move, other), np.asarray(0.7))
    assert np.max(np.abs(carried - move @ screws.exponential(other, np.asarray(0.7)) @ screws.inverse(move))) < 1e-14
    assert np.max(np.abs(screws.turned_by(move) - 0.4 * twist[:3])) < 1e-14


def test_sliding_is_a_displacement_too():
    assert np.allclose(screws.exponential(screws.translation(Y), np.asarray(0.2))[:3, 3], [0.0, 0.2, 0.0])
