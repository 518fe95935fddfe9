"""The drive: shafts and joints alternating, and the rest of the drive file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from cardan.errors import check

from .described import Described, Input, Output
from .fields.validity import point_problems, problems, wrong_count
from .joints import Hooke
from .shaft import Shaft


@dataclass(frozen=True, kw_only=True, slots=True)
class Drive(Described):
    """A universal-joint drive as described by one drive file, in SI.

    ``shafts`` may be given for any of the numbers 1 to n+1; missing ones are filled in with their defaults.

    Raises
    ------
    InputError
        With every contradiction found, each with its path.

    Examples
    --------
    >>> from cardan import Drive
    >>> from cardan.units import deg
    >>> Drive.from_angles([20 * deg]).form
    'angles'
    """

    def __post_init__(self) -> None:
        check(problems(self))
        object.__setattr__(self, "shafts", self.all_shafts())

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
        """Return a drive of Hooke joints with given joint angles.

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
