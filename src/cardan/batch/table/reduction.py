"""What is to be told of a column of a sweep, as a plan says it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from cardan.batch.search.goals import Limit

BINS = 50  # bins of a histogram when none are asked for


@dataclass(frozen=True, kw_only=True)
class Reduce:
    """What is to be told of a column, as a plan says it."""

    kind: str  # one of `KINDS`
    of: str = ""  # column; for ``count`` and ``share`` empty
    by: tuple[str, ...] = ()  # axes, by their names or by a field of theirs: one answer for each of their places
    where: tuple[Limit, ...] = ()  # rows that count; those without an answer never do
    percent: float = 50.0
    bins: int = BINS
    # low, high: of a histogram; without them it has bins of a power of two that cover all numbers
    low: float | None = None
    high: float | None = None
    name: str = ""  # among the results; made of the rest when empty

    @property
    def label(self) -> str:
        """Name among the results."""
        if self.name:
            return self.name
        words = [f"p{self.percent:g}" if self.kind == "percentile" else self.kind]
        limits = " and ".join(str(one) for one in self.where)
        words += [self.of, f"where {limits}" if limits else ""] if self.of else [limits]
        return " ".join(word for word in words if word) + (" by " + ", ".join(self.by) if self.by else "")

    def told(self) -> dict[str, Any]:
        """Return it as the table of a plan file."""
        found: dict[str, Any] = {"kind": self.kind}
        found |= {"of": self.of} if self.of else {}
        found |= {"by": list(self.by)} if self.by else {}
        found |= {"where": [str(one) for one in self.where]} if self.where else {}
        if self.kind == "percentile":
            found["percent"] = self.percent
        if self.kind == "histogram":
            found |= {"bins": self.bins} | {
                k: getattr(self, k) for k in ("low", "high") if getattr(self, k) is not None
            }
        return found | ({"name": self.name} if self.name else {})
