"""The life page of the report: there where a duty asks for lives, with the numbers of the analysis."""

from dataclasses import replace

import pytest

from cardan.drive.duty import History
from cardan.figures.wording import fixed, significant
from cardan.io import example
from cardan.questions.life.life import life
from cardan.report.life import lasting
from cardan.report.subject import asked

HOUR = 3600.0


def of(drive):
    return lasting(asked(drive, None, None))


def table(made, title):
    return next(block for block in made.blocks if getattr(block, "title", "") == title)


def test_a_life_too_short_stands_first_with_what_would_do():
    drive = example("truck-duty-cycle")
    made, found = of(drive), life(drive)
    (row,) = made.keys
    assert [one.text for one in row[:2]] == [
        "life of joint 3, the first to fail",
        significant(found.drive / HOUR),
    ]
    assert (row[3].text, row[4].text, row[5].tone) == ("≥ 8\u202f000", fixed(8000 * HOUR / found.drive), "failed")
    assert [one.tone for one in made.alarms] == ["failed"]
    assert made.answer.startswith("Joint 3 fails after")


def test_the_tables_are_those_of_the_analysis():
    drive = example("truck-duty-cycle")
    made, found = of(drive), life(drive)
    for i, row in enumerate(table(made, "Joints").rows):
        shown = [float(one.full) for one in row[6:]]
        assert shown == pytest.approx([found.of(name)[i] / HOUR for name in ("iso", "simple", "maker", "book")])
    rows = table(made, "Parts of the duty cycle").rows
    for joint in range(3):
        assert sum(float(row[3 + joint].full) for row in rows) == pytest.approx(100.0)
    assert any("wears its own patch" in one for one in table(made, "To mind").items)


def test_a_measured_torque_has_its_figure():
    drive = example("car-propshaft")
    measured = History(file="run.csv", times=(0.0, 5.0, 30.0, 40.0), torques=(100.0, 500.0, 200.0, 100.0))
    made = of(replace(drive, duty=replace(drive.duty, blocks=(), torque=None, torque_history=measured)))
    assert [block.figure.name for block in made.blocks if hasattr(block, "figure")] == ["life", "life-history"]


@pytest.mark.parametrize("change", ["no bearings", "no life asked for", "no duty"])
def test_there_is_no_page_without_a_life_to_tell(change):
    drive = example("mill-spindle")
    if change == "no bearings":
        drive = replace(drive, joints=tuple(replace(one, needles=None, rating=None, size="") for one in drive.joints))
    elif change == "no life asked for":
        drive = replace(drive, duty=replace(drive.duty, life=None))
    else:
        drive = replace(drive, duty=replace(drive.duty, torque=None))
    assert of(drive) is None


def test_the_dynamic_capacity_that_is_meant_stands_there():
    drive = example("truck-duty-cycle")
    found = life(drive)
    heavy = next(one.message for one in found.cautions if one.code == "heavy_load")
    assert "over half of their dynamic capacity of 63\u202f000 N" in heavy
    joints = table(of(drive), "Joints")
    at = [column.heading for column in joints.columns].index("dynamic capacity")
    assert [row[at].full for row in joints.rows] == [repr(float(one)) for one in found.bearings.capacity]
