"""``cardan torsion calm``: how is the drive to be designed so that it runs calmly?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _

from .asked import TorqueNm
from .options import AsCsv, AsJson, DriveFile, Force, Plot, SpeedRpm
from .torsion_band import Element, Out, SpeedBand

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.torsion.calm.calm import Calm

    from .answer import Answer, Cell, Remark, Table, Tone

ROUNDS = 40
"""Generations of a search."""

LITTLE = 0.9
"""A design that leaves more than this share of the swing is hardly calmer."""

AGREE = 0.02
"""Independent searches whose answers differ by no more than this share agree."""


def torsion_calm(
    file: DriveFile,
    free: Annotated[
        list[str] | None,
        typer.Option(
            "--free",
            metavar="PATH=LOW:HIGH[:STEP]",
            help=_("Key of the file that may change, as shafts[1].yoke_angle_deg; may be repeated. Yokes by default."),
            show_default=False,
        ),
    ] = None,
    speeds: SpeedBand = None,
    element: Element = None,
    grid: Annotated[
        int | None,
        typer.Option(
            "--grid",
            metavar="N",
            help=_("Try every combination of N values of each key instead of evolution."),
            show_default=False,
        ),
    ] = None,
    rounds: Annotated[
        int, typer.Option("--rounds", metavar="N", min=1, help=_("Generations of the search at most."))
    ] = ROUNDS,
    seed: Annotated[int, typer.Option("--seed", metavar="N", min=0, help=_("Of the random numbers."))] = 0,
    speed_rpm: SpeedRpm = None,
    torque: TorqueNm = None,
    out: Out = None,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell the yokes, stiffnesses, inertias or joint places with which torques swing least over the speeds in use."""
    from .asked import check_options, on_duty
    from .show import show
    from .torsion_band import asked_of, band_of, check_out, elements_of, repeated
    from .torsion_parts import ended, keeping

    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    check_out(out, file, force=force)
    band, ranges = band_of(speeds), ranges_of(free or [])

    from cardan.maths.curves.evolution import Evolution
    from cardan.questions.torsion.calm.calm import Grid
    from cardan.questions.torsion.calm.calm import calm as question

    from .source import read_with_text

    drive, text = read_with_text(file)
    drive = on_duty(drive, speed_rpm, torque)
    method = Evolution(rounds=rounds, seed=seed) if grid is None else Grid(points=grid)
    with asked_of(file, OPTIONS), keeping(_("searching calm designs")) as progress:
        found = question(
            drive, free=ranges, speeds=band, elements=elements_of(element), method=method, progress=progress
        )
    given: dict[str, object] = {"--speeds": speeds, "--grid": grid, "--rounds": None if rounds == ROUNDS else rounds}
    given |= {"--seed": seed or None, "--speed-rpm": speed_rpm, "--torque-Nm": torque}
    said = _answer(drive, file, found, repeated(given, {"--free": free, "--element": element}))
    if out is not None:
        said = _written(said, file, text, found, out)
    return ended(show(said, json=json, csv=csv, plot=plot), progress)


OPTIONS = {"free": "--free", "speeds": "--speeds", "elements": "--element", "method.points": "--grid"}
"""What the question calls by another name than the command."""


def ranges_of(texts: Sequence[str]) -> dict[str, tuple[float, ...]] | None:
    """Return path -> range of PATH=LOW:HIGH[:STEP], None where nothing is given.

    Examples
    --------
    >>> ranges_of(["shafts[1].yoke_angle_deg=-90:90:22.5"])
    {'shafts[1].yoke_angle_deg': (-90.0, 90.0, 22.5)}
    """
    from cardan.errors import Problem, check

    found: dict[str, tuple[float, ...]] = {}
    problems = []
    for text in texts:
        path, _equals, rest = text.partition("=")
        try:
            values = tuple(float(one) for one in rest.split(":"))
        except ValueError:
            values = ()
        if len(values) not in (2, 3):
            problems.append(Problem("--free", _("{text} is no PATH=LOW:HIGH[:STEP]").format(text=text)))
        elif path in found:
            problems.append(Problem("--free", _("{path} is given twice").format(path=path)))
        found[path] = values
    check(problems)
    return found or None


