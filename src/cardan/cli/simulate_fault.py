"""``cardan simulate-fault``: what should a fault of this drive show, and a recording of it to try things on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _

from .options import AsCsv, AsJson, DriveFile, Force, Plot

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.diagnosis.expected import Expected
    from cardan.questions.diagnosis.signals.signal import Signal

    from .answer import Answer, Cell, Remark, Table


def simulate_fault(
    file: DriveFile,
    fault: Annotated[
        str | None, typer.Argument(metavar="FAULT", help=_("Name of the fault, see --list."), show_default=False)
    ] = None,
    listed: Annotated[
        bool, typer.Option("--list", help=_("List the faults, and do nothing else."), show_default=False)
    ] = False,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="PATH",
            help=_("Write a recording of it into PATH: .csv, .wav, .uff, .unv or .tdms."),
            show_default=False,
        ),
    ] = None,
    severity: Annotated[float, typer.Option("--severity", metavar="X", help=_("How bad: 1 for a plain fault."))] = 1.0,
    shaft: Annotated[
        int | None,
        typer.Option(
            "--shaft", metavar="N", help=_("Shaft with the fault; the heaviest otherwise."), show_default=False
        ),
    ] = None,
    snr: Annotated[
        float, typer.Option("--snr-db", metavar="DB", help=_("What follows the shaft over the noise, in decibels."))
    ] = 10.0,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help=_("Of all that is by chance."))] = 0,
    run_up: Annotated[
        float, typer.Option("--run-up-s", metavar="S", help=_("Time to run up from the lowest to the top speed."))
    ] = 10.0,
    hold: Annotated[float, typer.Option("--hold-s", metavar="S", help=_("Time at each of two torques."))] = 4.0,
    steady: Annotated[
        float | None,
        typer.Option(
            "--steady-rpm", metavar="RPM", help=_("Do not run up: keep this speed at both torques."), show_default=False
        ),
    ] = None,
    rate: Annotated[float, typer.Option("--rate-hz", metavar="HZ", help=_("Values a second."))] = 2048.0,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what a fault of the drive should show at its bearings, and write a recording of it."""
    from .output import check_new
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)

    from cardan.errors import InputError, Problem

    from .progress import watching
    from .source import read

    if listed:
        return show(_listing(), json=json, csv=csv)
    problems = list(_refused(fault, out, seed, run_up))
    if problems:
        raise InputError(problems)
    if out is not None:
        check_new(out, force=force, field="--out")
    drive = read(file)

    from cardan.io import save
    from cardan.questions.diagnosis.expected import expected_orders
    from cardan.questions.diagnosis.simulate import Runs
    from cardan.questions.diagnosis.simulate import simulate_fault as simulated
    from cardan.units import rpm

    names = {
        "runs.run_up": "--run-up-s",
        "runs.hold": "--hold-s",
        "runs.rate": "--rate-hz",
        "runs.held": "--steady-rpm",
    }
    names |= {"fault": "FAULT", "severity": "--severity", "shaft": "--shaft", "snr": "--snr-db"}
    made = None
    with watching(_("making the recording")):
        try:
            found = expected_orders(drive, fault or "healthy", severity=severity, shaft=shaft)
            if out is not None:
                runs = Runs(run_up=run_up, hold=hold, rate=rate)
                if steady is not None:
                    runs = Runs(run_up=0.0, hold=hold, rate=rate, held=steady * rpm / found.speed[1])
                made = simulated(
                    drive, fault or "healthy", severity=severity, seed=seed, snr=snr, runs=runs, shaft=shaft
                )
        except InputError as error:
            found_names = [Problem(names.get(one.field, one.field), one.message, one.code) for one in error.problems]
            raise InputError(found_names) from error
        if made is not None and out is not None:
            save(made, out)
    return show(_answer(drive, file, found, made, out), json=json, csv=csv, plot=plot)


