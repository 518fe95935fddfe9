import json
import math
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages

import numpy as np
import pytest

from cardan import InputError, calc
from cardan.calc import CALCULATIONS, find
from cardan.errors import Problem
from cardan.units import DIMENSIONS

CHAIN = {"alpha_deg": [10, 20], "beta_deg": [30], "gamma_deg": [0], "phi1_deg": 40}


OWN = [name for name in CALCULATIONS if name != "errors"]
"""Those that answer by themselves; `errors` hands on to another."""


def problems(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return {problem.field: problem.message for problem in caught.value.problems}


def test_no_file_of_calculations_is_left_out():
    folder = import_module("cardan.calc").__path__
    parts = [import_module(module.name) for module in walk_packages(folder, "cardan.calc.")]
    declared = [one for part in parts if hasattr(part, "formula") for one in part.formula.calculations]
    assert {one.name for one in declared} == set(OWN)
    assert len(declared) == len(OWN), "two calculations share a name"


@pytest.mark.parametrize("one", CALCULATIONS.values(), ids=CALCULATIONS)
def test_every_calculation_says_what_it_takes_and_gives(one):
    assert one.doc
    assert one.source
    names = [item.name for item in one.takes]
    assert len(set(names)) == len(names)
    for item in one.takes:
        assert item.doc
        assert item.shape
        if item.meaning.dimension:
            units = set(f"_{item.key}_".split("_")) - set(f"_{item.name}_".split("_"))
            assert units & {word for unit in DIMENSIONS[item.meaning.dimension] for word in unit.split("_")}
    for output in one.returns:
        assert output.doc
        assert (output.unit in DIMENSIONS[output.dimension]) if output.dimension else output.unit == ""


CASES = [
    case
    for name in ("kinematics.json", "statics.json", "dynamics.json", "strength.json", "structure.json")
    for case in json.loads((Path(__file__).parents[1] / "reference" / name).read_text("utf8"))["cases"]
    if case["capability"] != "errors" and "error_field" not in case["expected"]
]
FIRST = {case["capability"]: case["inputs"] for case in reversed(CASES)} | {
    "blokh": CHAIN,
    "book_series": CHAIN,
    "book_comparison": {key: CHAIN[key] for key in ("alpha_deg", "beta_deg", "gamma_deg")},
    "rule_of_practice": {key: CHAIN[key] for key in ("alpha_deg", "beta_deg", "gamma_deg")},
    "pin_geometry": {"alpha_max_deg": 30, "radius_m": 0.06},
    "double_joint": {"alpha12_deg": 20, "alpha23_deg": 15, "arrangement": "a"},
    "collinear_joints": {"alpha_deg": [20, 15], "sign": [1, -1]},
    "ball_bearing_life": {"C_N": 25700, "C0_N": 15300, "radial_force_N": 2800, "axial_force_N": 1600, "speed_rpm": 650},
    "seal_friction": {"seal_diameter_m": 0.04, "speed_rpm": 1500},
    "groove_offset": {"alpha_deg": 40, "plane_tilt_deg": 0.5, "axial_play_m": 1e-4},
    "length_compensation": {
        "points0_m": [[-1, 0, 0], [0, 0, 0], [1, 0, -0.2], [2, 0, -0.2]],
        "amplitude_m": [[0, 0, 0], [0, 0, 0], [0, 0, 0.1], [0, 0, 0.1]],
        "omega_motion_rad_s": 5.0,
        "t_s": np.linspace(0, 2 * np.pi / 5, 201).tolist(),
        "overlap0_m": 0.05,
        "gap0_m": 0.03,
        "overlap_min_allowed_m": 0.045,
    },
}


@pytest.mark.parametrize("name", OWN)
def test_every_calculation_answers_in_plain_values_under_declared_keys(name):
    found = calc(name, FIRST[name])
    assert set(found) <= {output.key for output in CALCULATIONS[name].returns}
    assert json.loads(json.dumps(found, allow_nan=False)) == found


@pytest.mark.parametrize("name", OWN)
def test_every_calculation_refuses_a_key_it_does_not_know_and_names_all_it_misses(name):
    found = problems(name, {"colour": "red"})
    required = {item.key for item in CALCULATIONS[name].takes if item.required}
    if name == "efficiency_spline_branches_factors":
        required = {"mu_spline"}  # or any other of its parts
    if name in ("periodic_response", "floquet_stability"):
        required |= {"input_speed_rad_s"}  # or a mean speed
    if name == "critical_speed_book":
        required |= {"length_m"}  # or the material of its constant
    if name == "critical_speed":
        required |= {"d_out_mm", "length_mm", "E_GPa", "density_kg_m3"}  # or what another method needs
    if name == "mathieu_stability":
        required |= {"a"}  # or one of its other questions
    if name == "design_torque":
        required |= {"engine_torque_Nm", "engine_speed_rpm"}  # the torque, or power and speed
    if name == "lubrication_due":
        required |= {"hours"}  # or another counter
    if name == "diagnose":
        required |= {"order"}  # or another sign
    if name == "spline_axial_force":
        required = {"alpha_deg", "phi1_deg", "M2_Nm", "mu", "d_spline_m"}  # or those of the thrust alone
    either = {"alpha_deg"} if "alpha_deg" in {i.key for i in CALCULATIONS[name].takes if not i.required} else set()
    assert set(found) == {"colour"} | required | either


@pytest.mark.parametrize("name", OWN)
def test_every_number_must_be_a_finite_number(name):
    for item in CALCULATIONS[name].takes:
        for bad in ("x", True, {"a": 1}, [[["x"]]], math.nan):
            if (item.kind == "table" and bad == {"a": 1}) or (item.kind == "flag" and bad is True):
                continue
            if item.kind == "word" and not item.meaning.choices and bad == "x":
                continue
            assert item.key in {field.split("[")[0].split(".")[0] for field in problems(name, {item.key: bad})}, bad


def test_any_unit_of_the_dimension_is_read():
    inputs = {"alpha_rad": math.radians(20), "phi1_arcmin": 45 * 60, "omega1_rpm": 300 / math.pi * 10}
    mine = calc("single_joint", inputs)
    other = calc("single_joint", {"alpha_deg": 20, "phi1_deg": 45, "omega1_rad_s": 100})
    assert mine == pytest.approx(other, rel=1e-12)
    assert problems("single_joint", {"alpha_rad": 2.0, "phi1_deg": 0}) == {
        "alpha_rad": "2.0 is not allowed; allowed is at least 0 rad and less than 1.5708 rad"
    }
    assert problems("single_joint", {"alpha_rad": 0.1, "alpha_deg": 2, "phi1_deg": 0}) == {
        "alpha_deg": "alpha_rad gives the same already"
    }


def test_a_misspelt_key_is_met_with_the_nearest():
    assert problems("single_joint", {"alpha_deg": 1, "phi1_deg": 0, "omega_rad_s": 3}) == {
        "omega_rad_s": "unknown key; the nearest known one is omega1_rad_s"
    }


@pytest.mark.parametrize(
    ("capability", "changed", "field"),
    [
        ("chain", {"alpha_deg": [10, -1]}, "alpha_deg"),
        ("chain", {"alpha_deg": [10, 90]}, "alpha_deg"),
        ("chain", {"alpha_deg": [10, math.inf]}, "alpha_deg"),
        ("chain", {"alpha_deg": []}, "alpha_deg"),
        ("chain", {"alpha_deg": 10}, "alpha_deg"),
        ("chain", {"beta_deg": [1, 2]}, "beta_deg"),
        ("chain", {"gamma_deg": []}, "gamma_deg"),
        ("chain", {"gamma_deg": [[0], [1, 2]]}, "gamma_deg"),
        ("equivalent_joint", {"phi1_deg": 40}, "phi1_deg"),
        ("synthesis_spline", {"spline_teeth": [16.5]}, "spline_teeth"),
        ("synthesis_spline", {"spline_teeth": [0]}, "spline_teeth"),
        ("synthesis_spline", {"spline_teeth": [16, 16]}, "spline_teeth"),
        ("synthesis_spline", {"spline_teeth": [-3]}, "spline_teeth"),
        ("synthesis_continuous", {"fixed_gamma_deg": {"3": 0}}, "fixed_gamma_deg.3"),
        ("synthesis_continuous", {"fixed_gamma_deg": {"two": 0}}, "fixed_gamma_deg.two"),
        ("synthesis_continuous", {"points_m": [[0, 0, 0], [1, 0, 0], [2, 0, 1]], "beta_deg": None}, "points_m"),
    ],
)
def test_bad_chains_are_named(capability, changed, field):
    own = {item.key for item in CALCULATIONS[capability].takes}
    inputs = {key: value for key, value in (CHAIN | {"spline_teeth": [16]}).items() if key in own} | changed
    assert set(problems(capability, inputs)) == {field}


@pytest.mark.parametrize(
    ("points", "field"),
    [
        ([[0, 0, 0], [0, 0, 0], [1, 0, 0]], "points_m[1]"),
        ([[0, 0, 0], [1, 0, 0], [1, 1e-12, 0]], "points_m[2]"),
        ([[0, 0, 0], [1, math.nan, 0], [2, 0, 0]], "points_m[1]"),
        ([[0, 0, 0], [1, 0], [2, 0, 0]], "points_m[1]"),
        ([[0, 0, 0], [1, 0, 0], [1, 1, 0]], "points_m"),
        ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], "points_m"),
        ([[0, 0, 0], [1, 0, 0]], "points_m"),
        ([], "points_m"),
        ([0, 0, 0], "points_m"),
    ],
)
def test_bad_points_are_named(points, field):
    assert set(problems("geometry_from_points", {"points_m": points})) == {field}


