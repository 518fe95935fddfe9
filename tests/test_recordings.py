"""The shipped recordings: what their script makes, each with its fault found first."""

from __future__ import annotations

import runpy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from cardan import example
from cardan.io import recording_names
from cardan.questions.diagnosis.expected import FAULTS
from cardan.recordings import diagnose, load_recording

FOLDER = Path(__file__).parents[1] / "examples" / "recordings"

MOST = 300_000
"""Bytes of a file."""


@pytest.fixture(scope="module")
def script() -> dict[str, Any]:
    return runpy.run_path(str(FOLDER / "make.py"))


def test_there_is_one_of_every_fault(script: dict[str, Any]) -> None:
    assert set(script["FAULTS"]) == set(FAULTS)
    names = {Path(script["file_name"](fault)).stem for fault in FAULTS}
    assert names == set(recording_names())
    assert all(path.stat().st_size < MOST for path in FOLDER.glob("*.csv"))


@pytest.mark.slow
@pytest.mark.parametrize("fault", ["healthy", "worn_spline", "crack"])
def test_the_script_makes_what_is_there(script: dict[str, Any], fault: str) -> None:
    made = script["recording"](fault)
    kept = load_recording(FOLDER / script["file_name"](fault))
    assert (FOLDER / script["file_name"](fault)).read_bytes().splitlines()[:3] == script["content"](fault).splitlines()[
        :3
    ]
    assert [one.name for one in kept.channels] == [one.name for one in made.channels]
    assert kept.cautions == ()
    for one, other in zip(kept.channels, made.channels, strict=True):
        step = np.min(np.diff(np.unique(other.values)))
        # Another processor may round a last digit the other way.
        np.testing.assert_allclose(one.values, other.values, atol=1.01 * step)


@pytest.mark.parametrize("fault", FAULTS)
def test_its_fault_is_found_first(script: dict[str, Any], fault: str) -> None:
    drive = example(script["DRIVE"])
    found = diagnose(load_recording(FOLDER / script["file_name"](fault)), drive)
    assert found[0].cause == (FAULTS[fault] or "healthy")
    assert found[0].score > 2.0 * found[1].score
