"""Variants, papers that are stopped, and units of the user's choice, in a real browser."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from cardan.io import example_text, loads

Open = Callable[..., Any]


@pytest.fixture(scope="module")
def server(serve: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    folder = tmp_path_factory.mktemp("variants")
    (folder / "z.toml").write_text(example_text("z-arrangement"), "utf-8")
    (folder / "other.toml").write_text(example_text("w-arrangement"), "utf-8")
    (folder / "long.toml").write_text(example_text("pto-flywheel"), "utf-8")
    command = (sys.executable, "-m", "cardan", "app", str(folder / "z.toml"), "--port", "{port}", "--no-browser")
    return serve(*command)


@pytest.fixture(scope="module")
def url(server: Any) -> str:
    return str(server.url)


@pytest.fixture
def page(page_of: Open, url: str) -> Any:
    opened = page_of(url, reduced_motion="reduce")
    opened.wait_for_selector('[data-mark="answer"]:visible')
    opened.wait_for_function("document.querySelector('[data-mark=judgement]')?.textContent.length > 3")
    return opened


def mark(page: Any, name: str) -> Any:
    return page.locator(f'[data-mark="{name}"]')


@contextmanager
def held(process: subprocess.Popen[bytes]) -> Iterator[None]:
    """Let a process do nothing for a while."""
    process.send_signal(signal.SIGSTOP)
    try:
        yield
    finally:
        process.send_signal(signal.SIGCONT)


def menu(page: Any, item: str) -> None:
    """Choose from the menu of variants."""
    mark(page, "variants-menu").click()
    mark(page, item).first.click()


def kept(page: Any, name: str) -> None:
    """Keep the drive as a variant."""
    menu(page, "variants-keep")
    mark(page, "variant-name").fill(name)
    mark(page, "variant-named").click()
    mark(page, "variant-naming").wait_for(state="detached")


def bent(page: Any, value: str) -> None:
    before = mark(page, "answer").first.inner_text()
    field = page.get_by_label("centre mm y", exact=True).first
    field.fill(value)
    field.press("Enter")
    page.wait_for_function("before => document.querySelector('[data-mark=answer]').innerText !== before", arg=before)


def test_variants_are_kept_compared_and_gone_back_to(page: Any, tmp_path: Path) -> None:
    before = mark(page, "answer").first.inner_text()
    mark(page, "compare").click()
    mark(page, "compare-explained").wait_for()
    page.keyboard.press("Escape")
    kept(page, "as drawn")
    bent(page, "60")
    kept(page, "bent")
    bent(page, "90")

    menu(page, "variants-compare")
    shown = mark(page, "comparison")
    shown.locator("table").first.wait_for()
    heads = shown.locator("table").first.locator("th").all_inner_texts()
    assert [one for one in heads if one in ("now", "as drawn", "bent")] == ["now", "as drawn", "bent"]
    text = shown.inner_text()
    assert "joints[0].centre" in text
    assert "✓" in text
    shown.locator(".cardan-chart").first.wait_for()
    mark(page, "comparison-close").click()
    shown.wait_for(state="detached")

    menu(page, "variant")  # the first one
    page.wait_for_function("before => document.querySelector('[data-mark=answer]').innerText === before", arg=before)
    menu(page, "variant-edit")
    mark(page, "variant-name").fill("straight")
    mark(page, "variant-named").click()
    mark(page, "variant-naming").wait_for(state="detached")
    mark(page, "variants-menu").click()
    mark(page, "variant").filter(has_text="straight").wait_for()
    assert mark(page, "variant").count() == 2
    with page.expect_download() as saved:
        mark(page, "variant-download").nth(1).click()
    saved.value.save_as(tmp_path / "bent.toml")
    assert saved.value.suggested_filename == "bent.toml"
    assert loads((tmp_path / "bent.toml").read_text("utf-8")).joints[0].centre[1] == pytest.approx(0.06)
    menu(page, "variant-delete")
    mark(page, "variant-gone").click()
    page.wait_for_function("document.querySelector('[data-mark=variants-menu]').innerText.includes('(1)')")


def test_a_file_of_the_folder_stands_beside_the_drive(page: Any) -> None:
    menu(page, "variants-keep-file")
    mark(page, "variant-file").filter(has_text="other.toml").click()
    page.wait_for_function("document.querySelector('[data-mark=variants-menu]').innerText.includes('(1)')")
    mark(page, "compare").click()
    shown = mark(page, "comparison")
    shown.locator("table").first.wait_for()
    assert "other" in shown.locator("th").all_inner_texts()


def test_a_report_that_is_stopped_leaves_the_page_at_work(page: Any, url: str) -> None:
    page.goto(f"{url}/?file=long.toml")
    mark(page, "answer").first.wait_for()
    mark(page, "report-menu").click()
    mark(page, "report-pdf").click()
    mark(page, "making-cancel").click()
    mark(page, "making").wait_for(state="detached")
    mark(page, "report-menu").click()
    with page.expect_download() as saved:
        mark(page, "drive-toml").click()
    assert saved.value.suggested_filename == "long.toml"
    mark(page, "report-menu").click()
    with page.expect_download() as saved:
        mark(page, "view-png").click()
    assert saved.value.path().read_bytes().startswith(b"\x89PNG")


@pytest.mark.skipif(os.name != "posix", reason="only a POSIX process can be held")
def test_menus_open_and_close_while_the_server_is_busy(page: Any, server: Any) -> None:
    page.goto(f"{server.url}/?file=other.toml")
    mark(page, "answer").first.wait_for()
    with held(server.process):
        for name, item in (("variants", "variants-keep"), ("report", "drive-toml"), ("file", "file-open")):
            mark(page, f"{name}-menu").click()
            mark(page, item).first.wait_for()
            page.keyboard.press("Escape")
            mark(page, item).first.wait_for(state="hidden")
        mark(page, "settings").click()
        mark(page, "theme").wait_for()


@pytest.mark.slow
def test_answers_are_in_the_units_and_with_the_sign_that_the_user_chose(page: Any) -> None:
    mark(page, "settings").click()
    mark(page, "unit-angle").click()
    page.get_by_role("option", name="rad", exact=True).click()
    mark(page, "decimal").get_by_text("1,5").click()
    page.keyboard.press("Escape")
    page.wait_for_function(
        "[...document.querySelectorAll('.answer th')].some(one => one.innerText.includes('rad'))"
        " && /\\d,\\d/.test(document.querySelector('.answer td:nth-child(2)').innerText)"
    )
