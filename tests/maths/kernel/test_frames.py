import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan.maths.kernel import frames

ANGLES = st.floats(-3.1, 3.1)


@st.composite
def directions(draw):
    raw = np.asarray([draw(st.floats(-1, 1)) for _ in range(3)])
    size = np.linalg.norm(raw)
    return raw / size if size > 0.1 else np.asarray([0.0, 0.0, 1.0])


@given(directions(), directions(), ANGLES, ANGLES)
def test_turns_about_one_axis_add_up(vector, axis, one, two):
    twice = frames.rotate(frames.rotate(vector, axis, np.asarray(one)), axis, np.asarray(two))
    assert np.allclose(twice, frames.rotate(vector, axis, np.asarray(one + two)), rtol=0, atol=1e-15 * 4)


@given(directions(), directions(), directions(), ANGLES)
def test_turns_keep_lengths_angles_and_hands(a, b, axis, angle):
    turn = np.asarray(angle)
    one, two = frames.rotate(a, axis, turn), frames.rotate(b, axis, turn)
    assert frames.dot(one, two) == pytest.approx(frames.dot(a, b), abs=1e-15 * 4)
    assert np.allclose(frames.cross(one, two), frames.rotate(frames.cross(a, b), axis, turn), rtol=0, atol=1e-14)


@given(directions(), ANGLES)
def test_the_angle_about_an_axis_is_the_turn(axis, angle):
    start = frames.perpendicular(axis)
    assert frames.dot(start, axis) == pytest.approx(0.0, abs=1e-15)
    end = frames.rotate(start, axis, np.asarray(angle))
    assert frames.angle_about(axis, start, end) == pytest.approx(angle, abs=1e-14)


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-8, 1.0, np.pi - 1e-8, np.pi])
def test_angles_between_directions_are_accurate_at_both_ends(angle):
    a, b = np.asarray([1.0, 0.0, 0.0]), np.asarray([np.cos(angle), np.sin(angle), 0.0])
    # An acos would be 1e-8 off here.
    assert frames.angle_between(a, b) == pytest.approx(angle, abs=5e-16)


@pytest.mark.parametrize("a", [(1.0, 0, 0), (0, 1.0, 0), (0, 0, 1.0), (0, 0, -1.0), (1e-12, 0, 1.0), (0.6, 0, 0.8)])
def test_a_perpendicular_always_exists(a):
    b = frames.perpendicular(np.asarray(a))
    assert abs(frames.dot(np.asarray(a), b)) <= 1e-11
    assert frames.norm(b) == pytest.approx(1.0, abs=1e-15)


def test_batches_equal_their_members():
    rng = np.random.default_rng(3)
    a, b = rng.normal(size=(2, 4, 5, 3))
    assert np.array_equal(frames.cross(a, b)[2, 3], frames.cross(a[2, 3], b[2, 3]))
    assert np.allclose(frames.cross(a, b), np.cross(a, b), rtol=0, atol=1e-15)
