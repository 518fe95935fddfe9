"""``cardan torsion modes``: at which speeds does something excite the torsional modes of the drive?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _, plural

from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm
from .torsion_parts import Pieces

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.torsion.model.torsion import TorsionModes

    from .answer import Answer, Cell, Remark, Table, Tone

SHOWN = 4
"""Modes in the terminal; JSON and CSV hold all."""

CROSSINGS = 12
"""Crossings in the terminal."""

FAR = 3.0
"""Crossings at speeds so many times above those in use are left out in the terminal."""

NEAR = 0.1
"""Speeds nearer than this share are too near."""


def torsion_modes(
    file: DriveFile,
    speed_rpm: SpeedRpm = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell the natural frequencies and the speeds at which something excites them."""
    from .asked import keys_of, on_duty
    from .output import check_speed
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    check_speed(speed_rpm)

    from cardan.questions.torsion.model.torsion import torsion_modes as question

    from .source import read

    drive = on_duty(read(file), speed_rpm, None)
    with keys_of(file):
        found = question(drive, pieces=pieces)
    return show(_answer(drive, file, found), json=json, csv=csv, plot=plot)


def _answer(drive: Drive, file: Path, found: TorsionModes) -> Answer:
    from .answer import Answer
    from .asked import figures

    tone, sentence = _sentence(drive, file, found)
    return Answer(
        sentence=sentence,
        tone=tone,
        tables=lambda: _tables(drive, found),
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: figures(found),
    )


def _sentence(drive: Drive, file: Path, found: TorsionModes) -> tuple[Tone, str]:
    from cardan.units import rpm

    from .answer import significant
    from .source import title

    name = title(drive, file)
    first = {
        "hz": significant(float(found.omega[0]) / 6.283185307179586, 3),
        "second": significant(float(found.order2_speed[0]) / rpm, 3),
        "principal": significant(float(found.parametric_speed[0]) / rpm, 3),
    }
    text = _("{name}: the slowest torsional mode swings at {hz} Hz; joints excite it at {second} rpm by order 2 and at")
    text = (text + " " + _("{principal} rpm by parametric resonance")).format(name=name, **first)
    used = _used(drive)
    if used is None:
        return "plain", text + "."
    growing = [k for k in range(len(found.omega)) if _overlaps(found.zone[k], used)]
    if growing:
        said = _("; mode {mode} grows from {low} to {high} rpm, speeds in use.")
        zone = [significant(float(one) / rpm, 4) for one in found.zone[growing[0]]]
        return "failed", text + said.format(mode=growing[0] + 1, low=zone[0], high=zone[1])
    low, high = used
    reach = low * (1 - NEAR), high * (1 + NEAR)
    near = [k for k in range(len(found.omega)) if _overlaps(found.zone[k], reach)]
    if near:
        said = _("; mode {mode} grows from {low} to {high} rpm, near to the speeds in use.")
        zone = [significant(float(one) / rpm, 4) for one in found.zone[near[0]]]
        return "warning", text + said.format(mode=near[0] + 1, low=zone[0], high=zone[1])
    meets = [one for one in found.crossings if reach[0] <= one.speed <= reach[1]]
    if meets:
        count = plural(
            "{count} order meets a mode at speeds in use", "{count} orders meet a mode at speeds in use", len(meets)
        )
        return "warning", text + "; " + count.format(count=len(meets)) + "."
    return "good", text + _("; at the speeds in use no order meets a mode.")


def _used(drive: Drive) -> tuple[float, float] | None:
    """Return lowest and highest speed in use [rad/s]."""
    if drive.duty.speed_range is not None:
        return drive.duty.speed_range
    return None if drive.duty.speed is None else (abs(drive.duty.speed), abs(drive.duty.speed))


def _overlaps(zone: Any, used: tuple[float, float]) -> bool:
    return bool(zone[0] <= used[1] and used[0] <= zone[1])


def _tables(drive: Drive, found: TorsionModes) -> list[Table]:
    shown = [_mode_table(found), _joint_table(drive, found), _shape_table(found)]
    return [*shown, _crossing_table(found)] if found.crossings else shown


