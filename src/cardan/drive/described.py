"""What a drive file says of a drive, as it stands: not yet checked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

from cardan.units import plain, quantity

from .duty import Duty, Limits
from .joints import Joint
from .joints.joint import Point
from .movement import Movement
from .settings import Pose, Settings, Steering, TitleBlock
from .shaft import Shaft
from .station import Station
from .support import Support

Form: TypeAlias = Literal["points", "angles", "slopes"]


@dataclass(frozen=True, kw_only=True, slots=True)
class Input:
    """The driving end."""

    point: Point | None = quantity("length", None, doc="any point of the input axis before joint 1")
    start_phase: float = quantity(
        "angle", 0.0, doc="angle of the driving yoke of joint 1 from the plane of that joint at the start"
    )


@dataclass(frozen=True, kw_only=True, slots=True)
class Output:
    """The driven end."""

    point: Point | None = quantity("length", None, doc="any point of the output axis behind the last joint")


@dataclass(frozen=True, kw_only=True, slots=True)
class Described:
    """The keys of a drive file; a `cardan.drive.drive.Drive` is one that contradicts itself nowhere."""

    format: ClassVar[int] = 1

    name: str = plain("", doc="name of the drive")
    note: str = plain("", doc="what the reader of the report should know")
    report: TitleBlock = plain(TitleBlock(), doc="title block of the report")
    settings: Settings = plain(Settings(), doc="surroundings of the drive")
    input: Input = plain(Input(), doc="the driving end")
    output: Output = plain(Output(), doc="the driven end")
    joints: tuple[Joint, ...] = plain(doc="the joints in the order of the power flow")
    shafts: tuple[Shaft, ...] = plain((), doc="the shafts, any of them, by their number")
    supports: tuple[Support, ...] = plain((), doc="bearings that hold the shafts in the housing")
    stations: tuple[Station, ...] = plain((), doc="masses that turn with the shafts, beside those of the shafts")
    duty: Duty = plain(Duty(), doc="what the drive does")
    limits: Limits = plain(Limits(), doc="limits over the built-in ones")
    steering: Steering | None = plain(None, doc="what the drive is to do as a steering column")
    movements: tuple[Movement, ...] = plain((), doc="how the points of the drive move")
    poses: tuple[Pose, ...] = plain((), doc="standing variants of the drive")

    @property
    def form(self) -> Form:
        """In which form the geometry is given."""
        if any(joint.centre is not None for joint in self.joints):
            return "points"
        if any(joint.joint_angle is not None for joint in self.joints):
            return "angles"
        if any(shaft.side_slope is not None or shaft.plan_slope is not None for shaft in self.shafts):
            return "slopes"
        return "points" if self.input.point is not None or self.output.point is not None else "slopes"

    def all_shafts(self) -> tuple[Shaft, ...]:
        """Return shafts 1 to n+1, the ones not given with their defaults."""
        given = {shaft.number: shaft for shaft in self.shafts}
        return tuple(given.get(k) or Shaft(number=k) for k in range(1, len(self.joints) + 2))
