"""Tables of ``cardan bending``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from cardan.texts import _

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.bending.bending import CriticalSpeeds, Part
    from cardan.questions.bending.speed_map import CriticalSpeedMap

    from .answer import Cell, Table

SHOWN = 13
"""Values of the map that stand in the terminal."""


def mode_table(found: CriticalSpeeds) -> Table:
    """Return the critical speeds with a few columns, for the eye."""
    from cardan.units import rpm

    from .answer import Column, Table

    rows: list[list[Cell]] = [
        [
            k + 1,
            _short(part),
            float(found.speed[k]) / rpm,
            float(found.wear[k]),
            float(found.actual[k]) / rpm,
            None if found.used is None else float(found.actual[k]) / found.used[1],
            0.5 * float(found.actual[k]) / rpm,
            float(found.at_rest[k]) / rpm,
        ]
        for k, part in enumerate(found.part)
    ]
    columns = (
        Column(key="mode", heading=_("mode")),
        Column(key="part", heading=_("what moves"), left=True),
        Column(key="critical_rpm", heading=_("computed"), unit="rpm"),
        Column(key="wear_factor", heading="k_n", form=".2f"),
        Column(key="actual_rpm", heading=_("real"), unit="rpm"),
        Column(key="ratio", heading=_("over the"), unit=_("highest"), form="3"),
        Column(key="half_rpm", heading=_("half of it"), unit=_("± 8 % rpm")),
        Column(key="at_rest_rpm", heading=_("at rest"), unit="1/min"),
    )
    return Table(columns=columns, rows=rows)


def _short(part: Part) -> str:
    if part.kind == "support":
        return _("support {number} bounces").format(number=part.number)
    if part.waves == 1:
        return _("shaft {number} bows").format(number=part.number)
    return _("shaft {number}, {n} half waves").format(number=part.number, n=part.waves)


def rows(found: CriticalSpeeds) -> Table:
    """Return the critical speeds with all columns, for a program."""
    from cardan.units import rpm

    from .answer import Column, Table

    shares = [f"shaft_{k + 1}_share" for k in range(found.shaft_share.shape[1])]
    shares += [f"support_{k + 1}_share" for k in range(found.support_share.shape[1])]
    keys = ["mode", "critical_rpm", "wear_factor", "actual_rpm", "at_rest_rpm", "half_band_low_rpm"]
    keys += ["half_band_high_rpm", "crossed", "half_crossed", "moves", "number", "half_waves", *shares]
    rows: list[list[Cell]] = [
        [
            k + 1,
            float(found.speed[k]) / rpm,
            float(found.wear[k]),
            float(found.actual[k]) / rpm,
            float(found.at_rest[k]) / rpm,
            *(float(speed) / rpm for speed in found.half_band[k]),
            bool(found.crossed[k]),
            bool(found.half_crossed[k]),
            part.kind,
            part.number,
            part.waves,
            *(float(share) for share in (*found.shaft_share[k], *found.support_share[k])),
        ]
        for k, part in enumerate(found.part)
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def shaft_table(drive: Drive, found: CriticalSpeeds) -> Table:
    """Return each shaft by itself as a plain tube, and in the line."""
    from math import isnan

    from cardan.units import mm, rpm

    from .answer import Column, Table, named

    rows: list[list[Cell]] = []
    for shaft, span, alone in zip(drive.shafts, found.shaft_span, found.alone, strict=True):
        if isnan(span[0]):
            continue
        own = [
            float(found.actual[k]) / rpm
            for k, part in enumerate(found.part)
            if part.kind == "shaft" and part.number == shaft.number
        ]
        rows.append(
            [
                named(shaft.number, shaft.name),
                float(span[1] - span[0]) / mm,
                None if isnan(alone) else float(alone) / rpm,
                own[0] if own else None,
            ]
        )
    columns = (
        Column(key="shaft", heading=_("shaft"), left=True),
        Column(key="length_mm", heading=_("length"), unit="mm"),
        Column(key="closed_form_rpm", heading=_("as a plain tube"), unit=_("rpm, Book (257)")),
        Column(key="actual_rpm", heading=_("in the line"), unit=_("real rpm")),
    )
    return Table(columns=columns, rows=rows)


def map_table(drive: Drive, varied: CriticalSpeedMap, *, short: bool = False) -> Table:
    """Return the critical speeds over what varies; for the eye a few of its values, with a title."""
    from cardan.units import rpm

    from .answer import Column, Table

    stiff = varied.over == "stiffness"
    count = len(varied.value)
    step = max(1, (count - 1) // (SHOWN - 1)) if short else 1
    rows: list[list[Cell]] = [
        [1e-3 * float(value) if stiff else 1e3 * float(value), *(float(speed) / rpm for speed in speeds)]
        for value, speeds in list(zip(varied.value, varied.speed, strict=True))[::step]
    ]
    first = (
        Column(key="stiffness_N_per_mm", heading=_("stiffness"), unit="N/mm")
        if stiff
        else Column(key="length_mm", heading=_("length"), unit="mm")
    )
    modes = [
        Column(key=f"critical_{k + 1}_rpm", heading=_("mode {number}").format(number=k + 1), unit="rpm")
        for k in range(varied.speed.shape[1])
    ]
    text = _("Critical speeds over the stiffness of support {which}") if stiff else ""
    text = text or _("Critical speeds over the length of shaft {which}")
    return Table(columns=(first, *modes), rows=rows, title=text.format(which=_name(drive, varied)) if short else "")


def _name(drive: Drive, varied: CriticalSpeedMap) -> str:
    from .asked import called

    things = drive.supports if varied.over == "stiffness" else drive.shafts
    return called(varied.number, things[varied.number - 1].name)
