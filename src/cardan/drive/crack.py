"""A crack across a shaft."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class ShaftCrack:
    """Crack across a shaft that opens and closes as it turns under its weight."""

    losses: tuple[float, ...] = plain(
        (), doc="shares of its bending stiffness that the shaft loses along the crack and across it while it is open"
    )
    depth_ratio: float | None = plain(
        None,
        doc="depth over the radius, in place of `losses`; where one shaft is a mass on a spring, taken along all of it",
        above=0.0,
        below=2.0,
    )
    position: float | None = quantity(
        "length",
        None,
        doc="place along the power flow from the joint before, on shaft 1 from joint 1; amid the shaft when not given",
    )
    breathing: int = plain(
        1, doc="power of the law of breathing: 0 is always open, 1 is Mayes' law, more opens for a shorter time", low=0
    )
    angle: float = quantity("angle", 0.0, doc="about the axis along the power flow, from the shaft's driving yoke")
