"""How far the bodies of a scene use their limits, and the colours that say so to every reader."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from cardan.answers.reader import reader
from cardan.checks.verdict import AMBER, Verdict
from cardan.checks.verdict_table import share as used_share
from cardan.drive.bodies.build import Solid
from cardan.figures import palette
from cardan.texts import _

PARTS: dict[str, tuple[str, ...]] = {
    "bearing_life": ("bearing cap",),
    "needle_static": ("bearing cap",),
    "small_oscillation": ("bearing cap",),
    "lubrication": ("bearing cap",),
    "contact_pressure": ("bearing cap", "cross"),
    "journal_strength": ("cross",),
    "yoke_strength": ("driving yoke", "driven yoke"),
    "spline_strength": ("spline sleeve", "spline shaft"),
    "spline_pressure": ("spline sleeve", "spline shaft"),
    "spline_overlap": ("spline sleeve", "spline shaft"),
    "acceleration": (),
    "speed_fluctuation": (),
    "output_error": (),
}
"""Check -> parts of the joint or shaft that it judges; all of a joint, the tube of a shaft where it is not here."""

Use = tuple[float, str]


def used(verdicts: Sequence[Verdict]) -> Callable[[Solid], Use | None]:
    """Return a function from a body to the largest share of a limit it uses, and that in words.

    verdicts: of one drive; rules of thumb and what could not be judged are left out.
    """
    worst: dict[tuple[str, str], Use] = {}
    for one in verdicts:
        if one.advice or not one.run or not one.subject:
            continue
        share = float(np.max(one.utilisation))
        if math.isnan(share):
            continue
        parts = PARTS.get(one.check)
        if parts is None:
            parts = ("tube",) if one.subject.startswith("shafts") else ("",)
        for part in parts:
            key = one.subject.partition(".")[0], part
            if key not in worst or share > worst[key][0]:
                text = _("{share} of the limit of {check}")
                worst[key] = share, text.format(share=used_share(share).told(reader()), check=one.title)

    def of(solid: Solid) -> Use | None:
        path = solid.path.partition(".")[0]
        found = [worst[key] for key in ((path, solid.part), (path, "")) if key in worst]
        return max(found) if found else None

    return of


def scale() -> tuple[tuple[float, str, str], ...]:
    """Return the colours of utilisation: value, colour and what it means; darker the nearer to the limit."""
    return (
        (0.0, use_colour(0.0), _("unused")),
        (0.5, use_colour(0.5), _("half of the limit")),
        (AMBER, use_colour(AMBER), _("close to the limit")),
        (1.0, use_colour(1.0001), _("over the limit")),
    )


def use_colour(share: float | None) -> str:
    """Return the colour of a share of a limit: pale to blue, amber close to the limit, red beyond it."""
    if share is None:
        return palette.ROLES["grid"]
    if share > 1.0:
        return palette.ROLES["failed"]
    if share >= AMBER:
        return palette.ROLES["warning"]
    pale, blue = palette.mixed(palette.SHAFTS[5], "#ffffff", 0.72), palette.SHAFTS[1]
    return palette.mixed(pale, blue, share / AMBER)
