"""Standing variants of a drive: full load and empty, straight and turned."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from cardan.units import plain, quantity

Value: TypeAlias = float | tuple[float, ...] | bool | str
Change: TypeAlias = tuple[str, Value]


@dataclass(frozen=True, kw_only=True, slots=True)
class Pose:
    """A named set of changed fields and the share of time spent so."""

    name: str = plain(doc="name of the pose")
    share: float | None = quantity("share", None, doc="share of running time in this pose", low=0.0, high=1.0)
    set: tuple[Change, ...] = plain(doc='changed fields by path: { "joints[1].centre_mm" = [1200, 0, -150] }')
