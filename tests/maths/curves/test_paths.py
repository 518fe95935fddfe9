import numpy as np
import pytest

from cardan.maths.curves import paths
from cardan.maths.kernel import frames
from cardan.questions.motion.moving_chain import harmonic_points, moving_shafts


def test_shortest_arc_turns_about_the_common_normal():
    x, y, z = np.eye(3)
    direction = np.asarray([np.cos(0.7), np.sin(0.7), 0.0])
    np.testing.assert_allclose(paths.shortest_arc(x, direction, x), direction, atol=1e-15)
    np.testing.assert_allclose(paths.shortest_arc(x, direction, z), z, atol=1e-15)
    np.testing.assert_allclose(paths.shortest_arc(x, direction, y), frames.rotate(y, z, np.asarray(0.7)), atol=1e-15)


def test_rotations_in_series_have_their_derivatives():
    step = 1e-4
    times = step * np.arange(1001)
    both = paths.chained(
        paths.turning([0, 0, 1], paths.swing(0.8, 5.0, 0.1, times)),
        paths.turning([1, 2, 0], paths.swing(0.5, 9.0, 1.0, times)),
    )
    identity = np.swapaxes(both[0], -1, -2) @ both[0]
    np.testing.assert_allclose(identity, np.broadcast_to(np.eye(3), identity.shape), atol=1e-14)
    # h²/6 of the third derivative, some 1e3.
    np.testing.assert_allclose(np.gradient(both[0], step, axis=0)[1:-1], both[1][1:-1], atol=5e-6)
    np.testing.assert_allclose(np.gradient(both[1], step, axis=0)[1:-1], both[2][1:-1], atol=5e-5)


def test_transport_round_a_cone_twists_by_its_solid_angle():
    half = 0.3

    def direction(times):
        c, s = np.cos(times), np.sin(times)
        a = np.stack((np.sin(half) * c, np.sin(half) * s, np.cos(half) + 0.0 * times), axis=-1)
        return a, np.stack((-np.sin(half) * s, np.sin(half) * c, 0.0 * times), axis=-1)

    found = paths.transport(direction, np.asarray([2.0 * np.pi, 0.0, -2.0 * np.pi]))
    solid = 2.0 * np.pi * (1.0 - np.cos(half))
    # The shortest-arc frame comes back to itself; the carried one has turned by the solid angle of the cone.
    np.testing.assert_allclose(np.abs(found), [solid, 0.0, solid], atol=1e-11)
    assert found[0] == pytest.approx(-found[2], abs=1e-11)


def test_transport_is_the_spin_of_the_shortest_arc_frame_by_differences():
    def direction(times):
        tilt = 0.3 + 0.2 * np.sin(times)
        return np.stack((np.sin(tilt) * np.cos(times), np.sin(tilt) * np.sin(times), np.cos(tilt)), axis=-1)

    step = 1e-3
    times = step * np.arange(2001)
    a = direction(times)
    frame = paths.shortest_arc(a[0], a, frames.perpendicular(a[0]))
    spin = frames.dot(np.gradient(frame, step, axis=0), np.cross(a, frame))
    found = paths.transport(lambda at: (direction(at), (direction(at + 1e-6) - direction(at - 1e-6)) / 2e-6), times)
    # Trapezoids and differences of second order over 2 s with h = 1e-3.
    np.testing.assert_allclose(found[-1], np.trapezoid(spin, times), atol=1e-6)
    assert abs(found[-1]) > 0.05


def test_transport_of_a_plane_swing_is_nothing():
    path = harmonic_points([[-1, 0, 0], [0, 0, 0], [1, 0, 0]], [[0, 0, 0], [0, 0, 0.4], [0, 0, 0]], frequency=3.0)
    times = np.linspace(0.0, 4.0, 41)

    def direction(at):
        shafts = moving_shafts(path(at))
        return shafts.axis[:, 0], shafts.axis_rate[:, 0]

    np.testing.assert_array_equal(paths.transport(direction, times), 0.0)
