"""``cardan catalogue``: what the catalogue knows, where it is from, and whether a file of rows is right."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural

from .options import AsCsv, AsJson, MoreRows

if TYPE_CHECKING:
    from cardan.catalogue import Catalogue
    from cardan.catalogue.rows import Row

    from .answer import Answer, Cell


HIDDEN = ("confidence", "names", "russian", "uses", "parts", "family", "pair_mobility", "poisson", "density_kg_m3")
"""Keys that stand only in a single row, in `--csv` and in `--json`."""

SHOWN = {
    "materials": ("european", "american", "yield_strength_MPa", "ultimate_strength_MPa"),
    "joint_types": ("synchronous", "max_bend_deg", "min_torque_Nm", "max_torque_Nm", "max_speed_angle_rpm_deg"),
    "joint_sizes": (
        "rating.outer_mm",
        "mass_kg",
        "rating.torque_Nm",
        "rating.max_torque_Nm",
        "rating.max_bend_deg",
        "rating.max_speed_rpm",
    ),
    "faults": ("orders", "torque_sensitive", "flags"),
}
"""Table -> keys that stand in the terminal, where not all of them fit."""

WIDE, BRIEF = 18, 5
"""Widest text, and how many keys, of other tables in the terminal."""


def catalogue(
    table: Annotated[
        str | None,
        typer.Argument(metavar="[TABLE]", help=_("A table; all of them are listed without one."), show_default=False),
    ] = None,
    row: Annotated[
        str | None,
        typer.Argument(
            metavar="[ID]", help=_("A row of the table; materials by any of their names."), show_default=False
        ),
    ] = None,
    checked: Annotated[
        Path | None,
        typer.Option(
            "--check",
            metavar="FILE",
            help=_("Check a catalogue file of your own, every problem at once."),
            show_default=False,
        ),
    ] = None,
    keys: Annotated[
        bool, typer.Option("--keys", help=_("List the keys that a row of the table can have."), show_default=False)
    ] = False,
    more: MoreRows = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Show the tables of the catalogue, their rows, and each row with its source and how sure it is."""
    from .show import check_common, show

    check_common(json=json, csv=csv)

    from cardan.catalogue import catalogue as shipped
    from cardan.catalogue import with_files

    if checked is not None:
        return show(_checked(checked), json=json, csv=csv)
    files = tuple(more or ())
    known = with_files(shipped(), files) if files else shipped()
    if table is None:
        return show(_listing(known), json=json, csv=csv)
    name = _named(table)
    if keys:
        return show(_keys(name), json=json, csv=csv)
    if row is None:
        return show(_table(known, name), json=json, csv=csv)
    return show(_row(known, name, row), json=json, csv=csv)


def _named(table: str) -> str:
    """Return the name of a table, or refuse with the nearest."""
    from cardan.catalogue import TABLES
    from cardan.errors import refuse
    from cardan.units import nearest

    if table in TABLES:
        return table
    near = nearest(table, TABLES)
    text = _("{table} is not a table; the tables are {known}").format(table=repr(table), known=", ".join(TABLES))
    raise refuse("TABLE", text + (_("; the nearest is {near}").format(near=near) if near else ""))


def _listing(known: Catalogue) -> Answer:
    from cardan.catalogue import TABLES

    from .answer import Answer, Column, Remark, Table

    rows: list[list[Cell]] = []
    for name, kind in TABLES.items():
        doc = _((kind.__doc__ or "").strip().splitlines()[0]).rstrip(".")
        rows.append([name, len(known.tables.get(name, {})), doc])
    columns = (
        Column(key="table", heading=_("table"), left=True),
        Column(key="rows", heading=_("rows")),
        Column(key="what", heading=_("what it holds"), left=True, wrap=True),
    )
    table = Table(columns=columns, rows=rows)
    count = sum(len(one) for one in known.tables.values())
    return Answer(
        sentence=_("{count} rows in {tables} tables, each with its source.").format(count=count, tables=len(rows)),
        tables=lambda: [table],
        remarks=(
            Remark(
                text=_("A row, by any of its names:"), command=("cardan", "catalogue", "materials", "C45"), tone="next"
            ),
            Remark(
                text=_("What a row of your own can say:"),
                command=("cardan", "catalogue", "joint_sizes", "--keys"),
                tone="next",
            ),
        ),
        content=lambda: {"tables": [dict(zip(("table", "rows", "what"), row, strict=True)) for row in rows]},
        csv=lambda: table,
    )


def _table(known: Catalogue, name: str) -> Answer:
    from cardan.catalogue.telling import row_flat, row_tree

    from .answer import Answer, Column, Remark, Table

    rows = known.tables.get(name, {})
    shown = [row_flat(row) for row in rows.values()]
    keys = list(dict.fromkeys(key for one in shown for key in one))
    plain = [key for key in keys if key not in ("note", "source")]
    brief = [key for key in plain if key not in HIDDEN and all(len(str(one.get(key, ""))) <= WIDE for one in shown)]
    brief = ["id", *(SHOWN.get(name) or [key for key in brief if key != "id"][:BRIEF])]

    def columns(names: list[str]) -> tuple[Column, ...]:
        return tuple(
            Column(
                key=key,
                heading=_headed(key)[0],
                unit=_headed(key)[1],
                left=key == "id" or any(isinstance(one.get(key), str) for one in shown),
            )
            for key in names
        )

    short = Table(
        columns=(*columns(brief), Column(key="confidence", heading=_("how sure"), left=True)),
        rows=[[*(one.get(key) for key in brief), one["confidence"]] for one in shown],
    )
    whole = Table(columns=columns(keys), rows=[[one.get(key) for key in keys] for one in shown])
    text = plural("{table}: one row.", "{table}: {count} rows.", len(shown))
    command = ("cardan", "catalogue", name, shown[0]["id"]) if shown else ("cardan", "catalogue", name, "--keys")
    return Answer(
        sentence=text.format(table=name, count=len(shown)),
        tables=lambda: [short],
        remarks=(Remark(text=_("One row with its source:"), command=tuple(map(str, command)), tone="next"),),
        content=lambda: {"table": name, "rows": [row_tree(row) for row in rows.values()]},
        csv=lambda: whole,
    )


