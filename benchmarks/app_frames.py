"""The app: frames a second of the drive turning, in a browser that draws without a graphics card."""

from __future__ import annotations

import shutil
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from cardan.io import example_text

from .harness import Figure

AIM = 50.0
"""Frames a second."""

EXAMPLE = "truck-printed-angles"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WINDOW = {"width": 1280, "height": 720}


@contextmanager
def app(folder: Path) -> Iterator[str]:
    """Run the app on a drive; give its address."""
    file = folder / f"{EXAMPLE}.toml"
    file.write_text(example_text(EXAMPLE), encoding="utf-8")
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    command = [sys.executable, "-m", "cardan", "app", str(file), "--port", str(port), "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as server:
        try:
            address = f"http://127.0.0.1:{port}/"
            while not answers(address):
                if server.poll() is not None:
                    raise RuntimeError("the app did not start")
                time.sleep(0.2)
            yield address
        finally:
            server.terminate()


def answers(address: str) -> bool:
    try:
        with urllib.request.urlopen(address, timeout=10):
            return True
    except (urllib.error.URLError, TimeoutError):
        return False


def watched(page: Any, spans: int) -> tuple[list[float], dict[str, Any]]:
    """Return the frames a second in spans of two seconds, and how the view drew them."""
    page.wait_for_function("window.cardanView && cardanView.playing && cardanView.bodies.thinned !== undefined")
    page.wait_for_timeout(4000)  # thinner forms of the bodies are ready, the curves have been drawn
    rates = []
    for _span in range(spans):
        page.wait_for_timeout(2000)
        rates.append(float(page.evaluate("cardanView.fps")))
    return rates, dict(page.evaluate("cardanView.state"))


def figures(quick: bool) -> Iterator[Figure]:
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        raise RuntimeError(f"no browser on the PATH: none of {', '.join(BROWSERS)}")
    with tempfile.TemporaryDirectory() as folder, app(Path(folder)) as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=list(ARGUMENTS))
        page = browser.new_page(viewport=WINDOW)
        page.goto(address)
        rates, drawn = watched(page, 1 if quick else 8)
        size = page.evaluate("[cardanView.width, cardanView.height].join(' x ')")
        browser.close()
    how = f"{size} pixels, {drawn['triangles']} triangles in {drawn['calls']} calls, quality {drawn['level']}"
    for name, rate in (("middle", statistics.median(rates)), ("slowest two seconds", min(rates))):
        yield Figure(
            bench=f"frames of {EXAMPLE} in the app, {name}: {how}",
            value=rate,
            unit="1/s",
            yardstick="50 1/s without a graphics card, aim ≥ 1",
            ratio=rate / AIM,
        )
