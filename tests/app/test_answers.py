"""Answers and verdicts in a browser: tabs, charts in step with the view, long work, what is applied, what is wrong."""

import re
import sys

import pytest

from cardan.register import QUESTIONS, groups

pytest.importorskip("nicegui", reason="NiceGUI is not installed")

SHEET = ".sheet:visible"


@pytest.fixture(scope="module")
def address(serve, tmp_path_factory):
    folder = tmp_path_factory.mktemp("drives")
    return serve(sys.executable, "-m", "tests.app.answers_server", "{port}", str(folder)).url


@pytest.fixture
def page(page_of, address):
    """Return the page of the truck's power unit, its first chart drawn."""
    shown = page_of(address)
    shown.wait_for_selector(".cardan-chart .main-svg")
    return shown


def mark(name):
    return f"[data-mark='{name}']"


def turn_to(page, name):
    """Open the tab of a question, and the question on it."""
    names = next(names for names in groups().values() if name in names)
    page.click(mark(f"tab-{names[0]}"))
    if len(names) > 1:
        page.locator(mark(f"inner-{names[0]}")).get_by_text(QUESTIONS[name].title, exact=True).click()


def said(page):
    return page.locator(SHEET).locator(mark("answer"))


def test_the_motion_follows_an_edit_in_place_and_its_cursor_the_drive(page):
    chart = page.locator(".cardan-chart").first
    chart.evaluate("one => { one.kept = true }")
    before = said(page).inner_text()
    page.click("#turn")
    page.wait_for_function("before => document.querySelector('.said').textContent !== before", arg=before)
    assert chart.evaluate("one => one.kept")
    lines = page.locator(".cardan-chart").first.locator(".cursors > div")
    assert lines.count() == 3
    place = "one => new DOMMatrix(getComputedStyle(one).transform).m41"
    page.evaluate("dispatchEvent(new CustomEvent('cardan-angle', {detail: {angle: Math.PI}}))")
    half = lines.first.evaluate(place)
    page.evaluate("dispatchEvent(new CustomEvent('cardan-angle', {detail: {angle: 2.5 * Math.PI}}))")
    quarter = lines.first.evaluate(place)
    page.evaluate("dispatchEvent(new CustomEvent('cardan-angle', {detail: {angle: 0}}))")
    start = lines.first.evaluate(place)
    assert start < quarter < half
    assert (half - start) == pytest.approx(2 * (quarter - start), abs=0.5)  # half a pixel
    # Pressing there asks the view to go there.
    page.evaluate("addEventListener('cardan-go-to', event => { window.went = event.detail.angle })")
    box = chart.bounding_box()
    page.mouse.move(box["x"] + quarter, box["y"] + 110)
    page.mouse.down()
    page.mouse.up()
    assert page.evaluate("went") == pytest.approx(1.5708, abs=0.03)  # a pixel or two of 570 for 2 pi
    chart.focus()
    page.keyboard.press("ArrowRight")
    assert page.evaluate("went") == pytest.approx(5 / 57.29578, abs=1e-6)


CURVES = """() => {
  const plot = document.querySelector('.cardan-chart .plot');
  return [...plot.querySelectorAll('g.trace.scatter')].map(one => {
    const trace = one.__data__[0].trace;
    const y = plot._fullLayout[trace.yaxis.replace('y', 'yaxis')];
    const seen = one.querySelector('path.js-line').getAttribute('d').slice(1).split('L').map(at => +at.split(',')[1]);
    return {place: trace.index, seen: seen.map(height => y.p2l(height)), pixel: Math.abs(y.p2l(1) - y.p2l(0))};
  });
}"""
"""The curves of the first chart as they are drawn, read back into what their axes count."""

TURNED = f"""async () => {{
  const curves = {CURVES};
  const heights = () => document.querySelector('.cardan-chart .plot').data.map(one => [...one.y]);
  const other = async look => {{
    const before = JSON.stringify(look());
    while (JSON.stringify(look()) === before) await new Promise(done => setTimeout(done, 2));
    return look();
  }};
  const both = [other(curves), other(heights)];
  document.querySelector('#turn').click();
  return await Promise.all(both);
}}"""
"""Makes an edit; returns the curves as they are drawn first, and the values that plotly draws behind."""


def test_curves_drawn_at_once_stand_where_their_values_are(page):
    sketched, heights = page.evaluate(TURNED)
    whole = [one for one in sketched if len(one["seen"]) == len(heights[one["place"]])]
    assert whole, "no curve was drawn before plotly drew it"
    for one in whole:
        assert one["seen"] == pytest.approx(
            heights[one["place"]], abs=0.02 * one["pixel"]
        )  # two places behind the point


def test_a_setting_is_applied_with_one_touch(page):
    turn_to(page, "phasing")
    sheet = page.locator(SHEET)
    sheet.locator("button[data-do='A']").wait_for()
    assert "exactly uniform with other yoke angles" in said(page).inner_text()
    sheet.locator("button[data-do='A']").click()
    page.wait_for_function("() => document.body.innerText.includes('the yokes are phased right')")
    sheet.locator("button[data-do='A']").wait_for(state="detached")
    turn_to(page, "motion")
    page.wait_for_function("() => document.body.innerText.includes('the output turns exactly uniformly')")
    page.click("#undo")
    page.wait_for_function("() => !document.body.innerText.includes('the output turns exactly uniformly')")
    page.click(mark("make-synchronous"))
    page.wait_for_function("() => document.body.innerText.includes('the output turns exactly uniformly')")
    page.click(mark("make-synchronous"))
    page.wait_for_function("() => document.body.innerText.includes('The yokes stand right')")


