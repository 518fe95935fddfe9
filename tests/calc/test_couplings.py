import numpy as np
import pytest

from cardan import InputError, calc

PINS = {"alpha_deg": 30, "a_m": 0.05, "b_m": 0.052, "theta1_deg": 40, "theta2_deg": 42, "phi1_deg": 10}
CIRCLE = {"axial_m": 0.06, "radial_m": 0.01, "radius_m": 0.075}
PROFILES = {"alpha_deg": 30, "circle1": CIRCLE, "circle2": CIRCLE | {"axial_m": 0.062}, "phi1_deg": 40}
CROSS = {"alpha_deg": 25, "cross_offset_m": 0.02, "support_distance_m": 0.5, "phi1_deg": 40, "cross_sign": 1}


@pytest.mark.parametrize(
    ("capability", "inputs", "wrong", "fields"),
    [
        ("double_cardan_centring", {"alpha_deg": 20, "lambda_": 0.5}, {"lambda_": 1.0}, ["lambda_"]),
        ("double_cardan_centring", {"alpha_deg": 20, "lambda_": 0.5}, {"lambda_": 0.0}, ["lambda_"]),
        ("double_cardan_centring", {"alpha_deg": 90, "lambda_": 1.2}, {}, ["alpha_deg", "lambda_"]),
        ("centring_optimum", {"alpha_max_deg": 0}, {}, ["alpha_max_deg"]),
        ("centring_optimum", {"alpha_max_deg": 20, "alpha_min_deg": 30}, {}, ["alpha_min_deg"]),
        ("double_cardan_irregularity", {"alpha12_deg": -1, "alpha23_deg": 5, "yokes": "in_plane"}, {}, ["alpha12_deg"]),
        (
            "double_cardan_irregularity",
            {"alpha12_deg": 1, "alpha23_deg": 95},
            {"yokes": "in_line"},
            ["alpha23_deg", "yokes"],
        ),
        ("pin_coupling", PINS, {"theta1_deg": 14}, ["theta1_deg"]),
        ("pin_coupling", PINS, {"theta1_deg": 15, "theta2_deg": 75}, ["theta1_deg", "theta2_deg"]),
        ("pin_coupling", PINS, {"theta2_deg": -42}, ["theta2_deg"]),
        ("pin_coupling", PINS, {"a_m": 0, "b_m": -1}, ["a_m", "b_m"]),
        ("pin_stroke", {"alpha_deg": 60, "a_m": 0.05, "theta_deg": 60}, {}, ["theta_deg"]),
        ("profile_coupling", PROFILES, {"circle1": CIRCLE | {"radius_m": 0}}, ["circle1.radius_m"]),
        ("profile_coupling", PROFILES, {"circle2": CIRCLE | {"axial_m": 3}}, ["circle2"]),
        ("offset_cross", CROSS, {"cross_offset_m": -0.01}, ["cross_offset_m"]),
        ("offset_cross", CROSS, {"support_distance_m": 0.02}, ["support_distance_m"]),
        ("offset_cross", CROSS, {"alpha_deg": 90, "cross_sign": 0}, ["alpha_deg", "cross_sign"]),
    ],
)
def test_what_is_refused_is_named(capability, inputs, wrong, fields):
    with pytest.raises(InputError) as error:
        calc(capability, inputs | wrong)
    assert sorted(problem.field for problem in error.value.problems) == sorted(fields)


def test_pins_and_profiles_answer_for_a_whole_turn_at_once():
    angles = list(range(0, 360, 30))
    for capability, inputs in (("pin_coupling", PINS), ("profile_coupling", PROFILES), ("offset_cross", CROSS)):
        turn = calc(capability, inputs | {"phi1_deg": angles})
        one = calc(capability, inputs | {"phi1_deg": angles[5]})
        for key, value in one.items():
            whole = turn[key]
            assert (whole[5] if isinstance(whole, list) else whole) == pytest.approx(value, rel=1e-12, abs=1e-15)


def test_other_units_are_read():
    found = calc("pin_coupling", {k: v for k, v in PINS.items() if k not in ("a_m", "b_m")} | {"a_mm": 50, "b_mm": 52})
    assert found == pytest.approx(calc("pin_coupling", PINS))


def test_inner_yokes_at_right_angles_add_what_the_joints_do():
    found = calc("double_cardan_irregularity", {"alpha12_deg": 20, "alpha23_deg": 20, "yokes": "crossed"})
    ratio = 1 / np.cos(np.radians(20)) ** 2
    assert found == pytest.approx({"ratio_max": ratio, "ratio_min": 1 / ratio, "irregularity": ratio - 1 / ratio})
    even = calc("double_cardan_irregularity", {"alpha12_deg": 20, "alpha23_deg": 20})
    assert even == pytest.approx({"ratio_max": 1.0, "ratio_min": 1.0, "irregularity": 0.0})


def test_the_best_ratio_is_as_good_as_it_says():
    best = calc("centring_optimum", {"alpha_max_deg": 40})
    at = {"lambda_": best["lambda_minimax"]}
    deltas = [calc("double_cardan_centring", {"alpha_deg": a, **at})["irregularity"] for a in range(1, 41)]
    assert max(deltas) == pytest.approx(best["irregularity_max"], rel=1e-3)
    even = calc("double_cardan_centring", {"alpha_deg": 40, "lambda_": best["lambda_sync_at_alpha_max"]})
    assert even["irregularity"] == pytest.approx(0.0, abs=1e-15)


def test_the_best_pins_are_those_of_their_contact():
    best = calc("pin_geometry", {"alpha_max_deg": 30, "radius_mm": 60})
    pins = {"alpha_deg": 30, "a_m": best["a_m"], "b_m": best["a_m"], "phi1_deg": list(range(0, 360, 5))}
    turn = calc("pin_coupling", pins | {"theta1_deg": best["theta_deg"], "theta2_deg": best["theta_deg"]})
    assert max(turn["contact_force_per_torque_N_per_Nm"]) == pytest.approx(
        best["contact_force_per_torque_N_per_Nm"], rel=5e-3
    )
    stroke = calc("pin_stroke", {"alpha_deg": 30, "a_m": best["a_m"], "theta_deg": best["theta_deg"]})
    assert stroke["x_max_m"] - stroke["x_min_m"] == pytest.approx(best["stroke_m"], rel=1e-9)
    assert max(turn["x_m"]) * np.sin(np.radians(best["theta_deg"])) == pytest.approx(0.06, rel=1e-9)
    with pytest.raises(InputError) as error:
        calc("pin_geometry", {"alpha_max_deg": 80, "radius_mm": 60, "margin_deg": 6})
    assert error.value.field == "margin_deg"
