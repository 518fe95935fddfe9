"""cardan torsion absorber and optimise, on the terminal, as JSON and as CSV, and the drives that they write."""

import csv
import inspect
import io

import numpy as np
import pytest

from cardan import io as files
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.choices import torsion_design as calms
from cardan.cli.torsion import torsion_absorber, torsion_optimise
from cardan.questions.torsion.absorber import absorber as absorbers
from cardan.questions.torsion.optimise.answer import reasons
from cardan.questions.torsion.optimise.optimise import Grid
from cardan.units import rpm
from tests.cli.test_forces import plain, widest

RIG = """format = 1
name = "test rig"   # on the bench
[[joints]]
joint_angle_deg = 12
[[joints]]
joint_angle_deg = 12
[[shafts]]
number = 2
stiffness_Nm_per_rad = 6000
damping_Nms_per_rad = 2
yoke_angle_deg = 20   # as found
[[stations]]
shaft = 3
name = "mill"
inertia_kg_m2 = 0.5
[duty]
torque_Nm = 100
speed_range_rpm = [350, 700]
"""
YOKE = "shafts[1].yoke_angle_deg"

SEARCHED = {}
"""What was asked, and its answer."""


@pytest.fixture(autouse=True)
def each_search_once(monkeypatch):
    """Let commands and tests that ask the same share the answer; what is asked otherwise is searched."""
    for name, module, real in (
        ("ask", torsion_absorber, absorbers.absorber),
        ("optimise_torsion", torsion_optimise, calms.optimise_torsion),
    ):

        def once(drive, name=name, real=real, progress=None, **options):
            defaults = inspect.signature(real).parameters
            own = {key: value for key, value in sorted(options.items()) if value != defaults[key].default}
            asked = name, repr(drive), repr(own)
            if asked not in SEARCHED:
                SEARCHED[asked] = real(drive, **own)
            return SEARCHED[asked]

        monkeypatch.setattr(module, name, once)


@pytest.fixture
def rig(drive_file):
    return drive_file(RIG)


@pytest.mark.slow
def test_an_absorber_is_set_and_written(cardan, rig, tmp_path):
    done = cardan("torsion", "absorber", rig, "--ratio", "0.15", "-o", "better.toml", "--plot", "curves.svg")
    assert done.code == 0
    assert widest(done.out) <= 80
    found = absorbers.absorber(files.load(rig), inertia_ratio=0.15)
    text = plain(done.out)
    assert "with an absorber on mill the largest alternating torque falls" in text
    falls = f"from ±{found.bare.peak:,.0f} to ±{found.best.peak:.0f} N·m".replace(",", " ")
    assert falls in text.replace("\u202f", " ")
    written = (tmp_path / "better.toml").read_text("utf-8")
    assert "# on the bench" in written
    assert files.load(tmp_path / "better.toml") == found.drive
    assert (tmp_path / "curves.svg").stat().st_size > 10_000


@pytest.mark.slow
def test_what_an_absorber_does_for_a_program(cardan, rig):
    content = cardan("torsion", "absorber", rig, "--kind", "viscous", "--json").content
    found = absorbers.absorber(files.load(rig), kind="viscous")
    assert content["best"]["damping_Nms_per_rad"] == found.best.damping
    assert content["without"]["alternating_torque_Nm"] == pytest.approx(found.bare.peak)
    assert content["best"]["alternating_torque_Nm"] < content["without"]["alternating_torque_Nm"]
    assert "absorber.damping_Nms_per_rad" in content["station_toml"]
    assert content["station"] == {"number": 4, "name": "mill", "shaft": 3}
    assert [one["name"] for one in content["stations"]][-1] == "mill"
    rows = list(csv.DictReader(io.StringIO(cardan("torsion", "absorber", rig, "--kind", "viscous", "--csv").out)))
    assert len(rows) == len(found.speed) == len(content["curves"]["speed_rpm"])
    np.testing.assert_allclose(
        [float(row["best_alternating_torque_1_Nm"]) for row in rows], found.after[:, 0], rtol=1e-9
    )


@pytest.mark.slow
def test_pendulums_and_one_speed(cardan, rig):
    text = plain(cardan("torsion", "absorber", rig, "--kind", "pendulum", "--radius-mm", "150", "--at", "4").out)
    assert "with pendulums on mill" in text
    assert "--kind pendulum --at 4 --radius-mm 150 -o better.toml" in text
    text = plain(cardan("torsion", "absorber", rig, "--kind", "tuned", "--speed-rpm", "500").out)
    assert "with an absorber without damping on mill the alternating torque at 500.0 rpm falls from" in text
    assert "It serves this speed alone" in text


