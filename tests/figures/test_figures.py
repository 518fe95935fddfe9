"""Every figure of every example, by both renderers."""

import io
import re
from dataclasses import replace
from html import escape
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from cardan import figures
from cardan.answers import palette
from cardan.answers.reader import USUAL, Reader, reading
from cardan.book.comparison import book_comparison
from cardan.book.figure import book_figure
from cardan.drive.drive import Drive
from cardan.drive.models.wobble import wobbling
from cardan.figures.axes import axis, steps, written
from cardan.figures.figure import Axis, Bars, Curve, Figure, Panel, Row
from cardan.figures.for_reader import for_reader
from cardan.figures.page import laid_out
from cardan.figures.render_matplotlib import render
from cardan.figures.render_plotly import described
from cardan.figures.render_svg import inline_svg
from cardan.io import example, example_names
from cardan.questions.motion.articulation import articulation
from cardan.questions.motion.equivalence import after_each_joint, equivalent_joint
from cardan.questions.motion.figure import orders_figure
from cardan.questions.motion.motion import motion
from cardan.questions.phases.phases import phases
from cardan.units import deg

SIX = Drive.from_angles([0.1, 0.2, 0.3, 0.1, 0.2, 0.3], plane_twists=[1, 2, 3, -1, -2], yoke_angles=[1, 0, -1, 0.5, 0])
SPECIAL = {
    "straight": Drive.from_angles([0.0]),
    "straight pair": Drive.from_angles([0.0, 0.0]),
    "even": Drive.from_angles([0.3, 0.3]),
    "infeasible": Drive.from_angles([0.1, 0.4]),
    "steep": Drive.from_angles([88 * deg, 70 * deg]),
    "six": SIX,
    "twelve": Drive.from_angles([0.1] * 12, plane_twists=[0.4] * 11),
}
DRIVES = {**{name: example(name) for name in example_names()}, **SPECIAL}


def every(drive: Drive) -> list[figures.Figure]:
    asked = [drive, motion(drive), phases(drive)]
    if not wobbling(drive):
        asked += [equivalent_joint(drive), book_comparison(drive)]
    if drive.movements:
        asked.append(articulation(drive))
    return [for_reader(figure, USUAL) for result in asked for figure in figures.for_result(result)]


@pytest.mark.slow
@pytest.mark.parametrize("name", DRIVES)
def test_both_renderers_draw_every_figure(name):
    made = every(DRIVES[name])
    assert len({figure.name for figure in made}) == len(made)
    for figure in made:
        assert figure.title
        assert figure.source
        assert figure.sentence.endswith(".")
        assert figure.sentence.count(". ") == 0, "one sentence"
        tree = ElementTree.fromstring(inline_svg(figure))
        assert tree.get("role") == "img"
        assert figure.title in tree.get("aria-label")
        spec = described(figure)
        assert len(spec["data"]) or spec["layout"]["annotations"]


@pytest.mark.slow
def test_plotly_accepts_what_is_described():
    graphs = pytest.importorskip("plotly.graph_objects")
    for figure in every(DRIVES["pto-hitch"]) + every(SIX):
        graphs.Figure(described(figure))


def test_one_box_tells_all_curves_with_four_digits_and_units():
    who = Reader(units={"angle": "rad"}, decimal=",")
    (first, *_rest) = figures.for_result(motion(example("two-piece-rear-drive")))
    with reading(who):
        shown = described(for_reader(first, who))
    assert shown["layout"]["hovermode"] == "x unified"
    assert shown["layout"]["separators"].startswith(",")
    curves = [one for one in shown["data"] if one.get("hoverinfo") != "skip"]
    assert all(".4r" in one["hovertemplate"] for one in curves)
    assert any(" rad" in one["hovertemplate"] for one in curves)
    for tail, scale in shown["layout"]["meta"]["turning"]:  # the cursor stands on an axis in radians too
        assert 360.0 * scale == pytest.approx(2.0 * np.pi)
        assert shown["layout"][f"xaxis{tail}"]["range"][1] == pytest.approx(2.0 * np.pi)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("suffix", "start"), [(".svg", b"<?xml"), (".png", b"\x89PNG"), (".pdf", b"%PDF"), (".html", b"<!doc")]
)
def test_save_writes_whole_files(tmp_path, suffix, start):
    place = figures.save(figures.for_result(SIX), tmp_path / f"six{suffix}")
    assert place.read_bytes().startswith(start)
    assert [path.name for path in tmp_path.iterdir()] == [f"six{suffix}"]


