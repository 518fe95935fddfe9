"""The drawings of the conventions show what the program means."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

from cardan import Drive
from cardan.maths.kernel.frames import angle_about

DOCS = Path(__file__).parents[2] / "docs"


@pytest.fixture
def conventions(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    pytest.importorskip("matplotlib")
    monkeypatch.syspath_prepend(str(DOCS))
    import pictures.conventions as module  # type: ignore[import-not-found]

    yield module  # type: ignore[misc]
    for name in [name for name in sys.modules if name.split(".")[0] == "pictures"]:
        del sys.modules[name]


@pytest.mark.slow
@pytest.mark.parametrize("angle", [0.0, 1.0, 4.0])
def test_yokes_are_drawn_as_the_file_says(conventions: ModuleType, angle: float) -> None:
    yokes = [0.5, -1.2]
    drive = Drive.from_angles([0.3, 0.5, 0.2], plane_twists=[0.7, -2.0], yoke_angles=yokes, start_phase=0.4)
    place, driving, driven = conventions.pins(drive, angle)
    for k, wanted in enumerate(yokes):
        axis = place.axis[k + 1]
        assert driving[k + 1] @ axis == pytest.approx(0.0, abs=1e-14)
        drawn = angle_about(axis, driving[k + 1], driven[k])
        # Pins are lines: angles count modulo half a turn. Both ways round to a few units in the last place.
        assert np.sin(drawn - wanted) == pytest.approx(0.0, abs=1e-13)


def test_the_cross_holds_both_yokes_at_right_angles(conventions: ModuleType) -> None:
    drive = Drive.from_angles([0.3, 0.5], plane_twists=[0.7], yoke_angles=[0.2])
    _place, driving, driven = conventions.pins(drive, 0.9)
    assert np.sum(driving * driven, axis=-1) == pytest.approx(0.0, abs=1e-15)


def test_clockwise_on_paper_is_positive_about_an_axis_that_leaves_the_reader(conventions: ModuleType) -> None:
    # Seen along x with z up, y lies to the left: straight down turns by +90° to the left-hand side.
    assert conventions.towards(0.0) == pytest.approx([0.0, -1.0])
    assert conventions.towards(90.0) == pytest.approx([-1.0, 0.0], abs=1e-15)
    down, left = np.array([0.0, 0.0, -1.0]), np.array([0.0, 1.0, 0.0])
    assert angle_about(np.array([1.0, 0.0, 0.0]), down, left) == pytest.approx(np.pi / 2)


@pytest.mark.slow
@pytest.mark.parametrize("module", ["conventions", "theory", "movements", "gallery"])
def test_every_picture_is_drawn(module: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(DOCS))
    import pictures  # type: ignore[import-not-found]

    names = __import__(f"pictures.{module}", fromlist=["PICTURES"]).PICTURES
    if not names:
        pytest.skip("no pictures")
    first = next(iter(names))
    (file,) = pictures.build(tmp_path, only=first)
    text = file.read_text("utf-8")
    assert text.startswith("<?xml")
    assert len(text) > 5000
    assert "http://" not in text.replace("http://www.w3.org", "").replace("http://purl.org", "").replace(
        "http://creativecommons.org", ""
    )
    for name in [name for name in sys.modules if name.split(".")[0] == "pictures"]:
        del sys.modules[name]


@pytest.mark.slow
def test_every_picture_of_a_page_is_drawn(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(DOCS))
    import pictures  # type: ignore[import-not-found]

    pages = "\n".join(page.read_text("utf8") for page in DOCS.rglob("*.md") if "_build" not in page.parts)
    used = set(re.findall(r"/_build/pictures/([^)]*?)\.svg", pages))
    known = {name for _module, name in pictures.names()}
    for name in [name for name in sys.modules if name.split(".")[0] == "pictures"]:
        del sys.modules[name]
    assert len(used) > 50
    assert used - known == set()
    assert not any(" " in name for name in used)  # a blank ends an address in Markdown
