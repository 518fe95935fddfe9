"""Pages for another reader: the same quantities in other units, none left in the usual ones."""

import re
from functools import cache

import numpy as np
import pytest

from cardan.answers.reader import Reader, reading
from cardan.figures.figure import Curve, Figure
from cardan.io import example, example_names
from cardan.register import QUESTIONS
from cardan.report.answers import answered, subject
from cardan.report.block import Cell, Listing, Page, Picture, Table
from cardan.units import DIMENSIONS, label

AMERICAN = {"length": "in", "angle": "rad", "angular_speed": "rad_s", "torque": "lbft", "force": "lbf", "stress": "psi"}

USUAL = tuple(next(iter(DIMENSIONS[one])) for one in AMERICAN)

QUICK = tuple(name for name, one in QUESTIONS.items() if one.quick and name not in ("selection", "phasing"))

LONG = {
    "unstable-drive": ("torsion", "orders", "stability"),
    "pto-drive": ("check", "bending"),
    "pto-hitch": ("articulation",),
}

QUOTED = re.compile(r"Kozhevnikov &|rating by|rule of practice|Hertz; 4000 MPa stands behind ISO 76")
"""How words begin that say by what rule a limit or a rating is, in the units of that rule."""

SI = {label(unit): factor for units in DIMENSIONS.values() for unit, factor in units.items() if label(unit)}


@cache
def pages(name: str, *, american: bool = False) -> tuple[Page, ...]:
    """Return pages of an example for a reader, made once."""
    on = subject(example(name))
    with reading(Reader(units=AMERICAN if american else {})):
        return tuple(answered(one, on) for one in (*QUICK, *LONG.get(name, ())))


def texts(one: object, *, files: bool = False):
    """Yield everything that a page says, but for files as they stand and the numbers in full."""
    if isinstance(one, str):
        yield one
    elif isinstance(one, tuple | list):
        for part in one:
            yield from texts(part, files=files)
    elif isinstance(one, Cell):
        yield one.text
    elif not isinstance(one, Listing) or files:
        for name in getattr(one, "__dataclass_fields__", ()):
            if name not in ("name", "role", "roles", "dash", "side", "level", "tone", "source", "title"):
                yield from texts(getattr(one, name), files=files)


@pytest.mark.slow
@pytest.mark.parametrize("name", example_names())
def test_no_unit_is_left_over(name):
    left = "|".join(re.escape(label(unit)) for unit in USUAL)
    held = re.compile(rf"(?:\d ?|^|\[)(?:{left})(?![\w²³·/])")
    for shown in pages(name, american=True):
        assert [text for text in texts(shown) if held.search(text) and not QUOTED.match(text)] == []
        assert {one.unit for block in shown.blocks if isinstance(block, Table) for one in block.columns}.isdisjoint(
            label(unit) for unit in USUAL
        )


@pytest.mark.slow
@pytest.mark.parametrize("name", ["car-propshaft", "instrument-joint", "unstable-drive", "pto-hitch", "pto-drive"])
def test_every_quantity_is_the_same_in_si(name):
    seen = 0
    for page, shown in zip(pages(name), pages(name, american=True), strict=True):
        for old, new in zip(page.blocks, shown.blocks, strict=True):
            if isinstance(old, Table):
                seen += same_table(old, new)
            elif isinstance(old, Picture):
                seen += same_figure(old.figure, new.figure)
    assert seen > 15


def same_table(old: Table, new: Table) -> int:
    seen = 0
    for before, after in zip(old.rows, new.rows, strict=True):
        units = [next((cell.text for cell in row if cell.text in SI and cell.text), "") for row in (before, after)]
        for column, other, cell, told in zip(old.columns, new.columns, before, after, strict=True):
            if not cell.full or column.heading == "utilisation":
                continue
            a, b = (SI.get(one.unit or unit) for one, unit in zip((column, other), units, strict=True))
            if a and b:
                assert float(told.full) * b == pytest.approx(float(cell.full) * a, rel=1e-12)
                seen += cell.full != told.full
    return seen


def same_figure(old: Figure, new: Figure) -> int:
    seen = 0
    for before, after in zip(old.panels, new.panels, strict=True):
        for one, told in zip(before.series, after.series, strict=True):
            for axis in "xy":
                a, b = (SI.get(getattr(panel, axis).unit) for panel in (before, after))
                if a and b and isinstance(one, Curve):
                    values = [np.asarray(getattr(part, axis)) * k for part, k in ((one, a), (told, b))]
                    assert values[1] == pytest.approx(values[0], rel=1e-12)
                    seen += a != b
        for axis in "xy":
            seen += same_axis(getattr(before, axis), getattr(after, axis))
    return seen


def same_axis(old, new) -> int:
    assert len(new.ticks) == len(new.texts)
    assert all(new.low - 1e-9 <= tick <= new.high + 1e-9 for tick in new.ticks)
    if old.unit not in SI or old.unit == new.unit:
        return 0
    assert (new.low * SI[new.unit], new.high * SI[new.unit]) == pytest.approx(
        (old.low * SI[old.unit], old.high * SI[old.unit]), rel=1e-12
    )
    return 1
