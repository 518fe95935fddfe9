"""The plan file of a sweep: which drive, what varies, what is asked, on which machines."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from cardan.batch.answering.asking import Device
from cardan.batch.answering.questions import asked
from cardan.batch.points.axes import Axis, GridAxis, SampledAxis, TableAxis
from cardan.batch.points.distributions import DISTRIBUTIONS, METHODS, Distribution
from cardan.batch.points.fields import present, spots_of, spread_out
from cardan.batch.search.goals import limit_of
from cardan.batch.sweep import SweepWork, listed, work_of
from cardan.batch.table.reductions import BINS, KINDS, Reduce, reduce_of
from cardan.catalogue import Catalogue, catalogue, known_to
from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem, check, refuse
from cardan.files import Enclosed, folder_of
from cardan.mechanism.mechanism import Mechanism
from cardan.reading.table import Table
from cardan.texts import _

from .drive_file import load_either, toml_text
from .text import parsed, text_of

FORMAT = 1  # version of the plan file
ENGINES = ("in-process", "processes", "cluster")  # where a sweep may be worked on
KEYS = ("search", "sensitivity", "boundary")  # tables of designs that choose their points themselves; read by those


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What a plan file says."""

    drive: Drive | Mechanism
    known: Catalogue  # the catalogue of the drive, its own files among it
    axes: tuple[Axis, ...]  # what varies
    ask: tuple[str, ...]  # names of questions
    reduce: tuple[Reduce, ...] = ()
    constraints: tuple[str, ...] = ()
    title: str = ""
    seed: int = 0
    rows: str = "kept"
    chunk: int | None = None  # rows worked on at a time
    device: Device = "cpu"
    engine: str = "in-process"  # one of `ENGINES`
    workers: int | None = None
    scheduler: str = ""  # address of the scheduler of a cluster
    # the tables of `KEYS` that are given, as they stand
    parts: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)

    def work(self, *, device: Device | None = None) -> SweepWork:
        """Return the sweep as work for an engine."""
        return work_of(
            self.drive,
            self.axes,
            self.ask,
            reduce=self.reduce,
            constraints=self.constraints,
            known=self.known,
            device=device or self.device,
            title=self.title,
        )


def read_plan(path: str | Path, *, catalogues: Sequence[str | Path] = ()) -> Plan:
    """Return the plan that a file describes. path: a ``.toml`` file, or ``.json`` with the same tables."""
    where = Path(path)
    text, form = text_of(where)
    return plan_of(text, folder=where.parent, form=form, name=str(where), catalogues=catalogues)


def plan_of(
    text: str,
    *,
    folder: str | Path | Enclosed = ".",
    form: str = "toml",
    name: str = "plan",
    catalogues: Sequence[str | Path] = (),
) -> Plan:
    """Return the plan that a text describes; see `read_plan`.

    text: the plan file; folder: where the drive file is looked for; form: ``"toml"`` or ``"json"``.
    """
    top = Table(given=parsed(text, form, name))
    if top.whole("format") != FORMAT and isinstance(top.given.get("format"), int):
        top.refuse(
            "format",
            _("{value} is not known; this program reads {format}").format(value=top.given["format"], format=FORMAT),
        )
    drive, known = _drive(top, folder_of(folder), catalogues)
    seed = top.whole("seed", 0)
    found = [axis_of(one, drive, seed + k) for k, one in enumerate(top.tables("vary"))]
    axes = [axis for axis in found if axis is not None]
    reduce = list(_reduces(top))
    constraints = _constraints(top)
    engine = top.table("engine")
    workers = engine.whole("workers", 0) or None
    if workers is not None and workers < 1:
        engine.refuse("workers", _("{given} given; at least one is needed").format(given=workers))
    chunk = engine.whole("chunk_rows", 0) or None
    if chunk is not None and chunk < 1:
        engine.refuse("chunk_rows", _("{given} given; at least one is needed").format(given=chunk))
    made: dict[str, Any] = {
        "engine": engine.text("kind", "in-process", choices=ENGINES),
        "scheduler": engine.text("scheduler", ""),
        "device": engine.text("device", "cpu", choices=("cpu", "gpu")),
    }
    if made["scheduler"] and made["engine"] != "cluster":
        engine.refuse("scheduler", _("only a cluster has a scheduler"))
    engine.finish()
    parts = {key: top.table(key).given for key in KEYS if top.has(key)}
    ask = top.texts("ask") if top.has("ask") else []
    _asks(top, ask, isinstance(drive, Mechanism))
    made |= {"title": top.text("title", ""), "rows": top.text("rows", "kept", choices=("kept", "none"))}
    top.finish()
    for k, axis in enumerate(found):
        if drive is not None and axis is not None:
            _angle_errors(top, f"vary[{k}]", drive, axis)
    check(top.problems)
    assert drive is not None
    return Plan(
        drive=drive,
        known=known,
        axes=tuple(axes),
        ask=tuple(ask),
        reduce=tuple(reduce),
        constraints=tuple(constraints),
        seed=seed,
        chunk=chunk,
        workers=workers,
        parts=parts,
        **made,
    )


