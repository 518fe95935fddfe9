"""Pages in units of a choice: the same quantities, told otherwise."""

import re
from functools import cache

import numpy as np
import pytest

from cardan.figures import Figure
from cardan.figures.figure import Axis, Bars, Curve, Panel, Row
from cardan.io import example, example_names
from cardan.report.answers import ANSWERS, answered, subject
from cardan.report.block import Cell, Column, Listing, Page, Picture, Points, Table, Words
from cardan.report.preferred import in_choice, names_in
from cardan.texts import speaking
from cardan.units import DIMENSIONS, label

AMERICAN = {"length": "in", "angle": "rad", "angular_speed": "rad_s", "torque": "lbft", "force": "lbf", "stress": "psi"}

USUAL = tuple(next(iter(DIMENSIONS[one])) for one in AMERICAN)

QUICK = tuple(name for name, one in ANSWERS.items() if one.quick and name not in ("selection", "phasing"))

LONG = {
    "unstable-drive": ("torsion", "orders", "stability"),
    "pto-drive": ("limits", "bending"),
    "pto-hitch": ("articulation",),
}

SI = {label(unit): factor for units in DIMENSIONS.values() for unit, factor in units.items() if label(unit)}


@cache
def pages(name: str) -> tuple[Page, ...]:
    """Return pages of an example, made once."""
    on = subject(example(name))
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


@pytest.mark.parametrize("name", example_names())
def test_no_unit_is_left_over(name):
    left = "|".join(re.escape(label(unit)) for unit in USUAL)
    held = re.compile(rf"(?:\d ?|^|\[)(?:{left})(?![\w²³·/])")
    for page in pages(name):
        shown = in_choice(page, AMERICAN, names=names_in(example(name)))
        assert [text for text in texts(shown) if held.search(text)] == []
        assert {one.unit for block in shown.blocks if isinstance(block, Table) for one in block.columns}.isdisjoint(
            label(unit) for unit in USUAL
        )


@pytest.mark.parametrize("name", ["car-propshaft", "instrument-joint", "unstable-drive", "pto-hitch", "pto-drive"])
def test_every_quantity_is_the_same_in_si(name):
    seen = 0
    for page in pages(name):
        shown = in_choice(page, AMERICAN)
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


def test_panels_above_one_another_share_their_angle():
    figure = next(one.figure for one in pages("car-propshaft")[0].blocks if isinstance(one, Picture))
    shown = in_choice(figure, {"angle": "rad"})
    assert [panel.x.high for panel in shown.panels] == pytest.approx([2.0 * np.pi] * 3)
    assert [panel.x.unit for panel in shown.panels] == ["", "", "rad"]


def test_bars_lie_along_the_unit_of_their_heading():
    bars = Bars(at=np.asarray([1.0]), size=np.asarray([500.0]), texts=("500",), lying=True, thick=0.5)
    panel = Panel(series=(bars,), x=Axis(high=600.0, ticks=(0.0, 600.0), texts=("0", "600")), title="Heat [W]")
    shown = in_choice(Figure(name="", title="", sentence="", source="", rows=(Row(panels=(panel,)),)), {"power": "kW"})
    told = shown.panels[0]
    assert (told.title, told.x.high, told.y) == ("Heat [kW]", pytest.approx(0.6), panel.y)
    assert (told.series[0].size[0], told.series[0].thick, told.series[0].texts) == (
        pytest.approx(0.5),
        0.5,
        ("0.5000",),
    )


@pytest.mark.parametrize("language", ["en", "ru"])
def test_a_row_follows_the_unit_that_it_names(language):
    with speaking(language):
        columns = (Column(heading="what", left=True), Column(heading="value"), Column(heading="", left=True))
        row = [Cell(text="gap"), Cell(text="25.4", full="25.4"), Cell(text=label("mm"))]
        told = in_choice(Table(columns=columns, rows=[row]), {"length": "in"}, ",").rows[0]
        assert [one.text for one in told] == ["gap", "1,000", label("in")]
        assert float(told[1].full) == pytest.approx(1.0, rel=1e-15)


def test_what_stands_in_a_file_stays():
    columns = tuple(Column(heading=one) for one in ("key", "now", "to"))
    cures = Table(
        columns=columns, rows=[[Cell(text="joints[1].centre_mm"), Cell(text="12.5", full="12.5"), Cell(text="13.5")]]
    )
    page = Page(
        name="x",
        title="T",
        answer="Set joints[1].centre_mm: 12.5 mm.",
        blocks=(Listing(title="file", text="wall_mm = 2.5 # 2.5 mm"), cures, Points(title="", items=("2.5 mm",))),
    )
    shown = in_choice(page, {"length": "in"}, ",")
    assert shown.answer == "Set joints[1].centre_mm: 0,492 in."
    assert shown.blocks[0] is page.blocks[0]
    assert [one.text for one in shown.blocks[1].rows[0]] == ["joints[1].centre_mm", "12.5", "13.5"]
    assert shown.blocks[2].items == ["0,0984 in"]


def test_nothing_to_change_gives_the_same_object():
    page = Page(name="x", title="T", answer="12.5 mm", blocks=(Words(text="1.5"),))
    assert in_choice(page, {"length": "mm"}) is page
