"""``cardan losses``: how much of the power turns to heat, and where?"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural

from .asked import TorqueNm
from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.losses.loss_parts import Uncounted
    from cardan.questions.losses.losses import Losses, LossMap

    from .answer import Answer, Cell, Remark, Table

SHOWN = (0, 3, 6, 9, 14)
"""Speeds and torques of the map that stand in the terminal: a tenth to one and a half of the duty."""


LONG = 26
"""Letters of the name of a part, so that the table of a small instrument stays within the terminal too."""


def losses(
    file: DriveFile,
    torque: TorqueNm = None,
    speed_rpm: SpeedRpm = None,
    over: Annotated[
        bool,
        typer.Option(
            "--map", help=_("Efficiency and heat over speed and torque, around those of the duty."), show_default=False
        ),
    ] = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what the drive turns to heat, part by part."""
    from .asked import check_torque, keys_of, on_duty
    from .output import check_speed
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    check_speed(speed_rpm)
    check_torque(torque)

    from cardan.errors import refuse
    from cardan.questions.losses.losses import loss_map
    from cardan.questions.losses.losses import losses as question

    from .source import read

    drive = on_duty(read(file), speed_rpm, torque)
    if over and drive.duty.torque == 0.0:
        raise refuse("--map", _("spans a tenth to one and a half of the torque, and that is 0; say --torque-Nm"))
    with keys_of(file):
        found = question(drive)
        table = loss_map(drive) if over and not found.locked else None
    return show(_answer(drive, file, found, table), json=json, csv=csv, plot=plot)


def _answer(drive: Drive, file: Path, found: Losses, over: LossMap | None) -> Answer:
    from .answer import Answer

    def drawn() -> Any:
        from cardan.questions.losses.figure import losses_figures, map_figures

        return (*losses_figures(found, drive), *(() if over is None else map_figures(over)))

    return Answer(
        sentence=_sentence(drive, file, found),
        tone="failed" if found.locked else "plain",
        tables=lambda: _tables(drive, found, over),
        remarks=tuple(_remarks(drive, file, found, over)),
        content=lambda: _content(drive, file, found, over),
        csv=lambda: _trace(found) if over is None else _map_rows(over),
        figure=drawn,
        code=1 if found.locked else 0,
    )


def _sentence(drive: Drive, file: Path, found: Losses) -> str:
    from math import isnan

    from cardan.figures.wording import together
    from cardan.maths.ties import largest
    from cardan.units import rpm

    from .answer import percent, significant
    from .source import title

    name = title(drive, file)
    at = {"torque": significant(found.torque), "speed": significant(found.speed / rpm)}
    if found.locked:
        text = plural(
            "{name}: friction locks joint {which}.", "{name}: friction locks joints {which}.", len(found.locked)
        )
        return text.format(name=name, which=", ".join(str(k) for k in found.locked))
    if isnan(found.efficiency) or found.efficiency <= 0.0:
        text = _("{name}: at {torque} N·m and {speed} rpm no power comes through; {heat} W turn to heat.")
        return text.format(name=name, heat=significant(found.heat), **at)
    parts = _parts(drive, found)
    places = largest([one for _name, one in parts])
    heat = parts[places[0]][1]
    text = _("{name}: {share} of the power comes through at {torque} N·m and {speed} rpm; {heat} W turn to heat")
    text = text.format(name=name, share=percent(found.efficiency), heat=significant(found.heat), **at)
    if heat <= 0.0:
        return text + "."
    more = _(", most in {part}: {most} W.") if len(places) == 1 else _(", most in {part}: {most} W each.")
    return text + more.format(part=together(parts[k][0] for k in places), most=significant(heat))


def _parts(drive: Drive, found: Losses) -> list[tuple[str, float]]:
    """Return every part that rubs with its heat [W]."""
    from .asked import called

    parts = [
        (_("joint {number}").format(number=called(i, joint.name)), float(found.joints[i - 1]))
        for i, joint in enumerate(drive.joints, 1)
    ]
    parts += [
        (_("support {number}").format(number=called(k, support.name)), float(found.supports[k - 1]))
        for k, support in enumerate(drive.supports, 1)
    ]
    parts += [
        (_("spline of shaft {number}").format(number=called(shaft.number, shaft.name)), float(heat))
        for shaft, heat in zip(drive.shafts, found.splines, strict=True)
        if shaft.spline is not None
    ]
    return parts


def _tables(drive: Drive, found: Losses, over: LossMap | None) -> list[Table]:
    if over is not None:
        return list(_map_tables(over))
    return [] if found.locked else [_part_table(drive, found)]


