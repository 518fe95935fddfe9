"""Cells of a grid: the same colours whoever draws them, holes where nothing is known."""

import io
import re

import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.image import imread

from cardan.answers import palette
from cardan.answers.reader import Reader
from cardan.figures.axes import axis
from cardan.figures.figure import Cells, Figure, Panel, Row
from cardan.figures.for_reader import for_reader
from cardan.figures.render_matplotlib import render
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import SHADES, inline_svg

VALUES = np.asarray([[0.0, 1.0, 1.0], [4.0, np.nan, 3.0]])
CELLS = Cells(x=np.asarray([0.0, 1.0, 2.0, 4.0]), y=np.asarray([0.0, 10.0, 20.0]), values=VALUES, low=0.0, high=4.0)
PANEL = Panel(
    series=(CELLS,), x=axis("x", "", [CELLS.x], margin=0.0), y=axis("y", "", [CELLS.y], margin=0.0), title="cells"
)
FIGURE = Figure(
    name="cells", title="Cells", sentence="Cells.", source="made up", rows=(Row(panels=(PANEL,), height=2.0),)
)


def test_the_share_is_that_between_palest_and_darkest():
    np.testing.assert_allclose(CELLS.share, [[0.0, 0.25, 0.25], [1.0, np.nan, 0.75]])
    assert np.all(Cells(x=CELLS.x, y=CELLS.y, values=0.0 * VALUES[:1] + 3.0, low=3.0, high=3.0).share == 0.0)


def test_svg_draws_one_path_a_shade_and_leaves_holes():
    """Two equal cells side by side are one rectangle: four of them for five cells."""
    paths = re.findall(r'<path d="([^"]*)" fill="([^"]*)" shape-rendering', inline_svg(FIGURE))
    assert sum(d.count("M") for d, _fill in paths) == 4
    assert [fill for _d, fill in paths] == [
        palette.scale(np.rint(share * (SHADES - 1)) / (SHADES - 1)) for share in (0.0, 0.25, 0.75, 1.0)
    ]


def test_plotly_keeps_the_numbers_for_whoever_points_at_them():
    (trace,) = (one for one in described(FIGURE)["data"] if one["type"] == "heatmap")
    assert trace["z"] == [[0.0, 1.0, 1.0], [4.0, None, 3.0]]
    assert (trace["zmin"], trace["zmax"]) == (0.0, 4.0)
    assert trace["colorscale"][-1][1] == palette.scale(1.0)


@pytest.mark.slow
def test_matplotlib_has_the_colours_of_the_palette():
    stream = io.BytesIO()
    render(FIGURE, stream, "png", words=False)
    stream.seek(0)
    pixels = imread(stream)
    found = {to_hex(colour) for colour in np.unique(pixels[..., :3].reshape(-1, 3), axis=0)}
    # The darkest and the palest stand exactly; those between in one of 256 steps.
    assert {palette.scale(0.0), palette.scale(1.0)} <= found


@pytest.mark.parametrize("share", [-1.0, 0.0, 0.3, 1.0, 2.0])
def test_the_scale_grows_darker(share):
    def light(colour):
        return sum(int(colour[k : k + 2], 16) for k in (1, 3, 5))

    assert light(palette.scale(share)) >= light(palette.scale(share + 0.1))
    assert palette.colour(f"scale {share}") == palette.scale(share)


def test_in_other_units_the_cells_stand_where_they_did():
    panel = Panel(series=(CELLS,), x=axis("place", "mm", [CELLS.x], dimension="length"), y=axis("y", "", [CELLS.y]))
    figure = Figure(name="c", title="C", sentence="C.", source="s", rows=(Row(panels=(panel,)),))
    (cells,) = for_reader(figure, Reader(units={"length": "in"})).panels[0].series
    np.testing.assert_allclose(cells.x, CELLS.x / 25.4)
    np.testing.assert_array_equal(cells.values, VALUES)
