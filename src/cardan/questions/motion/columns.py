"""What a sweep may ask that joint angles, planes and yokes decide: of many drives at once, without positions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.maths.arrays import Array, namespace
from cardan.texts import mark

from .turning import Evenness


class Motions(Protocol):
    """What the motion of many drives is asked, arrays (n, ...) in SI; see `cardan.batch.answering.many.Many`."""

    @property
    def joint_angle(self) -> Array:
        """Angles of the joints (n, joints)."""

    @property
    def speed(self) -> Array | float:
        """Speed of the input (n,)."""

    @property
    def output(self) -> Evenness:
        """How evenly the output turns (n,)."""

    @property
    def each(self) -> Evenness:
        """How evenly the shafts that joints drive turn (n, joints)."""

    @property
    def lengths(self) -> Array:
        """Lengths of the shafts between two joints (n, joints - 1)."""

    @property
    def swings(self) -> Array:
        """Largest accelerations over the square of the speed: output, drive, coast (n, 1 or 3)."""


def _inside(drive: Drive) -> tuple[OutputColumn, ...]:
    output = OutputColumn.of("output_acceleration_rad_s2", mark("largest angular acceleration of the output"))
    if len(drive.joints) == 1:
        return (output,)
    return (
        output,
        OutputColumn.of(
            "drive_acceleration_rad_s2",
            mark("largest angular acceleration of intermediate shafts, the input turning uniformly"),
        ),
        OutputColumn.of(
            "coast_acceleration_rad_s2",
            mark("largest angular acceleration of intermediate shafts, the output turning uniformly"),
        ),
    )


def _norms(found: Motions) -> Sequence[Array]:
    return [found.speed**2 * one for one in _each(found.swings)]


def _each(values: Array) -> list[Array]:
    return [values[..., k] for k in range(values.shape[-1])]


COLUMNS = (
    SweepQuestion(
        name="speed_fluctuation",
        doc=mark("speed fluctuation δ of the output: largest less smallest speed ratio"),
        told=(OutputColumn.of("speed_fluctuation_percent", mark("speed fluctuation of the output")),),
        of_many=lambda found: (found.output.speed_fluctuation,),
    ),
    SweepQuestion(
        name="alpha_eq",
        doc=mark("equivalent joint angle: that of the single Hooke joint with the speed fluctuation of the drive"),
        told=(OutputColumn.of("alpha_eq_deg", mark("equivalent angle")),),
        of_many=lambda found: (found.output.joint_angle,),
    ),
    SweepQuestion(
        name="ratio",
        doc=mark("smallest and largest speed ratio of the drive over a turn"),
        told=(
            OutputColumn(name="ratio_min", text=mark("smallest speed ratio")),
            OutputColumn(name="ratio_max", text=mark("largest speed ratio")),
        ),
        of_many=lambda found: (found.output.ratio_min, found.output.ratio_max),
    ),
    SweepQuestion(
        name="angle_error",
        doc=mark("how far the output leads the input at most, about its mean"),
        told=(OutputColumn.of("angle_error_deg", mark("largest lead of the output")),),
        of_many=lambda found: (found.output.max_angle_error,),
    ),
    SweepQuestion(
        name="acceleration",
        doc=mark("largest angular accelerations at the speed of the duty: of the output and of the shafts inside"),
        told=_inside,
        of_many=_norms,
        needs_speed=True,
    ),
    SweepQuestion(
        name="shaft_speed_fluctuation",
        doc=mark("speed fluctuation of every shaft that a joint drives"),
        told=lambda drive: tuple(
            OutputColumn.of(f"shaft_speed_fluctuation_percent[{k}]", mark("speed fluctuation of a shaft"))
            for k in range(1, len(drive.joints) + 1)
        ),
        of_many=lambda found: _each(found.each.speed_fluctuation),
    ),
    SweepQuestion(
        name="joint_angle",
        doc=mark("joint angle of every joint"),
        told=lambda drive: tuple(
            OutputColumn.of(f"joint_angle_deg[{i}]", mark("joint angle of a joint")) for i in range(len(drive.joints))
        ),
        of_many=lambda found: _each(found.joint_angle),
    ),
    SweepQuestion(
        name="greatest_joint_angle",
        doc=mark("largest joint angle"),
        told=(OutputColumn.of("greatest_joint_angle_deg", mark("greatest joint angle of a joint")),),
        of_many=lambda found: (namespace(found.joint_angle).max(found.joint_angle, axis=-1),),
    ),
    SweepQuestion(
        name="length",
        doc=mark("length of every shaft between two joints, of drives given by joint centres"),
        told=lambda drive: tuple(
            OutputColumn.of(f"length_mm[{k}]", mark("length of a shaft")) for k in range(1, len(drive.joints))
        ),
        of_many=lambda found: _each(found.lengths),
        needs_centres=True,
    ),
)
"""What a sweep may ask of motion."""
