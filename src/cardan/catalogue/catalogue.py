"""The catalogue: materials, types and sizes of joints, norms, faults; the shipped rows and those of a user's files."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from functools import cache, lru_cache
from importlib.resources import files
from pathlib import Path
from typing import Any, TypeVar

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import NAMED, spelled
from cardan.drive.material import Material
from cardan.drive.shaft import Ply
from cardan.errors import InputError, Problem, check, refuse
from cardan.files import Enclosed, folder_of, refusal
from cardan.reading.limits import check_text
from cardan.reading.scalar import nearest_of
from cardan.reading.tree import Form, read_table
from cardan.texts import _, language

from .rows import TABLES, Grade, JointSize, Lamina, Row, row_tree, told
from .sheets import tree_of

R = TypeVar("R", bound=Row)

NEAR = 3  # names told of where one is not there
SHOWN = 6  # grades told of that a name stands for

STRENGTH = re.compile(r"[sepl](\d{3})(?!\d)")
"""Names of steels that say their yield strength [MPa]: structural, of machines, of pressure vessels, of line pipe."""

STEEL = 7000.0  # what metals that count as steel weigh at least [kg/m³]

NORMS = (
    "angle_norms",
    "speed_angle_limits",
    "max_joint_angles",
    "angle_pairs",
    "balance_norms",
    "balance_grades",
    "part_limits",
    "lubrication",
    "life_factors",
    "speed_angle_factors",
)
FILES: Mapping[str, tuple[str, ...]] = {
    "materials": ("materials", "laminae"),
    "joint_types": ("joint_types",),
    "example_sizes": ("joint_sizes",),
    "joint_sizes": ("joint_sizes",),
    "bearings": ("bearings",),
    "shaft_seals": ("shaft_seals",),
    "norms": NORMS,
    "limits": ("limits",),
    "factors": ("factors",),
    "faults": ("faults",),
}
"""Shipped files, beside this one, and the tables in each; rows of one table may stand in several files."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Catalogue:
    """Rows by table and id; its methods tell them in the language spoken here."""

    tables: Mapping[str, Mapping[str, Row]]  # name of the table -> id -> row, as its file has it

    def rows(self, cls: type[R]) -> Mapping[str, R]:
        """Return the rows of the first table of a class, by id."""
        name = next(name for name, kind in TABLES.items() if kind is cls)
        return self.table(name, cls)

    def table(self, name: str, cls: type[R]) -> Mapping[str, R]:
        """Return the rows of a table, by id."""
        assert TABLES[name] is cls
        if language() == "en":
            return self.tables.get(name, {})  # type: ignore[return-value]
        return _told(self, name, language())  # type: ignore[return-value]

    def row(self, cls: type[R], name: str, *, field: str = "id") -> R:
        """Return a row by its id.

        Raises
        ------
        InputError
            No row has it; the message names the nearest.
        """
        rows = self.rows(cls)
        if name in rows:
            return rows[name]
        text = _("{name} is not in the catalogue").format(name=repr(name))
        raise refuse(field, text + _near(name, {one: one for one in rows}), "unknown_key")

    def offered(self, size: str = "") -> tuple[JointSize, ...]:
        """Return the sizes to choose from, the smallest first: of the series of a size, else all but made-up ones.

        Rows of a user without a series are always among them.
        """
        rows = self.rows(JointSize)
        series = rows[size].series if size in rows else ""
        fits = [one for one in rows.values() if (one.series in ("", series) if series else one.confidence != "made_up")]
        return tuple(sorted(fits, key=lambda one: (one.space, one.mass or math.inf, one.id)))

    def grade(self, name: str, *, field: str = "material") -> Grade:
        """Return a grade by its id, or by its name in another standard: of the first row that has it.

        Raises
        ------
        InputError
            No grade has the name; the message names the nearest ones.

        Examples
        --------
        >>> catalogue().grade("C22").id
        '20'
        """
        rows = self.rows(Grade)
        # A row added later takes over no name of an earlier one, but for its own id.
        by_name = {other.casefold(): row for row in reversed(list(rows.values())) for other in row.every_name}
        by_name |= {row.id.casefold(): row for row in rows.values()}
        found = by_name.get(name.casefold())
        if found is not None:
            return found
        text = _("{name} is not in the catalogue").format(name=repr(name))
        raise refuse(field, text + _like(name.casefold(), list(rows.values())), "unknown_key")