def _part_table(drive: Drive, found: Losses) -> Table:
    from .answer import Column, Table

    whole = found.heat or 1.0
    sides: list[tuple[float | None, float | None]] = [
        (float(one), float(other)) for one, other in zip(found.driving_pins, found.driven_pins, strict=True)
    ]
    parts = _parts(drive, found)
    sides += [(None, None)] * (len(parts) - len(sides))
    lacking = _lacking(drive, found)
    rows: list[list[Cell]] = []
    for (name, heat), side in zip(parts, sides, strict=True):
        if name in lacking:
            rows.append([_short(name), None, None, None, None])
        else:
            rows.append([_short(name), heat, 100.0 * heat / whole, *side])
    rows.append([_("all"), found.heat, 100.0 if found.heat else None, None, None])
    columns = (
        Column(key="part", heading=_("part"), left=True),
        Column(key="heat_W", heading=_("heat"), unit="W"),
        Column(key="share_percent", heading=_("share"), unit="%", form=".1f"),
        Column(key="driving_journals_W", heading=_("journals of"), unit=_("driving yoke W")),
        Column(key="driven_journals_W", unit=_("driven yoke W")),
    )
    return Table(columns=columns, rows=rows)


def _short(name: str) -> str:
    return name if len(name) <= LONG else name[: LONG - 1] + "…"


def _lacking(drive: Drive, found: Losses) -> set[str]:
    """Return the names of the parts whose heat could not be counted."""
    names = [name for name, _heat in _parts(drive, found)]
    joints, supports = len(drive.joints), len(drive.supports)
    splines = [shaft.number - 1 for shaft in drive.shafts if shaft.spline is not None]
    lacking = set()
    for one in found.uncounted:
        kind, number = _place(one.field)
        if kind == "joints" and number is not None:
            lacking.add(names[number])
        elif kind == "supports":
            lacking.update(names[joints : joints + supports] if number is None else [names[joints + number]])
        elif kind == "shafts" and number in splines:
            lacking.add(names[joints + supports + splines.index(number)])
        elif kind == "movements":
            lacking.update(names[joints + supports :])
    return lacking


def _place(field: str) -> tuple[str, int | None]:
    """Return what a path begins with.

    Examples
    --------
    >>> _place("supports[2].friction"), _place("movements")
    (('supports', 2), ('movements', None))
    """
    match = re.match(r"(\w+)(?:\[(\d+)\])?", field)
    assert match is not None
    return match[1], None if match[2] is None else int(match[2])


def _map_tables(over: LossMap) -> Iterator[Table]:
    from cardan.units import rpm

    from .answer import Column, Table

    for title, values, form in (
        (_("Efficiency, %, over speed and torque"), 100.0 * over.efficiency, ".3f"),
        (_("Heat, W, over speed and torque"), over.heat, "4"),
    ):
        heads = [
            Column(key=str(t), heading=f"{over.torque[t]:.4g}", unit=_("N·m"), form=form)
            for t in SHOWN
            if t < over.torque.size
        ]
        rows = [
            [float(over.speed[s]) / rpm, *(float(values[s, t]) for t in SHOWN if t < over.torque.size)]
            for s in SHOWN
            if s < over.speed.size
        ]
        yield Table(columns=(Column(key="speed", heading=_("rpm"), form=".5g"), *heads), rows=rows, title=title)


def _remarks(drive: Drive, file: Path, found: Losses, over: LossMap | None) -> Iterator[Remark]:
    from cardan.figures.wording import closely

    from .answer import Remark, percent, significant

    if found.locked:
        text = _(
            "Failed: friction in the journals reaches what turns them; less friction, thinner journals, less bend."
        )
        yield Remark(text=text, tone="failed")
        return
    yield from _uncounted(found.uncounted)
    text = _("By the usual formulas, journals alone: {first} to first order, {small} for small bends.")
    yield Remark(text=text.format(first=percent(found.first_order), small=percent(found.small_angle)))
    taken = float(found.resisting.sum())
    if taken:
        text = _("Resisting torques of the shafts take {power} W more.")
        yield Remark(text=text.format(power=significant(taken)))
    text = _("Power balance checked: it closes {closely}.")
    yield Remark(text=text.format(closely=closely(found.residual)))
    if over is None:
        yield Remark(
            text=_("The same over speed and torque:"), command=("cardan", "losses", str(file), "--map"), tone="next"
        )


