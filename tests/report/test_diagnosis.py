"""The page of a diagnosis: the ranking of the library, in words that never say more than it knows."""

from dataclasses import replace

import pytest

from cardan.io import example
from cardan.questions.diagnosis.examination import examine
from cardan.questions.diagnosis.findings import diagnose
from cardan.questions.diagnosis.match import Signs
from cardan.questions.diagnosis.simulate import Runs, simulate_fault
from cardan.report.content import Excerpt
from cardan.report.diagnosis import by_torque, diagnosed, diagnosed_by_signs, grows
from cardan.report.renderer import RENDERERS

SHORT = Runs(run_up=5.0, hold=2.0, rate=1024.0)


@pytest.fixture(scope="module")
def found():
    drive = example("truck-supports")
    return examine(simulate_fault(drive, "worn_joint", seed=2, runs=SHORT), drive)


def titles(page):
    return [block.title for block in page.blocks if getattr(block, "title", "")]


def table(page, title):
    return next(block for block in page.blocks if getattr(block, "title", "").startswith(title))


@pytest.mark.slow
def test_the_ranking_is_that_of_the_library(found):
    page = diagnosed(found)
    rows = table(page, "Causes").rows
    assert [row[1].text for row in rows] == [one.fault for one in found.findings[: len(rows)]]
    assert [float(row[2].full) for row in rows] == [100.0 * one.score for one in found.findings[: len(rows)]]
    assert rows[0][3].text == found.findings[0].check
    assert rows[0][4].text == found.findings[0].repair
    first = found.findings[0]
    assert list(table(page, f"What speaks for: {first.fault}").items) == list(first.evidence)
    assert first.cause == "F20"
    assert page.answer == f"Likely: {first.fault} ({100 * first.score:.0f} %)."


def test_its_pictures_are_the_orders_behind_it(found):
    names = [block.figure.name for block in diagnosed(found).blocks if hasattr(block, "figure")]
    assert names == ["causes", "order-map", "order-spectrum", "tracked-orders", "rotation"]


def test_every_channel_is_listed_and_one_tells_the_speed(found):
    rows = table(diagnosed(found), "Channels").rows
    assert [row[0].text for row in rows] == [one.name for one in found.signal.channels]
    assert [row[0].text for row in rows if row[-1].text] == ["tacho"]


def test_a_poor_recording_is_said_to_be_one(found):
    poor = tuple(replace(one, confidence=0.3, cautions=("front: clipped.",)) for one in found.findings)
    page = diagnosed(replace(found, findings=poor))
    assert [one.tone for one in page.alarms] == ["warning"]
    assert "30 %" in page.alarms[0].text
    assert page.answer.endswith("(with a confidence of only 30 %).")
    assert list(table(page, "To mind").items) == ["front: clipped."]
    assert table(page, "Causes").rows[0][1].tone == "warning"


def test_what_should_show_is_the_model_at_the_sensor(found):
    rows = table(diagnosed(found), "What the likeliest").rows
    assert [row[0].text for row in rows] == ["1", "2", "4"]
    top, full = found.expected.speed[1], found.expected.reference
    lines = [one for one in found.expected.orders if one.place == found.channel.place and one.direction == "radial"]
    two = sum(abs(found.expected.value(one, top, full)) ** 2 for one in lines if one.order == 2.0) ** 0.5
    assert float(rows[1][1].full) == pytest.approx(float(two))


def test_signs_alone_rank_with_little_confidence():
    page = diagnosed_by_signs(diagnose(Signs(orders=(2.0,), torque_sensitive=True)))
    assert page.answer.startswith("No cause stands out")
    assert page.alarms
    assert "Channels of the recording" not in titles(page)


def test_the_words_for_speed_and_torque():
    assert [grows(power, amplified=False) for power in (0.0, 1.0, 1.5)] == [
        "stays the same",
        "in proportion",
        "power 1.5",
    ]
    shares = (1.0, 0.3, -0.6), (0.4, 0.0, 0.6), (1.0, 0.0, -0.8)
    assert [by_torque(share) for share in shares] == ["changes with its sense", "grows", "falls"]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".html", ".pdf", ".xlsx"])
def test_every_form_of_report_holds_it(found, suffix):
    made = RENDERERS[suffix].excerpt(Excerpt(title=found.drive.name, page=diagnosed(found)))
    assert len(made) > 10_000
    if suffix == ".html":
        assert found.findings[0].check in made.decode()
