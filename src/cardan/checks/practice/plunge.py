"""Whether joints that plunge go no farther in and out than they may while the drive moves."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.questions.motion.length import plunging
from cardan.texts import _, mark

from .spline_overlap import ROUNDING, slid

KEYS = ("plunge_out", "plunge_in")
"""How far a joint may be pulled out, and pushed in."""


def _judge(design: Design) -> Iterator[Verdict]:
    drive = design.drive
    taken = {k: plunging(design.drive, k) for k in range(1, design.joints)}
    ways = slid(design, [k for k, joints in taken.items() if joints])
    for k, (out, back, stood) in ways.items():
        joints = taken[k]
        moves = max(float(np.max(out)), float(np.max(back))) > ROUNDING
        for key, way, rest in zip(KEYS, (out, back), (stood, -stood), strict=True):
            paths = [f"joints[{i}].{key}" for i in joints]
            limits = [design.value(path) for path in paths]
            if any(one is None for one in limits):
                if moves:
                    yield Verdict(subject=f"joints[{joints[0]}]", missing=design.missing(*paths))
                continue
            title = {
                "plunge_out": _("plunge of joint {number}, pulled out"),
                "plunge_in": _("plunge of joint {number}, pushed in"),
            }[key]
            both = _("its shaft plunges at both ends: the way and the limits of both together")
            moved = _("while the drive moves") if np.all(way > rest + ROUNDING) and drive.movements else ""
            yield Verdict(
                subject=f"joints[{joints[0]}]",
                title=title,
                value=np.maximum(way, 0.0),
                limit=sum(np.asarray(one) for one in limits),
                source=_("limit of the joint"),
                design_variables=tuple(paths),
                note=both if len(joints) > 1 else moved,
            )


CHECK = Check(
    name="plunge",
    doc=mark("how far joints that plunge, tripods and ball joints, go in and out while the drive moves"),
    judge=_judge,
    title=mark("plunge of joint {number}"),
    dimension="length",
    unit="mm",
)
