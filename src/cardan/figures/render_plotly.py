"""Draws any figure with plotly: a page to point at, zoom and turn, that needs no network."""

from __future__ import annotations

import json
from collections.abc import Sequence
from html import escape
from typing import Any, TypeAlias

import numpy as np

from cardan.answers import palette
from cardan.answers.reader import reader
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.texts import language
from cardan.units import label as printed

from .figure import Axis, Band, Bars, Cells, Curve, Figure, Mesh, Note, Panel, Rule, Series, Shape
from .page import Box, Label, Page, facets, labels, laid_out, onto, ranges

Spec: TypeAlias = dict[str, Any]
Look: TypeAlias = tuple[str, ...]  # role and dash of a curve; nothing of what is no curve

LEAST_LETTER = 12.0  # pixels of the letters of a note at least
LINE = 15.0  # pixels of a line of the words beside upright rules

_DASHES = {"solid": "solid", "dashed": "dash", "dotted": "dot", "dashdot": "dashdot"}
_SIDES = {"left": "left", "centre": "center", "right": "right"}


class PanelWriter:
    """Puts one panel into the spec.

    spec: data and layout of the whole figure, added to; page: the laid-out figure; box: where.
    number: number of the panel, from 1; named: labels that stand in the legend already and how
    what they name looks, added to.
    along: unit of the axis that runs to the right, where it is that of another panel; together: whether one box tells
    the values of all curves where somebody points.
    """

    def __init__(
        self,
        spec: Spec,
        page: Page,
        panel: Panel,
        box: Box,
        number: int,
        named: dict[str, Look],
        *,
        along: str = "",
        together: bool = False,
    ) -> None:
        self.along, self.together = panel.x.unit or along, together
        self.data: list[Spec] = spec["data"]
        self.layout: Spec = spec["layout"]
        self.panel = panel
        self.box = box
        self.tail = "" if number == 1 else str(number)
        self.named = named
        self.across = [box.left / page.width, (box.left + box.width) / page.width]
        self.upright = [1.0 - (box.top + box.height) / page.height, 1.0 - box.top / page.height]
        self.space = panel.view is not None and panel.view.turnable
        self.reach = reach(panel) if self.space else 1.0

    def draw(self) -> None:
        """Draw frame, heading and series."""
        if self.space:
            self.layout[f"scene{self.tail}"] = scene(self.panel, self.box, self.across, self.upright)
        else:
            self._axes()
        if self.panel.equal:
            self.layout["meta"]["equal"].append(self.tail)
        if self.panel.heading:
            place = {"x": self.across[0], "y": self.upright[1], "xref": "paper", "yref": "paper"}
            how = {"xanchor": "left", "yanchor": "bottom", "showarrow": False, "font": {"size": 12.5}}
            self.layout["annotations"].append({"text": f"<b>{escape(self.panel.heading)}</b>", **place, **how})
        meshes = [item for item in self.panel.series if isinstance(item, Mesh)]
        if meshes and not self.space:
            self._faces(meshes)
        beside = {} if self.space else labels(self.panel, self.box)
        for k, item in enumerate(self.panel.series):
            self.label = beside.get(k, Label())
            if self.space:
                traces, words = in_space(item, f"scene{self.tail}", self.reach)
                self.data.extend(traces)
                self.layout[f"scene{self.tail}"]["annotations"].extend(words)
            else:
                self._flat(item)

    def _axes(self) -> None:
        panel = self.panel
        x, y = ranges(panel, self.box)
        self.layout[f"xaxis{self.tail}"] = _axis(panel.x, x, panel.bare, self.across, f"y{self.tail}", panel.x.title)
        suffix = _behind(self.along) if self.together else ""
        self.layout[f"xaxis{self.tail}"] |= {"hoverformat": ".4r", "ticksuffix": suffix}
        self.layout[f"yaxis{self.tail}"] = _axis(panel.y, y, panel.bare, self.upright, f"x{self.tail}", "")
        for name, here in (("turning", panel.x.turning), ("timed", panel.x.timed)):
            if here:
                self.layout["meta"][name].append([self.tail, panel.x.scale])

    def _flat(self, item: Series) -> None:
        if isinstance(item, Curve):
            self._curve(item)
        elif isinstance(item, Bars):
            self._bars(item)
        elif isinstance(item, Shape):
            self._add(
                type="scatter",
                mode="lines",
                x=_list([*item.x, item.x[0]]),
                y=_list([*item.y, item.y[0]]),
                fill="toself",
                fillcolor=_faded(palette.colour(item.role), item.opacity),
                line={"width": item.outline, "color": palette.colour(item.role)},
                hoverinfo="skip",
                **self._named(item.label),
            )
        elif isinstance(item, Cells):
            self._cells(item)
        elif isinstance(item, Note):
            self._note(item)
        elif isinstance(item, Rule):
            line = {"color": palette.colour(item.role), "width": item.width * 1.3, "dash": _DASHES[item.dash]}
            self._shape(item, item.value, item.value, line=line, type="line")
        elif isinstance(item, Band):
            tint = palette.colour(item.role)
            self._shape(item, item.low, item.high, type="rect", fillcolor=tint, opacity=item.opacity, line={"width": 0})

    def _curve(self, item: Curve) -> None:
        x, y = item.x, item.y
        if item.z is not None and self.panel.view is not None:
            seen = onto(self.panel.view, np.stack(np.broadcast_arrays(item.x, item.y, item.z), axis=-1))
            x, y = seen[..., 0], seen[..., 1]
        tint = palette.colour(item.role)
        mode = "lines+markers" if item.width and item.marker else "markers" if item.marker else "lines"
        empty = not len(x)
        self._add(
            type="scatter",
            mode=mode,
            x=[None] if empty else _list(x),
            y=[None] if empty else _list(y),
            line={"color": tint, "width": item.width * 1.4, "dash": _DASHES[item.dash]},
            marker={"color": tint, "size": item.marker * 1.5},
            **({"hoverinfo": "skip"} if self.panel.bare else {"hovertemplate": self._pointed()}),
            **self._named(item.label, item.role, item.dash),
        )
        if item.arrow and len(x) > 1:
            places = {"x": float(x[-1]), "y": float(y[-1]), "ax": float(x[-2]), "ay": float(y[-2])}
            refs = {f"{a}{end}ref": f"{end}{self.tail}" for a in ("", "a") for end in "xy"}
            head = {"arrowhead": 2, "arrowsize": 1.2, "arrowwidth": max(1.0, item.width), "arrowcolor": tint}
            self.layout["annotations"].append({**places, **refs, "text": "", "showarrow": True, **head})

    def _pointed(self) -> str:
        """Return what stands beside the pointer: four digits with their units."""
        height = f"%{{y:.4r}}{_behind(self.panel.y.unit or self.panel.unit)}"
        return height if self.together else f"{height} @ %{{x:.4r}}{_behind(self.along)}"

    def _bars(self, item: Bars) -> None:
        lengths = [float(size) - (0.0 if self._log(item) else item.base) for size in item.ends]
        at = _list(item.at)
        self._add(
            type="bar",
            orientation="h" if item.lying else "v",
            x=lengths if item.lying else at,
            y=at if item.lying else lengths,
            **({} if self._log(item) else {"base": item.base}),
            width=item.thick,
            text=[escape(text) for text in item.texts] or None,
            textposition="outside",
            cliponaxis=False,
            marker={"color": [palette.colour(item.roles[k % len(item.roles)]) for k in range(len(at))]},
            hovertemplate="%{x:.4r}" if item.lying else f"%{{y:.4r}}{_behind(self.panel.y.unit or self.panel.unit)}",
            **self._named(item.label),
        )

    def _cells(self, item: Cells) -> None:
        self._add(
            type="heatmap",
            x=_list(item.x),
            y=_list(item.y),
            z=[_list(row) for row in item.values],
            zmin=float(item.low),
            zmax=float(item.high) if item.high > item.low else float(item.low) + 1.0,
            colorscale=[[k / 16.0, palette.scale(k / 16.0)] for k in range(17)],
            showscale=False,
            hovertemplate="%{z:.4r} @ %{x:.4r}, %{y:.4r}<extra></extra>",
        )

    def _log(self, item: Bars) -> bool:
        return self.panel.x.log if item.lying else self.panel.y.log

    def _note(self, item: Note) -> None:
        x, y = item.x, item.y
        if item.z is not None and self.panel.view is not None:
            seen = onto(self.panel.view, np.asarray([item.x, item.y, item.z]))
            x, y = float(seen[0]), float(seen[1])
        x = float(np.log10(x)) if self.panel.x.log else x
        y = float(np.log10(y)) if self.panel.y.log else y
        place = {"x": x, "y": y, "xref": f"x{self.tail}", "yref": f"y{self.tail}"}
        sides = {"xanchor": _SIDES[item.side], "yanchor": item.level}
        shift = {"xshift": 1.5 * item.shift[0], "yshift": 1.5 * item.shift[1], "showarrow": False}
        font = {"size": max(LEAST_LETTER, 1.45 * item.size), "color": palette.colour(item.role)}
        self.layout["annotations"].append({"text": _marked(item), **place, **sides, **shift, "font": font})

    def _shape(self, item: Rule | Band, low: float, high: float, **how: Any) -> None:
        """Add a rule or band across the panel, and its words at its upper or right end."""
        here = {"xref": f"x{self.tail}", "yref": f"y{self.tail}"}
        here["yref" if item.upright else "xref"] += " domain"
        ends = {"x0": low, "x1": high, "y0": 0, "y1": 1} if item.upright else {"x0": 0, "x1": 1, "y0": low, "y1": high}
        self.layout["shapes"].append({**ends, **here, "layer": "below", **how})
        if item.text:
            log = self.panel.x.log if item.upright else self.panel.y.log
            at = float(np.log10(high)) if log else high
            x, y, side, level = (at, 1.0, "left", "top") if item.upright else (1.0, at, "right", "bottom")
            font = {"size": 12, "color": palette.colour(item.role)}
            if item.upright and self.label.before:
                side = "right"
            place = {"x": x, "y": y, **here, "xanchor": side, "yanchor": level, "yshift": -LINE * self.label.line}
            self.layout["annotations"].append({"text": escape(item.text), "showarrow": False, "font": font, **place})

    def _faces(self, meshes: Sequence[Mesh]) -> None:
        assert self.panel.view is not None
        for facet in facets(self.panel.view, meshes):
            path = "L".join(f"{x:.5g},{y:.5g}" for x, y in facet.corners)
            look = {"fillcolor": facet.fill, "line": {"color": facet.edge, "width": 0.6}, "layer": "between"}
            here = {"xref": f"x{self.tail}", "yref": f"y{self.tail}"}
            self.layout["shapes"].append({"type": "path", "path": f"M{path}Z", **look, **here})
        # Shapes alone leave the axes empty; an unseen point keeps them.
        unseen = {"mode": "markers", "marker": {"opacity": 0}, "hoverinfo": "skip", "showlegend": False}
        self._add(type="scatter", x=[self.panel.x.low], y=[self.panel.y.low], **unseen)

    def _named(self, label: str, *look: str) -> Spec:
        """Return the name of a trace, in the legend where it is new; one without has that of what looks alike above."""
        first = bool(label) and label not in self.named
        if first:
            self.named[label] = look
        called = label or next((name for name, other in self.named.items() if look and other == look), "")
        group = {"legendgroup": called} if called else {}
        return {"name": escape(called or self.panel.y.label or self.panel.heading), "showlegend": first, **group}

    def _add(self, **trace: Any) -> None:
        self.data.append({**trace, "xaxis": f"x{self.tail}", "yaxis": f"y{self.tail}"})


