"""How far cardan is from the reference cases: a table of all formulas, for the page on validation."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.reference.__main__ import result_of
from tests.reference.judge import MISSING, NOTES, period

FOLDER = Path(__file__).parent
PARTS = ("kinematics", "statics", "dynamics", "strength", "structure")
ROUNDING = 1e-12  # deviations below this share of a number are told as rounding
RULES = ("rule", "input", "by definition", "specification", "catalogue of this file", "fault table")  # no computation


@dataclass
class Residual:
    """What the cases of one formula come to."""

    part: str
    formula: str
    cases: int = 0
    refusals: int = 0
    numbers: int = 0
    largest: float = 0.0  # deviation over the size of the number, or of the largest beside it
    sources: dict[str, None] = field(default_factory=dict)

    @property
    def told(self) -> str:
        """The largest deviation by its class, which is the same on every processor."""
        if not self.numbers:
            return "–"
        return "rounding" if self.largest < ROUNDING else f"< 1e{math.ceil(math.log10(self.largest) + 0.3)}"


def residuals() -> Iterator[Residual]:
    """Yield what the cases of each formula come to, part by part."""
    for part in PARTS:
        found: dict[str, Residual] = {}
        for case in json.loads((FOLDER / f"{part}.json").read_text("utf8"))["cases"]:
            one = found.setdefault(case["capability"], Residual(part, case["capability"]))
            one.cases += 1
            result = result_of(case)
            if "error_field" in case["expected"] or result is None or "computed" not in result:
                one.refusals += 1
                continue
            source = case["source"].partition(";")[0].replace(" (beyond the seeds)", "")
            if not source.startswith(RULES):
                one.sources[source.removeprefix("independent computation: ")] = None
            for off, size in _pairs(result["computed"], case["expected"]):
                one.numbers += 1
                one.largest = max(one.largest, off / size if size > max(case["atol"], 1e-300) else 0.0)
        yield from found.values()


def _pairs(computed: Any, expected: Any, key: str = "", size: float = 0.0) -> Iterator[tuple[float, float]]:
    """Yield the deviation of every number and the size it is measured by."""
    if isinstance(expected, dict):
        for name, one in expected.items():
            if name not in NOTES:
                yield from _pairs(computed.get(name, MISSING) if isinstance(computed, dict) else MISSING, one, name)
    elif isinstance(expected, list):
        if isinstance(computed, list) and len(computed) == len(expected):
            largest = max((abs(one) for one in _flat(expected)), default=0.0)
            for one, other in zip(computed, expected, strict=True):
                yield from _pairs(one, other, key, max(size, largest))
    elif isinstance(expected, int | float) and not isinstance(expected, bool) and isinstance(computed, int | float):
        off = computed - expected
        turn = period(key)
        off = math.remainder(off, turn) if turn < math.inf else off
        yield abs(off), max(size, abs(expected))


def _flat(values: Any) -> Iterator[float]:
    """Yield the numbers of nested lists."""
    for one in values:
        if isinstance(one, list):
            yield from _flat(one)
        elif isinstance(one, int | float) and not isinstance(one, bool):
            yield float(one)


def table() -> str:
    """Return the table in Markdown."""
    rows = list(residuals())
    lines = [
        f"{sum(one.cases for one in rows)} cases of {len(rows)} formulas, {sum(one.numbers for one in rows)} numbers.",
        "",
        "| part | formula | cases | numbers | largest deviation | compared with |",
        "|---|---|---:|---:|---|---|",
    ]
    for one in rows:
        against = "; ".join(one.sources).replace("|", "\\|").replace("irregularity", "speed fluctuation")
        against = against or "rules and refusals"
        lines.append(f"| {one.part} | `{one.formula}` | {one.cases} | {one.numbers} | {one.told} | {against} |")
    return "\n".join(lines) + "\n"
