"""What the yoke angles of a drive can do."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from .setting import YokeSetting
from .steering import SteeringColumn


@dataclass(frozen=True, eq=False, kw_only=True)
class Phasing:
    """What the yoke angles of a drive can do.

    Attributes
    ----------
    as_built : YokeSetting
        The drive as described.
    feasible : bool
        Whether the free yokes can make it synchronous, exactly and in all harmonics.
    speed_fluctuation_min, speed_fluctuation_max : float
        δ that the free yokes can reach, and everything between.
    joint_angle_min, joint_angle_max : float [rad]
        The same as equivalent angles.
    free, fixed : tuple of int
        Numbers of the shafts whose yokes may be turned, and of those held.
    settings : tuple of YokeSetting
        Exact optima, best by the goal first: a setting and its mirror image, and what else the goal found.
    spline_settings : tuple of YokeSetting
        Best settings and runners-up that spline teeth allow; empty where no shaft has ``spline.teeth``.
    spline_steps : mapping of int to int
        Shaft number -> how many different yoke angles its teeth allow.
    spline_refusal : str
        Why the settings with spline teeth could not be enumerated; empty when they could.
    limiting_joint : int or None
        Number of the joint whose joint angle is too large for the others, where not feasible.
    limiting_joints : tuple of int
        The same with the joints that held yokes tie to it.
    poses : tuple of str
        Names of the poses that the settings are judged in.
    pose_settings : tuple of YokeSetting
        The setting with the least speed fluctuation in the worst pose, and that with the least mean over the poses'
        shares of time; empty when there are no poses.
    steering : tuple of SteeringColumn
        A steering column as specified, then in its best settings; empty where the drive is none.
    complete : bool
        False when ``progress`` stopped the search; what was found by then is kept.
    followed : bool
        Whether joints turn by laws of their own, so that settings were sought by those and nothing is proved.
    """

    as_built: YokeSetting
    feasible: bool
    speed_fluctuation_min: float
    speed_fluctuation_max: float
    joint_angle_min: float
    joint_angle_max: float
    free: tuple[int, ...]
    fixed: tuple[int, ...]
    settings: tuple[YokeSetting, ...]
    spline_settings: tuple[YokeSetting, ...] = ()
    spline_steps: Mapping[int, int] = field(default_factory=dict)
    spline_refusal: str = ""
    limiting_joint: int | None = None
    limiting_joints: tuple[int, ...] = ()
    poses: tuple[str, ...] = ()
    pose_settings: tuple[YokeSetting, ...] = ()
    steering: tuple[SteeringColumn, ...] = ()
    complete: bool = True
    followed: bool = False

    @property
    def reach(self) -> float:
        """Largest fluctuation met, in the drive and in its poses: the scale by which growth is more than rounding."""
        every = (self.as_built, *self.settings, *self.pose_settings)
        return max(
            self.speed_fluctuation_max, *(float(np.max(one.pose_speed_fluctuation, initial=0.0)) for one in every)
        )


def joint_angle_of(length: float) -> float:
    """Return the angle of the Hooke joint [rad] of a length L = asinh(δ/2) = -ln cos α; δ = sin α tan α."""
    return 2.0 * math.atan(math.sqrt(math.tanh(0.5 * length)))
