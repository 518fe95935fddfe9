"""What the curves of a panel are called by the legend of their figure."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .figure import Curve, Figure, Panel


def called(figure: Figure, panel: Panel) -> Panel:
    """Return a panel whose curves have the names that the legend of the figure gives their looks.

    A figure lists each curve once, above its panels; a panel that stands alone has to name its curves itself. A curve
    that has only the colour of one in the legend keeps to have no label and says in its text what it belongs to.
    panel: one of its panels.

    >>> import numpy as np
    >>> from .figure import Row
    >>> looks = {"x": np.arange(2.0), "y": np.arange(2.0), "role": "shaft 2"}
    >>> first, second = Panel(series=(Curve(label="tube", **looks),)), Panel(series=(Curve(**looks),))
    >>> rows = tuple(Row(panels=(panel,)) for panel in (first, second))
    >>> figure = Figure(name="f", title="", sentence="", source="", rows=rows)
    >>> called(figure, second).series[0].label
    'tube'
    """
    entries = [one for one in reversed(figure.entries) if isinstance(one, Curve)] if figure.legend else []
    alike = {(one.role, one.dash, one.width): one.label for one in entries}
    similar = {(one.role, one.dash): one.label for one in entries if one.width}
    akin = {one.role: one.label for one in entries}

    def named(one: Curve) -> Curve:
        if one.label:
            return one
        label = alike.get((one.role, one.dash, one.width), "")
        if not label and one.width and not one.marker and np.size(one.x) > 2:
            label = similar.get((one.role, one.dash), "")
        return replace(one, label=label, text=one.text or label or akin.get(one.role, ""))

    return replace(panel, series=tuple(named(one) if isinstance(one, Curve) else one for one in panel.series))
