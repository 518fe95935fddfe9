"""A figure as a chart to point at and to zoom, updated in place."""

from __future__ import annotations

import nicegui.elements.plotly  # noqa: F401  registers the plotly.js that NiceGUI ships, as "nicegui-plotly"
from nicegui.element import Element

from cardan.figures import Figure
from cardan.figures.palette import DARK
from cardan.figures.render_plotly import described


class Chart(Element, component="chart.js"):
    """A figure that can be pointed at.

    Parameters
    ----------
    figure : Figure
        What it shows at first.

    Notes
    -----
    Curves over the input angle show where the drive stands: the window's event ``cardan-angle`` with ``detail.angle``
    [rad] moves their cursor, and pressing on them sends ``cardan-go-to``. The server has no part in it.
    """

    def __init__(self, figure: Figure) -> None:
        super().__init__()
        self._props["dark"] = DARK
        self.show(figure)

    def show(self, figure: Figure) -> None:
        """Show another figure in its place; what the user zoomed stays zoomed."""
        self._props["label"] = f"{figure.title}. {figure.sentence}"
        self._props["spec"] = described(figure)
        self.update()
