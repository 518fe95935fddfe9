"""Every kind of joint has a page of its own, and a row in the table that compares the kinds."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

from cardan.drive.joints import JOINTS

DOCS = Path(__file__).parents[2] / "docs"
PARTS = ("keys", "loads", "limits")


@pytest.fixture(scope="module")
def joint_pages() -> ModuleType:
    sys.path.insert(0, str(DOCS / "extensions"))
    try:
        import joint_pages as module  # type: ignore[import-not-found]
    finally:
        sys.path.remove(str(DOCS / "extensions"))
    return module


@pytest.fixture(scope="module")
def made(joint_pages: ModuleType) -> dict[str, str]:
    found: dict[str, str] = joint_pages.pages()
    return found


@pytest.mark.parametrize("kind", JOINTS)
def test_a_page_has_picture_law_loads_and_limits(kind: str, joint_pages: ModuleType, made: dict[str, str]) -> None:
    name = joint_pages.hyphened(kind)
    text = (DOCS / "joints" / f"{name}.md").read_text("utf8")
    assert re.findall("^## (.*)$", text, re.M) == ["Law", "Loads", "Limits"]
    assert re.search(r"^!\[.+\]\(/_build/pictures/.+\.svg\)$", text, re.M)
    assert len(text.split("## Law")[1].split("## Loads")[0].split()) > 10
    shown = re.findall(r"^```\{include\} \.\./reference/generated/(.*)$", text, re.M)
    assert shown == [f"joint-{name}-{part}.md" for part in PARTS]
    assert all(made[one].strip() for one in shown)


def test_the_index_compares_every_kind_and_leads_to_its_page(joint_pages: ModuleType, made: dict[str, str]) -> None:
    rows, index = made["joint-kinds.md"].splitlines()[2:], (DOCS / "joint-types.md").read_text("utf8")
    names = [joint_pages.hyphened(kind) for kind in JOINTS]
    assert [re.search(r"\(joints/(.*?)\.md\)", row)[1] for row in rows] == names  # type: ignore[index]
    assert re.findall("^joints/(.*)$", index, re.M) == names
    assert sorted(page.stem for page in (DOCS / "joints").glob("*.md")) == sorted(names)


def test_limits_are_those_of_the_types_in_the_catalogue(made: dict[str, str]) -> None:
    assert "Above 26° none" in made["joint-tripod-limits.md"]
    assert "| Tripod, plunging | approx | 26° |" in made["joint-tripod-limits.md"]
    assert "`ball_diameter`" in made["joint-rzeppa-loads.md"]
