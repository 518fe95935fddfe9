"""From one drive to a hundred million: what varies, what is asked, and where it is worked on."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from cardan.batch.table.reduction import Reduce
from cardan.catalogue import Catalogue
from cardan.drive.drive import Drive

from .answering.asking import Device
from .engine.engines import Engine, InProcess
from .engine.running import Keeping, run
from .plan import work_of
from .points.axes import Axis
from .search.goals import Limit
from .table.swept import Sweep


def sweep(
    drive: Drive,
    vary: Mapping[str, Any] | Sequence[Axis],
    ask: Sequence[str],
    *,
    reduce: Sequence[str | Reduce] = (),
    constraints: Sequence[str | Limit] = (),
    engine: Engine = InProcess(),  # noqa: B008 - frozen
    into: str | Path | None = None,
    rows: Keeping = "kept",
    known: Catalogue | None = None,
    device: Device = "cpu",
    chunk: int | None = None,
    progress: Callable[[float], object] | None = None,
) -> Sweep:
    """Ask questions of a drive at every point of a sweep.

    Parameters
    ----------
    drive : Drive
    vary : mapping of str to sequence, or sequence of Axis
        Path with unit, as in the drive file, -> its values; or axes: `GridAxis`, `TableAxis`, `SampledAxis`. Every
        combination is a point.
    ask : sequence of str
        Names of questions: ``"speed_fluctuation"``, ``"life"``.
    reduce : sequence of str or Reduce
        What to tell of all points: ``"max speed_fluctuation by duty.speed_rpm"``.
    constraints : sequence of str or Limit
        What a point has to keep to be feasible: ``"speed_fluctuation <= 0.02"``.
    engine : InProcess, Processes or Cluster
        Where it is worked on; the rows are the same.
    into : path, optional
        Folder for the table. A sweep into a folder where it was begun goes on.
    rows : {"kept", "none"}
        Whether the table is kept, or the reductions alone.
    known : Catalogue, optional
        Where sizes and grades are looked up; the shipped one when not given.
    device : {"cpu", "gpu"}
        What computes motion; the GPU answers nothing else.
    chunk : int, optional
        Rows worked on at a time; measured by default.
    progress : function, optional
        Told the share done; when it answers "stop", the sweep ends as cancelled and keeps what is done.

    Returns
    -------
    Sweep
        table() : arrays (points,) by column; reductions; status and what is missing.

    Raises
    ------
    InputError
        All that is wrong with the sweep, at once; a folder that cannot be used.
    MissingExtraError
        A folder, a cluster or the GPU needs a library that is not installed.

    See Also
    --------
    results, read_sweep

    Notes
    -----
    A point that makes no drive, or has no answer, holds nan and says so by its status; `cardan.batch.plan.work_of`
    makes the same work without running it, and tells by ``why`` what stands in its way.

    Examples
    --------
    >>> pair = Drive.from_angles([0.3, 0.3])
    >>> angles = {"joints[1].joint_angle_deg": [10.0, 17.2, 95.0]}
    >>> found = sweep(pair, angles, ["speed_fluctuation"], reduce=["min speed_fluctuation"])
    >>> found.table()["speed_fluctuation"], found.table()["status"]
    (array([0.060775  , 0.00012169,        nan]), array([0, 0, 1], dtype=int8))
    """
    work = work_of(drive, vary, ask, reduce=reduce, constraints=constraints, known=known, device=device)
    return run(work, engine=engine, into=into, rows=rows, chunk=chunk, progress=progress)