@lru_cache(maxsize=256)
def _told(known: Catalogue, name: str, _code: str) -> Mapping[str, Row]:
    """Return the rows of a table in a language, which is the one spoken here."""
    return {id: told(row) for id, row in known.tables.get(name, {}).items()}


def _like(name: str, rows: Sequence[Grade]) -> str:
    """Return which grades are meant by a name that none has: by its standard, else by the strength it says."""
    meant = [row.id for row in rows if any(one.casefold().startswith(name) for one in row.every_name)]
    if meant:
        text = _(" by that name alone: name its state of delivery or its thickness, as in {grades}")
        return text.format(grades=", ".join(meant[:SHOWN]) + (" …" if len(meant) > SHOWN else ""))
    said = STRENGTH.match(name)
    if said is None:
        every = [other for row in rows for other in row.every_name]
        return _near(name, {other.casefold(): other for other in every if other[:1].casefold() == name[:1]})
    strength = 1e6 * float(said[1])
    steels = [row for row in rows if row.yield_strength and row.density > STEEL]
    strong = sorted(steels, key=lambda row: abs((row.yield_strength or 0.0) - strength))
    text = _("; nearest to its yield strength of {strength} MPa are {grades}")
    return text.format(strength=said[1], grades=", ".join(row.id for row in strong[:NEAR]))


def _near(name: str, spelled: Mapping[str, str]) -> str:
    """Return which names are most like one that is not there, as the end of a sentence; "" where none is."""
    found = [spelled[one] for one in get_close_matches(name, list(spelled), n=NEAR, cutoff=0.6)]
    if not found:
        return ""
    text = _("; the nearest is {near}").format(near=found[0])
    return text + (_(", then {others}").format(others=", ".join(found[1:])) if len(found) > 1 else "")