def _refused(fault: str | None, out: Path | None, seed: int, run_up: float) -> Iterator[Any]:
    """Yield what is wrong with the options before anything is read."""
    from cardan.errors import Problem
    from cardan.io.signals import WRITERS
    from cardan.questions.diagnosis.expected import FAULTS
    from cardan.units import nearest

    if fault is None:
        text = _("missing: one of {choices}; --list says what they are")
        yield Problem("FAULT", text.format(choices=", ".join(FAULTS)), "missing")
    elif fault not in FAULTS:
        near = nearest(fault, FAULTS)
        text = _("{value} is none of {choices}").format(value=repr(fault), choices=", ".join(FAULTS))
        yield Problem("FAULT", text + (_("; the nearest is {near}").format(near=near) if near else ""), "out_of_range")
    if out is not None and out.suffix.lower() not in WRITERS:
        text = _("{path} should end in one of {known}")
        yield Problem("--out", text.format(path=out, known=", ".join(WRITERS)), "unknown_kind")
    if seed < 0:
        yield Problem("--seed", _("{value} is negative").format(value=seed), "negative")
    if run_up == 0.0:
        yield Problem("--run-up-s", _("0 is no run-up; --steady-rpm keeps one speed"), "not_positive")


def _words(fault: str) -> str:
    """Return what a fault is, in words."""
    from cardan.catalogue import catalogue
    from cardan.catalogue.rows import Fault
    from cardan.questions.diagnosis.expected import FAULTS

    own = {"unbalance": _("unbalance of a shaft"), "lost_weight": _("balance weight lost")}
    if fault in own:
        return own[fault]
    row = catalogue().rows(Fault).get(FAULTS[fault])
    return _("nothing wrong") if row is None else _(row.fault)


def _listing() -> Answer:
    from cardan.questions.diagnosis.expected import FAULTS

    from .answer import Answer, Column, Table

    rows: list[list[Cell]] = [[name, cause, _words(name)] for name, cause in FAULTS.items()]
    columns = (
        Column(key="fault", heading=_("fault"), left=True),
        Column(key="cause", heading=_("cause"), left=True),
        Column(key="words", heading=_("what is wrong"), left=True, wrap=True),
    )
    table = Table(columns=columns, rows=rows)
    return Answer(
        sentence=_("{count} faults can be simulated.").format(count=len(rows)),
        tables=lambda: (table,),
        content=lambda: {"faults": [dict(zip(("fault", "cause", "words"), row, strict=True)) for row in rows]},
        csv=lambda: table,
    )


def _answer(drive: Drive, file: Path, found: Expected, made: Signal | None, out: Path | None) -> Answer:
    from cardan.figures import for_result
    from cardan.questions.diagnosis.figures.expected import expected_figure

    from .answer import Answer
    from .source import title

    text = _("{name}, {fault}: {sentence}")
    sentence = text.format(name=title(drive, file), fault=_words(found.fault), sentence=expected_figure(found).sentence)
    return Answer(
        sentence=sentence,
        tables=lambda: (_table(found),),
        remarks=tuple(_remarks(file, found, made, out)),
        content=lambda: _content(drive, file, found, made, out),
        csv=lambda: _rows(found),
        figure=lambda: for_result(found),
    )


def _table(found: Expected) -> Table:
    """Return the orders across the shaft for the eye: at each sensor one line an order, by its largest part."""
    from math import hypot

    from cardan.report.diagnosis import by_torque, grows

    from .answer import Column, Table

    radial = [one for one in found.orders if one.direction == "radial"]
    rows: list[list[Cell]] = []
    for place in sorted({one.place for one in radial}):
        for order in sorted({one.order for one in radial}):
            own = [one for one in radial if (one.place, one.order) == (place, order)]
            if not own:
                continue
            sizes = [float(abs(found.value(one, found.speed[1], found.reference))) for one in own]
            most = own[sizes.index(max(sizes))]
            said = grows(most.speed_power, amplified=False), by_torque(most.torque)
            rows.append([place, order, hypot(*sizes), *said])
    columns = (
        Column(key="place", heading=_("sits on"), left=True),
        Column(key="order", heading=_("order"), form="g"),
        Column(key="size_m_s2", heading=_("amplitude"), unit="m/s²", form="3"),
        Column(key="with_speed", heading=_("with the speed"), left=True),
        Column(key="with_torque", heading=_("with the torque"), left=True),
    )
    return Table(columns=columns, rows=rows)


