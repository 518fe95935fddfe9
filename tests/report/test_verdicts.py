"""The limits in the report: traffic lights and the changes that help most first, then every verdict."""

import re
from dataclasses import replace

import pytest

from cardan.answers.reader import Reader, reading
from cardan.catalogue import catalogue, with_files
from cardan.checks import check
from cardan.io import example
from cardan.report.block import Page, Table, Words
from cardan.report.report import page
from cardan.report.subject import asked
from cardan.report.summary import judgement, uniformity, warnings
from cardan.report.verdicts import judged
from tests.report.test_report import parsed


def table(page: Page, title: str) -> Table:
    return next(one for one in page.blocks if isinstance(one, Table) and one.title.startswith(title))


@pytest.mark.slow
def test_a_joint_too_small_stands_first_with_its_cure():
    text = page(example("truck-duty-cycle"))
    words = "".join(parsed(text).words)
    first = words.index("life of the bearings of joint 3")
    assert 'class="judgement failed"' in text
    assert first < words.index("joint 3: centre, z") < words.index("The drive as understood")
    assert re.search(r"3 of \d+ checks failed", words)


@pytest.mark.slow
def test_lights_show_what_fails_and_is_close_before_the_rest():
    found = judged(asked(example("truck-duty-cycle"), None, None))
    assert found.lights is not None
    tones = [row[-1].tone for row in found.lights.rows]
    assert tones[:2] == ["failed", "failed"]
    assert tones == sorted(tones, key=["failed", "warning", "good"].index)
    assert "more checks passed" in found.lights.note


def test_the_page_holds_every_verdict_and_names_what_is_missing():
    drive = example("car-propshaft")
    found = judged(asked(drive, None, None))
    assert found.page is not None
    assert found.changes is None
    assert not found.page.alarms
    rows = {block.title: block.rows for block in found.page.blocks if hasattr(block, "rows")}
    verdicts = check(drive)
    assert "Checks not run, and the keys they need" not in rows
    assert any("checks were not run, as the drive file" in getattr(one, "text", "") for one in found.page.blocks)
    assert found.missing is not None
    lacking = [row[1].text for row in found.missing.blocks[0].rows]
    assert lacking == [
        "angle error of the output (±)",
        "speed times angle n·α of joint 1 (gearbox) (and 2)",
        "clearance of the speeds in use from torsional resonance",
        "damping against parametric resonance",
        "reversal of the torque",
    ]
    assert sum(bool(one.missing) for one in verdicts) == 6
    said = " ".join(row[-2].text for row in rows[""])
    binding = [one for one in verdicts if one.run and not one.advice and one.check != "answers_agree"]
    assert all(one.title.split(" of ")[0] in said for one in binding)
    told = [block.text for block in found.page.blocks if isinstance(block, Words)]
    assert any(text.startswith("Answers that speak of the same quantity agree: ") for text in told)


def test_a_drive_of_which_nothing_is_said_has_no_such_page():
    drive = example("single-20deg")
    bare = replace(drive, duty=replace(drive.duty, speed=None, torque=None, application="industrial"))
    assert judged(asked(bare, None, None)).page is None


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "tone", "said"), [("truck-duty-cycle", "failed", "3 of "), ("composite-propshaft", "warning", "all ")]
)
def test_the_first_sentence_says_whether_the_limits_are_kept_and_the_next_how_evenly_it_turns(name, tone, said):
    on = asked(example(name), None, None)
    pages = [judged(on).page]
    first = judgement(on, pages)
    assert first.tone == tone
    assert first.text.startswith(f"{on.drive.name}: {said}")
    assert next(warnings(on, pages)).text == uniformity(on).text
    assert judgement(on) == uniformity(on)


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
    assert "all 3 checks passed" in "".join(parsed(page(own, known=known)).words)


def test_one_change_that_cures_all_stands_first_in_words_and_with_units():
    found = judged(asked(example("truck-wrong-yokes"), None, None))
    assert found.changes is not None
    (first,) = ([cell.text for cell in row] for row in found.changes.rows)
    assert first[:2] == ["shaft 2: yoke angle", "90°"]
    assert first[-1] == "torsional acceleration of the output and 1 other"
    assert "[" not in "".join(first)
    assert "count from 0" not in found.changes.note


def test_a_change_is_listed_once_and_marked_where_it_breaks_something():
    found = judged(asked(example("z-arrangement"), None, None))
    assert found.page is not None
    remedies = next(
        one for one in found.page.blocks if isinstance(one, Table) and one.title.startswith("Corrective changes")
    )
    told = [(row[0].text, row[2].text) for row in remedies.rows]
    assert len(set(told)) == len(told)
    assert {row[-1].tone for row in remedies.rows if "then fails" in row[-1].text} == {"warning"}


