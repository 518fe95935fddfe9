import numpy as np
import pytest
from scipy.special import mathieu_a, mathieu_b

from cardan import InputError, calc
from cardan.maths.periodic.mathieu import boundaries, exponents


def fields(name, inputs):
    with pytest.raises(InputError) as caught:
        calc(name, inputs)
    return [problem.field for problem in caught.value.problems]


DRIVE = {
    "alpha_deg": [10.0, 14.0],
    "psi_deg": [0.0, 40.0],
    "stiffness_Nm_per_rad": [3000.0, 9000.0, 2500.0],
    "J_first_kgm2": 2.0,
    "J_last_kgm2": 0.6,
    "speed_rpm": 860.0,
}


@pytest.mark.parametrize("order", [0, 1, 7])
def test_boundaries_carry_their_order_in_their_names(order):
    found = calc("mathieu_stability", {"q": -1.5, "boundaries_up_to_order": order})
    assert list(found) == [f"a_0_to_{order}", f"b_1_to_{order}"]
    assert found[f"a_0_to_{order}"] == pytest.approx([mathieu_a(r, -1.5) for r in range(order + 1)], abs=1e-12)
    assert found[f"b_1_to_{order}"] == pytest.approx([mathieu_b(r, -1.5) for r in range(1, order + 1)], abs=1e-12)


def test_exponent_is_told_where_there_is_one():
    assert "beta" not in calc("mathieu_stability", {"a": 1.0, "q": 0.1})
    found = calc("mathieu_stability", {"a": -0.1, "q": -0.6, "n": 0.2})
    assert found["growth_rate_per_rad"] == pytest.approx(-0.2)
    assert found["stable"] is True
    assert found["beta"] == pytest.approx(float(exponents(-0.14, 0.6).beta), abs=1e-12)
    assert "beta_book225" not in found
    edge = calc("mathieu_stability", {"a": 4.0, "q": 0.0})
    assert (edge["half_trace_undamped"], edge["growth_rate_per_rad"], edge["stable"]) == (1.0, 0.0, True)


def test_zones_beyond_the_principal_one_have_no_book_formula():
    found = calc("mathieu_stability", {"q": 2.0, "n": 0.01, "zone": 2})
    assert list(found) == ["a_lower", "a_upper"]
    a, b = boundaries(2.0, 2)
    assert b[1] < found["a_lower"] < found["a_upper"] < a[2]
    gone = calc("mathieu_stability", {"q": 0.1, "n": 0.2, "zone": 1})
    assert set(gone.values()) == {None}


def test_several_questions_may_be_asked_at_once():
    found = calc("mathieu_stability", {"a": 1.0, "q": 0.1, "n": 0.03, "zone": 1, "boundaries_up_to_order": 1})
    assert {"stable", "a_lower", "a_lower_book221", "a_0_to_1"} <= set(found)


def test_what_is_wrong_with_a_request_is_named():
    assert fields("mathieu_stability", {"q": 0.1}) == ["a"]
    assert fields("mathieu_stability", {"a": 1.0}) == ["q"]
    assert fields("mathieu_stability", {"a": np.nan, "q": 1e9, "n": "x"}) == ["a", "q", "n"]
    assert fields("mathieu_stability", {"q": 0.1, "zone": 0}) == ["zone"]
    assert fields("mathieu_stability", {"q": 0.1, "zone": 1, "n": -0.1}) == ["n"]
    assert fields("mathieu_stability", {"q": 0.1, "boundaries_up_to_order": 1.5}) == ["boundaries_up_to_order"]


def test_the_exact_drive_is_asked_for_by_its_torque():
    assert "half_trace_exact" not in calc("mathieu_reduction", DRIVE)
    rest = {key: value for key, value in DRIVE.items() if key != "speed_rpm"}
    found = calc("mathieu_reduction", rest | {"speed_rad_s": 40.0, "drive_torque_Nm": -30.0})
    exact, right = found["half_trace_exact"], found["half_trace_mathieu_q_corrected"]
    assert exact == pytest.approx(right, abs=0.02)
    assert right == pytest.approx(float(exponents(found["a"], found["q_corrected"]).half_trace), rel=1e-14)
    assert found["q_corrected"] == 2 * found["q_book"]
    assert len(found["kappa"]) == 2


def test_lists_of_a_drive_need_to_fit():
    assert fields("mathieu_reduction", DRIVE | {"psi_deg": [0.0], "stiffness_Nm_per_rad": [1.0]}) == [
        "psi_deg",
        "stiffness_Nm_per_rad",
    ]
    assert fields("mathieu_reduction", DRIVE | {"alpha_deg": [], "psi_deg": [], "stiffness_Nm_per_rad": [1.0]}) == [
        "alpha_deg"
    ]
    wrong = DRIVE | {"alpha_deg": [10.0, 90.0], "stiffness_Nm_per_rad": [1.0, 0.0, 1.0], "J_last_kgm2": 0.0}
    assert fields("mathieu_reduction", wrong) == ["alpha_deg[1]", "stiffness_Nm_per_rad[1]", "J_last_kgm2"]


