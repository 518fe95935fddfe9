"""Every question of the register is told on every surface, in both languages and in other units."""

import re
from functools import cache

import pytest

from cardan.answers.reader import Reader, reading
from cardan.errors import InputError
from cardan.io import example, example_names
from cardan.register import QUESTIONS
from cardan.report.block import Table, shown
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

READERS = {"en": ("en", Reader()), "ru": ("ru", Reader(keys="page")), "inches": ("en", AMERICAN)}
"""Who reads: language, units, decimal sign, and how parts are counted."""

FEW = ("single-20deg", "overconstrained-pump")
"""Examples that are quick; the others are asked when there is time."""

LEFT = "|".join(re.escape(label(next(iter(DIMENSIONS[one])))) for one in AMERICAN.units)
USUAL = re.compile(rf"(?:\d ?|^|\[|  )(?:{LEFT})(?![\w²³·/])")
"""A usual unit behind a number, alone or at the head of a column."""

USUAL_KEY = re.compile(
    rf"(?<!_per)(?<!_g)(?<!_rpm)_(?:{'|'.join(next(iter(DIMENSIONS[one])) for one in AMERICAN.units)})$"
)
"""A key of JSON with a usual unit; per degree, g·mm and rpm times degrees are units of their own."""

OF_FILE = re.compile(r"[.\[]|^joint_angle_deg$")
"""A key of JSON that is a key of the drive file: an axis of a map, what was varied."""

QUOTED = re.compile(
    r"Kozhevnikov &|rating by|Hertz; 4000 MPa stands behind ISO 76|rule of practice|A yoke 1° off|δ\(γ ± 1°\)"
)
"""How words begin that say by what rule a limit or a rating is, in the units of that rule, or what a degree does."""

FROM_ZERO = re.compile(r"\w\[\d+\]")
"""A part as a file counts it."""

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


def heavy(name, one, who):
    """Tell whether a page is written as a file too: for each reader in turn, so that all have had it in the end."""
    turn = example_names().index(name) + list(QUESTIONS).index(one) + list(READERS).index(who)
    return name in FEW or turn % 3 == 0


@pytest.mark.slow
@examples
def test_every_question_is_told_on_every_surface(name, monkeypatch):
    """To all readers in one test, so that every answer is computed once."""
    monkeypatch.setenv("COLUMNS", "100")
    for who, (language, reader) in READERS.items():
        with speaking(language), reading(reader):
            found = [told_on_every_surface(name, who, *one) for one in answers(name)]
        assert found, who


def told_on_every_surface(name, who, one, question, drive, result):
    """Tell the answer to a question on every surface to a reader, and look at what is said."""
    reader, where = READERS[who][1], (who, one)
    told = question.answer(drive, result)
    page = surfaces.page(question, drive)
    if who == "en":
        assert [one.text for one in told.remarks if surfaces.sentences(shown(one.text)) > 1] == [], where
    printed, tree = surfaces.terminal(told, drive), surfaces.as_data(told, reader)
    assert printed, where
    assert surfaces.csv(told, reader) or not told.tables, where
    assert "<" in surfaces.app(page) or not page.blocks, where
    said = list(surfaces.texts(page))
    if reader.keys == "page":
        assert [text for text in said if FROM_ZERO.search(text)] == [], where
    if heavy(name, one, who):
        assert "<html" in surfaces.report(page), where
        cells = surfaces.workbook(page)
        assert page.title in cells, where
        said += cells
    assert [text for text in [*said, *printed.splitlines()] if "{" in text or "}" in text] == [], where
    if who == "inches":
        no_usual_unit_is_left(page, [*said, *printed.splitlines()], tree)
    return True


def no_usual_unit_is_left(page, said, tree):
    assert [text for text in said if USUAL.search(text) and not QUOTED.search(text)] == []
    tables = [block for block in page.blocks if isinstance(block, Table)]
    assert [one.unit for block in tables for one in block.columns if USUAL.search(one.unit)] == []
    numbers = [cell.text for block in tables for row in block.rows for cell in row if cell.amount is not None]
    assert [text for text in (*numbers, page.answer) if POINT.search(text)] == []
    keys = {key for key, _value in surfaces.leaves(tree)}
    assert [key for key in keys if USUAL_KEY.search(key) and not OF_FILE.search(key)] == []
