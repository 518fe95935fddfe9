import json
import math

import pytest

from cardan import InputError, calc

LEVER = {"alpha12_deg": 20, "b_over_a": 0.35, "c_over_a": 0.7}
PLANE = {"alpha_deg": 30, "plane_tilt_deg": 0.2, "balls": 6, "phi1_deg": 20}
GROOVES = {"alpha_deg": 30, "c1_m": 0.003, "c2_m": 0.0033, "groove_radius_m": 0.03, "phi1_deg": 50}
TRACTA = {"alpha_deg": 30, "OA_m": 0.02, "OB_m": 0.021}
TRIPOD = {"alpha_deg": 20, "track_radius_m": 0.02, "phi1_deg": 30}
OFFSET = {"alpha_deg": 40, "plane_tilt_deg": 0.5, "axial_play_m": 1e-4}


def fields(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return [problem.field for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("capability", "good", "changed", "named"),
    [
        ("rzeppa_lever", LEVER, {"b_over_a": 0}, ["b_over_a"]),
        ("rzeppa_lever", LEVER, {"c_over_a": -0.1}, ["c_over_a"]),
        ("rzeppa_lever", LEVER, {"alpha12_deg": 90}, ["alpha12_deg"]),
        ("rzeppa_lever", LEVER, {"alpha12_deg": -1}, ["alpha12_deg"]),
        ("rzeppa_lever", LEVER, {"c_over_a": 1.35 / math.sin(math.radians(20))}, ["c_over_a"]),
        ("rzeppa_lever", LEVER, {"c_over_a": 4.0}, ["c_over_a"]),
        ("rzeppa_lever", LEVER, {"b_over_a": 0, "c_over_a": 0}, ["b_over_a", "c_over_a"]),
        ("rzeppa_lever_ratio", {"alpha12_deg": 20, "b_over_a": 0.35}, {"b_over_a": 0}, ["b_over_a"]),
        ("rzeppa_lever_ratio", {"alpha12_deg": 20, "b_over_a": 0.35}, {"b_over_a": 1.1}, ["b_over_a"]),
        ("rzeppa_lever_ratio", {"alpha12_deg": 20, "b_over_a": 0.35}, {"alpha12_deg": 90}, ["alpha12_deg"]),
        ("rzeppa_lever_optimum", {"b_over_a": 0.35, "alpha_max_deg": 35}, {"b_over_a": -1}, ["b_over_a"]),
        ("rzeppa_lever_optimum", {"b_over_a": 0.35, "alpha_max_deg": 35}, {"b_over_a": 2}, ["b_over_a"]),
        ("rzeppa_lever_optimum", {"b_over_a": 0.35, "alpha_max_deg": 35}, {"alpha_max_deg": 90}, ["alpha_max_deg"]),
        ("rzeppa_lever_optimum", {"b_over_a": 0.35, "alpha_max_deg": 35}, {"alpha_min_deg": 36}, ["alpha_min_deg"]),
        ("ball_plane_error", PLANE, {"alpha_deg": 90}, ["alpha_deg"]),
        ("ball_plane_error", PLANE, {"plane_tilt_deg": -75}, ["plane_tilt_deg"]),
        ("ball_plane_error", PLANE, {"balls": 0}, ["balls"]),
        ("ball_plane_error", PLANE, {"balls": 2.5}, ["balls"]),
        ("offset_groove_plane", GROOVES, {"c1_m": 0}, ["c1_m"]),
        ("offset_groove_plane", GROOVES, {"c2_m": -1}, ["c2_m"]),
        ("offset_groove_plane", GROOVES, {"groove_radius_m": 0}, ["groove_radius_m"]),
        ("offset_groove_plane", GROOVES, {"groove_radius_m": 0.001}, ["groove_radius_m"]),
        ("offset_groove_plane", GROOVES, {"alpha_deg": 90}, ["alpha_deg"]),
        ("tracta", TRACTA, {"OA_m": 0}, ["OA_m"]),
        ("tracta", TRACTA, {"OB_m": -0.02}, ["OB_m"]),
        ("tracta", TRACTA, {"alpha_deg": -1}, ["alpha_deg"]),
        ("tripod", TRIPOD, {"alpha_deg": 90}, ["alpha_deg"]),
        ("tripod", TRIPOD, {"track_radius_m": 0}, ["track_radius_m"]),
        ("tripod", TRIPOD, {"shaft_length_m": 0}, ["shaft_length_m"]),
        ("groove_offset", OFFSET, {"plane_tilt_deg": 0}, ["plane_tilt_deg"]),
        ("groove_offset", OFFSET, {"axial_play_m": -1}, ["axial_play_m"]),
    ],
)
def test_bad_joints_are_named(capability, good, changed, named):
    calc(capability, good)
    assert fields(capability, good | changed) == named


def test_the_tables_of_the_lever_come_out():
    """Errors of the cage in degrees over joint angles, for lengths read off the book's figure and for the best one."""
    table = {0.72: [-0.005, 0.045, 0.282, 0.836], 0.70: [-0.028, -0.026, 0.156, 0.644]}
    table |= {0.6562: [-0.082, -0.193, -0.138, 0.199], 0.65: [-0.090, -0.217, -0.181, 0.133]}
    for c, row in table.items():
        found = [
            math.degrees(calc("rzeppa_lever", LEVER | {"alpha12_deg": joint_angle, "c_over_a": c})["plane_error_rad"])
            for joint_angle in (5, 15, 25, 35)
        ]
        assert found == pytest.approx(row, abs=6e-4)  # printed with three decimals


def test_the_lever_is_exact_where_it_says():
    found = calc("rzeppa_lever_optimum", {"b_over_a": 0.35, "alpha_max_deg": 35})
    again = calc("rzeppa_lever_ratio", {"alpha12_deg": found["exact_bend_deg"], "b_over_a": 0.35})
    assert again["c_over_a"] == pytest.approx(found["c_over_a"], rel=1e-12)
    assert found["bend_of_largest_lead_deg"] == pytest.approx(35, rel=1e-12)
    least = calc(
        "rzeppa_lever", LEVER | {"alpha12_deg": found["bend_of_largest_lag_deg"], "c_over_a": found["c_over_a"]}
    )
    assert least["plane_error_rad"] == pytest.approx(-found["plane_error_max_rad"], rel=1e-9)


def test_the_normal_of_the_lever_and_of_the_balls_lean_alike():
    """The cage's error is the tilt that `ball_plane_error` takes."""
    lever = calc("rzeppa_lever", LEVER)
    balls = calc("ball_plane_error", {"alpha_deg": 20, "plane_tilt_rad": lever["plane_error_rad"], "phi1_deg": 0})
    assert balls["single_ball_irregularity"] == pytest.approx(lever["single_ball_irregularity"], rel=1e-14)


def test_the_remark_on_the_sense_of_the_tilt_changes_nothing():
    assert calc("ball_plane_error", PLANE | {"tilt_sign": "any words"}) == calc("ball_plane_error", PLANE)


@pytest.mark.parametrize(
    ("capability", "inputs"), [("ball_plane_error", PLANE), ("offset_groove_plane", GROOVES), ("tripod", TRIPOD)]
)
def test_many_angles_equal_single_ones(capability, inputs):
    angles = [-500.0, 0.0, 77.0, 900.0]
    many = calc(capability, inputs | {"phi1_deg": angles})
    for k, angle in enumerate(angles):
        for key, value in calc(capability, inputs | {"phi1_deg": angle}).items():
            one = many[key][k] if isinstance(many[key], list) else many[key]
            assert one == pytest.approx(value, rel=1e-12, abs=1e-16)


def test_further_answers_come_with_further_keys():
    assert "phi2_minus_phi1_rad" not in calc("tracta", TRACTA)
    assert calc("tracta", TRACTA | {"phi1_deg": 45})["phi2_minus_phi1_rad"] == pytest.approx(
        calc("tracta", TRACTA)["irregularity"] / 4, rel=1e-4
    )
    assert "shaft_tilt_rad" not in calc("tripod", TRIPOD)
    found = calc("tripod", TRIPOD | {"shaft_length_m": 0.4})
    assert found["shaft_tilt_rad"] == pytest.approx(found["orbit_radius_m"] / 0.4, rel=1e-15)


def test_the_offset_for_a_play_is_that_of_the_plane():
    c = calc("groove_offset", OFFSET)["c_m"]
    shifted = calc("offset_groove_plane", GROOVES | {"alpha_deg": 40, "c1_m": c - 1e-4, "c2_m": c})
    assert abs(math.degrees(shifted["plane_tilt_rad"])) == pytest.approx(0.5, rel=1e-12)


def test_straight_joints_are_even():
    assert calc("ball_plane_error", PLANE | {"alpha_deg": 0})["spread_rad"] == 0.0
    assert calc("offset_groove_plane", GROOVES | {"alpha_deg": 0})["phi2_minus_phi1_rad"] == 0.0
    assert calc("tracta", TRACTA | {"alpha_deg": 0}) == {"alpha1_rad": 0.0, "alpha2_rad": 0.0, "irregularity": 0.0}
    assert calc("tripod", TRIPOD | {"alpha_deg": 0})["orbit_radius_m"] == 0.0
    assert calc("rzeppa_lever", LEVER | {"alpha12_deg": 0})["plane_error_rad"] == 0.0
    best = calc("rzeppa_lever_optimum", {"b_over_a": 0.35, "alpha_max_deg": 0})
    assert best["plane_error_max_rad"] == 0.0


def test_answers_are_plain_numbers():
    for capability, inputs in (("tripod", TRIPOD), ("tracta", TRACTA), ("groove_offset", OFFSET)):
        assert json.loads(json.dumps(calc(capability, inputs))) == calc(capability, inputs)
