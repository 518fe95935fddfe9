"""Engines give what every chunk holds, whatever dies on the way, and leave nothing behind."""

from __future__ import annotations

import multiprocessing
import os
import time

import pytest

from cardan.batch.engine.engines import EngineLostError, InProcess, Processes, reason
from cardan.batch.work import Chunks
from cardan.errors import InputError, MissingExtraError, refuse
from tests.batch import works

CHUNKS = Chunks("a sweep", size=23, rows=4)
ROWS = {k: list(range(chunk.start, chunk.stop)) for k, chunk in enumerate(CHUNKS)}


def gone(number, patience=60.0):
    """Whether a process ends within a time; one that nobody has waited for yet counts as ended."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        try:
            with open(f"/proc/{number}/stat") as stat:
                if stat.read().rpartition(")")[2].split()[0] == "Z":
                    return True
        except OSError:
            return True
        time.sleep(0.02)
    return False


def results(engine, task, chunks=CHUNKS):
    return {done.chunk.index: (done.value, done.failure) for done in engine.run(task, chunks)}


@pytest.mark.slow
@pytest.mark.parametrize("engine", [InProcess(), Processes(workers=2)], ids=["in process", "processes"])
def test_every_chunk_comes_once_and_a_failure_is_told(engine):
    found = results(engine, works.Rowwise(works.Trouble("raise", row=9)))
    assert found == {
        k: (rows, None) if 9 not in rows else (None, "ValueError: row of trouble") for k, rows in ROWS.items()
    }
    assert not multiprocessing.active_children()


def test_a_library_that_is_missing_ends_the_run():
    def task(_chunk):
        raise MissingExtraError("needs a library")

    with pytest.raises(MissingExtraError):
        next(InProcess().run(task, CHUNKS))


@pytest.mark.slow
def test_the_chunk_of_a_killed_process_is_done_again(tmp_path):
    found = results(Processes(workers=2), works.Rowwise(works.Trouble("kill", row=9, marks=str(tmp_path), times=2)))
    assert found == {k: (rows, None) for k, rows in ROWS.items()}
    struck = [int(mark.name.partition("-")[2]) for mark in tmp_path.iterdir()]
    assert len(set(struck)) == 2
    assert all(gone(number) for number in struck)


@pytest.mark.slow
def test_a_chunk_that_always_kills_is_given_up_and_the_rest_goes_on():
    found = results(Processes(workers=2, retries=1), works.Rowwise(works.Trouble("kill", row=9)))
    assert found.pop(2) == (None, "the process that worked on it died 2 times")
    assert found == {k: (rows, None) for k, rows in ROWS.items() if k != 2}


@pytest.mark.slow
def test_workers_have_one_thread_and_end():
    found = [done.value for done in Processes(workers=1).run(works.threads_and_process, CHUNKS)]
    assert {threads for threads, _process in found} == {1}
    (worker,) = {process for _threads, process in found}
    assert worker != os.getpid()
    assert gone(worker)


@pytest.mark.slow
def test_what_cannot_be_sent_is_told():
    assert "pickle" in next(iter(Processes(workers=1).run(works.unsendable, CHUNKS))).failure


@pytest.mark.slow
def test_processes_that_cannot_begin_say_why():
    with pytest.raises(EngineLostError, match="no module named 'tools'"):
        results(Processes(workers=1, retries=0), works.Unreadable())


def test_stop_is_heard_while_all_work():
    begin = time.monotonic()
    assert (
        list(
            Processes(workers=2).run(
                works.lasting, CHUNKS, heard=lambda: "stop" if time.monotonic() > begin + 0.5 else ""
            )
        )
        == []
    )
    assert not multiprocessing.active_children()
    assert list(InProcess().run(works.size_of, CHUNKS, heard=lambda: "stop")) == []


@pytest.mark.slow
def test_no_more_chunks_are_taken_than_are_worked_on():
    taken = 0

    def counted():
        nonlocal taken
        for chunk in CHUNKS:
            taken += 1
            yield chunk

    for done, _one in enumerate(Processes(workers=2).run(works.size_of, counted())):
        assert taken <= done + 2


def test_closing_the_iterator_ends_the_processes():
    running = Processes(workers=2).run(works.threads_and_process, CHUNKS)
    _threads, process = next(running).value
    running.close()
    assert gone(process)
    assert not multiprocessing.active_children()


def test_the_number_of_processes_is_checked():
    with pytest.raises(InputError, match="workers: 0 is not at least 1"):
        Processes(workers=0)


def test_reasons_are_one_sentence():
    assert reason(refuse("a.b", "is wrong")) == "a.b: is wrong"
    assert reason(EngineLostError("all\n gone")) == "all gone"
    assert reason(KeyError()) == "KeyError"
