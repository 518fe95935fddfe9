"""What is said of a run-up: only where the duty has one, with the numbers of the simulation."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, example
from cardan.answers.answer import Answer, Table
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, significant
from cardan.drive.machine import Engine, RunUp
from cardan.questions.torsion.transient.run_up_answer import answer, ask, lacking, otherwise
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.questions.torsion.transient.transient import Adaptive
from cardan.units import rpm

RINGED = example("pto-flywheel-absorber")


def of(drive: Drive) -> Answer:
    found = ask(drive)
    assert found is not None
    return answer(drive, found)


def column(table: Table, key: str) -> list[float]:
    return list(next(one for one in table.columns if one.key == key).values)


@pytest.mark.slow
def test_the_numbers_are_those_of_the_simulation() -> None:
    """Followed here in fixed steps, there with steps held to their error."""
    said, found = of(RINGED), transient(RINGED, method=Adaptive(rtol=1e-7, atol=1e-8))
    ends = found.motion.extremes
    torques = said.tables[0]
    np.testing.assert_allclose(column(torques, "max"), ends.torque_high, rtol=1e-4)
    np.testing.assert_allclose(column(torques, "min"), ends.torque_low, rtol=1e-4)
    peak, time = float(ends.torque_high[0]), float(ends.torque_high_time[0])
    assert RINGED.duty.run_up is not None
    speed = time / RINGED.duty.run_up.duration * RINGED.duty.run_up.end
    reached = f"reaches {significant(peak)} N·m at {significant(speed / rpm, 3)} rpm"
    assert reached in told(said.sentence, USUAL)
    assert said.keys[0].value.value == pytest.approx(peak, rel=1e-5)
    assert [one.name for one in said.figures()] == ["torsion-transient"]
    assert not [one for one in said.remarks if one.alarm or one.tone == "warning"]


@pytest.mark.slow
def test_play_strikes() -> None:
    """Contacts fall within the steps: the peak holds to some 1e-3."""
    said = of(example("pto-flywheel"))
    assert [one.tone for one in said.remarks if one.alarm] == ["warning"]
    assert said.keys[0].value.value == pytest.approx(2590.11, rel=1e-3)  # of `transient`, held to 1e-10


@pytest.mark.slow
def test_resonances_are_told_in_the_order_they_are_passed() -> None:
    for course in (RunUp(start=60.0, end=10.0, duration=0.5), RunUp(start=-60.0, end=12.0, duration=0.5)):
        drive = replace(RINGED, duty=replace(RINGED.duty, run_up=course))
        passed = of(drive).tables[-1]
        rows = np.stack([column(passed, "time"), column(passed, "speed")], axis=-1)
        assert np.all(np.diff(rows[:, 0]) > 0.0)
        np.testing.assert_allclose(
            course.start + (course.end - course.start) * rows[:, 0] / course.duration, rows[:, 1]
        )
        assert len(rows) == 4  # orders 2 and 4 of the joints on both modes


def test_what_would_take_long_is_left_to_the_command() -> None:
    endless = replace(RINGED, duty=replace(RINGED.duty, run_up=RunUp(end=400.0, duration=1e6)))
    said = of(endless)
    assert "cardan torsion simulate" in told(said.sentence, USUAL)
    assert [one.name for one in said.tables] == ["resonances"]


def test_it_is_not_asked_without_a_run_up_or_a_line_nor_told_where_torques_make_the_speed() -> None:
    duty = RINGED.duty
    assert lacking(replace(RINGED, duty=replace(duty, run_up=None))) == (("duty.run_up",),)
    assert lacking(replace(example("z-arrangement"), duty=duty))
    freely = replace(RINGED, duty=replace(duty, engine=Engine(mean_torque=300.0)))
    assert not lacking(freely)
    assert ask(freely) is None
    assert "freely" in otherwise(freely)
