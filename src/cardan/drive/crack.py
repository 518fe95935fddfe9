"""A crack across a shaft."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from cardan.errors import Problem
from cardan.texts import _
from cardan.units import plain, quantity

if TYPE_CHECKING:
    from .shaft import Shaft


@dataclass(frozen=True, kw_only=True, slots=True)
class ShaftCrack:
    """Crack across a shaft that opens and closes as it turns under its weight."""

    losses: tuple[float, ...] = plain(
        (), doc="shares of its bending stiffness that the shaft loses along the crack and across it while it is open"
    )
    depth_ratio: float | None = plain(
        None,
        doc="depth over the radius of a solid shaft, in place of `losses`; taken along the whole shaft",
        above=0.0,
        below=2.0,
    )
    breathing: int = plain(
        1, doc="power of the law of breathing: 0 is always open, 1 is Mayes' law, more opens for a shorter time", low=0
    )
    angle: float = quantity("angle", 0.0, doc="about the axis along the power flow, from the shaft's driving yoke")


def crack_problems(shaft: Shaft, path: str) -> Iterator[Problem]:
    """Yield what contradicts itself in a crack.

    Parameters
    ----------
    shaft : Shaft
        The shaft.
    path : str
        Of the shaft.
    """
    crack = shaft.crack
    if crack is None:
        return
    if bool(crack.losses) == (crack.depth_ratio is not None):
        yield Problem(f"{path}.crack", _("give either its losses or its depth_ratio"), "inconsistent")
    if crack.losses and len(crack.losses) != 2:
        yield Problem(f"{path}.crack.losses", _("needs two shares, along the crack and across it"), "inconsistent")
    if any(not 0.0 <= one < 1.0 for one in crack.losses):
        yield Problem(f"{path}.crack.losses", _("needs to be at least 0 and below 1"), "out_of_range")
    if crack.depth_ratio is not None and (shaft.inner or shaft.wall or any(one.inner for one in shaft.segments)):
        text = _("is of a solid shaft; a tube needs its losses")
        yield Problem(f"{path}.crack.depth_ratio", text, "inconsistent")
