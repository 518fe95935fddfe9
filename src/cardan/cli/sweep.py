"""``cardan sweep``: a parameter sweep over the fields of a drive."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural
from cardan.units import thousands

from .options import AsCsv, AsJson, MoreRows, Plot

if TYPE_CHECKING:
    from cardan.batch.engine.engines import Engine
    from cardan.batch.plan import SweepWork
    from cardan.batch.table.swept import Sweep
    from cardan.io.plan_file import Plan

    from .answer import Answer, Cell, Remark, Table, Tone

HELD = 200_000
"""A table of at most so many points is held without a folder."""

SHOWN = 12
"""Rows of a table that are shown where no reduction is asked for."""

GROUPS = 24
"""Groups of a reduction that are shown."""


def sweep(
    plan: Annotated[
        Path,
        typer.Argument(metavar="PLAN", help=_("Plan file, TOML or JSON."), show_default=False),
    ],
    into: Annotated[
        Path | None,
        typer.Option(
            "--into",
            metavar="FOLDER",
            help=_("Folder for the table, as Parquet; a sweep begun there goes on."),
            show_default=False,
        ),
    ] = None,
    engine: Annotated[
        str | None,
        typer.Option(
            "--engine",
            metavar="in-process|processes|cluster",
            help=_("Where to work, instead of where the plan says."),
            show_default=False,
        ),
    ] = None,
    workers: Annotated[
        int | None,
        typer.Option(
            "--workers", metavar="N", min=1, help=_("How many processes or workers of a cluster."), show_default=False
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            "--scheduler",
            metavar="ADDRESS",
            help=_("Address of the scheduler of a dask cluster; without it a cluster is started here."),
            show_default=False,
        ),
    ] = None,
    device: Annotated[
        str | None,
        typer.Option(
            "--device",
            metavar="cpu|gpu",
            help=_("What computes questions about motion, instead of what the plan says."),
            show_default=False,
        ),
    ] = None,
    resume: Annotated[
        bool,
        typer.Option("--resume", help=_("Go on with the sweep of FOLDER, and begin none."), show_default=False),
    ] = False,
    design: Annotated[
        str | None,
        typer.Option(
            "--design",
            metavar="search|sensitivity|boundary",
            help=_("Run the plan's search, sensitivity or boundary instead of the full grid."),
            show_default=False,
        ),
    ] = None,
    catalogue: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Ask questions of a drive at every point of a plan."""
    from .failure import about
    from .show import check_common, show
    from .torsion_parts import ended, keeping

    check_common(json=json, csv=csv, plot=plot)
    _check(into, resume, engine, scheduler, device)

    from cardan.batch.engine.running import run
    from cardan.io.plan_file import read_plan

    with about(str(plan)):
        read = read_plan(plan, catalogues=catalogue or ())
        chosen = _design(read, design, plot)
    if chosen:
        from .sweep_design import designed

        return designed(read, plan, chosen, json=json, csv=csv, plot=plot)
    if csv and read.rows == "none":
        from cardan.errors import refuse

        raise refuse("--csv", _("the plan keeps no rows"))
    with about(str(plan)):
        work = read.work(device=device)  # type: ignore[arg-type]
        keeps = read.rows == "kept" and (into is not None or csv or work.size <= HELD)
    where = _engine(read, engine, workers, scheduler)
    with keeping(_("answering points"), count=work.size) as progress:
        found = run(
            work,
            engine=where,
            into=into,
            rows="kept" if keeps else "none",
            chunk=read.chunk,
            progress=progress,
        )
    return ended(show(_answer(read, work, found, plan, keeps), json=json, csv=csv), progress)


def _check(into: Path | None, resume: bool, engine: str | None, scheduler: str | None, device: str | None) -> None:
    """Refuse options that are none or contradict each other."""
    from cardan.errors import Problem, check

    known = ("in-process", "processes", "cluster")
    text = _("{value} is none of {choices}")
    problems = []
    if engine is not None and engine not in known:
        problems.append(Problem("--engine", text.format(value=repr(engine), choices=", ".join(known))))
    if device is not None and device not in ("cpu", "gpu"):
        problems.append(Problem("--device", text.format(value=repr(device), choices="cpu, gpu")))
    if scheduler is not None and engine not in (None, "cluster"):
        problems.append(Problem("--scheduler", _("only a cluster has a scheduler")))
    if resume and into is None:
        problems.append(Problem("--resume", _("missing; --into names the folder of the sweep")))
    check(problems)
    if resume and into is not None:
        from cardan.batch.table.swept import read_sweep

        read_sweep(into)


