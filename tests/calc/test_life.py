"""Calculations of lives: what they refuse, their warnings, null for what is unlimited, other units."""

import json
import math

import numpy as np
import pytest

from cardan import InputError, calc
from cardan.units import deg

C, R = {"C_N": 20000, "R_mm": 40}, {"speed_rpm": 900, "alpha_deg": 6}
CASES = {
    "cross_loads": {"torque_Nm": 100, "torque_side": "input", "alpha_deg": 10, "R_mm": 30, "phi_deg": [0, 45]},
    "needle_static_book": {"needles": 22, "needle_length_mm": 14, "needle_d_mm": 2.5, "cycles_per_min": 100},
    "needle_iso": {"needles": 22, "needle_length_mm": 14, "needle_d_mm": 2.5, "journal_d_mm": 16},
    "needle_hertz": {
        "journal_force_N": 9000,
        "needles": 22,
        "needle_length_mm": 14,
        "needle_d_mm": 2.5,
        "journal_d_mm": 16,
    },
    "small_oscillation": {"needles": 22, "needle_d_mm": 2.5, "journal_d_mm": 16, "alpha_deg": 5},
    "f_h": {"life_h": 640},
    "f_na": {"n_alpha_rpm_deg": 640},
    "joint_rating": C | R | {"life_h": 3000, "shock_factor": 1.1},
    "joint_life": C | R | {"torque_Nm": 500, "shock_factor": 1.1},
    "iso_life": C | R | {"torque_Nm": 500, "torque_side": "output"},
    "ball_bearing_life": {"C_N": 25700, "C0_N": 15300, "radial_force_N": 2800, "axial_force_N": 1600, "speed_rpm": 650},
    "catalogue_life": R | {"convention": "Tc", "rating_Nm": 1000, "torque_Nm": 500, "shock_factor": 1.0},
}
REGIME = R | {"torque_Nm": 500, "share_percent": 60}
CYCLE = C | {"shock_factor": 1.0, "regimes": [REGIME, REGIME | {"share_percent": 40}]}


def refused(capability, inputs):
    with pytest.raises(InputError) as caught:
        calc(capability, inputs)
    return [(problem.field, problem.code) for problem in caught.value.problems]


def below(capability, key):
    """Return the code of a value below zero: bends and shocks have ranges, some loads may be 0."""
    if key in ("alpha_deg", "shock_factor"):
        return "out_of_range"
    return "negative" if (capability, key) in LOADS else "not_positive"


LOADS = {
    ("cross_loads", "torque_Nm"),
    ("needle_hertz", "journal_force_N"),
    ("ball_bearing_life", "radial_force_N"),
    ("ball_bearing_life", "axial_force_N"),
}


@pytest.mark.parametrize("capability", CASES)
def test_every_number_is_asked_for_and_checked(capability):
    inputs = CASES[capability]
    optional = {"torque_side", "shock_factor", "method", "axial_force_N"}
    for key, value in inputs.items():
        if key not in optional:
            rest = {name: one for name, one in inputs.items() if name != key}
            assert refused(capability, rest) == [(key, "missing")]
        if isinstance(value, int | float):
            assert refused(capability, inputs | {key: math.nan}) == [(key, "not_finite")]
            assert refused(capability, inputs | {key: math.inf}) == [(key, "not_finite")]
            assert refused(capability, inputs | {key: -1}) == [(key, below(capability, key))]
        elif isinstance(value, str):
            assert refused(capability, inputs | {key: "sideways"}) == [(key, "out_of_range")]
    assert refused(capability, inputs | {"colour": 1}) == [("colour", "unknown_key")]


@pytest.mark.parametrize(
    "capability", ["joint_rating", "joint_life", "iso_life", "catalogue_life", "small_oscillation"]
)
def test_bends_reach_to_a_right_angle(capability):
    assert refused(capability, CASES[capability] | {"alpha_deg": 90}) == [("alpha_deg", "out_of_range")]
    assert calc(capability, CASES[capability] | {"alpha_deg": 89})


@pytest.mark.parametrize(
    ("regimes", "expected"),
    [
        ([], [("regimes", "empty")]),
        ([REGIME], [("regimes", "inconsistent")]),
        ([REGIME | {"share_percent": 100.02}], [("regimes", "inconsistent")]),
        ([REGIME | {"share_percent": -1}], [("regimes[0].share_percent", "negative")]),
        ([REGIME, REGIME | {"torque_Nm": -5}], [("regimes[1].torque_Nm", "negative")]),
        ([REGIME, REGIME | {"speed_rpm": 0}], [("regimes[1].speed_rpm", "not_positive")]),
        ([{**R, "torque_Nm": 5}], [("regimes[0].share_percent", "missing")]),
        ([REGIME | {"mood": 1}], [("regimes[0].mood", "unknown_key")]),
    ],
)
def test_bad_duty_cycles_are_named(regimes, expected):
    assert refused("duty_cycle_life", CYCLE | {"regimes": regimes}) == expected


