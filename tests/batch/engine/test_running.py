"""A sweep is the same on every engine and after every trouble, or says what is missing and goes on."""

from __future__ import annotations

import errno
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import replace
from functools import partial

import numpy as np
import pytest

from cardan.batch.engine import running
from cardan.batch.engine.engines import Done, EngineLostError, InProcess, Processes
from cardan.batch.engine.running import read_sweep, run
from cardan.batch.table import store
from cardan.batch.work import UNKNOWN, Chunks, rows_for
from cardan.errors import InputError
from tests.batch.truth import same_tables, undisturbed
from tests.batch.works import Numbers, Summed, Trouble

WORK = Numbers(size=1003)
CHUNK = 100


class Backwards:
    """An engine whose chunks are ready in the wrong order, as they may be anywhere, and that may be lost."""

    def __init__(self, writes=True, lost_after=None):
        self.writes, self.lost_after = writes, lost_after

    def run(self, task, chunks, *, heard=None):
        for count, chunk in enumerate(sorted(chunks, key=lambda one: (one.index % 3, -one.index))):
            if count == self.lost_after:
                raise EngineLostError("the machines are gone")
            yield Done(chunk, task(chunk))


@pytest.mark.parametrize("into", [True, False], ids=["folder", "memory"])
@pytest.mark.parametrize("rows", ["kept", "none"])
@pytest.mark.parametrize("engine", [InProcess(), Backwards(), Backwards(writes=False)], ids=["in", "back", "sent"])
def test_the_order_of_the_chunks_changes_nothing(engine, rows, into, tmp_path):
    sweep = run(WORK, engine=engine, rows=rows, chunk=CHUNK, into=tmp_path / "out" if into else None)
    undisturbed(sweep, WORK, CHUNK, rows)
    if rows == "none":
        assert not sum(len(part["k"]) for _start, part in sweep.parts())


@pytest.mark.parametrize("engine", [InProcess(), Backwards(writes=False)], ids=["in", "sent"])
def test_rows_that_nobody_keeps_are_not_held(engine, tmp_path):
    undisturbed(run(Summed(WORK.size), engine=engine, rows="none", chunk=CHUNK, into=tmp_path), WORK, CHUNK, "none")
    assert rows_for(Summed(WORK.size), keeps=False) > UNKNOWN
    assert rows_for(Numbers(0)) == 1


@pytest.mark.slow
def test_processes_give_the_same(tmp_path):
    undisturbed(run(WORK, engine=Processes(workers=2), chunk=CHUNK, into=tmp_path), WORK, CHUNK)
    undisturbed(run(WORK, engine=Processes(workers=1), chunk=CHUNK), WORK, CHUNK)


@pytest.mark.slow
def test_a_killed_worker_loses_and_doubles_nothing(tmp_path):
    (tmp_path / "marks").mkdir()
    work = replace(WORK, trouble=Trouble("kill", row=555, marks=str(tmp_path / "marks"), times=2))
    sweep = run(work, engine=Processes(workers=2), chunk=CHUNK, into=tmp_path / "out")
    assert len(list((tmp_path / "marks").iterdir())) == 2
    undisturbed(sweep, WORK, CHUNK)


def test_a_chunk_that_raises_is_missing_and_made_up_for_later(tmp_path):
    sweep = run(replace(WORK, trouble=Trouble("raise", row=555)), chunk=CHUNK, into=tmp_path)
    assert sweep.status == "incomplete"
    assert sweep.missing == ((500, 600, "ValueError: row of trouble"),)
    there = np.delete(np.arange(WORK.size), slice(500, 600))
    same_tables(sweep.table(), {name: column[there] for name, column in WORK.evaluate(0, WORK.size).items()})
    assert sweep.reductions["total"]["count"] == WORK.size - 100
    again = read_sweep(tmp_path)
    assert (again.status, again.missing, again.reductions) == (sweep.status, sweep.missing, sweep.reductions)
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


def test_only_what_is_missing_is_done_again(tmp_path):
    run(replace(WORK, trouble=Trouble("raise", row=555)), chunk=CHUNK, into=tmp_path)
    made = {file.name: file.stat().st_mtime_ns for file in tmp_path.glob("*.parquet")}
    shares = []
    run(WORK, into=tmp_path, chunk=7, progress=shares.append)
    assert {name: (tmp_path / name).stat().st_mtime_ns for name in made} == made
    assert shares[-1] == 1.0
    assert max(share for share in shares if share < 1.0) == pytest.approx(1.0 - 100 / WORK.size)
    assert shares == sorted(shares)


