"""``cardan sweep``: a parameter sweep over the fields of a drive."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.batch.answer import answer, over
from cardan.batch.engine.cluster import Cluster
from cardan.batch.engine.engines import Engine, InProcess, Processes
from cardan.batch.engine.running import run
from cardan.batch.search.answer import answer as design_answer
from cardan.batch.table.swept import read_sweep
from cardan.cli.shared.failure import about
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import check_common
from cardan.cli.shared.progress import ended, keeping
from cardan.cli.shared.source import AsCsv, AsJson, MoreRows, Plot
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, check, refuse
from cardan.io.plan_designs import design_of
from cardan.io.plan_file import Plan, read_plan
from cardan.texts import _

HELD = 200_000  # a table of at most so many points is held without a folder


def sweep(
    plan: Annotated[Path, argument("PLAN", _("Plan file, TOML or JSON."))],
    into: Annotated[
        Path | None, option("--into", "FOLDER", _("Folder for the table, as Parquet; a sweep begun there goes on."))
    ] = None,
    engine: Annotated[
        str | None,
        option("--engine", "in-process|processes|cluster", _("Where to work, instead of where the plan says.")),
    ] = None,
    workers: Annotated[
        int | None, option("--workers", "N", _("How many processes or workers of a cluster."), min=1)
    ] = None,
    scheduler: Annotated[
        str | None,
        option(
            "--scheduler",
            "ADDRESS",
            _("Address of the scheduler of a dask cluster; without it a cluster is started here."),
        ),
    ] = None,
    device: Annotated[
        str | None,
        option("--device", "cpu|gpu", _("What computes questions about motion, instead of what the plan says.")),
    ] = None,
    resume: Annotated[bool, flag("--resume", _("Go on with the sweep of FOLDER, and begin none."))] = False,
    design: Annotated[
        str | None,
        option(
            "--design",
            "search|sensitivity|boundary",
            _("Run the plan's search, sensitivity or boundary instead of the full grid."),
        ),
    ] = None,
    catalogue: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Ask questions of a drive at every point of a plan."""
    check_common(json=json, csv=csv, plot=plot)
    _check(into, resume, engine, scheduler, device)

    with about(str(plan)):
        read = read_plan(plan, catalogues=catalogue or ())
        chosen = _design(read, design)
    if chosen:
        return designed(read, plan, chosen, json=json, csv=csv, plot=plot)
    if csv and read.rows == "none":
        raise refuse("--csv", _("the plan keeps no rows"))
    with about(str(plan)):
        work = read.work(device=device)  # type: ignore[arg-type]
        keeps = read.rows == "kept" and (into is not None or csv or work.size <= HELD)
    if plot is not None and not (keeps and over(work)):
        why = _(
            "a table is drawn by cardan sweep show FOLDER --plot; here designs are, and grids over one or two fields"
        )
        raise refuse("--plot", why)
    where = _engine(read, engine, workers, scheduler)
    with keeping(_("answering points"), count=work.size) as progress:
        found = run(
            work, engine=where, into=into, rows="kept" if keeps else "none", chunk=read.chunk, progress=progress
        )
    title = read.title or read.drive.name or _("the drive")
    return ended(tell(answer(work, found, plan, keeps=keeps), name=title, json=json, csv=csv, plot=plot), progress)


def _check(into: Path | None, resume: bool, engine: str | None, scheduler: str | None, device: str | None) -> None:
    """Refuse options that are none or contradict each other."""
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
        read_sweep(into)


def _design(read: Plan, design: str | None) -> str:
    """Return the design that is to choose the points: the one asked for, or the only one where nothing else varies."""
    if design is not None and design not in read.parts:
        given = ", ".join(read.parts) or _("none")
        raise refuse("--design", _("the plan has no [{name}]; it has: {given}").format(name=design, given=given))
    return design or (next(iter(read.parts)) if len(read.parts) == 1 and not read.axes else "")


def _engine(read: Plan, engine: str | None, workers: int | None, scheduler: str | None) -> Engine:
    """Return where to work: as the options say, else as the plan says."""
    address = scheduler or read.scheduler
    kind = engine or ("cluster" if scheduler else read.engine)
    count = workers or read.workers
    if kind == "cluster":
        return Cluster(scheduler=address or None, workers=count)
    if kind == "processes":
        return Processes(workers=count)
    return InProcess()


def designed(read: Plan, file: Path, name: str, *, json: bool, csv: bool, plot: Path | None) -> int:
    """Run a design of a plan and tell what it found.

    name: table of the design; json, csv: ``--json`` and ``--csv``; plot: ``--plot``.
    """
    with about(str(file)):
        design = design_of(read, name)
    with keeping(_("choosing points")) as progress, about(str(file)):
        found = design.run(progress)
    title = read.title or read.drive.name or file.stem
    return ended(tell(design_answer(found), name=title, json=json, csv=csv, plot=plot), progress)
