"""Diagnosis by keys: what it takes in any form, what it tells, and what it refuses under which key."""

from __future__ import annotations

import math

import pytest

from cardan.calc import calc
from cardan.catalogue import catalogue
from cardan.catalogue.rows import Fault
from cardan.errors import InputError


def first(**signs):
    return calc("diagnose", signs)["first_causes"]


def test_the_short_form_of_the_table_is_found_again() -> None:
    assert first(order=1, torque_sensitive=True) == ["F03", "F13", "F20", "F21"]  # equal points: by id
    assert first(order=2, resonance_at_half_critical=True)[0] == "F12"
    assert first(order=[1, 2, 3], transient_at_critical=True)[0] == "F15"
    assert first(order=1, at_critical=True)[0] == "F14"
    assert first(wheel_order=True)[0] == "F41"
    assert first(symptom="grease_leak")[:2] == ["F30", "F31"]
    assert first(symptom="howl")[0] == "F23"


def test_speed_is_told_but_does_not_rank() -> None:
    assert first(order=1) == first(order=1, speed_dependent=True) == first(order=[1], speed_dependent=False)


def test_each_cause_says_what_it_is_and_how_to_make_sure() -> None:
    found = calc("diagnose", {"symptom": "vibration_at_standstill"})
    rows = catalogue().rows(Fault)
    assert found["scores"][0] == 3
    for rank, name in enumerate(found["first_causes"], 1):
        assert found[f"cause_{rank}"] == rows[name].fault
        assert found[f"inspection_{rank}"] == rows[name].inspection


@pytest.mark.parametrize(
    ("signs", "field", "code"),
    [
        ({}, "order", "missing"),
        ({"speed_dependent": True}, "order", "missing"),
        ({"order": []}, "order", "empty"),
        ({"order": 0.0}, "order", "not_positive"),
        ({"order": math.nan}, "order", "not_finite"),
        ({"order": [1.0, math.inf]}, "order[1]", "not_finite"),
        ({"order": 1.0, "symptom": "howling"}, "symptom", "out_of_range"),
        ({"order": 1.0, "critical": True}, "critical", "unknown_key"),
    ],
)
def test_a_bad_sign_is_refused_under_its_key(signs, field, code) -> None:
    with pytest.raises(InputError) as caught:
        calc("diagnose", signs)
    assert [(problem.field, problem.code) for problem in caught.value.problems] == [(field, code)]


def test_everything_wrong_is_told_at_once() -> None:
    with pytest.raises(InputError) as caught:
        calc("diagnose", {"order": [1.0, -2.0], "symptom": "howling", "at_critical": 3})
    assert [problem.field for problem in caught.value.problems] == ["order[1]", "symptom", "at_critical"]