def test_shafts_at_a_right_angle_are_named():
    found = problems("geometry_from_points", {"points_m": [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0]]})
    assert "shafts 2 and 3 enclose 90°" in found["points_m"]


def test_everything_wrong_is_told_at_once():
    inputs = {"alpha_deg": [95, 10], "beta_deg": [1, 2], "gama_deg": [0], "phi1_deg": "x"}
    assert set(problems("chain", inputs)) == {"alpha_deg", "gama_deg", "phi1_deg"}
    assert set(problems("chain", {"beta_deg": [1, 2], "alpha_deg": [1, 2], "phi1_deg": "x"})) == {
        "beta_deg",
        "phi1_deg",
    }


def test_an_unknown_capability_is_met_with_the_nearest():
    assert problems("single_join", {}) == {
        "capability": "there is no calculation named 'single_join'; did you mean single_joint?"
    }
    assert "there are absorber_optimum, absorber_response, " in problems("xyz", {})["capability"]
    assert problems("errors", {"call": "chian"}) == {
        "call": "there is no calculation named 'chian'; did you mean chain?"
    }
    assert find("chain").name == "chain"


def test_a_calculation_may_be_called_through_errors():
    assert calc("errors", {"call": "chain", **CHAIN}) == calc("chain", CHAIN)
    assert set(problems("errors", {"call": "chain", "phi1_deg": "x"})) == {"alpha_deg", "phi1_deg"}
    assert set(problems("errors", {})) == {"call"}