def _behind(unit: str) -> str:
    """Return a unit as it stands behind a number."""
    return "" if unit in ("", "-", "–") else f" {escape(printed(unit))}"


def runs(panel: Panel) -> bool:
    """Return whether all that a panel shows runs from left to right, so that one box can tell all values at a place."""
    if panel.bare or panel.equal or panel.view is not None:
        return False
    return all(
        not isinstance(one, Cells)
        and not (isinstance(one, Bars) and one.lying)
        and not (isinstance(one, Curve) and bool(np.any(np.diff(np.asarray(one.x, dtype=float)) < 0.0)))
        for one in panel.series
    )


def _axis(one: Axis, span: tuple[float, float], bare: bool, domain: list[float], anchor: str, title: str) -> Spec:
    log = bool(one.log)
    made: Spec = {
        "range": [float(np.log10(v)) if log else float(v) for v in span],
        "type": "log" if log else "linear",
        "domain": domain,
        "anchor": anchor,
        "visible": not bare,
        "zeroline": False,
        "showgrid": one.grid,
        "gridcolor": palette.colour("grid"),
        "tickvals": [float(v) for v in one.ticks],
        "ticktext": list(one.texts) or [""] * len(one.ticks),
        "tickfont": {"size": 12, "color": palette.colour("muted")},
    }
    if title and not bare:
        made["title"] = {"text": escape(title), "font": {"size": 12, "color": palette.colour("muted")}, "standoff": 6}
    return made


