import json
from pathlib import Path

import numpy as np
import pytest

from cardan import InputError, calc
from tests.builders.friction_model import over_a_turn, torques
from tests.builders.vector_model import VectorModel

CASES = json.loads((Path(__file__).parents[1] / "reference" / "statics.json").read_text("utf8"))["cases"]
FIRST = {case["capability"]: case["inputs"] for case in reversed(CASES) if "error_field" not in case["expected"]}
JOINT, CHAIN, PARTS = (
    FIRST[name] for name in ("efficiency_joint", "efficiency_chain", "efficiency_spline_branches_factors")
)


def fields(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return [problem.field for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"alpha_deg": 90}, ["alpha_deg"]),
        ({"alpha_deg": -1}, ["alpha_deg"]),
        ({"mu_pin_reduced": -0.1}, ["mu_pin_reduced"]),
        ({"pin_span_m": 0}, ["pin_span_m"]),
        ({"pin_diameter_m": 0}, ["pin_diameter_m"]),
        ({"bearing_span_m": 0}, ["bearing_span_m"]),
        ({"constant_torque": "middle"}, ["constant_torque"]),
        ({"alpha_deg": 80, "mu_pin_reduced": 1.0}, ["mu_pin_reduced"]),
        ({"mu_bearing_reduced": 0.01, "bearing_span_m": None}, ["bearing_span_m"]),
        ({"mu_bearing_reduced": float("nan")}, ["mu_bearing_reduced"]),
    ],
)
def test_bad_joints_are_named(changed, named):
    assert fields("efficiency_joint", JOINT | changed) == named


def test_without_bearing_keys_bearings_take_nothing():
    bare = {key: value for key, value in JOINT.items() if "bearing" not in key}
    assert calc("efficiency_joint", bare)["bearing_work_per_rev_over_torque"] == 0.0
    many = calc("efficiency_joint", bare | {"alpha_deg": [0, 10]})
    assert many["eta_pins_self_consistent"][0] == 1.0


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"kappa_mu_dc_over_d": [0.1]}, ["kappa_mu_dc_over_d"]),
        ({"kappa_mu_dc_over_d": []}, ["kappa_mu_dc_over_d"]),
        ({"kappa_mu_dc_over_d": [0.1, -0.1]}, ["kappa_mu_dc_over_d"]),
        ({"kappa_mu_dc_over_d": 0.1}, ["kappa_mu_dc_over_d"]),
        ({"kappa_mu_dc_over_d": [0.1, 9.0]}, ["kappa_mu_dc_over_d[1]"]),
        ({"kappa_mu_dc_over_d": [7.0, 9.0]}, ["kappa_mu_dc_over_d[0]", "kappa_mu_dc_over_d[1]"]),
        ({"gamma_deg": []}, ["gamma_deg"]),
        ({"points_m": None}, ["alpha_deg"]),
    ],
)
def test_bad_chains_are_named(changed, named):
    assert fields("efficiency_chain", CHAIN | changed) == named


def test_a_locking_joint_is_named_in_words():
    with pytest.raises(InputError, match="locks joint 2"):
        calc("efficiency_chain", CHAIN | {"kappa_mu_dc_over_d": [0.1, 9.0]})


def test_a_chain_by_its_angles_agrees_with_couples_of_plain_vectors():
    inputs = {"alpha_deg": [25, 15, 35], "beta_deg": [40, -70], "gamma_deg": [10, 80], "psi1_deg": 33}
    drag, turn = [0.05, 0.01, 0.03], over_a_turn()
    model = VectorModel.from_angles(*(np.deg2rad(inputs[key]) for key in ("alpha_deg", "beta_deg", "gamma_deg")), 0.576)
    for at in ("output", "input"):
        found = calc("efficiency_chain", inputs | {"kappa_mu_dc_over_d": drag, "constant_torque": at})
        plain = torques(model, turn, drag, at=at)
        into, out = (np.mean(plain.shaft[k] * plain.speed[k]) for k in (0, -1))
        assert found["eta_self_consistent"] == pytest.approx(out / into, abs=1e-8)
        lost = sum(found["pin_loss_of_each_joint_over_mean_power"])
        assert lost == pytest.approx(into - out, abs=1e-8)


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"mu_spline": -0.1}, ["mu_spline"]),
        ({"spline_diameter_m": 0}, ["spline_diameter_m"]),
        ({"rev_per_s": 0}, ["rev_per_s"]),
        ({"stroke_m": -0.1}, ["stroke_m"]),
        ({"strokes_per_s": 1e6}, ["strokes_per_s"]),
        ({"branch_eta": [0.9, 0.0]}, ["branch_eta"]),
        ({"branch_eta": [0.9, 1.1]}, ["branch_eta"]),
        ({"branch_eta": [0.9]}, ["branch_eta"]),
        ({"branch_useful_work_J": [0, 0]}, ["branch_useful_work_J"]),
        ({"branch_useful_work_J": [-1, 2]}, ["branch_useful_work_J"]),
        ({"mu_material": -0.1}, ["mu_material"]),
        ({"stroke_m": None, "rev_per_s": None}, ["stroke_m", "rev_per_s"]),
        (dict.fromkeys(PARTS), ["mu_spline"]),
    ],
)
def test_bad_parts_are_named(changed, named):
    assert fields("efficiency_spline_branches_factors", PARTS | changed) == named


def test_each_part_stands_alone():
    whole = calc("efficiency_spline_branches_factors", PARTS)
    spline = [key for key in PARTS if "branch" not in key and key != "mu_material"]
    parts = [spline, ["branch_useful_work_J", "branch_eta"], ["mu_material"]]
    found = [calc("efficiency_spline_branches_factors", {key: PARTS[key] for key in part}) for part in parts]
    assert found[0] | found[1] | found[2] == whole
    assert [len(one) for one in found] == [1, 1, 2]


def test_a_seal_by_the_formula_of_the_technical_report():
    found = calc("seal_friction", {"seal_diameter_m": [0.04, 0.08], "speed_rpm": 1500})
    assert found["power_loss_W"] == pytest.approx([7.69e-6 * d**2 * 1500 for d in (40, 80)])
    assert found["friction_torque_Nm"] == pytest.approx([7.69e-6 * d**2 * 30 / np.pi for d in (40, 80)])
    assert set(calc("seal_friction", {"seal_diameter_m": 0.04})) == {"friction_torque_Nm"}
    assert fields("seal_friction", {"seal_diameter_m": 0}) == ["seal_diameter_m"]
