"""The 3-D view in a browser: it draws, turns, can be touched, and comes back after it was taken away."""

from __future__ import annotations

import base64
import io
import json
import sys
from typing import Any

import numpy as np
import pytest

from cardan.app.scene.element import packed
from tests.app.conftest import refuse_complaints
from tests.app.made_up import scene

PIXELS = """() => {
  const view = window.cardanView, gl = view.renderer.getContext();
  view.render(performance.now(), {fine: false, ratio: 1});
  const {width, height} = view.page.canvas, all = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, all);
  const grid = [];
  for (let y = 0; y < height; y += 4) for (let x = 0; x < width; x += 4) {
    const k = 4 * (y * width + x); grid.push(all[k], all[k + 1], all[k + 2]);
  }
  return grid;
}"""


SMALL = {"width": 420, "height": 320}
ADDRESS = "/?width=380&height=210"


@pytest.fixture(scope="module")
def server(serve):
    """Return the server of the page with the view."""
    return serve(sys.executable, "-m", "tests.app.view_server", "{port}")


def ready(page: Any) -> Any:
    page.wait_for_function("window.cardanView && cardanView.scene && cardanView.sized", polling=50)
    return page


@pytest.fixture
def fresh(server, page_of):
    """Return a function that opens a page of its own."""
    return lambda path=ADDRESS, **options: ready(page_of(server.url + path, viewport=SMALL, **options))


@pytest.fixture(scope="module")
def shared(server, pages_of_file):
    open_page, complaints = pages_of_file
    return ready(open_page(server.url + ADDRESS, viewport=SMALL)), complaints


@pytest.fixture
def page(shared):
    """Return the page that the tests of this file share, standing still, as it was when it opened."""
    one, complaints = shared
    one.evaluate(
        """() => {
          const view = cardanView;
          view.play(false); view.mode(null); view.theme("light"); view.colourBy("shaft"); view.select(null);
          view.groupsOn = null; view.switch(); view.speed(6); view.look("iso", false); view.goTo(0.4);
        }"""
    )
    one.wait_for_function("cardanView.resting", polling=50)
    yield one
    refuse_complaints(complaints)


def pixels(page: Any) -> np.ndarray:
    """Return what is drawn, every fourth pixel, as colours (n, 3)."""
    return np.array(page.evaluate(PIXELS), dtype=int).reshape(-1, 3)


def ask(page: Any, name: str) -> None:
    page.evaluate(f"document.getElementById('ask-{name}').click()")


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """Return the share of pixels that are clearly different."""
    return float(np.mean(np.max(np.abs(before - after), axis=-1) > 12))


def test_it_draws(page):
    seen = pixels(page)
    back = seen[0]
    drawn = np.mean(np.max(np.abs(seen - back), axis=-1) > 40)
    assert 0.01 < drawn < 0.6  # parts on a quiet background
    shafts = np.array([[int(c[k : k + 2], 16) for k in (1, 3, 5)] for c in ("#0072b2", "#d55e00", "#009e73")])
    colour = seen / np.maximum(np.linalg.norm(seen, axis=1, keepdims=True), 1)
    for shaft in shafts:  # the colour of each shaft is there, lighter or darker; grey has 0.81 at most with any of them
        assert np.max(colour @ (shaft / np.linalg.norm(shaft))) > 0.94
    assert page.get_by_text("joint 3", exact=True).is_visible()
    assert page.locator("canvas").get_attribute("aria-label").startswith("Three-dimensional view")


def test_it_turns_and_stops(page):
    page.evaluate("cardanView.play(true)")
    page.evaluate("cardanView.speed(60)")
    first = page.evaluate("cardanView.angle")
    before = pixels(page)
    page.wait_for_function("before => Math.abs(cardanView.angle - before) > 0.3", arg=first)
    assert changed(before, pixels(page)) > 0.001
    ask(page, "pause")
    page.wait_for_function("!cardanView.playing && !cardanView.pending")
    stood = page.evaluate("cardanView.angle")
    held = pixels(page)
    page.wait_for_timeout(400)
    assert page.evaluate("cardanView.angle") == stood
    assert changed(held, pixels(page)) == 0.0
    assert page.locator("#playing").inner_text() == "False"


def test_at_rest_nothing_is_drawn(page):
    page.wait_for_function("cardanView.resting")
    before = page.evaluate("cardanView.renderer.info.render.frame")
    page.wait_for_timeout(300)
    assert page.evaluate("cardanView.renderer.info.render.frame") == before


