"""Every question of the register is told on every surface, in both languages and in other units."""

import re
from functools import cache

import pytest

from cardan.answers.reader import Reader, reading
from cardan.errors import InputError
from cardan.io import example, example_names
from cardan.register import QUESTIONS
from cardan.report.block import Table
from cardan.texts import speaking
from cardan.units import DIMENSIONS, label

from . import surfaces

AMERICAN = Reader(
    units={
        "length": "in",
        "angle": "rad",
        "angular_speed": "rad_s",
        "torque": "lbft",
        "force": "lbf",
        "stress": "psi",
    },
    decimal=",",
)

READERS = {"en": ("en", Reader()), "ru": ("ru", Reader()), "inches": ("en", AMERICAN)}
"""Who reads: language, units and decimal sign."""

FEW = ("single-20deg", "overconstrained-pump")
"""Examples that are quick; the others are asked when there is time."""

LEFT = "|".join(re.escape(label(next(iter(DIMENSIONS[one])))) for one in AMERICAN.units)
USUAL = re.compile(rf"(?:\d ?|^|\[|  )(?:{LEFT})(?![\w²³·/])")
"""A usual unit behind a number, alone or at the head of a column."""

USUAL_KEY = re.compile(rf"_(?:{'|'.join(next(iter(DIMENSIONS[one])) for one in AMERICAN.units)})$")
"""A key of JSON with a usual unit."""

QUOTED = re.compile(r"Book \(|rating by|Hertz; 4000 MPa stands behind ISO 76")
"""How words begin that say by what rule a limit or a rating is, in the units of that rule."""

POINT = re.compile(r"(?<![\w.])\d+\.\d+(?![\w.])")
"""A number with a decimal point."""


@cache
def asked(name):
    """Return an example and its questions, each of which computes once."""
    return example(name), {one: surfaces.once(question) for one, question in QUESTIONS.items()}


def answers(name):
    """Yield every question that has an answer, with the result of it, for an example."""
    drive, questions = asked(name)
    for one, question in questions.items():
        if question.lacking(drive):
            continue
        try:
            result = question.ask(drive)
        except InputError:
            continue
        if result is not None:
            yield one, question, drive, result


def examples(test):
    """Ask for every example, most of them slow."""
    every = [name if name in FEW else pytest.param(name, marks=pytest.mark.slow) for name in example_names()]
    return pytest.mark.parametrize("name", every)(test)


@pytest.mark.parametrize("who", READERS)
@examples
def test_every_question_is_told_on_every_surface(name, who, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    language, reader = READERS[who]
    found = 0
    with speaking(language), reading(reader):
        for one, question, drive, result in answers(name):
            told = question.answer(drive, result)
            page = surfaces.page(question, drive)
            printed, tree = surfaces.terminal(told, drive), surfaces.as_data(told, reader)
            assert surfaces.csv(told, reader) or not told.tables, one
            assert "<html" in surfaces.report(page), one
            assert "<" in surfaces.app(page) or not page.blocks, one
            cells = surfaces.workbook(page)
            said = [*surfaces.texts(page), *cells]
            assert page.title in cells, one
            assert printed, one
            assert [text for text in [*said, *printed.splitlines()] if "{" in text or "}" in text] == [], one
            if who == "inches":
                no_usual_unit_is_left(page, said, printed, tree)
            found += 1
    assert found


def no_usual_unit_is_left(page, said, printed, tree):
    lines = [*said, *printed.splitlines()]
    assert [text for text in lines if USUAL.search(text) and not QUOTED.match(text)] == []
    assert [text for text in lines if POINT.search(text)] == []
    units = {one.unit for block in page.blocks if isinstance(block, Table) for one in block.columns}
    assert [unit for unit in units if USUAL.search(unit)] == []
    assert [key for key, _value in surfaces.leaves(tree) if USUAL_KEY.search(key)] == []
