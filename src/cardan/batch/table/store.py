"""The folder of a sweep: one file for each chunk that is done, and a manifest that says what they are chunks of.

What counts as done is what is there and whole, nothing else: there is no list that could be wrong. So a run may be
ended at any moment and in any way, and the next one goes on.
"""

from __future__ import annotations

import hashlib
import json
import os
import secrets
import socket
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import IO, Any

import numpy as np

from cardan.batch.work import Chunk, Chunks, Column, Rows, State, Work
from cardan.errors import refuse
from cardan.files import refusal
from cardan.later import later
from cardan.texts import _, mark, plural

try:
    import fcntl
except ImportError:
    fcntl = None  # type: ignore[assignment]

FORMAT = 1
MANIFEST, SUMMARY, LOCK = "_manifest.json", "_summary.json", ".lock"  # readers of data skip such names

FEW = 3  # how many names a message tells


@dataclass(frozen=True, kw_only=True)
class Folder:
    """Where the chunks of a sweep lie; small enough to go to every worker."""

    path: Path  # the folder, from the root of the files
    label: Label  # of its files

    def file(self, chunk: Chunk) -> Path:
        """Return the file of a chunk."""
        return self.path / f"{chunk.name}{SUFFIX}"

    def put(self, chunk: Chunk, rows: Rows | None, states: Sequence[State]) -> None:
        """Write a chunk."""
        write_chunk(self.file(chunk), chunk, self.label, rows, states)

    def states(self, chunk: Chunk) -> list[State]:
        """Return the states of the reductions of a chunk that is there."""
        return states_of(self.file(chunk))

    def seen(self) -> bool:
        """Whether this machine sees the folder that is meant, and no other one by that name."""
        with suppress(OSError, ValueError, KeyError):
            return bool(read_json(self.path / MANIFEST)["work"] == self.label.work)
        return False


@dataclass(frozen=True, kw_only=True)
class Store:
    """An open folder that nobody else writes to."""

    folder: Folder  # where the chunks lie
    chunks: Chunks  # all chunks of the sweep, cut as they were at the first run
    done: set[int]  # indices of those that are there and whole
    # files that were not whole and have been taken away; their chunks are to be done again
    damaged: tuple[str, ...] = field(default=())

    def keep(self, summary: Mapping[str, Any]) -> None:
        """Write what came out; a disk without room for it keeps the one before."""
        with suppress(OSError):
            write_json(self.folder.path / SUMMARY, summary)


@contextmanager
def opened(
    path: Path, work: Work, *, keeps: bool, cut: Callable[[], int], heard: Callable[[], object] = lambda: None
) -> Iterator[Store]:
    """Open the folder of a sweep and keep others from it; what is there and whole is known afterwards.

    path: the folder; it is made where it is missing.
    cut: gives the rows of a chunk; asked only where nothing was begun before.
    """
    library()
    path = path.resolve()
    with ExitStack() as stack:
        try:
            path.mkdir(parents=True, exist_ok=True)
            stack.enter_context(_alone(path))
            manifest = _manifest(path, work, keeps, cut)
            label = Label(work=work.name, columns=tuple(work.columns), provenance=manifest["provenance"], keeps=keeps)
            chunks = Chunks(work.name, work.size, int(manifest["chunk_rows"]))
            _clear(path)
            stack.callback(_clear, path)
            done, damaged = _whole(Folder(path=path, label=label), chunks, heard)
        except OSError as error:
            raise refuse(str(path), _("cannot be written: {why}").format(why=refusal(error))) from None
        yield Store(folder=Folder(path=path, label=label), chunks=chunks, done=done, damaged=damaged)


def read_json(path: Path) -> dict[str, Any]:
    """Return what a JSON file holds."""
    content = json.loads(path.read_text(encoding="utf-8"))
    if not isinstance(content, dict):
        raise ValueError(path)
    return content


def write_json(path: Path, content: Mapping[str, Any]) -> None:
    """Write a JSON file as a whole or not at all."""
    text = json.dumps(content, ensure_ascii=False, indent=1, default=_plain)
    put(path, lambda stream: stream.write(text.encode() + b"\n"))


def names_in(path: Path) -> list[str]:
    """Return the names of the chunks in a folder, those of damaged files too."""
    return sorted(file.name.removesuffix(SUFFIX) for file in path.glob(f"*{SUFFIX}") if not file.name.startswith("."))


def manifest_of(path: Path) -> dict[str, Any]:
    """Return the manifest of a folder."""
    try:
        content = read_json(path / MANIFEST)
        if content["format"] != FORMAT:
            raise refuse(str(path), _("was written by another version of cardan"))
        content["columns"] = tuple(Column(**column) for column in content["columns"])
        if not (isinstance(content["chunk_rows"], int) and content["chunk_rows"] >= 1 and int(content["size"]) >= 0):
            raise ValueError(path)
        return {key: content[key] for key in ("work", "size", "chunk_rows", "rows", "columns", "provenance")}
    except FileNotFoundError:
        raise refuse(str(path), _("holds no sweep")) from None
    except OSError as error:
        raise refuse(str(path / MANIFEST), _("cannot be read: {why}").format(why=refusal(error))) from None
    except (ValueError, KeyError, TypeError):
        raise refuse(str(path / MANIFEST), _("is not the manifest of a sweep")) from None


