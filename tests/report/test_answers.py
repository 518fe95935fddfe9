"""The answers one by one: each is the page of the report, and where there is none says which keys would give it."""

from dataclasses import replace

import pytest

from cardan.checks import check
from cardan.drive.accuracy import Error
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.fields.keys import key_of
from cardan.drive.fields.paths import place
from cardan.errors import InputError
from cardan.io import example, example_names, example_text, loads
from cardan.io.amend import amend
from cardan.io.edit import edit
from cardan.questions.gathering import principal
from cardan.register import QUESTIONS, groups
from cardan.report.answers import answered, subject
from cardan.report.content import moved, pages_of, placed
from cardan.report.subject import Subject
from cardan.report.verdict_list import Applicable, lights, sentence, settings, synchronous, with_remedies
from cardan.report.verdicts import Judged
from cardan.units import deg

SAME = {"forces", "losses", "accuracy", "life", "strength", "mobility", "assembly", "bending"}
"""Answers that are pages of the report as they stand."""


def shape(page):
    """Return all words of a page, without its pictures."""
    return (page.title, page.answer, [repr(one) for one in page.blocks if "Picture" not in type(one).__name__])


def wrong_with(drive, path):
    """Return what is wrong with a path; nothing where it leads to a value."""
    try:
        place(drive, path)
    except InputError as error:
        return str(error)
    return ""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["truck-supports", "overconstrained-pump", "propshaft-with-rzeppa", "car-propshaft"])
def test_an_answer_is_the_page_of_the_report(name):
    drive = example(name)
    on = subject(drive)
    pages = {page.name: page for page in pages_of(on, placed(on)[0], Judged())}
    for one in SAME:
        page = answered(one, on)
        if one in pages:
            assert shape(page) == shape(pages[one])
            assert page.blocks
        else:
            assert not page.blocks
            assert page.answer


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_no_answer_is_silent_and_keys_named_are_keys_of_the_file(name):
    drive = example(name)
    on = subject(drive)
    for one, asked in QUESTIONS.items():
        missing = asked.lacking(principal(asked, drive))
        if missing:
            found = answered(one, on)
            assert found.lacking == missing
            assert all(key_of(path) in found.answer for some in missing for path in some)
        for path in (path for some in missing for path in some):
            # It may be a table, or one that the file has none of, but it is known.
            assert "no such field" not in wrong_with(drive, key_of(path))


@pytest.mark.parametrize(("name", "given"), [("strength", {"torque": 10.0}), ("check", {})])
def test_a_page_that_tells_nothing_carries_the_keys_that_let_it_tell_something(name, given):
    even = replace(Drive.from_angles([2 * deg, 2 * deg]), duty=Duty(**given))
    found = answered(name, subject(even))
    assert not found.blocks
    assert 1 <= len(found.lacking) <= 12
    assert all(key_of(path) in found.answer for some in found.lacking for path in some)


def test_giving_the_keys_that_are_missing_gives_the_answer():
    bare = Drive.from_angles([20 * deg, 20 * deg])
    assert "duty.torque_Nm" in answered("forces", subject(bare)).answer
    loaded = replace(bare, duty=Duty(torque=100.0, speed=100.0))
    assert "supports" in answered("forces", subject(loaded)).answer
    assert "duty.torque_Nm" not in answered("forces", subject(loaded)).answer
    assert answered("selection", subject(loaded)).blocks
    assert "duty.torque_Nm" in answered("selection", subject(bare)).answer
    rubbing = replace(loaded, joints=tuple(replace(joint, friction=0.01) for joint in loaded.joints))
    assert "friction" in answered("losses", subject(loaded)).answer
    assert "needs more" not in answered("losses", subject(rubbing)).answer


def test_why_there_is_nothing_although_no_key_is_missing():
    pump = example("overconstrained-pump")
    none = replace(pump, joints=(replace(pump.joints[0], error=Error()),))
    assert answered("accuracy", subject(none)).answer == "The errors given do nothing to the output."


def test_groups_hold_every_answer_once():
    assert sorted(name for names in groups().values() for name in names) == sorted(QUESTIONS)


def test_the_page_of_the_motion_asks_nothing_about_the_yokes(monkeypatch):
    def never(*_args, **_kwargs):
        raise AssertionError("asked")

    monkeypatch.setattr(QUESTIONS["phasing"].home, "ask", never)
    monkeypatch.setattr(QUESTIONS["articulation"].home, "ask", never)
    assert moved(subject(example("truck-power-unit"))).blocks
    assert answered("motion", Subject(drive=example("truck-power-unit"))).blocks


def test_a_joint_may_be_chosen_by_its_number():
    on = subject(example("truck-supports"))
    whole, third = answered("selection", on), answered("selection", on, None, {"joint": 3})
    assert whole.blocks[0].title == third.blocks[0].title
    assert whole.answer != third.answer
    assert "no joint 9" in answered("selection", on, None, {"joint": 9}).blocks[0].text


def test_a_setting_applied_makes_the_drive_even():
    text = example_text("truck-power-unit")
    best = synchronous(subject(loads(text)))
    assert isinstance(best, Applicable)
    after = subject(loads(edit(text, best.values)))
    assert after.even
    assert synchronous(after) == "The yokes stand right: the drive is synchronous."
    assert all(one.values == {} for one in settings(after) if one.label == best.label)


def test_why_a_drive_cannot_be_made_even():
    assert "The angle of joint 2 is too large" in synchronous(
        Subject(drive=Drive.from_angles([10 * deg, 30 * deg, 20 * deg]))
    )
    assert synchronous(subject(example("single-20deg"))) == "A single joint has no second one to undo it."


@pytest.mark.slow
@pytest.mark.parametrize("name", ["truck-duty-cycle", "truck-power-unit"])
def test_every_cure_cures_when_it_is_written_into_the_file(name):
    text = example_text(name)
    shown = with_remedies(subject(loads(text)))
    tried = 0
    for one in shown:
        for remedy in one.remedies[:1]:
            after = {other.name: other for other in lights(subject(loads(edit(text, remedy.values))))}
            assert one.name not in after or after[one.name].tone != "failed"
            tried += 1
    assert tried


@pytest.mark.slow
def test_lights_tell_what_check_tells():
    drive = example("truck-rear-axle")
    shown = lights(subject(drive))
    failed = {one.title for one in check(drive) if one.run and not one.advice and one.state == "failed"}
    assert sum(one.tone == "failed" for one in shown) <= len(failed)
    assert {one.title for one in shown if one.tone == "failed"} <= {
        *failed,
        *(one.title for one in shown if "(and" in one.title),
    }
    assert [one.advice for one in shown] == sorted(one.advice for one in shown)
    assert "failed" in sentence(shown)


def test_a_run_up_without_a_course_of_the_speed_names_the_key():
    assert "duty.run_up" in answered("run-up", subject(example("truck-power-unit"))).answer


def test_making_it_synchronous_keeps_to_the_teeth_of_the_splines():
    text = example_text("two-piece-rear-drive")  # 24 teeth on shaft 3: multiples of 15°; shaft 2 has none
    best = synchronous(subject(loads(text)))
    assert best.values["shafts[2].yoke_angle_deg"] == pytest.approx(15.0)
    assert best.effect == "leaves 0.0597 %, the best that exists on these splines"
    after = subject(loads(edit(text, best.values)))
    assert after.fluctuation == pytest.approx(5.969e-4, rel=1e-3)  # as the row of the table of settings says
    assert "do not exist on these splines" in synchronous(after)
    bare = amend(text, {"shafts[2].spline": None})
    assert subject(loads(edit(bare, synchronous(subject(loads(bare))).values))).even