class Shipped(Mapping[str, Mapping[str, Row]]):
    """Tables of the shipped files; a table is read when it is first asked for: a command needs few of them."""

    def __init__(self) -> None:
        self._names = tuple(dict.fromkeys(name for names in FILES.values() for name in names))
        self._read: dict[str, Mapping[str, Row]] = {}

    def __getitem__(self, name: str) -> Mapping[str, Row]:
        if name not in self._names:
            raise KeyError(name)
        if name not in self._read:
            rows = [row for file, names in FILES.items() if name in names for row in shipped_file(file)[name]]
            tables, problems = rows_of({name: rows})
            check(problems)
            self._read[name] = tables[name]
        return self._read[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __repr__(self) -> str:  # sweeps are named by all that decides their rows
        return repr(dict(self))


@cache
def shipped_file(name: str) -> Mapping[str, Any]:
    """Return a shipped file as it stands: tables of rows."""
    return tomllib.loads(files(__package__).joinpath(f"{name}.toml").read_text(encoding="utf-8"))


@cache
def catalogue() -> Catalogue:
    """Return the shipped catalogue.

    Examples
    --------
    >>> catalogue().grade("45").yield_strength
    355000000.0
    """
    return Catalogue(tables=Shipped())


def with_files(base: Catalogue, paths: Iterable[str | Path]) -> Catalogue:
    """Return a catalogue with the rows of a user's files added; a row of theirs replaces a shipped one of its id.

    paths: TOML files with the tables of the catalogue; CSV files and workbooks as `cardan.catalogue.sheets` has them.
    Raises InputError: a file cannot be read, or holds what is no row; every problem at once.
    """
    tables = {name: dict(rows) for name, rows in base.tables.items()}
    problems: list[Problem] = []
    for path in paths:
        try:
            tree = _tree(Path(path))
        except InputError as error:
            problems += [replace(one, field=one.field or str(path)) for one in error.problems]
            continue
        except OSError as error:
            problems.append(Problem(str(path), _("cannot be read: {why}").format(why=refusal(error))))
            continue
        except ValueError as error:
            problems.append(Problem(str(path), _("is not TOML: {why}").format(why=error)))
            continue
        rows, wrong = rows_of(tree)
        problems += [Problem(f"{path}: {problem.field}", problem.message) for problem in wrong]
        for name, new in rows.items():
            tables.setdefault(name, {}).update(new)
    check(problems)
    return Catalogue(tables=tables)


def _tree(path: Path) -> Mapping[str, Any]:
    """Return the tables of a user's file."""
    if path.suffix.lower() in (".csv", ".xlsx"):
        return tree_of(path)
    text = path.read_text(encoding="utf-8")
    check_text(text, str(path), counts=False)
    return tomllib.loads(text)


def known_to(drive: Drive, folder: str | Path | Enclosed = ".", catalogues: Sequence[str | Path] = ()) -> Catalogue:
    """Return the catalogue of a drive: the shipped one and the files that its settings name.

    folder: where the files are looked for; catalogues: further files, by their own paths.
    """
    paths = [*(folder_of(folder) / name for name in drive.settings.catalogues), *catalogues]
    return with_files(catalogue(), paths) if paths else catalogue()


def material(name: str, *, known: Catalogue | None = None) -> Material:
    """Return the material of a grade.

    name: id of the grade, or its name in another standard; known: the shipped one when not given.
    Raises InputError: no grade has the name.

    >>> material("C45").yield_strength
    355000000.0
    """
    row = (known or catalogue()).grade(name)
    hardness = row.hardness_brinell
    return Material(
        grade=name,
        density=row.density,
        youngs=row.youngs,
        shear=row.shear,
        poisson=row.poisson,
        yield_strength=row.yield_strength,
        ultimate_strength=row.ultimate_strength,
        hardness=None if hardness is None else 0.5 * (hardness[0] + hardness[1]),
    )


def found(known: Catalogue, words: str, only: str = "") -> dict[str, list[Row]]:
    """Return the rows in whose names, uses, source or note all words stand, table by table.

    only: a table that is searched alone.

    >>> [row.id for row in found(catalogue(), "GWB 687.15")["joint_sizes"]]
    ['gwb-687.15']
    """
    wanted = words.casefold().split()
    hits = {}
    for name in [only] if only else known.tables:
        rows = [row for row in known.table(name, TABLES[name]).values() if _stands(wanted, row)]
        if rows:
            hits[name] = rows
    return hits


def _stands(wanted: Sequence[str], row: Row) -> bool:
    text = str(list(row_tree(row).values())).casefold()
    return all(word in text for word in wanted)


def ply(name: str, *, known: Catalogue | None = None, field: str = "ply") -> Ply:
    """Return the ply of a lamina.

    name: id of the lamina; known: the shipped catalogue when not given; field: what is refused.
    Raises InputError: no lamina has the name, or it has no shear modulus.

    >>> ply("CFRP-HT-UD").tension_along
    1500000000.0
    """
    row = (known or catalogue()).row(Lamina, name, field=field)
    if row.shear_12 is None:
        raise refuse(field, _("{name} has no shear modulus; give the figures of the ply").format(name=name), "missing")
    made = Ply(
        grade=name,
        along=row.youngs_1,
        across=row.youngs_2,
        shear=row.shear_12,
        tension_along=row.tension_1,
        compression_along=row.compression_1,
        tension_across=row.tension_2,
        compression_across=row.compression_2,
        shear_strength=row.shear_strength,
    )
    made = made if row.poisson_12 is None else replace(made, poisson=row.poisson_12)
    return made if row.density is None else replace(made, density=row.density)


# From the tables of a catalogue file to rows, every problem at once.

FORM = Form(spelled=spelled, named=NAMED)


def rows_of(tree: Mapping[str, Any]) -> tuple[dict[str, dict[str, Row]], list[Problem]]:
    """Return the rows of the tables of a file by table and id, and all that is wrong with it."""
    found: dict[str, dict[str, Row]] = {}
    problems: list[Problem] = []
    for name, rows in tree.items():
        if name not in TABLES:
            text = _("unknown table; the tables are {known}").format(known=", ".join(TABLES))
            problems.append(Problem(name, text + nearest_of(name, TABLES)))
        elif not isinstance(rows, list) or not all(isinstance(row, Mapping) for row in rows):
            problems.append(Problem(name, _("must be tables, each under [[{key}]]").format(key=name)))
        else:
            found[name] = {}
            for k, table in enumerate(rows):
                row, wrong = read_table(TABLES[name], table, FORM, f"{name}[{k}]")
                empty = [key for key in ("id", "source") if isinstance(table.get(key), str) and not table[key].strip()]
                wrong += [Problem(f"{name}[{k}].{key}", _("must not be empty")) for key in empty]
                problems += wrong
                if wrong:
                    continue
                if row.id in found[name]:
                    problems.append(Problem(f"{name}[{k}].id", _("{id} stands twice").format(id=row.id)))
                found[name][row.id] = row
    return found, problems