def test_problems_of_the_functions_below_come_under_the_keys_given():
    with pytest.raises(InputError) as caught:
        calc("double_joint", {"alpha12_deg": 1, "alpha23_deg": 2, "arrangement": "d", "beta2_deg": 3})
    assert [type(problem) for problem in caught.value.problems] == [Problem]
    assert caught.value.field == "gamma2_deg"


@pytest.mark.parametrize("capability", ["single_joint", "chain", "geometry_from_points", "blokh", "book_series"])
def test_many_angles_equal_single_ones(capability):
    inputs = dict(FIRST[capability])
    angles = [-500.0, 0.0, 77.0, 900.0]
    many = calc(capability, inputs | {"phi1_deg": angles})
    for k, angle in enumerate(angles):
        for key, value in calc(capability, inputs | {"phi1_deg": angle}).items():
            if np.shape(many[key]) == np.shape(value):
                assert many[key] == value
            else:
                # Vector loops of NumPy fuse products that its loops over one number do not.
                assert np.asarray(many[key])[..., k] == pytest.approx(np.asarray(value), rel=1e-12, abs=1e-11)


def test_many_bends_equal_single_ones():
    many = calc("single_joint_extremes", {"alpha_deg": [5.0, 45.0]})
    for k, joint_angle in enumerate((5.0, 45.0)):
        one = calc("single_joint_extremes", {"alpha_deg": joint_angle})
        assert {key: value[k] for key, value in many.items()} == pytest.approx(one, rel=1e-14)
    both = calc("equivalent_joint", {"alpha_deg": [[10, 20], [5, 5]], "beta_deg": [30]})
    assert both["delta"][1] == pytest.approx(calc("equivalent_joint", {"alpha_deg": [5, 5], "beta_deg": [30]})["delta"])
    assert both["delta_of_each_shaft"][0][0] == pytest.approx(calc("equivalent_joint", {"alpha_deg": [10]})["delta"])


