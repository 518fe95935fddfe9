"""Reading the table of a sweep: questions in SQL, best rows, Pareto sets, summaries; never more than is asked for."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from cardan.batch.search.goals import Goal, Limit, check_names
from cardan.batch.search.pareto import pareto
from cardan.batch.work import STATUS, Column, Rows
from cardan.errors import refuse
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.texts import _, mark

from .store import SUFFIX, manifest_of, names_in
from .swept import Sweep, read_sweep

TABLE = "sweep"  # what the table is called in questions
Part: TypeAlias = Path | Rows  # a piece of the table: a file, or rows that are held


@dataclass(frozen=True, kw_only=True, eq=False)
class Results:
    """The table of a sweep, which stays where it is.

    Attributes
    ----------
    sweep : Sweep
        With columns, provenance, reductions, and what is missing.
    parts : tuple of Path or dict of str to array (n,)
        Pieces of the table, in order.
    """

    sweep: Sweep
    parts: tuple[Part, ...]

    @property
    def columns(self) -> tuple[Column, ...]:
        """Columns of the table, in order."""
        return self.sweep.columns

    @property
    def units(self) -> dict[str, str]:
        """Unit of each column, a key of `cardan.units`; empty for plain numbers and words."""
        return {column.name: column.unit for column in self.columns}

    @property
    def provenance(self) -> Mapping[str, Any]:
        """What the rows come from."""
        return self.sweep.provenance

    @cached_property
    def numbers(self) -> tuple[Column, ...]:
        """Columns of points and answers that hold numbers, in order."""
        head = self.table(limit=1)
        return tuple(c for c in self.columns if c.role != "status" and head[c.name].dtype.kind in "fiu")

    def column(self, name: str) -> Column:
        """Return a column by its name.

        Raises
        ------
        InputError
            There is none; the message names the nearest.
        """
        check_names([name], self.columns)
        return next(column for column in self.columns if column.name == name)

    def count(self, where: str = "") -> int:
        """Return how many rows there are that fulfil a condition in SQL."""
        return int(self.query(f"SELECT count(*) AS n FROM {TABLE}{condition(where)}")["n"][0])

    def query(self, sql: str) -> Rows:
        """Return what a question in SQL finds in the table ``sweep``.

        Parameters
        ----------
        sql : str
            One SELECT. Names of columns with brackets may stand as they are. What has no answer is NULL.

        Returns
        -------
        dict of str to array (n,)
            Numbers with nan for NULL, words with None.

        Raises
        ------
        InputError
            It is not one SELECT, or cannot be answered.

        Examples
        --------
        >>> column = Column(name="joint_angle_deg[0]", unit="deg", role="answer", text="")
        >>> held = ((0, {"joint_angle_deg[0]": np.asarray([3.0, 5.0])}),)
        >>> made = Sweep(
        ...     columns=(column,), size=2, status="done", missing=(), reductions={}, provenance={}, held=held
        ... )
        >>> results(made).query("SELECT max(joint_angle_deg[0]) AS most FROM sweep")
        {'most': array([5.])}
        """
        return self._answered(sql, self.parts)

    def table(self, columns: Sequence[str] = (), *, where: str = "", order: str = "", limit: int | None = None) -> Rows:
        """Return rows, in the order of the points.

        Parameters
        ----------
        columns : sequence of str
            All by default.
        where, order : str
            Condition and order in SQL.
        limit : int, optional
            Rows at most.
        """
        return self.query(self.select(columns, where=where, order=order, limit=limit))

    def select(self, columns: Sequence[str] = (), *, where: str = "", order: str = "", limit: int | None = None) -> str:
        """Return the question in SQL for rows; see `table`."""
        check_names(columns, self.columns)
        names = ", ".join(quoted(name) for name in columns) or "*"
        ordered = f" ORDER BY {order}" if order else ""
        ended = "" if limit is None else f" LIMIT {max(0, int(limit))}"
        return f"SELECT {names} FROM {TABLE}{condition(where)}{ordered}{ended}"

    def pieces(self, columns: Sequence[str] = (), *, where: str = "") -> Iterator[Rows]:
        """Return rows piece by piece, in the order of the points; see `table`."""
        sql = self.select(columns, where=where)
        for part in self.parts:
            yield self._answered(sql, (part,))

    def best(self, goal: Goal, *, limits: Sequence[Limit] = (), where: str = "", count: int = 1) -> Rows:
        """Return the best rows that were answered and keep the limits, the best first; equal ones by their points.

        Parameters
        ----------
        goal : Goal
            What is to be small or great.
        limits : sequence of Limit
            What is to be kept.
        where : str
            Further condition in SQL.
        count : int
            How many.
        """
        check_names([goal, *limits], self.columns)
        name = quoted(goal.name)
        point = "".join(f", {quoted(column.name)}" for column in self.columns if column.role == "point")
        told = self._conditions(limits, where, f"{name} IS NOT NULL")
        return self.table(where=told, order=f"{name} {'DESC' if goal.largest else 'ASC'}{point}", limit=count)

    def pareto(self, goals: Sequence[Goal], *, limits: Sequence[Limit] = (), where: str = "") -> Rows:
        """Return the rows that keep the limits of which none is better in all goals, in the order of the first.

        Parameters
        ----------
        goals : sequence of Goal
            One or more.
        limits : sequence of Limit
            What is to be kept.
        where : str
            Further condition in SQL.

        Notes
        -----
        Exact over all rows; looked through piece by piece, so that only the front is held.
        """
        check_names([*goals, *limits], self.columns)
        if not goals:
            raise refuse("goals", _("none is given; write “min speed_fluctuation_percent” or “max life_h”"), "missing")
        sql = self.select(where=self._conditions(limits, where))
        kept: Rows = {}
        for part in self.parts or ({},):
            piece = self._answered(sql, (part,) if part else ())
            kept = {name: np.concatenate([kept[name], column]) if kept else column for name, column in piece.items()}
            chosen = pareto(kept, goals)
            kept = {name: column[chosen] for name, column in kept.items()}
        order = np.argsort(goals[0].cost(kept), kind="stable")
        return {name: column[order] for name, column in kept.items()}

    def spans(self, names: Sequence[str] = (), *, where: str = "") -> dict[str, dict[str, float]]:
        """Return least, mean and greatest of columns of numbers, and how many rows have none.

        Parameters
        ----------
        names : sequence of str
            All columns of numbers by default.
        where : str
            Condition in SQL.
        """
        chosen = list(names) or [column.name for column in self.numbers]
        check_names(chosen, self.columns)
        told = {"least": "min({0})", "mean": "avg({0})", "most": "max({0})", "unknown": "count(*) - count({0})"}
        parts = [
            f"{how.format(quoted(name))} AS c{k}_{key}" for k, name in enumerate(chosen) for key, how in told.items()
        ]
        if not parts:
            return {}
        row = self.query(f"SELECT {', '.join(parts)} FROM {TABLE}{condition(where)}")
        return {name: {key: float(row[f"c{k}_{key}"][0]) for key in told} for k, name in enumerate(chosen)}

    def sample(self, columns: Sequence[str], count: int, *, where: str = "", seed: int = 0) -> Rows:
        """Return some rows drawn evenly from all, the same ones for the same seed.

        Parameters
        ----------
        columns : sequence of str
            Wanted.
        count : int
            Rows at most.
        where : str
            Condition in SQL.
        seed : int
            Of the draw.
        """
        inner = self.select(columns, where=where)
        if self.count(where) <= count:
            return self.query(inner)
        return self.query(f"SELECT * FROM ({inner}) USING SAMPLE reservoir({count} ROWS) REPEATABLE ({seed})")

    @contextmanager
    def opened(self, parts: Sequence[Part] | None = None, *, writes: Path | None = None) -> Iterator[Any]:
        """Open the table for SQL; close it afterwards.

        Parameters
        ----------
        parts : sequence, optional
            Pieces of the table; all by default.
        writes : Path, optional
            The one file that may be written; nothing else of the disk can be reached.
        """
        chosen = self.parts if parts is None else tuple(parts)
        connection = duckdb().connect(":memory:")
        try:
            files = [str(part) for part in chosen if isinstance(part, Path)]
            held: list[Rows] = [part for part in chosen if not isinstance(part, Path)]
            if not chosen:
                held = [{column.name: np.empty(0) for column in self.columns}]
            shown = ", ".join(cell(column) for column in self.columns)
            sources = [f"SELECT {shown} FROM read_parquet({listed(files)})"] if files else []
            for k, rows in enumerate(held):
                connection.register(f"held_{k}", arrow(rows))
                sources.append(f"SELECT {shown} FROM held_{k}")
            # Least and greatest as a file tells them of a column leave nan out: nothing is to be concluded from them.
            connection.execute("SET disabled_optimizers = 'statistics_propagation'")
            connection.execute(f"CREATE VIEW {TABLE} AS {' UNION ALL '.join(sources)}")
            allowed = [*files, *([] if writes is None else [str(writes)])]
            connection.execute(f"SET allowed_paths = {listed(allowed)}")
            connection.execute("SET enable_external_access = false")
            connection.execute("SET lock_configuration = true")
            yield connection
        except (duckdb().IOException, duckdb().InvalidInputException) as error:
            if writes is not None or (
                isinstance(error, duckdb().InvalidInputException) and "parquet" not in str(error).lower()
            ):
                raise
            raise refuse(str(self.sweep.folder), damage(error)) from None
        finally:
            connection.close()

    def named(self, sql: str) -> str:
        """Return a question with names of columns that SQL would take for more than a name in quotes."""
        return sql_names(sql, [column.name for column in self.columns])

    def _answered(self, sql: str, parts: Sequence[Part]) -> Rows:
        """Return what a question finds in pieces of the table."""
        try:
            with self.opened(parts) as connection:
                found = connection.execute(only_select(connection, self.named(sql))).fetchnumpy()
        except duckdb().Error as error:
            raise refuse("query", told_error(error)) from None
        return {name: filled(column) for name, column in found.items()}

    def _conditions(self, limits: Sequence[Limit], where: str, *more: str) -> str:
        """Return the condition in SQL of rows that were answered and keep limits."""
        told = [*([f"({where})"] if where else []), *more]
        told += [f"{STATUS} = 0"] if any(column.name == STATUS for column in self.columns) else []
        for limit in limits:
            ends = ((limit.low, ">="), (limit.high, "<="))
            told += [f"{quoted(limit.name)} {sign} {end!r}" for end, sign in ends if math.isfinite(end)]
        return " AND ".join(told)


def results(source: Sweep | str | Path) -> Results:
    """Return the results of a sweep, to be asked.

    Parameters
    ----------
    source : Sweep or path
        What came out of a sweep, or the folder that it was run into.

    Returns
    -------
    Results

    Raises
    ------
    InputError
        The folder holds no sweep, or one of which only summaries were kept.
    MissingExtraError
        duckdb is not installed.

    See Also
    --------
    sweep, read_sweep

    Examples
    --------
    >>> from cardan.sweeps import results
    >>> results("no such folder")
    Traceback (most recent call last):
    cardan.errors.InputError: no such folder: holds no sweep
    """
    duckdb()
    sweep = source if isinstance(source, Sweep) else read_sweep(source)
    folder = sweep.folder
    if folder is None:
        return Results(sweep=sweep, parts=tuple(rows for _start, rows in sweep.held))
    if manifest_of(folder)["rows"] == "none":
        raise refuse(str(folder), _("keeps summaries alone, no rows; run the sweep into another folder to keep them"))
    return Results(sweep=sweep, parts=tuple(folder / f"{name}{SUFFIX}" for name in names_in(folder)))


# Small things about SQL: names in quotes, what is not a number, what a database says when it cannot answer.

duckdb = later("duckdb", mark("reading the table of a sweep needs duckdb: pip install 'cardan[sweep]'"))
pyarrow = later("pyarrow")

_PLAIN = re.compile(r"[A-Za-z_]\w*")
_QUOTED = r"'(?:[^']|'')*'|\"(?:[^\"]|\"\")*\""


def quoted(name: str) -> str:
    """Return a name as SQL takes it whatever signs it has."""
    return '"' + name.replace('"', '""') + '"'


def sql_names(sql: str, columns: Sequence[str]) -> str:
    """Return a question with names of columns that SQL would take for more than a name in quotes."""
    odd = sorted((name for name in columns if not _PLAIN.fullmatch(name)), key=len, reverse=True)
    if not odd:
        return sql
    known = "|".join(rf"(?<![\w.\]]){re.escape(name)}(?![\w\[])" for name in odd)
    return re.sub(f"{_QUOTED}|({known})", lambda found: quoted(found[1]) if found[1] else found[0], sql)


def condition(where: str) -> str:
    """Return the clause of a condition, nothing where there is none."""
    return f" WHERE {where}" if where else ""


def cell(column: Column) -> str:
    """Return a column with NULL for nan: SQL would take that for the greatest of all numbers."""
    name = quoted(column.name)
    return f"CASE WHEN isnan({name}) THEN NULL ELSE {name} END AS {name}" if column.role == "answer" else name


def listed(files: Sequence[str]) -> str:
    """Return names of files as a list of words."""
    return "[" + ", ".join("'" + file.replace("'", "''") + "'" for file in files) + "]"


def arrow(rows: Rows) -> Any:
    """Return rows as a table that a database reads."""
    pa = pyarrow()
    return pa.table({name: pa.array(np.asarray(column)) for name, column in rows.items()})


def filled(column: Any) -> Array:
    """Return a column with nan, or None among words, for NULL; dates and lists in words."""
    if column.dtype.kind in "mM":
        column = column.astype(f"{column.dtype.kind}8[us]").astype(object)
    if column.dtype.kind == "O":
        told = np.asarray([*map(_plain, column.tolist()), None], dtype=object)[:-1]  # so that no list becomes a table
        column = np.ma.masked_array(told, np.ma.getmaskarray(column))
    if not np.ma.isMaskedArray(column):
        return np.asarray(column)
    whole: Any = column
    if whole.dtype.kind == "O":
        return np.where(np.ma.getmaskarray(whole), None, whole.data)
    return np.asarray(whole.astype(float).filled(math.nan)) if np.any(whole.mask) else np.asarray(whole.data)


def _plain(value: Any) -> Any:
    """Return a word, a number, or anything else in words."""
    return value if value is None or isinstance(value, str | int | float) else str(value)


def only_select(connection: Any, sql: str) -> Any:
    """Return the one statement that a question is."""
    statements = connection.extract_statements(sql)
    if len(statements) != 1 or statements[0].type != duckdb().StatementType.SELECT:
        raise refuse("query", _("only one SELECT is answered; the table itself is never changed"))
    return statements[0]


def told_error(error: Exception) -> str:
    """Return what the database says, in its own words without the picture of the place."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip() and set(line.strip()) != {"^"}]
    return _("it cannot be answered: {why}").format(why=" ".join(lines[:2]) or type(error).__name__)


def damage(error: Exception) -> str:
    """Return what to do about a file that cannot be read."""
    text = _("a file of it is damaged ({why}); run the sweep again into this folder: what is whole is not done again")
    return text.format(why=str(error).splitlines()[0][:200])
