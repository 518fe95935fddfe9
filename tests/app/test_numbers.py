"""Numbers by arrow keys, wheel, hand and sliders, and points dragged where a file gives angles: in a real browser."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from cardan.drive.models.geometry import geometry, movable, with_point
from cardan.io import example, example_text, loads
from tests.app.test_page import mark, ready, text_of

Open = Callable[..., Any]


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = str(tmp_path_factory.mktemp("drives"))
    return str(serve(sys.executable, "-m", "cardan", "app", folder, "--port", "{port}", "--no-browser").url)


SAYS = "text => document.querySelector('.cm-content').cmView.view.state.doc.toString().includes(text)"


def says(page: Any, text: str) -> None:
    """Wait until the file says something."""
    text_of(page)
    page.wait_for_function(SAYS, arg=text)
    mark(page, "way-form").click()
    page.locator(".form").wait_for()


STATE = """field => `${field.value}, ${field.isConnected ? "" : "not "}in the page; the focus is on ` +
  `${document.activeElement.ariaLabel ?? document.activeElement.className}`"""


def shows(page: Any, field: Any, text: str) -> None:
    """Wait until a field shows a number; tell what it shows where that does not come."""
    there = field.element_handle()
    try:
        page.wait_for_function("([one, text]) => one.value === text", arg=[there, text])
    except Exception as error:
        raise AssertionError(f"{text} does not come: {there.evaluate(STATE)}, and now {field.input_value()}") from error


TURNED = """field => { field.dataset.turned = ""; field.addEventListener("wheel", () => {
  field.dataset.turned = document.activeElement === field ? "yes" : "without the focus"; }, { once: true }); }"""


def turn(page: Any, field: Any, pixels: int) -> None:
    """Turn the wheel over a field with the focus; again where the page moved away under the mouse."""
    for _again in range(5):
        field.evaluate(TURNED)
        field.focus()
        field.hover()
        page.mouse.wheel(0, pixels)
        for _wait in range(50):
            page.wait_for_timeout(100)
            if turned := field.evaluate("field => field.dataset.turned"):
                break
        if turned == "yes":
            return
    raise AssertionError("the wheel does not reach the field")


def test_numbers_follow_keys_wheel_hand_and_slider_each_one_step_of_undo(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?example=three-joints-unequal", reduced_motion="reduce")
    ready(page)
    before = text_of(page)
    mark(page, "way-form").click()
    field = page.get_by_label("joint_angle °", exact=True).first
    assert field.get_attribute("inputmode") == "decimal"
    curve = mark(page, "answer").first.inner_text()
    field.focus()
    for key in ("ArrowUp", "ArrowUp", "Shift+ArrowUp", "Alt+ArrowDown"):
        page.keyboard.press(key)
    shows(page, field, "11.19")  # 10 by steps of a tenth
    says(page, "joint_angle_deg = 11.19")
    assert mark(page, "answer").first.inner_text() != curve
    turn(page, field, 100)
    shows(page, field, "11.09")
    says(page, "joint_angle_deg = 11.09")
    name = mark(page, "key-joints[0].joint_angle_deg").locator(".name")
    name.hover(position={"x": 5, "y": 5})
    box = name.bounding_box()
    page.mouse.down()
    page.mouse.move(box["x"] + 45, box["y"] + 5, steps=10)
    page.mouse.up()
    shows(page, field, "12.09")
    says(page, "joint_angle_deg = 12.09")
    field.focus()
    mark(page, "key-joints[0].joint_angle_deg").locator(".explore").click()
    slider = mark(page, "key-joints[0].joint_angle_deg").locator("input[type=range]")
    assert slider.get_attribute("aria-label") == "joint_angle °"
    slider.focus()
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    shows(page, field, "12.11")
    says(page, "joint_angle_deg = 12.11")
    for text in ("12.09", "11.09", "11.19"):
        mark(page, "undo").click()
        says(page, f"joint_angle_deg = {text}")
    mark(page, "undo").click()
    text_of(page)
    page.wait_for_function(
        "text => document.querySelector('.cm-content').cmView.view.state.doc.toString() === text", arg=before
    )


def test_only_the_newest_place_of_a_hand_is_sent(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?example=three-joints-unequal", reduced_motion="reduce")
    ready(page)
    before = text_of(page)
    mark(page, "way-geometry").click()
    place = page.locator('.drag-views circle[data-path="joints[1]"]').first
    place.wait_for()
    assert page.locator('.drag-views circle.fixed[data-path="joints[0]"]').count() == 2
    page.evaluate(
        """() => { window.sent = 0; const send = WebSocket.prototype.send;
          WebSocket.prototype.send = function (text) {
            sent += String(text).includes('"at"');
            return send.call(this, text);
          };
          addEventListener("cardan-followed", (event) => event.stopImmediatePropagation(), true); }"""
    )  # the server is never heard to follow
    box = place.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 10, y - 12, steps=16)
    page.mouse.up()
    page.wait_for_function("document.querySelector('[data-mark=\"file-name\"]').innerText.includes('not saved')")
    text_of(page)
    page.wait_for_function(SAYS.replace("doc.toString().includes(text)", "doc.toString() !== text"), arg=before)
    assert page.evaluate("sent") <= 3  # the first, the last, and one where the machine was slow
    drive = loads(text_of(page))
    first, moved = (geometry(one).points for one in (example("three-joints-unequal"), drive))
    np.testing.assert_allclose(moved[[1, 3]], first[[1, 3]], atol=1e-6)  # the other joints stay
    assert np.linalg.norm(moved[2] - first[2]) > 0.01


@pytest.mark.parametrize("name", ["three-joints-unequal", "w-arrangement", "z-arrangement", "truck-power-unit"])
def test_a_point_put_elsewhere_stands_there_and_the_others_stay(name: str) -> None:
    drive = loads(example_text(name))
    points = movable(drive)
    free = [path for path, (_at, loose) in points.items() if loose and path.startswith("joints")]
    assert free
    for path in free:
        there = np.add(points[path][0], (0.004, 0.003, -0.005))
        after = movable(with_point(drive, path, tuple(there)))
        np.testing.assert_allclose(after[path][0], there, atol=1e-12)
        for other, (at, _loose) in points.items():
            if other.startswith("joints") and other != path:
                np.testing.assert_allclose(after[other][0], at, atol=1e-12)


def test_keys_take_back_a_number_that_was_moved_and_letters_that_were_typed_into_it(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?example=three-joints-unequal", reduced_motion="reduce")
    ready(page)
    field = page.get_by_label("joint_angle °", exact=True).first
    field.focus()
    page.keyboard.press("ArrowUp")
    shows(page, field, "10.1")
    page.keyboard.press("ControlOrMeta+z")
    shows(page, field, "10")
    says(page, "joint_angle_deg = 10\n")
    field.press("End")
    field.press("5")
    shows(page, field, "105")
    page.keyboard.press("ControlOrMeta+z")
    shows(page, field, "10")
    assert mark(page, "redo").is_enabled()


AT_ONCE = """field => {
  const press = (key, ctrlKey) =>
    field.dispatchEvent(new KeyboardEvent("keydown", { key, ctrlKey, bubbles: true, cancelable: true }));
  press("ArrowUp", false);
  press("z", true);
}"""


def test_undo_right_behind_a_step_takes_that_step_back(page_of: Open, url: str) -> None:
    """A hand that is faster than the page sends: the step has to come before what takes it back."""
    page = page_of(f"{url}/?example=three-joints-unequal", reduced_motion="reduce")
    ready(page)
    field = page.get_by_label("joint_angle °", exact=True).first
    field.focus()
    field.evaluate(AT_ONCE)
    page.wait_for_function("button => !button.disabled", arg=mark(page, "redo").element_handle())
    shows(page, field, "10")
    says(page, "joint_angle_deg = 10\n")
