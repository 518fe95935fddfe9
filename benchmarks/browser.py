"""The app in a browser that draws without a graphics card, for the benchmarks of it."""

from __future__ import annotations

import re
import shutil
import socket
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

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WINDOW = {"width": 1280, "height": 720}

START = 60.0
"""Seconds the app may take until it answers."""


@contextmanager
def opened(example: str, **context: Any) -> Iterator[Any]:
    """Run the app on an example and give its page.

    Parameters
    ----------
    example : str
        Name of a shipped drive.
    **context
        How the browser is set, as playwright names it.
    """
    from playwright.sync_api import sync_playwright

    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        raise RuntimeError(f"no browser on the PATH: none of {', '.join(BROWSERS)}")
    with tempfile.TemporaryDirectory() as folder, running(example, Path(folder)) as address, sync_playwright() as entry:
        browser = entry.chromium.launch(executable_path=path, args=list(ARGUMENTS))
        page = browser.new_context(viewport=WINDOW, **context).new_page()
        page.goto(address)
        yield page
        browser.close()


@contextmanager
def running(example: str, folder: Path) -> Iterator[str]:
    """Run the app on an example and give its address."""
    file = folder / f"{example}.toml"
    file.write_text(example_text(example), encoding="utf-8")
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    command = [sys.executable, "-m", "cardan", "app", str(file), "--port", str(port), "--no-browser"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as server:
        try:
            assert server.stdout is not None
            told = re.search(r"http://\S+", server.stdout.readline())  # with the token that it asks for
            if told is None:
                raise RuntimeError("the app did not start")
            address, end = told[0], time.monotonic() + START
            while not answers(address):
                if server.poll() is not None or time.monotonic() > end:
                    raise RuntimeError("the app did not start")
                time.sleep(0.2)
            yield address
        finally:
            server.terminate()


def answers(address: str) -> bool:
    """Tell whether the app answers at an address."""
    try:
        with urllib.request.urlopen(address, timeout=10):
            return True
    except urllib.error.HTTPError:  # it leads on to where its cookie is asked for
        return True
    except OSError:  # errors of addresses and time-outs among them
        return False