def _headed(key: str) -> tuple[str, str]:
    """Return what stands above the column of a key: its name and its unit.

    Examples
    --------
    >>> _headed("rating.max_torque_Nm"), _headed("european")
    (('max torque', 'N·m'), ('european', ''))
    """
    from cardan.units import DIMENSIONS, label

    word = key.rpartition(".")[2]
    units = sorted({unit for known in DIMENSIONS.values() for unit in known}, key=len, reverse=True)
    unit = next((one for one in units if word.endswith(f"_{one}")), "")
    return word.removesuffix(f"_{unit}").replace("_", " "), label(unit)


def _row(known: Catalogue, name: str, wanted: str) -> Answer:
    from cardan.catalogue.rows import TABLES, Grade
    from cardan.catalogue.telling import row_flat, row_tree
    from cardan.errors import refuse
    from cardan.units import nearest

    from .answer import Answer, Column, Remark, Table

    rows = known.table(name, TABLES[name])
    row: Row
    if TABLES[name] is Grade:
        row = known.grade(wanted, field="ID")
    elif wanted in rows:
        row = rows[wanted]
    else:
        near = nearest(wanted, rows)
        text = _("{name} is not in {table}").format(name=repr(wanted), table=name)
        raise refuse("ID", text + (_("; the nearest is {near}").format(near=near) if near else ""))
    flat = row_flat(row)
    table = Table(
        columns=(
            Column(key="key", heading=_("key"), left=True),
            Column(key="value", heading=_("value"), left=True, wrap=True),
        ),
        rows=[[key, _said(value)] for key, value in flat.items() if key not in ("source", "note", "confidence")],
    )
    remarks = [
        Remark(text=_("Source: {source}. How sure: {sure}.").format(source=row.source, sure=SURE[row.confidence]))
    ]
    if row.note:
        remarks.append(Remark(text=_("Note: {note}.").format(note=row.note.rstrip("."))))
    return Answer(
        sentence=_("{table}: {id}.").format(table=name, id=row.id),
        tables=lambda: [table],
        remarks=tuple(remarks),
        content=lambda: {"table": name, "row": row_tree(known.tables[name][row.id])},
        csv=lambda: Table(columns=tuple(Column(key=key) for key in flat), rows=[list(flat.values())]),
    )


SURE = {
    "confirmed": _("confirmed by the source"),
    "recalled": _("usual values, not confirmed; look them up"),
    "not_confirmed": _("not confirmed"),
    "book": _("as the book has it"),
    "derived": _("derived from other rows"),
    "beyond": _("typical values of the trade; take the maker's"),
    "made_up": _("made up for examples"),
}
"""How sure a row is, in words."""


def _said(value: Any) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def _keys(name: str) -> Answer:
    from cardan.catalogue.telling import row_keys

    from .answer import Answer, Column, Table

    rows: list[list[Cell]] = [list(one) for one in row_keys(name)]
    columns = (
        Column(key="key", heading=_("key"), left=True),
        Column(key="needed", heading=_("needed")),
        Column(key="meaning", heading=_("meaning"), left=True, wrap=True),
    )
    table = Table(columns=columns, rows=rows)
    return Answer(
        sentence=_("{table}: a row can have {count} keys; any unit of the dimension is read.").format(
            table=name, count=len(rows)
        ),
        tables=lambda: [table],
        content=lambda: {
            "table": name,
            "keys": [dict(zip(("key", "needed", "meaning"), one, strict=True)) for one in rows],
        },
        csv=lambda: table,
    )


def _checked(path: Path) -> Answer:
    from cardan.catalogue import Catalogue, with_files
    from cardan.catalogue import catalogue as shipped
    from cardan.errors import InputError

    from .answer import Answer, Column, Remark, Table
    from .failure import about

    with about(str(path)):
        try:
            found = with_files(Catalogue(tables={}), [path])
        except InputError as error:
            raise error.renamed(lambda field: field.removeprefix(f"{path}: ").removeprefix(f"{path}.")) from error
    base = shipped().tables
    rows: list[list[Cell]] = [
        [name, len(own), ", ".join(own), ", ".join(key for key in own if key in base.get(name, {}))]
        for name, own in found.tables.items()
    ]
    columns = (
        Column(key="table", heading=_("table"), left=True),
        Column(key="rows", heading=_("rows")),
        Column(key="ids", heading=_("ids"), left=True),
        Column(key="replaces", heading=_("in place of shipped ones"), left=True, wrap=True),
    )
    table = Table(columns=columns, rows=rows)
    count = sum(len(own) for own in found.tables.values())
    text = plural("{file}: one row, nothing wrong.", "{file}: {count} rows, nothing wrong.", count)
    return Answer(
        sentence=text.format(file=path, count=count),
        tone="good",
        tables=lambda: [table],
        remarks=(
            Remark(
                text=_(
                    'Use it with --catalogue, or name it in a drive file: [settings] catalogues = ["{file}"]'
                ).format(file=path.name)
            ),
        ),
        content=lambda: {"file": str(path), "tables": {name: list(own) for name, own in found.tables.items()}},
        csv=lambda: table,
    )
