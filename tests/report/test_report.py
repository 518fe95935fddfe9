"""The report of every example: complete, self-contained, and with the numbers of the analyses."""

import dataclasses
import re
import sys
from html.parser import HTMLParser

import pytest

from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.models.wobble import wobbling
from cardan.errors import InputError
from cardan.figures.axes import percent
from cardan.io import example, example_names, example_text
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.phases import answer as yokes
from cardan.report.block import Picture, Table, shown
from cardan.report.content import content, moved, phased
from cardan.report.report import page, report
from cardan.report.subject import Subject
from cardan.units import deg
from tests.builders.reports import content_of, page_of
from tests.report.first_page import key_rows

VOID = {"meta", "br", "link", "img", "hr", "input"}


class Nesting(HTMLParser):
    """Follows the tags of a page: each closed by its own, ids used once, links that lead somewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.words: list[str] = []

    def handle_starttag(self, tag, attrs):
        known = dict(attrs)
        if "id" in known:
            self.ids.append(known["id"])
        if tag == "a":
            self.links.append(known["href"])
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        known = dict(attrs)
        if "id" in known:
            self.ids.append(known["id"])

    def handle_endtag(self, tag):
        assert self.open, tag
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] not in ("style", "script"):
            self.words.append(data)


def parsed(text: str) -> Nesting:
    seen = Nesting()
    seen.feed(text)
    seen.close()
    assert seen.open == []
    return seen


def proof(on: Subject) -> str:
    """Return what the appendix says of the sides of the polygon."""
    return " ".join(map(shown, yokes.proof(on.drive, on.phasing)))


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_the_report_of_every_example_is_whole(name):
    drive, source = example(name), example_text(name)
    seen = parsed(page_of(name))
    words = "".join(seen.words)
    assert len(seen.ids) == len(set(seen.ids))
    assert {link.removeprefix("#") for link in seen.links} <= set(seen.ids)
    if not wobbling(drive):
        assert percent(float(equivalent_joint(drive).speed_fluctuation)) in words
    assert drive.name in words
    assert source.strip().splitlines()[-1] in words
    assert "nan" not in re.findall(r"[a-z]+", words.lower())
    assert ("Articulation" in words) == bool(drive.movements)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["pto-hitch", "six-joints"])
def test_nothing_is_fetched(name):
    text = page_of(name)
    addresses = set(re.findall(r"https?://[^\s\"'<>]+", text))
    assert addresses <= {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"}
    assert not re.search(r"(?:src|href)=\"(?!#)", text)
    assert "<script" not in text
    assert "@import" not in text


def test_the_truck_says_what_is_wrong_and_what_helps():
    words = "".join(parsed(page_of("truck-printed-angles")).words)
    assert "12.51" in words
    assert "20.049" in words
    assert "with its yokes re-phased it is exactly uniform" in words
    for shaft in ("4.06", "3.21", "5.49"):
        assert shaft in words
    # Book (80) as in the worked example: 12.335 % with mean phases.
    assert "12.34" in words


def test_a_synchronous_drive_is_called_so():
    words = "".join(parsed(page(Drive.from_angles([0.3, 0.3]))).words)
    assert "uniform as specified" in words
    assert "exactly uniform" in words


def test_an_infeasible_drive_says_why_and_what_bend_would_do():
    words = "".join(parsed(page(Drive.from_angles([10 * deg, 30 * deg, 20 * deg]))).words)
    assert "cannot be made uniform. The angle of joint 2 is too large for the others" in words
    # cos x = cos 10° cos 20°, by hand: x = 22.27°.
    assert "22.27°" in words


def test_a_drive_even_but_for_rounded_coordinates_is_not_called_uneven():
    """Its two joint angles of 20° differ by 5e-5°: the file gives coordinates to a micrometre."""
    from cardan.report.subject import asked
    from cardan.report.summary import uniformity

    on = asked(example("pto-spline-thrust"), None, None)
    assert on.rounded
    assert not on.phasing.feasible
    (drawn,) = (one for one in yokes.answer(on.drive, on.phasing).figures() if one.name == "polygon")
    polygon = Picture(figure=drawn).figure.sentence
    said = [uniformity(on).text, phased(on).answer, proof(on), polygon, moved(on).answer]
    assert all("but for the rounding" in text.lower() for text in said)
    rows = {row[0].text: row for row in key_rows(on.drive)}
    assert rows["angle error of the output, ±"][1].text == "9.283·10⁻⁶"
    assert "times smaller" not in "".join(parsed(page(on.drive)).words)


def test_joints_that_turn_evenly_by_themselves_are_said_to():
    from cardan.report.subject import asked

    for name in ("pto-hitch",):
        on = asked(example(name), None, None)
        told = (proof(on), phased(on).answer, moved(on).answer)
        assert all("joint turns uniformly by itself" in text for text in told)
        assert ["as drawn" in text.lower() for text in told] == 3 * [bool(on.drive.movements)]


def test_the_bend_that_would_close_is_told_of_the_hooke_joint_that_turns_alike():
    from cardan.report.subject import asked

    on = asked(example("double-cardan-propshaft"), None, None)
    text = proof(on)
    assert "if the Hooke joint that turns like that joint had an angle of 1.00°. α is the angle of the Hooke" in text


def test_a_turn_between_yokes_is_told_as_the_line_that_other_pages_name():
    from cardan.report.method import method
    from cardan.report.subject import asked

    tables = [block for block in method(asked(example("truck-rear-axle"), None, None), None).blocks]
    equations = next(block for block in tables if getattr(block, "title", "") == "Equations used")
    turn = next(row[2].text for row in equations.rows if row[0].text == "between joints 1 and 2")
    assert turn.endswith("= 269.93° ≡ 89.93° (mod 180°)")


@pytest.mark.slow
def test_key_figures_name_the_pose_that_is_worst():
    rows = {row[0].text: row[1].text for row in key_rows(example("rolling-mill-upper-spindle"))}
    assert rows["largest joint angle, joint 1 (pinion stand), in the pose roll change"] == "3.719"
    rows = {row[0].text: row[1] for row in key_rows(example("truck-rear-axle"))}
    assert float(rows["largest joint angle while moving, joint 2 (axle), in the pose empty"].full) == pytest.approx(
        13.5, abs=0.1
    )
    assert float(rows["speed fluctuation δ of the output, in the pose empty"].full) == pytest.approx(0.251, abs=1e-3)
    assert (
        rows["shortest engaged length of the spline, shaft 2, while the drive moves; in the pose empty"].text == "84.2"
    )


def test_lengths_of_end_shafts_that_the_file_gives_are_shown():
    from cardan.report.description import description
    from cardan.report.subject import asked

    page_two = description(asked(example("w-arrangement"), None, None))
    shafts = next(block for block in page_two.blocks if getattr(block, "title", "") == "Shafts")
    assert [row[1].text for row in shafts.rows] == ["300.0", "1\u202f450.0", "250.0"]
    assert not any("lengths of the end shafts" in item for item in page_two.blocks[-1].items)


def test_a_degree_off_costs_something_where_the_slope_is_zero():
    from cardan.report.subject import asked

    on = asked(example("three-joints-unequal"), None, None)
    blocks = phased(on).blocks
    costs = next(block for block in blocks if getattr(block, "title", "").startswith("Growth of δ"))
    assert abs(on.best.sensitivity).max() < 1e-8
    assert all(0.0 < float(row[2].full) < float(row[1].full) for row in costs.rows)


@pytest.mark.slow
def test_spline_travel_is_judged_and_a_spline_that_does_not_follow_is_told_once():
    drive = example("pto-hitch")
    held = "".join(parsed(page(drive)).words)
    first, _sign, _rest = held.partition("The drive as understood")
    assert "shortest engaged length" not in first
    judged = first[first.rindex("engaged length of the spline of shaft 2") :].split()
    at = judged.index("189.0")
    assert judged[at : at + 6] == ["189.0", "mm", "≥", "150", "0.79", "✓passed"]
    tight = dataclasses.replace(drive.shafts[1].spline, gap=0.003)
    shafts = (drive.shafts[0], dataclasses.replace(drive.shafts[1], spline=tight), *drive.shafts[2:])
    failed = "".join(parsed(page(dataclasses.replace(drive, shafts=shafts))).words)
    assert failed.count("the spline of shaft 2 bottoms") == 1
    assert "A spline does not follow the movement." in failed
    assert re.search(
        r"remaining travel of the spline of shaft 2[^,]*, while the drive moves\s+−61.64\s+mm\s+> 0.*?failed",
        failed,
        re.S,
    )
    assert "least remaining travel" not in failed


def test_changes_come_with_the_most_helpful_first():
    from cardan.report.subject import asked
    from cardan.report.summary import changes

    for name in ("three-joints-unequal", "truck-printed-angles"):
        rows = changes(asked(example(name), None, None)).rows
        left = [float(row[2].full) for row in rows]
        assert 1 < len(left) <= 3
        assert left == sorted(left)
        assert left[0] == pytest.approx(0.0, abs=1e-12)


def test_a_change_is_listed_once_and_told_to_concern_the_drive_as_drawn():
    """Spline teeth that allow setting A itself are no second change."""
    from cardan.questions.phases.setting import YokeSetting
    from cardan.report.subject import asked
    from cardan.report.summary import changes

    on = asked(example("three-joints-unequal"), None, None)
    assert isinstance(on.best, YokeSetting)
    twice = dataclasses.replace(on, watched=dataclasses.replace(on.phasing, spline_settings=(on.best,)))
    assert [row[0].text for row in changes(twice).rows] == [row[0].text for row in changes(on).rows]
    assert changes(on).note == ""
    moving = dataclasses.replace(on, drive=dataclasses.replace(on.drive, movements=example("pto-hitch").movements))
    assert "standing still" in changes(moving).note


def test_bends_beyond_joints_and_beyond_digits_are_warned_of():
    steep = "".join(parsed(page(Drive.from_angles([50 * deg]))).words)
    assert "above 45° no real cross joint works" in steep
    assert "too much" in steep
    assert "rounding costs digits" in "".join(parsed(page(Drive.from_angles([85 * deg, 10 * deg]))).words)


@pytest.mark.slow
@pytest.mark.parametrize("joint_angles", [[0.0], [0.2], [0.0, 0.2, 0.2], [0.1] * 12, [0.0, 0.0]])
def test_any_number_of_joints_and_straight_ones_give_a_report(joint_angles):
    seen = parsed(page(Drive.from_angles(joint_angles)))
    assert "nan" not in re.findall(r"[a-z]+", "".join(seen.words).lower())


def test_a_duty_may_be_given_beside_the_drive():
    drive = Drive.from_angles([20 * deg])
    words = "".join(parsed(page(drive, Duty(speed=100.0))).words)
    # Largest acceleration of a 20° joint: 0.1249656 ω², Book Table 4.
    assert "1\u202f250" in words
    assert "rad/s²" in words


def test_words_of_the_user_cannot_break_the_page():
    drive = Drive.from_angles([0.2, 0.1], name="<script>alert(1)</script>")
    text = page(drive, source_text="# <b>&amp; </pre>", full=True)
    assert "<script>" not in text
    parsed(text)


def test_the_interactive_report_brings_its_program(tmp_path):
    text = report(example("single-20deg"), None, tmp_path / "r.html", interactive=True).read_text()
    assert "Plotly.newPlot" in text
    assert not re.search(r"<script[^>]+src=", text)


def test_the_file_is_written_whole_or_not_at_all(tmp_path):
    drive = Drive.from_angles([0.2])
    assert report(drive, None, tmp_path / "one.html").read_text().startswith("<!doctype html>")
    for place in (tmp_path / "no" / "r.html", tmp_path / "r.txt"):
        with pytest.raises(InputError):
            report(drive, None, place)
    assert [path.name for path in tmp_path.iterdir()] == ["one.html"]


@pytest.mark.slow
def test_progress_rises_to_one_and_may_stop_the_work():
    told: list[float] = []
    page(example("pto-hitch"), progress=told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0
    words = "".join(parsed(page(example("pto-hitch"), progress=lambda share: "stop")).words)
    assert "Stopped by the reader" in words
    assert "Articulation" not in words


@pytest.mark.slow
def test_what_few_ask_for_stands_in_the_appendix_and_only_where_asked():
    drive, text = example("two-piece-rear-drive"), example_text("two-piece-rear-drive")
    short, full = content(drive, source_text=text), content(drive, source_text=text, full=True)
    assert [one.name for one in short.pages] == [one.name for one in full.pages]
    assert not short.appendix
    assert [one.title for one in full.appendix] == [
        "Classical approximations",
        "Checks not run",
        "Method and evidence",
    ]
    told = "".join(parsed(page(drive, source_text=text)).words)
    assert not re.search("Appendix|classical|Poincaré|Möbius map|format = 1", told)
    words = "".join(parsed(page_of("two-piece-rear-drive")).words)
    assert words.index("Poincaré") < words.index("Appendix") < words.index("format = 1")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["two-piece-rear-drive", "truck-duty-cycle", "pto-hitch", "single-20deg"])
def test_no_number_of_the_limits_is_told_again_by_the_key_figures(name):
    said = content_of(name)
    assert isinstance(said.lights, Table)
    limits = {(row[1].full, row[2].text) for row in said.lights.rows}
    assert limits
    assert not limits & {(row[1].full, row[2].text) for row in said.figures.rows}
    assert len(said.figures.rows) > 1


def test_a_self_check_that_fails_is_named_on_the_first_page_without_the_appendix(monkeypatch):
    on = Subject(drive=example("z-arrangement"))
    broken = tuple(dataclasses.replace(one, residual=1.0) for one in on.checks[:1])
    monkeypatch.setattr(sys.modules[Subject.__module__], "evidence", lambda _drive: broken)
    told = [one.text for one in content(on.drive).warnings]
    assert f"A self-check failed: {broken[0].name}." in told