def _list(values: Any) -> list[float | None]:
    every = np.asarray(values, dtype=float)
    told: list[float | None] = every.tolist()
    return told if bool(np.isfinite(every).all()) else [v if v is not None and np.isfinite(v) else None for v in told]


def _faded(hexadecimal: str, opacity: float) -> str:
    red, green, blue = (int(hexadecimal[k : k + 2], 16) for k in (1, 3, 5))
    return f"rgba({red},{green},{blue},{opacity:g})"


# A panel that looks at space as a scene of plotly's, which the reader can turn.

SCENE = 0.58
"""Share of a scene's height that a side of 1 of its box takes, seen without perspective."""

HEAD = (0.028, 0.4)
"""Length of an arrowhead: share of the scene's size, and of the arrow at most."""

SLIM = 0.36
"""Radius of an arrowhead over its length."""

CORNERS = 12
"""Corners of the foot of an arrowhead."""


def scene(panel: Panel, box: Box, across: list[float], upright: list[float]) -> Spec:
    """Return the layout of a scene: where it stands, how it is looked at.

    panel: with a view; box: where it stands on the page; across, upright: the same as shares of the page.
    """
    assert panel.view is not None
    return {
        "domain": {"x": across, "y": upright},
        **{f"{end}axis": {"visible": False} for end in "xyz"},
        "aspectmode": "manual",
        "aspectratio": _proportions(panel, box),
        "camera": {
            "projection": {"type": "orthographic"},
            "eye": dict(zip("xyz", (1.1 * v for v in panel.view.toward), strict=True)),
            "up": {"x": 0.0, "y": 0.0, "z": 1.0},
        },
        "annotations": [],
    }


