"""What came out of a sweep: its table, its summaries, and what is missing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np

from cardan.batch.work import Chunks, Column, Rows
from cardan.errors import refuse
from cardan.texts import _

from .store import SUFFIX, SUMMARY, manifest_of, names_in, read_json, rows_of

Ending: TypeAlias = Literal["done", "cancelled", "incomplete"]


class Missing(NamedTuple):
    """Rows that are not there, and why."""

    start: int
    stop: int
    why: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Sweep:
    """What came out of a sweep.

    Attributes
    ----------
    columns : tuple of Column
        Columns of the table.
    size : int
        How many points there are to be.
    status : {"done", "cancelled", "incomplete"}
        Whether all rows are there; where they are not, running the same sweep into the same folder goes on.
    missing : tuple of Missing
        Rows that are not there, in order, and why.
    reductions : dict of str to object
        Name of each summary -> what it tells of the rows that are there.
    provenance : mapping
        What the rows come from: version, drive, axes, questions, units, seeds.
    folder : Path or None
        Where the table lies.
    damaged : tuple of str
        Files of an earlier run that were not whole and have been made again.
    held : tuple of tuple of int and dict
        The table where it lies in no folder, piece by piece: number of the first row, and rows; `parts` and `table`
        give it in either case.
    """

    columns: tuple[Column, ...]
    size: int
    status: Ending
    missing: tuple[Missing, ...]
    reductions: Mapping[str, Any]
    provenance: Mapping[str, Any]
    folder: Path | None = None
    damaged: tuple[str, ...] = ()
    held: tuple[tuple[int, Rows], ...] = field(default=(), repr=False)

    def parts(self, names: Iterable[str] | None = None) -> Iterator[tuple[int, Rows]]:
        """Return the rows piece by piece, in order, as much at once as a chunk holds.

        Parameters
        ----------
        names : iterable of str, optional
            Columns wanted, in this order; all by default.

        Yields
        ------
        tuple of int and dict of str to array (n,)
            The number of the first row, and the rows.
        """
        wanted = [column.name for column in self.columns] if names is None else list(names)
        unknown = [name for name in wanted if name not in {column.name for column in self.columns}]
        if unknown:
            raise refuse(unknown[0], _("is not a column of the table"), "unknown_key")
        if self.folder is not None:
            for name in names_in(self.folder):
                yield int(name.partition("-")[0]), rows_of(self.folder / f"{name}{SUFFIX}", wanted)
        for start, rows in self.held:
            yield start, {name: rows[name] for name in wanted}

    def table(self, names: Iterable[str] | None = None) -> Rows:
        """Return the rows that are there, in order, as one array for each column.

        Parameters
        ----------
        names : iterable of str, optional
            Columns wanted, in this order; all by default.

        Returns
        -------
        dict of str to array (n,)
            In the units of `columns`.
        """
        wanted = [column.name for column in self.columns] if names is None else list(names)
        pieces = [rows for _start, rows in self.parts(wanted)]
        return {name: np.concatenate([rows[name] for rows in pieces]) if pieces else np.empty(0) for name in wanted}


def read_sweep(folder: str | Path) -> Sweep:
    """Return the sweep that a folder holds, as far as it is done; it may be running.

    Parameters
    ----------
    folder : path
        Where a sweep was run into.

    Returns
    -------
    Sweep
        With the reductions that were last put together of just these rows, without any where there are none.

    Raises
    ------
    InputError
        The folder holds no sweep.

    See Also
    --------
    sweep, results

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from cardan import Drive
    >>> from cardan.sweeps import read_sweep, sweep
    >>> pair = Drive.from_angles([0.3, 0.3])
    >>> with TemporaryDirectory() as folder:
    ...     told = sweep(pair, {"joints[1].joint_angle_deg": [10, 20]}, ["speed_fluctuation"], into=folder)
    ...     read_sweep(folder).status, read_sweep(folder).size
    ('done', 2)
    """
    path = Path(folder)
    manifest = manifest_of(path)
    chunks = Chunks(manifest["work"], int(manifest["size"]), int(manifest["chunk_rows"]))
    there = set(names_in(path))
    try:
        summary = read_json(path / SUMMARY)
        why = {(start, stop): str(told) for start, stop, told in summary["missing"]}
        known = (str(summary["status"]), dict(summary["reductions"]))
    except (OSError, ValueError, KeyError):
        why, known = {}, ("", {})
    lacking = [one for one in chunks if one.name not in there]
    missing = ranges(Missing(one.start, one.stop, _("it is not done yet")) for one in lacking)
    same = [(one.start, one.stop) for one in missing] == [
        (one.start, one.stop) for one in ranges(Missing(*ends, "") for ends in sorted(why))
    ]
    if same:
        missing = tuple(Missing(*ends, told) for ends, told in sorted(why.items()))
    status: Ending = "done" if not missing else "cancelled" if known[0] == "cancelled" else "incomplete"
    return Sweep(
        columns=manifest["columns"],
        size=int(manifest["size"]),
        status=status,
        missing=missing,
        reductions=known[1] if same else {},
        provenance=manifest["provenance"],
        folder=path,
    )


def ranges(missing: Iterable[Missing]) -> tuple[Missing, ...]:
    """Return ranges put together that touch and are missing for the same reason."""
    found: list[Missing] = []
    for one in missing:
        if found and found[-1].stop == one.start and found[-1].why == one.why:
            found[-1] = Missing(found[-1].start, one.stop, one.why)
        else:
            found.append(one)
    return tuple(found)
