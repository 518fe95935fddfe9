"""Bars of the limits used."""

import re
from dataclasses import replace

import pytest

from cardan import check, example
from cardan.answers.reader import USUAL
from cardan.checks import Verdict
from cardan.checks.figure import BARS, WIDEST, check_figures
from cardan.figures.figure import Bars
from cardan.figures.for_reader import for_reader
from cardan.figures.render_svg import inline_svg


def bars(name):
    (figure,) = check_figures(check(example(name)), name=name)
    figure = for_reader(figure, USUAL)
    return figure, next(one for one in figure.rows[0].panels[0].series if isinstance(one, Bars))


@pytest.mark.slow
def test_every_limit_that_must_be_kept_has_a_bar_in_the_colour_of_its_verdict():
    figure, drawn = bars("truck-duty-cycle")
    run = [one for one in check(example("truck-duty-cycle")) if one.run and not one.advice]
    used = sorted((float(one.utilisation) for one in run), reverse=True)[:BARS]
    assert drawn.size.tolist() == used
    assert drawn.ends.tolist() == used
    assert [role == "failed" for role in drawn.roles] == [one > 1.0 for one in used]
    assert [role == "warning" for role in drawn.roles] == [0.9 <= one <= 1.0 for one in used]
    assert figure.sentence == "The 16 with the highest utilisation are shown."


@pytest.mark.slow
def test_signs_tell_without_colour():
    _figure, drawn = bars("car-propshaft")
    assert {text[0] for text in drawn.texts} == {"●", "○"}
    roles = dict(zip((text[0] for text in drawn.texts), drawn.roles, strict=True))
    assert roles == {"●": "good", "○": "muted"}


def test_a_limit_of_nothing_is_used_without_end():
    nothing_left = Verdict(check="spline_overlap", title="engaged length", value=0.0, limit=0.04, sense="at_least")
    (figure,) = check_figures([nothing_left, *check(example("car-propshaft"))])
    drawn = next(one for one in for_reader(figure, USUAL).rows[0].panels[0].series if isinstance(one, Bars))
    assert drawn.texts[0].endswith(" > 1\u202f000")


def test_nothing_judged_nothing_drawn():
    drive = example("single-20deg")
    assert check_figures([one for one in check(drive) if not one.run or one.advice]) == ()


def test_the_colours_are_told_in_words():
    (figure,) = check_figures(check(example("single-20deg")))
    assert not figure.sentence
    assert "amber comes near, red fails" in figure.source


def test_what_uses_far_too_much_is_cut_with_an_arrow_and_keeps_its_number():
    verdicts = [one for one in check(example("six-joints")) if one.run and not one.advice]
    first = next(one for one in verdicts if one.sense == "at_most")
    far = replace(first, value=23.4 * first.limit)
    (figure,) = check_figures([far, *(one for one in verdicts if one is not first)])
    figure = for_reader(figure, USUAL)
    drawn, panel = next(one for one in figure.panels[0].series if isinstance(one, Bars)), figure.panels[0]
    assert drawn.size[0] == pytest.approx(23.4)
    assert drawn.ends[0] == WIDEST < panel.x.high
    assert drawn.texts[0].startswith("▶ ")
    assert drawn.texts[0].endswith(" 23.40")
    assert not any(text.startswith("▶") for text in drawn.texts[1:])
    svg = inline_svg(figure)
    assert max(float(one) for one in re.findall(r'<rect [^>]*width="(\d+)"', svg)) < 7200 * figure.width