def _rows(found: Expected) -> Table:
    """Return every part of every order for a program."""
    from .answer import Column, Table

    parts = "torque_still", "torque_signed", "torque_sized"
    keys = ["place", "direction", "order", "size", "unit", "speed_power", *parts, "amplified", "source"]
    rows: list[list[Cell]] = [
        [
            one.place,
            one.direction,
            one.order,
            float(abs(found.value(one, found.speed[1], found.reference))),
            "rad/s" if one.direction == "torsion" else "m/s²",
            one.speed_power,
            *one.torque,
            one.amplified,
            one.source,
        ]
        for one in found.orders
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _remarks(file: Path, found: Expected, made: Signal | None, out: Path | None) -> Iterator[Remark]:
    from math import isfinite

    from cardan.units import rpm

    from .answer import Remark, significant

    text = _("Sizes are amplitudes at {speed} rpm and {torque} N·m, good to a factor; shapes are good to more.")
    yield Remark(text=text.format(speed=significant(found.speed[1] / rpm), torque=significant(found.reference)))
    swing = [one for one in found.orders if one.direction == "torsion"]
    if swing:
        size = max(float(abs(found.value(one, found.speed[1], found.reference))) for one in swing)
        text = _("The speed of the output swings by {size} rpm twice a turn.")
        yield Remark(text=text.format(size=significant(size / rpm, 2)))
    for one in found.bursts:
        text = _("Knocks {count} times a turn, loudest at the {kind}, {size} m/s² at light torque.")
        if one.per_turn == 1:
            text = _("Knocks once a turn, loudest at the {kind}, {size} m/s² at light torque.")
        kinds = {"input": _("input"), "centre": _("centre bearing"), "output": _("output")}
        yield Remark(text=text.format(count=one.per_turn, kind=kinds[one.kind], size=significant(one.size, 2)))
    if isfinite(found.critical):
        text = _("What is amplified grows where order times speed meets {speed} rpm.")
        yield Remark(text=text.format(speed=significant(found.critical / rpm)))
    if found.assumed:
        text = _("The drive does not say {names}; the sizes to be expected are assumed.")
        yield Remark(text=text.format(names=", ".join(found.assumed)), tone="warning")
    if made is None or out is None:
        again = ("cardan", "simulate-fault", str(file), found.fault, "-o", f"{found.fault}.csv")
        yield Remark(text=_("A recording of it:"), command=again, tone="next")
        return
    text = _("Recording written: {path}, {count} channels, {span} s.")
    yield Remark(text=text.format(path=out, count=len(made.channels), span=significant(made.duration, 3)))
    if out.suffix.lower() != ".wav":
        command = ("cardan", "diagnose", str(out), str(file))
        yield Remark(text=_("What is wrong with it:"), command=command, tone="next")


def _content(drive: Drive, file: Path, found: Expected, made: Signal | None, out: Path | None) -> dict[str, Any]:
    from cardan.units import rpm

    content: dict[str, Any] = {
        "question": "simulate-fault",
        "drive": drive.name,
        "file": str(file),
        "fault": found.fault,
        "cause": found.cause,
        "critical_speed_rpm": found.critical / rpm,
        "speed_range_rpm": [one / rpm for one in found.speed],
        "torque_Nm": found.reference,
        "orders": [
            {
                "order": one.order,
                "place": one.place,
                "direction": one.direction,
                "size": float(abs(found.value(one, found.speed[1], found.reference))),
                "unit": "rad/s" if one.direction == "torsion" else "m/s²",
                "speed_power": one.speed_power,
                "torque": list(one.torque),
                "amplified": one.amplified,
                "source": one.source,
            }
            for one in found.orders
        ],
        "knocks": [{"per_turn": one.per_turn, "at": one.kind, "size_m_s2": one.size} for one in found.bursts],
        "assumed": list(found.assumed),
    }
    if made is not None:
        channels = [one.name for one in made.channels]
        content["recording"] = {"path": str(out), "duration_s": made.duration, "channels": channels}
    return content