PRESSED = """name => {
  const button = [...document.querySelectorAll(name)].find(one => one.offsetParent);
  button?.click();
  return Boolean(button);
}"""
"""Presses a button as soon as it is seen: on a quick machine it is gone in a moment."""


def test_a_long_answer_shows_how_far_it_is_can_be_stopped_and_begun_again(page):
    turn_to(page, "stability")
    page.wait_for_function(PRESSED, arg=f"{mark('sheet-stability')} {mark('cancel')}")
    page.locator(mark("sheet-stability")).locator(mark("again")).wait_for()
    turn_to(page, "torsion")
    page.wait_for_function("() => document.body.innerText.includes('first torsional natural frequency is')")
    assert page.locator(SHEET).locator(mark("cancel")).is_hidden()


def test_every_tab_answers_and_figures_are_taken_along_in_the_reader_s_units(page):
    for name in ("forces", "losses", "accuracy", "life", "strength", "mobility", "selection"):
        turn_to(page, name)
        answer = page.locator(mark(f"sheet-{name}")).locator(mark("answer"))
        answer.filter(has_text="needs more in the drive file").wait_for()
        assert answer.is_visible()
    turn_to(page, "motion")
    page.locator(SHEET).locator(mark("save-figure")).first.click()
    page.wait_for_function("() => document.querySelector('#taken').textContent === 'motion'")
    page.click(mark("compare"))
    page.wait_for_function("() => document.querySelector('#taken').textContent === 'compare'")
    page.click("#inch")
    page.wait_for_function("() => document.querySelector('.said').textContent.includes('20,05°')")


def test_a_failed_verdict_leads_to_its_field_and_its_cure_cures_it_and_a_broken_file_is_told(page):
    failed = page.locator(".lights details.failed").first
    title = failed.locator("summary span").nth(1).inner_text().splitlines()[0]
    failed.locator("summary").click()
    failed.locator("button.apply").first.wait_for()
    page.wait_for_function("() => document.querySelector('#selected').textContent")
    assert re.fullmatch(r"[a-z]+(\[\d+\])?(\.[a-z_]+)*.*", page.locator("#selected").inner_text())
    failed.locator("button.apply").first.click()
    page.wait_for_function(
        "title => ![...document.querySelectorAll('.lights details.failed')].some(e => e.innerText.includes(title))",
        arg=title,
    )
    # A broken file keeps what was sound and says what is wrong.
    before = said(page).inner_text()
    page.click("#break")
    page.wait_for_selector(".lights .list.stale")
    assert "foo" in page.locator(mark("problems-of-verdicts")).inner_text()
    assert said(page).inner_text() == before
    page.click("#undo")
    page.wait_for_selector(".lights .list:not(.stale)")
    assert page.locator(mark("problems-of-verdicts")).inner_text() == ""


def test_two_users_and_a_dark_page_in_russian(page, page_of, address):
    other = page_of(f"{address}?language=ru&theme=dark&example=three-joints-unequal")
    other.wait_for_selector(".cardan-chart .main-svg")
    assert "Движение" in other.locator(mark("tab-motion")).inner_text()
    line = "one => getComputedStyle(one).stroke"
    drawn = [one.locator(".scatterlayer path.js-line").nth(1) for one in (other, page)]
    assert [one.evaluate(line) for one in drawn] == ["rgb(79, 168, 224)", "rgb(0, 114, 178)"]
    here = said(page).inner_text()
    other.click("#turn")
    other.wait_for_timeout(300)
    assert said(page).inner_text() == here


def test_a_recording_is_judged_a_broken_one_refused_and_nobody_else_sees_it(page_of, address):
    page = page_of(f"{address}?example=truck-supports")
    page.click(mark("tab-diagnosis"))
    sheet = page.locator(mark("sheet-diagnosis"))
    sheet.locator(mark("recording-hint")).wait_for()
    page.click(mark("recording-open"))
    page.click(mark("recording-truck-worn-spline"))
    sheet.locator(mark("answer")).filter(has_text="spline worn").wait_for()
    assert sheet.locator("button[aria-label='save this figure']").count() >= 5
    sheet.locator(mark("save-page")).click()
    page.wait_for_function("() => document.querySelector('#taken').textContent === 'diagnosis'")
    page.click(mark("recording-send"))
    sent = {"name": "photo.wav", "mimeType": "audio/wav", "buffer": b"\x89PNG\r\n\x1a\n"}
    page.locator("input[type=file]").set_input_files(sent)
    sheet.locator(".progress .wrong").filter(has_text="photo.wav").wait_for()
    assert sheet.locator(mark("recording-name")).inner_text() == "photo.wav"
    assert sheet.locator(mark("answer")).inner_text() == ""
    page.click(mark("tab-motion"))
    said(page).wait_for()
    other = page_of(f"{address}?example=truck-supports")
    other.click(mark("tab-diagnosis"))
    other.locator(mark("recording-hint")).wait_for()
    assert other.locator(mark("recording-name")).inner_text() == ""
