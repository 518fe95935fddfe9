"""A support: a bearing that holds a shaft in the housing."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.units import plain, quantity

from .joints.joint import Point

APART = 0.5e-3  # [m]: a bearing so near to the place about which a shaft swivels lets it


@dataclass(frozen=True, kw_only=True, slots=True)
class Support:
    """Bearing of a shaft: radial unless it says otherwise."""

    name: str = plain("", doc="name of the support, for tables and pictures")
    shaft: int = plain(doc="number of the shaft it holds", low=1)
    position: float = quantity(
        "length",
        doc="place along the power flow from the joint before it; on shaft 1 from joint 1, so zero or negative there",
    )
    radial: bool = plain(True, doc="whether it holds the shaft sideways")
    axial: bool = plain(False, doc="whether it holds the shaft lengthwise, both ways")
    tilt: bool = plain(False, doc="whether it holds the slope of the shaft too, as a fixed end does")
    stiffness: float | None = quantity("stiffness", None, doc="radial stiffness", above=0.0)
    side_stiffness: float | None = quantity(
        "stiffness",
        None,
        doc="radial stiffness sideways, where `stiffness` is that up and down; counts in the whirl of the whole line",
        above=0.0,
    )
    damping: float | None = quantity(
        "damping", None, doc="radial damping; counts in the whirl of the whole line", low=0.0
    )
    axial_stiffness: float | None = quantity("stiffness", None, doc="axial stiffness", above=0.0)
    tilt_stiffness: float | None = quantity("turning_stiffness", None, doc="stiffness against tilting", above=0.0)
    bearing: str = plain(
        "", doc="ball bearing, a row of the catalogue: 6208, or 6208-2RS with contact seals; brings bore and ratings"
    )
    capacity: float | None = quantity("force", None, doc="dynamic capacity C of its ball bearing", above=0.0)
    static_capacity: float | None = quantity("force", None, doc="static capacity C0 of its ball bearing", above=0.0)
    max_speed: float | None = quantity("angular_speed", None, doc="limiting speed of its bearing", above=0.0)
    bore: float | None = quantity("length", None, doc="diameter at which its friction acts", above=0.0)
    friction: float | None = plain(None, doc="coefficient of friction, at the diameter `bore`", low=0.0)
    seal: str = plain("", doc="shaft seal, a row of the catalogue: 40x62x8; brings `seal_diameter`")
    seal_diameter: float | None = quantity("length", None, doc="diameter of the shaft under its lip seals", above=0.0)
    max_lip_speed: float | None = quantity(
        "speed",
        None,
        doc="largest speed of the shaft's surface under its seals: the maker's, by rubber and lubricant",
        above=0.0,
    )
    seals: int = plain(1, doc="how many lip seals it has, where it has any", low=1)
    offset: Point = quantity("length", (0.0, 0.0, 0.0), doc="displacement of the housing there [x, y, z]")

    def hinders(self, place: float) -> bool:
        """Tell whether it keeps its shaft from swivelling about a place [m]."""
        return self.tilt or (self.radial and abs(self.position - place) > APART)
