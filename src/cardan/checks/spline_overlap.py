"""Whether every sliding spline stays engaged and does not bottom, as drawn and while the drive moves."""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache, partial

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.parts import known_lengths
from cardan.drive.paths import pose_drives
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
    slides = _slides(design.drive)
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


@lru_cache(maxsize=64)
def _slides(drive: Drive) -> dict[int, tuple[float, float]]:
    """Return how far each shaft grows longer and shorter than drawn while the drive moves and in its poses [m]."""
    found: dict[int, tuple[float, float]] = {}
    drawn = known_lengths(drive)
    for posed in pose_drives(drive):
        for number, length in known_lengths(posed).items():
            if number in drawn:
                out, back = found.get(number - 1, (0.0, 0.0))
                found[number - 1] = max(out, length - drawn[number]), max(back, drawn[number] - length)
    moving = movement(drive)
    if moving is not None:
        for one in moving.splines:
            out, back = found.get(one.shaft - 1, (0.0, 0.0))
            found[one.shaft - 1] = max(out, one.length_max - one.drawn), max(back, one.drawn - one.length_min)
    return found


CHECK = Check(
    name="spline_overlap", doc=mark("engaged length and way left of every spline while the drive moves"), judge=_judge
)
