"""Charts of a workbook: axes that fit what is drawn, bars whose names and words have room."""

from __future__ import annotations

from xml.etree import ElementTree

import numpy as np

from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row, Rule
from cardan.report.block import Page, Picture
from cardan.report.content import Excerpt
from cardan.report.workbook import excerpt

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
    bars = Bars(at=np.arange(20.0), size=np.full(count, 0.5), lying=True)
    data = book_of(Panel(series=(bars, Rule(value=1.0, upright=True)), x=along, y=kinds))
    limit, share = chart_in(data).iter(f"{CHART}ser")
    assert [one.text for one in limit.find(f"{CHART}val").iter(f"{CHART}v")] == ["1"] * count
    assert [one.text for one in share.find(f"{CHART}val").iter(f"{CHART}v")] == ["0.5"] * count
    (drawn,) = opened(data).worksheets[0]._charts
    assert drawn.anchor.to.row - drawn.anchor._from.row >= count * 16 // 21


def test_curves_of_one_name_stand_in_the_legend_once() -> None:
    curves = [Curve(x=np.arange(3.0), y=np.arange(3.0) + k, label=name) for k, name in enumerate(("a", "b", "b", "b"))]
    chart = chart_of(Panel(series=curves))
    gone = [int(one.find(f"{CHART}idx").get("val")) for one in chart.iter(f"{CHART}legendEntry")]
    assert gone == [2, 3]
