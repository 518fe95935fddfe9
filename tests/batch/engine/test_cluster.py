"""A real Dask cluster gives what one process gives, whatever of it dies; what is gone for good is told."""

from __future__ import annotations

import gc
import json
import multiprocessing
import os
import pickle
import subprocess
import sys
import time
from dataclasses import replace
from types import SimpleNamespace

import pytest

from cardan.batch.engine import cluster
from cardan.batch.engine.cluster import Cluster
from cardan.batch.engine.engines import Done
from cardan.batch.engine.running import run
from cardan.batch.work import Chunks
from cardan.errors import InputError, MissingExtraError
from cardan.version import VERSION
from tests.batch import works
from tests.batch.truth import undisturbed
from tests.batch.works import Numbers, Trouble

WORK = Numbers(size=1003)
CHUNK = 50

# Dask leaves sockets behind of schedulers that die; they are collected here, not in the tests of others.
pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
]


@pytest.fixture(autouse=True)
def collected():
    yield
    gc.collect()


class Outside:
    """A scheduler and workers in processes of their own, as on machines of others."""

    def __init__(self, folder):
        self.folder = folder
        self.file = folder / "scheduler.json"
        self.scheduler = None
        self.workers = []

    def start(self, *arguments):
        return subprocess.Popen(
            [sys.executable, "-m", *arguments],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=self.folder,
            env=os.environ | {"PYTHONPATH": os.getcwd()},
        )

    def open(self, port=0):
        self.file.unlink(missing_ok=True)
        told = ("--host", "127.0.0.1", "--port", str(port), "--no-dashboard", "--scheduler-file", str(self.file))
        self.scheduler = self.start("distributed.cli.dask_scheduler", *told)
        while not self.file.exists() or not self.file.read_text().rstrip().endswith("}"):
            assert self.scheduler.poll() is None
            time.sleep(0.02)
        self.address = json.loads(self.file.read_text())["address"]

    def work(self):
        told = ("--nthreads", "1", "--no-dashboard", "--no-nanny", "--local-directory", str(self.folder))
        self.workers.append(self.start("distributed.cli.dask_worker", self.address, *told))

    def close(self):
        for process in (*self.workers, self.scheduler):
            if process is not None:
                process.kill()
                process.wait()
        self.workers = []


@pytest.fixture
def outside(tmp_path):
    found = Outside(tmp_path)
    found.open()
    yield found
    found.close()


def test_a_cluster_of_this_machine_outlives_a_killed_worker(tmp_path):
    (tmp_path / "marks").mkdir()
    work = replace(WORK, trouble=Trouble("kill", row=555, marks=str(tmp_path / "marks")))
    sweep = run(work, engine=Cluster(workers=2), chunk=CHUNK, into=tmp_path / "out")
    assert len(list((tmp_path / "marks").iterdir())) == 1
    undisturbed(sweep, WORK, CHUNK)
    assert not multiprocessing.active_children()


def test_a_chunk_that_always_kills_is_told_from_its_neighbours(tmp_path):
    import dask
    import distributed  # noqa: F401  (brings its settings; the first import inside `set` would lose all of them behind it)

    work = replace(WORK, trouble=Trouble("kill", row=55))
    with dask.config.set({"distributed.scheduler.allowed-failures": 0}):
        sweep = run(work, engine=Cluster(workers=1), chunk=CHUNK, into=tmp_path)
    assert sweep.missing == ((50, 100, "the process that worked on it died 1 time"),)
    undisturbed(run(WORK, into=tmp_path), WORK, CHUNK)


def test_a_scheduler_that_is_started_anew(outside, tmp_path):
    outside.work()
    killed = []

    def progress(share):
        if share > 0.3 and not killed:
            killed.append(share)
            outside.close()
            outside.open(outside.address.rpartition(":")[2])
            outside.work()

    work = replace(WORK, trouble=Trouble("slow", seconds=0.05))
    sweep = run(work, engine=Cluster(scheduler=outside.address), chunk=CHUNK, into=tmp_path / "out", progress=progress)
    assert killed
    undisturbed(sweep, WORK, CHUNK)
    failing = replace(WORK, trouble=Trouble("raise", row=1002))
    sweep = run(failing, engine=Cluster(scheduler=outside.address), chunk=CHUNK, rows="none", into=tmp_path / "none")
    assert sweep.missing == ((1000, 1003, "ValueError: row of trouble"),)
    undisturbed(run(WORK, rows="none", into=tmp_path / "none"), WORK, CHUNK, "none")


