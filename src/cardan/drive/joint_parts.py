"""Parts of a joint beside its cross: needle bearings, yokes, and what a maker allows."""

from __future__ import annotations

import math
from dataclasses import dataclass

from cardan.drive.material import Material
from cardan.units import plain, quantity


@dataclass(frozen=True, kw_only=True, slots=True)
class Needles:
    """Needle bearing of a journal, one row without a cage."""

    count: int | None = plain(None, doc="number of needles", low=3)
    diameter: float | None = quantity("length", None, doc="diameter of a needle", above=0.0)
    length: float | None = quantity("length", None, doc="effective length of a needle", above=0.0)
    capacity: float | None = quantity("force", None, doc="dynamic capacity C", above=0.0)
    static_capacity: float | None = quantity("force", None, doc="static capacity C0", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Section:
    """Cross-section of a yoke's arm."""

    shape: str = plain(doc="rectangle or ellipse", choices=("rectangle", "ellipse"))
    height: float = quantity("length", doc="along the force of the journal", above=0.0)
    width: float = quantity("length", doc="across the force of the journal", above=0.0)


@dataclass(frozen=True, kw_only=True, slots=True)
class Yoke:
    """Yoke of a joint: the lever arms of the journal's force on its weakest section."""

    bending_arm: float | None = quantity("length", None, doc="arm of the force for bending", low=0.0)
    torsion_arm: float | None = quantity("length", None, doc="arm of the force for torsion", low=0.0)
    section: Section | None = plain(None, doc="weakest section of an arm")
    material: Material | None = plain(None, doc="material")


@dataclass(frozen=True, kw_only=True, slots=True)
class Rating:
    """What a maker allows."""

    torque: float | None = quantity("torque", None, doc="rated torque by the maker's convention", above=0.0)
    convention: str = plain(
        "Tc",
        doc="what the rated torque means: Tc (5000 h at 3° and 100 rpm), CR (dynamic capacity times arm) or book "
        "(5000 h at 3° and 33.3 rpm)",
        choices=("Tc", "CR", "book"),
    )
    max_torque: float | None = quantity("torque", None, doc="largest torque, short and rare", above=0.0)
    max_joint_angle: float | None = quantity("angle", None, doc="largest joint angle", above=0.0, below=math.pi / 2)
    max_speed: float | None = quantity("angular_speed", None, doc="largest speed", above=0.0)
    speed_angle: float | None = quantity("speed_angle", None, doc="largest product of speed and joint angle", above=0.0)
    rim_speed: float | None = quantity("speed", None, doc="largest speed of the rim", above=0.0)
    outer: float | None = quantity("length", None, doc="outer diameter of the joint", above=0.0)
