"""Kinds of joints: one file each, and its name in `JOINTS`."""

from .clemens import Clemens, Profile
from .constant_velocity import ConstantVelocity
from .double_cardan import DoubleCardan
from .half_cardan import ElasticHalfCardan, HalfCardan
from .hooke import Hooke
from .joint import Joint
from .offset_cross import OffsetCross
from .pin_coupling import PinCoupling
from .rzeppa import Rzeppa
from .tracta import Tracta
from .tripod import Tripod
from .weiss import Weiss

JOINTS: dict[str, type[Joint]] = {
    kind.kind: kind
    for kind in (
        Hooke,
        OffsetCross,
        DoubleCardan,
        ConstantVelocity,
        Tracta,
        Rzeppa,
        Weiss,
        Tripod,
        HalfCardan,
        ElasticHalfCardan,
        PinCoupling,
        Clemens,
    )
}
"""Value of the file key ``kind`` -> class."""

__all__ = [
    "JOINTS",
    "Clemens",
    "ConstantVelocity",
    "DoubleCardan",
    "ElasticHalfCardan",
    "HalfCardan",
    "Hooke",
    "Joint",
    "OffsetCross",
    "PinCoupling",
    "Profile",
    "Rzeppa",
    "Tracta",
    "Tripod",
    "Weiss",
]
