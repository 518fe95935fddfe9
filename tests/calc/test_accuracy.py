import json

import numpy as np
import pytest

from cardan import InputError, calc
from cardan.maths.kernel.loops import Status, rccc
from tests.builders.loop_newton import gap

LOOP = {"alpha_deg": [60, 75, 80, 40], "a_m": [0.1, 0.2, 0.15, 0.3], "s1_m": 0.05, "phi1_deg": 30.0}
STACK = {
    "alpha_deg": 30,
    "phi1_deg": 35,
    "tol_s1_a1_a2_a3_a4_mm": [0.05, 0.03, 0.04, 0.03, 0.1],
    "tol_alpha1_2_3_4_deg": [0.05, 0.08, 0.05, 0.2],
}
CHAIN = {
    "alpha_deg": [20, 20],
    "kappa_deg_between_joints": [90.0],
    "phi1_deg": 40.0,
    "angle_errors_deg_alpha1_4_per_joint": [[0.05, 0.1, -0.05, 0.02], [0.0, 0.08, 0.03, -0.02]],
    "phase_errors_deg_before_each_joint": [0.0, 0.0],
    "linear_errors_mm_s1_a1_4_per_joint": [[0.1, 0.05, 0.02, -0.03, 0.04], [0.0, 0.02, 0.05, 0.01, -0.02]],
}


def refused(name, inputs):
    with pytest.raises(InputError) as caught:
        calc(name, inputs)
    return caught.value


def test_random_loops_close_in_both_assemblies():
    rng = np.random.default_rng(1)
    seen = 0
    for _ in range(60):
        inputs = {
            "alpha_deg": rng.uniform(-170, 170, 4).tolist(),
            "a_m": rng.uniform(-1, 1, 4).tolist(),
            "s1_m": float(rng.uniform(-1, 1)),
            "phi1_deg": float(rng.uniform(-400, 400)),
        }
        if rccc(np.radians(inputs["alpha_deg"]), np.radians(inputs["phi1_deg"])).status != Status.CLOSED:
            assert refused("rccc", inputs).field == "phi1_deg"
            continue
        found = calc("rccc", inputs)
        seen += 1
        assert found["closure_residual"] < 1e-12
        phis = [one["phi4_deg"] for one in found["solutions_sorted_by_phi4"]]
        assert phis == sorted(phis)
        for one in found["solutions_sorted_by_phi4"]:
            angle = np.radians([inputs["phi1_deg"], one["phi2_deg"], one["phi3_deg"], one["phi4_deg"]])
            slide = [inputs["s1_m"], one["s2_m"], one["s3_m"], one["s4_m"]]
            left = gap(np.radians(inputs["alpha_deg"]), np.asarray(inputs["a_m"]), angle, slide)
            assert np.max(np.abs(left)) < 1e-12
    assert seen > 15


def test_a_loop_that_does_not_close_says_where_it_would():
    error = refused("rccc", {**LOOP, "alpha_deg": [30, 40, 45, 70], "phi1_deg": 10})
    assert error.field == "phi1_deg"
    # arccos 0.444916530 = 63.5826°
    assert "63.58" in str(error)
    assert "180°" in str(error)
    assert "any input angle" in str(refused("rccc", {**LOOP, "alpha_deg": [10, 10, 20, 120]}))


@pytest.mark.parametrize(
    ("change", "field", "words"),
    [
        ({"alpha_deg": [90, 0, 90, 30]}, "alpha_deg[1]", "parallel"),
        ({"alpha_deg": [90, 90, 180, 30]}, "alpha_deg[2]", "parallel"),
        ({"alpha_deg": [60, 90, 90, -60], "phi1_deg": 0}, "phi1_deg", "free"),
        ({"alpha_deg": [40, 60, 60]}, "alpha_deg", "4 needed"),
        ({"s1_m": float("nan")}, "s1_m", "finite"),
    ],
)
def test_a_loop_with_a_fault_names_it(change, field, words):
    error = refused("rccc", {**LOOP, **change})
    assert error.field == field
    assert words in str(error)


def test_the_end_of_the_range_is_dead():
    half = {**LOOP, "alpha_deg": [30, 40, 45, 70], "phi1_deg": 170.0}
    end = float(np.degrees(np.arccos(calc("rccc", half)["cos_phi1_max"])))
    error = refused("rccc", {**half, "phi1_deg": end})
    assert error.field == "phi1_deg"
    assert "dead" in str(error)


