"""Whether every sliding spline stays engaged and does not bottom, as drawn and while the drive moves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.movement_loads import extreme_lengths, lengths_at
from cardan.checks.verdict import Verdict
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.motion.length import slip_ends
from cardan.texts import _, mark
from cardan.units import mm

TOUCH = 1e-3 * mm
"""Way that must be left to bottoming [m]."""

ROUNDING = 1e-12
"""Way [m] that rounding alone makes."""


def _judge(design: Design) -> Iterator[Verdict]:
    splined = [k for k, shaft in enumerate(design.drive.shafts) if shaft.spline is not None]
    if not splined:
        return
    slides = slid(design, splined)
    own = design.value("limits.spline_overlap")
    for k in splined:
        path = f"shafts[{k}].spline"
        out, back, stood = slides.get(k, (0.0, 0.0, 0.0))
        moved = _("while the drive moves")
        engaged, gap = design.value(f"{path}.engaged"), design.value(f"{path}.gap")
        if engaged is None or (own is None and k not in slides):
            lacking = design.missing(f"{path}.engaged")
            yield Verdict(subject=f"shafts[{k}]", missing=lacking or ("limits.spline_overlap",))
        else:
            yield Verdict(
                subject=f"shafts[{k}]",
                value=np.asarray(engaged) - out,
                limit=TOUCH if own is None else own,
                source=_("it must not come apart") if own is None else _("limits of the drive file"),
                design_variables=(f"{path}.engaged",),
                note=moved if np.all(out > stood + ROUNDING) else "",
            )
        if gap is not None and k in slides:
            yield Verdict(
                subject=f"shafts[{k}]",
                title=_("remaining travel of the spline of shaft {number}"),
                value=np.asarray(gap) - back,
                limit=TOUCH,
                source=_("it must not bottom"),
                design_variables=(f"{path}.gap",),
                note=moved if np.all(back > ROUNDING - stood) else "",
            )


def slid(design: Design, shafts: Sequence[int]) -> dict[int, tuple[Array, Array, Array]]:
    """Return how far each of some shafts gets longer and shorter than drawn [m], and how much longer it is standing.

    shafts: counted from 0. None where none slides.

    Engaged length and gap hold in the drive as drawn; a pose that says them anew means its own place.
    """
    moves, drawn = design.drive.movements, design.drawn
    if not moves and not design.drive.poses and drawn is None:
        return {}
    ends, rest = slip_ends(design.drive), frames.norm(np.diff((drawn or design).points, axis=-2))
    reach = extreme_lengths(design.points, moves, rest, ends) if moves else None
    ways = {}
    for k in shafts:
        shaft = design.drive.shafts[k]
        origin = design if drawn is None or shaft.spline != drawn.drive.shafts[k].spline else drawn
        beside = min(max(k, 1), design.joints - 1)
        standing, zero = design.length(beside), origin.length(beside)
        if standing is None or zero is None:
            continue
        if k in ends:
            standing, zero = (lengths_at(one.points, rest, ends)[..., k] for one in (design, origin))
        low = high = np.asarray(standing, dtype=float)
        if reach is not None:
            low, high = (np.where(np.isfinite(one[..., k]), one[..., k], standing) for one in reach)
        ways[k] = high - zero, zero - low, np.asarray(standing - zero)
    return ways


CHECK = Check(
    name="spline_overlap",
    doc=mark("engaged length and remaining travel of every spline while the drive moves"),
    judge=_judge,
    title=mark("engaged length of the spline of shaft {number}"),
    dimension="length",
    unit="mm",
    sense="at_least",
)
