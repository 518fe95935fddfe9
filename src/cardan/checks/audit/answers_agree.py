"""Whether answers about the drive that speak of the same quantity agree."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from cardan.answers.quantity import Quantity, Text, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark, plural

from .asked import Asked
from .pairs import PAIRS, Pair


@dataclass(frozen=True, kw_only=True)
class Compared:
    """Two answers about one part of a drive, side by side."""

    pair: Pair
    part: str  # path of the part; empty for the drive as a whole
    values: tuple[float, float]  # what both tell, in SI

    @property
    def deviation(self) -> float:
        """By how much they differ, over what they may; at most 1 where they agree."""
        first, second = self.values
        if first == second or (self.pair.sense == "at_most" and first < second):
            return 0.0
        allowed = self.pair.tolerance * max(abs(first), abs(second), self.pair.least)
        return abs(first - second) / allowed if math.isfinite(allowed) else math.inf


def audit(design: Design, *, quick: bool = False) -> tuple[Compared, ...]:
    """Return every two answers about one drive that speak of the same quantity of the same part.

    design: of one drive; quick: only what an ordinary check compares.
    Where one of them answers nothing, there is nothing to compare.
    """
    asked, found = Asked(design=design), []
    for pair in PAIRS:
        if quick and not pair.quick:
            continue
        first = pair.read[0](asked)
        second = pair.read[1](asked) if first else {}
        for part in first:
            values = float(first[part]), float(second.get(part, math.nan))
            if not any(map(math.isnan, values)):
                found.append(Compared(pair=pair, part=part, values=values))
    return tuple(found)


def verdict_on(found: tuple[Compared, ...]) -> Iterator[Verdict]:
    """Yield the verdict on answers side by side; none where there are none."""
    if not found:
        return
    worst = max(found, key=lambda one: one.deviation)
    text: Text = plural("{count} comparison", "{count} comparisons", len(found)).format(count=len(found))
    if worst.deviation > 1.0:
        first, second = (Quantity(one, worst.pair.dimension) for one in worst.values)
        said = _("{quantity}: {first} in {one}, {second} in {other}; please report this, with the drive file")
        text = say(
            said,
            quantity=_(worst.pair.quantity),
            first=first,
            one=worst.pair.first,
            second=second,
            other=worst.pair.second,
        )
    yield Verdict(
        value=worst.deviation,
        limit=1.0,
        source=_("answers that speak of the same quantity, side by side"),
        note=text,
    )


def _judge(design: Design) -> Iterator[Verdict]:
    if design.varied or design.drawn is not None:
        return
    yield from verdict_on(audit(design, quick=True))


CHECK = Check(
    name="answers_agree",
    doc=mark("answers about the drive that speak of the same quantity: whether they agree"),
    judge=_judge,
    title=mark("answers that speak of the same quantity agree"),
    gathers="sum",
)
