"""Draws any figure with plotly: a page to point at, zoom and turn, that needs no network."""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape

from cardan.answers.reader import reader
from cardan.later import later
from cardan.texts import language

from . import palette
from .figure import Axis, Figure
from .page import laid_out
from .plotly_panel import Look, PanelWriter, Spec, runs

plotly = later("plotly.offline")

INCH = 118.0
"""Pixels of the screen per inch of print."""

FONT = "Inter, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif"


def render(figures: Figure | Sequence[Figure]) -> str:
    """Return a page with figures, the drawing program included."""
    several = (figures,) if isinstance(figures, Figure) else tuple(figures)
    blocks = "\n".join(
        f"<figure><figcaption><h1>{escape(figure.title)}</h1></figcaption>{fragment(figure)}"
        f"<p>{_caption(figure)}</p></figure>"
        for figure in several
    )
    title = escape(several[0].title if several else "cardan")
    style = (
        f"body{{margin:2rem auto;max-width:{INCH * 7.6:.0f}px;font-family:{FONT};color:{palette.colour('ink')}}}"
        "h1{font-size:1.1rem;margin:0}figure{margin:0 0 2.5rem}p{margin:.2rem 0;color:#5a6474}"
    )
    return (
        f'<!doctype html>\n<html lang="{language()}"><head><meta charset="utf-8"><title>{title}</title>'
        f"<style>{style}</style>"
        f"<script>{program()}</script></head><body>\n{blocks}\n</body></html>\n"
    )


def _caption(figure: Figure) -> str:
    """Return what stands below a figure; many have no sentence of their own."""
    lines = [escape(figure.sentence)] if figure.sentence else []
    return "<br>".join([*lines, f"<small>{escape(figure.source)}</small>"])


def program() -> str:
    """Return the drawing program, to be put into a page once."""
    return str(plotly().get_plotlyjs()).replace("</script", "<\\/script")


def fragment(figure: Figure) -> str:
    """Return the element of one figure for a page that has the `program`."""
    spec = described(figure)
    text = json.dumps(spec, separators=(",", ":"), allow_nan=False).replace("</", "<\\/")
    height = spec["layout"]["height"]
    name = f"figure-{escape(figure.name)}"
    config = '{"displaylogo":false,"responsive":true,"modeBarButtonsToRemove":["lasso2d","select2d"]}'
    return (
        f'<div id="{name}" style="height:{height:.0f}px" role="img" aria-label="{escape(figure.spoken)}"></div>'
        f"<script>(function(f){{Plotly.newPlot({json.dumps(name)},f.data,f.layout,{config})}})({text})</script>"
    )


def same_span(one: Axis, other: Axis) -> bool:
    """Return whether two axes have the same range."""
    return (one.low, one.high) == (other.low, other.high)


def described(figure: Figure) -> Spec:
    """Return a figure as plotly's data and layout."""
    page = laid_out(figure, words=False)
    together = all(map(runs, figure.panels))
    spec: Spec = {
        "data": [],
        "layout": {
            "height": page.height * INCH,
            "margin": {"l": 0, "r": 34, "t": 0, "b": 0},
            "modebar": {"orientation": "v", "color": "#c5ccd6", "bgcolor": "rgba(0,0,0,0)"},
            "font": {"family": FONT, "size": 12, "color": palette.colour("ink")},
            "paper_bgcolor": "white",
            "plot_bgcolor": "rgba(0,0,0,0)",
            "hovermode": "x unified" if together else "closest",
            "hoverlabel": {"bgcolor": palette.colour("paper"), "font": {"size": 12, "color": palette.colour("ink")}},
            "separators": f"{reader().sign} ",
            "showlegend": bool(page.legend),
            "legend": {"orientation": "h", "x": 0.0, "xanchor": "left", "y": 1.0, "yanchor": "top"},
            "shapes": [],
            "annotations": [],
            # Tails of the axes, as in "xaxis2", along which the input angle runs, along which the time of a movement
            # does, and where circles must stay round; the width at which it is laid out.
            "meta": {"turning": [], "timed": [], "equal": [], "width": page.width * INCH},
        },
    }
    named: dict[str, Look] = {}
    for number, (panel, box) in enumerate(page.panels, start=1):
        along = next((one.x.unit for one in figure.panels if one.x.unit and same_span(one.x, panel.x)), "")
        PanelWriter(spec, page, panel, box, number, named, along=along, together=together).draw()
    return spec
