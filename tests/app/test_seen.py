"""What is seen at a glance, in a real browser: the view in space, panes, charts, a drive that moves, the first page."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from typing import Any

import pytest

from cardan import example
from cardan.io import example_names
from cardan.io.examples import ABOUT, TEMPLATES, USES
from cardan.questions.motion.articulation import articulation
from cardan.questions.motion.moving_points import default_times
from tests.app.conftest import refuse_complaints

Open = Callable[..., Any]

DESK = {"width": 1440, "height": 900}


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = str(tmp_path_factory.mktemp("drives"))
    return str(serve(sys.executable, "-m", "cardan", "app", folder, "--port", "{port}", "--no-browser").url)


def mark(page: Any, name: str) -> Any:
    return page.locator(f'[data-mark="{name}"]')


def ready(page: Any) -> Any:
    page.wait_for_selector('[data-mark="answer"]:visible')
    page.wait_for_function("document.querySelector('[data-mark=judgement]')?.textContent.length > 3")
    page.wait_for_function("window.cardanView?.scene?.scale.length && cardanView.scene.arrows.length + 1", polling=50)
    return page


@pytest.fixture(scope="module")
def held(pages_of_file: Any, url: str) -> Any:
    """Return the page of a drive with supports that the tests here share."""
    open_page, complaints = pages_of_file
    page = open_page(f"{url}/?example=truck-supports", reduced_motion="reduce", viewport=DESK)
    return ready(page), complaints


@pytest.fixture
def page(held: Any) -> Any:
    one, complaints = held
    yield one
    refuse_complaints(complaints)


BODIES = 'g[clip-path="url(#{0}-frame)"] path[stroke-width="35"]'
"""Bodies in a panel of a picture."""

DRAWN = """bodies => {
  const boxes = [...document.querySelectorAll(bodies)].map((one) => one.getBBox());
  const width = Math.max(...boxes.map((b) => b.x + b.width)) - Math.min(...boxes.map((b) => b.x));
  return [width, Math.max(...boxes.map((b) => b.y + b.height)) - Math.min(...boxes.map((b) => b.y))];
}"""
"""Width and height of what is drawn there."""

STANDING = """() => {
  const spot = cardanView.viewer.camera.position.clone(), low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
  cardanView.bodies.tracks.root.updateMatrixWorld(true);
  for (const { solid, full } of cardanView.bodies.batches.values()) {
    const places = full.attributes.position;
    for (let k = 0; k < places.count; k++) {
      spot.fromBufferAttribute(places, k).applyMatrix4(solid.matrixWorld).toArray().forEach((value, axis) => {
        low[axis] = Math.min(low[axis], value);
        high[axis] = Math.max(high[axis], value);
      });
    }
  }
  return high.map((value, axis) => value - low[axis]);
}"""
"""Length, width and height of all bodies of the view."""


def switched(page: Any, name: str) -> None:
    """Switch a group of the view on or off."""
    mark(page, "show").click()
    mark(page, f"group-{name}").click()
    page.keyboard.press("Escape")
    page.locator(".q-menu").wait_for(state="detached")


def test_colours_by_utilisation_have_a_legend(page: Any) -> None:
    legend = page.locator(".cardan-legend")
    assert legend.is_hidden()
    mark(page, "colour").click()
    page.locator(".q-menu .q-item", has_text="by utilisation").click()
    legend.wait_for()
    assert legend.locator("li").count() == 4
    assert "over the limit" in legend.inner_text()
    page.evaluate("cardanView.colourBy('shaft')")
    assert legend.is_hidden()


def test_forces_stand_in_the_picture_before_the_bodies_with_their_size_at_the_angle_shown(page: Any) -> None:
    page.wait_for_function("cardanView.scene.arrows.length > 3", polling=50)
    switched(page, "forces")
    page.wait_for_function(
        "cardanView.groupsOn.has('forces') && !cardanView.viewer.way && cardanView.resting", polling=50
    )
    told = page.evaluate(
        """() => cardanView.arrows.texts(cardanView.angle).map(([arrow, place, text]) => {
          const length = cardanView.motion.vector(arrow.vector, cardanView.angle, place.clone()).length();
          const p = place.clone().project(cardanView.viewer.camera);
          return [parseFloat(text), length * arrow.scale, Math.max(Math.abs(p.x), Math.abs(p.y)), arrow.text];
        })"""
    )
    assert len(told) >= 3
    for shown, size, off, text in told:
        assert shown == pytest.approx(size, rel=5e-3)  # three digits
        assert off < 1.05  # its end lies within the picture
        assert ": " in text
    # Whatever stands before an arrow is drawn before it: its colour is seen where the bodies would hide it.
    assert page.evaluate("cardanView.arrows.wipe.visible && cardanView.arrows.wipe.renderOrder === 9")
    switched(page, "forces")


WHERE = """path => {
  const view = cardanView, camera = view.viewer.camera, box = view.page.canvas.getBoundingClientRect();
  for (const {members, full, solid} of view.bodies.batches.values()) {
    const k = members.findIndex((body) => body.path === path);
    if (k < 0) continue;
    const sum = solid.position.clone().set(0, 0, 0), {vertex, vertices} = full.userData.spans[k];
    const at = full.attributes.position;
    for (let v = vertex; v < vertex + vertices; v++) sum.add(sum.clone().fromBufferAttribute(at, v));
    const p = solid.localToWorld(sum.divideScalar(vertices)).project(camera);
    return [box.left + (p.x + 1) / 2 * box.width, box.top + (1 - p.y) / 2 * box.height];
  }
}"""
"""Where on the page the middle of a part is."""


def test_a_part_tells_its_angle_torque_and_force_beside_the_pointer_and_is_let_go(page: Any) -> None:
    x, y = page.evaluate(WHERE, "shafts[1]")
    page.mouse.move(x, y)
    tip = page.locator(".cardan-tip")
    tip.wait_for()
    assert re.search(r"torque [\d.]+ k?N·m", tip.inner_text())
    box = tip.bounding_box()
    assert not (box["x"] <= x <= box["x"] + box["width"] and box["y"] <= y <= box["y"] + box["height"])
    bodies = page.evaluate("cardanView.scene.bodies.map(({path, text}) => [path, text])")
    joint = next(text for path, text in bodies if path == "joints[1]")
    assert re.search(r"joint angle [\d.]+°", joint)
    assert re.search(r"force [\d.]+", joint)
    page.mouse.click(x, y)
    page.wait_for_function("cardanView.selected === 'shafts[1]'")
    page.keyboard.press("Escape")
    page.wait_for_function("cardanView.selected === null && !cardanView.bodies.outline.shown.length")


FITS = """() => {
  const seen = cardanView.corners().map((one) => one.project(cardanView.viewer.camera));
  return Math.max(...seen.flatMap(({x, y}) => [Math.abs(x), Math.abs(y)]));
}"""
"""How far the farthest corner of the drive is from the middle of the picture, 1 at its edge."""


def test_the_camera_finds_the_drive_and_the_cube_lies_as_it_does(page: Any) -> None:
    page.evaluate("cardanView.viewer.zoom(5)")
    assert page.evaluate(FITS) > 1.0
    mark(page, "fit").click()
    page.wait_for_function("!cardanView.viewer.own && !cardanView.viewer.way")
    assert 0.6 < page.evaluate(FITS) <= 1.0
    page.locator(".cardan-cube [data-look=plan]").dispatch_event("click")
    page.wait_for_function("cardanView.viewer.view === 'plan' && cardanView.resting", polling=50)
    box = {name: page.locator(f".cardan-cube [data-look={name}]").bounding_box() for name in ("plan", "side")}
    assert box["plan"]["width"] > 5 * min(box["side"]["height"], box["side"]["width"])  # seen from above
    # The picture reaches an edit once it is at rest.
    before = page.evaluate("cardanView.scene.size")
    page.get_by_label("centre mm y", exact=True).first.fill("300")
    page.keyboard.press("Enter")
    page.wait_for_function("before => cardanView.scene.size !== before", arg=before, polling=50)
    page.wait_for_function(f"({FITS})() <= 1.0", polling=50)
    mark(page, "undo").click()
    page.wait_for_function("before => cardanView.scene.size === before", arg=before, polling=50)
    mark(page, "look-iso").click()


def test_pictures_of_answers_show_the_bodies_of_the_view(page: Any) -> None:
    """Side and plan view are as long over as high, and over as wide, as what stands in space.

    The picture stands at another angle of the turn, so that ears of yokes lie elsewhere: a tenth of the height, a
    quarter of the width, which they are alone. Yokes that are no true size made both several times as much.
    """
    long, wide, high = page.evaluate(STANDING)
    mark(page, "tab-forces").click()
    page.locator(BODIES.format("loads-1")).first.wait_for(state="attached")
    side, plan = (page.evaluate(DRAWN, BODIES.format(f"loads-{k}")) for k in range(2))
    mark(page, "tab-motion").click()
    page.locator(".cardan-chart").first.wait_for(state="visible")
    assert side[0] / side[1] == pytest.approx(long / high, rel=0.1)
    assert plan[0] / plan[1] == pytest.approx(long / wide, rel=0.25)


def test_bars_and_labels_cover_nothing(page: Any) -> None:
    scene, tools = mark(page, "scene").bounding_box(), page.locator(".view > .tools").bounding_box()
    assert tools["y"] + tools["height"] <= scene["y"] + 1
    spots = page.evaluate("cardanView.labels.still.filter((one) => one.spot).map(({spot}) => spot)")
    cube = page.evaluate("cardanView.cube.spot")
    for k, one in enumerate(spots):
        for other in (*spots[k + 1 :], cube):
            apart = one["right"] <= other["left"] or other["right"] <= one["left"]
            assert apart or one["bottom"] <= other["top"] or other["bottom"] <= one["top"]


def test_a_section_shows_the_inside_and_a_distance_is_measured(page: Any) -> None:
    mark(page, "look-side").click()
    page.wait_for_function("cardanView.viewer.view === 'side' && cardanView.resting", polling=50)
    ray = "cardanView.bodies.cut && cardanView.bodies.cut.constant"
    mark(page, "section").click()
    page.wait_for_function("cardanView.bodies.cut !== null")
    middle = page.evaluate(ray)
    mark(page, "section-place").locator(".q-slider__track-container").focus()
    for _k in range(5):
        page.keyboard.press("ArrowRight")
    page.wait_for_function(f"before => {ray} !== before", arg=middle)
    mark(page, "section").click()
    page.wait_for_function("cardanView.bodies.cut === null")
    mark(page, "measure").click()
    page.wait_for_function("cardanView.measuring.on")
    points = [page.evaluate(WHERE, path) for path in ("shafts[1]", "shafts[2]")]
    for x, y in points:
        page.mouse.click(x, y)
    page.wait_for_function("document.querySelector('.told').innerText.includes('distance')")
    told = page.locator(".told").inner_text()
    ends = page.evaluate("cardanView.measuring.points.map((one) => one.toArray())")
    far = 1000.0 * sum((a - b) ** 2 for a, b in zip(*ends, strict=True)) ** 0.5
    number = re.search(r"distance ([\d\u202f.,]+)", told)
    assert number
    assert float(number[1].replace("\u202f", "")) == pytest.approx(far, rel=1e-3)  # four digits
    mark(page, "measure").click()
    page.wait_for_function("!cardanView.measuring.on")
    mark(page, "look-iso").click()


def test_panes_are_resized_by_keys_and_pointer_and_enlarged_and_the_browser_remembers(page: Any) -> None:
    def width() -> float:
        return float(page.locator(".pane.file").bounding_box()["width"])

    before = width()
    edge = page.locator(".file-edge")
    edge.focus()
    for _k in range(3):
        page.keyboard.press("ArrowRight")
    wider = width()
    assert wider == pytest.approx(before + 0.06 * DESK["width"], abs=8)
    box = edge.bounding_box()
    page.mouse.move(box["x"] + 4, 450)
    page.mouse.down()
    page.mouse.move(box["x"] - 82, 450)
    page.mouse.up()
    assert width() == pytest.approx(wider - 86, abs=4)
    mark(page, "enlarge-answers").click()
    assert page.locator(".pane.answers").bounding_box()["width"] > 0.97 * DESK["width"]
    assert page.locator(".pane.verdicts").is_hidden()
    mark(page, "enlarge-answers").click()
    assert page.locator(".pane.verdicts").is_visible()
    assert "--file" in page.evaluate("localStorage.getItem('cardan-panes')")
    page.evaluate("localStorage.clear()")


def test_all_tabs_fit_a_desk(page: Any) -> None:
    tabs = page.locator(".asked .q-tab")
    last = tabs.nth(tabs.count() - 1).bounding_box()
    pane = page.locator(".pane.answers").bounding_box()
    assert last["x"] + last["width"] <= pane["x"] + pane["width"]


def test_the_speed_of_the_picture_is_told_and_kept(page: Any) -> None:
    told = mark(page, "rate").inner_text()
    assert told == "2.67 rpm"
    turns = page.evaluate(
        """() => { const view = cardanView, before = view.angle;
          Object.assign(view, {playing: true, moving: true, last: 1000});
          view.frame(1900);  // a frame that took long
          Object.assign(view, {playing: false, moving: false});
          return (view.angle - before) / (2 * Math.PI) / 0.9 * 60; }"""
    )
    assert turns == pytest.approx(2.67, abs=0.005)  # three digits
    page.evaluate("cardanView.goTo(0)")


def test_one_box_tells_all_curves_and_the_wheel_zooms_where_the_chart_has_the_focus(page: Any) -> None:
    chart = page.locator("[data-mark=sheet-motion] .cardan-chart").first
    chart.scroll_into_view_if_needed()
    chart.locator(".main-svg").first.wait_for()
    box = chart.bounding_box()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 90)
    tip = chart.locator(".hoverlayer")
    page.wait_for_function("document.querySelector('[data-mark=sheet-motion] .hoverlayer')?.textContent.length > 5")
    assert tip.locator(".legend .traces").count() >= 2
    ranges = "one => one.querySelector('.plot')._fullLayout.xaxis.range.slice()"
    whole = chart.evaluate(ranges)
    page.mouse.wheel(0, -300)
    assert chart.evaluate(ranges) == whole  # the page scrolls
    chart.scroll_into_view_if_needed()
    chart.focus()
    box = chart.bounding_box()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 90)
    page.mouse.wheel(0, -300)
    page.wait_for_function(
        "one => one.querySelector('.plot')._fullLayout.xaxis.range[1] < 359", arg=chart.element_handle()
    )
    page.mouse.dblclick(box["x"] + 0.4 * box["width"], box["y"] + 90)
    page.wait_for_function(
        "one => one.querySelector('.plot')._fullLayout.xaxis.range[1] > 359", arg=chart.element_handle()
    )
    page.evaluate("cardanView.goTo(0)")


def test_a_chart_opened_later_stands_where_the_drive_stands(page: Any) -> None:
    page.evaluate("cardanView.goTo(Math.PI)")
    page.wait_for_function("cardanView.told === Math.PI")
    mark(page, "tab-forces").click()
    page.wait_for_function(
        """() => { const chart = [...document.querySelectorAll('[data-mark=sheet-forces] .cardan-chart')]
            .find((one) => one.querySelector('.cursors > div')?.style.transform);
          const x = chart?.querySelector('.plot')._fullLayout.xaxis, line = chart?.querySelector('.cursors > div');
          const at = chart && new DOMMatrix(getComputedStyle(line).transform).m41;
          return chart && Math.abs(x.p2l(at - x._offset) - 180) < 0.5; }"""
    )
    mark(page, "tab-motion").click()
    page.evaluate("cardanView.goTo(0)")


def test_a_drive_that_moves_is_played_and_dragged_and_curves_and_headline_follow(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?example=pto-hitch", reduced_motion="reduce", viewport=DESK)
    ready(page)
    drive = example("pto-hitch")
    times = default_times(drive.movements)
    most = 100.0 * float(articulation(drive).speed_fluctuation.max())
    number = mark(page, "headline").locator("b")
    title = mark(page, "headline").locator("span")
    assert float(number.inner_text().split()[0]) == pytest.approx(most, rel=5e-3)  # three digits
    assert "movement" in title.inner_text()
    drawn = page.evaluate("cardanView.scene.tracks.at(-1).origin.slice(0, 3)")
    place = "JSON.stringify(cardanView.scene.tracks.at(-1).origin.slice(0, 3))"
    mark(page, "time").locator(".q-slider__track-container").focus()
    for _k in range(40):
        page.keyboard.press("ArrowRight")
    page.wait_for_function("window.cardanTime > 0", polling=50)
    page.wait_for_timeout(1000)
    instant = page.evaluate("cardanTime")
    assert 0.0 < instant <= float(times[-1]) * 40 / 400 + 1e-9
    page.wait_for_function(f"{place} !== '{drawn}'.replaceAll(' ', '')", polling=50)
    here = 100.0 * float(articulation(drive, times=[instant]).speed_fluctuation[0])
    page.wait_for_function("document.querySelector('[data-mark=headline] span').textContent.includes('t = ')")
    assert float(number.inner_text().split()[0]) == pytest.approx(here, rel=5e-3)
    page.locator("[data-mark=inner-motion]").get_by_text("Articulation", exact=True).click()
    line = page.locator("[data-mark=sheet-articulation] .cursors > div").first
    page.wait_for_function("document.querySelector('[data-mark=sheet-articulation] .cursors > div')?.style.transform")
    stood = line.evaluate("one => one.style.transform")
    mark(page, "play-movement").click()
    page.wait_for_function(f"window.cardanTime > {instant} + 0.3", polling=50)
    page.wait_for_function(
        "before => document.querySelector('[data-mark=sheet-articulation] .cursors > div').style.transform !== before",
        arg=stood,
    )
    mark(page, "play-movement").click()
    mark(page, "as-drawn").click()
    page.wait_for_function("document.querySelector('[data-mark=headline] span').textContent.includes('movement')")


ALIKE = ("cured-drive", "pto-flywheel-absorber")
"""Examples whose lines and names alone tell them from another one, which differs by inertias on its shafts."""


def test_the_first_page_tells_every_example_apart_and_begins_with_a_template(page_of: Open, url: str) -> None:
    assert set(ABOUT) == set(example_names())
    assert set(USES) == set(TEMPLATES)
    page = page_of(url, reduced_motion="reduce", viewport=DESK)
    cards = page.locator(".start .card")
    cards.first.wait_for()
    lines = [one.locator(".about").inner_text() for one in cards.all()]
    assert len(lines) == len(set(lines)) == len(example_names())
    assert all(lines)
    pictures = page.evaluate(
        """() => Promise.all([...document.querySelectorAll('.start .card img')]
            .map((one) => fetch(one.src).then((answer) => answer.text())))"""
    )
    assert all(one.startswith("<svg") and "<path" in one for one in pictures)
    assert len(set(pictures)) == len(pictures) - len(ALIKE)
    mark(page, "template-mill").click()
    ready(page)
    assert "not saved" in mark(page, "file-name").inner_text()
    assert page.evaluate("cardanView.scene.name") == example(TEMPLATES["mill"]).name