def _manifest(path: Path, work: Work, keeps: bool, cut: Callable[[], int]) -> dict[str, Any]:
    """Return the manifest, a new one where nothing was begun here."""
    rows = "kept" if keeps else "none"
    if not (path / MANIFEST).exists():
        if strangers := names_in(path):
            raise refuse(str(path), _strangers(strangers))
        new = {
            "format": FORMAT,
            "work": work.name,
            "size": work.size,
            "chunk_rows": cut(),
            "rows": rows,
            "columns": [asdict(column) for column in work.columns],
            "provenance": dict(work.provenance),
        }
        write_json(path / MANIFEST, new)
    found = manifest_of(path)
    here = json.loads(json.dumps(dict(work.provenance), default=_plain))
    if found["work"] != work.name or found["size"] != work.size:
        raise refuse(str(path), _another(found["provenance"], here))
    same = json.dumps(found["provenance"]) == json.dumps(here)  # as texts: nan is no other nan
    if not same or found["columns"] != tuple(work.columns):
        raise refuse(str(path / MANIFEST), _("has been changed; put it back as it was, or choose another folder"))
    if found["rows"] != rows:
        text = _("keeps all rows: choose another folder to keep none")
        raise refuse(str(path), _("keeps no rows: choose another folder to keep them") if keeps else text)
    return found


def _another(there: Any, here: Any) -> str:
    names = sorted(name for name in {*there, *here} if there.get(name) != here.get(name))
    if names:
        return _("holds another sweep, which differs in {names}: choose another folder").format(names=", ".join(names))
    return _("holds another sweep: choose another folder")


def _strangers(names: Sequence[str]) -> str:
    shown = ", ".join(f"{name}{SUFFIX}" for name in names[:FEW]) + (" …" if len(names) > FEW else "")
    return plural(
        "holds a table that is not of this sweep ({names}): choose another folder",
        "holds {count} tables that are not of this sweep ({names}): choose another folder",
        len(names),
    ).format(count=len(names), names=shown)


def _whole(folder: Folder, chunks: Chunks, heard: Callable[[], object]) -> tuple[set[int], tuple[str, ...]]:
    """Return the chunks that are there and whole, and the names of files that were not; these are taken away."""
    done: set[int] = set()
    damaged: list[str] = []
    strangers: list[str] = []
    for name in names_in(folder.path):
        chunk = _chunk(chunks, name)
        if chunk is None:
            strangers.append(name)
        elif flaw(folder.file(chunk), chunk, folder.label):
            damaged.append(folder.file(chunk).name)
        else:
            done.add(chunk.index)
        if heard() == "stop":
            break
    if strangers:
        raise refuse(str(folder.path), _strangers(strangers))
    for name in damaged:
        (folder.path / name).unlink(missing_ok=True)
    return done, tuple(damaged)


def _chunk(chunks: Chunks, name: str) -> Chunk | None:
    """Return the chunk of a name, None where there is none."""
    start = name.partition("-")[0]
    index = int(start) // chunks.rows if start.isdecimal() else len(chunks)
    return chunks[index] if index < len(chunks) and chunks[index].name == name else None


def _clear(path: Path) -> None:
    """Take away what was being written when a run was ended."""
    for file in path.glob(f".*{PART}"):
        with suppress(OSError):
            file.unlink()


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """Keep other runs from a folder; the system lets go of it when this process ends, however it ends."""
    with open(path / LOCK, "a+", encoding="utf-8") as file:
        if not _locked(file.fileno()):
            file.seek(0)
            raise refuse(str(path), _("is in use by another run ({who})").format(who=file.read().strip() or "?"))
        file.truncate(0)
        file.write(_("process {number} on {machine}").format(number=os.getpid(), machine=socket.gethostname()))
        file.flush()
        yield
        file.truncate(0)


def _locked(handle: int) -> bool:
    """Lock a file; true where it is ours now, or where no lock is to be had on such a disk."""
    if fcntl is None:  # another system
        return True
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True


def _plain(value: Any) -> Any:
    """Return a number or an array as JSON can hold it."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(value)


# A chunk as a Parquet file: its rows, what they come from, the states of its reductions, and how to see it is whole.
#
# Written uncompressed and without dictionaries, which numbers with all their digits gain nothing from; each page has
# its checksum, and what stands beside the rows has one as well. Nothing in a file tells when or where it was made: a
# chunk that is made twice is the same file.

library = later("pyarrow.parquet", mark("keeping a sweep in a folder needs pyarrow: pip install 'cardan[sweep]'"))
pyarrow = later("pyarrow")

CHUNK_FORMAT = 1
SUFFIX = ".parquet"
PART = ".part"  # end of the name of a file that is being written
ABOUT, STATES, CHECK = b"cardan", b"cardan.states", b"cardan.check"  # keys of what stands beside the rows


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
            "format": CHUNK_FORMAT,
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
    """Write a file as a whole or not at all, and have the disk keep it before it gets its name."""
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
