"""A working hour in few minutes, in a real browser: whatever happens in between, nothing is lost."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from cardan.io import example_text, loads
from tests.app.conftest import PATIENCE, refuse_complaints
from tests.app.test_kept import opened, speed, state, stored
from tests.app.test_page import mark, ready, text_of, typed

TEXT = "document.querySelector('.cm-content').cmView.view.state.doc.toString()"


def until(page: Any, text: str) -> None:
    """Wait until the file of a window is a text."""
    text_of(page)
    page.wait_for_function(f"text => {TEXT} === text", arg=text)


@pytest.mark.slow
def test_a_working_hour_loses_nothing(
    pages_of_file: Any, serve: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder: Path = tmp_path_factory.mktemp("hour")
    file, begun = folder / "rear.toml", example_text("truck-printed-coordinates")
    file.write_text(begun, "utf-8")
    server = serve(sys.executable, "-m", "cardan", "app", str(file), "--port", "{port}", "--no-browser")
    open_page, complaints = pages_of_file
    lost = ("WebSocket", "ERR_INTERNET_DISCONNECTED", "ERR_NETWORK_CHANGED")  # what a browser without a network says

    # Open, edit, drag, add, cure: every one a step, and a step of undo.
    page = opened(open_page, str(server.url), allow=lost)
    texts = [begun]

    def done() -> str:
        """Take the text of the file once it is another one."""
        text_of(page)
        page.wait_for_function(f"text => {TEXT} !== text", arg=texts[-1])
        texts.append(text_of(page))
        return texts[-1]

    typed(page, "centre mm y", "40")
    assert "40" in done()
    mark(page, "way-geometry").click()
    place = page.locator('.drag-views circle[data-path="joints[1]"]').first
    box = place.bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 6, y - 8, steps=6)
    page.mouse.up()
    done()
    mark(page, "way-form").click()
    mark(page, "add").click()
    mark(page, "add-supports").click()
    assert len(loads(done()).supports) == 1
    failed = page.locator(".lights details.failed").first
    failed.locator("summary").click()
    failed.locator("button.apply").first.click()
    done()
    assert len(set(texts)) == 5

    # A variant is kept, the page is loaded anew.
    mark(page, "variants-menu").click()
    mark(page, "variants-keep").click()
    mark(page, "variant-name").fill("cured")
    mark(page, "variant-named").click()
    page.wait_for_function("document.querySelector('[data-mark=variants-menu]').innerText.includes('(1)')")
    stored(page, "cured")
    page.reload()
    ready(page)
    until(page, texts[-1])
    assert "(1)" in mark(page, "variants-menu").inner_text()

    # The network is cut, and the server stands still; what was written meanwhile arrives.
    page.context.set_offline(True)
    os.kill(server.process.pid, signal.SIGSTOP)
    mark(page, "way-form").click()
    page.wait_for_timeout(3000)
    os.kill(server.process.pid, signal.SIGCONT)
    page.context.set_offline(False)
    speed(page, "1111")
    done()

    # Two windows on one file: who saves second is told, and both are kept.
    other = opened(open_page, f"{server.url}/?file=rear.toml")
    assert text_of(other) == begun
    speed(other, "2222")
    other.keyboard.press("Control+s")
    state(other, "rear.toml ○ saved")
    mark(page, "disk").wait_for()
    page.keyboard.press("Control+s")
    mark(page, "write-over").locator('[data-mark="disk-both"]').click()
    state(page, "rear-2.toml ○ saved")
    assert (folder / "rear-2.toml").read_text("utf-8") == texts[-1]
    assert "2222" in file.read_text("utf-8")

    # The report tells of the drive that is seen, and undo leads back through all of it.
    mark(page, "report-menu").click()
    with page.expect_download(timeout=PATIENCE) as waiting:
        mark(page, "report-html").click()
    report = folder / "report.html"
    waiting.value.save_as(report)
    assert "1111" in report.read_text("utf-8")
    for text in reversed(texts[:-1]):
        mark(page, "undo").click()
        until(page, text)
    for text in texts[1:]:
        mark(page, "redo").click()
        until(page, text)
    assert "(1)" in mark(page, "variants-menu").inner_text()
    refuse_complaints(complaints)