@pytest.mark.slow
def test_pdf_has_a_page_for_each_figure(tmp_path):
    text = figures.save(figures.for_result(SIX), tmp_path / "six.pdf").read_bytes()
    assert len(re.findall(rb"/Type /Page\b", text)) == 3


def test_unknown_suffix_and_unwritable_place_are_refused(tmp_path):
    from cardan.errors import InputError

    made = figures.for_result(motion(SIX))
    with pytest.raises(InputError, match=r"\.svg"):
        figures.save(made, tmp_path / "six.gif")
    with pytest.raises(InputError, match="cannot be written"):
        figures.save(made, tmp_path / "nowhere" / "six.svg")
    assert not list(tmp_path.iterdir())


def test_an_interactive_page_asks_nothing_of_the_network(tmp_path):
    text = figures.save(figures.for_result(motion(SIX)), tmp_path / "m.html").read_text()
    assert not re.search(r"<(script|link|img)[^>]+(src|href)=", text.split("<script>")[0] + text.split("</script>")[-1])
    assert "<script src" not in text


def test_unknown_results_are_named():
    with pytest.raises(TypeError, match="int"):
        figures.for_result(1)


def test_the_same_svg_every_time():
    figure = figures.for_result(motion(SIX))[0]
    assert inline_svg(figure) == inline_svg(figure)


def test_ids_of_two_pictures_on_a_page_differ():
    ids = [re.findall(r'id="([^"]+)"', inline_svg(figure)) for figure in every(SIX)]
    flat = [name for some in ids for name in some]
    assert flat
    assert len(flat) == len(set(flat))


def test_words_of_a_picture_keep_all_their_digits():
    value = 0.0123456
    figure = for_reader(figures.for_result(equivalent_joint(Drive.from_angles([value])))[-1], USUAL)
    shown = [text for panel in figure.panels for item in panel.series if isinstance(item, Bars) for text in item.texts]
    assert all(escape(text) in inline_svg(figure) for text in shown)


def test_a_synchronous_output_is_a_flat_line_on_a_sensible_axis():
    even = motion(Drive.from_angles([0.3, 0.3], yoke_angles=[np.pi]))
    straight = motion(Drive.from_angles([0.0, 0.0]))
    for found in (even, straight):
        for panel in figures.for_result(found)[0].panels:
            assert panel.y.high - panel.y.low > 1e-3


def test_a_shaft_has_its_colour_in_every_figure():
    for figure in every(SIX):
        for panel in figure.panels:
            for item in panel.series:
                if isinstance(item, Curve) and item.label.startswith("shaft 3"):
                    assert palette.colour(item.role) == palette.SHAFTS[2]


def test_shafts_are_told_apart_and_none_is_red():
    assert len({palette.colour(palette.shaft(k)) + palette.dash_of(k) for k in range(1, 33)}) == 32
    assert palette.ROLES["failed"] not in palette.SHAFTS


def test_motion_figure_shows_the_curves_themselves():
    found = motion(SIX, speed=100.0)
    panels = figures.for_result(found)[0].panels
    curves = [[item for item in panel.series if isinstance(item, Curve)] for panel in panels]
    for k in range(7):
        np.testing.assert_array_equal(curves[0][k].y, found.shaft_ratio[k])
        np.testing.assert_allclose(curves[1][k].y, np.degrees(found.angle_error[k]), rtol=1e-15, atol=1e-300)
        np.testing.assert_array_equal(curves[2][k].y, found.shaft_acceleration[k])


def test_each_phase_polygon_starts_in_the_middle_and_ends_at_its_irregularity():
    found = phases(DRIVES["truck-printed-angles"])
    figure = figures.for_result(found)[0]
    for panel, one in zip(figure.panels, (found.as_built, *found.settings), strict=False):
        sides = [item for item in panel.series if isinstance(item, Curve) and item.width > 1.0]
        assert len(sides) == 4
        assert np.hypot(sides[0].x[0], sides[0].y[0]) == 0.0
        radius = np.hypot(sides[-1].x[-1], sides[-1].y[-1])
        # The ring a corner lies on is its speed fluctuation; rounding of the arc's construction is some 1e-16.
        assert 4.0 * radius / (1.0 - radius**2) == pytest.approx(one.speed_fluctuation, abs=1e-14)