def test_nothing_is_started_where_nothing_is_missing(tmp_path):
    run(WORK, chunk=CHUNK, into=tmp_path)
    shares = []
    undisturbed(run(WORK, engine=Backwards(lost_after=0), into=tmp_path, progress=shares.append), WORK, CHUNK)
    assert shares[-1] == 1.0


def test_lost_machines_leave_what_was_done(tmp_path):
    sweep = run(WORK, engine=Backwards(lost_after=4), chunk=CHUNK, into=tmp_path)
    assert sweep.status == "incomplete"
    assert {one.why for one in sweep.missing} == {"the machines are gone"}
    assert sum(one.stop - one.start for one in sweep.missing) == WORK.size - 400
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


def test_stop_is_heard_and_the_run_goes_on_later(tmp_path):
    told = []

    def progress(share):
        told.append(share)
        return "stop" if len(told) == 3 else None

    work = replace(WORK, trouble=Trouble("slow", seconds=0.11))  # longer than between two words
    sweep = run(work, chunk=CHUNK, into=tmp_path, progress=progress)
    assert sweep.status == "cancelled"
    assert sweep.missing[-1].stop == WORK.size
    assert "stopped" in sweep.missing[-1].why
    again = read_sweep(tmp_path)
    assert (again.status, again.missing, again.reductions) == ("cancelled", sweep.missing, sweep.reductions)
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


@pytest.mark.slow
def test_stopped_processes_are_gone(tmp_path):
    work = replace(WORK, trouble=Trouble("slow", seconds=60.0))
    begin = time.monotonic()
    sweep = run(
        work,
        engine=Processes(workers=2),
        chunk=CHUNK,
        progress=lambda _: "stop" if time.monotonic() > begin + 0.5 else None,
    )
    assert (sweep.status, sweep.missing) == ("cancelled", ((0, WORK.size, "it was stopped"),))
    assert not multiprocessing.active_children()


class Swallowing:
    """What is interrupted as it is thrown away: Python goes on."""

    met = 0

    def __del__(self):
        Swallowing.met += 1
        signal.raise_signal(signal.SIGINT)
        time.sleep(0)  # the handler runs here


def test_a_ctrl_c_that_a_destructor_swallows_ends_the_run_all_the_same(tmp_path, monkeypatch):
    told = []
    monkeypatch.setattr(sys, "unraisablehook", told.append)
    monkeypatch.setattr(Swallowing, "met", 0)
    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    def progress(_share):
        if not Swallowing.met:
            Swallowing()

    try:
        with pytest.raises(KeyboardInterrupt):
            run(WORK, chunk=CHUNK, into=tmp_path, progress=progress)
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
        assert sys.unraisablehook == told.append
    finally:
        signal.signal(signal.SIGINT, before)
    assert (Swallowing.met, told) == (1, [])
    assert read_sweep(tmp_path).status == "cancelled"
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