def _mode_table(found: TorsionModes) -> Table:
    from cardan.units import rpm

    from .answer import Column, Table

    rows: list[list[Cell]] = []
    for k, omega in enumerate(found.omega[:SHOWN]):
        zone = [None if one != one else float(one) / rpm for one in found.zone[k]]
        rows.append(
            [
                k + 1,
                float(omega) / 6.283185307179586,
                float(found.order2_speed[k]) / rpm,
                float(found.parametric_speed[k]) / rpm,
                100.0 * float(found.modulation[k]),
                200.0 * float(found.damping_ratio[k]),
                *zone,
            ]
        )
    columns = (
        Column(key="mode", heading=_("mode")),
        Column(key="frequency_Hz", heading=_("swings"), unit="Hz"),
        Column(key="order_2_rpm", heading=_("order 2"), unit="rpm"),
        Column(key="principal_rpm", heading=_("parametric"), unit="rpm"),
        Column(key="modulation_percent", heading=_("pulled"), unit="%", form="3"),
        Column(key="needed_percent", heading=_("damped"), unit="%", form="3"),
        Column(key="zone_low_rpm", heading=_("grows"), unit=_("from rpm")),
        Column(key="zone_high_rpm", unit=_("to rpm")),
    )
    return Table(columns=columns, rows=rows)


def _mode_columns(found: TorsionModes, form: str) -> list[Any]:
    from .answer import Column

    count = min(SHOWN, len(found.omega))
    return [
        Column(key=f"mode_{k}", heading=_("mode {number}").format(number=k), form=form) for k in range(1, count + 1)
    ]


def _joint_table(drive: Drive, found: TorsionModes) -> Table:
    from .answer import Column, Table, named

    rows: list[list[Cell]] = [
        [named(i + 1, joint.name), *(float(one) for one in found.joint_weight[:SHOWN, i])]
        for i, joint in enumerate(drive.joints)
    ]
    title = _("How far each joint is from the node of a mode, κ: 0 excites nothing")
    return Table(
        columns=(Column(key="joint", heading=_("joint"), left=True), *_mode_columns(found, ".3f")),
        rows=rows,
        title=title,
    )


def _shape_table(found: TorsionModes) -> Table:
    from .answer import Column, Table
    from .torsion_parts import short

    known = found.train.to_scale
    rows: list[list[Cell]] = [
        [
            short(name, 30),
            *([1e3 * float(found.train.position[k])] if known else []),
            *(float(one) for one in found.shape[:SHOWN, k]),
        ]
        for k, name in enumerate(found.train.model.names)
    ]
    columns = (
        Column(key="station", heading=_("station"), left=True),
        *([Column(key="position_mm", heading=_("at"), unit="mm", form=".0f")] if known else []),
        *_mode_columns(found, ".3f"),
    )
    return Table(columns=columns, rows=rows, title=_("How the stations swing, the largest by 1"))


def _crossing_table(found: TorsionModes) -> Table:
    from cardan.units import rpm

    from .answer import Column, Table

    used = found.speed_range[1] if found.speed_range is not None else found.speed
    near = [one for one in found.crossings if not used or one.speed < FAR * used]
    rows: list[list[Cell]] = [
        [one.speed / rpm, one.order, one.mode, one.inside, one.cause] for one in (near or found.crossings)[:CROSSINGS]
    ]
    columns = (
        Column(key="speed_rpm", heading=_("speed"), unit="rpm"),
        Column(key="order", heading=_("order"), form="g"),
        Column(key="mode", heading=_("mode")),
        Column(key="in_use", heading=_("in use")),
        Column(key="cause", heading=_("what swings so"), left=True, wrap=True),
    )
    return Table(columns=columns, rows=rows, title=_("Speeds at which an order meets a mode"))


