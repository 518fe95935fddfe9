"""Torsional vibration in the app: absorber, calm running, run-up, load step and a sweep tell what is told elsewhere."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from cardan import Drive
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.io import example_text
from cardan.io.drive_file import loads
from cardan.register import QUESTIONS, groups
from tests.app.test_page import mark, ready
from tests.app.test_sweep import written

Open = Callable[..., Any]

STEPPED = (
    example_text("pto-flywheel").replace("loss_factor", 'material = "C45"\nloss_factor')
    + """
life_h = 1000

[[duty.events]]
kind = "load_step"
name = "the knives meet hay"
count = 5000
torque_Nm = 900
duration_s = 0.05
"""
)
"""Power take-off shaft whose load steps up."""


ALTERNATING = re.compile("largest alternating torque of torsional vibration at the speed of the duty", re.IGNORECASE)


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> str:
    folder: Path = tmp_path_factory.mktemp("vibration")
    (folder / "stepped.toml").write_text(STEPPED, "utf-8")
    return str(serve(sys.executable, "-m", "cardan", "app", str(folder), "--port", "{port}", "--no-browser").url)


def sheet_of(page: Any, name: str) -> Any:
    """Open the tab of a question, and the question on it; return its sheet once it answers."""
    names = next(names for names in groups().values() if name in names)
    mark(page, f"tab-{names[0]}").click()
    if len(names) > 1:
        mark(page, f"inner-{names[0]}").get_by_text(QUESTIONS[name].title, exact=True).click()
    sheet = mark(page, f"sheet-{name}")
    sheet.locator('[data-mark="answer"]').filter(has_text=sentence(name)).wait_for()
    return sheet


def sentence(name: str, drive: Drive | None = None) -> str:
    """Return the sentence that answers a question about the drive."""
    question, drive = QUESTIONS[name], drive or loads(STEPPED)
    return told(question.answer(drive, question.result(drive)).sentence, USUAL)


def test_measures_against_vibration_a_run_up_and_a_load_step_are_told_in_the_app(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?file=stepped.toml", reduced_motion="reduce", viewport={"width": 1440, "height": 900})
    ready(page)
    absorber = sheet_of(page, "absorber")
    absorber.locator(".cardan-chart .main-svg").first.wait_for()
    assert "N·m" in sentence("absorber")
    sheet_of(page, "optimise")
    run_up = sheet_of(page, "run-up")
    run_up.locator(".cardan-chart .main-svg").first.wait_for()
    strength = sheet_of(page, "strength")
    strength.get_by_text("the knives meet hay").first.wait_for()


def test_the_alternating_torque_is_swept_over_the_speed(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?file=stepped.toml", reduced_motion="reduce", viewport={"width": 1440, "height": 900})
    ready(page)
    mark(page, "tab-sweep").click()
    mark(page, "sweep-ask").click()
    page.locator(".q-menu .q-item").filter(has_text=ALTERNATING).click()
    page.keyboard.press("Escape")
    written(page.get_by_label("key that varies"), "duty.speed_rpm")
    for title, value in (("from 1", "450"), ("to 1", "600"), ("values 1", "2")):
        page.get_by_label(title, exact=True).fill(value)
    mark(page, "sweep-run").click()
    sweep = mark(page, "sheet-sweep")
    sweep.locator('[data-mark="answer"]').filter(has_text="2 points are answered").wait_for()
    sweep.locator(".cardan-chart .main-svg").nth(1).wait_for()
