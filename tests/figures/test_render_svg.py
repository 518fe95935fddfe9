"""SVG: points stand where the axes say, to half a hundredth of a point, and words stay words."""

import re
from xml.etree import ElementTree

import numpy as np
import pytest

from cardan.figures.figure import Axis, Band, Bars, Curve, Figure, Note, Panel, Row, Rule, Shape
from cardan.figures.page import laid_out
from cardan.figures.render_svg import document, inline_svg

SVG = "{http://www.w3.org/2000/svg}"
INCH = 7200.0


def figure(*series, x=None, y=None, **how):
    panel = Panel(series=series, x=x or Axis(low=0.0, high=10.0), y=y or Axis(low=-1.0, high=1.0), **how)
    return Figure(name="one", title="Title", sentence="Sentence.", source="Source", rows=(Row(panels=(panel,)),))


def box(one):
    """Return left, top, width and height of the only frame, in hundredths of a point."""
    ((_panel, frame),) = laid_out(one, words=False).panels
    return [INCH * value for value in (frame.left, frame.top, frame.width, frame.height)]


def inside(one):
    """Return what is drawn within the frame."""
    tree = ElementTree.fromstring(inline_svg(one))
    return next(group for group in tree.iter(f"{SVG}g") if "clip-path" in group.attrib)


def corners(path):
    """Return the points of every run of a path."""
    runs = []
    for run in re.findall(r"M(-?\d+) (-?\d+)l([-\d ]+)", path):
        steps = np.reshape([int(one) for one in run[2].split()], (-1, 2))
        runs.append(np.cumsum(np.vstack(([int(run[0]), int(run[1])], steps)), axis=0))
    return runs


def test_points_of_a_curve_stand_where_the_axes_say():
    x, y = np.linspace(0.0, 10.0, 40), np.sin(np.linspace(0.0, 6.0, 40))
    one = figure(Curve(x=x, y=y))
    left, top, width, height = box(one)
    (found,) = corners(next(iter(inside(one))).get("d"))
    wanted = np.stack((left + 0.1 * width * x, top + height * (1.0 - y) / 2.0), axis=-1)
    assert np.abs(found - wanted).max() <= 0.5 + 1e-6  # rounded to whole hundredths


def test_what_is_not_known_interrupts_a_curve_and_what_is_far_away_keeps_finite():
    y = np.asarray([0.0, 0.5, np.nan, 0.2, 1e300, np.inf, 0.1, 0.3])
    runs = corners(next(iter(inside(figure(Curve(x=np.arange(8.0), y=y))))).get("d"))
    assert [len(run) for run in runs] == [2, 2, 2]
    assert np.abs(runs[1]).max() <= 1e6


def test_a_logarithmic_axis_has_ten_midway_between_one_and_a_hundred():
    one = figure(Rule(value=10.0, upright=True), x=Axis(low=1.0, high=100.0, log=True))
    left, _top, width, _height = box(one)
    assert float(next(iter(inside(one))).get("d")[1:].split()[0]) == pytest.approx(left + 0.5 * width, abs=0.5)


def test_equal_axes_keep_a_circle_round():
    turn = np.linspace(0.0, 2.0 * np.pi, 90)
    (found,) = corners(next(iter(inside(figure(Curve(x=np.cos(turn), y=np.sin(turn)), equal=True)))).get("d"))
    wide, high = np.ptp(found, axis=0)
    assert wide == pytest.approx(high, rel=2e-3)  # 90 chords miss the top by 0.06 %


def test_bars_reach_from_their_base_to_their_size_either_way():
    one = figure(Bars(at=np.asarray([2.0, 5.0]), size=np.asarray([0.5, -0.5]), texts=("a", "b"), thick=1.0))
    _left, top, _width, height = box(one)
    first, second = inside(one)
    assert [float(first.get(key)) for key in ("y", "height")] == pytest.approx(
        [top + 0.25 * height, 0.25 * height], abs=1
    )
    assert [float(second.get(key)) for key in ("y", "height")] == pytest.approx(
        [top + 0.5 * height, 0.25 * height], abs=1
    )


def test_bands_lie_behind_rules_and_rules_behind_curves():
    series = (
        Curve(x=np.arange(2.0), y=np.zeros(2)),
        Rule(value=0.1, text="rule"),
        Band(low=0.0, high=0.5, text="band"),
    )
    drawn = list(inside(figure(*series)))
    assert drawn[0].tag == f"{SVG}rect"
    assert "stroke-dasharray" in drawn[1].attrib
    assert "l" in drawn[2].get("d")


def test_words_are_escaped_and_have_a_line_each():
    tree = ElementTree.fromstring(inline_svg(figure(Note(text="a < b\n& c", x=1.0, y=0.0))))
    words = [text for text in tree.iter(f"{SVG}text") if "paint-order" in text.get("style", "")]
    assert [text.text for text in words] == ["a < b", "& c"]
    assert float(words[1].get("y")) - float(words[0].get("y")) == pytest.approx(960, abs=1)  # 1.2 times 8 pt


def test_ticks_out_of_range_are_left_out():
    one = figure(x=Axis(low=0.0, high=10.0, ticks=(-1.0, 0.0, 10.0, 10.5), texts=("no", "first", "last", "never")))
    text = inline_svg(one)
    assert "first" in text
    assert "last" in text
    assert "no<" not in text
    assert "never" not in text


def test_an_arrowhead_points_along_the_last_stretch():
    def heads(x):
        tree = ElementTree.fromstring(inline_svg(figure(Curve(x=np.asarray(x), y=np.zeros(2), arrow=True))))
        filled = [path for path in tree.iter(f"{SVG}path") if path.get("fill") != "none"]
        return [corners(path.get("d"))[0] for path in filled]

    ((tip, one, two),) = heads([1.0, 5.0])
    assert tip[0] - one[0] == tip[0] - two[0] == 280
    assert {one[1] - tip[1], two[1] - tip[1]} == {140, -140}
    assert heads([1.0, 11.0]) == []  # beyond the frame


def test_a_document_has_all_figures_with_their_words_and_ids_of_its_own():
    shape = Shape(x=np.asarray([0.0, 1.0, 1.0]), y=np.asarray([0.0, 0.0, 1.0]), opacity=0.5, outline=1.0)
    text = document([figure(shape), figure(shape)])
    tree = ElementTree.fromstring(text.encode("utf-8"))
    words = [one.text for one in tree.iter(f"{SVG}text")]
    assert words.count("Title") == words.count("Sentence.") == words.count("Source") == 2
    ids = [one.get("id") for one in tree.iter() if one.get("id")]
    assert len(ids) == len(set(ids)) == 2


def test_words_of_rules_side_by_side_stand_below_each_other_and_within_the_frame():
    at = {"in use": 5.0, "1.6 × the highest": 5.1, "far": 8.5, "at the very end of it": 9.9}
    one = figure(*(Rule(value=value, upright=True, text=text) for text, value in at.items()))
    tree = ElementTree.fromstring(inline_svg(one))
    found = {text.text: text for text in tree.iter(f"{SVG}text") if text.text in at}
    lines = {text: float(one.get("y")) for text, one in found.items()}
    assert lines["in use"] < lines["1.6 × the highest"]
    assert lines["far"] != lines["at the very end of it"]
    assert [text for text, one in found.items() if one.get("text-anchor") == "end"] == ["at the very end of it"]
