"""Against the triangle drawn in coordinates and the drive of two joints as plain vectors."""

import array_api_strict as strict
import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan.drive.joints import double_cardan
from cardan.maths.kernel import mobius
from cardan.units import deg
from tests.builders.vector_model import VectorModel

JOINT_ANGLE = st.floats(1.0, 80.0).map(np.radians)
SHARE = st.floats(0.1, 0.9)


def triangle(joint_angle, share):
    """Return both joint angles and x/l with O1 at the origin, shaft 1 along x and the distance of the centres 1."""
    crossing = np.array([share, 0.0])
    way = np.array([np.cos(joint_angle), np.sin(joint_angle)])
    along = crossing @ way  # O3 = O + x way at the distance 1 from O1
    x = -along + np.sqrt(along**2 + 1.0 - share**2)
    middle = crossing + x * way
    first = np.arctan2(middle[1], middle[0])
    return first, joint_angle - first, x


@pytest.mark.slow
@given(JOINT_ANGLE, SHARE)
def test_the_triangle_of_the_centres_closes(joint_angle, share):
    first, second, x = triangle(joint_angle, share)
    # The plain triangle loses digits where the middle shaft runs along shaft 1; 1e-13 is a few ulps of its angles.
    np.testing.assert_allclose(double_cardan.split(joint_angle, share), (first, second), atol=1e-13)
    assert double_cardan.slide(joint_angle, share) == pytest.approx(x, abs=1e-14)


@given(JOINT_ANGLE, SHARE)
def test_the_book_leaves_the_square_of_what_it_leaves_out(joint_angle, share):
    # (12) solves the quadratic (10)-(12); its root is checked in the quadratic itself.
    t = np.tan(0.5 * joint_angle)
    small = double_cardan.lag_book(joint_angle, share)
    a = 2 * share**2 * (1 - np.cos(joint_angle)) - 1
    c = 2 * share**2 * (1 + np.cos(joint_angle)) - 1
    assert a * small**2 - 2 * small * t + t * t * c == pytest.approx(0.0, abs=1e-13 * (1 + t * t))


@pytest.mark.parametrize(("joint_angle", "share"), [(10, 0.5), (30, 0.5), (40, 0.52), (80, 0.7)])
def test_the_missed_half_to_all_digits(joint_angle, share):
    with mpmath.workdps(40):
        alpha = mpmath.mpf(joint_angle * deg)
        exact = mpmath.asin(mpmath.mpf(share) * mpmath.sin(alpha)) - alpha / 2
    # The factor 2 λ cos(α/2) - 1 alone can lose digits, where the joint angle is nearly halved: here one at most.
    assert double_cardan.lag(joint_angle * deg, share) == pytest.approx(float(exact), rel=2e-14)


@given(JOINT_ANGLE)
def test_the_even_share_halves_the_bend(joint_angle):
    share = double_cardan.even_share(joint_angle)
    assert double_cardan.lag(joint_angle, share) == pytest.approx(0.0, abs=1e-15)
    assert double_cardan.slide(joint_angle, share) == pytest.approx(share, abs=1e-14)


@settings(max_examples=25)
@given(JOINT_ANGLE, SHARE, st.floats(-170.0, 170.0))
def test_it_turns_as_two_joints_of_plain_vectors(joint_angle, share, angle):
    phi = angle * deg
    model = VectorModel.from_angles(list(triangle(joint_angle, share)[:2]), [0.0], [0.0])
    angle_error = np.remainder(model.angles(phi)[-1] - phi + 1.0, 2 * np.pi) - 1.0
    # The plain vectors lose a few digits where the middle shaft bends steeply.
    assert double_cardan.deviation(phi, joint_angle, share) == pytest.approx(angle_error, abs=1e-12)


@pytest.mark.parametrize("crossed", [False, True])
@pytest.mark.parametrize(("first", "second"), [(15, 14), (10, 25), (40, 5), (60, 55)])
def test_two_joints_swing_as_plain_vectors_do(first, second, crossed):
    model = VectorModel.from_angles([first * deg, second * deg], [0.0], [0.5 * np.pi if crossed else 0.0])
    ends = double_cardan.gain(first * deg, second * deg, crossed=crossed)
    left = double_cardan.unevenness(first * deg, second * deg, crossed=crossed)
    assert left == pytest.approx(ends - 1 / ends, abs=1e-14)
    assert abs(left) == pytest.approx(model.speed_fluctuation(), rel=1e-7), (
        "the vectors are sampled, with a parabola on top"
    )


def test_the_map_is_that_of_the_deviation():
    phi = np.linspace(0, 2 * np.pi, 37)
    pair = double_cardan.centred_pair(50 * deg, 0.4)
    angle_error = mobius.angle_error(pair, np.exp(2j * phi))
    np.testing.assert_allclose(double_cardan.deviation(phi, 50 * deg, 0.4), angle_error, atol=1e-15)


def test_other_array_libraries():
    joint_angle = strict.asarray([0.1, 0.6])
    np.testing.assert_allclose(
        np.asarray(double_cardan.lag(joint_angle, 0.5)), double_cardan.lag([0.1, 0.6], 0.5), rtol=1e-15
    )
    np.testing.assert_allclose(
        np.asarray(double_cardan.deviation(joint_angle, joint_angle, 0.5)),
        double_cardan.deviation([0.1, 0.6], [0.1, 0.6], 0.5),
        rtol=1e-14,
    )
