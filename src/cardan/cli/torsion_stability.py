"""``cardan torsion stability``: does torsional vibration die out, at a speed or over a map?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _

from .options import AsCsv, AsJson, DriveFile, Plot, SpeedRpm
from .torsion_parts import Pieces, Speeds

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.torsion.stability.torsion_stability import Stability

    from .answer import Answer, Cell, Remark, Table, Tone

SIGNS = {0: "·", 1: "~", 2: "#", 3: " "}
"""A point of a map in the terminal, by `cardan.questions.torsion.steady.run_stability.Verdict`."""

NAMED = 3
"""Zones named in the answer to a map."""

WIDE, HIGH = 61, 17
"""Points of a map in the terminal at most."""


def torsion_stability(
    file: DriveFile,
    speed_rpm: SpeedRpm = None,
    speeds: Speeds = None,
    bends: Annotated[
        str | None,
        typer.Option(
            "--bends",
            metavar="LOW:HIGH[:COUNT]",
            help=_("Bend of the most bent joint [°], the others in proportion."),
            show_default=False,
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        typer.Option(
            "--over",
            metavar="PATH=LOW:HIGH[:COUNT]",
            help=_("Any key of the file, as shafts[1].damping_Nms_per_rad; may be repeated."),
            show_default=False,
        ),
    ] = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell whether torsional vibration dies out, and how fast."""
    from .asked import keys_of, on_duty
    from .output import check_speed
    from .show import check_common, show
    from .torsion_parts import ended, keeping

    check_common(json=json, csv=csv, plot=plot)
    check_speed(speed_rpm)
    axes = _axes(speeds, bends, over or [])

    from cardan.questions.torsion.stability.torsion_stability import stability as question

    from .source import read

    drive = on_duty(read(file), speed_rpm, None)
    with keys_of(file), keeping(_("judging steady motions")) as progress:
        found = question(drive, over=axes, pieces=pieces, progress=progress)
    return ended(show(_answer(drive, file, found), json=json, csv=csv, plot=plot), progress)


def _axes(speeds: str | None, bends: str | None, over: list[str]) -> dict[str, Any]:
    """Return the paths of a map with their values."""
    from cardan.errors import refuse

    from .torsion_parts import values

    several = sum(one is not None for one in (speeds, bends)) + len(over) > 1
    count = 61 if several else 201
    axes: dict[str, Any] = {}
    if speeds is not None:
        axes["duty.speed_rpm"] = values(speeds, "--speeds", count=count, low=0.0)
    if bends is not None:
        axes["bend_deg"] = values(bends, "--bends", count=31 if several else count)
    for one in over:
        path, equals, text = one.partition("=")
        if not equals:
            raise refuse("--over", _("{text} is no PATH=LOW:HIGH[:COUNT]").format(text=one))
        axes[path] = values(text, "--over", count=31 if several else count)
    return axes