def test_angles_go_both_ways_without_the_server(page):
    page.evaluate("window.heard = []; window.addEventListener('cardan-angle', (e) => heard.push(e.detail.angle))")
    page.evaluate("window.dispatchEvent(new CustomEvent('cardan-go-to', {detail: {angle: 2.5}}))")
    page.wait_for_function("heard.at(-1) === 2.5")
    ask(page, "go")
    page.wait_for_function("heard.at(-1) === 1.25")
    page.wait_for_function("document.getElementById('angle').innerText === '1.2500'")


def test_bodies_stand_as_python_says(page):
    """The turn of a track at a frame is that frame's own, and halfway it is halfway."""
    told = scene()
    track = told["tracks"][2]["turn"]
    step = told["angle"][1]
    for share in (0.0, 0.5):
        page.evaluate(f"cardanView.goTo({(7 + share) * step})")
        page.wait_for_function(f"cardanView.told === {(7 + share) * step}")
        seen = page.evaluate("cardanView.tracks.groups[2].quaternion.toArray()")
        mean = np.array(track[28:32]) * (1 - share) + np.array(track[32:36]) * share
        assert abs(np.dot(seen, mean / np.linalg.norm(mean))) == pytest.approx(1.0, abs=1e-6)  # single precision


def middle_of(page: Any, name: str) -> tuple[float, float]:
    """Return where on the page a body is seen: its corner nearest to the viewer."""
    found = page.evaluate(
        """name => {
          const view = cardanView, camera = view.viewer.camera, box = view.page.canvas.getBoundingClientRect();
          for (const {members, full, solid} of view.bodies.batches.values()) {
            const k = members.findIndex((b) => b.name === name);
            if (k < 0) continue;
            const at = full.attributes.position, sum = solid.position.clone().set(0, 0, 0);
            const {vertex, vertices} = full.userData.spans[k];
            for (let v = vertex; v < vertex + vertices; v++) sum.add(solid.position.clone().fromBufferAttribute(at, v));
            const p = solid.localToWorld(sum.divideScalar(vertices)).project(camera);
            return [box.left + (p.x + 1) / 2 * box.width, box.top + (1 - p.y) / 2 * box.height];
          }
        }""",
        name,
    )
    return found[0], found[1]


def test_a_touched_body_gives_its_path_and_its_text(page):
    page.mouse.move(*middle_of(page, "tube 3"))
    page.locator(".cardan-tip").wait_for()
    assert page.locator(".cardan-tip").inner_text() == "Tube 3; 40 % of the limit"
    page.mouse.click(*middle_of(page, "tube 3"))
    page.wait_for_function("document.getElementById('heard').innerText === 'shafts[3]'")
    page.mouse.click(*middle_of(page, "support 1"))
    page.wait_for_function("document.getElementById('heard').innerText === 'supports[0]'")
    assert page.evaluate("cardanView.selected") == "supports[0]"


def now(angle: float) -> str:
    """Return the size of the made-up force at an angle, between the frames before and after it."""
    arrow = scene()["arrows"][0]
    vectors = np.reshape(arrow["vector"], (-1, 3))
    before, share = divmod(angle / (2.0 * np.pi) * len(vectors), 1.0)
    mixed = vectors[int(before)] * (1.0 - share) + vectors[int(before) + 1] * share
    return f"{arrow['scale'] * np.linalg.norm(mixed):.0f} N"


def test_groups_are_hidden_and_shown(page):
    joint = page.get_by_text("joint 2", exact=True)
    assert joint.is_visible()
    before = pixels(page)
    ask(page, "hide")  # all but forces and planes
    page.wait_for_function("cardanView.groupsOn?.size === 2")
    page.wait_for_timeout(200)
    assert not joint.is_visible()
    assert page.get_by_text(now(0.4), exact=True).is_visible()
    assert changed(before, pixels(page)) > 0.001


def test_theme_and_colours(page):
    light = pixels(page)
    ask(page, "dark")
    page.wait_for_function("cardanView.page.root.dataset.theme === 'dark'")
    dark = pixels(page)
    assert np.median(light) > 200
    assert np.median(dark) < 60
    ask(page, "utilisation")
    page.wait_for_function("cardanView.bodies.by === 'utilisation'")
    assert changed(dark, pixels(page)) > 0.005


