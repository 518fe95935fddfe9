"""What is said of the checks of a drive: each verdict once, for any reader, with the remedies of what fails."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.quantity import Written, told
from cardan.answers.reader import USUAL, Reader
from cardan.checks import check
from cardan.choices.check_answer import COLUMNS, answer, ask, checked, lacking, otherwise, urgent
from cardan.drive.drive import Drive
from cardan.io import example
from cardan.texts import speaking

POUNDS = Reader(units={"torque": "lbft", "stress": "psi", "angle": "rad"}, decimal=",")


def table(said, title):
    return next(one for one in said.tables if one.title.startswith(title))


@pytest.mark.slow
def test_what_failed_stands_first_and_what_is_closest_where_nothing_did():
    failing, passing = (answer(drive, ask(drive)) for drive in map(example, ("truck-duty-cycle", "car-propshaft")))
    text = told(failing.sentence, USUAL)
    assert text == "3 of 43 checks failed; worst: life of the bearings of joint 3 (axle), at 135 % of its limit."
    assert (failing.code, failing.tone, passing.code) == (1, "failed", 0)
    assert told(passing.sentence, USUAL).startswith("all ")
    assert "by unconfirmed ratings; closest: " in told(passing.sentence, USUAL)


@pytest.mark.slow
def test_every_verdict_is_told_in_the_units_of_the_reader():
    drive = example("car-propshaft")
    usual, pounds = (data(answer(drive, ask(drive)), who)["verdicts"] for who in (USUAL, POUNDS))
    found = [one for one in check(drive) if one.check != "answers_agree"]
    assert [row["title"] for row in pounds] == [one.title for one in found]
    for row, one, before in zip(pounds, found, usual, strict=True):
        assert before["unit"] == one.unit
        assert row["unit"] == {"Nm": "lbft", "MPa": "psi", "deg": "rad"}.get(one.unit, one.unit)
        if one.run and one.dimension == "angle":
            assert row["value"] == pytest.approx(float(one.value))
    shown = printed(answer(drive, ask(drive)).tables[0], POUNDS)
    assert any(cell.text.endswith(" lbf·ft") for row in shown.rows for cell in row)
    assert not any("N·m" in cell.text for row in shown.rows for cell in row)


@pytest.mark.slow
def test_a_band_has_both_its_ends_for_programs():
    drive = example("two-piece-rubber-bearing")
    rows = data(answer(drive, checked(drive)), USUAL)["verdicts"]
    assert any(isinstance(row["limit"], list) and row["limit"][0] < row["limit"][1] for row in rows)


@pytest.mark.slow
def test_each_change_stands_once_and_those_that_help_most_first():
    drive = example("truck-duty-cycle")
    result = ask(drive)
    keys, *_more = table(answer(drive, result), "Corrective changes").columns
    to = next(one for one in _more if one.heading == "to")
    assert keys.values[0] == Written("joints[2].centre_mm[2]", "joint 3: centre, z", "Joint 3 · centre_mm z")
    changes = list(zip(keys.values, to.values, strict=True))
    assert len(set(changes)) == len(changes)
    assert len(data(answer(drive, result), USUAL)["remedies"]) == len(result.remedies)


@pytest.mark.slow
def test_keys_that_checks_need_stand_behind_an_option():
    drive = example("car-propshaft")
    brief, whole = (table(answer(drive, ask(drive), missing=one), "Checks not run") for one in (False, True))
    assert (brief.depth, whole.depth) == ("full", "brief")


@pytest.mark.slow
def test_a_limit_of_nothing_is_told_as_beyond_a_thousand_times():
    drive = example("truck-duty-cycle")
    shaft = replace(drive.shafts[2], spline=replace(drive.shafts[2].spline, engaged=1e-9))
    spent = replace(drive, shafts=(*drive.shafts[:2], shaft, *drive.shafts[3:]))
    assert "> 100\u202f000 %" in told(answer(spent, ask(spent)).sentence, USUAL)


@pytest.mark.slow
def test_the_first_page_has_what_fails_and_is_close():
    result = ask(example("truck-duty-cycle"))
    keys, left = urgent(result)
    assert [one.tone for one in keys[:4]] == ["failed", "failed", "failed", "warning"]
    assert left > 0
    assert keys[0].utilisation == pytest.approx(float(result.binding[0].utilisation))


def test_verdicts_speak_the_language_of_the_reader():
    with speaking("ru"):
        titles = [one.title for one in check(example("car-propshaft"), only=["tube_strength"])]
    assert titles == ["напряжение вала 2 (tube)"]


def test_a_drive_of_which_nothing_is_said_tells_what_it_lacks():
    bare = Drive.from_angles([0.1])
    assert lacking(bare) == ()
    assert ask(bare) is None
    assert ("duty.speed",) in otherwise(bare)


@pytest.mark.slow
def test_a_sweep_tells_how_many_verdicts_rest_on_unconfirmed_ratings():
    sure, unsure = example("two-piece-rear-drive"), example("pickup-two-piece")
    (asked,) = COLUMNS
    verdicts = [one for one in check(unsure) if one.run and not one.advice and one.check != "audit"]
    used, failed, loose = asked.of_one(unsure)
    assert used == max(float(np.max(one.utilisation)) for one in verdicts)
    assert (failed, loose) == (0.0, sum(one.state == "unconfirmed" for one in verdicts))
    assert loose > 0.0
    assert asked.of_one(sure)[2] == sum(not one.sure for one in check(sure) if one.run and not one.advice)