def test_a_cluster_that_is_gone_or_other_is_told(outside, tmp_path, monkeypatch):
    outside.work()
    wait_for_worker(outside)
    with monkeypatch.context() as patch:
        patch.setattr(cluster, "VERSION", "0.0.9")
        with pytest.raises(InputError) as refused:
            run(WORK, engine=Cluster(scheduler=outside.address))
        assert str(refused.value).startswith("scheduler: worker tcp://127.0.0.1:")
        assert "here is cardan 0.0.9, Python 3." in str(refused.value)

    def progress(share):
        if share > 0.3:
            outside.close()

    work = replace(WORK, trouble=Trouble("slow", seconds=0.02))
    engine = Cluster(scheduler=outside.address, patience=0.5)
    sweep = run(work, engine=engine, chunk=CHUNK, into=tmp_path / "out", progress=progress)
    assert sweep.status == "incomplete"
    assert {one.why for one in sweep.missing} == {
        f"the scheduler {outside.address} is gone and did not come back within 0.5 s"
    }
    assert 0 < sum(one.stop - one.start for one in sweep.missing) < WORK.size
    undisturbed(run(WORK, into=tmp_path / "out"), WORK, CHUNK)


def wait_for_worker(outside):
    from distributed import Client

    with Client(outside.address, set_as_default=False) as client:
        client.wait_for_workers(1, timeout=300)


def test_a_scheduler_without_workers_is_told(outside):
    sweep = run(WORK, engine=Cluster(scheduler=outside.address, patience=0.3), chunk=CHUNK)
    assert sweep.missing == ((0, WORK.size, f"the scheduler {outside.address} has had no worker for 0.3 s"),)


@pytest.mark.parametrize(
    ("address", "told"),
    [
        ("tcp://127.0.0.1:9", "scheduler: no Dask scheduler answers at tcp://127.0.0.1:9"),
        ("pigeon://a:1", "scheduler: pigeon://a:1 is not the address of a Dask scheduler: "),
    ],
)
def test_a_wrong_address_is_one_message(address, told, monkeypatch):
    monkeypatch.setattr(cluster, "FIRST", 0.5)
    with pytest.raises(InputError) as refused:
        run(WORK, engine=Cluster(scheduler=address))
    assert str(refused.value).startswith(told)
    assert "\n" not in str(refused.value)


class Line:
    """A scheduler that a test speaks for: chunks come back in the order of their giving."""

    stopped = False

    def __init__(self, fates):
        self.fates, self.given, self.most, self.breaks = dict(fates), [], 0, 0

    def connect(self, again=False):
        self.broken = False
        self.breaks += again

    def up(self):
        return not self.broken

    def threads(self):
        return 3

    def stop(self):
        return False

    def give(self, told, chunk):
        future = SimpleNamespace(key=len(self.given), status="finished", add_done_callback=lambda call: call(future))
        self.given.append(chunk)
        return future

    def taken(self, chunk, future):
        fate = self.fates.get(chunk.index, [])
        match fate.pop(0) if fate else "done":
            case "broken":
                self.broken = True
                return None
            case "cancelled":
                future.status = "cancelled"
                return None
            case "killed":
                raise cluster._KilledError(4)
        return Done(chunk, chunk.index)


def test_chunks_come_back_once_whatever_becomes_of_them_on_the_way():
    chunks = Chunks("a sweep", 40, 1)
    taken = 0

    def counted():
        nonlocal taken
        for chunk in chunks:
            taken += 1
            yield chunk

    line = Line({3: ["broken"], 5: ["cancelled"], 8: ["killed"], 9: ["killed", "killed"], 20: ["broken", "broken"]})
    found = {}
    for done in cluster._worked(line, works.size_of, counted()):
        assert done.chunk.index not in found
        found[done.chunk.index] = (done.value, done.failure)
        assert taken <= len(found) + cluster.AHEAD * 3 + 2  # those in hand, and two that are blamed and wait
    died = (None, "the process that worked on it died 4 times")
    assert found == {k: (k, None) if k != 9 else died for k in range(40)}
    assert line.breaks == 3


def test_a_worker_of_another_version_that_comes_late_does_nothing(monkeypatch):
    (chunk,) = Chunks("a sweep", 3, 3)
    assert cluster._work(pickle.dumps((works.size_of, "en", VERSION)), chunk) == (3, None)
    value, failure = cluster._work(pickle.dumps((works.size_of, "en", "0.0.9")), chunk)
    assert value is None
    assert "has cardan" in failure


def test_what_makes_no_sense_is_refused():
    with pytest.raises(InputError, match="a cluster that is running has the workers that it has"):
        Cluster(scheduler="tcp://127.0.0.1:9", workers=2)
    with pytest.raises(InputError, match="0 is not at least 1"):
        Cluster(workers=0)
    assert Cluster().writes
    assert not Cluster(scheduler="tcp://127.0.0.1:9").writes
    assert Cluster(scheduler="tcp://127.0.0.1:9", shared=True).writes


def test_a_missing_library_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingExtraError, match=r"pip install 'cardan\[cluster\]'"):
        run(WORK, engine=Cluster())