def plan_text(drive: str, axes: Sequence[Axis], ask: Sequence[str]) -> str:
    """Return the text of a plan file; reading it gives an equal plan.

    drive: name of the drive file beside it; axes: what varies; ask: names of questions.
    """
    return toml_text({"format": FORMAT, "drive": drive, "ask": list(ask), "vary": [axis.told() for axis in axes]})


def _asks(top: Table, ask: Sequence[str], mechanism: bool) -> None:
    """Note names that are no question."""
    if not isinstance(top.given.get("ask", []), list):
        return
    try:
        asked(ask, mechanism=mechanism)
    except InputError as error:
        top.problems += error.problems


def _angle_errors(top: Table, path: str, drive: Drive | Mechanism, axis: Axis) -> None:
    """Note paths of an axis that lead nowhere in the drive."""
    try:
        spots_of(drive, [one for one in axis.fields if one not in axis.facts])
    except InputError as error:
        top.problems += [Problem(f"{path}: {one.field}", one.message, one.code) for one in error.problems]


def _drive(
    top: Table, folder: Path | Enclosed, catalogues: Sequence[str | Path]
) -> tuple[Drive | Mechanism | None, Any]:
    given = top.text("drive")
    if not given:
        if given == top.given.get("drive"):
            top.refuse("drive", _("names no file"))
        return None, None
    where = folder / given
    try:
        drive = load_either(where, catalogues=catalogues)
        if isinstance(drive, Mechanism):
            return drive, catalogue()
        return drive, known_to(drive, Path(str(where)).parent, catalogues)
    except InputError as error:
        top.problems += [Problem(f"drive: {one.field}", one.message, one.code) for one in error.problems]
        return None, None


def _reduces(top: Table) -> list[Reduce]:
    found = []
    for k, given in enumerate(top.items("reduce")):
        try:
            if isinstance(given, str):
                found.append(reduce_of(given))
            elif isinstance(given, dict):
                found.append(_reduce(Table(given=given, path=f"reduce[{k}]", problems=top.problems)))
            else:
                raise refuse("", _("a text or a table is needed"))
        except InputError as error:
            top.follow(f"reduce[{k}]", error)
    return found


def _reduce(one: Table) -> Reduce:
    kind = one.text("kind", choices=tuple(KINDS))
    ends = {key: one.number(key) if one.has(key) else None for key in ("low", "high")}
    made = Reduce(
        kind=kind,
        of=one.text("of", ""),
        by=tuple(one.texts("by")),
        where=tuple(limit_of(text) for text in one.texts("where")),
        percent=one.number("percent", 50.0),
        bins=one.whole("bins", BINS),
        name=one.text("name", ""),
        **ends,
    )
    one.finish()
    return made


def _constraints(top: Table) -> list[str]:
    kept = []
    for k, text in enumerate(top.texts("constraints")):
        try:
            limit_of(text)
            kept.append(text)
        except InputError as error:
            top.problems += [Problem(f"constraints[{k}]", one.message, one.code) for one in error.problems]
    return kept


# Axes of a plan file: grids, lists, rows of tables, designs drawn from distributions.


def axis_of(one: Table, drive: Drive | Mechanism | None, seed: int) -> Axis | None:
    """Return the axis that a table describes, None where something is wrong with it, which the table then notes.

    one: an entry of ``vary``.
    drive: whose values stand for what is not given; None where it could not be read.
    seed: of random numbers, where the table gives none.
    """
    before = len(one.problems)
    made: Axis | None
    try:
        if one.has("design"):
            made = _drawn(one, drive, seed)
        elif one.has("rows"):
            made = _rows(one)
        else:
            made = _single(one, drive)
    except InputError as error:
        one.follow("", error)
        made = None
    one.finish()
    return made if len(one.problems) == before else None


