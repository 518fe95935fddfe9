"""Values that are possible but hardly meant are pointed out, and never changed."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from cardan import Drive, example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.cli.main import main
from cardan.drive.cross import Cross
from cardan.drive.drive import Input
from cardan.drive.duty import Case, Duty
from cardan.drive.fields.plausibility import doubts
from cardan.drive.joints import Hooke
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft
from cardan.report.subject import asked
from cardan.report.summary import warnings
from cardan.units import deg, rpm

EXAMPLES = sorted(path.stem for path in Path("examples").glob("*.toml"))

DRIVE = Drive(
    joints=(Hooke(joint_angle=0.1, cross=Cross(span=0.08, journal=0.02)), Hooke(joint_angle=0.1)),
    shafts=(Shaft(number=2, length=1.2, outer=0.08, wall=0.003, material=Material(yield_strength=350e6)),),
    duty=Duty(torque=300.0, speed=1500 * rpm, life=3.6e6),
)


def said(drive, reader=USUAL):
    return [told(one.text, reader).replace("\u202f", " ") for one in doubts(drive)]


@pytest.mark.parametrize("name", EXAMPLES)
def test_nothing_is_odd_about_the_examples(name):
    assert said(example(name)) == []


def test_sizes_a_thousand_times_off_are_told_with_what_may_be_meant():
    shaft = DRIVE.shafts[1]
    for value, off, text in (
        (shaft, replace(shaft, length=1200.0), "shafts[1].length_mm is 1 200 000 mm; did you mean 1 200 mm?"),
        (shaft, replace(shaft, length=0.0012), "shafts[1].length_mm is 1.2 mm; did you mean 1 200 mm?"),
        (
            shaft,
            replace(shaft, material=Material(yield_strength=350.0)),
            "shafts[1].material.yield_strength_MPa is 0.00035 MPa; did you mean 350 MPa?",
        ),
    ):
        drive = replace(DRIVE, shafts=tuple(off if one is value else one for one in DRIVE.shafts))
        assert said(drive) == [text]
    cross = replace(DRIVE.joints[0], cross=Cross(span=80.0, journal=20.0))
    assert said(replace(DRIVE, joints=(cross, DRIVE.joints[1]))) == [
        "joints[0].cross.span_mm is 80 000 mm; did you mean 80 mm?",
        "joints[0].cross.journal_mm is 20 000 mm; did you mean 20 mm?",
    ]
    long = replace(DRIVE, shafts=tuple(replace(one, length=1200.0) if one is shaft else one for one in DRIVE.shafts))
    assert "in; did you mean" in said(long, Reader(units={"length": "in"}))[0]


def test_joints_that_stand_far_apart_are_told():
    far = Drive(
        joints=(Hooke(centre=(0.0, 0.0, 0.0)), Hooke(centre=(1200.0, 0.0, 10.0))),
        input=Input(point=(-400.0, 0.0, 0.0)),
        output=replace(DRIVE.output, point=(1600.0, 0.0, 10.0)),
    )
    assert said(far) == ["joints 1 and 2 are 1 200 042 mm apart; did you mean 1 200.04 mm?"]


def test_angles_that_look_like_radians_are_told():
    small = Drive.from_angles([0.35 * deg, 0.26 * deg])
    assert said(small) == [
        "joints[0].joint_angle_deg is 0.35°, which looks like radians; did you mean 20.05°?",
        "joints[1].joint_angle_deg is 0.26°, which looks like radians; did you mean 14.9°?",
    ]
    assert said(Drive.from_angles([0.35 * deg, 8 * deg])) == []
    quarter = Drive.from_angles([0.1, 0.1], yoke_angles=[1.5708 * deg])
    assert said(quarter) == ["shafts[1].yoke_angle_deg is 1.5708°, which looks like radians; did you mean 90°?"]


def test_signs_and_absurd_values_are_told():
    odd = replace(DRIVE, duty=Duty(torque=-300.0, speed=-1500 * rpm))
    drives, turns = said(odd)
    assert drives.startswith("duty.torque_Nm is −300 N·m, less than zero: the load drives")
    assert turns.startswith("duty.speed_rpm is −1 500 rpm, less than zero: the input turns the other way")
    fast = replace(DRIVE, duty=Duty(torque=300.0, speed=5e9))
    assert said(fast)[0].endswith("; is that so?") or "did you mean" in said(fast)[0]


def test_load_cases_are_looked_at_as_the_duty_is():
    case = Case(name="start", torque=3e8, speed_range=(1.0, 3e5))
    assert said(replace(DRIVE, duty=Duty(torque=300.0, speed=100.0, cases=(case,)))) == [
        "duty.cases[0].torque_Nm is 300 000 000 N·m; did you mean 300 000 N·m?",
        "duty.cases[0].speed_range_rpm[1] is 2 864 789 rpm; did you mean 2 864.79 rpm?",
    ]


def test_commands_and_report_point_it_out_and_change_nothing(tmp_path, capsys):
    file = tmp_path / "off.toml"
    file.write_text(
        "format = 1\n[duty]\nspeed_rpm = 500\n[[joints]]\njoint_angle_deg = 10\n[[joints]]\njoint_angle_deg = 10\n"
        "[[shafts]]\nnumber = 2\nlength_m = 1200\n",
        "utf-8",
    )
    before = file.read_text("utf-8")
    assert main(["motion", str(file)]) == 0
    assert "did you mean 1 200 mm?" in capsys.readouterr().out.replace("\u202f", " ")
    assert main(["motion", str(file), "--json"]) == 0
    remarks = json.loads(capsys.readouterr().out)["remarks"]
    assert any("did you mean" in str(one) for one in remarks)
    assert file.read_text("utf-8") == before
    off = replace(DRIVE, shafts=tuple(replace(one, length=1200.0) if one.number == 2 else one for one in DRIVE.shafts))
    assert "did you mean" in str(told(next(warnings(asked(off, None, None))).text, USUAL))