def test_sides_of_the_polygon_are_hyperbolic_lines_of_the_joints_lengths():
    from cardan.drive.models.kinematics_model import chain

    found = phases(SIX)
    joint_angle = chain(SIX).joint_angle
    figure = figures.for_result(found)[0]
    sides = [item for item in figure.panels[0].series if isinstance(item, Curve) and item.width > 1.0]
    for side, alpha in zip(sides, joint_angle, strict=True):
        z = np.asarray(side.x) + 1j * np.asarray(side.y)
        # Distances in the disk of curvature -1 are 2 artanh; the joints' lengths are -ln cos α = 2 artanh τ.
        legs = 2.0 * np.arctanh(np.abs((z[1:] - z[:-1]) / (1.0 - np.conj(z[:-1]) * z[1:])))
        whole = 2.0 * np.arctanh(abs((z[-1] - z[0]) / (1.0 - np.conj(z[0]) * z[-1])))
        assert whole == pytest.approx(-np.log(np.cos(alpha)), rel=1e-9)
        assert legs.sum() == pytest.approx(whole, rel=1e-9)


def test_all_shafts_of_after_each_joint_find_their_figure():
    assert figures.for_result(after_each_joint(SIX))[-1].name == "orders"


def test_a_layout_shows_bends_before_and_after():
    from cardan.questions.phases.layout import layout

    boxed = replace(
        DRIVES["truck-printed-coordinates"].joints[2], move_within=((0.7, 0.71), (-0.06, -0.05), (0.0, 0.05))
    )
    drive = DRIVES["truck-printed-coordinates"]
    found = layout(replace(drive, joints=(*drive.joints[:2], boxed, drive.joints[3])))
    bars = figures.for_result(found)[0].panels[0].series
    np.testing.assert_allclose(bars[0].size, np.degrees(found.joint_angle_before))
    np.testing.assert_allclose(bars[1].size, np.degrees(found.joint_angle))
    for figure in figures.for_result(found):
        figure = for_reader(figure, USUAL)
        ElementTree.fromstring(inline_svg(figure))


def test_axes_never_magnify_noise():
    made = axis("ratio", "", [1.0 + 1e-16 * np.arange(5)], mirrored=1.0, least=0.02)
    assert (made.low, made.high) == (pytest.approx(0.99), pytest.approx(1.01))


@pytest.mark.parametrize("span", [1e-9, 3e-4, 0.07, 1.0, 33.0, 1e7])
def test_ticks_are_few_round_and_told_apart(span):
    ticks = steps(-0.3 * span, 0.7 * span, 5)
    assert 3 <= len(ticks) <= 12
    assert len(set(written(ticks))) == len(ticks)


@pytest.mark.slow
def test_several_figures_of_a_png_stand_below_each_other():
    one, all_of_them = io.BytesIO(), io.BytesIO()
    made = figures.for_result(SIX)
    render(made[0], one, "png", dpi=40)
    render(made, all_of_them, "png", dpi=40)

    def height(stream: io.BytesIO) -> int:
        return int.from_bytes(stream.getvalue()[20:24], "big")

    assert height(all_of_them) > 2 * height(one)


def test_names_are_escaped():
    named = replace(SIX.shafts[2], name='<b>&"')
    drive = replace(SIX, shafts=(*SIX.shafts[:2], named, *SIX.shafts[3:]))
    for figure in figures.for_result(drive):
        ElementTree.fromstring(inline_svg(figure))
        assert "<b>&" not in str(described(figure)).replace("<b>&lt;", "")


