"""A reader who comes with the words of the trade finds them in the pages."""

from __future__ import annotations

from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
GENERATED = {"_build", "generated", "paper"}
PAGES = "\n".join(
    page.read_text("utf8") for page in sorted(DOCS.rglob("*.md")) if not GENERATED & set(page.parts)
).casefold()
TERMS = (
    *("operating angle", "deflection angle", "U-joint", "CV joint", "non-uniformity", "homokinetic", "phase angle"),
    *("statically indeterminate", "overconstrained", "redundant constraint", "pilot lever", "giubo", "flex disc"),
    *("double Cardan", "centre bearing", "slip spline", "remaining travel", "secondary couple", "inertia excitation"),
    *("torsional acceleration", "natural frequency", "alternating torque", "Campbell", "modal inertia", "bounce mode"),
    *("parametric instability", "half-critical", "service factor", "equivalent torque", "oscillation angle"),
    *("false brinelling", "trunnion", "needle bearing", "ball track", "backlash", "misalignment", "utilisation"),
    *("limitations", "phasing", "spider", "length compensation", "intermediate shaft", "remedy", "governing"),
)


@pytest.mark.parametrize("term", TERMS)
def test_the_pages_have_the_term(term: str) -> None:
    assert term.casefold() in PAGES


def test_no_term_of_the_glossary_stands_for_two_things() -> None:
    rows = [line.split("|") for line in (DOCS / "glossary.md").read_text("utf8").splitlines() if line.startswith("| ")]
    names = [name.strip() for row in rows if row[1].strip() != "term" for name in row[1].replace(";", ",").split(",")]
    assert len(names) > 60
    assert [name for name in names if names.count(name) > 1] == []
