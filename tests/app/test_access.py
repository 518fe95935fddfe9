"""The app for everybody: axe-core finds nothing, letters and targets are large enough, nothing is cut on a phone."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Sequence
from typing import Any
from urllib.parse import quote

import pytest

from cardan.io import example_names

axe = pytest.importorskip("axe_playwright_python.sync_playwright", reason="axe-playwright-python is not installed")

Open = Callable[..., Any]

TAGS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]

SIZES = {"desk": (1440, 900), "tablet": (1024, 768), "phone": (390, 844)}


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = str(tmp_path_factory.mktemp("drives"))
    return str(serve(sys.executable, "-m", "cardan", "app", folder, "--port", "{port}", "--no-browser").url)


@pytest.fixture
def opened(page_of: Open, url: str) -> Open:
    """Return a function that opens a page with choices of its user."""

    def open_page(where: str, size: str, language: str = "en", theme: str = "light") -> Any:
        width, height = SIZES[size]
        cookie = quote(json.dumps({"language": language, "theme": theme}))
        page = page_of(
            f"{url}{where}",
            reduced_motion="reduce",
            viewport={"width": width, "height": height},
            cookies={"cardan_choices": cookie},
        )
        page.wait_for_selector(".start .card" if where == "/" else '[data-mark="answer"]:visible')
        if where != "/":
            page.wait_for_function("document.querySelector('[data-mark=judgement]')?.textContent.length > 3")
            page.wait_for_selector(".cardan-chart .main-svg")
        assert page.evaluate("document.documentElement.lang") == language
        return page

    return open_page


LETTERS = """() => {
  const found = new Set(), walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const one = walk.currentNode.parentElement;
    if (!walk.currentNode.textContent.trim() || !one.checkVisibility({visibilityProperty: true})) continue;
    const size = parseFloat(getComputedStyle(one).fontSize);
    if (size >= 12 || one.closest('.drawing, .material-icons')) continue;
    found.add(`${size} ${one.className} ${one.textContent.slice(0, 30)}`);
  }
  return [...found];
}"""
"""Texts in letters of less than 12 pixels, drawings of the report apart, which are scaled as a whole."""

TARGETS = """() => {
  const touched = 'button, a[href], input, select, summary, [role=tab], [role=slider], [tabindex="0"]';
  const found = [];
  for (const one of document.querySelectorAll(touched)) {
    if (!one.checkVisibility({visibilityProperty: true}) || one.closest('.cm-editor, .edge, .skip')) continue;
    const whole = one.closest('.q-field__control, .q-slider, .q-checkbox, .q-toggle') ?? one;
    const {width, height} = whole.getBoundingClientRect();
    if (width <= 1 || Math.min(width, height) >= 23.5) continue;
    found.push(`${width.toFixed(0)}x${height.toFixed(0)} ${one.className} ${one.ariaLabel ?? one.innerText}`);
  }
  return found;
}"""
"""What is to be touched and is smaller than 24 pixels; edges of panes are as long as these."""

CUT = """() => [...document.querySelectorAll('.pane.file input:not([type=file], .q-select__focus-target)')]
  .filter((one) => one.checkVisibility() && one.scrollWidth > one.clientWidth + 1)
  .map((one) => `${one.ariaLabel}: ${one.value}`)"""
"""Fields that do not show all of their number."""

BESIDE = """() => [...document.querySelectorAll('.lights summary .value .word > *')]
  .filter((one) => one.checkVisibility())
  .filter((one) => one.getBoundingClientRect().right > one.closest('.lights').getBoundingClientRect().right + 1)
  .map((one) => one.textContent)"""
"""Limits of verdicts that reach beyond their pane."""

OUT = """() => [...document.querySelectorAll('.view > .tools > *, .view .bar > *')]
  .filter((one) => one.checkVisibility())
  .filter((one) => one.getBoundingClientRect().bottom > one.parentElement.getBoundingClientRect().bottom + 1)
  .map((one) => one.outerHTML.slice(0, 100))"""
"""What stands out of the bars above and below the picture."""

WIDER = "() => document.documentElement.scrollWidth - innerWidth"
"""By how much the page is wider than the window."""

CHARTS = """() => [...document.querySelectorAll('.cardan-chart')].flatMap((chart) => {
  if (!chart.checkVisibility()) return [];
  const found = [], page = chart.getBoundingClientRect(), scrolled = chart.scrollWidth > chart.clientWidth + 1;
  const box = (one) => [one.textContent, one.getBoundingClientRect()];
  const boxes = (names) => [...chart.querySelectorAll(names)].map(box);
  for (const [text, {left, right}] of boxes('.xtick text, .ytick text, .g-xtitle text, .g-ytitle text'))
    if (left < page.left - 1 || (right > page.right + 1 && !scrolled)) found.push(`cut: ${text}`);
  for (const [text, {top}] of boxes('.annotation text'))
    for (const [, {bottom, height}] of boxes('g.legend .bg'))
      if (height && top < bottom - 2) found.push(`under the legend: ${text}`);
  const numbers = boxes('.xtick text').filter(([text]) => text);
  for (const [k, [text, one]] of numbers.entries())
    for (const [other, two] of numbers.slice(k + 1))
      if (Math.min(one.right, two.right) > Math.max(one.left, two.left) + 1 && Math.abs(one.top - two.top) < 2)
        found.push(`${text} on ${other}`);
  return found;
})"""
"""What is cut in charts, and what stands on each other."""


ALL = ("minor", "moderate", "serious", "critical")
"""How grave what axe-core finds may be."""


def refused(page: Any, impacts: Sequence[str] = ALL, within: str | None = None) -> list[str]:
    """Return what axe-core has to say, of a part of the page where that is named: the rest was asked before."""
    if not page.evaluate("'axe' in window"):
        page.evaluate(axe.Axe().axe_script)
    found = page.evaluate(AXE, [within, TAGS])
    some = [one for one in found if one["impact"] in impacts]
    return [f"{one['id']}: {node['target']} {node['html'][:160]}" for one in some for node in one["nodes"]]


AXE = """async ([within, values]) => (await axe.run(within ?? document,
  {runOnly: {type: 'tag', values}, resultTypes: ['violations']})).violations"""
"""Asks axe-core for what it refuses and nothing else: to bring all that is good across takes longer than to look."""


def judge(page: Any, where: str, **how: Any) -> None:
    """Fail where anything keeps somebody out of what the page shows."""
    found = {"axe": refused(page, **how)}
    found |= {name: page.evaluate(script) for name, script in LOOKS.items()}
    found["wider"] = [one for one in [page.evaluate(WIDER)] if one > 0]
    told = [f"{name}: {one}" for name, some in found.items() for one in some]
    assert not told, f"{where}:\n" + "\n".join(told)


LOOKS = {"letters": LETTERS, "targets": TARGETS, "cut": CUT, "beside": BESIDE, "out": OUT, "charts": CHARTS}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("size", "language", "theme"), [("desk", "en", "light"), ("tablet", "en", "dark"), ("phone", "ru", "dark")]
)
def test_nothing_keeps_anybody_out_of_the_first_page(opened: Open, size: str, language: str, theme: str) -> None:
    judge(opened("/", size, language, theme), "first page")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("example", "size", "language", "theme"),
    [
        ("truck-supports", "desk", "en", "light"),
        ("pto-flywheel", "tablet", "ru", "light"),
        ("pto-hitch", "desk", "ru", "dark"),
        ("truck-supports", "phone", "ru", "dark"),
        ("pto-hitch", "phone", "en", "light"),
    ],
)
def test_nothing_keeps_anybody_out_of_a_drive(opened: Open, example: str, size: str, language: str, theme: str) -> None:
    page = opened(f"/?example={example}", size, language, theme)
    judge(page, "as it opens")
    for name in page.locator('[data-mark^="tab-"]').evaluate_all("all => all.map((one) => one.dataset.mark)"):
        page.locator(f'[data-mark="{name}"]').click()
        mark = f'[data-mark="{name.replace("tab", "sheet", 1)}"]'
        sheet = page.locator(mark)
        begun = '[data-mark="recording-hint"], [data-mark="sweep-run"]'  # where nothing is answered before it is asked
        sheet.locator(f'[data-mark="answer"]:not(:empty), {begun}').first.wait_for()
        if sheet.locator(".cardan-chart").count():
            sheet.locator(".cardan-chart .main-svg").last.wait_for(state="attached")
        page.wait_for_timeout(QUIET)
        judge(page, name, within=mark)
    for name in ("way-geometry", "way-file"):
        page.locator(f'[data-mark="{name}"]').click()
        page.wait_for_timeout(2 * QUIET)
        judge(page, name)


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "ru"])
@pytest.mark.parametrize("where", ["/", "/?example=pickup-two-piece"])
def test_nothing_keeps_anybody_out_at_any_width_in_any_language_and_light(
    opened: Open, where: str, language: str
) -> None:
    page = opened(where, "desk", language, "auto")
    for width, height in SIZES.values():
        page.set_viewport_size({"width": width, "height": height})
        for scheme in ("light", "dark"):
            page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
            page.wait_for_function(f"document.body.classList.contains('body--{scheme}')")
            page.wait_for_timeout(QUIET)
            judge(page, f"{width} {scheme}")


@pytest.mark.slow
def test_examples_are_called_in_the_language_of_the_page(opened: Open) -> None:
    names = opened("/", "desk", "ru", "light").locator(".start .card .head").all_inner_texts()
    assert len(names) == len(example_names())
    assert [one for one in names if not re.search("[а-я]", one)] == []


QUIET = 600
"""Milliseconds after which a chart was drawn in the room that there is."""


@pytest.mark.slow
def test_menus_and_dialogs_keep_nobody_out(opened: Open) -> None:
    page = opened("/?example=car-propshaft", "desk", "ru", "dark")
    for name in ("settings", "report-menu", "variants-menu", "show", "file-menu", "file-save-as", "file-send"):
        if name in ("file-save-as", "file-send"):
            page.locator('[data-mark="file-menu"]').click()
        page.locator(f'[data-mark="{name}"]').click()
        page.locator(".q-menu, .q-dialog__inner").last.wait_for()
        page.wait_for_timeout(QUIET)
        judge(page, name, impacts=("serious", "critical"))  # a menu is no region of the page
        page.keyboard.press("Escape")
        page.locator(".q-menu, .q-dialog__inner").wait_for(state="detached")


@pytest.mark.slow
def test_keys_reach_the_drive_past_the_bar_and_show_where_they_are(opened: Open) -> None:
    page = opened("/?example=truck-supports", "desk")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.dataset.mark") == "skip"
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    assert page.evaluate("document.activeElement.closest('#main') !== null")
    for _k in range(60):
        page.keyboard.press("Tab")
        ring = page.evaluate(
            """() => { const one = document.activeElement, look = getComputedStyle(one);
              const helped = one.querySelector('.q-focus-helper') ?? one.closest('.q-field, .q-slider, .q-tab');
              return look.outlineStyle !== 'none' || look.boxShadow !== 'none' || Boolean(helped); }"""
        )
        assert ring, page.evaluate("document.activeElement.outerHTML.slice(0, 200)")