def _design(read: Plan, design: str | None, plot: Path | None) -> str:
    """Return the design that is to choose the points: the one asked for, or the only one where nothing else varies."""
    from cardan.errors import refuse

    if design is not None and design not in read.parts:
        given = ", ".join(read.parts) or _("none")
        raise refuse("--design", _("the plan has no [{name}]; it has: {given}").format(name=design, given=given))
    chosen = design or (next(iter(read.parts)) if len(read.parts) == 1 and not read.axes else "")
    if plot is not None and not chosen:
        raise refuse("--plot", _("a table is drawn by cardan sweep show FOLDER --plot; here designs are"))
    return chosen


def _engine(read: Plan, engine: str | None, workers: int | None, scheduler: str | None) -> Engine:
    """Return where to work: as the options say, else as the plan says."""
    from cardan.batch.engine.engines import InProcess, Processes

    address = scheduler or read.scheduler
    kind = engine or ("cluster" if scheduler else read.engine)
    count = workers or read.workers
    if kind == "cluster":
        from cardan.batch.engine.cluster import Cluster

        return Cluster(scheduler=address or None, workers=count)
    if kind == "processes":
        return Processes(workers=count)
    return InProcess()


def _answer(read: Plan, work: SweepWork, found: Sweep, file: Path, keeps: bool) -> Answer:
    from .answer import Answer

    tone, sentence = _sentence(read, found)
    return Answer(
        sentence=sentence,
        tone=tone,
        tables=lambda: list(_tables(found, keeps)),
        remarks=tuple(_remarks(work, found, file, keeps)),
        content=lambda: _content(found, file, keeps),
        csv=lambda: _rows(found, None),
        code=0 if found.status == "done" else 1,
    )


def _sentence(read: Plan, found: Sweep) -> tuple[Tone, str]:
    counts = found.reductions.get("points", {})
    answered = int(counts.get("answered", 0))
    done = found.size - sum(one.stop - one.start for one in found.missing)
    if found.missing:
        text = _("{name}: {done} of {all} points are done, {answered} answered.")
    elif answered == done:
        text = _("{name}: all {all} points are answered.")
    else:
        text = _("{name}: of {all} points {answered} are answered.")
    said = text.format(
        name=read.title or read.drive.name or _("the drive"),
        done=thousands(done),
        all=thousands(found.size),
        answered=thousands(answered),
    )
    if "feasible" in counts:
        said += " " + _("{count} of them keep every constraint.").format(count=thousands(int(counts["feasible"])))
    if found.missing:
        return ("warning" if found.status == "cancelled" else "failed"), said
    return ("plain" if answered else "warning"), said


def _tables(found: Sweep, keeps: bool) -> Iterator[Table]:
    from .answer import Column, Table

    told = {name: one for name, one in found.reductions.items() if one.get("kind") not in ("points", None)}
    single = {name: one for name, one in told.items() if "groups" not in one and one["kind"] != "histogram"}
    if single:
        columns = (
            Column(key="name", heading=_("over all points"), left=True),
            Column(key="value", heading=_("value"), form="5"),
            Column(key="unit", heading=_("unit"), left=True),
            Column(key="where", heading=_("where"), left=True, wrap=True),
        )
        rows = [[name, one.get("value"), _unit(one), _where(one)] for name, one in single.items()]
        yield Table(columns=columns, rows=rows)
    for name, one in told.items():
        if "groups" in one and one["kind"] != "histogram":
            yield _grouped(name, one)
        elif one["kind"] == "histogram" and "groups" not in one:
            yield _histogram(name, one)
    if not told and keeps:
        yield _rows(found, SHOWN)


def _unit(one: Mapping[str, Any]) -> str:
    from cardan.units import label

    return label(one["unit"]) if one.get("unit") else ""


def _where(one: Mapping[str, Any]) -> str:
    """Return what stands beside a value: its point, or how far it may be off."""
    from .answer import significant

    if "point" in one:
        return ", ".join(f"{key} = {_short(value)}" for key, value in one["point"].items())
    if one.get("bound"):
        return _("within {bound}").format(bound=significant(float(one["bound"]), 2))
    return ""


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _grouped(name: str, one: Mapping[str, Any]) -> Table:
    from .answer import Column, Table

    keys = list(one["groups"][0])
    columns = (
        *(Column(key=key, heading=key, left=isinstance(one["groups"][0][key], str), form=".6g") for key in keys),
        Column(key="value", heading=_("value"), unit=_unit(one), form="5"),
    )
    pairs = list(zip(one["groups"], one["values"], strict=True))
    title = (
        name
        if len(pairs) <= GROUPS
        else _("{name}: the first {count} of {all}").format(name=name, count=GROUPS, all=thousands(len(pairs)))
    )
    return Table(
        columns=columns, rows=[[*group.values(), value.get("value")] for group, value in pairs[:GROUPS]], title=title
    )