@pytest.mark.slow
def test_a_drive_that_runs_elsewhere_is_warned(cardan, drive_file):
    """Without a band of speeds the nearest resonance is taken, wherever the drive runs."""
    slow = drive_file(RIG.replace("speed_range_rpm = [350, 700]", "speed_rpm = 100"))
    done = cardan("torsion", "absorber", slow, "--kind", "tuned", "--speeds", "450:600")
    assert "the drive runs" not in plain(done.out)
    text = plain(cardan("torsion", "absorber", slow, "--kind", "viscous").out)
    assert text.startswith("▲")
    assert "the drive runs at 100.0 rpm, outside these speeds" in text
    assert "It slips by" in text
    assert "absorber.stiffness" not in text


@pytest.mark.slow
def test_a_design_is_found_and_written(cardan, rig, tmp_path):
    ask = ("torsion", "optimise", rig, "--free", f"{YOKE}=-45:45", "--grid", "7")
    done = cardan(*ask, "-o", "better.toml", "--plot", "after.png")
    assert done.code == 0
    assert widest(done.out) <= 80
    found = calms.optimise_torsion(files.load(rig), free={YOKE: (-45.0, 45.0)}, method=Grid(points=7))
    text = plain(done.out)
    assert "the largest alternating torque falls from" in text
    assert "Joint 1 stands in the node" in text
    assert "The excitations of order 2 cancel" in text
    written = (tmp_path / "better.toml").read_text("utf-8")
    assert "# as found" in written
    assert files.load(tmp_path / "better.toml") == found.drive
    content = cardan(*ask, "--json").content
    assert content["values"] == pytest.approx(dict(found.values))
    assert content["reduction"] == pytest.approx(found.reduction)
    assert content["why"] == [told(one, USUAL) for one in reasons(found)]
    rows = list(csv.DictReader(io.StringIO(cardan(*ask, "--csv").out)))
    np.testing.assert_allclose([float(row["speed_rpm"]) for row in rows], found.speed / rpm)


@pytest.mark.slow
def test_the_old_name_asks_it_too(cardan, rig):
    ask = (rig, "--free", f"{YOKE}=-45:45", "--grid", "7")
    assert cardan("torsion", "calm", *ask).out == cardan("torsion", "optimise", *ask).out


@pytest.mark.slow
def test_one_yoke_is_best_where_it_is_and_the_file_stays(cardan, rig, tmp_path):
    ask = ("torsion", "optimise", rig, "--free", f"{YOKE}=70:90", "--grid", "2", "-o", "same.toml")
    text = plain(cardan(*ask).out)
    assert "nothing that may change makes it vibrate much less" in text
    assert (tmp_path / "same.toml").read_text("utf-8") == RIG


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("absorber", "--kind", "magic"), "--kind: 'magic' given"),
        (("absorber", "--at", "mil"), "the nearest is mill"),
        (("absorber", "--ratio", "-1"), "--ratio: -1 given"),
        (("absorber", "--element", "0"), "--element: 0 given; elements count from 1"),
        (("absorber", "--speeds", "700:300"), "--speeds: 700:300 is empty"),
        (("absorber", "--speeds", "300:700:9"), "--speeds: not a band of speeds: 300:700:9; write LOW:HIGH"),
        (("absorber", "--element", "2"), "--element: not all of these are there; the line has 1: shaft 2"),
        (("absorber", "--kind", "tuned", "--radius-mm", "9"), "--radius-mm: counts only with pendulums"),
        (("optimise", "--free", "shafts[1].yoke=1:2"), "shafts[1].yoke"),
        (("optimise", "--free", "nonsense"), "--free: not PATH=LOW:HIGH[:STEP]: nonsense"),
        (("optimise", "--grid", "1"), "--grid: 1 given; at least 2"),
    ],
)
def test_what_is_wrong_names_the_option(cardan, rig, arguments, said):
    done = cardan("torsion", arguments[0], rig, *arguments[1:])
    assert done.code == 2
    assert said in plain(done.err)


def test_files_that_cannot_be_written_are_refused_before_any_work(cardan, rig, tmp_path):
    (tmp_path / "there.toml").write_text("x", encoding="utf-8")
    for name in ("absorber", "optimise"):
        assert "--force" in cardan("torsion", name, rig, "-o", "there.toml").err
        assert "should end in" in cardan("torsion", name, rig, "-o", "drive.txt").err


@pytest.mark.slow
def test_a_duty_of_the_command_line_is_not_written_into_the_file(cardan, rig, tmp_path):
    done = cardan("torsion", "absorber", rig, "--torque-Nm", 7, "--speed-rpm", 777, "-o", "better.json")
    assert done.code == 0
    assert files.load(tmp_path / "better.json").duty == files.load(rig).duty
