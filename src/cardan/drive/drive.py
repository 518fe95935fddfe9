"""The drive: shafts and joints alternating, and the rest of the drive file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

from cardan.errors import check
from cardan.units import plain, quantity

from .duty import Duty, Limits
from .joints import Hooke, Joint
from .joints.joint import Point
from .movement import Movement
from .pose import Pose
from .settings import Settings
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
class Drive:
    """A universal-joint drive as described by one drive file, in SI.

    ``shafts`` may be given for any of the numbers 1 to n+1; missing ones are filled in with their defaults.

    Raises
    ------
    InputError
        With every contradiction found, each with its path.

    Examples
    --------
    >>> from cardan.units import deg
    >>> Drive.from_angles([20 * deg]).form
    'angles'
    """

    format: ClassVar[int] = 1

    name: str = plain("", doc="name of the drive")
    note: str = plain("", doc="what the reader of the report should know")
    settings: Settings = plain(Settings(), doc="surroundings of the drive")
    input: Input = plain(Input(), doc="the driving end")
    output: Output = plain(Output(), doc="the driven end")
    joints: tuple[Joint, ...] = plain(doc="the joints in the order of the power flow")
    shafts: tuple[Shaft, ...] = plain((), doc="the shafts, any of them, by their number")
    supports: tuple[Support, ...] = plain((), doc="bearings that hold the shafts in the housing")
    stations: tuple[Station, ...] = plain((), doc="masses that turn with the shafts, beside those of the shafts")
    duty: Duty = plain(Duty(), doc="what the drive does")
    limits: Limits = plain(Limits(), doc="limits over the built-in ones")
    movements: tuple[Movement, ...] = plain((), doc="how the points of the drive move")
    poses: tuple[Pose, ...] = plain((), doc="standing variants of the drive")

    def __post_init__(self) -> None:
        from .fields.validity import all_shafts, problems

        check(problems(self))
        object.__setattr__(self, "shafts", all_shafts(self))

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

    @classmethod
    def from_points(
        cls,
        points: Sequence[Sequence[float]],
        *,
        yoke_angles: Sequence[float] = (),
        start_phase: float = 0.0,
        name: str = "",
    ) -> Drive:
        """Return a drive of Hooke joints through points of its axis.

        Parameters
        ----------
        points : sequence (n+2, 3) [m]
            A point of the input axis, the n joint centres, a point of the output axis.
        yoke_angles : sequence (n-1,) [rad]
            γ of shafts 2 to n; all zero when empty.
        start_phase : float [rad]
            ψ_1.
        name : str
            Name of the drive.
        """
        from .fields.validity import point_problems, wrong_count

        rows = [tuple(float(x) for x in point) for point in points]
        check(point_problems(rows))
        check(wrong_count("yoke_angles", yoke_angles, len(rows) - 3, empty=True))
        return cls(
            name=name,
            input=Input(point=rows[0], start_phase=start_phase),  # type: ignore[arg-type]
            output=Output(point=rows[-1]),  # type: ignore[arg-type]
            joints=tuple(Hooke(centre=row) for row in rows[1:-1]),  # type: ignore[arg-type]
            shafts=_yokes(yoke_angles),
        )

    @classmethod
    def from_angles(
        cls,
        joint_angles: Sequence[float],
        *,
        plane_twists: Sequence[float] = (),
        yoke_angles: Sequence[float] = (),
        start_phase: float = 0.0,
        name: str = "",
    ) -> Drive:
        """Return a drive of Hooke joints with given bends.

        Parameters
        ----------
        joint_angles : sequence (n,) [rad]
            α of each joint.
        plane_twists : sequence (n-1,) [rad]
            β of joints 2 to n; all zero when empty.
        yoke_angles : sequence (n-1,) [rad]
            γ of shafts 2 to n; all zero when empty.
        start_phase : float [rad]
            ψ_1.
        name : str
            Name of the drive.
        """
        from .fields.validity import wrong_count

        between = max(len(joint_angles) - 1, 0)
        check(
            [
                *wrong_count("plane_twists", plane_twists, between, empty=True),
                *wrong_count("yoke_angles", yoke_angles, between, empty=True),
            ]
        )
        twists = [float(twist) for twist in plane_twists] or [0.0] * between
        return cls(
            name=name,
            input=Input(start_phase=start_phase),
            joints=tuple(
                Hooke(joint_angle=float(joint_angle), plane_twist=twist)
                for joint_angle, twist in zip(joint_angles, [0.0, *twists], strict=False)
            ),
            shafts=_yokes(yoke_angles),
        )


def _yokes(angles: Sequence[float]) -> tuple[Shaft, ...]:
    return tuple(Shaft(number=k, yoke_angle=float(angle)) for k, angle in enumerate(angles, start=2))
