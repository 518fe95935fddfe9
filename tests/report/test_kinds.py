"""Every kind of joint: a drive file that loads, is written as it was read, moves, draws and has a report."""

from __future__ import annotations

import json

import pytest

from cardan import motion
from cardan.answers.reader import USUAL
from cardan.cli.main import main
from cardan.drive.drive import Drive
from cardan.drive.joints import JOINTS, Hooke
from cardan.io import dumps, loads
from cardan.questions.motion.kinds import kind_name, steep
from cardan.report.report import page
from cardan.units import deg
from tests.fixtures.joint_keys import KEYS

LOADED = """
[duty]
torque_Nm = 300
speed_rpm = 900

[[supports]]
shaft = 1
position_mm = -200
axial = true

[[supports]]
shaft = 1
position_mm = -50
"""


def file_of(kind: str) -> str:
    return f"""format = 1
name = "one of each"
input.point_mm = [-300, 0, 0]
output.point_mm = [1100, 0, 20]

[[joints]]
kind = "{kind}"
centre_mm = [0, 0, 0]
{KEYS[kind]}

[[joints]]
centre_mm = [600, 0, 30]

[[shafts]]
number = 2
yoke_angle_deg = 15
outer_mm = 60
wall_mm = 3
{LOADED}"""


def test_every_kind_has_a_file_here() -> None:
    assert set(KEYS) == set(JOINTS)
    assert {kind_name(made()) for name, made in JOINTS.items() if name != "offset_cross"}


@pytest.mark.parametrize("kind", KEYS)
def test_a_file_is_written_as_it_was_read(kind: str) -> None:
    drive = loads(file_of(kind))
    assert drive.joints[0].kind == kind
    for form in ("toml", "json"):
        assert loads(dumps(drive, form=form), form=form) == drive


@pytest.mark.slow
@pytest.mark.parametrize("kind", [kind for kind in KEYS if kind != "hooke"])
def test_a_report_tells_of_every_kind(kind: str) -> None:
    drive = loads(file_of(kind).replace(LOADED, "").replace("outer_mm = 60\nwall_mm = 3\n", ""))
    text = page(drive)
    assert kind_name(drive.joints[0]) in text
    assert "self-check leaves more than rounding" not in text


@pytest.mark.slow
def test_a_report_names_what_it_leaves_out() -> None:
    text = page(loads(file_of("tripod")))
    assert "forces: not answered" not in text
    assert "Not run (judges Hooke joints, not a joint of kind tripod)" in text


@pytest.mark.slow
def test_a_report_tells_which_joint_could_be_even() -> None:
    text = page(loads(file_of("pin_coupling")))
    assert "Joint 1 is uniform where the parts of both its shafts are alike. What the other joints add" in text


@pytest.mark.parametrize("kind", ["double_cardan", "rzeppa", "pin_coupling"])
def test_the_command_line_tells_of_mixed_chains(kind: str, tmp_path, capsys) -> None:
    file = tmp_path / "drive.toml"
    file.write_text(file_of(kind), encoding="utf-8")
    assert main(["motion", str(file), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert [row["kind"] for row in told["joints"]] == [kind, "hooke"]
    ratio = motion(loads(file_of(kind))).ratio
    assert told["ratio_max"] == pytest.approx(ratio.max(), rel=1e-5)
    assert told["ratio_min"] == pytest.approx(ratio.min(), rel=1e-5)


def test_keys_of_another_kind_are_named() -> None:
    from cardan.errors import InputError

    text = file_of("tripod").replace(
        "track_radius_mm = 20", "track_radius_mm = 20\ncross = { span_mm = 80 }\nballs = 6"
    )
    with pytest.raises(InputError) as caught:
        loads(text)
    told = {problem.field: problem.message for problem in caught.value.problems}
    assert "[[joints]] kind = 'hooke'" in told["joints[0].cross"]
    assert "[[joints]] kind = 'rzeppa'" in told["joints[0].balls"]


def test_steep_joints_are_judged_by_their_kind() -> None:
    assert steep(JOINTS["rzeppa"](), 1, 46 * deg) is None
    assert "Rzeppa" in steep(JOINTS["rzeppa"](), 1, 48 * deg).told(USUAL)
    assert "cross joint" in steep(Hooke(), 1, 46 * deg).told(USUAL)
    assert "joints[0].kind" not in page(Drive(joints=(JOINTS["constant_velocity"](joint_angle=0.3),)))