def test_a_slow_speed_is_named_where_it_leads_out_of_range():
    assert fields("mathieu_reduction", DRIVE | {"speed_rpm": 0.1, "drive_torque_Nm": 0.0}) == ["speed_rpm"]


def test_amplitudes_stand_under_their_orders():
    forcing = [
        {"amplitude": 1.0, "order": 0, "phase_deg": 90.0},
        {"amplitude": 0.5, "order": 2, "phase_deg": 30.0},
        {"amplitude": 0.2, "order": 6.8125},
    ]
    found = calc("mathieu_forced", {"a": 2.0, "q": 0.0, "forcing": forcing})
    assert found["order_amplitude"] == pytest.approx({"0": 0.5, "2": 0.25, "6.8125": 0.2 / (6.8125**2 - 2.0)})
    assert found["order_phase_deg"] == pytest.approx({"0": 90.0, "2": -150.0, "6.8125": 180.0})
    assert found["mean"] == 0.5
    assert "4" in calc("mathieu_forced", {"a": 2.0, "q": 0.1, "forcing": forcing})["order_amplitude"]


def test_a_forcing_in_resonance_is_named():
    forcing = [{"amplitude": 1.0, "order": 1}, {"amplitude": 1.0, "order": 2}]
    assert fields("mathieu_forced", {"a": 4.0, "q": 0.0, "forcing": forcing}) == ["forcing[1].order"]
    assert fields("mathieu_forced", {"a": 4.0, "q": 0.0, "forcing": [{"amplitude": 1.0, "order": -1}]}) == [
        "forcing[0].order"
    ]


SIZING = {
    "c_Nm_per_rad": 900.0,
    "s_n1": 0.0513,
    "a": 0.774,
    "J_first_kgm2": 2.0,
    "J_last_kgm2": 0.64,
    "drive_torque_mean_Nm": -150.0,
}


def test_harmonics_of_one_order_are_taken_together():
    one = {"order": 6.8, "amplitude_Nm": 72.0}
    found = calc("dynamic_torque_engineering", SIZING | {"drive_torque_harmonics": [one, one]})
    single = calc("dynamic_torque_engineering", SIZING | {"drive_torque_harmonics": [one]})
    assert found["engine_order_abs_Nm"]["6.8"] == 2 * single["engine_order_abs_Nm"]["6.8"]
    assert found["mean_abs_Nm"] == 150.0
    load = calc("dynamic_torque_engineering", SIZING | {"load_torque_harmonics": [one]})
    assert load["load_order_abs_Nm"]["6.8"] == pytest.approx(single["engine_order_abs_Nm"]["6.8"] * 2.0 / 0.64)


def test_torques_without_bound_are_refused():
    two = [{"order": 2.0, "amplitude_Nm": 1.0}]
    assert fields("dynamic_torque_engineering", SIZING | {"a": 4.0, "load_torque_harmonics": two}) == [
        "a",
        "load_torque_harmonics[0].order",
    ]
    assert fields("dynamic_torque_engineering", SIZING | {"c_Nm_per_rad": 0.0, "s_n1": -1.0}) == [
        "c_Nm_per_rad",
        "s_n1",
    ]


def test_validity_tells_what_neglecting_costs():
    found = calc("validity_check", {"a": 0.774, "q": 0.0066, "forcing_orders": [0, 2, 6.8]})
    assert not found["book_237_satisfied"]
    assert not found["neglecting_q_costs_over_5_percent"]
    assert max(found["neglecting_q_costs"]) < 0.01
    zone = calc("validity_check", {"a": 1.0, "q": 0.05, "forcing_orders": [0, 2]})
    assert not zone["stable"]
    assert "beta" not in zone
    assert zone["neglecting_q_costs_over_5_percent"]
    resonant = calc("validity_check", {"a": 4.0, "q": 0.0, "forcing_orders": [2]})
    assert resonant["solved_amplitude"] == [None]
    assert fields("validity_check", {"a": 1.0, "q": 0.05, "forcing_orders": [0, -2]}) == ["forcing_orders[1]"]


def test_the_truck_needs_no_input():
    found = calc("worked_example_truck", {})
    assert found["order2_resonance_speed_rpm"] == pytest.approx(378.3, abs=0.05)
    assert found["principal_zone_speed_rpm"] == pytest.approx(756.6, abs=0.05)
    assert calc("worked_example_truck", {"speed_rpm": 900.0, "a": 0.9})["natural_frequency_rad_s"] == pytest.approx(
        900 * np.pi / 30 * np.sqrt(0.9)
    )
