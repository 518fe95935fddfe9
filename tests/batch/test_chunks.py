"""Chunks cover all rows once, keep their names, and are as long as time and memory allow."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cardan.batch.work import MOST, UNKNOWN, Chunks, chunks_of, rows_for
from tests.batch.works import Numbers, Trouble


@pytest.mark.slow
@given(size=st.integers(0, 500), rows=st.integers(1, 600))
def test_chunks_cover_all_rows_once(size, rows):
    chunks = Chunks("a sweep", size, rows)
    assert [k for chunk in chunks for k in range(chunk.start, chunk.stop)] == list(range(size))
    assert [chunk.index for chunk in chunks] == list(range(len(chunks)))
    assert len({chunk.name for chunk in chunks}) == len(chunks)
    assert sorted(chunk.name for chunk in chunks) == [chunk.name for chunk in chunks]


def test_names_follow_the_content_alone():
    chunks = Chunks("a sweep", 100, 10)
    assert chunks[3] == Chunks("a sweep", 100, 10)[3] == chunks[-7]
    assert chunks[3].name == Chunks("a sweep", 90, 10)[3].name
    assert chunks[3].name != Chunks("another", 100, 10)[3].name
    assert chunks[2:4] == [chunks[2], chunks[3]]
    with pytest.raises(IndexError):
        chunks[10]


def test_a_hundred_million_chunks_take_no_memory():
    chunks = Chunks("a sweep", 10**8, 1)
    assert len(chunks) == 10**8
    assert chunks[-1].start == 10**8 - 1


@dataclass(frozen=True)
class Costly(Numbers):
    """Rows that take a time and a memory each."""

    seconds: float = 0.0
    memory: int = 0

    def evaluate(self, start, stop):
        space = np.zeros((stop - start) * self.memory, dtype=np.uint8)
        time.sleep(self.seconds * (stop - start))
        return super().evaluate(start, stop) | {"k": np.arange(start, stop) + 0 * len(space)}


def test_slow_rows_make_small_chunks():
    # sleep lasts at least as long as asked for: 0.16 s hold 8 rows of 0.02 s, or fewer where the machine is busy
    assert 1 <= rows_for(Costly(1000, seconds=0.02), target=0.16) <= 8
    assert rows_for(Costly(3, seconds=0.1), target=0.05) == 1
    assert rows_for(Costly(100, seconds=0.1), target=0.05) == 1


def test_a_small_sweep_is_not_tried_for_long():
    @dataclass(frozen=True)
    class Counted(Costly):
        calls: list = field(default_factory=list)

        def evaluate(self, start, stop):
            self.calls.append(stop - start)
            return super().evaluate(start, stop)

    assert rows_for(slow := Counted(20, seconds=0.06)) == 1
    assert rows_for(fast := Counted(20), target=60.0) >= 20
    assert slow.calls == fast.calls == [1]


@pytest.mark.slow
def test_large_rows_make_small_chunks():
    room = 2**20
    rows = rows_for(Costly(10**7, memory=4096), room=room)
    assert 64 <= rows <= 256  # 4096 bytes of working space a row, and up to as much again for its columns


def test_many_slow_rows_do_not_make_too_many_files():
    assert len(chunks_of(Costly(1000 * MOST, seconds=0.06))) <= 1.5 * MOST


def test_rows_that_fail_make_chunks_all_the_same():
    work = Numbers(1000, trouble=Trouble("raise", row=499))
    assert rows_for(work) == UNKNOWN
    assert len(chunks_of(work, rows=300)) == 4