@pytest.mark.parametrize("mode", ["whirl", "torsion"])
def test_a_mode_swings_while_the_drive_stands(page, mode):
    turning = pixels(page)
    angle = page.evaluate("cardanView.angle")
    ask(page, mode)
    page.wait_for_function("cardanView.modes.chosen")
    page.evaluate("cardanView.modes.time = 0; cardanView.play(true)")
    page.wait_for_function("cardanView.modes.time > 0")
    # Somewhere in the swing the drive stands otherwise than at rest; in its middle a picture differs little.
    assert any(changed(turning, pixels(page)) > 0.0005 for _look in range(20))
    assert page.evaluate("cardanView.angle") == angle
    ask(page, "turn")
    page.wait_for_function("!cardanView.modes.chosen")
    page.wait_for_function("before => cardanView.angle !== before", arg=angle)


def test_standard_views(page):

    def look() -> list[float]:
        page.wait_for_function("!cardanView.viewer.way && !cardanView.pending")
        return page.evaluate("cardanView.viewer.camera.getWorldDirection(cardanView.shared.up.value.clone()).toArray()")

    ask(page, "side")
    page.wait_for_function("cardanView.viewer.view === 'side'")
    assert look() == pytest.approx([0, 1, 0], abs=1e-6)
    assert page.evaluate("cardanView.viewer.camera.isOrthographicCamera")
    ask(page, "axis")
    page.wait_for_function("cardanView.viewer.view === 'axis'")
    axis = np.array(scene()["tracks"][2]["origin"]) - np.array(scene()["tracks"][3]["origin"])
    assert abs(np.dot(look(), axis / np.linalg.norm(axis))) == pytest.approx(1.0, abs=1e-5)
    page.locator("canvas").focus()
    page.keyboard.press("3")
    page.wait_for_function("cardanView.viewer.view === 'plan'")
    assert look() == pytest.approx([0, 0, -1], abs=1e-3)
    page.keyboard.press("1")
    page.wait_for_function("cardanView.viewer.view === 'iso'")
    first = look()
    assert page.evaluate("cardanView.viewer.camera.isPerspectiveCamera")
    page.keyboard.press("ArrowLeft")
    assert look() != pytest.approx(first, abs=1e-3)
    page.keyboard.press("Space")
    page.wait_for_function("cardanView.playing")


def test_an_edit_keeps_camera_and_unchanged_meshes(page):
    page.evaluate("cardanView.viewer.orbit(0.3, 0.1)")
    camera = "cardanView.viewer.camera.matrixWorld.toArray()"
    meshes = "[...cardanView.bodies.batches].map(([key, {solid}]) => [key, solid.id])"
    page.wait_for_timeout(300)
    stood, first = page.evaluate(camera), page.evaluate(meshes)
    before = dict(first)
    ask(page, "edit")  # thicker tubes: meshes of shafts are new, those of crosses and supports are not
    page.wait_for_function(
        f"before => JSON.stringify({meshes}) !== before", arg=json.dumps(first, separators=(",", ":"))
    )
    page.wait_for_timeout(200)
    after = dict(page.evaluate(meshes))
    assert page.evaluate(camera) == pytest.approx(stood, abs=1e-6)
    kept = {key for key in before if before[key] == after.get(key)}
    assert {"6/true", "7/true", "8/true", "9/true", "0/false"} <= kept
    assert not {"1/true", "2/true"} & kept


def test_it_can_be_taken_away_and_come_back(fresh):
    page = fresh()
    ask(page, "move")
    page.wait_for_function("window.cardanView === undefined")
    assert page.locator("canvas").count() == 0
    ask(page, "again")
    page.wait_for_function("window.cardanView?.scene && cardanView.sized")
    assert len(np.unique(pixels(page), axis=0)) > 50


def test_a_loaded_page_shows_what_was_asked_for(fresh):
    """A browser that begins anew is told everything again, the scene included."""
    page = fresh()
    page.evaluate("cardanView.page.root.dataset.before = 1")
    page.reload()
    ready(page)
    assert page.evaluate("cardanView.page.root.dataset.before") is None


def test_two_views_on_a_page(fresh):
    page = fresh("/two")
    page.wait_for_function("document.querySelectorAll('canvas').length === 2")
    page.wait_for_timeout(300)
    for canvas in page.locator(".cardan-scene").all():
        assert len(canvas.screenshot()) > 4_000  # a plain surface compresses to less


def test_snapshot_is_a_picture(page):
    image = pytest.importorskip("PIL.Image", reason="pillow is not installed")
    seen = image.open(io.BytesIO(base64.b64decode(page.evaluate("cardanView.snapshot()"))))
    assert seen.size == (760, 420)
    assert len(seen.convert("RGB").getcolors(2_000_000)) > 200
    ask(page, "snapshot")  # and in pieces by way of the server
    page.wait_for_function("document.getElementById('heard').innerText.length === 12")
    assert base64.b64decode(page.locator("#heard").inner_text()) == b"\x89PNG\r\n\x1a\n"


