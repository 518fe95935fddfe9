"""cardan bending: the critical speeds, what moves, how far the drive stays away, and what the file lacks."""

import csv
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.questions.bending.bending import bending_speeds, critical_speed_map
from cardan.units import rpm
from tests.cli.conftest import EXAMPLES
from tests.cli.test_forces import plain, widest

VAN = EXAMPLES / "two-piece-rubber-bearing.toml"
TRUCK = EXAMPLES / "truck-supports.toml"


def changed(tmp_path, *pairs):
    text = VAN.read_text("utf8")
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    path = tmp_path / "van.toml"
    path.write_text(text, "utf8")
    return path


@pytest.mark.parametrize("path", [VAN, TRUCK], ids=lambda path: path.stem)
@pytest.mark.parametrize("options", [(), ("--map",), ("--modes", "1")], ids=["modes", "map", "one"])
def test_the_answer_stands_within_80_columns(cardan, path, options):
    done = cardan("bending", path, *options)
    assert (done.code, done.err) == (0, "")
    assert widest(done.out) <= 80
    assert files.load(path).name in plain(done.out)


def test_it_says_what_whirls_and_what_to_mind(cardan):
    said = plain(cardan("bending", VAN).out)
    found = bending_speeds(files.load(VAN))
    assert "first bending mode, shaft 3 (rear piece) at 7 095 rpm, 1.82 times" in said
    half, full = found.passing(0)
    assert f"bounce mode on support 1 (centre bearing), and half of it; pass each quickly: in {half:.2g} s" in said
    assert f"in {full:.2g} s all of it (loss factor of rubber, 0.1)" in said
    low, high = found.half_band[1] / rpm
    assert f"from {low:,.0f} to {high:,.0f} rpm the joints".replace(",", " ") in said
    assert "Joints 1 and 3 are assumed rigidly supported" in said
    assert "no mode is missed" in said


def test_json_is_the_critical_speeds(cardan):
    said = cardan("bending", VAN, "--json", "--modes", "2").content
    found = bending_speeds(files.load(VAN), modes=2)
    assert [row["critical_rpm"] for row in said["modes"]] == (found.speed / rpm).tolist()
    assert [row["moves"] for row in said["modes"]] == ["support", "shaft"]
    assert said["modes"][1]["deflection"] == found.deflection[1].tolist()
    assert said["status"] == "clear"
    assert said["margin"]["ratio"] == found.margin.ratio
    assert said["speed_range_rpm"] == pytest.approx([700.0, 3900.0])


def test_csv_has_a_row_for_each_mode(cardan):
    rows = list(csv.DictReader(io.StringIO(cardan("bending", VAN, "--csv", "--modes", "5").out)))
    found = bending_speeds(files.load(VAN), modes=5)
    np.testing.assert_allclose([float(row["actual_rpm"]) for row in rows], found.actual / rpm)
    np.testing.assert_allclose([float(row["support_1_share"]) for row in rows], found.support_share[:, 0])


def test_the_map_is_that_of_the_library(cardan):
    rows = list(csv.DictReader(io.StringIO(cardan("bending", VAN, "--map", "--csv", "--modes", "1").out)))
    found = critical_speed_map(files.load(VAN), modes=1)
    np.testing.assert_allclose([float(row["stiffness_N_per_mm"]) for row in rows], found.value / 1e3)
    np.testing.assert_allclose([float(row["critical_1_rpm"]) for row in rows], found.speed[:, 0] / rpm)


def test_a_broken_rule_is_exit_code_1_with_what_would_keep_it(cardan, tmp_path):
    fast = changed(tmp_path, ("[700, 3900]", "[700, 5500]"))
    done = cardan("bending", fast, "--modes", "1")
    assert done.code == 0  # the 60 % of practice are advice; a limit of the file fails
    strict = tmp_path / "strict.toml"
    strict.write_text(fast.read_text("utf-8") + "\n[limits]\ncritical_speed = 1.6\n", "utf-8")
    assert cardan("bending", strict, "--modes", "1").code == 1
    said = plain(done.out)
    assert "only 1.29 times the highest speed in use" in said
    assert "should be 60 % above the highest speed" in said
    assert "Shaft 3 at most about 1 187 mm long, or 24 % thicker" in said
    beyond = cardan("bending", changed(tmp_path, ("[700, 3900]", "[700, 8000]")))
    assert beyond.code == 1
    assert "runs at or above a bending critical speed of a shaft" in plain(beyond.out)


def test_without_speeds_it_asks_for_them(cardan, tmp_path):
    calm = changed(tmp_path, ("speed_rpm = 2500\n", ""), ("speed_range_rpm = [700, 3900]\n", ""))
    done = cardan("bending", calm)
    assert done.code == 0
    assert "needs duty.speed_range_rpm or duty.speed_rpm" in plain(done.out)


def test_what_the_file_lacks_is_named_as_the_file_spells_it(cardan):
    done = cardan("bending", EXAMPLES / "two-piece-rear-drive.toml")
    assert done.code == 2
    assert "shafts[1].outer_mm: missing" in plain(done.err)
    assert cardan("bending", VAN, "--modes", "0").code == 2


def test_pictures(cardan, tmp_path):
    done = cardan("bending", VAN, "--map", "--plot", tmp_path / "map.svg")
    assert done.code == 0
    assert (tmp_path / "map.svg").stat().st_size > 1000
