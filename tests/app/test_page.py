"""The app as a user meets it, in a real browser: every part once, and what must not break it."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest

from cardan import equivalent_joint
from cardan.io import example_text, load, loads
from tests.app.conftest import PATIENCE

Open = Callable[..., Any]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("drives")
    (made / "rear.toml").write_text(example_text("truck-printed-coordinates"), "utf-8")
    return made


@pytest.fixture(scope="module")
def url(serve: Callable[..., Any], folder: Path) -> str:
    command = (sys.executable, "-m", "cardan", "app", str(folder / "rear.toml"), "--port", "{port}", "--no-browser")
    return str(serve(*command).url)


@pytest.fixture
def page(page_of: Open, url: str) -> Any:
    opened = page_of(url, reduced_motion="reduce")  # the drive stands still: software rendering is slow
    ready(opened)
    return opened


def mark(page: Any, name: str) -> Any:
    """Return the part of the page that carries a mark."""
    return page.locator(f'[data-mark="{name}"]')


def ready(page: Any) -> None:
    """Wait until answers and verdicts are there."""
    page.wait_for_selector('[data-mark="answer"]:visible')
    page.wait_for_function("document.querySelector('[data-mark=judgement]')?.textContent.length > 3")


def text_of(page: Any) -> str:
    """Return the text of the file as the editor shows it."""
    mark(page, "way-file").click()
    page.wait_for_selector(".cm-content")
    return str(page.evaluate("document.querySelector('.cm-content').cmView.view.state.doc.toString()"))


def changed(page: Any, before: str) -> None:
    """Wait until the answer is another one."""
    script = "before => document.querySelector('[data-mark=answer]').innerText !== before"
    page.wait_for_function(script, arg=before)


def typed(page: Any, label: str, value: str) -> None:
    """Write a value into a field of the form."""
    field = page.get_by_label(label, exact=True).first
    field.fill(value)
    field.press("Enter")


def test_an_example_is_opened_from_its_picture(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?file=none-of-this-name.toml", reduced_motion="reduce")
    page.wait_for_selector(".start")
    assert "none-of-this-name" in page.locator(".q-notification").inner_text()
    picture = mark(page, "example-two-piece-rear-drive").locator("img")
    picture.scroll_into_view_if_needed()
    page.wait_for_function(
        "document.querySelector('[data-mark=\"example-two-piece-rear-drive\"] img').naturalWidth > 0"
    )
    mark(page, "example-two-piece-rear-drive").click()
    ready(page)
    assert "front tube" in text_of(page)


def test_an_edit_changes_curve_verdicts_and_text_and_is_undone(page: Any) -> None:
    before = mark(page, "answer").first.inner_text()
    typed(page, "centre mm y", "40")
    changed(page, before)
    assert re.search(r"centre_mm = \[[^,]+, 40,", text_of(page))
    mark(page, "undo").click()
    page.wait_for_function("before => document.querySelector('[data-mark=answer]').innerText === before", arg=before)
    mark(page, "redo").click()
    changed(page, before)


def test_synchronous_phases_are_applied_at_a_touch(page: Any) -> None:
    before = mark(page, "answer").first.inner_text()
    mark(page, "make-synchronous").click()
    changed(page, before)
    assert float(equivalent_joint(loads(text_of(page))).speed_fluctuation) < 1e-9


def test_every_tab_gives_an_answer(page: Any) -> None:
    tabs = page.locator('[data-mark^="tab-"]')
    names = [tabs.nth(k).get_attribute("data-mark") for k in range(tabs.count())]
    assert len(names) >= 8
    for name in names:
        mark(page, name).click()
        page.wait_for_function(
            "[...document.querySelectorAll('.pane.answers .sheet')].some(e => e.offsetParent"
            " && e.innerText.trim().length > 20)"
        )


def test_a_wrong_value_is_told_in_the_loaders_words_and_the_rest_goes_on(page: Any) -> None:
    before = mark(page, "answer").first.inner_text()
    typed(page, "centre mm x", "far")
    page.wait_for_selector('[data-mark="problems"] .wrong')
    assert "centre_mm" in mark(page, "problems").inner_text()
    assert mark(page, "answer").first.inner_text() == before
    typed(page, "centre mm x", "1")
    page.wait_for_function("!document.querySelector('[data-mark=problems]').offsetParent")


def test_a_text_that_is_no_toml_is_told_and_taken_back(page: Any) -> None:
    mark(page, "way-file").click()
    page.wait_for_selector(".cm-content")
    page.locator(".cm-line").first.click()
    page.keyboard.press("Control+Home")
    page.keyboard.type("[[[ ")
    page.wait_for_selector('[data-mark="problems"] .wrong')
    mark(page, "undo").click()
    page.wait_for_function("!document.querySelector('[data-mark=problems]').offsetParent")


BAD = {
    "broken.toml": (b"[[joints]\nx", "TOML"),
    "empty.toml": (b"# nothing yet\n", "empty.toml: holds no table"),
    "photo.toml": (b"\x89PNG\r\n\x1a\n\xff\xfe", "UTF-8"),
    "bomb.json": (b"[" * 200_000, "levels"),
    "deep.toml": (b"format = 1\n" + b".".join([b"a"] * 50_000) + b" = 1\n", "49999 levels"),
    "long.toml": (b"format = 1\n" + b"[[joints]]\njoint_angle_deg = 1\n" * 3000, "3000 [[joints]]"),
}
"""Files that are refused, each with words of the reason."""


def test_bad_uploads_are_refused_in_words(page: Any) -> None:
    before = text_of(page)
    for name, (content, words) in BAD.items():
        mark(page, "file-menu").click()
        mark(page, "file-send").click()
        sent = {"name": name, "mimeType": "text/plain", "buffer": content}
        page.locator("input[type=file]").set_input_files(sent)
        page.locator(".q-notification").filter(has_text=words).wait_for()
        if page.locator("input[type=file]").count():
            page.keyboard.press("Escape")
            page.locator(".q-dialog__inner").wait_for(state="detached")
    assert text_of(page) == before


def test_a_name_that_is_markup_stays_a_name(page: Any) -> None:
    text = example_text("car-propshaft").replace('"tube"', '"<b>x</b><script>document.title=1</script>"')
    text = text.replace('"gearbox"', '"<img src=x onerror=document.title=1>"')
    sent = {"name": "odd.toml", "mimeType": "text/plain", "buffer": text.encode()}
    mark(page, "file-menu").click()
    mark(page, "file-send").click()
    page.locator("input[type=file]").set_input_files(sent)
    page.wait_for_function("document.body.innerText.includes('<b>x</b>')")
    assert page.locator("img[src=x]").count() == 0
    assert page.title() == "cardan"


def test_two_windows_do_not_see_each_other(page_of: Open, url: str) -> None:
    one, two = page_of(url, reduced_motion="reduce"), page_of(url, reduced_motion="reduce")
    ready(one)
    ready(two)
    typed(one, "centre mm y", "33")
    one.wait_for_function("document.querySelector('[data-mark=\"file-name\"]').innerText.includes('not saved')")
    assert ", 33," not in text_of(two)
    assert "not saved" not in mark(two, "file-name").inner_text()


def test_saving_writes_the_file_of_the_folder(page_of: Open, url: str, folder: Path) -> None:
    (folder / "saved.toml").write_text(example_text("z-arrangement"), "utf-8")
    page = page_of(f"{url}/?file=saved.toml", reduced_motion="reduce")
    ready(page)
    mark(page, "table-duty").click()
    typed(page, "speed rpm", "1234")
    page.wait_for_function("document.querySelector('[data-mark=\"file-name\"]').innerText.includes('not saved')")
    page.keyboard.press("Control+s")
    page.wait_for_function("!document.querySelector('[data-mark=\"file-name\"]').innerText.includes('not saved')")
    speed = load(folder / "saved.toml").duty.speed
    assert speed == pytest.approx(1234 * 3.141592653589793 / 30)


def test_the_page_speaks_russian_and_remembers_it(page_of: Open, url: str) -> None:
    page = page_of(url, reduced_motion="reduce")
    ready(page)
    mark(page, "language-ru").click()
    page.wait_for_function("document.documentElement.lang === 'ru'")
    page.wait_for_function("document.querySelector('[data-mark=\"way-form\"]').innerText.match(/[А-Яа-я]/)")
    kept = {one["name"]: one["value"] for one in page.context.cookies()}
    page.reload()
    page.wait_for_function("document.documentElement.lang === 'ru'")
    assert "cardan_choices" in kept
    ready(page)
    mark(page, "way-form").click()
    field = page.get_by_label("centre мм y", exact=True).first
    for wrong in ("abc", "abd"):  # what cannot be taken is told in the language of the page, whoever found it
        field.fill(wrong)
        field.press("Enter")
        page.wait_for_function(
            "told => document.querySelector('[data-mark=problems]').innerText.includes(told)", arg=wrong
        )
        told = mark(page, "problems").inner_text()
        assert re.match(r"Шарнир 1 · centre_mm y: [а-я]", told), told


COVERED = """() => [...document.querySelectorAll("button, input, [role=tab]")].map(one => {
  const box = one.getBoundingClientRect(), x = box.left + box.width / 2, y = box.top + box.height / 2;
  const met = box.width ? document.elementFromPoint(x, y) : null;
  const covered = met && !one.contains(met) && met.matches(".q-icon");
  return covered ? `${met.innerText} over ${one.outerHTML.slice(0, 120)}` : "";
}).filter(found => found)"""


def test_icons_without_their_font_take_no_clicks_of_their_neighbours(page_of: Open, url: str) -> None:
    page = page_of(url, reduced_motion="reduce", allow=("net::ERR_FAILED",))
    page.route("**/*.woff2", lambda one: one.abort())
    page.reload()
    ready(page)
    assert page.evaluate(COVERED) == []


def test_every_export_opens_with_its_own_library(page: Any, tmp_path: Path) -> None:
    opened: list[str] = []
    for kind, check in EXPORTS.items():
        mark(page, "report-menu").click()
        with page.expect_download(timeout=PATIENCE) as waiting:
            mark(page, kind).click()
        place = tmp_path / waiting.value.suggested_filename
        waiting.value.save_as(place)
        check(place.read_bytes())
        opened.append(kind)
    assert opened == list(EXPORTS)


def _html(content: bytes) -> None:
    from html.parser import HTMLParser

    HTMLParser().feed(content.decode("utf-8"))
    assert b"<svg" in content


def _pdf(content: bytes) -> None:
    from pypdf import PdfReader

    assert len(PdfReader(BytesIO(content)).pages) >= 3


def _xlsx(content: bytes) -> None:
    from openpyxl import load_workbook

    assert len(load_workbook(BytesIO(content)).sheetnames) >= 3


def _toml(content: bytes) -> None:
    assert loads(content.decode("utf-8")).joints


def _json(content: bytes) -> None:
    assert json.loads(content)["joints"]


EXPORTS = {
    "report-html": _html,
    "report-pdf": _pdf,
    "report-xlsx": _xlsx,
    "drive-toml": _toml,
    "drive-json": _json,
}


def test_joints_come_and_go_and_the_view_goes_along(page: Any) -> None:
    mark(page, "scene").get_by_text("joint 4", exact=True).wait_for()
    for name, gone in (("a joint after this one", False), ("take this joint out", True)):
        page.get_by_label(name, exact=True).first.click()
        page.locator('[data-mark="table-joints[4]"]').wait_for(state="detached" if gone else "attached")
        shown = mark(page, "scene").get_by_text("joint 5", exact=True)
        shown.wait_for(state="detached" if gone else "attached")


def test_ends_of_lines_stay_as_the_file_has_them_and_a_pose_written_can_be_looked_at(
    page_of: Open, url: str, folder: Path
) -> None:
    lines = example_text("truck-printed-coordinates").replace("\n", "\r\n")
    (folder / "windows.toml").write_bytes(lines.encode())
    unseen = "Anchor: target"  # hints of the form, built anew while the text is looked at
    page = page_of(f"{url}/?file=windows.toml", reduced_motion="reduce", allow=(unseen,))
    ready(page)
    assert not mark(page, "pose").is_visible()
    text_of(page)
    page.locator(".cm-content").press("Control+End")
    page.keyboard.insert_text('\n[[poses]]\nname = "low"\nset = { "output.point_mm" = [2000, 0, -300] }')
    mark(page, "pose").wait_for()
    mark(page, "language-ru").click()  # builds the page anew, and it still saves once
    page.wait_for_function("document.documentElement.lang === 'ru'")
    ready(page)
    page.keyboard.press("Control+s")
    page.wait_for_selector(".q-notification")
    assert page.locator(".q-notification").count() == 1
    saved = (folder / "windows.toml").read_bytes().decode()
    assert saved.startswith(lines.rstrip())
    assert saved.count("\r\n") == saved.count("\n")


def test_what_an_answer_lacks_is_offered_as_fields_and_then_it_is_there(page_of: Open, url: str) -> None:
    page = page_of(f"{url}/?drive=new", reduced_motion="reduce")
    ready(page)
    bare = page.locator(".asked .q-tab.bare")
    assert "Forces" in bare.all_inner_texts()
    mark(page, "tab-forces").click()
    offer = page.locator('[data-mark="sheet-forces"] [data-mark="offer"]')
    field = offer.get_by_label("torque N·m", exact=True)
    assert re.match(r"such as \d", field.get_attribute("placeholder"))
    offer.locator('[data-mark="add-supports"]').wait_for()
    field.fill("800")
    field.press("Enter")
    offer.locator('[data-mark="key-duty.torque_Nm"]').wait_for(state="detached")
    offer.locator('[data-mark="add-supports"]').click()
    offer.wait_for(state="hidden")
    page.wait_for_function(
        "[...document.querySelectorAll('.asked .q-tab.bare')].every((tab) => !tab.innerText.includes('Forces'))"
    )
    drive = loads(text_of(page))
    assert drive.duty.torque == 800.0
    assert len(drive.supports) == 1


def test_what_nothing_can_be_judged_without_is_offered_too(page_of: Open, url: str) -> None:
    """The half shaft tells its torque and no size: its strength needs these, and says so with fields."""
    page = page_of(f"{url}/?example=front-halfshaft", reduced_motion="reduce")
    ready(page)
    mark(page, "tab-strength").click()
    offer = page.locator('[data-mark="sheet-strength"] [data-mark="offer"]')
    field = offer.get_by_label("outer mm", exact=True)
    field.fill("32")
    field.press("Enter")
    field.wait_for(state="detached")
    assert loads(text_of(page)).shafts[1].outer == pytest.approx(0.032)


def test_the_geometry_stands_in_its_views_and_as_numbers(page: Any) -> None:
    mark(page, "way-geometry").click()
    page.locator(".drag-views circle").first.wait_for()
    assert page.locator(".drag-views circle").count() == 2 * 6  # four joints and two ends, from the side and from above
    before = mark(page, "answer").first.inner_text()
    field = page.locator(".centres").get_by_label("centre mm y", exact=True).first
    field.fill("40")
    field.press("Enter")
    changed(page, before)
