"""Letters of the pages stand out from their ground by 4.5 to 1 and more, in light and in dark (WCAG 2.1, 1.4.3)."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

pytest.importorskip("furo")
styles = pytest.importorskip("pygments.styles")

CONF = (Path(__file__).parents[2] / "docs" / "conf.py").read_text("utf8")
LEAST = 4.5
PAPER = {"light": "#ffffff", "dark": "#131416"}  # grounds of the theme


def brightness(colour: str) -> float:
    """Return the relative luminance of a colour, as WCAG has it."""
    parts = [int(colour.lstrip("#")[k : k + 2], 16) / 255.0 for k in (0, 2, 4)]
    red, green, blue = (c / 12.92 if c <= 0.03928 else ((c + 0.055) / 1.055) ** 2.4 for c in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours."""
    low, high = sorted((brightness(one), brightness(other)))
    return (high + 0.05) / (low + 0.05)


def test_contrast_is_that_of_known_pairs() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21.0)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("option", ["pygments_style", "pygments_dark_style"])
def test_code_stands_out(option: str) -> None:
    (name,) = re.findall(rf'^{option} = "([\w-]+)"$', CONF, re.MULTILINE)
    style = styles.get_style_by_name(name)
    faint = {
        str(token): look["color"]
        for token, look in style
        if look["color"] and contrast(look["color"], look["bgcolor"] or style.background_color) < LEAST
    }
    assert faint == {}


@pytest.mark.parametrize("mode", ["light", "dark"])
def test_links_stand_out(mode: str) -> None:
    found = re.findall(rf'"{mode}_css_variables": \{{(.*?)\}}', CONF)
    colours = re.findall(r"#[0-9a-f]{6}", found[0])
    assert len(colours) == 2
    assert all(contrast(colour, PAPER[mode]) >= LEAST for colour in colours)