def _uncounted(parts: Sequence[Uncounted]) -> Iterator[Remark]:
    """Yield what was left out, keys that differ only by their number together."""
    from .answer import Remark
    from .asked import key_of, listed

    groups: dict[str, list[int]] = {}
    for one in parts:
        if one.message.startswith(_("missing")):
            kind, number = _place(one.field)
            rest = one.field.partition("]")[2]
            groups.setdefault(f"{kind}\0{rest}", []).extend([] if number is None else [number])
        else:
            text = _("Warning: not counted: {field}: {message}")
            yield Remark(text=text.format(field=one.field, message=one.message), tone="warning")
    keys = []
    for group, numbers in groups.items():
        kind, rest = group.split("\0")
        if kind == "movements":
            text = _(
                "Warning: heat of splines is not counted: they slide while the drive moves, and [[movements]] tell how."
            )
            yield Remark(text=text, tone="warning")
            continue
        if not numbers:
            keys.append(f"[[{kind}]]")
            continue
        key = key_of(f"x{rest}")[1:].lstrip(".")
        singular = {"joints": _("joint"), "supports": _("support"), "shafts": _("shaft")}[kind]
        several = {"joints": _("joints"), "supports": _("supports"), "shafts": _("shafts")}[kind]
        word = singular if len(numbers) == 1 else several
        keys.append(_("{key} of {which}").format(key=key, which=f"{word} {listed(numbers)}"))
    if keys:
        text = _("Warning: some heat is not counted; the file lacks {keys}.")
        yield Remark(text=text.format(keys=", ".join(keys)), tone="warning")


def _trace(found: Losses) -> Table:
    """Return torques and heat of the joints over the turn."""
    import numpy as np

    from .answer import Column, Table

    named: list[tuple[str, Any]] = [
        ("angle_deg", np.rad2deg(found.angle)),
        ("input_torque_Nm", found.input_torque),
        ("output_torque_Nm", found.output_torque),
    ]
    named += [(f"joint_{i}_heat_W", heat) for i, heat in enumerate(found.joint_power, 1)]
    table = np.stack([values for _key, values in named], axis=-1)
    return Table(columns=tuple(Column(key=key) for key, _values in named), rows=table.tolist())


def _map_rows(over: LossMap) -> Table:
    """Return the map, one speed and torque a row."""
    from cardan.units import rpm

    from .answer import Column, Table

    joints = over.joints.shape[-1]
    keys = ["speed_rpm", "torque_Nm", "efficiency", "heat_W", "input_power_W", "output_power_W"]
    keys += [f"joint_{i}_heat_W" for i in range(1, joints + 1)]
    rows = [
        [
            float(speed) / rpm,
            float(torque),
            float(over.efficiency[s, t]),
            float(over.heat[s, t]),
            float(over.input_power[s, t]),
            float(over.output_power[s, t]),
            *(float(heat) for heat in over.joints[s, t]),
        ]
        for s, speed in enumerate(over.speed)
        for t, torque in enumerate(over.torque)
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _content(drive: Drive, file: Path, found: Losses, over: LossMap | None) -> dict[str, Any]:
    from cardan.units import rpm

    from .asked import columns_of, key_of

    content = {
        "question": "losses",
        "drive": drive.name,
        "file": str(file),
        "speed_rpm": found.speed / rpm,
        "torque_Nm": found.torque,
        "torque_at": found.torque_at,
        "efficiency": found.efficiency,
        "efficiency_first_order": found.first_order,
        "efficiency_small_bends": found.small_angle,
        "input_power_W": found.input_power,
        "output_power_W": found.output_power,
        "heat_W": found.heat,
        "joints": [
            {
                "number": i + 1,
                "name": joint.name,
                "heat_W": found.joints[i],
                "driving_journals_W": found.driving_pins[i],
                "driven_journals_W": found.driven_pins[i],
            }
            for i, joint in enumerate(drive.joints)
        ],
        "supports": [
            {"number": k + 1, "name": one.name, "heat_W": found.supports[k]} for k, one in enumerate(drive.supports)
        ],
        "shafts": [
            {
                "number": shaft.number,
                "name": shaft.name,
                "spline_heat_W": found.splines[shaft.number - 1],
                "resisting_W": found.resisting[shaft.number - 1],
                "storing_W": found.storing[shaft.number - 1],
            }
            for shaft in drive.shafts
        ],
        "locked_joints": found.locked,
        "not_counted": [{"field": key_of(one.field), "message": one.message} for one in found.uncounted],
        "residual": found.residual,
        "assumed": found.assumed,
        "losses": columns_of(_trace(found)),
    }
    return content if over is None else {**content, "map": columns_of(_map_rows(over))}
