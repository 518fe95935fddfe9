"""What is said of the catalogue: its tables, their rows, the keys of a row, a file of rows that is right."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.answers.reader import Reader, reader
from cardan.texts import _, mark, plural
from cardan.units import preferred

from .catalogue import Catalogue, catalogue
from .rows import TABLES, Row, row_flat, row_keys, row_tree

HIDDEN = ("confidence", "names", "russian", "uses", "parts", "family", "pair_mobility", "poisson", "density_kg_m3")
"""Keys that stand only in a single row and in files."""

SHOWN = {
    "materials": ("european", "american", "yield_strength_MPa", "ultimate_strength_MPa"),
    "joint_types": ("synchronous", "max_joint_angle_deg", "min_torque_Nm", "max_torque_Nm", "max_speed_angle_rpm_deg"),
    "laminae": ("name", "youngs_1_MPa", "youngs_2_MPa", "shear_12_MPa", "tension_1_MPa"),
    "joint_sizes": (
        "series",
        "rating.outer_mm",
        "rating.torque_Nm",
        "rating.max_torque_Nm",
        "rating.max_joint_angle_deg",
        "rating.max_speed_rpm",
    ),
    "bearings": ("bore_mm", "outer_mm", "width_mm", "capacity_N", "static_capacity_N", "max_speed_rpm", "mass_kg"),
    "shaft_seals": ("seal_diameter_mm", "outer_mm", "width_mm"),
    "faults": ("orders", "torque_sensitive", "flags"),
}
"""Table -> keys that stand for people, where not all of them fit."""

UNITS = {"lubrication": {"time": "h", "length": "km"}}
"""Table -> units in which its rows are told where whoever looks chose none."""

WIDE, BRIEF = 18, 5  # widest text, and how many keys, of other tables for people

SURE = {
    "confirmed": mark("confirmed by the source"),
    "recalled": mark("usual values, not confirmed; look them up"),
    "not_confirmed": mark("not confirmed"),
    "book": mark("as the book has it"),
    "derived": mark("derived from other rows"),
    "beyond": mark("typical values of the trade; take the maker's"),
    "made_up": mark("made up for examples"),
}
"""How sure a row is, in words."""


def answer(known: Catalogue) -> Answer:
    """Return what tables a catalogue has."""
    kinds = [_((kind.__doc__ or "").strip().splitlines()[0]).rstrip(".") for kind in TABLES.values()]
    counts = [len(known.tables.get(name, {})) for name in TABLES]
    text = _("{count} rows in {tables} tables, each with its source.")
    return Answer(
        name="catalogue",
        title=_("Catalogue"),
        sentence=text.format(count=sum(len(one) for one in known.tables.values()), tables=len(TABLES)),
        tables=(
            Table(
                name="tables",
                records=True,
                columns=(
                    Column(key="table", heading=_("table"), values=list(TABLES)),
                    Column(key="rows", heading=_("rows"), values=counts),
                    Column(key="what", heading=_("what it holds"), values=kinds, wrap=True),
                ),
            ),
        ),
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
    )


def answer_of_table(known: Catalogue, name: str) -> Answer:
    """Return the rows of a table: the most important for people, for programs as a file has them."""
    who = _looking(name)
    rows = list(known.tables.get(name, {}).values())
    usual = [row_flat(row) for row in rows]
    every = [key for key in dict.fromkeys(key for one in usual for key in one) if key not in ("note", "source")]
    brief = [key for key in every if key not in HIDDEN and all(len(str(one.get(key, ""))) <= WIDE for one in usual)]
    brief = ["id", *(SHOWN.get(name) or [key for key in brief if key != "id"][:BRIEF])]
    text = plural("{table}: one row.", "{table}: {count} rows.", len(rows))
    return Answer(
        name="catalogue",
        title=_("Catalogue"),
        sentence=text.format(table=name, count=len(rows)),
        tables=(
            Table(
                columns=(
                    *_columns(name, brief, rows, who),
                    Column(key="", heading=_("how sure"), values=[row.confidence for row in rows], left=True),
                )
            ),
        ),
        remarks=(
            Remark(
                text=_("One row with its source:"),
                command=("cardan", "catalogue", name, rows[0].id if rows else "--keys"),
                tone="next",
            ),
        ),
        facts={"table": name, "rows": [row_tree(row, who.units) for row in rows]},
        full=lambda: _as_filed([row_flat(row, who.units) for row in rows]),
    )


def answer_of_search(known: Catalogue, words: str, found: Mapping[str, Sequence[Row]]) -> Answer:
    """Return the rows in which words stand: those of one table as it is told, of several by name and source."""
    if len(found) == 1:
        ((name, rows),) = found.items()
        if len(rows) == 1:
            return answer_of_row(known, name, rows[0])
        return answer_of_table(replace(known, tables={**known.tables, name: {row.id: row for row in rows}}), name)
    every = [(name, row) for name, rows in found.items() for row in rows]
    text = _("{words}: {count} rows in {tables} tables.")
    return Answer(
        name="catalogue",
        title=_("Catalogue"),
        sentence=text.format(words=words, count=len(every), tables=len(found)),
        tables=(
            Table(
                name="rows",
                records=True,
                columns=(
                    Column(key="table", heading=_("table"), values=[name for name, _row in every]),
                    Column(key="id", heading=_("row"), values=[row.id for _name, row in every], left=True),
                    Column(key="source", heading=_("source"), values=[row.source for _name, row in every], wrap=True),
                ),
            ),
        ),
        remarks=(
            Remark(
                text=_("One row with its source:"),
                command=("cardan", "catalogue", every[0][0], every[0][1].id),
                tone="next",
            ),
        ),
    )


def _looking(name: str) -> Reader:
    """Return who looks at a table, in its units where no others are chosen."""
    who = reader()
    return replace(who, units={**UNITS.get(name, {}), **who.units})


def _columns(name: str, keys: Sequence[str], rows: Sequence[Row], who: Reader) -> Iterator[Column]:
    """Yield columns of a table for people, in the units of whoever looks."""
    dimensions = {one.key: one.dimension for one in row_keys(name)}
    flat = [row_flat(row, who.units) for row in rows]
    for key in keys:
        dimension = dimensions.get(key, "")
        unit, factor = who.unit(dimension) if dimension else ("", 1.0)
        bare = key.removesuffix(f"_{preferred(dimension)}") if dimension else key
        values = [one.get(f"{bare}_{unit}" if dimension else key) for one in flat]
        yield Column(
            key="",
            heading=bare.rpartition(".")[2].replace("_", " "),
            values=[value * factor if isinstance(value, float) else value for value in values],
            dimension=dimension,
            unit=unit,
            trim=True,
            left=key == "id" or any(isinstance(value, str) for value in values),
        )


def _as_filed(flat: Sequence[Mapping[str, Any]]) -> Table:
    """Return rows with the keys of a file as a table."""
    keys = dict.fromkeys(key for one in flat for key in one)
    return Table(columns=[Column(key=key, values=[one.get(key) for one in flat]) for key in keys])


def answer_of_row(known: Catalogue, name: str, row: Row) -> Answer:
    """Return one row, with its source and how sure it is."""
    who = _looking(name)
    flat = row_flat(row, who.units)
    shown = {key: _said(value, who) for key, value in flat.items() if key not in ("source", "note", "confidence")}
    source = _("Source: {source}. How sure: {sure}.").format(source=row.source, sure=_(SURE[row.confidence]))
    remarks = [Remark(text=source)]
    if row.note:
        remarks.append(Remark(text=_("Note: {note}.").format(note=row.note.rstrip("."))))
    return Answer(
        name="catalogue",
        title=_("Catalogue"),
        sentence=_("{table}: {id}.").format(table=name, id=row.id),
        tables=(
            Table(
                fixed=0,
                columns=(
                    Column(key="", heading=_("key"), values=list(shown)),
                    Column(key="", heading=_("value"), values=list(shown.values()), left=True, wrap=True),
                ),
            ),
        ),
        remarks=tuple(remarks),
        facts={"table": name, "row": row_tree(known.tables[name][row.id], who.units)},
        full=lambda: _as_filed([flat]),
    )


def _said(value: Any, who: Reader) -> str:
    """Return a value for people, the number as it was given."""
    if isinstance(value, bool):
        return _("yes") if value else _("no")
    return who.signed(f"{value:.10g}") if isinstance(value, float) else str(value)


def answer_of_keys(name: str) -> Answer:
    """Return the keys that a row of a table can have."""
    keys = list(row_keys(name))
    text = _("{table}: a row can have {count} keys; any unit of the dimension is read.")
    return Answer(
        name="catalogue",
        title=_("Catalogue"),
        sentence=text.format(table=name, count=len(keys)),
        tables=(
            Table(
                name="keys",
                records=True,
                fixed=0,
                columns=(
                    Column(key="key", heading=_("key"), values=[one.key for one in keys]),
                    Column(key="needed", heading=_("needed"), values=[one.needed for one in keys]),
                    Column(key="meaning", heading=_("meaning"), values=[one.meaning for one in keys], wrap=True),
                ),
            ),
        ),
        facts={"table": name},
    )


def answer_of_file(path: Path, found: Catalogue) -> Answer:
    """Return what a file of rows holds that is right."""
    base = catalogue().tables
    own = found.tables
    instead = [", ".join(key for key in rows if key in base.get(name, {})) for name, rows in own.items()]
    count = sum(len(rows) for rows in own.values())
    text = plural("{file}: one row, nothing wrong.", "{file}: {count} rows, nothing wrong.", count)
    use = _('Use it with --catalogue, or name it in a drive file: [settings] catalogues = ["{file}"]')
    return Answer(
        name="catalogue",
        title=_("Catalogue"),
        sentence=text.format(file=path, count=count),
        tone="good",
        tables=(
            Table(
                columns=(
                    Column(key="table", heading=_("table"), values=list(own)),
                    Column(key="rows", heading=_("rows"), values=[len(rows) for rows in own.values()]),
                    Column(key="ids", heading=_("ids"), values=[", ".join(rows) for rows in own.values()]),
                    Column(key="replaces", heading=_("in place of shipped ones"), values=instead, wrap=True),
                )
            ),
        ),
        remarks=(Remark(text=use.format(file=path.name)),),
        facts={"file": str(path), "tables": {name: list(rows) for name, rows in own.items()}},
    )
