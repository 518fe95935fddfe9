"""A sweep in the app: its rows are those that the command makes of the plan taken along, and they follow the drive."""

from __future__ import annotations

import csv
import sys
from collections.abc import Callable
from math import radians
from pathlib import Path
from typing import Any

import pytest

from cardan import Drive, equivalent_joint
from cardan.errors import InputError
from cardan.figures.figure import Curve
from cardan.io import example_text
from cardan.io.plan_file import plan_of, read_plan
from cardan.report.swept import MOST, Wanted, swept
from cardan.sweeps import sweep
from tests.app.test_page import mark, ready

Open = Callable[..., Any]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("sweeps")
    (made / "pair.toml").write_text(example_text("z-arrangement"), "utf-8")
    return made


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], folder: Path) -> str:
    return str(serve(sys.executable, "-m", "cardan", "app", str(folder), "--port", "{port}", "--no-browser").url)


def written(field: Any, words: str) -> None:
    """Write into a field and take it."""
    field.fill(words)
    field.press("Enter")


def taken(page: Any, name: str, folder: Path) -> Path:
    """Take a file along and return where it is."""
    with page.expect_download() as waiting:
        mark(page, name).click()
    place: Path = folder / waiting.value.suggested_filename
    waiting.value.save_as(place)
    return place


def test_a_sweep_is_drawn_taken_along_and_run_again_by_the_command(page_of: Open, url: str, folder: Path) -> None:
    page = page_of(f"{url}/?file=pair.toml", reduced_motion="reduce", viewport={"width": 1440, "height": 900})
    ready(page)
    mark(page, "tab-sweep").click()
    mark(page, "sweep-run").click()
    page.locator(".q-notification").filter(has_text="varies at least one key").wait_for()
    written(page.get_by_label("key that varies"), "shafts[1].yoke_angle_deg")
    for title, value in (("from 1", "0"), ("to 1", "90"), ("values 1", "7")):
        page.get_by_label(title, exact=True).fill(value)
    mark(page, "sweep-run").click()
    sheet = mark(page, "sheet-sweep")
    sheet.locator('[data-mark="answer"]').filter(has_text="7 points are answered").wait_for()
    sheet.locator(".cardan-chart .main-svg").first.wait_for()
    curve = sheet.locator(".cardan-chart").evaluate("one => [...one.querySelector('.plot').data[0].y]")
    plan, table = taken(page, "sweep-plan", folder), taken(page, "sweep-table", folder)
    again = read_plan(plan)
    found = sweep(again.drive, again.axes, again.ask).table()
    rows = list(csv.DictReader(table.read_text("utf-8").splitlines()))
    assert [float(row["speed_fluctuation_percent"]) for row in rows] == found["speed_fluctuation_percent"].tolist()
    assert curve == pytest.approx(found["speed_fluctuation_percent"].tolist(), abs=1e-5)
    # A second key makes a map; an edit of the drive makes the sweep anew.
    mark(page, "sweep-more").click()
    written(page.get_by_label("key that varies").nth(1), "duty.speed_rpm")
    page.wait_for_function("document.querySelector('[aria-label=\"to 2\"]').value !== ''")  # about that of the drive
    page.get_by_label("values 2", exact=True).fill("3")
    mark(page, "sweep-run").click()
    said = sheet.locator('[data-mark="answer"]')
    said.filter(has_text="21 points are answered").wait_for()
    sheet.locator("figure .title").filter(has_text="over shafts[1].yoke_angle_deg and duty").wait_for()
    # Too many points are refused in words, with the limit and the way to more.
    page.get_by_label("values 1", exact=True).fill("9999")
    mark(page, "sweep-run").click()
    page.locator(".q-notification").filter(has_text=f"at most {MOST}").wait_for()
    page.get_by_label("take out 2").click()
    # A long sweep says how far it is and is stopped.
    mark(page, "sweep-ask").click()
    page.locator(".q-menu .q-item").filter(has_text="Greatest utilisation over all checks").click()
    page.keyboard.press("Escape")
    page.get_by_label("values 1", exact=True).fill("5000")
    mark(page, "sweep-run").click()
    mark(page, "tab-motion").click()  # nobody looks: it is given up, and begun again once somebody does
    mark(page, "tab-sweep").click()
    sheet.locator('[data-mark="cancel"]').click()
    sheet.locator('[data-mark="again"]').wait_for()


def test_a_sweep_asks_the_drive_at_every_point() -> None:
    drive = Drive.from_angles([0.3, 0.3])
    found = swept(drive, Wanted(vary=(("joints[1].joint_angle_deg", 10.0, 20.0, 3),)))
    rows = [float(line.split(",")[1]) for line in found.table.splitlines()[1:]]
    bent = [Drive.from_angles([0.3, radians(angle)]) for angle in (10.0, 15.0, 20.0)]
    assert rows == pytest.approx([100.0 * float(equivalent_joint(one).speed_fluctuation) for one in bent], rel=1e-9)
    (figure,) = found.figures.values()
    curve = figure.rows[0].panels[0].series[0]
    assert isinstance(curve, Curve)
    assert curve.y.tolist() == rows
    assert [type(block).__name__ for block in found.page.blocks] == ["Table"]


def test_a_plan_file_says_what_was_wanted(tmp_path: Path) -> None:
    wanted = Wanted(vary=(("duty.speed_rpm", 500.0, 1500.0, 3),), ask=("ratio", "mass"))
    (tmp_path / "it.toml").write_text(example_text("car-propshaft"), "utf-8")
    plan = plan_of(wanted.plan("it.toml"), folder=tmp_path)
    assert (plan.axes, plan.ask) == (wanted.axes(), wanted.ask)


def test_what_a_sweep_lacks_is_told_at_once() -> None:
    wanted = Wanted(vary=(("duty.speed_rpm", None, 2.0, 3), ("", 0.0, 1.0, 0)))
    with pytest.raises(InputError) as told:
        wanted.axes()
    assert [one.field for one in told.value.problems] == ["duty.speed_rpm: from", "key"]
