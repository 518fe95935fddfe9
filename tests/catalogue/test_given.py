"""Page 2 of a report: all that the drive file gives, in words, with where the figures of the catalogue come from."""

import tomllib

import pytest

from cardan import example
from cardan.answers.printed import printed
from cardan.answers.reader import USUAL, Reader
from cardan.catalogue.given import inputs, sources
from cardan.io.examples import example_names, example_text

TITLES = {"supports": "Supports", "stations": "Masses that turn with the shafts", "limits": "Limits set in the file"}


def rows(drive, who=USUAL):
    """All tables by title: words -> cells; what stands indented below a part of it, behind that."""
    found = {}
    for one in [printed(one, who, "full") for one in inputs(drive)]:
        part, told = "", found.setdefault(one.title, {})
        for first, *others in ([cell.text for cell in row] for row in one.rows):
            if not any(others):
                part = first
            else:
                told[f"{part}: {first.strip()}" if first.startswith("\u2003") else first] = others
    return found


@pytest.mark.parametrize("name", example_names())
def test_every_key_of_a_part_has_its_row(name):
    given, told = tomllib.loads(example_text(name)), rows(example(name))
    for table, title in TITLES.items():
        parts = given.get(table, [])
        parts = parts if isinstance(parts, list) else [parts]
        keys = {key for one in parts for key, value in one.items() if key != "name" and value not in (0, 0.0, False)}
        plain = {key for key in keys if not any(isinstance(one.get(key), dict) for one in parts)}
        assert len(told.get(title, ())) >= len(plain), (title, plain)


def test_the_page_tells_the_drive_in_the_words_of_the_trade():
    told = rows(example("car-propshaft"))
    assert told["Duty"]["running time that the joints are to last"] == ["4\u202f000 h"]
    assert told["Duty cycle"]["torque"] == ["150 N·m", "300 N·m", "560 N·m"]
    joints = told["Sizes and ratings of the joints"]
    assert joints["size"] == ["example-75"]  # two joints of one size share a column
    assert joints["cross of the joint: distance between the middles of opposite bearings"] == ["58 mm"]
    assert "yokes of the joint: arm of the force for bending" not in joints  # the catalogue's, and no main size
    assert told["Tubes, materials, splines"]["sliding spline of the shaft: number of teeth"] == ["16"]


def test_figures_of_the_catalogue_say_where_they_come_from():
    said = list(sources(example("car-propshaft")))
    assert any(one.startswith("example-75: ") and "made up for examples" in one for one in said)
    assert any("GOST 1050-88" in one and "not confirmed" in one for one in said)
    assert not list(sources(example("truck-exact-yokes")))


def test_the_page_is_told_in_the_units_of_the_reader():
    who = Reader(units={"length": "in", "torque": "lbft"}, decimal=",")
    told = rows(example("car-propshaft"), who)
    assert told["Duty cycle"]["torque"][0].startswith("110,6 ")
    assert told["Tubes, materials, splines"]["outer diameter"] == ["2,992 in"]


def test_poses_and_movements_stand_on_the_page_with_what_they_change():
    told = rows(example("truck-rear-axle"))
    assert told["Poses"]["share of the whole time"] == ["35 %", "25 %", "40 %"]
    assert told["Poses"]["joint 2: centre"][0] == "1\u202f450 mm, 45 mm, −316 mm"
    assert told["Movements"]["amplitude of the shift"] == ["0 mm, 0 mm, 70 mm"]  # of a body; an arm has another one
    assert "joint 2, output" in next(inputs_heads(example("truck-rear-axle"), "Movements"))


def inputs_heads(drive, title):
    return (one.heading for table in inputs(drive) if table.title == title for one in table.columns[1:])
