"""What to mind about a life: bends too small for its formulas, loads too large, values outside the tables."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from cardan.formulas.joint_rating import LEAST_BEND, LIFE_RANGE, ROUNDING, SPEED_ANGLE_RANGE, rated_bend, within
from cardan.maths.arrays import Array, ArrayLike, floats
from cardan.texts import _
from cardan.units import deg

if TYPE_CHECKING:
    from .life import Life

HEAVY = 0.5
"""ISO 281 holds for loads up to this share of the capacity."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Caution:
    """Something to mind.

    Attributes
    ----------
    code : str
        ``small_oscillation``, ``angle_clamped_3deg``, ``extrapolated``, ``no_swing`` or ``heavy_load``.
    joint : int
        Number of the joint; 0 where it is the duty.
    message : str
        In one sentence.
    """

    code: str
    joint: int
    message: str


def clamped(bend: ArrayLike) -> Array:
    """Tell whether book and makers count a bend as 3°, array (...) of bool.

    Parameters
    ----------
    bend : array (...) [rad]
    """
    (alpha,) = floats(bend)
    return alpha < LEAST_BEND * (1.0 - ROUNDING)


def extrapolated(speed_angle: ArrayLike, life: ArrayLike) -> Array:
    """Tell whether speed times bend or life lie outside the tables of the book, array (...) of bool.

    Parameters
    ----------
    speed_angle : array (...) [rad²/s]
        With the bend that the book counts.
    life : array (...) [s]
    """
    return ~(within(speed_angle, SPEED_ANGLE_RANGE) & within(life, LIFE_RANGE))


def cautions(found: Life, *, beyond: bool) -> Iterator[Caution]:
    """Yield what to mind about the lives of a drive; ``beyond`` tells that the reliability is outside its table."""
    running = found.share > 0.0
    bend = found.bend[running]
    speed = np.abs(np.asarray([part.speed for part in found.parts]))[running, None]
    book = found.of("book")
    for i in range(bend.shape[1]):
        least = float(np.min(bend[:, i]))
        own = found.bearings
        if np.any(bend[:, i] == 0.0) and own.rated[i]:
            text = _("joint {number} does not bend: its needles do not roll, and ISO 281 rates no life for that")
            yield Caution(code="no_swing", joint=i + 1, message=text.format(number=i + 1))
        if least < own.critical_swing[i]:
            text = _(
                "joint {number} bends {bend:.3g}°; below {limit:.3g}° each needle wears its own patch, and formulas "
                "promise too much"
            )
            said = text.format(number=i + 1, bend=least / deg, limit=own.critical_swing[i] / deg)
            yield Caution(code="small_oscillation", joint=i + 1, message=said)
        figures = ~np.isnan(found.book[:, i]) | ~np.isnan(found.maker[:, i])
        if np.any(clamped(bend[:, i])) and np.any(figures):
            text = _("joint {number} bends {bend:.3g}°; book and makers count it as 3°")
            said = text.format(number=i + 1, bend=least / deg)
            yield Caution(code="angle_clamped_3deg", joint=i + 1, message=said)
        whole = book[i]
        if np.isfinite(whole) and np.any(extrapolated(speed[:, 0] * rated_bend(bend[:, i]), whole)):
            text = _("joint {number} is outside the book's tables, 10 to 35 000 rpm·° and 100 to 100 000 h")
            yield Caution(code="extrapolated", joint=i + 1, message=text.format(number=i + 1))
        most = float(np.max(found.journal_force[running, i]))
        if most > HEAVY * own.capacity[i]:
            text = _(
                "journals of joint {number} carry up to {force} N, over half of their dynamic capacity of {capacity} "
                "N; ISO 281 ends there"
            )
            said = text.format(number=i + 1, force=_grouped(most), capacity=_grouped(float(own.capacity[i])))
            yield Caution(code="heavy_load", joint=i + 1, message=said)
    if beyond:
        text = _("{share:.6g} % reliability is beyond the table of ISO 281, which ends at 99.95 %")
        yield Caution(code="extrapolated", joint=0, message=text.format(share=100.0 * found.reliability))


def _grouped(value: float) -> str:
    """Return a number with four digits, in thin groups.

    Examples
    --------
    >>> _grouped(51086.7), _grouped(12.3456)
    ('51\u202f090', '12.35')
    """
    text = f"{float(f'{value:.4g}'):,.10g}"
    return text.replace(",", "\u202f")