INTERRUPTED = """
import sys
from pathlib import Path
from cardan.batch.engine.cluster import Cluster
from cardan.batch.engine.engines import Processes
from cardan.batch.engine.running import run
from tests.batch.works import Numbers, Summed, Trouble

if __name__ == "__main__":
    run(
        Numbers(size=1003, trouble=Trouble("slow", seconds=0.05)),
        engine=ENGINE(workers=2), chunk=25, into=sys.argv[1], progress=lambda share: print(share, flush=True),
    )
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "how"),
    [("Processes", signal.SIGINT), ("Processes", signal.SIGKILL), ("Cluster", signal.SIGINT)],
    ids=["ctrl-C", "killed", "ctrl-C on a cluster"],
)
def test_an_interrupted_program_leaves_nobody_and_can_go_on(engine, how, tmp_path):
    script = tmp_path / "script.py"
    script.write_text(INTERRUPTED.replace("ENGINE", engine))
    out = tmp_path / "out"
    program = subprocess.Popen(
        [sys.executable, script, out],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | {"PYTHONPATH": os.pathsep.join((os.getcwd(), os.environ.get("PYTHONPATH", "")))},
        start_new_session=True,
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),  # what runs in the background ignores it
    )
    while 0.0 <= float(program.stdout.readline()) < 0.1:
        pass
    os.killpg(program.pid, how) if how == signal.SIGINT else os.kill(program.pid, how)
    _rest, errors = program.communicate(timeout=300)  # ends when nobody holds the line to it any more, workers neither
    assert program.returncode == -how
    if how == signal.SIGINT:
        assert errors.count("KeyboardInterrupt") == 1
        assert read_sweep(out).status == "cancelled"
    sweep = read_sweep(out)
    lacking = sum(one.stop - one.start for one in sweep.missing)
    assert 0 < lacking < 1003
    same_tables(
        sweep.table(["k"]),
        {"k": np.delete(np.arange(1003), np.concatenate([np.arange(*one[:2]) for one in sweep.missing]))},
    )
    undisturbed(run(WORK, into=out), WORK, 25)


@contextmanager
def short_of_room(folder, room):
    """A disk that has no room for more than some bytes in all."""
    real = open
    written = 0

    class Stream:
        def __init__(self, stream):
            self.stream = stream

        def __enter__(self):
            return self

        def __exit__(self, *_args):
            self.stream.close()

        def __getattr__(self, name):
            return getattr(self.stream, name)

        def write(self, content):
            nonlocal written
            written += len(content)
            if written > room:
                self.stream.write(bytes(content)[: len(content) // 2])
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return self.stream.write(content)

    def opening(path, mode="r", *args, **kwargs):
        stream = real(path, mode, *args, **kwargs)
        return Stream(stream) if "x" in mode else stream

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(store, "open", opening, raising=False)
        yield


@pytest.mark.parametrize("engine", [InProcess(), Backwards(writes=False)], ids=["workers write", "we write"])
def test_a_full_disk_ends_the_run_and_nothing_half_written_counts(engine, tmp_path):
    with short_of_room(tmp_path, 60_000):
        sweep = run(WORK, engine=engine, chunk=CHUNK, into=tmp_path)
    full(sweep, tmp_path)
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


def full(sweep, folder):
    """The run ended in order, with some chunks and not with others."""
    assert sweep.status == "incomplete"
    assert {one.why for one in sweep.missing} == {f"{folder} cannot be written: No space left on device"}
    assert 0 < len(list(folder.glob("*.parquet"))) < len(Chunks("", WORK.size, CHUNK))
    assert not list(folder.glob("*.part"))
    assert read_sweep(folder).missing


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix" or os.geteuid() != 0, reason="only root can mount")
@pytest.mark.parametrize("engine", [InProcess(), Processes(workers=2)], ids=["in process", "processes"])
def test_a_disk_that_is_really_full(engine, tmp_path):
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=48k", "tmpfs", tmp_path], capture_output=True)
    if mounted.returncode:
        pytest.skip("nothing may be mounted here")
    try:
        sweep = run(WORK, engine=engine, chunk=CHUNK, into=tmp_path)
        full(sweep, tmp_path)
        subprocess.run(["mount", "-o", "remount,size=4m", tmp_path], check=True)
        undisturbed(run(WORK, engine=engine, into=tmp_path), WORK, CHUNK)
    finally:
        subprocess.run(["umount", tmp_path], check=True)


def test_a_table_that_is_too_large_to_be_held_is_refused(monkeypatch):
    monkeypatch.setattr(running, "HELD", 10_000)
    with pytest.raises(InputError, match="1003 points is too large to be held: keep it in a folder"):
        run(WORK)
    assert run(WORK, rows="none", chunk=CHUNK).status == "done"


@pytest.mark.slow
def test_memory_does_not_grow_with_the_size():
    import tracemalloc

    def peak(size):
        tracemalloc.start()
        try:
            run(Numbers(size=size), rows="none", chunk=2000)
            return tracemalloc.get_traced_memory()[1]
        finally:
            tracemalloc.stop()

    peak(2000)
    one = peak(10_000)
    assert peak(200_000) < 1.1 * one  # twenty times the points; a tenth for what is counted and told


def test_columns_are_read_by_name(tmp_path):
    for sweep in (run(WORK, chunk=CHUNK, into=tmp_path), run(WORK, chunk=CHUNK)):
        assert list(sweep.table(["y", "k"])) == ["y", "k"]
        assert [start for start, _rows in sweep.parts()] == list(range(0, WORK.size, CHUNK))
        with pytest.raises(InputError, match="z: is not a column of the table"):
            sweep.table(["z"])


def test_a_sweep_without_points_is_done(tmp_path):
    sweep = run(Numbers(size=0), chunk=CHUNK, into=tmp_path)
    assert (sweep.status, sweep.reductions["total"]) == ("done", {"count": 0, "sum": 0.0})
    assert read_sweep(tmp_path).status == "done"


def test_where_the_rows_come_from_is_told_everywhere(tmp_path):
    run(WORK, chunk=CHUNK, into=tmp_path)
    assert json.loads((tmp_path / "_manifest.json").read_text())["provenance"] == WORK.provenance
    assert read_sweep(tmp_path).provenance == WORK.provenance
