"""Sharing rows out: every row once, whatever the numbers."""

from __future__ import annotations

import threading

import pytest

from cardan.maths.compiled.method import LIMITS, available, processors, share


@pytest.mark.parametrize("rows", [0, 1, 2, 7, 100, 1001])
@pytest.mark.parametrize("threads", [None, 1, 2, 5])
@pytest.mark.parametrize("least", [1, 10, 5000])
def test_every_row_once(rows, threads, least):
    done, lock = [], threading.Lock()

    def work(first, last):
        with lock:
            done.extend(range(first, last))

    share(work, rows, threads=threads, least=least)
    assert sorted(done) == list(range(rows))


def test_an_error_in_a_thread_is_not_lost():
    def work(first, last):
        raise ValueError(first)

    with pytest.raises(ValueError, match="0"):
        share(work, 100, threads=2)


def test_processors(monkeypatch):
    for name in LIMITS:
        monkeypatch.delenv(name, raising=False)
    assert available() == processors() >= 1


@pytest.mark.parametrize("name", LIMITS)
@pytest.mark.parametrize(("said", "threads"), [("1", 1), ("0", None), ("many", None), ("100000", None)])
def test_a_cluster_says_how_many_threads(monkeypatch, name, said, threads):
    for other in LIMITS:
        monkeypatch.delenv(other, raising=False)
    monkeypatch.setenv(name, said)
    assert available() == (threads or processors())
