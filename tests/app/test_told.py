"""What the page tells, in a real browser: the number first, limits and shares, values at the cursor, teeth, menus."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable
from math import degrees
from typing import Any
from urllib.parse import quote

import pytest

from cardan.io import example, loads
from cardan.report.answers import subject
from cardan.report.verdict_list import headline, lights, sentence
from tests.app.test_page import mark, ready, text_of, typed

Open = Callable[..., Any]

DESK = {"width": 1440, "height": 900}


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = str(tmp_path_factory.mktemp("drives"))
    return str(serve(sys.executable, "-m", "cardan", "app", folder, "--port", "{port}", "--no-browser").url)


@pytest.fixture
def opened(page_of: Open, url: str) -> Open:
    """Return a function that opens an example."""

    def open_page(name: str, language: str = "en") -> Any:
        cookie = quote(json.dumps({"language": language}))
        where = f"{url}/?example={name}"
        page = page_of(where, reduced_motion="reduce", viewport=DESK, cookies={"cardan_choices": cookie})
        ready(page)
        return page

    return open_page


@pytest.mark.slow
def test_what_is_rounding_has_no_digits_in_large_letters() -> None:
    on = subject(example("pickup-two-piece"))
    assert 0.0 < on.fluctuation < 1e-5
    assert headline(on, lights(on, swift=True)).value == "< 0.001 %"


SIZE = "one => parseFloat(getComputedStyle(one).fontSize)"


def test_the_one_number_stands_first_and_large_and_beside_every_verdict_its_limit_and_share(opened: Open) -> None:
    page = opened("truck-printed-coordinates")
    on = subject(example("truck-printed-coordinates"))
    shown = lights(on)
    number = mark(page, "headline").locator("b")
    assert number.inner_text() == headline(on, shown).value
    assert number.inner_text().startswith("9.47")
    assert mark(page, "judgement").inner_text() == sentence(shown)
    assert re.match(r"\d+ of \d+ checks? fail", sentence(shown))
    assert number.evaluate(SIZE) > 1.5 * mark(page, "judgement").evaluate(SIZE)
    assert number.bounding_box()["y"] < mark(page, "judgement").bounding_box()["y"]
    told = page.locator(".lights summary .value")
    assert told.count() == len(shown) >= 3
    for one, light in zip(told.all_inner_texts(), shown, strict=True):
        value, beside = one.split("\n", 1)
        assert value == light.value.text
        assert beside.split() == [*light.limit.split(), f"{100 * light.used:.0f}", "%"]


HOVER = "document.querySelector('[data-mark=sheet-motion] .cardan-chart .hoverlayer').textContent"


def test_the_cursor_of_a_chart_tells_the_values_where_keys_or_the_hand_put_it(opened: Open) -> None:
    page = opened("truck-printed-coordinates")
    chart = page.locator("[data-mark=sheet-motion] .cardan-chart").first
    chart.locator(".cursors > div").first.wait_for(state="attached")
    chart.focus()
    page.keyboard.press("ArrowRight")
    page.wait_for_function(f"{HOVER}.startsWith('5.000')")
    assert degrees(page.evaluate("cardanView.angle")) == pytest.approx(5.0)
    assert re.search(r"shaft 5, output : [\d.]{5}", page.evaluate(HOVER))
    mark(page, "tab-motion").focus()
    page.wait_for_function(f"{HOVER} === ''")
    # Lower panels name their curves too, as the legend does; while the cursor is dragged its values are told.
    places = "one => { const y = one.querySelector('.plot')._fullLayout.yaxis2; return y._offset + y._length / 2; }"
    chart.scroll_into_view_if_needed()
    box, down = chart.bounding_box(), chart.evaluate(places)
    page.mouse.move(box["x"] + 200, box["y"] + down)
    page.mouse.down()
    page.mouse.move(box["x"] + 300, box["y"] + down, steps=5)
    page.wait_for_function(f"{HOVER}.includes('shaft 5, output : ') && {HOVER}.includes('°shaft 2')")
    assert "trace" not in page.evaluate(HOVER)
    angle = float(page.evaluate(HOVER).split()[0])
    page.wait_for_function("told => Math.abs(cardanView.angle * 180 / Math.PI - told) < 1.5", arg=angle)
    page.mouse.up()


def test_making_it_synchronous_keeps_to_the_teeth_and_says_so_and_what_does_not_exist(opened: Open) -> None:
    page = opened("two-piece-rear-drive")  # 24 teeth on shaft 3: multiples of 15°
    before = text_of(page)
    mark(page, "make-synchronous").click()
    page.locator(".q-notification").filter(has_text="applied, leaves").filter(
        has_text="the best that exists on these splines"
    ).wait_for()
    page.wait_for_function(
        "before => document.querySelector('.cm-content').cmView.view.state.doc.toString() !== before", arg=before
    )
    teeth = degrees(loads(text_of(page)).shafts[2].yoke_angle) / 15.0
    assert teeth == pytest.approx(round(teeth), abs=1e-9)
    mark(page, "make-synchronous").click()
    page.get_by_text("The angles for a uniform output do not exist on these splines").wait_for()


def test_what_can_be_added_fits_and_is_named_in_the_language_of_the_page_the_usual_first(opened: Open) -> None:
    page = opened("truck-power-unit", "ru")  # given by angles
    mark(page, "add").click()
    assert page.locator(".q-menu .q-item").all_inner_texts()[0] == "опора"
    page.keyboard.press("Escape")
    page.locator(".q-menu").wait_for(state="detached")
    mark(page, "table-shafts[1]").locator(".q-item").first.click()
    mark(page, "more-shafts[1]").click()
    page.locator(".q-menu .q-item").first.wait_for()
    offered = page.locator(".q-menu .q-item").all_inner_texts()
    assert all(re.search("[А-Яа-я]", one) for one in offered)
    names = [one.rpartition("(")[2].rstrip(")") for one in offered]
    assert not {"side slope", "plan slope"} & set(names)  # of another form of geometry
    assert names[:2] == ["yoke angle", "inner"]  # of its tube the outer diameter stands there already


def test_places_are_counted_as_the_page_counts_and_keys_named_as_the_file_names_them(opened: Open) -> None:
    page = opened("truck-printed-coordinates")
    typed(page, "centre mm x", "far")
    mark(page, "problems").get_by_text("Joint 1 · centre_mm").wait_for()
    mark(page, "undo").click()
    failed = page.locator(".lights details.failed").first
    failed.locator("summary").click()
    failed.locator("button.apply").first.wait_for()
    cure = failed.locator(".cure code").first.inner_text()
    assert re.match(r"(Shaft|Joint) \d · [a-z_]+(_[A-Za-z]+)? \d? ?= ", cure), cure
    failed.locator("button.apply").first.click()
    page.locator(".q-notification").filter(has_text=f"{cure}: applied").wait_for()


def test_a_remedy_is_applied_that_was_seen_although_others_are_being_looked_for(opened: Open) -> None:
    page = opened("truck-printed-coordinates")
    cures = page.locator(".lights details.failed .cure code")
    cures.first.wait_for(state="attached")
    seen = cures.first.text_content()
    typed(page, "centre mm y", "3.25")
    page.wait_for_function(
        "seen => ![...document.querySelectorAll('.cure code')].some((one) => one.innerText === seen)", arg=seen
    )
    pressed = "seen => {const old = document.createElement('button'); old.dataset.do = `cure ${seen}`;"
    page.evaluate(pressed + "document.querySelector('[data-mark=verdicts] summary').after(old); old.click();}", seen)
    page.locator(".q-notification").filter(has_text=f"{seen}: applied").wait_for()


def test_the_picture_fills_the_screen_and_gives_it_back(opened: Open) -> None:
    page = opened("car-propshaft")
    mark(page, "whole-screen").click()
    page.wait_for_function("document.fullscreenElement?.classList.contains('view')")
    mark(page, "whole-screen").click()
    page.wait_for_function("document.fullscreenElement === null")
