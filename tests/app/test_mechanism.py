"""A mechanism file in the app: opened, shown, edited, taken along; what is wrong with it is told."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from cardan.io import example_text

Open = Callable[..., Any]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("mechanisms")
    (made / "slider.toml").write_text(example_text("crank-slider"), "utf-8")
    (made / "bad.toml").write_text(example_text("crank-slider").replace('type = "P"', 'type = "Q"'), "utf-8")
    (made / "drive.toml").write_text(example_text("single-20deg"), "utf-8")
    return made


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], folder: Path) -> str:
    command = (sys.executable, "-m", "cardan", "app", str(folder / "drive.toml"), "--port", "{port}", "--no-browser")
    return str(serve(*command).url)


@pytest.mark.slow
def test_a_mechanism_is_shown_with_its_picture_motion_and_forces(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?file=slider.toml", reduced_motion="reduce")
    page.wait_for_selector('[data-mark="of-mechanism"]')
    page.wait_for_function("document.querySelector('.sheet')?.innerText.includes('crank bearing carries most')")
    text = page.locator(".sheet").inner_text()
    assert "slides over 100.0 mm" in text
    assert "3 redundant constraints" in text
    assert page.locator(".sheet figure").count() == 4
    assert "missing" not in page.locator("main").inner_text()
    page.locator(".cm-content").click()
    page.evaluate(
        "view => { const v = document.querySelector('.cm-content').cmView.view, d = v.state.doc.toString(),"
        " k = d.indexOf('output_force_N = 800');"
        " v.dispatch({changes: {from: k, to: k + 20, insert: 'output_force_N = 900'}}); }",
        None,
    )
    page.wait_for_function("!document.querySelector('.sheet').innerText.includes('2 421 N')")


@pytest.mark.slow
def test_what_is_wrong_with_a_mechanism_is_told(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?file=bad.toml", reduced_motion="reduce")
    page.wait_for_selector('[data-mark="mechanism-wrong"]:visible')
    said = page.locator('[data-mark="mechanism-wrong"]').inner_text()
    assert "Joint 4 · type" in said
    assert "drive" not in said
