"""A browser and a server for tests of the app; without a browser these tests are skipped and say so.

``page_of(url)`` opens a page; what it writes to its console as an error, throws or fails to load fails the test.
``serve(command ...)`` starts a server of its own process, ``{port}`` in the command is its free port.
"""

from __future__ import annotations

import os
import re
import shutil
import socket
import subprocess
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import pytest

from cardan.app.server import COOKIE

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
ARGUMENTS = ("--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
PATIENCE = 300_000
"""Milliseconds a page may take to show what is waited for; how fast it is, benchmarks tell."""

START = 300.0
"""Seconds a server may take until it answers."""


def launched(playwright: Any, *more: str) -> Any:
    """Return a running browser, or skip the test with the reason why there is none."""
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        pytest.skip(f"no browser on the PATH: none of {', '.join(BROWSERS)}")
    return playwright.chromium.launch(executable_path=path, args=[*ARGUMENTS, *more])


@pytest.fixture(scope="module")
def playwright() -> Iterator[Any]:
    """Return playwright's entry, one a test file: while it is open, nothing else may run an event loop."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with sync_api.sync_playwright() as entry:
        yield entry


@pytest.fixture(scope="module")
def chromium(playwright: Any) -> Iterator[Any]:
    """Return a browser with a software renderer, one a test file."""
    browser = launched(playwright)
    yield browser
    browser.close()


class Complaints:
    """What a page had to complain about."""

    def __init__(self, page: Any, allowed: tuple[str, ...]) -> None:
        self.found: list[str] = []
        self.allowed = allowed
        page.on("console", lambda message: self.add(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: self.add(f"{error.name}: {error.message}\n{error.stack}"))
        page.on(
            "response",
            lambda answer: self.add(f"{answer.status} from {answer.url}") if answer.status >= 400 else None,
        )

    def add(self, text: str) -> None:
        if not any(part in text for part in self.allowed):
            self.found.append(text)


Opener = Callable[..., Any]

TOKENS: dict[str, str] = {}
"""Address of a server -> the token that it printed; pages opened there have it."""


def admitted(context: Any, url: str) -> None:
    """Give a browser the cookie that a first visit by the printed address gives it."""
    base = next((base for base in TOKENS if url.startswith(base)), "")
    if base:
        name = f"{COOKIE}_{base.rpartition(':')[2]}"
        context.add_cookies(
            [{"name": name, "value": TOKENS[base], "url": base, "httpOnly": True, "sameSite": "Strict"}]
        )


@contextmanager
def pages(chromium: Any) -> Iterator[tuple[Opener, list[Complaints]]]:
    """Give a function that opens pages, and what they complain of; close them in the end."""
    contexts: list[Any] = []
    complaints: list[Complaints] = []

    def open_page(
        url: str,
        *,
        allow: tuple[str, ...] = (),
        script: str = "",
        browser: Any = None,
        cookies: Mapping[str, str] | None = None,
        **options: Any,
    ) -> Any:
        context = (browser or chromium).new_context(**{"viewport": {"width": 1280, "height": 720}, **options})
        context.set_default_timeout(PATIENCE)
        contexts.append(context)
        admitted(context, url)
        context.add_cookies([{"name": name, "value": value, "url": url} for name, value in (cookies or {}).items()])
        page = context.new_page()
        if script:
            page.add_init_script(script)
        complaints.append(Complaints(page, allow))
        page.goto(url)
        return page

    yield open_page, complaints
    for context in contexts:
        context.close()


def refuse_complaints(complaints: list[Complaints]) -> None:
    """Fail where a page had anything to complain of, and forget it."""
    found = [text for one in complaints for text in one.found]
    for one in complaints:
        one.found.clear()
    assert not found, "the page complained:\n" + "\n".join(found)


@pytest.fixture
def page_of(chromium: Any) -> Iterator[Opener]:
    """Return a function that opens a page.

    ``page_of(url, allow=("part of a message",), script="run before the page", cookies={name: value}, **context)``
    """
    with pages(chromium) as (open_page, complaints):
        yield open_page
    refuse_complaints(complaints)


@pytest.fixture(scope="module")
def pages_of_file(chromium: Any) -> Iterator[tuple[Opener, list[Complaints]]]:
    """Return the same for pages that all tests of a file share; they ask ``refuse_complaints`` themselves."""
    with pages(chromium) as opened:
        yield opened


def free_port() -> int:
    """Return a port of this machine that nobody listens to."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return int(one.getsockname()[1])


def answers(url: str) -> bool:
    """Return whether a server answers at all, an error of its own included."""
    try:
        with urllib.request.urlopen(url, timeout=5):
            return True
    except urllib.error.HTTPError as error:
        error.close()
        return True
    except OSError:
        return False


class Server:
    """A server in a process of its own, and what it wrote."""

    def __init__(self, command: tuple[str, ...], log: Any, environment: dict[str, str]) -> None:
        port = free_port()
        self.url = f"http://127.0.0.1:{port}"
        self.log = log
        with log.open("wb") as out:
            self.process = subprocess.Popen(
                [part.replace("{port}", str(port)) for part in command],
                stdout=out,
                stderr=subprocess.STDOUT,
                stdin=subprocess.DEVNULL,
                env={**{k: v for k, v in os.environ.items() if not k.startswith("PYTEST")}, **environment},
            )
        end = time.monotonic() + START
        while not answers(self.url):
            if self.process.poll() is not None or time.monotonic() > end:
                self.stop()
                raise RuntimeError(f"the server did not start:\n{self.written()}")
            time.sleep(0.1)
        self.token = "".join(re.findall(r"\?token=(\S+)", self.written())[:1])
        if self.token:
            TOKENS[self.url] = self.token

    def written(self) -> str:
        return str(self.log.read_text(errors="replace"))

    def stop(self) -> None:
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


@pytest.fixture(scope="session")
def serve(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Server]]:
    """Return a function that starts a server once for each command: ``serve(sys.executable, "x.py", "{port}").url``."""
    running: dict[Any, Server] = {}
    folder = tmp_path_factory.mktemp("servers")

    def start(*command: str, **environment: str) -> Server:
        key = (command, *sorted(environment.items()))
        if key not in running:
            running[key] = Server(command, folder / f"{len(running)}.log", environment)
        return running[key]

    yield start
    for server in running.values():
        server.stop()
