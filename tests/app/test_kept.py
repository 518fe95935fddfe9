"""Nothing is lost, and no window keeps another one waiting: in a real browser."""

from __future__ import annotations

import json
import os
import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from cardan.app.state.document import heavy
from cardan.app.state.kept import Kept
from cardan.io import example_text
from tests.app.conftest import TOKENS
from tests.app.test_page import changed, mark, ready, text_of, typed

Open = Callable[..., Any]

SMALL = example_text("z-arrangement")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("kept")
    (made / "rear.toml").write_text(example_text("truck-printed-coordinates"), "utf-8")
    (made / "two\u202elmot.toml").write_text(SMALL, "utf-8")
    return made


@pytest.fixture(scope="module")
def server(serve: Callable[..., Any], folder: Path) -> Any:
    return serve(sys.executable, "-m", "cardan", "app", str(folder / "rear.toml"), "--port", "{port}", "--no-browser")


@pytest.fixture(scope="module")
def url(server: Any) -> str:
    return str(server.url)


def opened(page_of: Open, address: str, **how: Any) -> Any:
    page = page_of(address, reduced_motion="reduce", **how)
    ready(page)
    return page


def state(page: Any, words: str) -> None:
    """Wait until the top of the page says something of the file."""
    page.wait_for_function(
        "words => document.querySelector('[data-mark=\"file-name\"]').innerText.includes(words)", arg=words
    )


def speed(page: Any, value: str) -> None:
    """Give the drive a speed."""
    mark(page, "way-form").click()
    if not page.get_by_label("speed rpm", exact=True).first.is_visible():
        mark(page, "table-duty").click()
    typed(page, "speed rpm", value)
    state(page, "not saved")


def stored(page: Any, text: str) -> None:
    """Wait until the browser keeps a text."""
    page.wait_for_function("text => (sessionStorage.getItem('cardan-kept') ?? '').includes(text)", arg=text)


def test_the_token_is_not_left_in_the_address(page_of: Open, url: str) -> None:
    page = page_of("about:blank")
    page.goto(f"{url}/?token={TOKENS[url]}&example=z-arrangement")
    ready(page)
    assert page.url == f"{url}/?example=z-arrangement"
    assert "not saved" in mark(page, "file-name").inner_text()
    held = [one for one in page.context.cookies() if one["value"] == TOKENS[url]]
    assert [(one["httpOnly"], one["sameSite"]) for one in held] == [(True, "Strict")]


def test_a_reload_keeps_text_history_and_variants_of_this_window_alone(page_of: Open, url: str) -> None:
    page = opened(page_of, f"{url}/?example=car-propshaft")
    before = text_of(page)
    speed(page, "1111")
    speed(page, "2222")
    mark(page, "variants-menu").click()
    mark(page, "variants-keep").click()
    mark(page, "variant-name").fill("fast")
    mark(page, "variant-named").click()
    page.wait_for_function("document.querySelector('[data-mark=variants-menu]').innerText.includes('(1)')")
    page.reload()
    ready(page)
    assert page.url == f"{url}/?example=car-propshaft"
    assert "2222" in text_of(page)
    assert "(1)" in mark(page, "variants-menu").inner_text()
    for _step in range(2):
        mark(page, "undo").click()
    page.wait_for_function(
        "text => document.querySelector('.cm-content').cmView.view.state.doc.toString() === text", arg=before
    )
    mark(page, "redo").click()
    page.wait_for_function("document.querySelector('.cm-content').cmView.view.state.doc.toString().includes('1111')")
    other = opened(page_of, page.url)
    assert text_of(other) == before


def test_a_window_that_its_server_does_not_know_goes_on_with_what_the_browser_kept(page_of: Open, url: str) -> None:
    text = f"{SMALL}# mine\n"
    kept = Kept(text=text, example="z-arrangement").packed()
    script = f"if (!sessionStorage['cardan-kept']) sessionStorage['cardan-kept'] = {json.dumps(kept)}"
    page = opened(page_of, f"{url}/?example=z-arrangement", script=script)
    assert text_of(page) == text
    other = opened(page_of, f"{url}/?example=w-arrangement", script=script)  # the address names another drive
    assert text_of(other) == example_text("w-arrangement")


def test_what_the_browser_keeps_is_what_is_seen(page_of: Open, url: str) -> None:
    page = opened(page_of, f"{url}/?example=z-arrangement")
    speed(page, "3333")
    stored(page, "3333")


def test_who_leaves_what_is_not_saved_is_asked(page_of: Open, url: str) -> None:
    page = opened(page_of, f"{url}/?example=z-arrangement")
    assert page.evaluate("window.cardanLosing") is False
    speed(page, "1234")
    page.wait_for_function("window.cardanLosing === true")
    with page.expect_event("dialog") as asked:
        page.close(run_before_unload=True)
    assert asked.value.type == "beforeunload"
    asked.value.dismiss()
    assert not page.is_closed()
    mark(page, "undo").click()
    page.wait_for_function("window.cardanLosing === false")


