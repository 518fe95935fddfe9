"""A shaft that an alternating torque breaks: its damage by hand, and every place that must tell of it."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from cardan import load
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.checks.design import design
from cardan.checks.strength.section import sections
from cardan.checks.strength.shaft_life import sorted_into_classes, spectrum
from cardan.checks.strength.strength import strength
from cardan.choices.remedy import remedies
from cardan.choices.sizing import size
from cardan.cli.main import main
from cardan.drive.conditions import used_speeds
from cardan.drive.cross import Cross
from cardan.drive.joint_parts import Needles
from cardan.drive.joints import Hooke
from cardan.drive.settings import Pose
from cardan.questions.life.life import life
from cardan.questions.life.rainflow import rainflow
from cardan.units import deg, mm, rpm

FILE = """
format = 1
name = "reversing test stand"

[[joints]]
joint_angle_deg = 6

[[joints]]
joint_angle_deg = 6

[[shafts]]
number = 2
length_mm = 1200
outer_mm = 76
wall_mm = 2
material = { yield_strength_MPa = 355, ultimate_strength_MPa = 600 }
notch = { bending = 1.3, torsion = 1.2 }

[duty]
speed_rpm = 1000
life_h = LIFE
torque_history = "torque.csv"
"""


def written(folder: Path, *, life: float = 5000.0, seconds: int = 600) -> Path:
    """Write the drive with its measured torque: ±1,600 N·m at 2 Hz, eight rows a period."""
    time = np.arange(16 * seconds + 1) / 16.0
    torque = 1600.0 * np.sin(4.0 * np.pi * time)
    rows = "\n".join(f"{t:.4f},{m:.4f}" for t, m in zip(time, torque, strict=True))
    (folder / "torque.csv").write_text(f"time_s,torque_Nm\n{rows}\n", encoding="utf-8")
    path = folder / "drive.toml"
    path.write_text(FILE.replace("LIFE", f"{life:g}"), encoding="utf-8")
    return path


@pytest.fixture
def drive(tmp_path):
    return load(written(tmp_path))


def one(verdicts, name):
    (found,) = (its for its in verdicts if its.check == name and its.run)
    return found


def test_the_life_by_hand(drive):
    """W_t = π(76⁴ - 72⁴)/(16·76) = 16.77 cm³; the tube turns slowest by cos 6°, its torque is 1600/cos 6°.

    σ_a = √3·1.2·τ = 199.5 MPa; S_e = 4.51·600^-0.265 · 1.51·76^-0.157 · 0.897 · 300 MPa = 170.3 MPa, so Goodman's
    safety is 0.854; A = (0.9·600)²/S_e, B = -⅓ lg(540/S_e); N = (σ_a/A)^(1/B) = 3.9e5 swings, at two a second 54 h.
    """
    modulus = math.pi * (0.076**4 - 0.072**4) / (16 * 0.076)
    swing = math.sqrt(3) * 1.2 * 1600 / math.cos(math.radians(6)) / modulus / 1e6
    endurance = 4.51 * 600**-0.265 * 1.51 * 76**-0.157 * 0.897 * 300
    slope = -math.log10(0.9 * 600 / endurance) / 3
    cycles = (swing / ((0.9 * 600) ** 2 / endurance)) ** (1 / slope)
    hours = cycles / 2 / 3600
    assert hours == pytest.approx(54.1, abs=0.1)
    found = strength(drive).shafts[1]
    # the two quarters at its ends count as halves of smaller swings: one in 1,200
    assert found.fatigue_life / 3600 == pytest.approx(hours, rel=2e-3)
    assert found.safety == pytest.approx(endurance / swing, rel=1e-6)


@pytest.mark.slow
def test_every_verdict_tells_of_it(drive):
    """5,000 h of two swings a second are 3.6e7, beyond the knee: nothing may damage, so both safeties are one."""
    verdicts = check(drive)
    safety, life = one(verdicts, "tube_fatigue"), one(verdicts, "shaft_life")
    assert (safety.state, life.state) == ("failed", "failed")
    assert safety.value == pytest.approx(0.854, abs=1e-3)
    assert life.value / 3600 == pytest.approx(54.1, abs=0.1)
    assert float(life.torque_factor) == pytest.approx(safety.value)
    found = strength(drive)
    assert found.enough is False
    assert found.governing.check == "tube_fatigue"
    assert found.rated_torque == pytest.approx(1600.0 * safety.value / 1.5, rel=1e-6)


@pytest.mark.slow
def test_a_short_life_uses_what_lies_below_the_knee(tmp_path):
    """A life of 54.1 h is just reached with this torque: safety 1; for half of it more torque would do."""
    hours = strength(load(written(tmp_path))).shafts[1].fatigue_life / 3600
    just = check(load(written(tmp_path, life=hours)))
    assert float(one(just, "tube_fatigue").value) == pytest.approx(1.0, rel=1e-6)
    assert float(one(just, "shaft_life").utilisation) == pytest.approx(1.0, rel=1e-5)  # six digits of the file
    assert float(one(check(load(written(tmp_path, life=0.5 * hours))), "tube_fatigue").value) > 1.05


@pytest.mark.slow
def test_the_size_that_lasts(drive):
    """The tube becomes larger, and the size found passes when it is put into the file."""
    found = size(drive, None, "tube:2")
    assert found.exact["shafts[1].outer_mm"] > 76.0
    assert found.governing.check == "tube_fatigue"
    after = strength(found.drive)
    assert after.enough
    assert math.isinf(after.shafts[1].fatigue_life)


@pytest.mark.slow
def test_a_remedy_makes_both_verdicts_pass(drive):
    thicker = [its for its in remedies(drive) if its.path == "shafts[1].outer_mm" and its.check == "tube_fatigue"]
    assert thicker
    assert "fatigue life of shaft 2" in thicker[0].solves


def measured(folder: Path, torque, speed=None):
    """Return the drive with another torque [N·m], four rows a second, and the input speed beside it [rpm]."""
    path = written(folder, seconds=1)
    columns = [0.25 * np.arange(len(torque)), torque, *([] if speed is None else [speed])]
    names = ["time_s", "torque_Nm", "speed_rpm"][: len(columns)]
    np.savetxt(folder / "torque.csv", np.transpose(columns), delimiter=",", header=",".join(names), comments="")
    return load(path)


def test_a_measured_torque_that_reverses_is_told_and_keeps_no_gap_closed(tmp_path):
    """Once a second it drives or brakes: 119 times in 119.75 s it passes through zero, 3,577 times an hour."""
    torque = 1600.0 * np.tile([1.0, 1.0, 1.0, 1.0, -0.5, -0.5, -0.5, -0.5], 60)
    names = ["torque_reversal", "gap_closure"]
    (found,) = [one for one in check(measured(tmp_path, torque), only=names) if one.run]
    assert (found.check, found.advice) == ("torque_reversal", True)
    assert (found.value, found.limit) == (2400.0, 1600.0)
    assert told(found.note, USUAL).startswith("3\u202f577 reversals per hour; the file gives no backlash")
    (found,) = [one for one in check(measured(tmp_path, 2000.0 + torque), only=names) if one.run]
    assert (found.check, found.value) == ("gap_closure", pytest.approx(1200.0))  # the least of it, not its peak


def test_many_drives_that_move_keep_a_measured_torque_that_reverses(tmp_path):
    """What is the same at every instant and in every drive is a verdict on each of them."""
    path = written(tmp_path, seconds=1)
    text = path.read_text(encoding="utf-8")
    for x, z in ((0, 0), (1200, -150)):
        text = text.replace("joint_angle_deg = 6", f"centre_mm = [{x}, 0, {z}]", 1)
    ends = "input.point_mm = [-300, 0, 0]\noutput.point_mm = [1500, 0, -300]\n[[joints]]"
    moves = 'kind = "harmonic"\nmoves = ["joints[1]", "output"]\nfrequency_Hz = 0.5\namplitude_mm = [0, 0, 100]\n'
    text = text.replace("length_mm = 1200\n", "").replace("[[joints]]", ends, 1)
    path.write_text(text.replace("[duty]", f"[[movements]]\n{moves}\n[duty]"), encoding="utf-8")
    many = check(load(path), vary={"shafts[1].outer_mm": np.array([[70.0], [76.0]])}, only=["torque_reversal"])
    assert [np.unique(np.asarray(one.value)) for one in many if one.run] == [3200.0]


def test_speeds_measured_beside_the_torque_are_in_use(tmp_path):
    """A run at 6,000 rpm counts where speeds are judged, though the duty says 1,000; life asks for no other speed."""
    torque, speed = np.full(40, 800.0), np.linspace(300.0, 6000.0, 40)
    still, fast = measured(tmp_path, torque), measured(tmp_path, torque, speed)
    names = ["critical_speed", "gap_closure"]
    before, after = ({one.check: one for one in check(drive, only=names) if one.run} for drive in (still, fast))
    assert after["critical_speed"].value == pytest.approx(6.0 * before["critical_speed"].value)
    assert after["gap_closure"].limit == pytest.approx(36.0 * before["gap_closure"].limit)  # joints shake by its square
    assert used_speeds(fast.duty) == pytest.approx((300 * rpm, 6000 * rpm))
    assert used_speeds(replace(fast.duty, speed=None)) == pytest.approx((300 * rpm, 6000 * rpm))
    rated = replace(Hooke(joint_angle=6 * deg), cross=Cross(span=80 * mm), needles=Needles(capacity=25e3))
    lives = [
        life(replace(fast, joints=(rated, rated), duty=replace(fast.duty, speed=one))) for one in (None, 1e3 * rpm)
    ]
    assert lives[0].of("iso").tolist() == pytest.approx(lives[1].of("iso").tolist())


def test_many_drives_at_once_are_the_single_ones(drive):
    widths = [70.0, 76.0, 95.0]
    names = ["tube_fatigue", "shaft_life"]
    many = {its.check: its.value for its in check(drive, only=names, vary={"shafts[1].outer_mm": widths})}
    for k, width in enumerate(widths):
        for its in check(drive, only=names, vary={"shafts[1].outer_mm": width}):
            assert float(its.value) == pytest.approx(float(many[its.check][k]), rel=1e-12)


def test_very_many_different_cycles_damage_as_one_by_one(drive):
    """A random torque has thousands of different cycles; in classes they damage as they do one by one."""
    rng = np.random.default_rng(7)
    counted = rainflow(900.0 * rng.standard_normal(6000))
    sorted_ = sorted_into_classes(counted)
    assert len(sorted_.range) < len(counted.range)
    assert sorted_.total == pytest.approx(counted.total)
    subject = design(drive)
    (tube,) = sections(subject, 1)
    plain = spectrum(subject, 1, tube)
    scale = plain.alternating[0] / (0.5 * 3200.0)  # [Pa] a N·m of amplitude
    rates = []
    for cycles in (counted, sorted_):
        swing, mean = 0.5 * scale * cycles.range, scale * np.abs(cycles.mean)
        use = swing / plain.endurance + mean / plain.ultimate
        level = 0.9 * plain.ultimate / plain.endurance
        reversed_ = swing / (1 - mean / plain.ultimate)
        life = (reversed_ / (level * 0.9 * plain.ultimate)) ** (-3.0 / np.log10(level))
        rates.append(np.sum(np.where(use > 1.0, cycles.count / life, 0.0)))
    assert rates[1] == pytest.approx(rates[0], rel=5e-3)  # classes of 0.5 % of the range at the knee


@pytest.mark.slow
def test_command_line_and_first_page(tmp_path, capsys):
    path = written(tmp_path)
    assert main(["check", str(path), "--json"]) == 1
    answered = json.loads(capsys.readouterr().out)
    rows = {row["check"]: row for row in answered["verdicts"]}
    assert rows["shaft_life"]["state"] == "failed"
    assert rows["shaft_life"]["value"] == pytest.approx(54.1, abs=0.1)
    assert rows["shaft_life"]["unit"] == "h"
    out = tmp_path / "report.html"
    assert main(["report", str(path), "-o", str(out)]) in (0, 1)
    page = out.read_text(encoding="utf-8")
    assert page.index("fatigue life of shaft 2") < page.index("safety, fatigue")  # before the chapter on strength


@pytest.mark.slow
@pytest.mark.parametrize("measured", [True, False])
def test_a_shaft_tires_in_all_poses_by_their_shares(drive, measured):
    """A quarter of the time at 25°: the damages a second add up, in the table of strength and in the verdict."""
    if not measured:
        drive = replace(drive, duty=replace(drive.duty, torque_history=None, torque=4500.0))
    raised = replace(drive, joints=(drive.joints[0], replace(drive.joints[1], joint_angle=25 * deg)))
    rates = [1.0 / strength(one).shafts[1].fatigue_life for one in (drive, raised)]
    assert rates[1] > 1.5 * rates[0]
    pose = Pose(name="raised", set=(("joints[1].joint_angle_deg", 25.0),), share=0.25)
    found = strength(replace(drive, poses=(pose,)))
    assert found.shafts[1].fatigue_life == pytest.approx(1.0 / (0.75 * rates[0] + 0.25 * rates[1]))
    if measured:
        verdict = one(check(replace(drive, poses=(pose,)), only=["shaft_life"]), "shaft_life")
        assert verdict.value == pytest.approx(found.shafts[1].fatigue_life)
        assert not verdict.note