def test_points_may_stand_for_bends():
    points = [[0, 0, 0], [0.1, 0, 0.007], [0.498, -0.072, 0.034], [0.707, -0.057, 0.027], [0.9, 0, 0]]
    place = calc("geometry_from_points", {"points_m": points})
    angles = {key: place[key] for key in ("alpha_deg", "beta_deg")}
    one, other = (calc("synthesis_continuous", given) for given in ({"points_m": points}, angles))
    assert one["delta_max"] == pytest.approx(other["delta_max"], rel=1e-12)


def test_arrays_are_read_like_lists():
    inputs = CHAIN | {"alpha_deg": np.asarray([10.0, 20.0]), "phi1_deg": np.float64(40)}
    assert calc("chain", inputs) == calc("chain", CHAIN)


def test_what_is_undefined_is_none():
    assert calc("equivalent_joint", {"alpha_deg": [20, 20]})["psi_eq_mod180_deg"] is None


def test_sliding_says_which_limit_it_passes():
    found = calc("length_compensation", FIRST["length_compensation"])
    # The middle joint swings ±0.1 m about 0.2 m below: L between √1.01 and √1.09.
    assert found["stroke_m"] == pytest.approx(math.sqrt(1.09) - math.sqrt(1.01), abs=1e-6)
    assert found["slip_path_m"] == pytest.approx(2 * found["stroke_m"], rel=1e-4)
    assert found["engaged_min_m"] == pytest.approx(0.05 - (math.sqrt(1.09) - math.sqrt(1.04)), abs=1e-6)
    assert len(found["flags"]) == 1


@pytest.mark.parametrize("one", [CALCULATIONS[name] for name in OWN], ids=OWN)
@pytest.mark.parametrize("value", [10**400, 1e308, -1e308])
def test_a_number_that_no_drive_has_is_refused_under_its_key(one, value):
    for item in one.takes:
        if item.kind in {"word", "table"}:
            continue
        deep = value
        for _axis in range(item.axes[-1]):
            deep = [deep] * (item.width or 1)
        assert any(field.startswith(item.key) for field in problems(one.name, FIRST[one.name] | {item.key: deep}))


@pytest.mark.parametrize(
    ("capability", "inputs", "field"),
    [
        ("chain", {"alpha_deg": [10, 20], "beta_deg": [[1]], "phi1_deg": 0}, "beta_deg"),
        ("chain", {"alpha_deg": [[10, 20]] * 2, "gamma_deg": [[1], [2], [3]], "phi1_deg": 0}, "gamma_deg"),
        ("collinear_joints", {"alpha_deg": [10, 20], "sign": [1]}, "sign"),
        ("collinear_joints", {"alpha_deg": [10, 20], "sign": [1, 0]}, "sign"),
        ("collinear_joints", {"alpha_deg": [], "sign": []}, "alpha_deg"),
        ("book_series", {"alpha_deg": [10], "phi1_deg": 0, "order": 2, "phases": "mean"}, "phases"),
        ("length_compensation", FIRST["length_compensation"] | {"t_s": [0.0, 0.2, 0.1]}, "t_s"),
        ("synthesis_spline", {"alpha_deg": [10] * 6, "spline_teeth": [10_007] * 5}, "spline_teeth"),
        ("errors", {"call": ["chain"]}, "call"),
    ],
)
def test_inputs_that_do_not_go_together_are_refused_under_their_key(capability, inputs, field):
    assert field in problems(capability, inputs)