def test_where_the_input_makes_no_difference_there_is_no_bound():
    found = calc("rccc", {**LOOP, "alpha_deg": [90, 90, 90, 0]})
    assert found["full_rotation"] is True
    assert found["cos_phi1_min"] is None
    assert found["cos_phi1_max"] is None
    json.dumps(found, allow_nan=False)


def test_the_other_assembly_changes_the_signs_it_should():
    here = calc("influence_coefficients", {"alpha_deg": 25, "phi1_deg": 50})
    there = calc(
        "influence_coefficients",
        {"alpha_deg": 25, "phi1_deg": 50, "branch": "phi4=atan2(-cos(alpha)cos(phi1),-sin(phi1))"},
    )
    signs = np.asarray([[1, 1, -1, -1, 1], [-1, -1, 1, 1, -1], [1, 1, -1, -1, 1]])
    assert np.asarray(there["C"]) == pytest.approx(np.asarray(here["C"]) * signs, abs=1e-15)
    assert np.asarray(here["d"]) == pytest.approx(np.asarray(here["C"])[:, 1:], abs=0)
    assert refused("influence_coefficients", {"alpha_deg": 25, "phi1_deg": 50, "branch": "up"}).field == "branch"


def test_the_stack_adds_up_and_equal_shares_keep_the_target():
    found = calc("tolerance_stack", {**STACK, "target_phi4_deg": 0.1, "target_s4_mm": 0.2})
    assert np.sum(found["share_of_alpha1_4_in_phi2_phi3_phi4"], axis=-1) == pytest.approx([1, 1, 1])
    assert np.sum(found["share_of_s1_a1_4_in_s2_s3_s4"], axis=-1) == pytest.approx([1, 1, 1])
    turns, ways = found["required_alpha1_4_deg"], found["required_s1_a1_4_m"]
    again = calc(
        "tolerance_stack",
        {**STACK, "tol_alpha1_2_3_4_deg": turns, "tol_s1_a1_a2_a3_a4_mm": [1000 * one for one in ways]},
    )
    # Each has its largest share, though not all at one position.
    assert 0.5 * np.radians(0.1) < again["max_over_turn_rss_phi4_rad"] <= np.radians(0.1)
    assert 0.5e-4 < again["max_over_turn_rss_s4_m"] <= 2e-4
    # max |C_42| is 1/cos α.
    assert turns[1] == pytest.approx(0.1 * np.cos(np.radians(30)) / 2, rel=1e-9)


@pytest.mark.slow
def test_the_largest_stack_of_a_turn_is_found_between_samples():
    found = calc("tolerance_stack", STACK)
    fine = [
        calc("tolerance_stack", {**STACK, "phi1_deg": float(angle)})["worst_phi2_phi3_phi4_rad"][2]
        for angle in np.linspace(0, 180, 361)
    ]
    assert max(fine) <= found["max_over_turn_worst_phi4_rad"] * (1 + 1e-12)
    assert max(fine) == pytest.approx(found["max_over_turn_worst_phi4_rad"], rel=1e-4)


@pytest.mark.parametrize(
    ("law", "sigma"), [("normal, sigma = tol/3", 1 / 3), ("Uniform", 3**-0.5), ("triangular law", 6**-0.5)]
)
def test_samples_spread_as_the_stack_says(law, sigma):
    found = calc("tolerance_montecarlo", {**STACK, "distribution": law, "samples": 16384, "seed": 4})
    stack = calc("tolerance_stack", STACK)
    # Sobol' points; 1 % holds what is of second order in 0.2°.
    for kind in ("phi2_phi3_phi4_rad", "s2_s3_s4_m"):
        assert np.asarray(found[f"std_{kind}"]) == pytest.approx(sigma * np.asarray(stack[f"rss_{kind}"]), rel=0.01)
        assert np.all(np.asarray(found[f"quantile_997_{kind}"])[1] > np.asarray(found[f"quantile_95_{kind}"])[1])
    assert found["seed"] == 4
    assert found["not_assembled"] == 0
    assert found["samples"] == 16384


