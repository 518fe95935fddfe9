"""Pages of the report as HTML: everything a user wrote is escaped, numbers keep their place, signs and full figures."""

import re
from html.parser import HTMLParser
from pathlib import Path

import nicegui
import pytest

from cardan.answers.palette import DARK, ROLES, SHAFTS
from cardan.app.parts.blocks import _placed, block_html, cell_html, drawn_in_space, table_html
from cardan.app.parts.verdicts import field_of, lights_html
from cardan.figures.render_plotly import described
from cardan.io import example
from cardan.register import QUESTIONS
from cardan.report.answers import answered, subject
from cardan.report.block import Cell, Column, Listing, Picture, Points, Table, Words
from cardan.report.verdict_list import Applicable, Light, lights

EVIL = "<script>alert(1)</script>\"'&"

VOID = {"br", "img", "hr"}


class Checked(HTMLParser):
    """Fails where tags do not close each other, and notes them."""

    def __init__(self, text):
        super().__init__()
        self.open, self.tags, self.words = [], [], []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


@pytest.mark.parametrize(
    "block",
    [
        Words(text=EVIL, title=EVIL, tone="failed"),
        Words(text=EVIL),
        Points(title=EVIL, items=[EVIL, EVIL]),
        Listing(title=EVIL, text=EVIL),
        Table(
            title=EVIL,
            note=EVIL,
            columns=[Column(heading=EVIL, unit=EVIL), Column(heading="x")],
            rows=[[Cell(text=EVIL, full=EVIL, chip=EVIL), Cell(text="1", tone="warning")]],
        ),
    ],
)
def test_what_a_user_wrote_is_words_and_nothing_else(block):
    seen = Checked(block_html(block, {EVIL: EVIL}))
    assert not [tag for tag, _attributes in seen.tags if tag == "script"]
    assert EVIL in "".join(seen.words)


def test_a_light_with_evil_words_is_harmless():
    remedy = Applicable(label=EVIL, effect=EVIL, values={"joints[0].joint_angle_deg": 1.0})
    one = Light(
        name=EVIL,
        title=EVIL,
        tone="failed",
        verdict=EVIL,
        value=Cell(text=EVIL, full=EVIL),
        limit=EVIL,
        used=float("inf"),
        source=EVIL,
        why=EVIL,
        path="joints[0]",
        design_variables=(EVIL,),
        remedies=(remedy,),
    )
    seen = Checked(lights_html([one]))
    assert not [tag for tag, _attributes in seen.tags if tag == "script"]
    assert ("details", {"class": "failed", "data-name": EVIL}) in seen.tags
    assert field_of(one) == "joints[0].joint_angle_deg"


def test_numbers_are_told_in_full_and_tones_by_sign_too():
    text = cell_html(Cell(text="0.79", full="0.791234", tone="failed"), left=False)
    seen = Checked(text)
    assert seen.tags[0] == ("td", {"class": "failed", "title": "0.791234"})
    assert "✖" in seen.words


def test_the_unit_stands_in_the_heading_and_words_to_the_left():
    table = Table(columns=[Column(heading="a", left=True), Column(heading="b", unit="mm")], rows=[[Cell(text="x")] * 2])
    seen = Checked(table_html(table))
    assert ("th", {"scope": "col", "class": "left"}) in seen.tags
    assert ("span", {"class": "unit"}) in seen.tags
    assert "mm" in seen.words


def test_buttons_stand_in_the_first_table_that_has_them_alone():
    page = answered("phasing", subject(example("truck-power-unit")))
    given = _placed(page.blocks, {"A": "apply"})
    (table,) = [block for block, some in zip(page.blocks, given, strict=True) if some]
    assert table.title == "Yoke angles γ, and the speed fluctuation δ that they leave"
    buttons = [a for tag, a in Checked(table_html(table, {"A": "apply"})).tags if tag == "button"]
    assert [one["data-do"] for one in buttons] == ["A"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["truck-supports", "overconstrained-pump", "propshaft-with-rzeppa"])
def test_every_quick_answer_is_sound_html(name):
    on = subject(example(name))
    for one, asked in QUESTIONS.items():
        if asked.quick:
            for block in answered(one, on).blocks:
                if not isinstance(block, Picture):
                    Checked(block_html(block))
    Checked(lights_html(lights(on)))


def test_curves_over_the_input_angle_know_it_and_drawings_are_no_charts():
    on = subject(example("truck-supports"))
    figures = [block.figure for block in answered("motion", on).blocks if isinstance(block, Picture)]
    assert described(figures[0])["layout"]["meta"]["turning"] == [["", 1.0], ["2", 1.0], ["3", 1.0]]  # axis, its scale
    assert described(figures[1])["layout"]["meta"]["turning"] == []  # orders
    space = {
        block.figure.name: drawn_in_space(block.figure)
        for block in answered("forces", on).blocks
        if isinstance(block, Picture)
    }
    assert space["loads"]
    assert space["loads-space"]
    assert not space["torques"]


def test_every_colour_of_figures_has_one_for_dark_pages():
    assert set(SHAFTS) | set(ROLES.values()) == set(DARK)
    bright = [sum(int(colour[k : k + 2], 16) for k in (1, 3, 5)) for colour in (*DARK, *DARK.values())]
    half = len(bright) // 2
    curves = [k for k, colour in enumerate(DARK) if colour in SHAFTS]
    assert all(bright[k + half] > bright[k] for k in curves)


KNOWN = ("3.1.",)
"""Versions of plotly.js whose inner parts `chart.js` knows, see docs/decisions/0023."""


def test_the_plotly_that_nicegui_ships_is_one_whose_inner_parts_the_charts_know():
    shipped = Path(nicegui.__file__).parent / "elements" / "plotly" / "dist" / "index.js"
    version = re.findall(r'version="(\d+\.\d+\.\d+)"', shipped.read_text("utf-8"))[0]
    assert version.startswith(KNOWN), (
        f"NiceGUI ships plotly.js {version}; chart.js moves curves in the SVG of {', '.join(KNOWN)}x: "
        "run tests/app/test_seen.py and tests/app/test_access.py with it, then add it to KNOWN"
    )