def test_a_limit_alone_that_is_not_kept_is_not_one_of_one():
    found = judged(asked(example("single-20deg"), None, None))
    assert found.page is not None
    assert found.page.answer.startswith("The only check failed: torsional acceleration of")


@pytest.mark.slow
def test_verdicts_name_the_speed_and_a_band_both_of_its_ends():
    lights = judged(asked(example("truck-duty-cycle"), None, None)).lights
    assert lights is not None
    assert "torsional acceleration of the output, at 1\u202f800 rpm" in [row[0].text for row in lights.rows]
    page = judged(asked(example("two-piece-rubber-bearing"), None, None)).page
    assert page is not None
    rows = [row for block in page.blocks if isinstance(block, Table) for row in block.rows]
    band = next(row for row in rows if row[-2].text.startswith("clearance of the speed range from half critical speed"))
    assert band[3].text == "≤ 3\u202f264 or ≥ 3\u202f831 rpm"


def test_joints_that_differ_in_number_alone_are_lacking_in_one_row():
    page = judged(asked(example("six-joints"), None, None)).missing
    assert page is not None
    rows = next(one.rows for one in page.blocks if isinstance(one, Table) and one.title.startswith("Checks not run"))
    assert [row[1].text for row in rows if "rating.max_torque" in row[0].text] == [
        "largest torque of joint 1 (engine) (and 2, 3, 4, 5, 6)"
    ]
    assert len(rows) < 25


@pytest.mark.slow
def test_limits_are_written_as_they_were_given():
    found = judged(asked(example("truck-rear-axle"), None, None)).page
    assert found is not None
    tables = [block for block in found.blocks if isinstance(block, Table) and len(block.columns) > 5]
    limits = {row[3].text for block in tables for row in block.rows}
    assert "≤ 6°" in limits
    assert not any(re.fullmatch(r"[≤≥] .*\.\d*0( .*)?", text) for text in limits)


@pytest.mark.slow
def test_the_colour_of_the_first_sentence_has_a_reason_in_words():
    on = asked(example("composite-propshaft"), None, None)
    limits = judged(on).page
    assert limits is not None
    asks = Page(name="bending", title="", answer="", blocks=[], alarms=[Words(text="half", tone="warning")])
    first = judgement(on, [asks, limits])
    assert (first.tone, first.text.endswith("See the warnings below.")) == ("warning", True)
    calm = judgement(on, [limits])
    assert calm.tone == "warning", "verdicts met by unconfirmed ratings are not green"
    assert "by unconfirmed ratings" in calm.text
    own = asked(example("truck-supports"), None, None)
    assert judgement(own, [judged(own).page]).tone == "good"
    assert any(
        cell.text == "beyond"
        for block in limits.blocks
        if isinstance(block, Table)
        for row in block.rows
        for cell in row
    )


def test_a_limit_nearly_used_up_makes_the_first_sentence_amber():
    drive = example("composite-propshaft")
    joint_angles = [float(one.value) for one in check(drive, only=["joint_angle"])]
    near = replace(drive, limits=replace(drive.limits, joint_angle=max(joint_angles) / 0.95))
    on = asked(near, None, None)
    page = judged(on).page
    assert page is not None
    assert judgement(on, [page]).tone == "warning"


@pytest.mark.slow
def test_what_no_single_key_cures_is_said_beside_the_cures():
    """The duty names a speed and a range of speeds: lowering one of them leaves the other."""
    drive = example("truck-power-unit")
    fixed = replace(drive, shafts=tuple(replace(one, yoke_fixed=0 < k < 4) for k, one in enumerate(drive.shafts)))
    found = judged(asked(fixed, None, None))
    assert found.changes is not None
    said = "Failed, and no single parameter remedies it: torsional acceleration of the output."
    assert found.changes.note.endswith(said)
    assert "no single parameter" not in judged(asked(example("truck-wrong-yokes"), None, None)).changes.note


@pytest.mark.slow
def test_changes_of_keys_stay_in_the_units_of_the_keys():
    with reading(Reader(units={"length": "in", "torque": "lbft"})):
        page = judged(asked(example("truck-duty-cycle"), None, None)).page
    assert page is not None
    rows = table(page, "Corrective changes").rows
    changes = [(row[0].text, (row[1].text, row[2].text)) for row in rows]
    assert ("-193", "-184.5") in [told_ for key, told_ in changes if key == "joints[2].centre_mm[2]"]
    assert any(row[3].text.endswith("lbf·ft") for row in table(page, "").rows)
