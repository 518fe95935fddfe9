import copy
import json
from pathlib import Path

import numpy as np
import pytest

from cardan import InputError, calc

CASES = json.loads((Path(__file__).parents[1] / "reference" / "statics.json").read_text("utf8"))["cases"]
BLOCKED = next(case["inputs"] for case in CASES if case["id"] == "as-01")
ELASTIC = next(case["inputs"] for case in CASES if case["id"] == "in-02")


def changed(inputs, path, value):
    other = copy.deepcopy(inputs)
    place = other
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    return other


def problems(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return {problem.field for problem in caught.value.problems}


@pytest.mark.parametrize(
    ("path", "value", "field"),
    [
        (["alpha_deg"], 90, "alpha_deg"),
        (["alpha_deg"], -1, "alpha_deg"),
        (["phi1_deg"], float("nan"), "phi1_deg"),
        (["errors_mm_s1_a1_a2_a3_a4"], [0.1], "errors_mm_s1_a1_a2_a3_a4"),
        (["free_slides"], ["pin_D"], "free_slides[0]"),
        (["free_slides"], "pin_B", "free_slides"),
        (["shafts"], [], "shafts"),
        (["shafts", 0, "bearing_span_m"], 0, "shafts[0].bearing_span_m"),
        (["shafts", 1, "overhang_m"], -0.1, "shafts[1].overhang_m"),
        (["shafts", 1, "EI_Nm2"], 0, "shafts[1].EI_Nm2"),
        (["shafts", 0, "EA_N"], -1, "shafts[0].EA_N"),
        (["shafts", 0, "k_radial_near_N_m"], 0, "shafts[0].k_radial_near_N_m"),
        (["shafts", 1, "k_axial_far_N_m"], float("inf"), "shafts[1].k_axial_far_N_m"),
        (["shafts", 1, "colour"], 1, "shafts[1].colour"),
    ],
)
def test_bad_joints_are_named(path, value, field):
    assert problems("assembly_forces", changed(BLOCKED, path, value)) == {field}


@pytest.mark.parametrize(
    ("path", "value", "field"),
    [
        (["points_m"], [[0, 0, 0], [1, 0, 0], [1, 1, 0], [2, 1, 0]], "points_m"),
        (["gamma_deg"], [1, 2], "gamma_deg"),
        (["bearings"], [], "bearings"),
        (["bearings", 0, "shaft"], 4, "bearings"),
        (["bearings", 0, "shaft"], 0, "bearings"),
        (["bearings", 0, "k_radial_N_m"], -1, "bearings[0].k_radial_N_m"),
        (["bearings", 0, "axial"], 1, "bearings[0].axial"),
        (["bearings", 3, "radial"], False, "bearings[3].radial"),
        (["bearings", 2, "housing_offset_m"], [0, 1], "bearings[2].housing_offset_m"),
        (["bearings", 2, "k_radial_N_m"], None, "bearings"),
    ],
)
def test_bad_bearings_are_named(path, value, field):
    assert problems("indeterminate_reactions", changed(ELASTIC, path, value)) == {field}


def test_what_is_free_stores_less():
    whole = calc("assembly_forces", BLOCKED)["strain_energy_J"]
    for free in ("pin_B", "pin_C", "shaft_2"):
        found = calc("assembly_forces", changed(BLOCKED, ["free_slides"], [free]))
        assert 0 < found["strain_energy_J"] < whole
    everything = calc("assembly_forces", changed(BLOCKED, ["free_slides"], ["pin_B", "pin_C", "shaft_2"]))
    assert everything["force_magnitude_N"] == pytest.approx(0.0, abs=1e-9)
    assert everything["max_force_over_turn_N"] == pytest.approx(0.0, abs=1e-9)


def test_a_straight_joint_is_regular():
    found = calc("assembly_forces", changed(BLOCKED, ["alpha_deg"], 0))
    # Shafts in line: what they miss along the axis meets both axial compliances in a row.
    axial = sum(
        (s["bearing_span_m"] + s["overhang_m"]) / s["EA_N"] + 1 / s["k_axial_far_N_m"] for s in BLOCKED["shafts"]
    )
    assert found["force_abs_along_shaft1_N"] == pytest.approx(abs(found["gap_vector_frame1_m"][2]) / axial, rel=1e-12)


@pytest.mark.slow
def test_the_largest_force_is_that_of_dense_samples():
    sizes = [
        calc("assembly_forces", changed(BLOCKED, ["phi1_deg"], angle))["force_magnitude_N"]
        for angle in np.arange(0.0, 360.0, 5.0)
    ]
    largest = calc("assembly_forces", BLOCKED)["max_force_over_turn_N"]
    # The curve bends by at most four times its size per rad²: half of five degrees lose under 0.5 %.
    assert max(sizes) <= largest <= max(sizes) * 1.005


def test_torque_and_misfit_superpose():
    both = calc("indeterminate_reactions", ELASTIC)
    alone = calc("indeterminate_reactions", changed(ELASTIC, ["M_out_Nm"], 0.0))
    level = copy.deepcopy(ELASTIC)
    for bearing in level["bearings"]:
        bearing.pop("housing_offset_m")
    loaded = calc("indeterminate_reactions", level)
    total = np.add(alone["bearing_reaction_N"], loaded["bearing_reaction_N"])
    np.testing.assert_allclose(total, both["bearing_reaction_N"], rtol=1e-9, atol=1e-8)


def test_a_determinate_layout_needs_no_stiffness():
    bare = copy.deepcopy(ELASTIC)
    for bearing in bare["bearings"]:
        bearing.pop("k_radial_N_m")
        bearing.pop("k_axial_N_m")
    del bare["bearings"][2]
    found = calc("indeterminate_reactions", bare)
    assert found["degree_of_indeterminacy"] == 0
    assert np.max(np.abs(found["bearing_reaction_N"])) > 1.0
