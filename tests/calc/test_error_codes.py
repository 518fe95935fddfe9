"""One word for what is wrong with an input, from the general machinery."""

import math

import pytest

from cardan import InputError, calc
from cardan.errors import CODES

GOOD = {"alpha_deg": 20, "mu_pin_reduced": 0.05, "pin_diameter_m": 0.02, "pin_span_m": 0.08}


@pytest.mark.parametrize(
    ("changed", "field", "code"),
    [
        ({"pin_span_m": None}, "pin_span_m", "missing"),
        ({"pin_span_m": math.nan}, "pin_span_m", "not_finite"),
        ({"pin_span_m": 10**400}, "pin_span_m", "not_finite"),
        ({"pin_span_m": 0}, "pin_span_m", "not_positive"),
        ({"mu_pin_reduced": -0.1}, "mu_pin_reduced", "negative"),
        ({"alpha_deg": -1}, "alpha_deg", "out_of_range"),
        ({"alpha_deg": 90}, "alpha_deg", "out_of_range"),
        ({"constant_torque": "middle"}, "constant_torque", "out_of_range"),
        ({"colour": 1}, "colour", "unknown_key"),
        ({"pin_span_mm": 80}, "pin_span_mm", "inconsistent"),
    ],
)
def test_a_bad_input_has_its_code(changed, field, code):
    with pytest.raises(InputError) as caught:
        calc("efficiency_joint", GOOD | changed)
    (problem,) = caught.value.problems
    assert (problem.field, problem.code) == (field, code)
    assert code in CODES


def test_a_key_left_out_is_missing():
    with pytest.raises(InputError) as caught:
        calc("efficiency_joint", {"alpha_deg": 20})
    assert {problem.code for problem in caught.value.problems} == {"missing"}
