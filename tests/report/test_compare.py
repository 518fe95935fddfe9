"""Drives side by side."""

import pytest

from cardan.errors import InputError
from cardan.figures.figure import Curve
from cardan.io import example, example_text, loads
from cardan.io.amend import amend
from cardan.report.block import Picture, Table, Words
from cardan.report.compare import Variant, compared, differences_table
from cardan.texts import speaking
from tests.report.first_page import key_rows

TEXT = example_text("z-arrangement")

BENT = amend(TEXT, {"output.point_mm": [2000, 0, 400]})


@pytest.fixture(scope="module")
def page():
    return compared([Variant(name="as drawn", drive=loads(TEXT)), Variant(name="bent", drive=loads(BENT))])


def table(page, title):
    return next(one for one in page.blocks if isinstance(one, Table) and one.title == title)


def row(found, name):
    return next([cell.text for cell in row] for row in found.rows if row[0].text.startswith(name))


@pytest.mark.slow
def test_the_figures_are_those_of_the_report(page):
    found = table(page, "Key figures")
    for k, text in enumerate((TEXT, BENT)):
        for cells in key_rows(loads(text))[:4]:
            assert row(found, cells[0].text)[2 + k] == cells[1].text


def test_the_best_is_named_and_has_its_sign(page):
    found = table(page, "Key figures")
    line = next(one for one in found.rows if one[0].text.startswith("speed fluctuation"))
    assert [cell.sign for cell in line[2:4]] == ["✓", ""]
    assert line[-1].text == "as drawn"
    assert row(found, "largest joint angle")[0] == "largest joint angle, joint 1 / joint 2"


def test_outputs_are_drawn_over_one_another(page):
    figure = next(one.figure for one in page.blocks if isinstance(one, Picture))
    curves = [one for one in figure.panels[0].series if isinstance(one, Curve)]
    assert [one.label for one in curves] == ["as drawn", "bent"]
    assert len({(one.role, one.dash) for one in curves}) == 2
    assert len([one for one in figure.panels[1].series if isinstance(one, Curve)]) == 2


def test_only_what_differs_is_told(page):
    found = table(page, "What differs in the files")
    assert [one[0].text for one in found.rows] == ["output.point"]
    assert found.rows[0][2].text == "2000, 0, 400 mm"


@pytest.mark.slow
def test_limits_stand_beside_each_other_with_their_signs():
    text = example_text("car-propshaft")
    low = amend(text, {"joints[1].centre_mm": [1150, 0, -120]})
    page = compared([Variant(name=name, drive=loads(one)) for name, one in (("now", text), ("low", low))])
    assert page.answer.startswith("now: all limits are kept. Limits not kept: low")
    found = table(page, "Limits")
    joint_angle = next(one for one in found.rows if one[0].text.startswith("joint angle of joint 2"))
    assert [cell.sign for cell in joint_angle[1:3]] == ["▲", "✖"]  # met by a rating that is not confirmed
    assert joint_angle[-1].text == "now"
    assert row(table(page, "Key figures"), "limits not kept")[2:] == ["0", str(number_failed(found, 2)), "now"]


def number_failed(found, column):
    return sum(one[column].sign == "✖" for one in found.rows)


@pytest.mark.slow
def test_drives_of_any_kinds_and_numbers_of_joints_compare():
    names = ("tracta-steered-axle", "single-20deg", "six-joints")
    page = compared([Variant(name=one, drive=example(one)) for one in names])
    assert len(table(page, "Key figures").columns) == 2 + len(names) + 1
    for one in page.blocks:
        if isinstance(one, Table):
            assert all(len(line) == len(one.columns) for line in one.rows)


def test_the_same_drive_twice_has_no_best():
    page = compared([Variant(name=one, drive=loads(BENT)) for one in "ab"])
    assert {one[-1].text for one in table(page, "Key figures").rows} <= {"all alike", "–"}
    assert table(page, "What differs in the files").note == "The files say the same."
    assert page.answer.startswith("All of them have")


def test_who_stops_gets_what_there_is():
    page = compared(
        [Variant(name=one, drive=loads(TEXT)) for one in "abc"], lambda share: "stop" if share > 0.3 else None
    )
    assert isinstance(page.blocks[0], Words)
    assert "left out: " in page.blocks[0].text


def test_progress_rises_to_the_end():
    told = []
    compared([Variant(name=one, drive=loads(TEXT)) for one in "ab"], told.append)
    assert told == sorted(told)
    assert told[-1] == 1.0


def test_it_speaks_the_language_of_the_reader():
    with speaking("ru"):
        assert differences_table(["а", "б"], [loads(TEXT), loads(BENT)]).columns[0].heading == "ключ"


@pytest.mark.parametrize("names", [(), ("a", "a")])
def test_names_are_needed(names):
    with pytest.raises(InputError):
        compared([Variant(name=one, drive=loads(TEXT)) for one in names])
