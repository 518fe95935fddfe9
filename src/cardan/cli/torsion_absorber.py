"""``cardan torsion absorber``: which absorber calms the drive, on which station, and how is it to be set?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from cardan.texts import _

from .asked import TorqueNm
from .options import AsCsv, AsJson, DriveFile, Force, Plot, SpeedRpm
from .torsion_band import Element, Out, SpeedBand

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.torsion.absorber.absorber import Absorber

    from .answer import Answer, Cell, Remark, Table, Tone

HOSTS = 12
"""Stations in the terminal."""

WIDE_SWING = 30.0
"""Swing of a pendulum [°] from which its order falls by more than two percent."""

LITTLE = 0.9
"""An absorber that leaves more than this share of the swing is not worth its place."""


def torsion_absorber(
    file: DriveFile,
    kind: Annotated[
        str,
        typer.Option(
            "--kind", metavar="KIND", help=_("One of h_infinity, den_hartog, viscous, tuned (one speed), pendulum.")
        ),
    ] = "h_infinity",
    ratio: Annotated[
        float | None,
        typer.Option(
            "--ratio",
            metavar="SHARE",
            help=_("Inertia over that of the mode at the station; 0.1 where none is given."),
            show_default=False,
        ),
    ] = None,
    inertia: Annotated[
        float | None,
        typer.Option("--inertia-kg-m2", metavar="INERTIA", help=_("The inertia itself, instead."), show_default=False),
    ] = None,
    at: Annotated[
        str | None,
        typer.Option(
            "--at",
            metavar="STATION",
            help=_("Name or number of the station; where the mode moves most by default."),
            show_default=False,
        ),
    ] = None,
    mode: Annotated[
        int | None,
        typer.Option("--mode", metavar="N", help=_("Mode to suppress; the strongest by default."), show_default=False),
    ] = None,
    order: Annotated[
        float | None,
        typer.Option("--order", metavar="ORDER", help=_("Order that excites it."), show_default=False),
    ] = None,
    radius: Annotated[
        float | None,
        typer.Option(
            "--radius-mm", metavar="MM", help=_("Pendulums: distance of the pivots from the axis."), show_default=False
        ),
    ] = None,
    count: Annotated[int, typer.Option("--count", metavar="N", help=_("Pendulums: how many."))] = 1,
    speeds: SpeedBand = None,
    element: Element = None,
    speed_rpm: SpeedRpm = None,
    torque: TorqueNm = None,
    out: Out = None,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how an absorber, damper or pendulum is to be set on the drive, and what it does."""
    from .asked import check_options, on_duty
    from .show import show
    from .torsion_band import asked_of, band_of, check_out, elements_of, repeated
    from .torsion_parts import ended, keeping

    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    check_out(out, file, force=force)
    band = band_of(speeds)

    from cardan.questions.torsion.absorber.absorber import absorber as question
    from cardan.units import mm

    from .source import read_with_text

    drive, text = read_with_text(file)
    drive = on_duty(drive, speed_rpm, torque)
    with asked_of(file, OPTIONS), keeping(_("setting the absorber")) as progress:
        found = question(
            drive,
            kind=kind,
            inertia=inertia,
            inertia_ratio=ratio,
            radius=None if radius is None else radius * mm,
            count=count,
            station=at,
            mode=mode,
            order=order,
            speeds=band,
            elements=elements_of(element),
            progress=progress,
        )
    given = {"--kind": kind, "--ratio": ratio, "--inertia-kg-m2": inertia, "--at": at, "--mode": mode, "--order": order}
    given |= {"--radius-mm": radius, "--count": None if count == 1 else count, "--speeds": speeds}
    given |= {"--speed-rpm": speed_rpm, "--torque-Nm": torque}
    said = _answer(drive, file, found, repeated(given, {"--element": element}), chosen=band is not None)
    if out is not None:
        said = _written(said, file, text, found, out)
    return ended(show(said, json=json, csv=csv, plot=plot), progress)


OPTIONS = {
    "kind": "--kind",
    "inertia": "--inertia-kg-m2",
    "inertia_ratio": "--ratio",
    "station": "--at",
    "mode": "--mode",
    "order": "--order",
    "radius": "--radius-mm",
    "count": "--count",
    "speeds": "--speeds",
    "elements": "--element",
}
"""What the question calls by another name than the command."""


