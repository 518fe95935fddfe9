"""Results as CSV and JSON."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from cardan import InputError, articulation, equivalent_joint, example, motion, phases, save


def test_motion_as_csv(tmp_path: Path) -> None:
    found = motion(example("truck-printed-angles"))
    save(found, tmp_path / "a.csv")
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert len(rows) == found.angle.shape[0]
    assert float(rows[60]["shaft_5_ratio"]) == found.ratio[60]
    assert float(rows[90]["angle_deg"]) == pytest.approx(90.0, abs=1e-12)
    assert "shaft_5_acceleration_rad_s2" in rows[0]


def test_articulation_as_csv(tmp_path: Path) -> None:
    found = articulation(example("pto-hitch"))
    save(found, tmp_path / "a.csv")
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert [float(row["time_s"]) for row in rows] == found.times.tolist()
    assert float(rows[3]["shaft_2_length_mm"]) == pytest.approx(1e3 * found.length[3, 1], rel=1e-15)


@pytest.mark.parametrize("name", ["single-20deg", "truck-printed-angles", "three-joints-unequal", "six-joints"])
def test_results_as_json(name: str, tmp_path: Path) -> None:
    drive = example(name)
    for k, result in enumerate((motion(drive), equivalent_joint(drive), phases(drive))):
        save(result, tmp_path / f"{k}.json")
        assert isinstance(json.loads((tmp_path / f"{k}.json").read_text()), dict)
    held = json.loads((tmp_path / "0.json").read_text())
    np.testing.assert_array_equal(held["shaft_ratio"], motion(drive).shaft_ratio)


def test_unknown_format_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"known are \.csv, \.json"):
        save(motion(example("single-20deg")), tmp_path / "a.xls")
    with pytest.raises(InputError, match="no table"):
        save(equivalent_joint(example("single-20deg")), tmp_path / "a.csv")
    assert not list(tmp_path.iterdir())
