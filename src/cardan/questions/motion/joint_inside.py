"""What else moves inside a joint while it turns at a bend: wobble, orbits, strokes, play, planes that are missed."""

from __future__ import annotations

from cardan.drive.joints import Joint
from cardan.drive.joints.common.inside import Inside


def joint_inside(joint: Joint, joint_angle: float) -> tuple[Inside, ...]:
    """Return what else moves inside a joint at a joint angle, as far as its sizes are given.

    joint: a joint of any kind; joint_angle [rad]: α in [0, π/2).
    Returns: empty where nothing else moves, or where no size says how much.
    """
    return tuple(joint.inside(joint_angle))
