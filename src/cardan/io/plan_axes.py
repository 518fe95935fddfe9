"""Axes of a plan file: grids, lists, rows of tables, designs drawn from distributions."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from cardan.batch.plan import listed
from cardan.batch.points.axes import Axis, GridAxis, SampledAxis, TableAxis
from cardan.batch.points.designs import METHODS
from cardan.batch.points.distributions import DISTRIBUTIONS, Distribution
from cardan.batch.points.fields import present, spread_out
from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.reading.table import Table
from cardan.texts import _


def axis_of(one: Table, drive: Drive | None, seed: int) -> Axis | None:
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


def _single(one: Table, drive: Drive | None) -> Axis | None:
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


def _drawn(one: Table, drive: Drive | None, seed: int) -> Axis | None:
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


def _distribution(spot: Table, drive: Drive | None) -> tuple[str, Distribution] | None:
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