def test_a_new_drive_is_saved_over_no_other_file_without_a_question(page_of: Open, url: str, folder: Path) -> None:
    (folder / "mine.toml").write_text("# mine\n")
    page = opened(page_of, f"{url}/?example=z-arrangement")
    page.keyboard.press("Control+s")
    name = mark(page, "save-name")
    name.fill("mine")
    mark(page, "save-named").click()
    over = mark(page, "write-over")
    over.wait_for()
    assert "mine.toml" in over.inner_text()
    assert (folder / "mine.toml").read_text() == "# mine\n"
    over.get_by_text("Stay").click()
    over.wait_for(state="detached")
    assert (folder / "mine.toml").read_text() == "# mine\n"
    mark(page, "save-named").click()
    mark(page, "replace").click()
    state(page, "mine.toml ○ saved")
    assert (folder / "mine.toml").read_text("utf-8") == SMALL
    page.wait_for_url(f"{url}/?file=mine.toml")


def test_of_two_windows_on_one_file_the_second_to_save_is_told_and_both_are_kept(
    page_of: Open, url: str, folder: Path
) -> None:
    (folder / "both.toml").write_text(SMALL, "utf-8")
    one, two = (opened(page_of, f"{url}/?file=both.toml") for _k in range(2))
    speed(one, "1111")
    speed(two, "2222")
    one.keyboard.press("Control+s")
    state(one, "both.toml ○ saved")
    mark(two, "disk").wait_for()
    two.keyboard.press("Control+s")
    mark(two, "write-over").wait_for()
    assert "1111" in (folder / "both.toml").read_text("utf-8")
    mark(two, "write-over").locator('[data-mark="disk-both"]').click()
    state(two, "both-2.toml ○ saved")
    assert "1111" in (folder / "both.toml").read_text("utf-8")
    assert "2222" in (folder / "both-2.toml").read_text("utf-8")
    assert not mark(two, "disk").is_visible()


def test_what_another_program_writes_is_seen_and_read_again_with_a_way_back(
    page_of: Open, url: str, folder: Path
) -> None:
    place = folder / "outside.toml"
    place.write_text(SMALL, "utf-8")
    page = opened(page_of, f"{url}/?file=outside.toml")
    speed(page, "1111")
    place.write_text(f"{SMALL}# theirs\n", "utf-8")
    state(page, "changed on the disk")
    mark(page, "disk").locator('[data-mark="disk-reload"]').click()
    state(page, "outside.toml ○ saved")
    assert text_of(page).endswith("# theirs\n")
    mark(page, "undo").click()
    page.wait_for_function("document.querySelector('.cm-content').cmView.view.state.doc.toString().includes('1111')")
    place.unlink()
    state(page, "not saved")
    page.keyboard.press("Control+s")
    state(page, "outside.toml ○ saved")
    assert "1111" in place.read_text("utf-8")


def test_marks_that_turn_a_name_are_shown(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?file=")
    page.wait_for_selector(".start")
    assert page.get_by_text("two\\u202elmot.toml", exact=True).is_visible()
    text = SMALL.replace('name = "', 'name = "a\\u202eb', 1)
    mark(page, "file-menu").click()
    mark(page, "file-send").click()
    sent = {"name": "odd.toml", "mimeType": "text/plain", "buffer": text.encode()}
    page.locator("input[type=file]").set_input_files(sent)
    ready(page)
    assert "\u202e" not in page.evaluate("document.body.innerText")


HEAVY = "format = 1\nduty.speed_rpm = 1000\n" + "".join(
    f"[[joints]]\njoint_angle_deg = {5 + k % 3}\n" for k in range(60)
)


@contextmanager
def standing(process: Any) -> Iterator[None]:
    """Let the processes that a server started do nothing for a while."""
    threads = Path(f"/proc/{process.pid}/task").glob("*/children")
    found = [pid for one in threads for pid in one.read_text().split()]
    pids = [int(pid) for pid in found if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes()]
    assert pids
    for pid in pids:
        os.kill(pid, signal.SIGSTOP)
    try:
        yield
    finally:
        for pid in pids:
            os.kill(pid, signal.SIGCONT)


@pytest.mark.skipif(not Path("/proc/self/task").is_dir(), reason="processes of a process are listed in /proc")
def test_edits_go_on_while_a_heavy_file_of_another_window_is_worked_on(
    page_of: Open, url: str, server: Any, folder: Path
) -> None:
    """Told without a clock: what works on the heavy file stands still, and the other window goes on all the same."""
    assert heavy(HEAVY)
    (folder / "heavy.toml").write_text(HEAVY, "utf-8")
    large, small = opened(page_of, f"{url}/?file=heavy.toml"), opened(page_of, f"{url}/?file=rear.toml")
    judged = mark(large, "judgement").inner_text()
    with standing(server.process):
        mark(large, "way-file").click()
        large.wait_for_selector(".cm-content")
        large.locator(".cm-content").press("Control+End")
        large.keyboard.insert_text("\n[limits]\njoint_angle_deg = 1\n")
        for value in ("40", "50"):
            before = mark(small, "answer").first.inner_text()
            typed(small, "centre mm y", value)
            changed(small, before)
        assert mark(large, "judgement").inner_text() == judged
        assert "not saved" not in mark(large, "file-name").inner_text()
    state(large, "not saved")
    mark(large, "way-geometry").click()  # its table comes in pieces, and all of it
    large.wait_for_function("document.querySelectorAll('.centres .key').length >= 180")
    large.wait_for_function(
        "before => document.querySelector('[data-mark=judgement]').innerText !== before", arg=judged
    )
