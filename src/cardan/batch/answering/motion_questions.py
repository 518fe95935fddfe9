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
    return (namespace(found.bend).max(found.bend, axis=-1),)


MOTION = (
    Question(
        name="irregularity",
        doc=mark("irregularity δ of the output: largest less smallest speed ratio"),
        told=lambda _drive: _single(Told(name="irregularity", text=mark("irregularity of the output"))),
        of_many=lambda found: (found.output.irregularity,),
    ),
    Question(
        name="alpha_eq",
        doc=mark("equivalent angle: bend of the single Hooke joint that is as uneven as the drive"),
        told=lambda _drive: _single(
            Told(name="alpha_eq_deg", dimension="angle", unit="deg", text=mark("equivalent angle"))
        ),
        of_many=lambda found: (found.output.bend,),
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
        name="lead",
        doc=mark("how far the output leads the input at most, about its mean"),
        told=lambda _drive: _single(
            Told(name="lead_deg", dimension="angle", unit="deg", text=mark("largest lead of the output"))
        ),
        of_many=lambda found: (found.output.max_lead,),
    ),
    Question(
        name="acceleration",
        doc=mark("largest angular accelerations at the speed of the duty: of the output and of the shafts inside"),
        told=_inside,
        of_many=_norms,
        needs_speed=True,
    ),
    Question(
        name="shaft_irregularity",
        doc=mark("irregularity of every shaft that a joint drives"),
        told=lambda drive: tuple(
            Told(name=f"shaft_irregularity[{k}]", text=mark("irregularity of a shaft")) for k in _shafts(drive)
        ),
        of_many=lambda found: _each(found.each.irregularity),
    ),
    Question(
        name="bend",
        doc=mark("bend of every joint"),
        told=lambda drive: tuple(
            Told(name=f"bend_deg[{i}]", dimension="angle", unit="deg", text=mark("bend of a joint"))
            for i in range(len(drive.joints))
        ),
        of_many=lambda found: _each(found.bend),
    ),
    Question(
        name="greatest_bend",
        doc=mark("bend of the joint that bends most"),
        told=lambda _drive: _single(
            Told(name="greatest_bend_deg", dimension="angle", unit="deg", text=mark("greatest bend of a joint"))
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