def _single(one: Table, drive: Drive | Mechanism | None) -> Axis | None:
    before = len(one.problems)
    key = one.text("key")
    if one.has("values"):
        values = one.items("values")
        return listed(drive, key, values) if drive is not None else None
    start, stop, count = one.number("from"), one.number("to"), one.whole("count")
    return GridAxis(field=key, start=start, stop=stop, count=count) if len(one.problems) == before else None


def _rows(one: Table) -> Axis | None:
    name = one.text("name")
    facts = one.texts("facts")
    rows = [dict(row.given) for row in one.tables("rows", required=True)]
    _some(one, "rows")
    keys = list(rows[0]) if rows else []
    for k, row in enumerate(rows):
        for key in {*keys, *row} - ({*keys} & {*row}):
            one.refuse(f"rows[{k}]", _("{key}: every row gives the same keys").format(key=key))
    if not rows or any(set(row) != set(keys) for row in rows):
        return None
    fields: list[str] = []
    columns: list[list[Any]] = []
    for key in keys:
        paths, parts = spread_out(key, [row[key] for row in rows])
        fields += [name if key == "name" else path for path in paths]
        columns += [list(column) for column in zip(*parts, strict=True)]
    unknown = [fact for fact in facts if fact not in keys]
    if unknown:
        one.refuse("facts", _("no row gives {names}").format(names=", ".join(unknown)))
    said = tuple(
        name if fact == "name" else fact for fact in dict.fromkeys([*facts, *(["name"] if "name" in keys else [])])
    )
    return TableAxis(fields=tuple(fields), rows=tuple(zip(*columns, strict=True)), name=name, facts=said)


def _drawn(one: Table, drive: Drive | Mechanism | None, seed: int) -> Axis | None:
    method = one.text("design", choices=METHODS)
    name, count, own = one.text("name", "draw"), one.whole("count"), one.whole("seed", seed)
    distributions: dict[str, Distribution] = {}
    for spot in one.tables("fields", required=True):
        found = _distribution(spot, drive)
        if found is not None:
            if found[0] in distributions:
                spot.refuse("key", _("varies twice"))
            distributions[found[0]] = found[1]
    _some(one, "fields")
    correlations = []
    for k, row in enumerate(one.items("correlations")):
        if isinstance(row, list) and len(row) == 3 and isinstance(row[2], int | float) and abs(row[2]) <= 1:
            correlations.append((str(row[0]), str(row[1]), float(row[2])))
        else:
            one.refuse(f"correlations[{k}]", _('is not a correlation; write ["one key", "another key", 0.5]'))
    if one.problems or not distributions:
        return None
    return SampledAxis(
        distributions=distributions,
        count=count,
        seed=own,
        method=method,  # type: ignore[arg-type]
        correlations=tuple(correlations),
        name=name,
    )


def _some(one: Table, key: str) -> None:
    """Note an empty list."""
    if one.given.get(key) == []:
        one.refuse(key, _("an empty list has no values to vary over"))


def _distribution(spot: Table, drive: Drive | Mechanism | None) -> tuple[str, Distribution] | None:
    """Return the path of a field and its distribution; a mean not given is the drive's own value."""
    key, kind = spot.text("key"), spot.text("distribution", choices=tuple(DISTRIBUTIONS))
    cls = DISTRIBUTIONS.get(kind)
    here: float | None = None
    if key and drive is not None:
        try:
            here = present(drive, key)
        except InputError as error:
            spot.follow("key", error)
            return None
    if cls is None:
        return None
    values: dict[str, float] = {}
    if spot.has("plus_minus"):
        width = spot.number("plus_minus")
        if here is None:
            spot.refuse("plus_minus", _("the drive has no value there; give low and high"))
        else:
            values = {"low": here - width, "high": here + width}
    for name in (one.name for one in fields(cls)):
        if name in values:
            continue
        middle = here if name in ("mean", "mode") else None
        values[name] = spot.number(name, middle)
    spot.finish()
    try:
        return key, cls(**values)
    except InputError as error:
        spot.follow("", error)
        return None
