"""Life of oscillating bearings against plain sums over the turn and makers' own rating points."""

import numpy as np
import pytest
from scipy.special import hyp2f1

from cardan.questions.life.bearing_life import RELIABILITIES, bearing_life, maker_life, reliability_factor, swing_damage
from cardan.units import deg, hour, rpm

P = 10.0 / 3.0


def summed(joint_angle, torque_at, count=200_000):
    """Return the damage of a turn in both yokes by swings and loads of the cross, summed from step to step."""
    phi = 2.0 * np.pi * np.arange(count + 1) / count
    middle = 0.5 * (phi[1:] + phi[:-1])
    s = np.sqrt(1.0 + (np.tan(joint_angle) * np.sin(middle)) ** 2)
    load = s if torque_at == "input" else 1.0 / (np.cos(joint_angle) * s)
    swings = np.arctan(np.tan(joint_angle) * np.sin(phi)), np.arcsin(np.sin(joint_angle) * np.cos(phi))
    return [np.sum(np.abs(np.diff(swing)) * load**P) / (2.0 * np.pi) for swing in swings]


@pytest.mark.parametrize("torque_at", ["input", "output"])
@pytest.mark.parametrize("joint_angle", [0.01, 12 * deg, 30 * deg, 70 * deg])
def test_the_integral_is_the_sum_over_the_turn(joint_angle, torque_at):
    """The sum errs with the square of the step: some 1e-9 at 200 000 steps."""
    np.testing.assert_allclose(
        swing_damage(joint_angle, torque_at=torque_at), summed(joint_angle, torque_at), rtol=3e-8
    )


@pytest.mark.parametrize("joint_angle", [1e-5, 0.1, 1.0, 1.5, 89.5 * deg])
def test_one_of_them_is_a_hypergeometric_function(joint_angle):
    """∫ sec^p is sin α F(1/2, (p+1)/2; 3/2; sin² α): another way to the same number."""
    exact = 2.0 / np.pi * np.sin(joint_angle) * hyp2f1(0.5, 0.5 * (P + 1.0), 1.5, np.sin(joint_angle) ** 2)
    assert swing_damage(joint_angle, torque_at="input")[0] == pytest.approx(exact, rel=1e-11)
    assert swing_damage(joint_angle, torque_at="output")[1] == pytest.approx(exact, rel=1e-11)


def test_swings_are_those_of_plain_vectors():
    """Angles of the cross in its yokes from its arms as vectors: range 2α in both, as the formulas have it."""
    phi = np.linspace(0.0, 2.0 * np.pi, 7201)
    axis_in, axis_out = np.asarray([1.0, 0.0, 0.0]), np.asarray([np.cos(0.4), np.sin(0.4), 0.0])
    other = np.asarray([0.0, 0.0, 1.0])
    driving = np.cos(phi)[:, None] * other + np.sin(phi)[:, None] * np.cross(axis_in, other)
    driven = np.cross(axis_out, driving)
    driven /= np.linalg.norm(driven, axis=1)[:, None]
    normal = np.cross(driving, driven)
    in_driving = np.arctan2(np.einsum("ij,ij->i", np.cross(normal, axis_in), driving), normal @ axis_in)
    in_driven = np.arctan2(np.einsum("ij,ij->i", np.cross(normal, axis_out), driven), normal @ axis_out)
    for swing in (in_driving, in_driven):
        assert np.max(np.abs(swing)) == pytest.approx(0.4, rel=1e-6)
        assert np.sum(np.abs(np.diff(swing))) == pytest.approx(4 * 0.4, rel=1e-6)


def test_by_hand():
    """C = 20 kN, R = 40 mm, 800 N·m, 1000 rpm, 3°: P = 800/0.08 = 10 kN, so C/P = 2.

    A turn moves the bearing by 3/90 revolutions: L = 2^(10/3) * 10^6 * 30/(60 * 1000) h = 10.079 * 500 = 5040 h.
    """
    found = bearing_life(20e3, 0.040, 800.0, speed=1000 * rpm, joint_angle=3 * deg, torque_at="input")
    assert found.simple / hour == pytest.approx(5039.7, abs=0.05)
    assert found.worst == min(found.driving, found.driven)


def test_small_bends_make_both_the_same_and_steep_ones_shorten_the_driven_yoke_most():
    """At 30° and constant input torque the mean load promises 18 % and 39 % too much."""
    small = bearing_life(20e3, 0.04, 800.0, speed=100.0, joint_angle=1e-4, torque_at="output")
    assert small.driving == pytest.approx(small.simple, rel=1e-7)
    steep = bearing_life(20e3, 0.04, 800.0, speed=100.0, joint_angle=30 * deg, torque_at="input")
    assert steep.simple / steep.driving == pytest.approx(1.18, abs=0.005)
    assert steep.simple / steep.driven == pytest.approx(1.39, abs=0.005)


def test_without_torque_or_without_bend_nothing_is_damaged():
    idle = bearing_life(20e3, 0.04, [0.0, 100.0], speed=100.0, joint_angle=[0.1, 0.0], torque_at="input")
    assert np.all(np.isinf(idle.worst))
    assert np.all(np.isinf(idle.simple))


def test_makers_rating_points_are_theirs():
    """T_c lasts 5000 h at 3° and 100 rpm; C R 5000 h with the rounded constant; the book's 2.6 is 0.9373 of 2.774."""
    case = {"speed": 100 * rpm, "joint_angle": 3 * deg}
    assert maker_life(700.0, 700.0, convention="Tc", **case) / hour == pytest.approx(5000.0)
    assert maker_life(700.0, 700.0, convention="CR", **case) / hour == pytest.approx(50_000.0)
    assert maker_life(700.0, 700.0, convention="book", **case) / hour == pytest.approx(1.218e7 / 300, rel=1e-4)
    assert maker_life(700.0, 700.0, convention="CR", speed=1.0, joint_angle=1 * deg, shock=2.0) == pytest.approx(
        maker_life(700.0, 1400.0, convention="CR", speed=-1.0, joint_angle=3 * deg), rel=1e-12
    )


def test_reliability_is_the_table_and_falls_all_the_way():
    shares = np.asarray(list(RELIABILITIES))
    np.testing.assert_allclose(reliability_factor(shares), list(RELIABILITIES.values()), rtol=1e-12)
    law = 0.05 + 0.95 * (np.log(shares) / np.log(0.9)) ** (2 / 3)
    np.testing.assert_allclose(reliability_factor(shares), law, atol=0.006)  # the table has two digits
    fine = reliability_factor(np.linspace(0.5, 0.9995, 2001))
    assert np.all(np.diff(fine) < 0.0)
    assert reliability_factor(0.5) == pytest.approx(5.34, abs=0.01)  # makers' average life: about 5
