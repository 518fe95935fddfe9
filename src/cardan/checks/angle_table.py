"""The articles' table of joint angles: which second angle a first one and a speed allow."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.analysis.angle_limits import TABLE_TORSIONAL, angle_limits
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .check import Check
from .design import Design
from .verdict import Verdict

SET = 1e-3
"""Yokes this far [rad] from their place count as set right."""


def _judge(design: Design) -> Iterator[Verdict]:
    if design.joints != 2 or not _phased(design):
        return
    made = partial(
        Verdict,
        check="angle_table",
        title=_("larger bend beside the smaller, table of angles"),
        dimension="angle",
        unit="deg",
        source=_("web articles on drive shafts, table of joint angles: √(θ₁² + 400/ω²)"),
        advice=True,
    )
    speed = design.top_speed
    if speed is None:
        yield made(missing=("duty.speed",))
        return
    if np.any(np.asarray(speed) == 0.0):
        return
    high, low = np.max(design.bend, axis=-1), np.min(design.bend, axis=-1)
    most: Array = angle_limits(speed, low, high, torsional=TABLE_TORSIONAL).most
    yield made(
        value=high,
        limit=most,
        levers=(*design.bend_levers, *design.speed_levers),
    )


def _phased(design: Design) -> bool:
    """Tell whether the yokes of two joints are set so that their bends cancel."""
    turned = design.chain.turn_before[..., 1]
    return bool(np.all(np.abs(np.cos(turned)) < SET))


CHECK = Check(
    name="angle_table",
    doc=mark("table of joint angles by speed, for two joints set right"),
    judge=_judge,
    crosses="all",
)