def _answer(drive: Drive, file: Path, found: Calm, given: tuple[str, ...]) -> Answer:
    from .answer import Answer
    from .asked import figures

    tone, sentence = _sentence(drive, file, found)
    return Answer(
        sentence=sentence,
        tone=tone,
        tables=lambda: (_value_table(found), _peak_table(found)),
        remarks=tuple(_remarks(file, found, given)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: figures(found),
        code=0,
    )


def _sentence(drive: Drive, file: Path, found: Calm) -> tuple[Tone, str]:
    from cardan.figures.wording import percent
    from cardan.units import rpm

    from .answer import significant
    from .source import title

    low, high = (significant(float(one) / rpm, 3) for one in found.speed[[0, -1]])
    band = _("{low}–{high} rpm") if len(found.speed) > 1 else _("at {low} rpm")
    values = {
        "name": title(drive, file),
        "band": band.format(low=low, high=high),
        "before": significant(found.peak_before.torque, 3),
        "after": significant(found.peak_after.torque, 3),
        "share": percent(found.reduction, 3),
    }
    if found.reduction > LITTLE and not len(found.unstable_before):
        text = _("{name}: nothing that may change makes it much calmer; torques swing by {after} N·m, {band}.")
        return "warning", text.format(**values)
    text = _("{name}: the largest swing of a torque falls from {before} to {after} N·m ({share}), {band}.")
    return ("warning" if len(found.unstable_after) else "good"), text.format(**values)


def _value_table(found: Calm) -> Table:
    from .answer import Column, Table

    rows: list[list[Cell]] = [
        [one.path, one.built, found.values[one.path], f"{one.low:g} … {one.high:g}" + _step(one.step)]
        for one in found.free
    ]
    columns = (
        Column(key="path", heading=_("what may change"), left=True),
        Column(key="built", heading=_("as built"), form=".5g"),
        Column(key="best", heading=_("best"), form=".5g"),
        Column(key="range", heading=_("range"), left=True),
    )
    return Table(columns=columns, rows=rows)


def _step(step: float | None) -> str:
    return "" if step is None else _(", step {step:g}").format(step=step)


def _peak_table(found: Calm) -> Table:
    import numpy as np

    from cardan.maths.ties import foremost
    from cardan.units import rpm

    from .answer import Column, Table
    from .torsion_parts import short

    rows: list[list[Cell]] = []
    for e, name in enumerate(found.elements):
        cells: list[Cell] = [e + 1, short(name, 34)]
        for curve in (found.before, found.after):
            k = int(foremost(np.nan_to_num(curve[:, e], nan=-1.0)))
            cells += [float(curve[k, e]), float(found.speed[k]) / rpm]
        rows.append(cells)
    columns = (
        Column(key="element", heading=_("no.")),
        Column(key="name", heading=_("torque in"), left=True),
        Column(key="before_Nm", heading=_("as built"), unit="± N·m", form="3"),
        Column(key="before_rpm", unit=_("at rpm"), form=".4g"),
        Column(key="after_Nm", heading=_("best"), unit="± N·m", form="3"),
        Column(key="after_rpm", unit=_("at rpm"), form=".4g"),
    )
    return Table(columns=columns, rows=rows, title=_("Largest swing of every torque in the band"), fixed=2)


def _remarks(file: Path, found: Calm, given: tuple[str, ...]) -> Iterator[Remark]:
    from .answer import Remark, significant
    from .torsion_band import band_remarks

    for sentence in found.sentences:
        yield Remark(text=sentence)
    for path in found.at_limits:
        text = _("{path} ends at the end of its range: a wider one may do more.")
        yield Remark(text=text.format(path=path))
    yield from band_remarks(found)
    if found.infeasible:
        text = _("{count} of the values tried make no drive.")
        yield Remark(text=text.format(count=found.infeasible))
    if len(found.run_peaks) > 1:
        agrees = found.agreement <= AGREE
        text = (
            _("Searched {count} designs on the exact equations; two independent searches end within {share} %.")
            if agrees
            else _("Warning: of {count} designs, two independent searches end {share} % apart; take more --rounds.")
        )
        said = text.format(count=found.evaluations, share=significant(max(100.0 * found.agreement, 0.1), 2))
        yield Remark(text=said, tone="plain" if agrees else "warning")
    else:
        yield Remark(text=_("Searched {count} designs on the exact equations.").format(count=found.evaluations))
    yield Remark(
        text=_("Write the best values into a copy of the file:"),
        command=("cardan", "torsion", "calm", str(file), *given, "-o", "better.toml"),
        tone="next",
    )


def _rows(found: Calm) -> Table:
    """Return the curves over the speed."""
    from cardan.units import rpm

    from .answer import Column, Table

    many = range(1, len(found.elements) + 1)
    keys = ["speed_rpm", *(f"{word}_swing_{k}_Nm" for word in ("before", "after") for k in many)]
    rows: list[list[Cell]] = [
        [float(found.speed[s]) / rpm, *(float(one) for curve in (found.before, found.after) for one in curve[s])]
        for s in range(len(found.speed))
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _content(drive: Drive, file: Path, found: Calm) -> dict[str, Any]:
    from cardan.units import rpm

    from .asked import columns_of

    def peak(one: Any) -> dict[str, Any]:
        return {"swing_Nm": one.torque, "at_rpm": one.speed / rpm, "element": found.elements[one.element]}

    def rule(one: Any) -> dict[str, Any]:
        return {
            "mode": one.mode,
            "frequency_Hz": one.omega / 6.283185307179586,
            "joint_weight": one.kappa,
            "modulation": one.modulation,
            "damping_ratio": one.damping_ratio,
            "push_left": one.left,
            "resonance_torque_Nm": one.resonance_torque,
        }

    return {
        "question": "torsion calm",
        "drive": drive.name,
        "file": str(file),
        "free": [
            {"path": one.path, "low": one.low, "high": one.high, "step": one.step, "built": one.built}
            for one in found.free
        ],
        "values": dict(found.values),
        "before": peak(found.peak_before),
        "after": peak(found.peak_after),
        "reduction": found.reduction,
        "elements": list(found.elements),
        "unstable_before_rpm": found.unstable_before / rpm,
        "unstable_after_rpm": found.unstable_after / rpm,
        "modes_before": [rule(one) for one in found.rules_before],
        "modes_after": [rule(one) for one in found.rules_after],
        "why": found.sentences,
        "evaluations": found.evaluations,
        "infeasible": found.infeasible,
        "run_peaks_Nm": found.run_peaks,
        "history_Nm": found.history,
        "converged": found.converged,
        "cancelled": found.cancelled,
        "play_closed": found.play,
        "at_limits": found.at_limits,
        "assumed": found.assumed,
        "curves": columns_of(_rows(found)),
    }


def _written(said: Answer, file: Path, text: str, found: Calm, out: Path) -> Answer:
    """Write the drive with the best values and return the answer with a word on it."""
    from cardan.io import edit

    from .torsion_band import written

    changed = {one.path: found.values[one.path] for one in found.free if found.values[one.path] != one.built}

    def edited() -> str:
        return edit(text, changed, folder=file.parent) if changed else text

    return written(said, file, text, out, edited, found.drive)
