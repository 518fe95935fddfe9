"""What to mind about a life: bends too small for its formulas, loads too large, values outside the tables."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Quantity, say
from cardan.formulas.ball_bearing import THRUST
from cardan.formulas.joint_rating import (
    LEAST_JOINT_ANGLE,
    LIFE_RANGE,
    ROUNDING,
    SPEED_ANGLE_RANGE,
    rated_joint_angle,
    within,
)
from cardan.maths.arrays import Array, ArrayLike, floats
from cardan.texts import _

from .lives import Caution, Life

LEAST = Quantity(LEAST_JOINT_ANGLE, "angle", trim=True)
"""As what smaller joint angles count."""

HEAVY = 0.5
"""ISO 281 holds for loads up to this share of the capacity."""


def clamped(joint_angle: ArrayLike) -> Array:
    """Tell whether book and makers count a joint angle as 3°, array (...) of bool. joint_angle (...) [rad]."""
    (alpha,) = floats(joint_angle)
    return alpha < LEAST_JOINT_ANGLE * (1.0 - ROUNDING)


def extrapolated(speed_angle: ArrayLike, life: ArrayLike) -> Array:
    """Tell whether speed times joint angle or life lie outside the tables of the book, array (...) of bool.

    speed_angle (...) [rad²/s]: with the joint angle that the book counts; life (...) [s].
    """
    return ~(within(speed_angle, SPEED_ANGLE_RANGE) & within(life, LIFE_RANGE))


def _held(found: Life) -> Iterator[Caution]:
    """Yield bearings of supports that carry more than their rating is made for."""
    if found.supports is None:
        return
    own, loads = found.supports, found.supports.loads
    for k, number in enumerate(own.number):
        most, along = float(np.max(loads.load[:, k])), float(np.max(loads.axial[:, k]))
        if most > HEAVY * own.capacity[k]:
            text = _(
                "the bearing of support {number} carries {force} as equivalent load, over half of its dynamic "
                "capacity of {capacity}; ISO 281 ends there"
            )
            size = {"force": Quantity(most, "force"), "capacity": Quantity(float(own.capacity[k]), "force")}
            yield Caution(code="heavy_load", joint=0, message=say(text, number=number, **size))
        if along > THRUST[-1] * own.static_capacity[k]:
            text = _(
                "the bearing of support {number} carries {force} axially, more than the table of ISO 281 for deep "
                "groove ball bearings has, {limit}"
            )
            size = {"force": Quantity(along, "force"), "limit": Quantity(THRUST[-1] * own.static_capacity[k], "force")}
            yield Caution(code="heavy_thrust", joint=0, message=say(text, number=number, **size))


def cautions(found: Life, *, beyond: bool) -> Iterator[Caution]:
    """Yield what to mind about the lives of a drive; ``beyond`` tells that the reliability is outside its table."""
    running = found.share > 0.0
    joint_angle = found.joint_angle[running]
    speed = np.asarray([abs(part.speed or 0.0) for part in found.parts])[running, None]
    book = found.of("book")
    for i in range(joint_angle.shape[1]):
        least = float(np.min(joint_angle[:, i]))
        own = found.bearings
        if np.any(joint_angle[:, i] == 0.0) and own.rated[i]:
            text = _("joint {number} is straight: its needles do not roll, and ISO 281 rates no life for that")
            yield Caution(code="no_swing", joint=i + 1, message=say(text, number=i + 1))
        angle = Quantity(least, "angle", 3)
        if least < own.critical_swing[i]:
            text = _(
                "joint {number} has a joint angle of {angle}; below {limit} roller paths do not overlap: false "
                "brinelling, and the computed life is optimistic"
            )
            said = say(text, number=i + 1, angle=angle, limit=Quantity(float(own.critical_swing[i]), "angle", 3))
            yield Caution(code="small_oscillation", joint=i + 1, message=said)
        figures = ~np.isnan(found.book[:, i]) | ~np.isnan(found.maker[:, i])
        if np.any(clamped(joint_angle[:, i])) and np.any(figures):
            text = _("joint {number} has a joint angle of {angle}; handbook and makers count it as {least}")
            said = say(text, number=i + 1, angle=angle, least=LEAST)
            yield Caution(code="angle_clamped_3deg", joint=i + 1, message=said)
        whole = book[i]
        if np.isfinite(whole) and np.any(extrapolated(speed[:, 0] * rated_joint_angle(joint_angle[:, i]), whole)):
            text = _("joint {number} is outside the handbook's tables, 10 to 35 000 rpm·° and 100 to 100 000 h")
            yield Caution(code="extrapolated", joint=i + 1, message=say(text, number=i + 1))
        most = float(np.max(found.journal_force[running, i]))
        if most > HEAVY * own.capacity[i]:
            text = _(
                "journals of joint {number} carry up to {force}, over half of their dynamic capacity of {capacity}; "
                "ISO 281 ends there"
            )
            capacity = Quantity(float(own.capacity[i]), "force")
            said = say(text, number=i + 1, force=Quantity(most, "force"), capacity=capacity)
            yield Caution(code="heavy_load", joint=i + 1, message=said)
    yield from _held(found)
    if beyond:
        text = _("{share} reliability is beyond the table of ISO 281, which ends at 99.95 %")
        share = Quantity(found.reliability, "share", 6, trim=True)
        yield Caution(code="extrapolated", joint=0, message=say(text, share=share))
