"""What the sizes, materials and figures must satisfy that strength and upkeep go by."""

from __future__ import annotations

import math
from collections.abc import Iterator

from cardan.drive.body import FITS
from cardan.drive.cross import Cross
from cardan.drive.described import Described
from cardan.drive.duty import Vehicle
from cardan.drive.joint_parts import Needles
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft, Spline
from cardan.errors import Problem
from cardan.texts import _
from cardan.units import mm

ROUNDING = 1e-9
"""Sizes that differ by this share are the same."""


ROOM = 0.02
"""More needles than fit by this share are a matter of rounded diameters."""


def size_problems(drive: Described) -> Iterator[Problem]:
    """Yield sizes that do not go together, and keys that nothing can use beside the others."""
    for i, joint in enumerate(drive.joints):
        if joint.cross is not None:
            yield from _cross(joint.cross, f"joints[{i}].cross")
            yield from _needles(joint.cross, joint.needles, f"joints[{i}].needles")
        if joint.yoke is not None:
            yield from _material(joint.yoke.material, f"joints[{i}].yoke.material")
    for shaft in drive.shafts:
        path = f"shafts[{shaft.number - 1}]"
        yield from _material(shaft.material, f"{path}.material")
        for k, segment in enumerate(shaft.segments):
            yield from _material(segment.material, f"{path}.segments[{k}].material")
        yield from _layup(shaft, path)
        if shaft.spline is not None:
            yield from _spline(shaft.spline, f"{path}.spline")
        if not shaft.has_body:
            for name, there in (("notch", shaft.notch is not None), ("finish", shaft.finish != "machined")):
                if there:
                    yield Problem(f"{path}.{name}", _("belongs to a body, and its outer diameter is not given"))
    if drive.duty.vehicle is not None:
        yield from _vehicle(drive.duty.vehicle, "duty.vehicle")


def _cross(cross: Cross, path: str) -> Iterator[Problem]:
    if cross.journal is not None and cross.journal_bore >= cross.journal:
        text = _("{bore:.6g} mm is not less than the diameter of the journal, {journal:.6g} mm")
        yield Problem(f"{path}.journal_bore", text.format(bore=cross.journal_bore / mm, journal=cross.journal / mm))
    yield from _material(cross.material, f"{path}.material")


def _needles(cross: Cross, needles: Needles | None, path: str) -> Iterator[Problem]:
    """Yield a row of needles that has no room around its journal: z asin(d/(D + d)) ≤ π."""
    if needles is None or needles.count is None or needles.diameter is None or cross.journal is None:
        return
    most = math.pi / math.asin(needles.diameter / (cross.journal + needles.diameter))
    if needles.count > most * (1.0 + ROOM):
        text = _("{count} needles of {diameter:.6g} mm have no room around a journal of {journal:.6g} mm; {most} have")
        said = text.format(
            count=needles.count, diameter=needles.diameter / mm, journal=cross.journal / mm, most=math.floor(most)
        )
        yield Problem(f"{path}.count", said, "inconsistent")


def _material(material: Material | None, path: str) -> Iterator[Problem]:
    if material is None or material.yield_strength is None or material.ultimate_strength is None:
        return
    if material.ultimate_strength < material.yield_strength:
        yield Problem(f"{path}.ultimate_strength", _("is below the yield strength"), "inconsistent")


def _layup(shaft: Shaft, path: str) -> Iterator[Problem]:
    layup = shaft.layup
    if layup is None:
        return
    if shaft.outer is None:
        yield Problem(f"{path}.layup", _("belongs to a tube, and its outer diameter is not given"))
    elif 2.0 * len(layup.angles) * layup.ply_thickness > shaft.outer * (1.0 - FITS):
        yield Problem(f"{path}.layup.ply_thickness", _("the plies are thicker than half the outer diameter"))
    if not layup.angles:
        yield Problem(f"{path}.layup.angles", _("holds no ply"), "empty")
    for name in ("material", "wall", "inner"):
        if getattr(shaft, name) is not None:
            yield Problem(f"{path}.{name}", _("layup gives the same already"))


def _spline(spline: Spline, path: str) -> Iterator[Problem]:
    if spline.outer is None or spline.root is None:
        return
    if spline.root >= spline.outer:
        yield Problem(f"{path}.root", _("is not less than the outer diameter of the teeth"))
    elif spline.outer - spline.root <= 4.0 * spline.chamfer * (1.0 + ROUNDING):
        yield Problem(f"{path}.chamfer", _("leaves no flank of the teeth to bear"), "out_of_range")


def _vehicle(vehicle: Vehicle, path: str) -> Iterator[Problem]:
    if vehicle.engine_torque is not None:
        for name in ("engine_power", "engine_speed"):
            if getattr(vehicle, name) is not None:
                yield Problem(f"{path}.{name}", _("engine_torque gives the torque already"))
