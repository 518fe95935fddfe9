"""Against the balance of all six equations, solved as a system without any step of the book's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import fsolve

from cardan.book.instruments import Contact, SlotCam, cam_forces, follower_force
from cardan.units import deg

BASE = SlotCam(
    radius=0.03,
    length=0.12,
    weight=8.0,
    first_slope=55 * deg,
    second_slope=60 * deg,
    first_place=-0.02,
    second_place=0.03,
    drive_place=0.05,
    first_friction=0.1,
    second_friction=0.1,
    first_guide_friction=0.12,
    second_guide_friction=0.12,
    rim_friction=0.1,
    end_friction=0.1,
    far_friction=0.1,
)


def follower(load, slope, friction, guide):
    """Balance a follower: the slot's normal and friction, its guide's normal and friction, the load along z."""

    across = np.cos(slope) + friction * np.sin(slope)
    along = np.sin(slope) - friction * np.cos(slope)
    normal, _side = np.linalg.solve([[along, -guide], [across, -1.0]], [load, 0.0])
    return normal


@pytest.mark.parametrize(("slope", "friction", "guide"), [(55, 0.1, 0.12), (30, 0.2, 0.0), (88, 0.0, 0.3)])
def test_the_follower_is_in_balance(slope, friction, guide):
    normal = follower(20.0, slope * deg, friction, guide)
    found = float(follower_force(20.0, slope * deg, friction, guide))
    assert found == pytest.approx(normal * np.hypot(1, friction), rel=1e-12)


def sums(x, cam, normal2, normal4, psi, side):
    """Add all forces and moments on the cam for rim forces and the angles at which they act."""
    drive, end, rim, far, at_c, at_d = x
    r, half = cam.radius, 0.5 * cam.length

    def contact(normal, friction, angle, z):
        inward, back = -np.array([np.cos(angle), np.sin(angle), 0]), np.array([np.sin(angle), -np.cos(angle), 0])
        return [([r * np.cos(angle), r * np.sin(angle), z], normal * (inward + friction * back))]

    def push(normal, slope, friction, z, sense):
        # The slot's normal stands at its slope to the cam's circumference; friction lies along the slot.
        across = normal * np.cos(slope) + friction * normal * np.sin(slope)
        along = normal * np.sin(slope) - friction * normal * np.cos(slope)
        return [([-r, 0, z], np.array([0, across, sense * along]))]

    acting = push(normal2, cam.first_slope, cam.first_friction, cam.first_place, -1)
    acting += push(normal4, cam.second_slope, cam.second_friction, cam.second_place, 1)
    acting += [
        (
            [-r * np.cos(psi), -r * np.sin(psi), cam.drive_place],
            drive * np.array([np.sin(psi), -np.cos(psi), 0]),
        )
    ]
    acting += [([0, 0, cam.weight_place], np.array([cam.weight, 0, 0]))]
    acting += contact(rim, cam.rim_friction, at_c, side * half)
    place = [r * np.cos(at_c), r * np.sin(at_c), side * half]
    rubbed = cam.end_friction * np.array([np.sin(at_c), -np.cos(at_c), 0])
    acting += [(place, end * (rubbed - [0, 0, side]))]
    acting += contact(far, cam.far_friction, at_d, -side * half)
    force = sum(f for _p, f in acting)
    moment = sum(np.cross(p, f) for p, f in acting)
    return np.concatenate([force, moment / r])


RNG = np.random.default_rng(12)


def cams(count):
    for _k in range(count):
        u = RNG.uniform
        yield (
            SlotCam(
                radius=u(0.02, 0.05),
                length=u(0.08, 0.25),
                weight=u(0, 30),
                first_slope=u(35, 80) * deg,
                second_slope=u(35, 80) * deg,
                first_place=u(-0.03, 0.03),
                second_place=u(-0.03, 0.03),
                drive_place=u(-0.04, 0.04),
                weight_place=u(-0.01, 0.01),
                first_friction=u(0, 0.2),
                second_friction=u(0, 0.2),
                first_guide_friction=u(0, 0.2),
                second_guide_friction=u(0, 0.2),
                rim_friction=u(0, 0.15),
                end_friction=u(0, 0.15),
                far_friction=u(0, 0.15),
            ),
            u(5, 60),
            u(5, 60),
            u(-0.5, 4),
        )


@pytest.mark.parametrize(("cam", "load2", "load4", "psi"), [(BASE, 20.0, 35.0, 0.0), *cams(24)])
def test_all_six_equations_hold(cam, load2, load4, psi):
    found = cam_forces(cam, load2, load4, psi)
    assert found.status == Contact.BOTH_ENDS
    assert found.imbalance < 1e-14
    normal = [
        follower(load2, cam.first_slope, cam.first_friction, cam.first_guide_friction),
        follower(load4, cam.second_slope, cam.second_friction, cam.second_guide_friction),
    ]
    side = float(found.end_side)
    assert found.end >= 0
    x = [float(one) for one in (found.drive, found.end, found.rim, found.far)]
    x += [float(np.arctan2(*point[::-1])) for point in (found.rim_point, found.far_point)]
    assert np.allclose(np.linalg.norm([found.rim_point, found.far_point], axis=-1), cam.radius, rtol=1e-13)
    # Forces to some 300 N.
    assert np.abs(sums(x, cam, *normal, psi, side)).max() < 2e-12


def test_the_system_solved_at_once_has_this_solution():
    found = cam_forces(BASE, 20.0, 35.0)
    normal = [follower(20.0, 55 * deg, 0.1, 0.12), follower(35.0, 60 * deg, 0.1, 0.12)]
    at = [float(np.arctan2(*point[::-1])) for point in (found.rim_point, found.far_point)]
    near = [50.0, 15.0, 25.0, 20.0, at[0] + 0.1, at[1] - 0.1]
    x, _info, sure, words = fsolve(lambda x: sums(x, BASE, *normal, 0.0, 1.0), near, xtol=1e-13, full_output=True)
    assert sure == 1, words
    want = [float(one) for one in (found.drive, found.end, found.rim, found.far)]
    assert np.allclose(x[:4], want, rtol=1e-10)


def test_work_put_in_is_work_taken_out_plus_friction():
    """Turn by a small angle: the drive's work is that of the followers' forces and of friction at both rims."""
    found = cam_forces(BASE, 20.0, 35.0, 0.7)
    lean = [BASE.first_slope - np.arctan(0.1), BASE.second_slope - np.arctan(0.1)]
    out = found.first * np.cos(lean[0]) + found.second * np.cos(lean[1])
    rubbed = 0.1 * (found.rim + found.end + found.far)
    assert float(found.drive) == pytest.approx(float(out + rubbed), rel=1e-14)


def test_many_cams_equal_single_ones():
    psi = np.linspace(0, 6, 7)
    many = cam_forces(replace(BASE, first_slope=np.asarray([[55.0], [10.0], [40.0]]) * deg), 40.0, 35.0, psi)
    for i, slope in enumerate((55, 10, 40)):
        for k, angle in enumerate(psi):
            one = cam_forces(replace(BASE, first_slope=slope * deg), 40.0, 35.0, angle)
            assert np.allclose([many.rim[i, k], many.far[i, k]], [one.rim, one.far], rtol=1e-12, equal_nan=True)
            assert many.status[i, k] == one.status
    assert list(many.status[:, 0]) == [Contact.BOTH_ENDS, Contact.FIRST_JAMS, Contact.BOTH_ENDS]
    assert many.rim_point.shape == (3, 7, 2)


def test_jamming_and_other_contacts_are_told():
    limit = np.arctan(0.1) + np.arctan(0.12)
    for share, status in ((1 - 1e-12, Contact.SECOND_JAMS), (1 + 1e-3, Contact.BOTH_ENDS)):
        assert cam_forces(replace(BASE, second_slope=limit * share), 20.0, 35.0, 2.0).status == status
    assert np.isnan(follower_force(1.0, limit, 0.1, 0.12))


@pytest.mark.slow
def test_a_cam_that_no_two_rims_hold_is_told_and_the_equations_have_no_answer():
    """Where weight and drive cancel across the axis, the end plane tips the cam and it must lie on the whole plane."""
    cam, psi = replace(BASE, weight=30.0, drive_place=0.03, length=0.24), 5.7
    found = cam_forces(cam, 10.0, 55.0, psi)
    assert found.status == Contact.OTHER
    assert np.isnan([found.drive, found.end, found.rim, found.imbalance]).all()
    assert found.second > 0
    normal = [follower(10.0, 55 * deg, 0.1, 0.12), follower(55.0, 60 * deg, 0.1, 0.12)]
    for at_c in np.arange(0, 6, 1.5):
        for at_d in np.arange(0.5, 6, 1.5):
            x, _info, sure, _words = fsolve(
                lambda x: sums(x, cam, *normal, psi, 1.0), [60, 40, 30, 30, at_c, at_d], full_output=True
            )
            assert sure != 1 or min(x[2:4]) < 0


def test_loads_in_proportion_give_forces_in_proportion():
    one, ten = (cam_forces(replace(BASE, weight=8.0 * k), 20.0 * k, 35.0 * k, 0.3) for k in (1.0, 1e6))
    for name in ("first", "drive", "rim", "far", "end"):
        assert float(getattr(ten, name)) == pytest.approx(1e6 * float(getattr(one, name)), rel=1e-12)


def test_not_a_number_stays_one():
    found = cam_forces(replace(BASE, weight=np.asarray([8.0, np.nan])), 20.0, 35.0)
    assert not np.isnan(found.rim[0])
    assert np.isnan(found.rim[1])
    assert list(found.status) == [Contact.BOTH_ENDS, Contact.OTHER]
