"""Kinds of joints: one file each, and its name in `JOINTS`. What a kind says stands in `joint`."""

from .clemens import Clemens, Profile
from .constant_velocity import ConstantVelocity
from .double_cardan import DoubleCardan
from .half_cardan import ElasticHalfCardan, HalfCardan
from .hooke import Hooke
from .joint import Joint
from .mechanism import MechanismJoint
from .offset_cross import OffsetCross
from .pin_coupling import PinCoupling
from .rzeppa import Rzeppa
from .tracta import Tracta
from .tripod import Tripod
from .weiss import Weiss

JOINTS: dict[str, type[Joint]] = {}  # value of the file key ``kind`` -> class
DEFAULT = Hooke.kind  # kind of a joint whose file does not name it


def register(*kinds: type[Joint]) -> None:
    """Make kinds of joints known to files, commands and pages by the value of their key ``kind``.

    *kinds: classes; one of a name that is there takes its place.
    """
    JOINTS.update({kind.kind: kind for kind in kinds})


def other_kinds(joint: Joint, name: str) -> list[str]:
    """Return the kinds, in words, whose law a type of the catalogue turns by; empty where the joint may be of it.

    A type that no kind names is anybody's, and an ideal joint of constant velocity may be any type.
    """
    kinds = {kind.kind: kind.in_words() for kind in JOINTS.values() if name in kind.types}
    return [] if joint.kind in kinds or joint.any_type else list(kinds.values())


register(
    Hooke, OffsetCross, DoubleCardan, ConstantVelocity, Tracta, Rzeppa, Weiss, Tripod, HalfCardan, ElasticHalfCardan,
    PinCoupling, Clemens, MechanismJoint,
)  # fmt: skip

__all__ = [
    "DEFAULT", "JOINTS", "Clemens", "ConstantVelocity", "DoubleCardan", "ElasticHalfCardan", "HalfCardan", "Hooke",
    "Joint", "MechanismJoint", "OffsetCross", "PinCoupling", "Profile", "Rzeppa", "Tracta", "Tripod", "Weiss",
    "other_kinds", "register",
]  # fmt: skip
