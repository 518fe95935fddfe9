"""From an edit to the curve: the app in a real browser, a joint centre of a four-joint drive written anew."""

from __future__ import annotations

import statistics
from collections.abc import Iterator

from .browser import opened
from .harness import Figure

EXAMPLE = "truck-printed-coordinates"

EDIT = """async value => {
  const field = document.querySelector('[aria-label="centre mm y"]');
  const curve = () => [...document.querySelectorAll('.cardan-chart path.js-line')].map(p => p.getAttribute('d')).join();
  const before = curve();
  const begin = performance.now();
  const setter = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value').set;
  setter.call(field, value);
  field.dispatchEvent(new Event('input', {bubbles: true}));
  field.dispatchEvent(new Event('change', {bubbles: true}));
  return await new Promise((done, failed) => {
    const look = () => curve() !== before ? done(performance.now() - begin)
      : performance.now() - begin > 20000 ? failed(new Error('no new curve')) : setTimeout(look, 1);
    look();
  });
}"""
"""Writes a coordinate and waits until the curve on the page is another one [ms]."""


def figures(quick: bool) -> Iterator[Figure]:
    """Yield the median from an edit to the new curve."""
    with opened(EXAMPLE) as page:
        page.wait_for_selector(".cardan-chart path.js-line", state="attached", timeout=120_000)
        page.wait_for_timeout(3000)
        times = []
        for k in range(6 if quick else 25):
            times.append(page.evaluate(EDIT, str(10 + k)))
            page.wait_for_timeout(400)
        median = statistics.median(times[1:])
        yield Figure(
            bench="app, edit to curve of four joints, median",
            value=median / 1000.0,
            unit="s",
            yardstick="0.1 s, aim ≤ 1",
            ratio=median / 100.0,
        )
