"""Whether every sliding spline stays engaged and does not bottom, as drawn and while the drive moves."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache, partial

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.parts import known_lengths
from cardan.texts import _, mark
from cardan.units import mm

from .check import Check
from .design import Design
from .moving import movement
from .verdict import Verdict

TOUCH = 1e-3 * mm
"""Way that must be left to bottoming [m]."""


def _judge(design: Design) -> Iterator[Verdict]:
    splined = [k for k, shaft in enumerate(design.drive.shafts) if shaft.spline is not None]
    if not splined:
        return
    slides = _slid(design)
    own = design.value("limits.spline_overlap")
    for k in splined:
        path = f"shafts[{k}].spline"
        out, back = slides.get(k, (0.0, 0.0))
        made = partial(Verdict, check="spline_overlap", subject=f"shafts[{k}]", dimension="length", unit="mm")
        made = partial(made, sense="at_least")
        engaged, gap = design.value(f"{path}.engaged"), design.value(f"{path}.gap")
        title = _("engaged length of the spline of shaft {number}").format(number=k + 1)
        if engaged is None or (own is None and k not in slides):
            lacking = design.missing(f"{path}.engaged")
            yield made(title=title, missing=lacking or ("limits.spline_overlap",))
        else:
            yield made(
                title=title,
                value=np.asarray(engaged) - out,
                limit=TOUCH if own is None else own,
                source=_("it must not come apart") if own is None else _("limits of the drive file"),
                levers=(f"{path}.engaged",),
            )
        if gap is not None and k in slides:
            yield made(
                title=_("way left to bottoming of the spline of shaft {number}").format(number=k + 1),
                value=np.asarray(gap) - back,
                limit=TOUCH,
                source=_("it must not bottom"),
                levers=(f"{path}.gap",),
            )


def _slid(design: Design) -> dict[int, tuple[float, float]]:
    """Return how far each shaft grows longer and shorter than drawn, where it slides [m]; a pose may say it anew."""
    found = _slides(design.drive, design.drawn or design.drive)
    if design.drawn is None:
        return found
    shafts = zip(design.drive.shafts, design.drawn.shafts, strict=True)
    anew = {k for k, (one, other) in enumerate(shafts) if one.spline and one.spline != other.spline}
    own = _slides(design.drive, design.drive) if anew else {}
    return {k: own.get(k, (0.0, 0.0)) if k in anew else ways for k, ways in found.items()}


@lru_cache(maxsize=64)
def _slides(drive: Drive, drawn: Drive) -> dict[int, tuple[float, float]]:
    """Return how far each shaft gets longer and shorter than drawn, standing and moving; none where none slides [m]."""
    if not drive.movements and not drive.poses and drive is drawn:
        return {}
    zero, standing, moving = known_lengths(drawn), known_lengths(drive), movement(drive)
    reach = {number: (length, length) for number, length in standing.items()}
    for one in moving.splines if moving is not None else ():
        reach[one.shaft] = (one.length_min, one.length_max)
    return {k - 1: (high - zero[k], zero[k] - low) for k, (low, high) in reach.items() if k in zero}


CHECK = Check(
    name="spline_overlap", doc=mark("engaged length and way left of every spline while the drive moves"), judge=_judge
)