def _histogram(name: str, one: Mapping[str, Any]) -> Table:
    from .answer import Column, Table

    columns = (
        Column(key="from", heading=_("from"), unit=_unit(one), form="5"),
        Column(key="to", heading=_("to"), unit=_unit(one), form="5"),
        Column(key="count", heading=_("points")),
    )
    rows: list[list[Cell]] = [[a, b, n] for a, b, n in zip(one["edges"], one["edges"][1:], one["counts"], strict=False)]
    return Table(columns=columns, rows=rows, title=name, fixed=2)


def _rows(found: Sweep, most: int | None) -> Table:
    """Return the rows of the table, read piece by piece; the first of them as a list where a limit is given."""
    from .answer import Column, Table

    columns = tuple(Column(key=one.name, heading=one.name, form="5") for one in found.columns)
    parts = (part for _start, part in found.parts())
    rows: Any = (row for part in parts for row in zip(*(part[one.name].tolist() for one in found.columns), strict=True))
    return Table(columns=columns, rows=rows if most is None else list(islice(rows, most)), fixed=0)


def _remarks(work: SweepWork, found: Sweep, file: Path, keeps: bool) -> Iterator[Remark]:
    from .answer import Remark

    counts = found.reductions.get("points", {})
    for key, row in counts.get("first", {}).items():
        n = int(counts[key])
        if key == "no_drive":
            text = plural(
                "{count} point makes no drive, row {row}: {why}",
                "{count} points make no drive, the first of them in row {row}: {why}",
                n,
            )
        else:
            text = plural(
                "{count} point has a question without an answer, row {row}: {why}",
                "{count} points have a question without an answer, the first of them in row {row}: {why}",
                n,
            )
        why = "; ".join(str(one) for one in work.why(int(row))[:3])
        yield Remark(text=text.format(count=thousands(n), row=row, why=why), tone="warning")
    for one in found.missing[:3]:
        text = _("Missing: rows {start} to {stop}: {why}")
        yield Remark(
            text=text.format(start=thousands(one.start), stop=thousands(one.stop - 1), why=one.why), tone="warning"
        )
    if len(found.missing) > 3:
        more = len(found.missing) - 3
        text = plural("Missing: {count} further stretch of rows.", "Missing: {count} further stretches of rows.", more)
        yield Remark(text=text.format(count=more))
    if found.damaged:
        yield Remark(text=_("Made again, because damaged: {names}").format(names=", ".join(found.damaged[:5])))
    if found.missing and found.folder is not None:
        command = ("cardan", "sweep", _plan(file), "--into", _near(found.folder), "--resume")
        yield Remark(text=_("To go on:"), command=command, tone="next")
    elif found.folder is not None and keeps:
        yield Remark(text=_("To look at it:"), command=("cardan", "sweep", "show", _near(found.folder)), tone="next")
    elif found.folder is None:
        keeping = ("cardan", "sweep", _plan(file), "--into", file.stem)
        yield Remark(text=_("No table was kept. To keep one:"), command=keeping, tone="next")


def _near(folder: Path) -> str:
    """Return a folder as it is written from here."""
    here = Path.cwd()
    return str(folder.relative_to(here) if folder.is_relative_to(here) and folder != here else folder)


def _plan(file: Path) -> str:
    """Return a plan as it is written on the command line."""
    return f"./{file}" if str(file) == "show" else str(file)


def _content(found: Sweep, file: Path, keeps: bool) -> dict[str, Any]:
    held = keeps and found.folder is None
    return {
        "question": "sweep",
        "plan": str(file),
        "points": found.size,
        "status": found.status,
        "missing": [{"start": one.start, "stop": one.stop, "why": one.why} for one in found.missing],
        "folder": None if found.folder is None else str(found.folder),
        "columns": [{"name": one.name, "unit": one.unit, "role": one.role} for one in found.columns],
        "reductions": dict(found.reductions),
        "provenance": dict(found.provenance),
        **({"table": {name: values.tolist() for name, values in found.table().items()}} if held else {}),
    }