def reach(panel: Panel) -> float:
    """Return the size of what stands in a scene, corner to corner."""
    found = _corners(panel)
    return float(np.linalg.norm(np.ptp(found, axis=0))) if len(found) else 1.0


def in_space(item: Series, name: str, reach: float) -> tuple[list[Spec], list[Spec]]:
    """Return the traces and the annotations of a series in space.

    item: what to draw; what is flat is left out.
    name: name of the scene; reach: size of the scene.
    """
    if isinstance(item, Mesh):
        tint = palette.mixed(palette.colour(item.role), "#ffffff", item.shade)
        return [_surface(item.corners, item.triangles, tint, name, item)], []
    if isinstance(item, Note) and item.z is not None:
        return [], [_word(item)]
    if isinstance(item, Curve) and item.z is not None:
        return _line(item, name, reach), []
    return [], []


def _surface(corners: Array, triangles: Any, tint: str, name: str, item: Mesh | None = None) -> Spec:
    i, j, k = np.asarray(triangles).T
    x, y, z = np.asarray(corners, dtype=float).T
    made: Spec = {
        "type": "mesh3d",
        **{"x": x.tolist(), "y": y.tolist(), "z": z.tolist(), "i": i.tolist(), "j": j.tolist(), "k": k.tolist()},
        "color": tint,
        "flatshading": item is not None and not item.smooth,
        "lighting": {"ambient": 0.75, "diffuse": 0.55, "specular": 0.05},
        "scene": name,
    }
    if item is None:
        return {**made, "hoverinfo": "skip"}
    if item.opacity < 1.0:
        made["opacity"] = item.opacity
    return {**made, "text": item.text, "hoverinfo": "text"}


