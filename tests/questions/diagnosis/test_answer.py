"""What is said of a recording: the ranking of the library, in words that never say more than it knows."""

from dataclasses import replace

import pytest

from cardan.answers.data import data
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.io import example
from cardan.questions.diagnosis.answer import answer, answer_of_signs
from cardan.questions.diagnosis.examination import examine
from cardan.questions.diagnosis.expected import expected_orders
from cardan.questions.diagnosis.fault_answer import answer as answer_of_fault
from cardan.questions.diagnosis.fault_answer import by_torque, grows
from cardan.questions.diagnosis.findings import diagnose
from cardan.questions.diagnosis.match import Signs
from cardan.questions.diagnosis.simulate import TestSchedule, simulate_fault
from cardan.report.block import page as page_of
from cardan.report.content import Excerpt
from cardan.report.render.renderer import RENDERERS

SHORT = TestSchedule(run_up=5.0, hold=2.0, rate=1024.0)


@pytest.fixture(scope="module")
def found():
    drive = example("truck-supports")
    return examine(simulate_fault(drive, "worn_joint", seed=2, runs=SHORT), drive)


def diagnosed(found):
    return page_of(answer(found), USUAL)


def titles(page):
    return [block.title for block in page.blocks if getattr(block, "title", "")]


def table(page, title):
    return next(block for block in page.blocks if getattr(block, "title", "").startswith(title))


@pytest.mark.slow
def test_the_ranking_is_that_of_the_library(found):
    page = diagnosed(found)
    rows = table(page, "Causes").rows
    assert [row[1].text for row in rows] == [one.fault for one in found.findings[: len(rows)]]
    shares = [100.0 * one.score for one in found.findings[: len(rows)]]
    assert [float(row[0].full) for row in rows] == pytest.approx(shares)
    assert rows[0][2].text == found.findings[0].check
    assert rows[0][3].text == found.findings[0].repair
    first = found.findings[0]
    said = [row[1].text for row in table(page, f"What speaks for and against: {first.fault}").rows]
    assert said == [told(one, USUAL) for one in (*first.evidence, *first.against)]
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
    assert page.answer.endswith("The confidence is only 30 %.")
    assert table(page, "To mind").items[-1] == "front: clipped."
    assert table(page, "Causes").rows[0][1].tone == "warning"


def test_what_should_show_is_the_model_at_the_sensor(found):
    rows = table(diagnosed(found), "What the likeliest").rows
    assert [row[0].text for row in rows] == ["1", "2", "4"]
    top, full = found.expected.speed[1], found.expected.reference
    lines = [one for one in found.expected.orders if one.place == found.channel.place and one.direction == "radial"]
    two = sum(abs(found.expected.value(one, top, full)) ** 2 for one in lines if one.order == 2.0) ** 0.5
    assert float(rows[1][1].full) == pytest.approx(float(two))


def test_signs_alone_rank_with_little_confidence():
    signs = Signs(orders=(2.0,), torque_sensitive=True)
    page = page_of(answer_of_signs(signs, diagnose(signs)), USUAL)
    assert page.answer.startswith("No cause stands out")
    assert page.alarms
    assert "Channels of the recording" not in titles(page)


def test_readers_are_told_in_their_units(found):
    reader = Reader(units={"angular_speed": "rad_s", "acceleration": "mm_s2"}, decimal=",")
    said = answer(found)
    turned = next(told(one.text, reader) for one in said.remarks if "turns from" in told(one.text, reader))
    assert "rad/s" in turned
    peak = data(said, reader)["orders"][0]["peaks"][0]
    assert peak["amplitude_mm_s2"] == pytest.approx(1e3 * found.spectra[0].peaks()[0][1])


def test_what_a_fault_should_show_is_told_in_the_units_of_the_reader():
    expected = expected_orders(example("truck-supports"), "unbalance")
    said = answer_of_fault(expected)
    assert told(said.sentence, USUAL).startswith("unbalance of a shaft: at 1\u202f800 rpm order 2 is the largest")
    reader = Reader(units={"angular_speed": "rad_s"})
    assert data(said, reader)["speed_range_rad_s"] == list(expected.speed)
    assert "fluctuates by ±" in " ".join(told(one.text, reader) for one in said.remarks)


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
