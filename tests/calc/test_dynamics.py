"""Absorbers, run-ups and straight lines by name: units, forms, and what is refused under which key."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from cardan import InputError, calc
from cardan.formulas.absorbers import den_hartog

CASES = json.loads((Path(__file__).parents[1] / "reference" / "dynamics.json").read_text("utf8"))["cases"]
CASE = {case["id"]: case["inputs"] for case in CASES}
ABSORBER, PENDULUM, LINE = CASE["abs-damped"], CASE["cpva-0"], CASE["lfr-0"]
SWEEP, JOINT = CASE["run-0"], CASE["run-joint"]


def fields(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return [problem.field for problem in caught.value.problems]


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"inertia_ratio": 0.0}, ["inertia_ratio"]),
        ({"frequency_ratio_absorber": 0.0}, ["frequency_ratio_absorber"]),
        ({"xi": -0.1}, ["xi"]),
        ({"beta": [0.5, -1.0]}, ["beta"]),
        ({"xi_definition": "b/(2 J omega)"}, ["xi_definition"]),
        ({"inertia_ratio": -1.0, "xi": -1.0}, ["inertia_ratio", "xi"]),
    ],
)
def test_bad_absorbers_are_named(changed, named):
    assert fields("absorber_response", ABSORBER | changed) == named
    if "frequency_ratio_absorber" not in changed:
        bare = {key: value for key, value in (ABSORBER | changed).items() if key != "frequency_ratio_absorber"}
        assert fields("viscous_damper_response", bare) == named


def test_a_bare_frequency_gives_a_bare_number():
    many = calc("absorber_response", ABSORBER)["amplification"]
    one = calc("absorber_response", ABSORBER | {"beta": ABSORBER["beta"][1]})["amplification"]
    assert one == pytest.approx(many[1], rel=1e-14)


def test_damping_may_be_referred_to_the_absorber():
    own = calc("absorber_response", ABSORBER)
    f = ABSORBER["frequency_ratio_absorber"]
    other = ABSORBER | {"xi": ABSORBER["xi"] / f, "xi_definition": "b/(2 J_a omega_a)"}
    assert calc("absorber_response", other)["amplification"] == pytest.approx(own["amplification"], rel=1e-13)


def test_a_resonance_without_damping_is_none_among_numbers():
    found = calc("viscous_damper_response", {"inertia_ratio": 0.5, "xi": 0.0, "beta": [0.5, 1.0]})["amplification"]
    assert found[0] == pytest.approx(1 / 0.75)
    assert found[1] is None


def test_many_inertias_equal_single_ones():
    many, one = (calc("absorber_optimum", {"inertia_ratio": ratio}) for ratio in ([0.05, 0.3], 0.3))
    for setting, values in one.items():
        for key, value in values.items():
            assert many[setting][key][1] == pytest.approx(value, rel=1e-9)
    assert fields("absorber_optimum", {"inertia_ratio": [0.1, 0.0]}) == ["inertia_ratio"]


def test_damping_of_the_fixed_points_is_that_of_fig_83():
    """Drawn from 0.168 at 1/α_J = 10 down to 0.140, to the digits that can be read off; there it has reached 16."""
    low, high = (calc("absorber_optimum", {"inertia_ratio": 1 / n})["den_hartog"]["xi"] for n in (10, 16))
    assert (low, high) == pytest.approx((0.168, 0.140), abs=6e-4)
    assert low == pytest.approx(float(den_hartog(0.1).damping), rel=1e-14)


@pytest.mark.parametrize("key", ["pendulum_mass_kg", "pivot_radius_m", "pendulum_length_m", "count"])
def test_bad_pendulums_are_named(key):
    assert fields("pendulum_absorber", PENDULUM | {key: 0}) == [key]
    assert fields("pendulum_absorber", PENDULUM | {"order": -2}) == ["order"]


def test_a_tuned_pendulum_is_reported_as_antiresonance():
    found = calc("pendulum_absorber", PENDULUM | {"pendulum_length_m": 0.03})
    assert found["antiresonance"] is True
    assert found["effective_inertia_kgm2"] is None
    assert found["total_inertia_kgm2"] is None
    assert calc("pendulum_absorber", PENDULUM)["antiresonance"] is False
    in_mm = {key.replace("_m", "_mm"): 1e3 * PENDULUM[key] for key in ("pivot_radius_m", "pendulum_length_m")}
    rest = {key: value for key, value in PENDULUM.items() if not key.endswith("_m")}
    assert calc("pendulum_absorber", rest | in_mm) == pytest.approx(calc("pendulum_absorber", PENDULUM))


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"inertia_kgm2": [1.5, -0.05, 0.8]}, ["inertia_kgm2"]),
        ({"inertia_kgm2": []}, ["inertia_kgm2"]),
        ({"inertia_kgm2": [0, 0, 0]}, ["inertia_kgm2"]),
        ({"stiffness_Nm_per_rad": [8000.0, 0.0]}, ["stiffness_Nm_per_rad"]),
        ({"stiffness_Nm_per_rad": [8000.0]}, ["stiffness_Nm_per_rad"]),
        ({"damping_Nms_per_rad": [1.0]}, ["damping_Nms_per_rad"]),
        ({"damping_Nms_per_rad": [1.0, -1.0]}, ["damping_Nms_per_rad"]),
        ({"loss_factor": [0.1, 0.1, 0.1]}, ["loss_factor"]),
        ({"torque_station": 4}, ["torque_station"]),
        ({"torque_station": 0}, ["torque_station"]),
        ({"torque_station": 1.5}, ["torque_station"]),
        ({"omega_rad_s": -1.0}, ["omega_rad_s"]),
        ({"omega_rad_s": [1.0, 0.0]}, ["omega_rad_s"]),
        ({"stiffness_Nm_per_rad": [], "loss_factor": []}, ["stiffness_Nm_per_rad", "loss_factor"]),
    ],
)
def test_bad_lines_are_named(changed, named):
    assert sorted(fields("linear_forced_response", LINE | changed)) == sorted(named)


def test_a_frequency_without_an_answer_is_named_with_its_value():
    line = {"inertia_kgm2": [1, 1], "stiffness_Nm_per_rad": [50], "torque_station": 2}
    with pytest.raises(InputError, match="10 rad/s is a natural frequency") as caught:
        calc("linear_forced_response", line | {"omega_rad_s": [3, 10]})
    assert caught.value.field == "omega_rad_s"
    with pytest.raises(InputError) as caught:
        calc("linear_forced_response", line | {"omega_Hz": 0})
    assert caught.value.field == "omega_Hz"


def test_many_frequencies_equal_single_ones():
    found = calc("linear_forced_response", LINE | {"omega_rad_s": [20.0, 60.0]})
    one = calc("linear_forced_response", LINE)
    for key, value in one.items():
        np.testing.assert_allclose(np.asarray(found[key])[:, 1], value, rtol=1e-13)
    double = calc("linear_forced_response", LINE | {"torque_amplitude_Nm": 2.0})
    np.testing.assert_allclose(double["element_torque_Nm"], 2 * np.asarray(one["element_torque_Nm"]), rtol=1e-14)


def test_stations_without_inertia_add_no_frequency():
    found = calc("torsional_natural_frequencies", {"inertia_kgm2": [2, 0, 0.6], "stiffness_Nm_per_rad": [1800, 1800]})
    wanted = calc("torsional_natural_frequencies", {"inertia_kgm2": [2, 0.6], "stiffness_Nm_per_rad": [900]})
    assert found["omega_rad_s"] == pytest.approx(wanted["omega_rad_s"], rel=1e-14)
    assert found["order2_critical_speed_rpm"] == pytest.approx(wanted["order2_critical_speed_rpm"], rel=1e-14)
    # Half-way along the spring, half-way between both angles.
    assert found["mode_shape"][1] == pytest.approx([-0.3, 0.35, 1.0], rel=1e-13)
    alone = calc("torsional_natural_frequencies", {"inertia_kgm2": [2], "stiffness_Nm_per_rad": []})
    assert alone["omega_rad_s"] == [0.0]
    assert alone["order2_critical_speed_rpm"] == []


@pytest.mark.parametrize(
    ("inputs", "named"),
    [
        (SWEEP | {"sweep_acceleration_rad_s2": 0.0}, ["sweep_acceleration_rad_s2"]),
        (SWEEP | {"damping_ratio": 0.0}, ["damping_ratio"]),
        (SWEEP | {"damping_ratio": 1.0}, ["damping_ratio"]),
        (SWEEP | {"t_max_s": 0.0}, ["t_max_s"]),
        (SWEEP | {"t_s": [-1.0]}, ["t_s"]),
        (SWEEP | {"natural_frequency_rad_s": -20.0, "t_max_s": -1.0}, ["natural_frequency_rad_s", "t_max_s"]),
        (SWEEP | {"damping_ratio": None}, ["damping_ratio"]),
        (SWEEP | {"equation": "y'' = 0"}, ["equation"]),
        (JOINT | {"alpha_deg": 90}, ["alpha_deg"]),
        (JOINT | {"stiffness_Nm_per_rad": 0}, ["stiffness_Nm_per_rad"]),
        (JOINT | {"inertia_kgm2": 0}, ["inertia_kgm2"]),
        (JOINT | {"damping_Nms_per_rad": -0.5}, ["damping_Nms_per_rad"]),
        (JOINT | {"input_acceleration_rad_s2": -20}, ["input_acceleration_rad_s2"]),
        (JOINT | {"t_max_s": -4}, ["t_max_s"]),
        (JOINT | {"t_s": [5.0]}, ["t_s"]),
        (JOINT | {"inertia_kgm2": None, "stiffness_Nm_per_rad": None}, ["stiffness_Nm_per_rad", "inertia_kgm2"]),
        (JOINT | {"t_max_s": 1e5}, ["t_max_s"]),
        (JOINT | {"damping_ratio": 0.1}, ["alpha_deg"]),
        ({"t_max_s": 1.0}, ["alpha_deg"]),
    ],
)
def test_bad_run_ups_are_named(inputs, named):
    assert fields("run_up", inputs) == named


def test_curves_come_with_the_instants_asked_for():
    bare = {key: value for key, value in SWEEP.items() if key != "t_s"}
    assert "y" not in calc("run_up", bare)
    in_hertz = {"natural_frequency_Hz": 20 / (2 * math.pi), "damping_ratio": 0.02, "sweep_acceleration_rad_s2": 8}
    found = calc("run_up", in_hertz | {"t_s": SWEEP["t_s"], "t_max_s": 6})
    assert found["y"] == pytest.approx(calc("run_up", SWEEP)["y"], rel=1e-9)
    torque = calc("run_up", JOINT | {"t_s": [0.0, calc("run_up", JOINT)["peak_time_s"]]})
    assert torque["torque_Nm"][0] == pytest.approx(0.0, abs=1e-9)
    assert abs(torque["torque_Nm"][1]) == pytest.approx(torque["peak_torque_Nm"], rel=1e-9)
