"""What somebody is writing stays as written, and is what is saved: in a real browser."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from cardan.io import example_text
from tests.app.test_hour import until
from tests.app.test_kept import opened, speed, state
from tests.app.test_numbers import says
from tests.app.test_page import mark, text_of

Open = Callable[..., Any]

LAST = "() => { const { view } = document.querySelector('.cm-content').cmView; view.focus(); "
LAST += "view.dispatch({ selection: { anchor: view.state.doc.length } }); }"
"""Puts the cursor behind the last letter of the file."""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "rear.toml").write_text(example_text("truck-printed-coordinates"), "utf-8")
    return tmp_path


@pytest.fixture
def page(page_of: Open, serve: Callable[..., Any], folder: Path) -> Any:
    command = (sys.executable, "-m", "cardan", "app", str(folder / "rear.toml"), "--port", "{port}", "--no-browser")
    return opened(page_of, str(serve(*command).url))


def saved(page: Any) -> None:
    """Save by keys, and wait until that is told."""
    page.keyboard.press("Control+s")
    page.locator(".q-notification").filter(has_text="is saved").first.wait_for()
    state(page, "rear.toml ○ saved")
    page.locator(".q-notification").first.wait_for(state="detached")


def test_letters_written_while_the_page_follows_stay(page: Any) -> None:
    before = text_of(page)
    page.evaluate(LAST)
    written = "# any pace of writing"
    for k, letter in enumerate(written):
        page.keyboard.type(letter)
        page.wait_for_timeout(360 + 20 * (k % 10))  # about as long as the page waits before it reads, and follows
    until(page, before + written)
    page.wait_for_timeout(1500)
    assert text_of(page) == before + written


def test_what_is_saved_by_keys_is_what_was_written(page: Any, folder: Path) -> None:
    file = folder / "rear.toml"
    written = text_of(page) + "# the last word"
    page.evaluate(LAST)
    page.keyboard.type("# the last word")
    saved(page)
    assert file.read_text("utf-8") == written
    page.keyboard.type("s")  # it is written on where it was left
    until(page, f"{written}s")
    speed(page, "1111")
    field = page.get_by_label("speed rpm", exact=True).first
    field.fill("1717")
    saved(page)
    assert "speed_rpm = 1717" in file.read_text("utf-8")
    for _step in range(3):
        page.keyboard.press("ArrowUp")
    shown = field.input_value()
    saved(page)
    assert f"speed_rpm = {shown}" in file.read_text("utf-8")


def test_what_was_written_last_is_there_before_something_is_pressed(page: Any) -> None:
    before = text_of(page)
    page.evaluate(LAST)
    page.keyboard.type("# mine")
    mark(page, "make-synchronous").click()
    page.locator(".q-notification").filter(has_text="applied").wait_for()
    page.wait_for_timeout(1000)
    assert "# mine" in text_of(page)
    mark(page, "undo").click()
    until(page, f"{before}# mine")
    mark(page, "undo").click()
    until(page, before)


def test_what_is_written_into_a_field_stays_while_the_page_follows_the_one_before(page: Any) -> None:
    mark(page, "way-form").click()
    before, field = (page.get_by_label(f"centre mm {axis}", exact=True).first for axis in "yz")
    before.click(click_count=3)
    page.keyboard.type("41")
    field.click(click_count=3)
    for letter in "12.25":
        page.keyboard.type(letter)
        page.wait_for_timeout(100)
    page.wait_for_timeout(1500)
    assert field.input_value() == "12.25"
    page.keyboard.press("Tab")
    says(page, "41, 12.25]")
    mark(page, "undo").click()
    page.wait_for_function("one => one.value === '7'", arg=field.element_handle())
    assert before.input_value() == "41"
