"""What else moves inside a joint while it turns at a bend: wobble, orbits, strokes, play, planes that are missed."""

from __future__ import annotations

from cardan.drive.joints import Joint
from cardan.drive.joints.common.inside import Inside


def joint_inside(joint: Joint, joint_angle: float) -> tuple[Inside, ...]:
    """Return what else moves inside a joint at a joint angle, as far as its sizes are given.

    Parameters
    ----------
    joint : Joint
        A joint of any kind.
    joint_angle : float [rad]
        α in [0, π/2).

    Returns
    -------
    tuple of Inside
        Empty where nothing else moves, or where no size says how much.

    Examples
    --------
    >>> from cardan.drive.joints import Tripod
    >>> from cardan.units import deg
    >>> (orbit,) = joint_inside(Tripod(track_radius=0.02), 20 * deg)
    >>> print(f"{orbit.meaning}: {1e3 * orbit.value:.4f} mm")
    radius of the circle that the spider runs round three times a turn: 0.6418 mm
    """
    return tuple(joint.inside(joint_angle))
