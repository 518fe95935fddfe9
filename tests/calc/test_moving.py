import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan import InputError, calc


@given(st.floats(0.0, 2.0), st.floats(0.05, 2.0), st.floats(-50, 50), st.floats(-30, 30))
def test_the_hitch_has_its_triangle(l1, l2, yaw, pitch):
    """Pin, joint 1 and joint 2 make a triangle; its law of sines and cosines gives bends and length."""
    found = calc("motion_hitch", {"l1_m": l1, "l2_m": l2, "yaw_deg": yaw, "pitch_deg": pitch})
    turn = math.acos(math.cos(math.radians(yaw)) * math.cos(math.radians(pitch)))
    first = math.atan2(l2 * math.sin(turn), l1 + l2 * math.cos(turn))
    # The acos of a small turn has half the digits.
    assert math.radians(found["alpha12_deg"]) == pytest.approx(first, abs=3e-8)
    assert math.radians(found["alpha23_deg"]) == pytest.approx(turn - first, abs=3e-8)
    assert found["length2_m"] == pytest.approx(math.sqrt(l1**2 + l2**2 + 2 * l1 * l2 * math.cos(turn)), abs=1e-12)
    length = abs(math.log(math.cos(first) / math.cos(turn - first)))
    assert found["delta"] == pytest.approx(2 * math.sinh(length), abs=1e-7)


def test_equal_arms_of_the_hitch_are_synchronous_at_any_turn():
    for yaw, pitch in ((0, 0), (10, 0), (0, 20), (-35, 12), (60, -40)):
        assert calc("motion_hitch", {"l1_m": 0.7, "l2_m": 0.7, "yaw_deg": yaw, "pitch_deg": pitch})["delta"] < 1e-13


def test_the_yoke_of_the_hitch_counts():
    crossed = calc("motion_hitch", {"l1_m": 0.4, "l2_m": 0.4, "yaw_deg": 30, "gamma2_deg": 90})
    assert crossed["delta"] == pytest.approx(2 * math.sinh(-2 * math.log(math.cos(math.radians(15)))), rel=1e-12)


POINTS = {
    "points0_m": [[-1, 0, 0], [0, 0, 0], [1.5, 0.1, -0.25], [2.0, 0.1, -0.3]],
    "amplitude_m": [[0, 0, 0], [0, 0, 0], [0.02, 0.0, 0.08], [0.02, 0.0, 0.09]],
    "omega_motion_rad_s": 9.0,
    "phase_rad": [0, 0, 0.3, 0.3],
    "omega1_rad_s": 150.0,
}


def test_centres_at_rest_turn_like_the_drive_that_stands():
    still = POINTS | {"omega_motion_rad_s": 0.0, "phase_rad": 0.0, "gamma_deg": [20.0]}
    time = 0.0123
    moved = calc("moving_centres", still | {"t_s": time})
    stood = calc(
        "geometry_from_points",
        {
            "points_m": POINTS["points0_m"],
            "gamma_deg": [20.0],
            "phi1_deg": math.degrees(150.0 * time),
            "omega1_rad_s": 150.0,
        },
    )
    assert moved["alpha_deg"] == pytest.approx(stood["alpha_deg"], abs=1e-12)
    assert moved["spin_rad_s"][-1] == pytest.approx(stood["omega_out_rad_s"], rel=1e-12)
    assert moved["spin_acc_rad_s2"][-1] == pytest.approx(stood["eps_out_rad_s2"], rel=1e-9)


def test_many_instants_equal_single_ones():
    times = [0.0, 0.05, 0.3]
    many = calc("moving_centres", POINTS | {"t_s": times})
    for k, time in enumerate(times):
        for key, value in calc("moving_centres", POINTS | {"t_s": time}).items():
            assert np.asarray(many[key])[k] == pytest.approx(np.asarray(value), rel=1e-12, abs=1e-12)


FOLDING = [[0, 0, 0], [0, 0, 0], [-1.6, 0, 0], [0, 0, 0]]


@pytest.mark.parametrize(
    ("capability", "inputs", "field"),
    [
        ("moving_centres", POINTS | {"t_s": 0, "phase_rad": [0.0]}, "phase_rad"),
        ("moving_centres", POINTS | {"t_s": 0, "amplitude_m": [[0, 0, 0]]}, "amplitude_m"),
        ("moving_centres", POINTS | {"t_s": 0, "gamma_deg": [0, 0]}, "gamma_deg"),
        ("moving_centres", POINTS | {"t_s": 0, "points0_m": [[0, 0, 0]] * 4}, "points0_m[1]"),
        (
            "moving_centres",
            POINTS
            | {"t_s": math.pi / 18, "phase_rad": 0.0, "amplitude_m": [[0, 0, 0], [0, 0, 0], [-1.6, 0, 0], [0, 0, 0]]},
            "points0_m",
        ),
        ("motion_hitch", {"l1_m": 0, "l2_m": 0}, "l2_m"),
        ("motion_hitch", {"l1_m": -1, "l2_m": 1}, "l1_m"),
        (
            "varying_angle_random",
            {"alpha_mean_deg": 80, "alpha_std_deg": 2, "alpha_rate_std_rad_s": 1, "omega1_rad_s": 1, "phi1_deg": 0},
            "alpha_std_deg",
        ),
        (
            "varying_angle_single",
            {"alpha_mean_deg": 80, "alpha_amp_deg": -10, "alpha_omega_rad_s": 1, "omega1_at_t0_rad_s": 1, "t_s": 0},
            "alpha_mean_deg",
        ),
        (
            "motion_arm",
            {
                "B1_m": [0, 0, 0],
                "a1": [1, 0, 0],
                "pivot_m": [0, 0, 0],
                "axis": [0, 0, 0],
                "B2_at_rest_m": [1, 0, 0],
                "a3_at_rest": [1, 0, 0],
                "arm_rotation_deg": 1,
            },
            "axis",
        ),
    ],
)
def test_bad_movements_are_named(capability, inputs, field):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    assert caught.value.field == field
