"""A Dask cluster of this machine: started for one sweep, and ended with it whatever happens."""

from __future__ import annotations

import logging
import multiprocessing
import os
import signal
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

from cardan.later import later
from cardan.texts import mark

from .engines import EngineLostError, deaf, stillborn

PART = 5.0
"""Seconds that a cluster of ours has to end."""


library = later("distributed", mark("a cluster needs dask.distributed: pip install 'cardan[cluster]'"))
"""``dask.distributed``."""


@contextmanager
def local_cluster(workers: int) -> Iterator[str]:
    """Start a cluster on this machine that nobody else can reach, and end it afterwards.

    workers: how many processes, one thread each.
    Yields: address of its scheduler.
    """
    if getattr(multiprocessing.current_process(), "_inheriting", False):
        raise RuntimeError(stillborn(""))  # a script without a guard, which a worker of ours imports as it begins
    with tempfile.TemporaryDirectory(prefix="cardan-") as folder:
        try:
            with deaf():  # threads that start workers, now or later, inherit it
                cluster = library().LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    processes=True,
                    host="127.0.0.1",
                    scheduler_port=0,
                    dashboard_address="127.0.0.1:0",
                    worker_dashboard_address="127.0.0.1:0",
                    scheduler_kwargs={"dashboard": False},
                    local_directory=folder,
                    silence_logs=logging.CRITICAL,
                )
        except RuntimeError:  # its processes ended before they began
            raise EngineLostError(stillborn("")) from None
        try:
            yield str(cluster.scheduler_address)
        finally:
            _end(cluster)


def _end(cluster: Any) -> None:
    """End a cluster of ours at once: a chunk that is worked on is worth nothing any more."""
    for _attempt in range(2):  # one may just have been about to be started
        for nanny in list(cluster.workers.values()):
            nanny.auto_restart = False
            if nanny.pid:
                with suppress(ProcessLookupError):
                    os.kill(nanny.pid, getattr(signal, "SIGKILL", signal.SIGTERM))
        try:
            cluster.close(timeout=PART)
        except TimeoutError:
            continue
        return