def test_shares_may_miss_a_hundred_by_a_hundredth():
    for share in (40.01, 39.99):
        found = calc("duty_cycle_life", CYCLE | {"regimes": [REGIME, REGIME | {"share_percent": share}]})
        assert found["life_equivalent_h"] == pytest.approx(found["life_each_h"][0])


def test_without_torque_life_is_null():
    idle = REGIME | {"torque_Nm": 0, "share_percent": 40}
    found = calc("duty_cycle_life", CYCLE | {"regimes": [REGIME, idle]})
    assert found["life_each_h"][1] is None
    assert found["life_equivalent_h"] == pytest.approx(found["life_each_h"][0] / 0.6)
    found = calc("duty_cycle_life", CYCLE | {"regimes": [idle | {"share_percent": 100}]})
    assert (found["life_each_h"], found["life_equivalent_h"]) == ([None], None)
    assert json.dumps(found, allow_nan=False)


def test_warnings_stand_in_alphabetical_order():
    found = calc("joint_life", CASES["joint_life"] | {"alpha_deg": 1, "torque_Nm": 20})
    assert found["warnings"] == ["angle_clamped_3deg", "extrapolated"]
    assert calc("joint_rating", CASES["joint_rating"] | {"speed_rpm": 6000})["warnings"] == ["extrapolated"]
    assert calc("joint_rating", CASES["joint_rating"] | {"alpha_deg": 3})["warnings"] == []
    assert calc("f_h", {"life_h": 100})["warnings"] == calc("f_na", {"n_alpha_rpm_deg": 35000})["warnings"] == []
    assert refused("f_na", {"n_alpha_rpm_deg": 9, "method": "table"}) == [("n_alpha_rpm_deg", "out_of_range")]


def test_keys_in_other_units_mean_the_same():
    inputs = CASES["iso_life"]
    same = {"C_kN": 20, "R_m": 0.04, "torque_kNm": 0.5, "torque_side": "output", "speed_rpm": 900}
    other = calc("iso_life", same | {"alpha_rad": 6 * deg})
    assert other == {key: pytest.approx(value, rel=1e-12) for key, value in calc("iso_life", inputs).items()}
    assert calc("f_h", {"life_s": 640 * 3600})["f_h"] == pytest.approx(calc("f_h", {"life_h": 640})["f_h"])


def test_loads_of_a_cross_at_one_angle_are_numbers_and_those_of_joint_reactions():
    """Constant torque of the driven shaft: the same journal load as from the reactions of a single joint."""
    one = calc("cross_loads", CASES["cross_loads"] | {"torque_side": "output", "phi_deg": 33})
    other = calc(
        "joint_reactions",
        {
            "variant": "sliding_cross",
            "alpha_deg": 10,
            "phi1_deg": 33,
            "M2_Nm": 100,
            "d_pin_span_m": 0.06,
            "a1_bearing_span_m": 0.3,
            "c1_overhang_m": 0.1,
            "a2_bearing_span_m": 0.3,
        },
    )
    assert one["journal_force_N"] == pytest.approx(other["R_pin_inplane_N"], rel=1e-12)
    assert one["couple_input_shaft_Nm"] == pytest.approx(0.3 * other["R_bearing1_near_radial_N"], rel=1e-12)
    turn = calc(
        "cross_loads", CASES["cross_loads"] | {"alpha_deg": 60, "phi_deg": np.arange(0.0, 360.0, 0.05).tolist()}
    )
    for peak, course in (
        ("journal_force_max_N", "journal_force_N"),
        ("couple_input_max_Nm", "couple_input_shaft_Nm"),
        ("couple_output_max_Nm", "couple_output_shaft_Nm"),
    ):
        assert max(turn[course]) == pytest.approx(turn[peak], rel=1e-6)


def test_a_ball_bearing_by_the_makers_example():
    """TPI catalogue 2202/TE, p. 11: P = 3.94 kN, about 7 000 h; without axial force about 20 000 h."""
    inputs = CASES["ball_bearing_life"]
    found = calc("ball_bearing_life", inputs)
    assert found["P_N"] == pytest.approx(3940.0, rel=0.006)
    assert found["P0_N"] == pytest.approx(2800.0)
    assert found["L10h"] == pytest.approx(7000.0, rel=0.04)
    assert calc("ball_bearing_life", inputs | {"axial_force_N": 0.0})["L10h"] == pytest.approx(20000.0, rel=0.01)
    assert calc("ball_bearing_life", inputs | {"axial_force_N": 0.0, "radial_force_N": 0.0})["L10h"] is None