def _answer(drive: Drive, file: Path, found: Absorber, given: tuple[str, ...], *, chosen: bool) -> Answer:
    from .absorber_tables import content, rows
    from .answer import Answer
    from .asked import figures

    away = None if chosen else _away(drive, found)
    tone, sentence = _sentence(drive, file, found)
    return Answer(
        sentence=sentence,
        tone="warning" if away is not None else tone,
        tables=lambda: (_setting_table(found), _host_table(found)),
        remarks=tuple(_remarks(file, found, given, away)),
        content=lambda: content(drive, file, found),
        csv=lambda: rows(found),
        figure=lambda: figures(found),
    )


def _away(drive: Drive, found: Absorber) -> float | None:
    """Return the speed of a drive [rad/s] where it lies outside the band; None where it does not, or none is given."""
    if drive.duty.speed is None or found.speed[0] <= abs(drive.duty.speed) <= found.speed[-1]:
        return None
    return abs(drive.duty.speed)


def _sentence(drive: Drive, file: Path, found: Absorber) -> tuple[Tone, str]:
    from cardan.units import rpm

    from .answer import significant
    from .source import title

    what = {
        "viscous": _("a viscous damper on {station}"),
        "pendulum": _("pendulums on {station}"),
        "tuned": _("an absorber without damping on {station}"),
    }.get(found.kind, _("an absorber on {station}"))
    values = {
        "name": title(drive, file),
        "what": what.format(station=found.host.name),
        "before": significant(found.bare.peak, 3),
        "after": significant(found.best.peak, 3),
        "low": significant(float(found.speed[0]) / rpm, 3),
        "high": significant(float(found.speed[-1]) / rpm, 3),
    }
    if found.tuned_speed is not None:
        text = _("{name}: with {what} the torque at {speed} rpm swings by {after} N·m, not by {before} N·m.")
        text = text.format(speed=significant(found.tuned_speed / rpm), **values)
    elif found.reduction > LITTLE:
        text = _(
            "{name}: {what} does little here: torques swing by {after} N·m, by {before} N·m without, {low}–{high} rpm."
        )
        text = text.format(**values)
    else:
        text = _(
            "{name}: with {what} the largest swing of a torque falls from {before} to {after} N·m, {low}–{high} rpm."
        )
        text = text.format(**values)
    return ("good" if found.reduction < LITTLE else "warning"), text


def _setting_table(found: Absorber) -> Table:
    from cardan.units import mm, rpm

    from .answer import Column, Table
    from .torsion_parts import short

    pendulum = found.kind == "pendulum"
    rows: list[list[Cell]] = []
    for name, setting in ((_("without"), found.bare), (_("closed form"), found.closed_form), (_("best"), found.best)):
        own: list[Cell] = [None] * 4
        if setting.inertia:
            spring: Cell = setting.stiffness if setting.arm is None else setting.arm / mm
            ratio = None if found.kind == "viscous" else found.frequency_ratio(setting)
            damper = None if pendulum else setting.damping
            own = [None if found.kind == "viscous" else spring, damper, ratio, found.damping_ratio(setting)]
            own[3] = None if pendulum else own[3]
        place = short(found.elements[setting.peak_element], 24)
        rows.append([name, *own, setting.peak, setting.peak_speed / rpm, place])
    spring_column = (
        Column(key="arm_mm", heading=_("arm"), unit="mm")
        if pendulum
        else Column(key="stiffness_Nm_per_rad", heading=_("spring"), unit="N·m/rad")
    )
    columns = (
        Column(key="setting", heading=_("setting"), left=True),
        spring_column,
        Column(key="damping_Nms_per_rad", heading=_("damper"), unit="N·m·s/rad"),
        Column(key="frequency_ratio", heading=_("tuned to"), unit=_("× order") if pendulum else "× ω", form=".3f"),
        Column(key="damping_ratio", heading="ξ", form=".3f"),
        Column(key="swing_Nm", heading=_("swing"), unit="± N·m", form="3"),
        Column(key="at_rpm", heading=_("at"), unit="rpm", form=".4g"),
        Column(key="element", heading=_("in"), left=True),
    )
    return Table(columns=columns, rows=rows)


