"""The limits in the report: traffic lights and the changes that help most first, then every verdict."""

import re
from dataclasses import replace

import pytest

from cardan.catalogue import catalogue, with_files
from cardan.checks import check
from cardan.io import example
from cardan.report.block import Page, Words
from cardan.report.report import page
from cardan.report.subject import asked
from cardan.report.summary import evenness, judgement, warnings
from cardan.report.verdicts import judged
from tests.report.test_report import parsed


def test_a_joint_too_small_stands_first_with_its_cure():
    text = page(example("truck-duty-cycle"))
    words = "".join(parsed(text).words)
    first = words.index("life of the bearings of joint 3")
    assert 'class="judgement failed"' in text
    assert first < words.index("joints[2].size") < words.index("The drive as understood")
    assert re.search(r"2 of \d+ limits are not kept", words)


def test_lights_show_what_fails_and_is_close_before_the_rest():
    found = judged(asked(example("truck-duty-cycle"), None, None))
    assert found.lights is not None
    tones = [row[-1].tone for row in found.lights.rows]
    assert tones[:2] == ["failed", "failed"]
    assert tones == sorted(tones, key=["failed", "warning", "good"].index)
    assert "more limits are kept" in found.lights.note


def test_the_page_holds_every_verdict_and_names_what_is_missing():
    drive = example("car-propshaft")
    found = judged(asked(drive, None, None))
    assert found.page is not None
    assert found.changes is None
    assert not found.page.alarms
    rows = {block.title: block.rows for block in found.page.blocks if hasattr(block, "rows")}
    verdicts = check(drive)
    assert len(rows["Could not be judged"]) == sum(bool(one.missing) for one in verdicts)
    said = " ".join(row[0].text for row in rows["Verdicts"])
    assert all(one.title.split(" of ")[0] in said for one in verdicts if one.run and not one.advice)


def test_a_drive_of_which_nothing_is_said_has_no_such_page():
    drive = example("single-20deg")
    bare = replace(drive, duty=replace(drive.duty, speed=None, torque=None))
    assert judged(asked(bare, None, None)).page is None


@pytest.mark.parametrize(
    ("name", "tone", "said"), [("truck-duty-cycle", "failed", "2 of "), ("composite-propshaft", "good", "all ")]
)
def test_the_first_sentence_says_whether_the_limits_are_kept_and_the_next_how_evenly_it_turns(name, tone, said):
    on = asked(example(name), None, None)
    pages = [judged(on).page]
    first = judgement(on, pages)
    assert first.tone == tone
    assert first.text.startswith(f"{on.drive.name}: {said}")
    assert next(warnings(on, pages)).text == evenness(on).text
    assert judgement(on) == evenness(on)


def test_no_kept_limit_hides_what_fails_elsewhere():
    on = asked(example("composite-propshaft"), None, None)
    grows = Page(name="torsion", title="", answer="", blocks=[], alarms=[Words(text="grows", tone="failed")])
    assert judgement(on, [grows, judged(on).page]).tone == "failed"


def test_the_norm_of_a_catalogue_of_the_user_s_own_counts(tmp_path):
    rows = "torsional_rad_s2 = 9e3\ninertia_drive_rad_s2 = 9e3\ninertia_coast_rad_s2 = 9e3\n"
    (tmp_path / "own.toml").write_text(f'[[angle_norms]]\nid = "plant"\nsource = "s"\n{rows}', "utf-8")
    drive = example("z-arrangement")
    own = replace(drive, settings=replace(drive.settings, norm="plant"))
    known = with_files(catalogue(), [tmp_path / "own.toml"])
    assert "all 3 limits that could be judged are kept" in "".join(parsed(page(own, known=known)).words)
