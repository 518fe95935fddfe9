"""What it costs to hand chunks over to other processes, and to keep their rows."""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cardan.batch.work import TARGET, Chunk, Chunks
from cardan.errors import MissingExtraError

from .harness import Figure, fastest

if TYPE_CHECKING:
    from cardan.batch.engine.engines import Engine

AIM = 0.05
"""Share of the time of a chunk that an engine may cost."""


@dataclass(frozen=True)
class Steps:
    """So many steps of plain arithmetic: work that takes as long beside other work as alone."""

    count: int

    def __call__(self, chunk: Chunk) -> tuple[float, list[float]]:
        """Return the seconds it took, and numbers that have to travel."""
        begin = time.perf_counter()
        x = 0.1 + 1e-9 * chunk.index
        for _step in range(self.count):
            x = 3.9 * x * (1.0 - x)
        return time.perf_counter() - begin, [x] * 100


def per_chunk(engine: Engine, task: Steps, count: int) -> float:
    """Return seconds between one chunk and the next [s], the first one left aside: its time is that of starting."""
    ends: list[float] = []
    for done in engine.run(task, Chunks("benchmark", count + 1, 1)):
        if done.failure:
            raise RuntimeError(done.failure)
        ends.append(time.perf_counter())
    return (ends[-1] - ends[0]) / count


def figures(quick: bool) -> Iterator[Figure]:
    from cardan.backends import Cluster, InProcess, Processes

    seconds, count, rounds = (0.05, 3, 1) if quick else (TARGET, 6, 3)
    trial = Steps(200_000)
    steps = Steps(round(trial.count * seconds / min(trial(chunk)[0] for chunk in Chunks("trial", 5, 1))))
    engines: dict[str, Engine] = {"one process": Processes(workers=1)}
    if not quick:
        engines["a cluster of one worker"] = Cluster(workers=1)
    best = dict.fromkeys(("here", *engines), float("inf"))
    for _round in range(rounds):
        for name, engine in {"here": InProcess(), **engines}.items():
            try:
                best[name] = min(best[name], per_chunk(engine, steps, count))
            except MissingExtraError as error:
                print(f"engines: {error}", file=sys.stderr)
    for name in engines:
        if best[name] < float("inf"):
            cost = max(0.0, best[name] / best["here"] - 1.0)
            yield Figure(
                bench=f"handing a chunk of {seconds:g} s over to {name}",
                value=100.0 * cost,
                unit="%",
                yardstick=f"the same chunks in a loop; {100 * AIM:g} %, aim ≤ 1",
                ratio=cost / AIM,
            )
    try:
        yield keeping(10**4 if quick else 2 * 10**6)
    except MissingExtraError as error:
        print(f"engines: {error}", file=sys.stderr)


def keeping(rows: int) -> Figure:
    """Return how fast a chunk is put on the disk, checksums and all, against its bytes as they are."""
    import numpy as np

    from cardan.batch.table.store import Label, put, write_chunk
    from cardan.batch.work import Column

    names = [f"c{k}" for k in range(6)]
    table = {name: np.random.default_rng(k).random(rows) for k, name in enumerate(names)}
    columns = tuple(Column(name=name, unit="", role="answer", text=name) for name in names)
    label = Label(work="benchmark", columns=columns, provenance={}, keeps=True)
    (chunk,) = Chunks("benchmark", rows, rows)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        best = fastest(
            {
                "chunk": lambda: write_chunk(path / "chunk.parquet", chunk, label, table, []),
                "bytes": lambda: put(path / "bytes", lambda file: [file.write(table[name].data) for name in names]),
            },
            rounds=3,
        )
    size = 8e-9 * rows * len(names)
    return Figure(
        bench=f"keeping chunks of {1e3 * size:.3g} MB",
        value=size / best["chunk"],
        unit="GB/s",
        yardstick=f"the same bytes as they are, {size / best['bytes']:.3g} GB/s",
        ratio=best["bytes"] / best["chunk"],
    )