def _host_table(found: Absorber) -> Table:
    from math import isfinite, sqrt

    from .answer import Column, Table
    from .torsion_parts import short

    least = float(min(found.modal_inertia))
    rows: list[list[Cell]] = []
    for k, host in enumerate(found.hosts):
        inertia = float(found.modal_inertia[k])
        moves = sqrt(least / inertia) if isfinite(inertia) else 0.0
        rows.append([k + 1, short(host.name, 40), moves, inertia if moves > 1e-6 else None, host == found.host])
    columns = (
        Column(key="station", heading=_("no.")),
        Column(key="name", heading=_("station"), left=True),
        Column(key="moves", heading=_("moves"), unit=_("× most"), form=".3f"),
        Column(key="modal_inertia_kg_m2", heading=_("inertia"), unit="kg·m²"),
        Column(key="chosen", heading=_("taken"), left=True),
    )
    shown = sorted(rows, key=lambda row: -float(row[2] or 0.0))[:HOSTS]
    return Table(
        columns=columns,
        rows=sorted(shown, key=lambda row: int(row[0] or 0)),
        title=_("How mode {mode} moves the stations, and what it weighs there").format(mode=found.mode),
        fixed=2,
    )


def _remarks(file: Path, found: Absorber, given: tuple[str, ...], away: float | None) -> Iterator[Remark]:
    import numpy as np

    from cardan.io.stations import station_text
    from cardan.maths.ties import foremost
    from cardan.units import rpm

    from .answer import Remark, percent, significant
    from .torsion_band import band_remarks

    text = _(
        "It weighs {inertia} kg·m², {ratio} of mode {mode} there ({hertz} Hz), which order {order:g} meets at {speed} "
        "rpm."
    )
    yield Remark(
        text=text.format(
            inertia=significant(found.best.inertia, 3),
            ratio=percent(round(found.inertia_ratio, 5)),
            mode=found.mode,
            hertz=significant(found.omega / (2.0 * np.pi), 3),
            order=found.order,
            speed=significant(found.omega / found.order / rpm, 3),
        )
    )
    if found.tuned_speed is None and not found.speed[0] <= found.omega / found.order <= found.speed[-1]:
        yield Remark(text=_("Warning: no resonance lies in this band; this one is the nearest."), tone="warning")
    elif away is not None:
        text = _("Warning: the drive runs at {speed} rpm, outside these speeds; --speeds LOW:HIGH names others.")
        yield Remark(text=text.format(speed=significant(away / rpm)), tone="warning")
    yield from _borne(found)
    if found.tuned_speed is not None:
        worst = np.max(found.after[:, list(found.judged)], axis=-1)
        k = int(foremost(worst))
        text = _("It serves this speed alone: at {speed} rpm it swings itself up, and the torque by ± {torque} N·m.")
        yield Remark(
            text=text.format(speed=significant(float(found.speed[k]) / rpm, 3), torque=significant(float(worst[k]), 3)),
            tone="warning",
        )
    yield from band_remarks(found)
    text = _("Searched {count} settings on the exact equations; the closed form of one mode leaves ± {torque} N·m.")
    yield Remark(text=text.format(count=found.evaluations, torque=significant(found.closed_form.peak, 3)))
    for line in station_text(found.drive, found.table).splitlines():
        yield Remark(text=line)
    yield Remark(
        text=_("Write it into a copy of the file:"),
        command=("cardan", "torsion", "absorber", str(file), *given, "-o", "better.toml"),
        tone="next",
    )


def _borne(found: Absorber) -> Iterator[Remark]:
    """Yield what the absorber has to bear; one that serves one speed, there."""
    import numpy as np

    from cardan.units import deg

    from .answer import Remark, significant

    rows = slice(None) if found.tuned_speed is None else found.speed == found.tuned_speed
    swing = float(np.nanmax(found.twist[rows])) / deg
    values = {"swing": significant(swing, 3), "torque": significant(float(np.nanmax(found.torque[rows])), 3)}
    text = {
        "pendulum": _("The pendulums swing by ± {swing}° at most and pull with ± {torque} N·m."),
        "tuned": _("There its spring twists by ± {swing}° and carries ± {torque} N·m."),
        "viscous": _("It slips by ± {swing}° and drags with ± {torque} N·m at most; that makes {heat} W of heat."),
    }.get(
        found.kind,
        _("Its spring twists by ± {swing}° and carries ± {torque} N·m at most; its damper makes {heat} W of heat."),
    )
    yield Remark(text=text.format(heat=significant(float(np.nanmax(found.heat[rows])), 3), **values))
    if found.kind == "pendulum" and swing > WIDE_SWING:
        text = _("Warning: so wide a swing on a circle lowers the order of a pendulum; give it more inertia.")
        yield Remark(text=text, tone="warning")


def _written(said: Answer, file: Path, text: str, found: Absorber, out: Path) -> Answer:
    """Write the drive with the absorber and return the answer with a word on it."""
    from cardan.io.stations import put_station

    from .torsion_band import written

    def edited() -> str:
        return put_station(text, found.drive, found.table, folder=file.parent)

    return written(said, file, text, out, edited, found.drive)
