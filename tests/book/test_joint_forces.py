"""Closed forms of single and double joints against vectors and sampled turns."""

from __future__ import annotations

import array_api_strict as strict
import numpy as np
import pytest

from cardan.book.joint_forces import (
    double_joint_forces,
    largest_middle_couple,
    single_joint_forces,
    single_joint_peaks,
    spline_thrust,
)
from cardan.questions.forces.forces import journal_loads
from cardan.units import deg

TURN = np.arange(720) * (np.pi / 360)
SIZES = {"span": 0.1, "bearing_span": 0.3, "overhang": 0.08, "reach": 0.4}


@pytest.mark.parametrize("joint_angle", [5 * deg, 40 * deg, 45 * deg, 70 * deg])
@pytest.mark.parametrize("end", ["output", "input"])
def test_peaks_of_a_single_joint_are_those_of_a_turn(joint_angle: float, end: str) -> None:
    found = single_joint_forces(joint_angle, np.linspace(0, np.pi, 100001), 1.0, located=False, **SIZES)
    given = found.driving_torque if end == "input" else 1.0
    peaks = single_joint_peaks(joint_angle, torque_at=end)
    assert np.max(found.driving_couple / given) == pytest.approx(float(peaks.driving_couple), rel=1e-8)
    assert np.max(found.driven_couple / given) == pytest.approx(float(peaks.driven_couple), rel=1e-8)
    load = found.journal[:-1] * 0.1 / (given[:-1] if end == "input" else 1.0)
    assert np.max(load) == pytest.approx(float(peaks.journal), rel=1e-8)
    # samples of a smooth period: the mean is right to rounding
    assert np.mean(load) == pytest.approx(float(peaks.journal_mean), rel=1e-12)


def test_parts_of_a_journal_load_make_the_whole() -> None:
    found = single_joint_forces(30 * deg, TURN, 1000.0, located=True, **SIZES)
    for one, two in ((found.driving_across, found.driving_along), (found.driven_across, found.driven_along)):
        np.testing.assert_allclose(np.hypot(one, two), found.journal, rtol=1e-12)
    # the force of the located cross lies along the driven arm: its parts on shaft 1 make up the load of the bearing
    side = found.driven_bearing * np.sqrt(1 - (found.axial / np.maximum(found.driven_bearing, 1e-300)) ** 2)
    lateral = np.sqrt(np.maximum(found.near**2 - (found.driving_couple / 0.3) ** 2, 0.0)) * 0.3 / 0.38
    np.testing.assert_allclose(lateral, side, atol=1e-5)


def test_the_book_takes_twice_the_axial_load_of_a_located_cross() -> None:
    found = single_joint_forces(30 * deg, TURN, 1000.0, located=True, **SIZES)
    assert found.axial.max() == pytest.approx(0.5 * 1000 * np.sin(30 * deg) * np.tan(30 * deg) / 0.4, rel=1e-4)
    assert found.axial[0] == 0.0


@pytest.mark.parametrize("joint_angle", [10 * deg, 20 * deg, 30 * deg, 55 * deg])
def test_the_book_forms_of_synchronous_double_joints(joint_angle: float) -> None:
    """Book (120) with β in place of its γ: S = M √2 sin α |cos φ| w √(1 + cos β), yokes set for an even output."""
    w = np.sqrt(1 + np.tan(joint_angle) ** 2 * np.sin(TURN) ** 2)
    for twist in (0.0, 1.1, np.pi):
        found = double_joint_forces(
            joint_angle, joint_angle, TURN, plane_twist=twist, yoke_angle=-twist, torque=100.0, length=0.7
        )
        wanted = 100 * np.sqrt(2) * np.sin(joint_angle) * np.abs(np.cos(TURN)) * w * np.sqrt(1 + np.cos(twist))
        np.testing.assert_allclose(found.middle_couple, wanted, atol=1e-9)
        np.testing.assert_allclose(found.driving_torque, 100.0, rtol=1e-12)
        np.testing.assert_allclose(np.hypot(found.along_arm, found.across_arm), found.pair_force, atol=1e-9)


