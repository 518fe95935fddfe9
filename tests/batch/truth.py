"""What a sweep must give, whatever happened on its way."""

from __future__ import annotations

import numpy as np

from cardan.batch.engine.engines import InProcess
from cardan.batch.engine.running import read_sweep, run


def same_tables(found, wanted):
    """Two tables are equal in every row, column and bit."""
    assert list(found) == list(wanted)
    for name, column in wanted.items():
        np.testing.assert_array_equal(found[name], column, err_msg=name)
        assert found[name].dtype.kind == column.dtype.kind


def undisturbed(sweep, work, chunk, rows="kept"):
    """A sweep is the one of a single evaluation, and of a run that nothing disturbed, bit for bit."""
    assert (sweep.status, sweep.missing) == ("done", ())
    plain = run(work, engine=InProcess(), chunk=chunk)
    assert sweep.reductions == plain.reductions
    assert sweep.reductions["total"]["count"] == work.size
    if rows == "kept":
        same_tables(sweep.table(), work.evaluate(0, work.size))
    if sweep.folder is not None:
        again = read_sweep(sweep.folder)
        assert (again.status, again.missing, again.reductions) == ("done", (), plain.reductions)
        assert again.columns == sweep.columns
        files = sorted(sweep.folder.iterdir())
        assert not [file for file in files if file.name.endswith(".part")]
        assert len([file for file in files if file.suffix == ".parquet"]) == -(-work.size // chunk)