def _marked(item: Note) -> str:
    return f"<b>{escape(item.text)}</b>" if item.bold else escape(item.text)


def _word(item: Note) -> Spec:
    return {
        "text": _marked(item),
        **{"x": item.x, "y": item.y, "z": item.z, "showarrow": False},
        **{"xshift": item.shift[0] * 1.5, "yshift": item.shift[1] * 1.5},
        "font": {"color": palette.colour(item.role), "size": 12},
        "bgcolor": "rgba(255,255,255,0.6)",
    }


def _line(item: Curve, name: str, reach: float) -> list[Spec]:
    x, y, z = (one.astype(float) for one in np.broadcast_arrays(item.x, item.y, np.asarray(item.z)))
    tint = palette.colour(item.role)
    mode = "lines+markers" if item.width and item.marker else "markers" if item.marker else "lines"
    made: list[Spec] = [
        {
            "type": "scatter3d",
            "mode": mode,
            **{"x": x.tolist(), "y": y.tolist(), "z": z.tolist()},
            "line": {"color": tint, "width": 2.0 * item.width},
            "marker": {"color": tint, "size": item.marker},
            **({"text": item.text, "hoverinfo": "text"} if item.text else {"hoverinfo": "skip"}),
            "showlegend": False,
            "scene": name,
        }
    ]
    points = np.stack((x, y, z), axis=-1)
    if item.arrow and len(points) > 1 and np.any(points[-1] != points[-2]):
        corners, triangles = _head(points[-2], points[-1], reach)
        made.append(_surface(corners, triangles, tint, name))
    return made


def _head(start: Array, tip: Array, reach: float) -> tuple[Array, Array]:
    """Return corners and triangles of the cone at the tip of an arrow."""
    way = tip - start
    long = float(np.linalg.norm(way))
    along = way / long
    size = min(HEAD[0] * reach, HEAD[1] * long)
    other = np.eye(3)[int(np.argmin(np.abs(along)))]
    right = np.cross(along, other)
    right /= np.linalg.norm(right)
    turn = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)[:, None]
    foot = tip - size * along
    ring = foot + SLIM * size * (np.cos(turn) * right + np.sin(turn) * np.cross(along, right))
    one = np.arange(CORNERS)
    two = (one + 1) % CORNERS
    apex, middle = np.full(CORNERS, CORNERS), np.full(CORNERS, CORNERS + 1)
    triangles = np.concatenate((np.stack((one, two, apex), axis=-1), np.stack((two, one, middle), axis=-1)))
    return np.concatenate((ring, tip[None], foot[None])), triangles


def _corners(panel: Panel) -> Array:
    """Return all points in space, array (m, 3)."""
    found = [np.asarray(item.corners) for item in panel.series if isinstance(item, Mesh)]
    for item in panel.series:
        if isinstance(item, Curve) and item.z is not None:
            found.append(np.stack(np.broadcast_arrays(item.x, item.y, item.z), axis=-1))
    return np.concatenate(found) if found else np.zeros((0, 3))


def _proportions(panel: Panel, box: Box) -> Spec:
    """Return the sides of the box around all that stands in it, as large as fills the panel when seen from `View`."""
    corners = _corners(panel)
    if not len(corners) or panel.view is None:
        return {"x": 1.0, "y": 1.0, "z": 1.0}
    sides, seen = np.ptp(corners, axis=0), np.ptp(onto(panel.view, corners), axis=0)
    scale = min(0.9 * box.width / box.height / float(seen[0]), 0.72 / float(seen[1])) / SCENE
    return dict(zip("xyz", (max(float(side) * scale, 1e-3) for side in sides), strict=True))


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