def test_couples_on_the_middle_shaft_add_as_signed_vectors() -> None:
    """Book (114), (115): m_1 and m_2 with their signs, the angle between them γ."""
    a1, a2, gamma = 18 * deg, 12 * deg, -35 * deg
    found = double_joint_forces(a1, a2, TURN, plane_twist=70 * deg, yoke_angle=gamma, torque=300.0, length=0.9)
    one, two = found.middle_first, found.middle_second
    angle = np.abs(np.cos(gamma))
    size = found.middle_couple**2 - one**2 - two**2
    np.testing.assert_allclose(np.abs(size), 2 * one * two * angle, atol=1e-7)
    np.testing.assert_allclose(
        found.along_arm * 0.9, np.sqrt(found.middle_couple**2 - (two * np.sin(gamma)) ** 2), atol=1e-6
    )
    np.testing.assert_allclose(found.across_arm * 0.9, two * np.abs(np.sin(gamma)), atol=1e-9)


@pytest.mark.parametrize("joint_angles", [(0.0, 0.4), (0.4, 0.0), (0.0, 0.0)])
def test_a_straight_joint_of_a_double_joint_keeps_its_plane(joint_angles: tuple[float, float]) -> None:
    """θ_1 counts from the plane that the twist stands from: the limit of ever smaller bends."""
    angle = np.linspace(0.0, 3.0, 7)
    placed = {"plane_twist": 0.7, "yoke_angle": 0.3, "torque": 100.0, "length": 0.5}
    found = double_joint_forces(*joint_angles, angle, **placed)
    near = double_joint_forces(*(joint_angle or 1e-8 for joint_angle in joint_angles), angle, **placed)
    for name in ("driving_torque", "middle_couple", "pair_force", "last_couple", "last_axial"):
        # a joint angle of 1e-8 shows to the first order in 100 N·m and in the forces at half a metre
        np.testing.assert_allclose(getattr(found, name), getattr(near, name), rtol=0, atol=1e-5)


@pytest.mark.parametrize("joint_angle", [20 * deg, 44 * deg, 55 * deg])
def test_largest_couple_of_the_v_arrangement(joint_angle: float) -> None:
    most, _at = largest_middle_couple(joint_angle, joint_angle, torque=50.0)
    assert most == pytest.approx(
        100 * np.sin(joint_angle) if joint_angle <= 45 * deg else 50 / np.cos(joint_angle), rel=1e-11
    )


def test_thrust_of_a_spline_by_its_projections() -> None:
    joint_angle, c, s = 25 * deg, np.cos(25 * deg), np.sin(25 * deg)
    e2 = np.asarray([c, s, 0.0])
    found = spline_thrust(joint_angle, TURN, 800.0, 4.0)
    u = np.stack((0 * TURN, np.cos(TURN), np.sin(TURN)), axis=-1)
    v = np.cross(e2, u)
    v /= np.linalg.norm(v, axis=-1)[:, None]
    np.testing.assert_allclose(found.along_driving_arm, 3200 * u @ e2, atol=1e-9)
    np.testing.assert_allclose(found.along_driven_arm, 3200 * v @ e2, atol=1e-9)
    np.testing.assert_allclose(found.along_normal, 3200 * np.abs(np.cross(u, v) @ e2), atol=1e-9)
    np.testing.assert_allclose(found.axial, 3200 * c)
    np.testing.assert_allclose(found.radial, 3200 * s)


def test_closed_forms_take_any_array_library() -> None:
    angle = strict.asarray(TURN)
    joint_angle = strict.asarray(0.4)
    single = single_joint_forces(
        joint_angle, angle, strict.asarray(100.0), located=True, **{k: strict.asarray(v) for k, v in SIZES.items()}
    )
    np.testing.assert_allclose(
        np.asarray(single.near), single_joint_forces(0.4, TURN, 100.0, located=True, **SIZES).near
    )
    thrust = spline_thrust(joint_angle, angle, strict.asarray(100.0), strict.asarray(3.0))
    np.testing.assert_allclose(np.asarray(thrust.along_normal), spline_thrust(0.4, TURN, 100.0, 3.0).along_normal)
    peaks = single_joint_peaks(strict.asarray([0.4, 1.0]))
    np.testing.assert_allclose(np.asarray(peaks.journal_mean), single_joint_peaks(np.asarray([0.4, 1.0])).journal_mean)


def test_a_force_in_the_joint_is_shared_by_opposite_journals() -> None:
    x, y, z = np.eye(3)
    found = journal_loads(0 * x, 0 * x, y, z, np.asarray(0.1), 10 * x + 3 * y, 10 * x + 3 * y)
    np.testing.assert_allclose(found.load[:2], [[5, 0, 0]] * 2)
    np.testing.assert_allclose(found.load[2:], [[5, 1.5, 0]] * 2)
    np.testing.assert_allclose(found.thrust, [3, 0])
