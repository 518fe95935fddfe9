"""A chunk as a Parquet file: its rows, what they come from, the states of its reductions, and how to see it is whole.

Written uncompressed and without dictionaries, which numbers with all their digits gain nothing from; each page has its
checksum, and what stands beside the rows has one as well. Nothing in a file tells when or where it was made: a chunk
that is made twice is the same file.
"""

from __future__ import annotations

import hashlib
import json
import os
import secrets
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import IO, Any

import numpy as np

from cardan.batch.chunks import Chunk
from cardan.batch.work import Column, Rows, State
from cardan.later import later
from cardan.texts import _, mark

library = later("pyarrow.parquet", mark("keeping a sweep in a folder needs pyarrow: pip install 'cardan[sweep]'"))
pyarrow = later("pyarrow")

FORMAT = 1
SUFFIX = ".parquet"
PART = ".part"
"""End of the name of a file that is being written."""

ABOUT, STATES, CHECK = b"cardan", b"cardan.states", b"cardan.check"
"""Keys of what stands beside the rows."""


@dataclass(frozen=True, kw_only=True)
class Label:
    """What all files of a sweep have in common."""

    work: str  # name of the sweep
    columns: tuple[Column, ...]  # of its table
    provenance: Mapping[str, Any]  # what the rows come from
    keeps: bool  # whether the files hold rows; without them they hold the states of the reductions only

    def about(self, chunk: Chunk) -> bytes:
        """Return what a chunk is, as JSON."""
        told = {
            "format": FORMAT,
            "work": self.work,
            "chunk": chunk.name,
            "start": chunk.start,
            "stop": chunk.stop,
            "rows": "kept" if self.keeps else "none",
            "columns": [asdict(column) for column in self.columns],
            "provenance": self.provenance,
        }
        return json.dumps(told, ensure_ascii=False, sort_keys=True).encode()


def write_chunk(path: Path, chunk: Chunk, label: Label, rows: Rows | None, states: Sequence[State]) -> None:
    """Write a chunk as a whole or not at all.

    path: the file; one that is there is replaced.
    rows, dict of str to array (n,),: rows of the chunk; none where the sweep keeps none.
    states: one for each reduction, as JSON can hold it.
    Raises OSError: the file cannot be written; nothing of it is left.
    """
    about, told = label.about(chunk), json.dumps(list(states)).encode()
    table = _table(label, rows if rows is not None else {column.name: np.empty(0) for column in label.columns})
    table = table.replace_schema_metadata({ABOUT: about, STATES: told, CHECK: _digest(about, told)})

    def write(stream: IO[bytes]) -> None:
        library().write_table(
            table,
            stream,
            compression="none",
            use_dictionary=False,
            write_page_checksum=True,
            row_group_size=max(1, table.num_rows),
        )

    put(path, write)


def put(path: Path, write: Callable[[IO[bytes]], object]) -> None:
    """Write a file as a whole or not at all, and have the disk keep it before it gets its name.

    Raises OSError: it cannot be written.
    """
    temporary = path.with_name(f".{path.name}.{secrets.token_hex(8)}{PART}")
    try:
        with open(temporary, "xb") as stream:
            write(stream)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(temporary, path)
    except BaseException:
        with suppress(OSError):
            temporary.unlink()
        raise
    _keep_names(path.parent)


def _keep_names(folder: Path) -> None:
    """Have the disk keep the names in a folder, where the system can."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)


def flaw(path: Path, chunk: Chunk, label: Label) -> str:
    """Return what keeps a file from being a chunk of a sweep; empty where it is, every page of it.

    chunk: the chunk it should be; label: of the sweep it should belong to.
    """
    try:
        with library().ParquetFile(path, page_checksum_verification=True) as file:
            beside, twin = file.metadata.metadata or {}, file.schema_arrow.metadata or {}  # the format holds both
            if beside.get(ABOUT) != label.about(chunk):
                return _("it belongs to something else")
            if beside.get(CHECK) != _digest(beside[ABOUT], beside.get(STATES, b"")) or any(
                twin.get(key) != beside.get(key) for key in (ABOUT, STATES, CHECK)
            ):
                return _("it is damaged")
            if file.metadata.num_rows != (chunk.size if label.keeps else 0):
                return _("it is not whole")
            if file.schema_arrow.names != [column.name for column in label.columns]:
                return _("it belongs to something else")
            for group in range(file.num_row_groups):
                file.read_row_group(group)
    except (pyarrow().ArrowException, OSError, ValueError, KeyError):
        return _("it is damaged")
    return ""


def states_of(path: Path) -> list[State]:
    """Return the states of the reductions of a chunk."""
    with library().ParquetFile(path) as file:
        states: list[State] = json.loads(file.metadata.metadata[STATES])
        return states


def rows_of(path: Path, names: Iterable[str] | None = None) -> Rows:
    """Return the rows of a chunk.

    names: columns to read, in this order; all by default.
    Returns dict of str to array (n,).
    """
    wanted = None if names is None else list(names)
    with library().ParquetFile(path) as file:
        table = file.read(columns=wanted)
    return {name: _array(table.column(name)) for name in wanted or table.column_names}


def _table(label: Label, rows: Rows) -> Any:
    pa = pyarrow()
    arrays = [pa.array(np.asarray(rows[column.name])) for column in label.columns]
    fields = [
        pa.field(column.name, array.type, metadata={b"unit": column.unit.encode(), b"role": column.role.encode()})
        for column, array in zip(label.columns, arrays, strict=True)
    ]
    return pa.Table.from_arrays(arrays, schema=pa.schema(fields))


def _array(column: Any) -> Any:
    array = column.to_numpy()
    return array.astype(np.str_) if array.dtype == object and column.null_count == 0 else array


def _digest(about: bytes, states: bytes) -> bytes:
    return hashlib.sha256(about + b"\n" + states).hexdigest().encode()
