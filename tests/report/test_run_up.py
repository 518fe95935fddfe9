"""The report's page of a run-up: present where the duty has one, with the numbers of the simulation."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from cardan import Drive, example
from cardan.drive.machine import Engine, RunUp
from cardan.figures.wording import significant
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.questions.torsion.transient.transient import Adaptive
from cardan.report.block import Page, Picture, Table
from cardan.report.run_up import running_up
from cardan.units import rpm

RINGED = example("pto-flywheel-absorber")


def page(drive: Drive) -> Page | None:
    return running_up(SimpleNamespace(drive=drive))  # type: ignore[arg-type]


def tables(shown: Page) -> dict[str, Table]:
    return {block.title: block for block in shown.blocks if isinstance(block, Table)}


@pytest.mark.slow
def test_the_numbers_are_those_of_the_simulation() -> None:
    """Followed here in fixed steps, there with steps held to their error."""
    shown, found = page(RINGED), transient(RINGED, method=Adaptive(rtol=1e-7, atol=1e-8))
    assert shown is not None
    ends = found.motion.extremes
    torques = tables(shown)["Torques while running up"]
    for row, high, low in zip(torques.rows, ends.torque_high, ends.torque_low, strict=True):
        assert (row[1].text, row[4].text) == (significant(float(high)), significant(float(low)))
    peak, time = float(ends.torque_high[0]), float(ends.torque_high_time[0])
    speed = time / RINGED.duty.run_up.duration * RINGED.duty.run_up.end
    assert f"reaches {significant(peak)} N·m, at {significant(speed / rpm, 3)} rpm" in shown.answer
    assert float(shown.keys[0][1].full) == pytest.approx(peak, rel=1e-5)
    assert [block.figure.name for block in shown.blocks if isinstance(block, Picture)] == ["torsion-transient"]
    assert tables(shown)["Checks"].rows[0][-1].tone == "good"
    assert not shown.alarms


def test_play_strikes() -> None:
    """Contacts fall within the steps: the peak holds to some 1e-3."""
    drive = example("pto-flywheel")
    shown = page(drive)
    assert shown is not None
    assert [alarm.tone for alarm in shown.alarms] == ["warning"]
    assert float(shown.keys[0][1].full) == pytest.approx(2590.11, rel=1e-3)  # of `transient`, held to 1e-10


def test_resonances_are_told_in_the_order_they_are_passed() -> None:
    for course in (RunUp(start=60.0, end=10.0, duration=0.5), RunUp(start=-60.0, end=12.0, duration=0.5)):
        drive = replace(RINGED, duty=replace(RINGED.duty, run_up=course))
        shown = page(drive)
        assert shown is not None
        rows = np.asarray(
            [[float(cell.full) for cell in row[:2]] for row in tables(shown)["Resonances on the way"].rows]
        )
        assert np.all(np.diff(rows[:, 0]) > 0.0)
        np.testing.assert_allclose(
            course.start + (course.end - course.start) * rows[:, 0] / course.duration, rows[:, 1] * rpm
        )
        assert len(rows) == 4  # orders 2 and 4 of the joints on both modes


def test_what_would_take_long_is_left_to_the_command() -> None:
    endless = replace(RINGED, duty=replace(RINGED.duty, run_up=RunUp(end=400.0, duration=1e6)))
    shown = page(endless)
    assert shown is not None
    assert "cardan torsion simulate" in shown.answer
    assert list(tables(shown)) == ["Resonances on the way"]


def test_there_is_no_page_without_a_run_up_or_a_line_or_where_torques_make_the_speed() -> None:
    duty = RINGED.duty
    assert page(replace(RINGED, duty=replace(duty, run_up=None))) is None
    assert page(replace(example("z-arrangement"), duty=duty)) is None
    assert page(replace(RINGED, duty=replace(duty, engine=Engine(mean_torque=300.0)))) is None