def _answer(drive: Drive, file: Path, found: Stability) -> Answer:
    from .answer import Answer
    from .asked import figures

    single = not found.over
    tone, sentence = _sentence(drive, file, found) if single else _mapped(drive, file, found)
    return Answer(
        sentence=sentence,
        tone=tone,
        tables=lambda: [] if single else _tables(found),
        remarks=tuple(_remarks(file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: figures(found),
        code=1 if single and tone == "failed" else 0,
    )


def _sentence(drive: Drive, file: Path, found: Stability) -> tuple[Tone, str]:
    from cardan.questions.torsion.steady.run_stability import Kind, Verdict
    from cardan.units import rpm

    from .answer import significant
    from .source import title

    at = {"name": title(drive, file), "speed": significant(abs(float(found.speed)) / rpm)}
    verdict, rate = int(found.verdict), float(found.growth_rate)
    if verdict == Verdict.UNKNOWN:
        return "failed", _("{name}: no steady motion was found at {speed} rpm.").format(**at)
    if verdict == Verdict.UNSTABLE:
        text = _("{name}: unstable at {speed} rpm: vibration grows tenfold in {time} s, {zone}, order {order}.")
        time = significant(2.302585092994046 / rate, 3)
        order = f"{float(found.order):.3g}" if int(found.kind) == Kind.COMBINATION else f"{float(found.order):g}"
        return "failed", text.format(time=time, zone=found.zone.name(), order=order, **at)
    if verdict == Verdict.NEUTRAL:
        return "warning", _("{name}: neutral at {speed} rpm: vibration neither grows nor dies out.").format(**at)
    text = _("{name}: stable at {speed} rpm: vibration dies out to a tenth in {time} s.")
    return "good", text.format(time=significant(-2.302585092994046 / rate, 3), **at)


def _mapped(drive: Drive, file: Path, found: Stability) -> tuple[Tone, str]:
    import numpy as np

    from cardan.questions.torsion.steady.run_stability import Verdict

    from .answer import percent
    from .source import title
    from .torsion_response import intervals

    name = title(drive, file)
    unstable = found.verdict == Verdict.UNSTABLE
    lost = found.verdict == Verdict.UNKNOWN
    if not np.any(unstable):
        if np.all(found.verdict == Verdict.STABLE):
            return "good", _("{name}: stable throughout.").format(name=name)
        if np.all(lost):
            return "failed", _("{name}: no steady motion was found.").format(name=name)
        text = _("{name}: no point is known to be unstable; {neutral} of {all} are neutral, {lost} not known.")
        neutral = int(np.sum(found.verdict == Verdict.NEUTRAL))
        return "warning", text.format(name=name, neutral=neutral, all=unstable.size, lost=int(np.sum(lost)))
    if len(found.over) == 1:
        path, values = found.over[0]
        text = _("{name}: unstable at {where} {path}.")
        return "failed", text.format(name=name, path=_axis(path), where=intervals(values, unstable))
    named = np.argwhere(unstable & (found.zone.modes[..., 0] > 0)).tolist()
    zones = sorted({found.zone.name(tuple(index)) for index in named})
    said = ", ".join(zones[:NAMED]) + (_(" and others") if len(zones) > NAMED else "")
    text = (
        _("{name}: {share} of the map is unstable: {zones}.") if said else _("{name}: {share} of the map is unstable.")
    )
    return "failed", text.format(name=name, share=percent(found.unstable_share), zones=said)


def _axis(path: str) -> str:
    return {"duty.speed_rpm": _("rpm"), "bend_deg": _("° of bend")}.get(path, path)


def _tables(found: Stability) -> list[Table]:
    """Return the map drawn with signs, or its unstable ranges."""
    import numpy as np

    from .answer import Column, Table, printed

    if len(found.over) == 1:
        return []
    (down, rows), (across, columns) = found.over if found.over[0][0] != "duty.speed_rpm" else found.over[::-1]
    table = found.verdict if found.over[0][0] != "duty.speed_rpm" else found.verdict.T
    i = np.unique(np.linspace(0, len(rows) - 1, min(len(rows), HIGH)).round().astype(int))[::-1]
    j = np.unique(np.linspace(0, len(columns) - 1, min(len(columns), WIDE)).round().astype(int))
    pictured = [[SIGNS[int(table[k, n])] for n in j] for k in i]
    title = _("# unstable, · stable")
    here = dict(found.here)
    at = [(here.get(path), values[picked]) for path, values, picked in ((down, rows, i), (across, columns, j))]
    if all(one is not None and min(values) <= one <= max(values) for one, values in at):
        y, x = (int(np.argmin(np.abs(values - one))) for one, values in at)
        pictured[y][x] = "O"
        title = _("# unstable, · stable, O the drive")
    lines: list[list[Cell]] = [[float(rows[k]), "".join(line)] for k, line in zip(i, pictured, strict=True)]
    ends = f"{printed(float(columns[0]), 'g')} … {printed(float(columns[-1]), 'g')}"
    heads = (
        Column(key="value", heading=_axis(down)),
        Column(key="map", heading=f"{_axis(across)}: {ends}", left=True),
    )
    return [Table(columns=heads, rows=lines, title=title)]


def _remarks(file: Path, found: Stability) -> Iterator[Remark]:
    import numpy as np

    from cardan.questions.torsion.steady.run_stability import Verdict
    from cardan.units import rpm

    from .answer import Remark, significant
    from .torsion_parts import assumptions

    if found.cancelled:
        done = int(np.sum(found.verdict != Verdict.UNKNOWN))
        text = _("Warning: stopped; {done} of {all} points are done.")
        yield Remark(text=text.format(done=done, all=found.verdict.size), tone="warning")
    if not found.over and int(found.verdict) == Verdict.STABLE and np.isfinite(found.zone.speed):
        text = _("The nearest zone is the {zone}, at {speed} rpm.")
        speed = significant(float(found.zone.speed) / rpm)
        yield Remark(text=text.format(zone=found.zone.name(), speed=speed))
    if not found.over and int(found.verdict) == Verdict.UNSTABLE:
        text = _("What helps: another speed, less bend, a joint nearer to the node of the mode, more damping.")
        yield Remark(text=text)
    if found.train.model.free:
        yield Remark(text=_("Turning as a whole is left out: a free drive may shift in time."))
    yield from assumptions(found.train)
    if not found.over:
        yield Remark(
            text=_("Where it is stable, over speed [rpm] and bend [°]:"),
            command=("cardan", "torsion", "stability", str(file), "--speeds", "LOW:HIGH", "--bends", "LOW:HIGH"),
            tone="next",
        )


def _rows(found: Stability) -> Table:
    """Return the map, one point a row."""
    import numpy as np

    from cardan.units import rpm

    from .answer import Column, Table

    shape = found.verdict.shape
    grid = np.meshgrid(*(values for _path, values in found.over), indexing="ij") if found.over else []
    keys = [path for path, _values in found.over]
    keys += ["input_speed_rpm", "verdict", "spectral_radius", "growth_rate_1_per_s", "order"]
    parts = [*grid, np.broadcast_to(np.abs(found.speed), shape) / rpm]
    parts += [found.verdict, found.spectral_radius, found.growth_rate, found.order]
    rows = np.stack([np.asarray(part, dtype=float).reshape(-1) for part in parts], axis=-1).tolist()
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _content(drive: Drive, file: Path, found: Stability) -> dict[str, Any]:
    import numpy as np

    from cardan.units import rpm

    from .torsion_tables import STATES

    states = np.asarray(STATES)[found.verdict]
    return {
        "question": "torsion stability",
        "drive": drive.name,
        "file": str(file),
        "over": {path: values for path, values in found.over},
        "speed_rpm": np.abs(found.speed) / rpm,
        "verdict": states,
        "stable": found.stable,
        "spectral_radius": found.spectral_radius,
        "growth_rate_1_per_s": found.growth_rate,
        "order": found.order,
        "nearest_zone_rpm": found.zone.speed / rpm,
        "nearest_zone": [found.zone.name(index) for index in np.ndindex(found.verdict.shape)],
        "cancelled": found.cancelled,
        "assumed": found.train.assumed,
    }
