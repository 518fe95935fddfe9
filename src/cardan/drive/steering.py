"""A drive that steers: how far its wheel turns, and the speed ratio that it is to have straight ahead."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Steering:
    """What a drive is to do as a steering column; its start position is straight ahead."""

    lock: float = quantity("angle", doc="turn of the steering wheel from straight ahead to either lock", above=0.0)
    centre_ratio: float = plain(
        1.0, doc="speed ratio of output to steering wheel wanted straight ahead: 1 as uniform as can be", above=0.0
    )
