"""Bars of the limits used."""

from cardan import check, example
from cardan.figures.check import MOST, WIDEST, check_figures
from cardan.figures.figure import Bars


def bars(name):
    (figure,) = check_figures(check(example(name)), name=name)
    return figure, next(one for one in figure.rows[0].panels[0].series if isinstance(one, Bars))


def test_every_limit_that_must_be_kept_has_a_bar_in_the_colour_of_its_verdict():
    figure, drawn = bars("truck-duty-cycle")
    run = [one for one in check(example("truck-duty-cycle")) if one.run and not one.advice]
    used = sorted((float(one.utilisation) for one in run), reverse=True)[:MOST]
    assert drawn.size.tolist() == [min(one, WIDEST) for one in used]
    assert [role == "failed" for role in drawn.roles] == [one > 1.0 for one in used]
    assert [role == "warning" for role in drawn.roles] == [0.9 <= one <= 1.0 for one in used]
    assert "2 of" in figure.sentence


def test_signs_tell_without_colour():
    _figure, drawn = bars("car-propshaft")
    assert all(text.startswith("●") for text in drawn.texts)


def test_nothing_judged_nothing_drawn():
    drive = example("single-20deg")
    assert check_figures([one for one in check(drive) if not one.run or one.advice]) == ()