def test_reduced_motion_starts_paused_but_plays_when_asked(fresh):
    page = fresh(reduced_motion="reduce")
    page.wait_for_timeout(300)
    assert not page.evaluate("cardanView.playing")
    page.wait_for_function("document.getElementById('playing').innerText === 'False'")
    ask(page, "play")
    page.wait_for_function("cardanView.playing")


def test_without_webgl_a_sentence_stands_in_its_place(server, page_of):
    page = page_of(server.url, script="HTMLCanvasElement.prototype.getContext = () => null")
    page.get_by_text("WebGL is not available").wait_for()
    ask(page, "dark")  # calls that come do nothing
    ask(page, "pause")
    assert page.evaluate("window.cardanView") is None


def test_packing_sends_a_mesh_once():
    told = scene()
    message, names = packed(told)
    assert set(message["meshes"]) == names
    assert len(names) < len(told["bodies"])  # the four crosses are one mesh
    again, same = packed(told, names)
    assert again["meshes"] == {}
    assert same == names
    other, more = packed(scene(radius=0.05), names)
    assert set(other["meshes"]) == more - names
    assert not any("positions" in body for body in message["bodies"])


def volume(positions: np.ndarray, indices: np.ndarray) -> float:
    """Return what a closed surface holds, by the tetrahedra from the origin."""
    a, b, c = (positions[indices[:, k]] for k in range(3))
    return float(np.sum(a * np.cross(b, c)) / 6)


def test_thinned_bodies_are_closed_and_of_the_same_shape(page):
    """Without a graphics card bodies move with fewer triangles: the same surface within a pixel."""
    page.wait_for_function("[...cardanView.bodies.meshes.values()].every((mesh) => mesh.thin)")
    found = page.evaluate(
        """() => [...cardanView.bodies.meshes.values()].map((mesh) => [mesh, mesh.thin].map(
          ({positions, indices}) => [[...positions], [...indices]]))"""
    )
    error = page.evaluate("cardanView.bodies.error")
    assert error <= scene()["size"] / 320
    fewer = 0
    for pair in found:
        (points, corners), (kept, left) = (
            (np.array(place).reshape(-1, 3), np.array(index).reshape(-1, 3)) for place, index in pair
        )
        fewer += len(corners) - len(left)
        assert {tuple(p) for p in kept.tolist()} <= {tuple(p) for p in points.tolist()}  # no corner is made up
        places = {tuple(p): k for k, p in enumerate(kept.tolist())}
        ends = [[places[tuple(kept[k].tolist())] for k in triangle] for triangle in left.tolist()]
        sides = [(t[k], t[(k + 1) % 3]) for t in ends for k in range(3)]
        assert sorted(sides) == sorted((b, a) for a, b in sides)  # every side of a triangle is that of a neighbour
        area = float(
            np.sum(
                np.linalg.norm(
                    np.cross(
                        points[corners[:, 1]] - points[corners[:, 0]], points[corners[:, 2]] - points[corners[:, 0]]
                    ),
                    axis=1,
                )
            )
            / 2
        )
        assert abs(volume(kept, left) - volume(points, corners)) <= area * error
    assert fewer > 0


def test_selecting_a_key_marks_the_parts_it_belongs_to(page):
    def marked(path: str) -> int:
        page.evaluate("path => cardanView.select(path)", path)
        return page.evaluate("cardanView.bodies.outline.shown.length")

    joint = sum(body["path"] == "joints[1]" for body in scene()["bodies"])
    assert marked("joints[1]") == joint
    assert marked("joints[1].centre_mm[2]") == joint
    assert marked("joints[12]") == 0


def test_an_arrow_tells_its_text(page):
    page.evaluate("cardanView.groups(['forces'])")
    page.wait_for_function("cardanView.resting")
    box = page.locator("canvas").bounding_box()
    at = page.evaluate(
        """() => { const [, place] = cardanView.arrows.texts(cardanView.angle)[0];
          const from = place.clone().fromArray(cardanView.scene.arrows[0].from);
          const p = from.lerp(place, 0.8).project(cardanView.viewer.camera); return [(p.x + 1) / 2, (1 - p.y) / 2]; }"""
    )
    page.mouse.move(box["x"] + at[0] * box["width"], box["y"] + at[1] * box["height"])
    tip = page.locator(".cardan-tip")
    tip.filter(has_text="joint 2: 870 N").wait_for()
    assert tip.inner_text() == f"joint 2: 870 N\n{now(0.4)}"
