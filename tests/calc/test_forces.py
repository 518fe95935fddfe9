"""Calculations of forces: keys, lists of angles, and what is wrong with inputs."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from cardan import InputError, calc

DOUBLE: dict[str, Any] = {
    "points_m": [[-0.4, 0.0, 0.0], [0.0, 0.0, 0.0], [0.7, 0.25, 0.1], [1.1, 0.25, 0.1]],
    "gamma_deg": [30.0],
    "phi1_deg": 50.0,
    "M_out_Nm": 150.0,
    "bearings": [
        {"shaft": 1, "x_from_shaft_start_m": 0.1, "radial": True, "axial": True},
        {"shaft": 1, "x_from_shaft_start_m": 0.3},
        {"shaft": 3, "x_from_shaft_start_m": 0.1},
        {"shaft": 3, "x_from_shaft_start_m": 0.3},
    ],
}

SINGLE = {
    "variant": "located_cross",
    "alpha_deg": 30,
    "phi1_deg": 37,
    "M2_Nm": 1000,
    "d_pin_span_m": 0.1,
    "a1_bearing_span_m": 0.3,
    "c1_overhang_m": 0.08,
    "b2_joint_to_bearing_m": 0.4,
}


def fields(capability: str, inputs: dict[str, Any]) -> list[str]:
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return [problem.field for problem in caught.value.problems]


def bearing(**changed: Any) -> list[dict[str, Any]]:
    return [{**DOUBLE["bearings"][0], **changed}, *DOUBLE["bearings"][1:]]


@pytest.mark.parametrize(
    ("changed", "found"),
    [
        ({"bearings": DOUBLE["bearings"][:3]}, ["bearings"]),
        ({"bearings": [*DOUBLE["bearings"], {"shaft": 2, "x_from_shaft_start_m": 0.2}]}, ["bearings"]),
        ({"bearings": bearing(shaft=4)}, ["bearings"]),
        ({"bearings": bearing(shaft=0)}, ["bearings"]),
        ({"bearings": bearing(radial="yes")}, ["bearings[0].radial"]),
        ({"bearings": bearing(radial=False, axial=False)}, ["bearings"]),
        ({"bearings": bearing(x_from_shaft_start_m=math.nan)}, ["bearings[0].x_from_shaft_start_m"]),
        ({"bearings": [{"shaft": 1, "place_m": 0.1}]}, ["bearings[0].place_m", "bearings[0].x_from_shaft_start_m"]),
        ({"bearings": 3}, ["bearings"]),
        ({"bearings": []}, ["bearings"]),
        ({"J_kg_m2": [0.1, 0.2]}, ["J_kg_m2"]),
        ({"J_kg_m2": [0.1, -0.2, 0.1]}, ["J_kg_m2"]),
        ({"cross_mass_kg": [0.1]}, ["cross_mass_kg"]),
        ({"cross_inertia_b_c_n_kg_m2": [[0.1, 0.1]]}, ["cross_inertia_b_c_n_kg_m2[0]"]),
        ({"gravity_m_s2": [0.0, -9.81]}, ["gravity_m_s2"]),
        ({"gamma_deg": [1.0, 2.0]}, ["gamma_deg"]),
        ({"cross_slides_on_pins": 1}, ["cross_slides_on_pins"]),
        (
            {"splines": [{"shaft": 2, "x_from_shaft_start_m": 0.4, "mu": 0.1, "d_m": 0.05, "direction": 1}] * 2},
            ["splines"],
        ),
        (
            {"splines": [{"shaft": 2, "x_from_shaft_start_m": 0.4, "mu": -0.1, "d_m": 0.0, "direction": 1}]},
            ["splines[0].mu", "splines[0].d_m"],
        ),
        ({"splines": [{"shaft": 4, "x_from_shaft_start_m": 0.4}]}, ["splines"]),
        ({"splines": [{"shaft": 2, "x_from_shaft_start_m": 0.4, "mu": 0.1}]}, ["splines[0].d_m"]),
        (
            {"splines": [{"shaft": 2, "x_from_shaft_start_m": 0.4, "mu": 0.1, "d_m": 0.05, "direction": 0.5}]},
            ["splines[0].direction"],
        ),
    ],
)
def test_bad_input_of_kinetostatics_is_named(changed: dict[str, Any], found: list[str]) -> None:
    assert fields("kinetostatics", DOUBLE | changed) == found


@pytest.mark.parametrize(
    ("changed", "found"),
    [
        ({"alpha_deg": 90}, ["alpha_deg"]),
        ({"d_pin_span_m": 0}, ["d_pin_span_m"]),
        ({"a1_bearing_span_m": -1}, ["a1_bearing_span_m"]),
        ({"b2_joint_to_bearing_m": 0}, ["b2_joint_to_bearing_m"]),
        ({"b2_joint_to_bearing_m": None}, ["b2_joint_to_bearing_m"]),
        ({"a2_bearing_span_m": 0.2}, ["a2_bearing_span_m"]),
        ({"variant": "sliding_cross"}, ["a2_bearing_span_m", "b2_joint_to_bearing_m"]),
        ({"variant": "located"}, ["variant"]),
    ],
)
def test_bad_input_of_a_single_joint_is_named(changed: dict[str, Any], found: list[str]) -> None:
    assert fields("joint_reactions", SINGLE | changed) == found


def test_a_bend_that_swings_to_a_right_angle_is_refused() -> None:
    inputs = {"phi1_rad": 0, "omega1_rad_s": 1, "alpha0_rad": 1.5, "A_rad": 0.1, "W_rad_s": 1, "t_s": 0}
    assert fields("moving_axis_gyro", inputs | {"J_polar_kg_m2": 1, "J_transverse_kg_m2": 1}) == ["alpha0_rad"]


@pytest.mark.parametrize(
    ("capability", "inputs"),
    [
        ("kinetostatics", DOUBLE),
        ("joint_reactions", SINGLE),
        (
            "double_joint_reactions",
            {"alpha12_deg": 15, "alpha23_deg": 25, "phi1_deg": 50, "M3_Nm": 300, "l2_m": 0.9, "gamma2_deg": 20},
        ),
        ("spline_axial_force", {"alpha_deg": 15, "phi1_deg": 30, "M2_Nm": 300, "mu": 0.1, "d_spline_m": 0.05}),
    ],
)
def test_a_list_of_angles_gives_what_each_gives(capability: str, inputs: dict[str, Any]) -> None:
    angles = [20.0, 50.0, 200.0]
    many = calc(capability, {**inputs, "phi1_deg": angles})
    for k, angle in enumerate(angles):
        for key, value in calc(capability, {**inputs, "phi1_deg": angle}).items():
            if np.ndim(many[key]) > np.ndim(value):
                np.testing.assert_allclose(many[key][k], value, rtol=1e-9, atol=1e-9, err_msg=key)
            else:
                assert many[key] == pytest.approx(value), key


def test_other_units_are_read() -> None:
    mine = calc("kinetostatics", DOUBLE)["bearing_reaction_N"]
    inputs = {key: value for key, value in DOUBLE.items() if key not in ("M_out_Nm", "bearings")} | {
        "M_out_kNm": 0.15,
        "bearings": [
            {
                "x_from_shaft_start_mm" if k == "x_from_shaft_start_m" else k: 1e3 * v if "x_" in k else v
                for k, v in row.items()
            }
            for row in DOUBLE["bearings"]
        ],
    }
    np.testing.assert_allclose(calc("kinetostatics", inputs)["bearing_reaction_N"], mine, rtol=1e-9, atol=1e-9)


def test_how_long_the_joints_rattle() -> None:
    points = [[-0.5, 0, 0], [0, 0, 0], [0.54378, 0.25357, 0]]
    found = calc("gap_closure", {"points_m": points, "omega1_rad_s": 150, "M_out_Nm": 100, "J_kg_m2": [0.0, 0.05]})
    assert not found["closed"]
    crossings = found["phi1_at_sign_changes_deg"][0]
    assert len(crossings) == 4
    assert found["open_share_of_turn"][0] == pytest.approx(2 * (crossings[1] - crossings[0]) / 360, rel=1e-9)


def test_what_is_left_out_is_none() -> None:
    """Without a load and without friction of a spline there are the same answers as with both nought."""
    held = [*DOUBLE["bearings"][:3], {**DOUBLE["bearings"][3], "axial": True}]
    bare = {key: value for key, value in DOUBLE.items() if key != "M_out_Nm"} | {
        "bearings": held,
        "splines": [{"shaft": 2, "x_from_shaft_start_m": 0.4}],
        "mass_kg": [4.0, 5.0, 6.0],
        "gravity_m_s2": [0.0, 0.0, -9.81],
    }
    spline = {**bare["splines"][0], "mu": 0, "d_m": 0.05, "direction": -1}
    assert calc("kinetostatics", bare) == calc("kinetostatics", bare | {"M_out_Nm": 0, "splines": [spline]})
