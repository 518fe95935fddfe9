"""From an edit to the curve: the app in a real browser, a joint centre of a four-joint drive written anew."""

from __future__ import annotations

import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from cardan.io import example_text

from .harness import Figure

BROWSERS = ("chromium", "chromium-browser", "google-chrome")

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
    with opened() as page:
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


@contextmanager
def opened(example: str = "truck-printed-coordinates", **context: Any) -> Iterator[Any]:
    """Open the app with an example in a browser that draws by software."""
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        raise RuntimeError(f"no browser on the PATH: none of {', '.join(BROWSERS)}")
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "drive.toml"
        file.write_text(example_text(example), "utf-8")
        command = [sys.executable, "-m", "cardan", "app", str(file), "--port", str(port), "--no-browser"]
        server = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            _await(f"http://127.0.0.1:{port}/")
            with sync_playwright() as entry:
                arguments = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
                browser = entry.chromium.launch(executable_path=path, args=arguments)
                page = browser.new_context(viewport={"width": 1280, "height": 720}, **context).new_page()
                page.goto(f"http://127.0.0.1:{port}/")
                yield page
                browser.close()
        finally:
            server.terminate()
            server.wait()


def _await(url: str) -> None:
    end = time.monotonic() + 60
    while True:
        try:
            with urllib.request.urlopen(url, timeout=5):
                return
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.1)