def _remarks(drive: Drive, file: Path, found: TorsionModes) -> Iterator[Remark]:
    import numpy as np

    from cardan.maths.ties import foremost_on

    from .answer import Remark, significant
    from .torsion_parts import assumptions

    for k, nodes in enumerate(found.nodes[:1], start=1):
        for node in nodes:
            names = found.train.model.names
            text = _("Mode {mode} stands still at {place} mm from the input end, between {one} and {two}.")
            if not found.train.to_scale:
                text = _("Mode {mode} stands still {share} % of the way from {one} to {two}.")
            at = node.before if node.share < 0.005 else node.behind if node.share > 0.995 else None
            if at is not None:
                text = _("Mode {mode} stands still at {place} mm from the input end, at {one}.")
                if not found.train.to_scale:
                    text = _("Mode {mode} stands still at {one}.")
            one, two = names[node.before if at is None else at], names[node.behind]
            where = {"place": significant(1e3 * node.position, 3), "share": significant(100.0 * node.share, 2)}
            yield Remark(text=text.format(mode=k, one=one, two=two, **where))
    if found.joint_weight.shape[-1]:
        nearest = int(foremost_on(np.abs(found.joint_weight[0]), least=True)) + 1
        text = _(
            "A joint in the node of a mode excites no parametric vibration of it: joint {number} is nearest to that of "
            "mode 1. A mode grows where joints pull more than damping takes: pulled above damped."
        )
        yield Remark(text=text.format(number=nearest))
    if not found.train.model.free:
        text = _('The input turns evenly, so it stands still in every mode; input = "free" lets it swing.')
        yield Remark(text=text)
    yield from assumptions(found.train)
    yield Remark(
        text=_("How strongly it swings at a speed:"), command=("cardan", "torsion", "response", str(file)), tone="next"
    )


def _rows(found: TorsionModes) -> Table:
    """Return the modes, one a row, with their shapes."""
    from cardan.units import rpm

    from .answer import Column, Table

    joints, stations = found.joint_weight.shape[-1], found.shape.shape[-1]
    keys = ["mode", "frequency_Hz", "order_2_rpm", "principal_rpm", "modulation", "damping_ratio", "zone_low_rpm"]
    keys += ["zone_high_rpm", *(f"joint_{i}_weight" for i in range(1, joints + 1))]
    keys += [f"station_{k}" for k in range(1, stations + 1)]
    rows: list[list[Cell]] = [
        [
            k + 1,
            float(omega) / 6.283185307179586,
            float(omega) / 2.0 / rpm,
            float(omega) / rpm,
            float(found.modulation[k]),
            float(found.damping_ratio[k]),
            *(float(one) / rpm for one in found.zone[k]),
            *(float(one) for one in found.joint_weight[k]),
            *(float(one) for one in found.shape[k]),
        ]
        for k, omega in enumerate(found.omega)
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _content(drive: Drive, file: Path, found: TorsionModes) -> dict[str, Any]:
    from cardan.units import rpm

    model = found.train.model
    return {
        "question": "torsion modes",
        "drive": drive.name,
        "file": str(file),
        "input": "free" if model.free else "uniform",
        "stations": [
            {
                "name": name,
                "shaft": model.shaft[k] + 1,
                "position_mm": 1e3 * found.train.position[k],
                "inertia_kg_m2": model.inertia[k],
            }
            for k, name in enumerate(model.names)
        ],
        "elements": [
            {
                "from": model.names[a],
                "to": model.names[b],
                "stiffness_Nm_per_rad": model.stiffness[e],
                "damping_Nms_per_rad": model.damping[e],
                "loss_factor": model.loss_factor[e],
                "backlash_deg": 57.29577951308232 * model.backlash[e],
            }
            for e, (a, b) in enumerate(model.elements)
        ],
        "modes": [
            {
                "number": k + 1,
                "frequency_Hz": omega / 6.283185307179586,
                "order_2_rpm": found.order2_speed[k] / rpm,
                "principal_rpm": found.parametric_speed[k] / rpm,
                "shape": found.shape[k],
                "joint_weight": found.joint_weight[k],
                "modulation": found.modulation[k],
                "damping_ratio": found.damping_ratio[k],
                "zone_rpm": found.zone[k] / rpm,
                "nodes_mm": [1e3 * node.position for node in found.nodes[k]],
            }
            for k, omega in enumerate(found.omega)
        ],
        "crossings": [
            {
                "speed_rpm": one.speed / rpm,
                "order": one.order,
                "mode": one.mode,
                "cause": one.cause,
                "in_use": one.inside,
            }
            for one in found.crossings
        ],
        "residual": found.residual,
        "assumed": found.train.assumed,
    }
