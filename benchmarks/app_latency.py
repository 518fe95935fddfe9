"""From an edit to the curve: the app in a real browser, a joint centre of a four-joint drive written anew."""

from __future__ import annotations

import statistics
from collections.abc import Iterator

from .browser import opened
from .harness import Figure

EXAMPLE = "truck-printed-coordinates"

EDIT = """async value => {
  const field = document.querySelector('[aria-label="centre mm y"]');
  const watched = {
    curve: [document.querySelector('.pane.answers'), {subtree: true, attributes: true, attributeFilter: ['d']}],
    verdicts: [document.querySelector('[data-mark="verdicts"]'), {childList: true}],
  };
  const begin = performance.now(), took = {};
  const seen = Object.entries(watched).map(([name, [part, what]]) => new Promise((done, failed) => {
    setTimeout(() => failed(new Error('the page stays as it was')), 20000);
    new MutationObserver((_changes, observer) => {
      took[name] = performance.now() - begin;
      observer.disconnect();
      done();
    }).observe(part, what);
  }));
  const setter = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set;
  setter.call(field, value);
  field.dispatchEvent(new Event('input', {bubbles: true}));
  field.dispatchEvent(new Event('change', {bubbles: true}));
  await Promise.all(seen);
  return took;
}"""
"""Writes a coordinate; tells when curves and verdicts of the page are others [ms], without a look in between."""

REST = 1500
"""Milliseconds from edit to edit: the view in space has followed, and the drive turns."""


def figures(quick: bool) -> Iterator[Figure]:
    """Yield the medians from an edit to the new curve and to the new verdicts, while the drive turns."""
    with opened(EXAMPLE) as page:
        page.wait_for_selector(".cardan-chart path.js-line", state="attached", timeout=120_000)
        page.wait_for_timeout(3000)
        times = []
        for k in range(6 if quick else 25):
            times.append(page.evaluate(EDIT, str(10 + k)))
            page.wait_for_timeout(REST)
    for name, told in (("curve", "edit to curve"), ("verdicts", "edit to verdicts")):
        median = statistics.median(one[name] for one in times[1:])
        yield Figure(
            bench=f"app, {told} of four joints, median",
            value=median / 1000.0,
            unit="s",
            yardstick="0.1 s, aim ≤ 1",
            ratio=median / 100.0,
        )
