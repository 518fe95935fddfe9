"""A mechanism file is swept as a drive file is: against closed forms, refused where a drive alone answers."""

from pathlib import Path

import numpy as np
import pytest

from cardan import InputError
from cardan.batch.answering.asking import evaluator
from cardan.batch.answering.questions import questions
from cardan.batch.sweep import work_of
from cardan.io import example_mechanism
from cardan.io.plan_file import plan_of, read_plan

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.mark.slow
def test_a_crank_slider_goes_over_twice_its_crank_whatever_its_rod():
    made = example_mechanism("crank-slider")
    ask = evaluator(made, ["joints[1].point_mm[0]", "joints[2].point_mm[0]"], ["motion", "mobility"])
    rows = ask(np.asarray([[30.0, 200.0], [30.0, 150.0], [0.0, 200.0]]))
    assert rows["travel_mm"] == pytest.approx([100.0, 100.0, 80.0], rel=1e-4)  # between degrees of the crank
    assert rows["redundant_constraints"].tolist() == [3.0, 3.0, 3.0]
    assert np.all(np.isnan(rows["ratio_min"]))


@pytest.mark.slow
def test_the_readings_of_a_differentiator_are_its_ratio():
    work = read_plan(EXAMPLES / "sweeps" / "differentiator.toml").work()
    rows = work.evaluate(0, 2)
    place = rows["joints[2].point_mm[0]"]
    assert rows["ratio_min"] == pytest.approx(place / 20.0, abs=1e-12)  # Litvin (7.7)
    assert rows["ratio_max"] == pytest.approx(place / 20.0, abs=1e-12)
    assert rows["input_torque_Nm"] == pytest.approx(0.02 * place / 20.0, rel=1e-9)
    assert rows["joint_force_N"] == pytest.approx(1.0, rel=1e-9)
    assert work.provenance["drive"]["name"] == "disc differentiator"


def test_a_cylinder_is_told_by_its_path():
    ask = evaluator(example_mechanism("boom-cylinder"), ["joints[1].point_mm[2]"], ["motion", "forces"])
    assert [one.name for one in ask.answers][:2] == ["ratio_min_deg_per_mm", "ratio_max_deg_per_mm"]
    assert "input_force_N" in [one.name for one in ask.answers]
    rows = ask(np.asarray([[-600.0]]))
    angle = np.arccos((0.8**2 + 0.6**2 - np.asarray([1.0, 1.3]) ** 2) / (2 * 0.8 * 0.6))
    first = np.asarray([1.0, 1.3]) / (0.8 * 0.6 * np.sin(angle))
    assert -rows["ratio_max_deg_per_mm"][0] == pytest.approx(np.degrees(first[0]) / 1e3, rel=1e-9)
    assert -rows["ratio_min_deg_per_mm"][0] == pytest.approx(np.degrees(first[1]) / 1e3, rel=1e-9)
    assert rows["turn_deg"][0] == pytest.approx(np.degrees(angle[1] - angle[0]), rel=1e-9)
    assert 90.0 < rows["efficiency_percent"][0] < 100.0


def test_a_point_that_does_not_turn_says_so():
    ask = evaluator(example_mechanism("boom-cylinder"), ["joints[1].point_mm[2]"], ["motion"])
    answers, status, problems = ask.at({"joints[1].point_mm[2]": -350.0})
    assert (answers, status) == ({}, 2)
    assert "cannot follow" in problems[0].message


def test_questions_of_mechanisms_are_those_that_have_columns():
    assert sorted(questions(mechanism=True)) == ["forces", "mobility", "motion"]
    made = example_mechanism("crank-slider")
    with pytest.raises(InputError, match="unknown question 'life'; the questions are"):
        work_of(made, {"joints[3].friction": [0.1]}, ["life"])
    with pytest.raises(InputError, match="there is no such field"):
        work_of(made, {"joints[3].frictional": [0.1]}, ["motion"])


def test_a_plan_names_what_it_cannot_ask_of_a_mechanism():
    text = 'format = 1\ndrive = "crank-slider.toml"\nask = ["life"]\n[[vary]]\nkey = "speed_rpm"\nvalues = [1]\n'
    with pytest.raises(InputError) as caught:
        plan_of(text, folder=EXAMPLES / "mechanisms")
    assert [one.field for one in caught.value.problems] == ["ask"]
