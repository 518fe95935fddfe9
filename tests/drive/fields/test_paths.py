"""Paths: read what stands there, change it, say where they lead nowhere."""

from __future__ import annotations

import math
import re

import pytest

from cardan import Drive, InputError, example
from cardan.drive.fields.paths import pose_drives, read, with_values
from cardan.io import loads

DRIVE = loads("""
format = 1
name = "trailer"
input.point_mm = [-800, 0, 0]
output.point_mm = [1000, 0, 0]
[[joints]]
centre_mm = [-400, 0, 0]
[[joints]]
centre_mm = [480, 0, 0]
[[shafts]]
number = 2
spline = { teeth = 16, engaged_mm = 220, gap_mm = 130 }
[duty]
speed_rpm = 540
[[movements]]
kind = "hitch"
moves = ["joints[1]", "output"]
pivot_mm = [0, 0, 0]
yaw_deg = 40
frequency_Hz = 0.1
""")


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ("joints[1].centre_mm[0]", 480.0),
        ("joints[1].centre_m", (0.48, 0.0, 0.0)),
        ("shafts[1].yoke_angle_deg", 0.0),
        ("shafts[1].spline.engaged_mm", 220.0),
        ("duty.speed_rpm", 540.0),
        ("movements[0].yaw_deg", 40.0),
        ("input.point_mm[0]", -800.0),
        ("name", "trailer"),
    ],
)
def test_reads(path: str, value: object) -> None:
    assert read(DRIVE, path) == pytest.approx(value)


def test_writes_what_it_reads() -> None:
    changed = with_values(
        DRIVE, {"joints[1].centre_mm[2]": 50, "shafts[1].yoke_lead_deg": 10, "duty.speed_rad_s": 3, "name": "new"}
    )
    assert changed.joints[1].centre == (0.48, 0.0, 0.05)
    assert changed.shafts[1].yoke_angle == pytest.approx(-math.radians(10))
    assert (changed.duty.speed, changed.name) == (3.0, "new")
    assert read(changed, "shafts[1].yoke_lead_deg") == pytest.approx(10)
    assert with_values(DRIVE, {"joints[1].centre_mm": [480, 0, 0]}) == DRIVE


@pytest.mark.parametrize(
    ("path", "value", "words"),
    [
        ("joints[1].center_mm", [0, 0, 0], "the nearest is joints[1].centre_mm"),
        ("joints[7].centre_mm", [0, 0, 0], "no index 7"),
        ("joints[1]", 3, "whole table"),
        ("joints", 3, "whole table"),
        ("duty", 3, "whole table"),
        ("duty.speed_rpm.x", 3, "beyond a value"),
        ("duty.speed", 3, "needs a unit: write speed_rpm"),
        ("duty.speed_rpm", [3], "must be"),
        ("duty.speed_rpm", "fast", "must be"),
        ("name", 3, "must be a text, not 3"),
        ("joints[1].centre_mm", 3, "must be"),
        ("joints[1].centre_mm[0]", [3], "must be"),
        ("joints[1].centre_mm[0", 3, "not a step of a path"),
        ("shafts[1].spline.teeth", 2.5, "must be"),
    ],
)
def test_says_where_a_path_leads_nowhere(path: str, value: object, words: str) -> None:
    with pytest.raises(InputError, match=re.escape(words)) as caught:
        with_values(DRIVE, {path: value})
    assert caught.value.field == path


def test_all_bad_paths_at_once() -> None:
    with pytest.raises(InputError) as caught:
        with_values(DRIVE, {"a": 1, "joints[9].joint_angle_deg": 2})
    assert len(caught.value.problems) == 2


def test_poses() -> None:
    drives = pose_drives(example("rolling-mill-upper-spindle"))
    assert [round(1e3 * drive.joints[1].centre[2]) for drive in drives] == [420, 370, 760]  # type: ignore[index]
    assert all(not drive.poses for drive in drives)
    assert pose_drives(Drive.from_angles([0.1])) == ()
