"""Kinds of joints: one file each, and its name in `JOINTS`. What a kind says stands in `joint`."""

from __future__ import annotations

from cardan.later import Kinds, later

from .hooke import Hooke
from .joint import Joint

JOINTS: Kinds[Joint] = Kinds(
    {
        "hooke": later("cardan.drive.joints.hooke", of="Hooke"),
        "offset_cross": later("cardan.drive.joints.offset_cross", of="OffsetCross"),
        "double_cardan": later("cardan.drive.joints.double_cardan", of="DoubleCardan"),
        "constant_velocity": later("cardan.drive.joints.constant_velocity", of="ConstantVelocity"),
        "tracta": later("cardan.drive.joints.tracta", of="Tracta"),
        "rzeppa": later("cardan.drive.joints.rzeppa", of="Rzeppa"),
        "weiss": later("cardan.drive.joints.weiss", of="Weiss"),
        "tripod": later("cardan.drive.joints.tripod", of="Tripod"),
        "half_cardan": later("cardan.drive.joints.half_cardan", of="HalfCardan"),
        "elastic_half_cardan": later("cardan.drive.joints.half_cardan", of="ElasticHalfCardan"),
        "pin_coupling": later("cardan.drive.joints.pin_coupling", of="PinCoupling"),
        "clemens": later("cardan.drive.joints.clemens", of="Clemens"),
        "mechanism": later("cardan.drive.joints.mechanism", of="MechanismJoint"),
    }
)
"""Value of the file key ``kind`` -> class."""

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
    if not name or joint.any_type or name in joint.types:
        return []
    return [kind.in_words() for kind in JOINTS.values() if name in kind.types]


__all__ = ["DEFAULT", "JOINTS", "Hooke", "Joint", "other_kinds", "register"]
