"""Whether the drive is due for lubrication."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.catalogue.rows import Lubrication
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import BELOW, Verdict
from cardan.formulas.maintenance import SEVERE
from cardan.texts import _, mark

COUNTERS = {"hours": ("duration", "h"), "distance": ("length", "km"), "years": ("", "")}


def _judge(design: Design) -> Iterator[Verdict]:
    upkeep = design.duty.upkeep
    if upkeep is None:
        return
    words = {
        "hours": _("running time since {item} were lubricated"),
        "distance": _("distance since {item} were lubricated"),
        "years": _("years since {item} were lubricated"),
    }
    for item in upkeep.items or ("needle_bearings",):
        row = design.known.row(Lubrication, item, field="duty.upkeep.items")
        asked = [name for name in COUNTERS if getattr(row, name) is not None]
        given = [name for name in asked if design.value(f"duty.upkeep.{name}") is not None]
        if not given:
            title = words[asked[0]].format(item=_words(item))
            yield Verdict(title=title, missing=tuple(f"duty.upkeep.{name}" for name in asked))
        for name in given:
            dimension, unit = COUNTERS[name]
            yield Verdict(
                source=row.source,
                confidence=row.confidence,
                title=words[name].format(item=_words(item)),
                dimension=dimension,
                unit=unit,
                # Due when the interval is reached, so all but a hair of it passes.
                value=design.value(f"duty.upkeep.{name}"),
                limit=getattr(row, name) * (SEVERE if upkeep.severe else 1.0) * BELOW,
                note=_("lubricate with {what}").format(what=row.lubricant)
                + (_("; severe use halves the interval") if upkeep.severe else ""),
                design_variables=(f"duty.upkeep.{name}",),
            )


def _words(item: str) -> str:
    """Return the row of a table in words."""
    return {"needle_bearings": _("the needle bearings")}.get(item, item.replace("_", " "))


CHECK = Check(name="lubrication", doc=mark("use since the last lubrication against the intervals"), judge=_judge)
