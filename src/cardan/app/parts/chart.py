"""A figure as a chart to point at and to zoom, updated in place."""

from __future__ import annotations

import json
from array import array
from base64 import b64encode
from collections.abc import Iterable, Mapping
from math import nan
from typing import Any

import nicegui.elements.plotly  # noqa: F401  registers the plotly.js that NiceGUI ships, as "nicegui-plotly"
from nicegui.element import Element

from cardan.figures import Figure
from cardan.figures.palette import DARK
from cardan.figures.render_plotly import described


class Chart(Element, component="chart.js"):
    """A figure that can be pointed at.

    Curves over the input angle show where the drive stands: the window's event ``cardan-angle`` with ``detail.angle``
    [rad] moves their cursor, and pressing on them sends ``cardan-go-to``. The server has no part in it.
    """

    def __init__(self, figure: Figure) -> None:
        super().__init__()
        # Within a tuple NiceGUI does not watch every number of it, which takes longer than the motion of the drive.
        self._props.update(dark=DARK, label=figure.spoken, spec=(described(figure),))

    def show(self, figure: Figure) -> None:
        """Show another figure in its place; what the user zoomed stays zoomed."""
        spec, label = described(figure), figure.spoken
        change = changed(self._props["spec"][0], spec)
        if not change and label == self._props["label"]:
            return
        with self._props.suspend_updates():
            self._props.update(spec=(spec,), label=label)
        self.run_method("change", json.dumps({"label": label, **change}, ensure_ascii=False, separators=(",", ":")))


def changed(before: Mapping[str, Any], after: Mapping[str, Any]) -> dict[str, Any]:
    """Return what turns a described figure into another one.

    before, after: as `cardan.figures.render_plotly.described` gives them.
    Returns: ``heights``: place of a curve -> its values as base 64 of their bytes, where nothing but these differs in
    the data; else ``data``. ``layout`` where that differs.

    >>> line = {"mode": "lines", "x": [0, 1], "y": [2, 3]}
    >>> changed({"data": [line], "layout": {}}, {"data": [line | {"y": [2, 4]}], "layout": {}})
    {'heights': {0: 'AAAAAAAAAEAAAAAAAAAQQA=='}}
    """
    change: dict[str, Any] = {} if before["layout"] == after["layout"] else {"layout": after["layout"]}
    old, new = before["data"], after["data"]
    if len(old) == len(new) and all(_same_but_height(*pair) for pair in zip(old, new, strict=True)):
        heights = {k: _bytes(now["y"]) for k, now in enumerate(new) if now != old[k]}
        return change | ({"heights": heights} if heights else {})
    return change | {"data": new}


def _same_but_height(old: Mapping[str, Any], new: Mapping[str, Any]) -> bool:
    """Return whether two traces are the same curve but for its values."""
    return old == new or (new.get("mode") == "lines" and {**old, "y": ()} == {**new, "y": ()})


def _bytes(values: Iterable[float | None]) -> str:
    """Return numbers as they are in a machine, the missing ones as NaN: shorter than as text, and sooner read."""
    return b64encode(array("d", (nan if value is None else value for value in values)).tobytes()).decode()
