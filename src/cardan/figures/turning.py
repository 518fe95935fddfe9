"""What figures over the input angle share: the axis, and how shafts and supports are called."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cardan.maths.arrays import Array
from cardan.texts import _

from .axes import angle_axis, axis
from .figure import Axis
from .palette import DASHES

LONG = 24
"""Letters of a name in a legend."""


def across(angle: Array, *, named: bool = False) -> Axis:
    """Return the axis of the input angle [°]; without name and unit where a panel below carries them.

    angle (p,): input angles [°]; named: write what runs along it.
    """
    label = _("input angle φ₁ from the start position") if named else ""
    stop = float(np.max(angle)) if angle.size else 360.0
    if float(np.min(angle, initial=0.0)) < 0.0 or stop > 1080.0 or stop < 45.0:
        made = axis(label, "deg", [angle], dimension="angle", margin=0.0, least=1.0)
    else:
        made = angle_axis(label, stop)
    bare = Axis(low=made.low, high=made.high, ticks=made.ticks, texts=made.texts)
    return replace(made if named else bare, turning=True)


def shaft_name(number: int, count: int) -> str:
    """Return what a shaft is called in a legend.

    >>> shaft_name(1, 3), shaft_name(2, 3), shaft_name(3, 3)
    ('shaft 1, input', 'shaft 2', 'shaft 3, output')
    """
    if number == 1:
        return _("shaft 1, input")
    if number == count:
        return _("shaft {number}, output").format(number=number)
    return _("shaft {number}").format(number=number)


def support_name(number: int, shaft: int, name: str = "") -> str:
    """Return what a support is called in a legend.

    >>> support_name(3, 2), support_name(3, 2, "centre bearing")
    ('support 3 on shaft 2', '3 centre bearing')
    """
    if name:
        return f"{number} {name if len(name) <= LONG else name[: LONG - 1] + '…'}"
    return _("support {number} on shaft {shaft}").format(number=number, shaft=shaft)


def support_dashes(shafts: Sequence[int]) -> tuple[str, ...]:
    """Return how the curve of every support is drawn: in the colour of its shaft, the second on it dashed, and so on.

    >>> support_dashes([1, 1, 2])
    ('solid', 'dashed', 'solid')
    """
    return tuple(DASHES[list(shafts[:k]).count(shaft) % len(DASHES)] for k, shaft in enumerate(shafts))
