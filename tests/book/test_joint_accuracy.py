import numpy as np
import pytest

from cardan import InputError
from cardan.book.joint_accuracy import joint_samples, joint_stack, stack_over_turn
from cardan.maths.kernel import loops
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.units import deg, mm

WAYS = np.asarray([0.05, 0.03, 0.04, 0.03, 0.1]) * mm
TURNS = np.asarray([0.05, 0.08, 0.05, 0.2]) * deg


def test_the_stack_is_that_of_loops_with_one_error_each():
    """Exact loops, one unit length at a time; one small angle at a time by differences."""
    joint_angle, phi = 0.6, np.asarray([0.3, 1.9, 4.0])
    perfect = np.asarray([0.5 * np.pi] * 3 + [joint_angle])
    slides, angles = [], []
    for k in range(5):
        one = np.eye(5)[k]
        slides.append(loops.rccc(perfect, phi, length=one[1:], slide=one[0]).slide * WAYS[k])
    for k in range(4):
        step = 1e-5 * np.eye(4)[k]
        up, down = (loops.rccc(perfect + sign * step, phi).angle for sign in (1, -1))
        angles.append((up - down) / 2e-5 * TURNS[k])
    found = joint_stack(joint_angle, phi, ways=WAYS, turns=TURNS)
    assert found.worst_slide == pytest.approx(np.sum(np.abs(slides), axis=0), rel=1e-12)
    assert found.square_slide == pytest.approx(np.linalg.norm(slides, axis=0), rel=1e-12)
    # Differences with a step of 1e-5 leave 1e-10 of third derivatives and 1e-11 of rounding.
    assert found.worst_angle == pytest.approx(np.sum(np.abs(angles), axis=0), rel=1e-8)
    assert found.square_angle == pytest.approx(np.linalg.norm(angles, axis=0), rel=1e-8)
    assert found.share_slide == pytest.approx(np.moveaxis((slides / np.linalg.norm(slides, axis=0)) ** 2, 0, -1))


def test_batches_of_bends_and_angles():
    joint_angle, phi = np.asarray([[0.1], [0.5]]), np.asarray([0.0, 1.0, 2.0])
    found = joint_stack(joint_angle, phi, ways=WAYS, turns=TURNS)
    assert found.worst_angle.shape == (2, 3, 3)
    assert found.share_slide.shape == (2, 3, 3, 5)
    alone = joint_stack(0.5, 2.0, ways=WAYS, turns=TURNS)
    assert found.worst_angle[1, 2] == pytest.approx(alone.worst_angle, rel=1e-14)
    none = joint_stack(0.5, 2.0, ways=np.zeros(5), turns=TURNS)
    assert np.all(np.isnan(none.share_slide))


@pytest.mark.parametrize("joint_angle", [5, 30, 60])
def test_known_peaks_over_a_turn(joint_angle):
    alpha = joint_angle * deg

    def largest(k):
        return stack_over_turn(alpha, ways=np.zeros(5), turns=np.eye(4)[k]).worst_angle

    # Pin B: sin α to 45°, then 1/(2 cos α); cross: 1/cos α; pin C: tan α; bend: ½ tan α.
    assert largest(0) == pytest.approx(np.sin(alpha) if joint_angle <= 45 else 0.5 / np.cos(alpha), rel=1e-10)
    assert largest(1) == pytest.approx(1 / np.cos(alpha), rel=1e-10)
    assert largest(2) == pytest.approx(np.tan(alpha), rel=1e-10)
    assert largest(3) == pytest.approx(0.5 * np.tan(alpha), rel=1e-10)
    equal = stack_over_turn(alpha, ways=WAYS, turns=TURNS).equal_turns
    assert equal == pytest.approx([0.5 / largest(k) for k in range(4)], rel=1e-10)


def test_without_a_bend_there_is_no_limit_for_what_has_no_effect():
    found = stack_over_turn(0.0, ways=WAYS, turns=TURNS)
    assert np.array_equal(np.isnan(found.equal_turns), [True, False, True, True])
    assert found.worst_angle == pytest.approx(TURNS[1])


def test_samples_are_those_of_the_exact_loop():
    """Uniform error of the cross alone, tens of degrees wide, against a fine grid of it."""
    wide = np.asarray([0.0, 20 * deg, 0.0, 0.0])
    found = joint_samples(
        0.5, 0.8, ways=np.zeros(5), turns=wide, distribution="uniform", method=MonteCarlo(samples=16384)
    )
    alpha = np.asarray([0.5 * np.pi] * 3 + [0.5]) + np.linspace(-1, 1, 4001)[:, None] * wide
    angle = loops.rccc(alpha, 0.8).angle
    assert found.angle_deviation == pytest.approx(np.std(angle, axis=0), rel=1e-3)
    assert found.angle_mean == pytest.approx(np.mean(angle - angle[2000], axis=0), abs=1e-4)
    assert found.angle_levels == pytest.approx(
        np.quantile(angle - angle[2000], [0.0015, 0.025, 0.975, 0.9985], axis=0), abs=1e-3
    )
    assert np.all(found.slide_deviation == 0.0)
    assert (found.count, found.lost) == (16384, 0)


def test_joints_that_cannot_be_assembled_are_left_out():
    found = joint_samples(
        80 * deg, 0.0, ways=WAYS, turns=[0, 20 * deg, 0, 0], distribution="uniform", method=MonteCarlo(samples=4096)
    )
    # At φ_1 = 0 a cross out of square by more than 10° has no place.
    assert found.lost == pytest.approx(2048, abs=8)
    assert np.all(np.isfinite(found.angle_deviation))


def test_sobol_points_and_random_ones_agree():
    one, other = (
        joint_samples(0.4, 0.9, ways=WAYS, turns=TURNS, method=MonteCarlo(samples=32768, points=points))
        for points in ("sobol", "random")
    )
    # Four standard errors of a deviation from random samples.
    assert other.angle_deviation == pytest.approx(one.angle_deviation, rel=4 / np.sqrt(65536))
    assert other.slide_deviation == pytest.approx(one.slide_deviation, rel=4 / np.sqrt(65536))


def test_where_none_can_be_assembled_that_is_said():
    with pytest.raises(InputError) as caught:
        joint_samples(90 * deg - 1e-9, 0.0, ways=WAYS, turns=[0, 20 * deg, 0, 0], method=MonteCarlo(samples=128))
    assert caught.value.field == "turns"