@pytest.mark.parametrize(
    ("name", "base", "change", "field"),
    [
        ("tolerance_stack", STACK, {"alpha_deg": 90}, "alpha_deg"),
        ("tolerance_stack", STACK, {"tol_alpha1_2_3_4_deg": [0.1, -0.1, 0, 0]}, "tol_alpha1_2_3_4_deg"),
        ("tolerance_stack", STACK, {"tol_s1_a1_a2_a3_a4_mm": [0.1]}, "tol_s1_a1_a2_a3_a4_mm"),
        ("tolerance_stack", STACK, {"target_phi4_deg": 0}, "target_phi4_deg"),
        ("tolerance_montecarlo", STACK, {"distribution": "lognormal"}, "distribution"),
        ("tolerance_montecarlo", STACK, {"distribution": 3}, "distribution"),
        ("tolerance_montecarlo", STACK, {"samples": 3}, "samples"),
        ("influence_coefficients", {"alpha_deg": 1, "phi1_deg": 0}, {"phi1_deg": float("inf")}, "phi1_deg"),
        ("chain_with_errors", CHAIN, {"alpha_deg": [20, 95]}, "alpha_deg"),
        ("chain_with_errors", CHAIN, {"alpha_deg": []}, "alpha_deg"),
        ("chain_with_errors", CHAIN, {"kappa_deg_between_joints": [1, 2]}, "kappa_deg_between_joints"),
        ("chain_with_errors", CHAIN, {"phase_errors_deg_before_each_joint": [1]}, "phase_errors_deg_before_each_joint"),
        (
            "chain_with_errors",
            CHAIN,
            {"linear_errors_mm_s1_a1_4_per_joint": [[0] * 5]},
            "linear_errors_mm_s1_a1_4_per_joint",
        ),
        (
            "chain_with_errors",
            CHAIN,
            {"alpha_deg": [80, 20], "angle_errors_deg_alpha1_4_per_joint": [[0, 25, 0, 0], [0, 0, 0, 0]]},
            "angle_errors_deg_alpha1_4_per_joint",
        ),
    ],
)
def test_bad_input_is_named(name, base, change, field):
    assert refused(name, {**base, **change}).field.split("[")[0] == field


def test_keys_are_read_in_other_units():
    inputs = dict(CHAIN)
    inputs["kappa_rad_between_joints"] = [np.radians(inputs.pop("kappa_deg_between_joints")[0])]
    inputs["linear_errors_m_s1_a1_4_per_joint"] = (
        0.001 * np.asarray(inputs.pop("linear_errors_mm_s1_a1_4_per_joint"))
    ).tolist()
    inputs["angle_errors_arcmin_alpha1_4_per_joint"] = (
        60 * np.asarray(inputs.pop("angle_errors_deg_alpha1_4_per_joint"))
    ).tolist()
    inputs["alpha_rad"] = np.radians(inputs.pop("alpha_deg")).tolist()
    one, other = calc("chain_with_errors", inputs), calc("chain_with_errors", CHAIN)
    assert one == pytest.approx(other, rel=1e-9)


def test_a_single_joint_is_a_chain_too():
    found = calc(
        "chain_with_errors",
        {
            "alpha_deg": [30],
            "kappa_deg_between_joints": [],
            "phi1_deg": 90,
            "angle_errors_deg_alpha1_4_per_joint": [[0.1, 0, 0, 0]],
        },
    )
    # The peak of a pin out of square is sin α times the error, once a turn.
    assert found["delta_phi_out_linear_rad"] == pytest.approx(np.radians(0.1) * np.sin(np.radians(30)))
    assert found["first_harmonic_rad"] > 100 * found["second_harmonic_rad"]
    assert found["axial_shift_out_exact_m"] == 0.0


def test_errors_of_the_other_sign_give_the_other_sign_to_first_order():
    minus = {key: (-np.asarray(value)).tolist() if "errors" in key else value for key, value in CHAIN.items()}
    one, other = calc("chain_with_errors", CHAIN), calc("chain_with_errors", minus)
    assert other["delta_phi_out_linear_rad"] == pytest.approx(-one["delta_phi_out_linear_rad"])
    assert other["axial_shift_out_linear_m"] == pytest.approx(-one["axial_shift_out_linear_m"])
