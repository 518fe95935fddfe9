"""Questions that bends, planes and yokes decide: answered for many drives at once, without positions."""

from __future__ import annotations

from collections.abc import Sequence

from cardan.drive.drive import Drive
from cardan.maths.arrays import Array, namespace
from cardan.texts import mark

from .many import Many
from .questions import Question, Told


def _single(*told: Told) -> tuple[Told, ...]:
    return told


def _shafts(drive: Drive) -> range:
    """Return the shafts that joints drive, counted from 0."""
    return range(1, len(drive.joints) + 1)


def _inside(drive: Drive) -> tuple[Told, ...]:
    output = Told(
        name="output_acceleration_rad_s2",
        dimension="angular_acceleration",
        unit="rad_s2",
        text=mark("largest angular acceleration of the output"),
    )
    if len(drive.joints) == 1:
        return (output,)
    names = (
        ("drive_acceleration_rad_s2", mark("largest angular acceleration of inside shafts, the input turning evenly")),
        ("coast_acceleration_rad_s2", mark("largest angular acceleration of inside shafts, the output turning evenly")),
    )
    return (output, *(Told(name=n, dimension="angular_acceleration", unit="rad_s2", text=t) for n, t in names))


def _norms(found: Many) -> Sequence[Array]:
    swing = found.swings
    return [found.speed**2 * swing[..., k] for k in range(swing.shape[-1])]


def _each(values: Array) -> list[Array]:
    return [values[..., k] for k in range(values.shape[-1])]


def _greatest(found: Many) -> Sequence[Array]:
    return (namespace(found.joint_angle).max(found.joint_angle, axis=-1),)


MOTION = (
    Question(
        name="speed_fluctuation",
        doc=mark("speed fluctuation δ of the output: largest less smallest speed ratio"),
        told=lambda _drive: _single(Told(name="speed_fluctuation", text=mark("speed fluctuation of the output"))),
        of_many=lambda found: (found.output.speed_fluctuation,),
    ),
    Question(
        name="alpha_eq",
        doc=mark("equivalent angle: bend of the single Hooke joint that is as uneven as the drive"),
        told=lambda _drive: _single(
            Told(name="alpha_eq_deg", dimension="angle", unit="deg", text=mark("equivalent angle"))
        ),
        of_many=lambda found: (found.output.joint_angle,),
    ),
    Question(
        name="ratio",
        doc=mark("smallest and largest speed ratio of the drive over a turn"),
        told=lambda _drive: _single(
            Told(name="ratio_min", text=mark("smallest speed ratio")),
            Told(name="ratio_max", text=mark("largest speed ratio")),
        ),
        of_many=lambda found: (found.output.ratio_min, found.output.ratio_max),
    ),
    Question(
        name="angle_error",
        doc=mark("how far the output leads the input at most, about its mean"),
        told=lambda _drive: _single(
            Told(name="angle_error_deg", dimension="angle", unit="deg", text=mark("largest lead of the output"))
        ),
        of_many=lambda found: (found.output.max_angle_error,),
    ),
    Question(
        name="acceleration",
        doc=mark("largest angular accelerations at the speed of the duty: of the output and of the shafts inside"),
        told=_inside,
        of_many=_norms,
        needs_speed=True,
    ),
    Question(
        name="shaft_speed_fluctuation",
        doc=mark("speed fluctuation of every shaft that a joint drives"),
        told=lambda drive: tuple(
            Told(name=f"shaft_speed_fluctuation[{k}]", text=mark("speed fluctuation of a shaft"))
            for k in _shafts(drive)
        ),
        of_many=lambda found: _each(found.each.speed_fluctuation),
    ),
    Question(
        name="joint_angle",
        doc=mark("joint angle of every joint"),
        told=lambda drive: tuple(
            Told(name=f"joint_angle_deg[{i}]", dimension="angle", unit="deg", text=mark("joint angle of a joint"))
            for i in range(len(drive.joints))
        ),
        of_many=lambda found: _each(found.joint_angle),
    ),
    Question(
        name="greatest_joint_angle",
        doc=mark("joint angle of the joint that bends most"),
        told=lambda _drive: _single(
            Told(
                name="greatest_joint_angle_deg",
                dimension="angle",
                unit="deg",
                text=mark("greatest joint angle of a joint"),
            )
        ),
        of_many=_greatest,
    ),
    Question(
        name="length",
        doc=mark("length of every shaft between two joints, of drives given by joint centres"),
        told=lambda drive: tuple(
            Told(name=f"length_mm[{k}]", dimension="length", unit="mm", text=mark("length of a shaft"))
            for k in range(1, len(drive.joints))
        ),
        of_many=lambda found: _each(found.lengths),
    ),
)
"""Questions about motion."""