@pytest.mark.slow
@pytest.mark.parametrize(
    "said",
    [
        "the secondary couple is largest on shaft 2;",
        "Момент на входе меняется; дополнительный изгибающий момент наибольший на валу 2;",
    ],
)
def test_the_caption_stays_within_the_page_in_any_script(said: str) -> None:
    figure = figures.Figure(name="words", title=said, sentence=" ".join([said] * 8), source=said, rows=())
    page = laid_out(figure, words=True)
    font = FontProperties(family="DejaVu Sans")
    widths = [TextPath((0.0, 0.0), line, size=8.2, prop=font).get_extents().width / 72.0 for line in page.caption]
    assert 0.8 * page.width < max(widths) < page.width - 0.1  # drawn 0.1 in from the left


def test_orders_below_the_rounding_say_so_instead_of_vanishing():
    drive = Drive.from_angles([1 * deg, 1 * deg], yoke_angles=[90 * deg])
    figure = for_reader(orders_figure(equivalent_joint(drive)), USUAL)
    (drawn,) = (one for one in figure.panels[0].series if isinstance(one, Bars))
    assert drawn.at.tolist() == [2.0, 4.0, 6.0, 8.0]
    assert [text == "< 1·10⁻⁹\u202f°" for text in drawn.texts] == [False, False, True, True]
    assert not any(re.search("[⁰¹²³⁴-⁹]°", text) for text in drawn.texts)
    assert np.all(drawn.ends >= figure.panels[0].y.low)
    assert np.all(drawn.size[2:] < figure.panels[0].y.low)
    texts = figure.panels[0].y.texts
    assert all(text.startswith("10") for text in texts)
    assert "·10" not in re.sub("·10[⁻⁰¹²³⁴-⁹]+\u202f°", "", book_figure(book_comparison(drive, np.zeros(3))).sentence)


def test_panels_that_are_zero_throughout_are_left_out():
    straight, bent = Drive.from_angles([0.0, 0.0]), Drive.from_angles([0.1, 0.2])
    for drive, count in ((straight, 1), (bent, 3)):
        (figure,) = figures.for_result(motion(drive))
        assert len(figure.rows) == count
        assert figure.rows[-1].panels[0].x.title == "input angle φ₁ from the start position [°]"
    lower = book_figure(book_comparison(straight, np.linspace(0.0, 6.0, 9)))
    assert len(lower.rows) == 1
    close = book_figure(book_comparison(Drive.from_angles([0.004, 0.003]), np.linspace(0.0, 6.0, 99)))
    most = max(float(np.max(np.abs(one.y))) for one in close.panels[1].series if isinstance(one, Curve))
    assert most > 0.5 * close.panels[1].y.high


def test_every_result_with_figures_is_found_from_its_own_folder():
    """A folder of results tells in `figure` or `figures` beside it, or in one above, what makes their figures."""
    root = Path(figures.__file__).parent.parent
    homes = [*root.rglob("figure.py"), *root.rglob("figures/__init__.py")]
    names = [".".join(("cardan", *home.relative_to(root).with_suffix("").parts)) for home in homes]
    tables = [import_module(name.removesuffix(".__init__")) for name in names]
    found = {kind: made for one in tables for kind, made in getattr(one, "FIGURES", {}).items()}
    assert len(found) > 40
    for kind, made in found.items():
        assert figures._maker(kind) is made


def test_words_at_the_right_end_stay_on_the_page():
    """A last tick in the middle of its place, and the text of the longest bar, as a browser draws them."""
    bars = Bars(
        at=np.asarray([2.0, 1.0]), size=np.asarray([15285.0, 125062.0]), texts=("15 285 rpm", "125 062 rpm"), lying=True
    )
    along = Axis(low=0.0, high=140070.0, ticks=(0.0, 140000.0), texts=("0", "140 000"))
    figure = Figure(
        name="x",
        title="",
        sentence="",
        source="",
        rows=(Row(panels=(Panel(series=(bars,), x=along, y=Axis(low=0.0, high=3.0)),)),),
    )
    short = replace(
        figure, rows=(Row(panels=(Panel(series=(replace(bars, texts=("", "")),), x=replace(along, texts=("0", ""))),)),)
    )
    one, other = (laid_out(each, words=False) for each in (figure, short))
    box, wider = one.panels[0][1], other.panels[0][1]
    assert box.left + box.width * 140000 / 140070 + 0.5 * 7 * 0.059 <= one.width
    assert box.left + box.width * 125062 / 140070 + 0.1 + 11 * 0.059 <= one.width
    assert box.width < wider.width
