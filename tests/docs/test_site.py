"""The pages build without a warning, lead nowhere wrong, and load nothing from a network."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable
from contextlib import AbstractContextManager
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag

import pytest

from tests.test_public_names import public_names

ROOT = Path(__file__).parents[2]
LOADS = {
    "script": "src",
    "img": "src",
    "link": "href",
    "iframe": "src",
    "source": "src",
    "object": "data",
    "use": "href",
}
FAR = re.compile(r"^(https?:)?//", re.I)


class Page(HTMLParser):
    """What a page loads, where it leads, and the places others may lead to."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.loads: list[str] = []
        self.links: list[str] = []
        self.places: set[str] = set()
        self.bare_images: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        if "id" in given:
            self.places.add(given["id"])
        if tag in LOADS and LOADS[tag] in given:
            self.loads.append(given[LOADS[tag]])
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        if tag == "img" and not given.get("alt") and "logo" not in given.get("class", ""):
            self.bare_images.append(given.get("src", ""))


def built() -> bool:
    """Tell whether ``make docs`` has built the pages without a warning, and nothing was changed since."""
    stamp = ROOT / "docs" / "_build" / ".whole"
    made = {"_build", "generated", "__pycache__"}
    sources = (file for folder in ("docs", "src", "examples") for file in (ROOT / folder).rglob("*"))
    changed = max(file.stat().st_mtime for file in sources if file.is_file() and not made & set(file.parts))
    return stamp.exists() and stamp.stat().st_mtime > changed


@pytest.fixture(scope="session")
def site(
    tmp_path_factory: pytest.TempPathFactory, one_at_a_time: Callable[[str], AbstractContextManager[Path]]
) -> Path:
    """Return the pages: those of ``make docs``, or one build for all workers."""
    if built():
        return ROOT / "docs" / "_build" / "html"
    pytest.importorskip("sphinx")
    pytest.importorskip("furo")
    with one_at_a_time("site") as out:
        if not (out / "done").exists():
            where = ["-b", "html", "-d", str(out / "tree"), str(ROOT / "docs"), str(out / "html")]
            made = subprocess.run(
                [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-j", "auto", *where],
                capture_output=True,
                text=True,
                timeout=900,
                check=False,
            )
            assert made.returncode == 0, made.stderr
            (out / "done").touch()
    return out / "html"


@pytest.fixture(scope="session")
def read(site: Path) -> dict[Path, Page]:
    return {file: Page(file.read_text("utf-8")) for file in site.rglob("*.html")}


def test_nothing_is_loaded_from_a_network(site: Path, read: dict[Path, Page]) -> None:
    assert [(file.name, what) for file, page in read.items() for what in page.loads if FAR.match(what)] == []
    styles = [
        file
        for file in site.rglob("*.css")
        if re.search(r"(@import|url\()\s*[\"']?\s*(https?:)?//", file.read_text("utf-8"))
    ]
    assert styles == []


def test_what_pages_load_is_there(read: dict[Path, Page]) -> None:
    lost = [
        (file.name, what)
        for file, page in read.items()
        for what in page.loads
        if not what.startswith(("data:", "#"))
        and not (file.parent / unquote(what.split("?")[0].split("#")[0])).exists()
    ]
    assert [one for one in lost if one[1] != "#"] == []


def test_links_within_the_pages_lead_somewhere(read: dict[Path, Page]) -> None:
    lost = []
    for file, page in read.items():
        for link in page.links:
            if FAR.match(link) or link.startswith(("mailto:", "javascript:")):
                continue
            path, place = urldefrag(link)
            goal = (file.parent / unquote(path)).resolve() if path else file
            there = goal.exists() and (goal not in read or not place or unquote(place) in read[goal].places)
            if not there:
                lost.append((file.name, link))
    assert lost == []


def test_pictures_are_described_in_words(read: dict[Path, Page]) -> None:
    assert [image for page in read.values() for image in page.bare_images] == []


def test_formulas_are_set(site: Path) -> None:
    text = (site / "theory" / "core-idea.html").read_text("utf-8")
    assert text.count('<svg class="formula"') > 30
    assert "\\frac" not in re.sub(r'aria-label="[^"]*"', "", text)


def test_every_public_name_has_a_page(read: dict[Path, Page], site: Path) -> None:
    folder = site / "reference" / "generated" / "names"
    told = {place for file, page in read.items() if file.parent == folder for place in page.places}
    assert [name for name in public_names() if name not in told] == []
    assert len(list(folder.glob("*.html"))) == len(public_names())
