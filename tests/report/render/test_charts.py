"""Charts of a workbook: axes that fit what is drawn, bars whose names and words have room."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np

from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row, Rule
from cardan.report.block import Page, Picture
from cardan.report.content import Excerpt
from cardan.report.render.exports import figure_csv
from cardan.report.render.workbook import excerpt

from .test_workbook import CHART, opened, parts


def book_of(panel: Panel) -> bytes:
    """Return a workbook with the chart of a panel."""
    figure = Figure(name="one", title="one", sentence="", source="", rows=(Row(panels=(panel,)),))
    return excerpt(Excerpt(title="one", page=Page(name="one", title="one", answer="", blocks=[Picture(figure=figure)])))


def chart_in(data: bytes) -> ElementTree.Element:
    """Return the chart of a workbook."""
    (text,) = parts(data, "xl/charts/chart").values()
    return ElementTree.fromstring(text)


def chart_of(panel: Panel) -> ElementTree.Element:
    """Return the chart of a panel."""
    return chart_in(book_of(panel))


def ends_of(chart: ElementTree.Element, kind: str) -> list[tuple[float, float]]:
    """Return the ranges of the axes of a chart."""
    scales = [one.find(f"{CHART}scaling") for one in chart.iter(f"{CHART}{kind}")]
    return [tuple(float(one.find(f"{CHART}{end}").get("val")) for end in ("min", "max")) for one in scales]


def test_axes_begin_where_something_is_drawn() -> None:
    axis = Axis(label="force", unit="N", low=-0.3, high=4.3, ticks=(0.0, 2.0, 4.0), texts=("0", "2", "4"))
    rising, below = (Curve(x=np.asarray([0.0, 4.0]), y=np.asarray([low, 4.0])) for low in (0.0, -0.2))
    assert ends_of(chart_of(Panel(series=(rising,), x=axis, y=axis)), "valAx") == [(0.0, 4.0), (0.0, 4.0)]
    assert ends_of(chart_of(Panel(series=(below,), x=axis, y=axis)), "valAx") == [(0.0, 4.0), (-2.0, 4.0)]


def test_bars_over_decades_stand_between_powers_of_ten_with_their_words_above() -> None:
    kinds = Axis(label="order", low=0.4, high=2.6, ticks=(1.0, 2.0), texts=("2", "4"))
    along = Axis(label="amplitude", unit="°", low=4e-5, high=0.033, ticks=(1e-4, 1e-2), texts=("", ""), log=True)
    bars = Bars(at=np.asarray([1.0, 2.0]), size=np.asarray([0.02, 1e-4]), texts=("0.02°", "0.0001°"))
    chart = chart_of(Panel(series=(bars,), x=kinds, y=along))
    assert ends_of(chart, "valAx") == [(1e-5, 0.1)]
    (title,) = (one.text for one in chart.find(f"{CHART}chart/{CHART}title").iter(f"{CHART}v"))
    assert title == "Amplitude"
    ((words_of,),) = ([*one.iter(f"{CHART}dLbls")] for one in chart.iter(f"{CHART}lineChart"))
    assert {one.get("val") for one in words_of.iter(f"{CHART}dLblPos")} == {"t"}
    assert not [*chart.find(f".//{CHART}barChart").iter(f"{CHART}dLbls")]


def test_lying_bars_have_room_and_stand_before_the_track_up_to_their_limit() -> None:
    count = 20
    names = tuple(f"check {k}" for k in range(count))
    kinds = Axis(low=-0.5, high=count - 0.5, ticks=tuple(map(float, range(count))), texts=names)
    along = Axis(label="share", low=0.0, high=1.2, ticks=(0.0, 1.0), texts=("0", "1"))
    bars = Bars(at=np.arange(20.0), size=np.asarray([1.1] + [0.5] * (count - 1)), lying=True)
    data = book_of(Panel(series=(bars, Rule(value=1.0, upright=True)), x=along, y=kinds))
    limit, share, outline = chart_in(data).iter(f"{CHART}ser")
    assert [one.text for one in outline.find(f"{CHART}val").iter(f"{CHART}v")] == ["1"]
    assert (
        outline.find(f"{CHART}spPr").find("{http://schemas.openxmlformats.org/drawingml/2006/main}noFill") is not None
    )
    assert [one.text for one in limit.find(f"{CHART}val").iter(f"{CHART}v")] == ["1"] * count
    assert [one.text for one in share.find(f"{CHART}val").iter(f"{CHART}v")] == ["0.5"] * (count - 1) + ["1.1"]
    size = chart_in(data).find(f".//{CHART}catAx//{{http://schemas.openxmlformats.org/drawingml/2006/main}}defRPr")
    assert size.get("sz") == "800"
    (drawn,) = opened(data).worksheets[0]._charts
    assert drawn.anchor.to.row - drawn.anchor._from.row >= count * 16 // 21


def test_curves_of_one_name_stand_in_the_legend_once() -> None:
    curves = [Curve(x=np.arange(3.0), y=np.arange(3.0) + k, label=name) for k, name in enumerate(("a", "b", "b", "b"))]
    chart = chart_of(Panel(series=curves))
    gone = [int(one.find(f"{CHART}idx").get("val")) for one in chart.iter(f"{CHART}legendEntry")]
    assert gone == [2, 3]


def test_bars_that_are_cut_have_their_true_length_among_the_numbers() -> None:
    kinds = Axis(low=0.5, high=2.5, ticks=(1.0, 2.0), texts=("a", "b"))
    along = Axis(label="share", low=0.0, high=12.0, ticks=(0.0, 5.0, 10.0), texts=("0", "5", "10"))
    bars = Bars(at=np.asarray([1.0, 2.0]), size=np.asarray([3.0, 42.0]), lying=True, most=10.0)
    data = book_of(Panel(series=(bars,), x=along, y=kinds))
    rows = [row[1:3] for row in opened(data).worksheets[1].iter_rows(min_row=5, values_only=True)]
    assert rows == [("share", "as drawn"), (None, None), (42, 10), (3, 3)]
    (drawn,) = chart_in(data).iter(f"{CHART}ser")
    assert [one.text for one in drawn.find(f"{CHART}val").iter(f"{CHART}v")] == ["10", "3"]


def stacked() -> Figure:
    """Return a figure of two panels whose legend stands with the first, and a mark without a name."""
    names = ("shaft 1", "shaft 2")
    first = [Curve(x=np.arange(3.0), y=np.arange(3.0) + k, label=one, role=one) for k, one in enumerate(names)]
    second = [Curve(x=np.arange(3.0), y=np.arange(3.0) * k, role=one) for k, one in enumerate(names)]
    dot = Curve(x=np.ones(1), y=np.ones(1), role="ink", width=0.0, marker=4.0)
    upright = Axis(label="force", unit="N")
    panels = Panel(series=(Rule(value=0.5), *first), y=upright), Panel(series=(*second, dot), y=upright)
    rows = tuple(Row(panels=(panel,)) for panel in panels)
    return Figure(name="two", title="two", sentence="", source="", rows=rows)


def test_each_chart_has_a_legend_and_each_column_the_name_that_it_has_there() -> None:
    page = Page(name="two", title="two", answer="", blocks=[Picture(figure=stacked())])
    data = excerpt(Excerpt(title="two", page=page))
    sheet = opened(data).worksheets[1]
    heads = [cell.value for cell in sheet[5]]
    names = ["x", "shaft 1", "shaft 2"]
    assert heads == [*names, None, "x", "force", None, *names, None, "x", "line"]
    beside = "Lines and marks beside the curves"
    assert [k for k, cell in enumerate(sheet[4]) if cell.value == beside] == [4, 11]
    for text in parts(data, "xl/charts/chart").values():
        chart = ElementTree.fromstring(text)
        gone = {int(one.find(f"{CHART}idx").get("val")) for one in chart.iter(f"{CHART}legendEntry")}
        assert chart.find(f".//{CHART}legend") is not None
        assert len([*chart.iter(f"{CHART}ser")]) - len(gone) == 2


def test_a_csv_names_the_curves_of_the_lower_panels_too() -> None:
    assert figure_csv(stacked()).splitlines()[7].split(",")[:3] == ["x", "shaft 1 [N]", "shaft 2 [N]"]


def test_only_numbers_that_fill_pages_are_not_printed() -> None:
    short, long = (
        opened(book_of(Panel(series=(Curve(x=np.arange(n), y=np.arange(n)),)))).worksheets[1] for n in (60.0, 61.0)
    )
    assert not short.print_area
    assert "too many" not in short["A2"].value
    assert long.print_area
    assert "too many to be printed" in long["A2"].value


def test_decades_are_written_in_one_way() -> None:
    kinds = Axis(low=0.4, high=1.6, ticks=(1.0,), texts=("2",))
    for low, form in ((1e-9, "0E+00"), (1e-2, "General"), (1.0, "#,##0")):
        along = Axis(label="size", low=low, high=10.0, ticks=(low,), texts=("",), log=True)
        chart = chart_of(Panel(series=(Bars(at=np.ones(1), size=np.ones(1)),), x=kinds, y=along))
        assert {one.get("formatCode") for one in chart.find(f".//{CHART}valAx").iter(f"{CHART}numFmt")} == {form}


def test_long_names_of_many_bars_are_smaller_so_that_none_takes_two_lines() -> None:
    names = tuple(f"{k} {'torque of the composite tube of shaft 2'}" for k in range(16))
    kinds = Axis(low=-0.5, high=15.5, ticks=tuple(map(float, range(16))), texts=names)
    along = Axis(label="share", low=0.0, high=1.2, ticks=(0.0, 1.0), texts=("0", "1"))
    chart = chart_of(Panel(series=(Bars(at=np.arange(16.0), size=np.ones(16), lying=True),), x=along, y=kinds))
    size = chart.find(f".//{CHART}catAx//{{http://schemas.openxmlformats.org/drawingml/2006/main}}defRPr")
    assert size.get("sz") == "700"
