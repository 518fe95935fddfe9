"""A slip yoke on an end shaft takes up the length of the shaft beside it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from cardan import check, forces
from cardan.checks.movement_loads import FEW, extreme_lengths, lengths_at
from cardan.io.drive_file import loads
from cardan.questions.motion.articulation import articulation
from cardan.questions.motion.length import slip_ends
from cardan.questions.motion.moving_points import moving_points

POINTS = np.asarray([[-300, 0, 0], [0, 0, 0], [1400, 50, -100], [1700, 0, -120]]) * 1e-3
SPLINE = "spline = { engaged_mm = 90, gap_mm = 20, friction = 0.1, mean_diameter_mm = 40 }"
DRIVE = f"""format = 1
input.point_mm = [-300, 0, 0]
output.point_mm = [1700, 0, -120]
[[joints]]
centre_mm = [0, 0, 0]
[[joints]]
centre_mm = [1400, 50, -100]
[[shafts]]
number = 1
{SPLINE}
[[movements]]
kind = "body"
moves = ["joints[1]", "output"]
pivot_mm = [200, 30, -50]
amplitude_mm = [15, -10, 60]
pitch_deg = 2
frequency_Hz = 1.5
"""


def slip(points, drawn):
    """How far joint 1 of points (4, 3) slips along shaft 1 until joint 2 is as far from it as drawn [m]."""
    along = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
    return brentq(lambda s: np.linalg.norm(points[2] - points[1] - s * along) - drawn, -0.3, 0.3, xtol=1e-15)


def slips(drive, reverse=False):
    """How far it slips at many instants."""
    drawn = np.linalg.norm(POINTS[2] - POINTS[1])
    moved = moving_points(POINTS, drive.movements, np.linspace(0.0, 1 / 1.5, 4001))[0]
    return np.asarray([slip(one[::-1] if reverse else one, drawn) for one in moved]), moved


def test_the_yoke_slips_until_the_shaft_beside_has_its_length():
    drive = loads(DRIVE)
    (one,), (way, _moved) = articulation(drive).splines, slips(drive)
    assert one.shaft == 1
    assert one.engaged_min == pytest.approx(0.09 - way.max(), abs=1e-8)
    assert one.gap_min == pytest.approx(0.02 + way.min(), abs=1e-8)
    assert one.max_rate == pytest.approx(np.abs(np.gradient(way, 1 / 6000)).max(), rel=1e-4)
    steps = np.diff(way, 2) * 6000**2
    assert one.max_acceleration == pytest.approx(np.abs(steps).max(), rel=1e-3)
    assert articulation(drive).warnings == ()


def test_so_does_that_of_the_output():
    drive = loads(DRIVE.replace("number = 1", "number = 3"))
    (one,), (way, moved) = articulation(drive).splines, slips(drive, reverse=True)
    own = np.linalg.norm(moved[:, 3] - moved[:, 2], axis=-1)
    whole = own - own[0] + way
    assert one.shaft == 3
    assert one.engaged_min == pytest.approx(0.09 - whole.max(), abs=1e-8)
    assert one.gap_min == pytest.approx(0.02 + whole.min(), abs=1e-8)


def test_the_check_judges_what_articulation_tells():
    drive = loads(DRIVE)
    (one,) = articulation(drive).splines
    engaged, left = check(drive, only=["spline_overlap"])
    assert engaged.value == pytest.approx(one.engaged_min, abs=1e-12)
    assert left.value == pytest.approx(one.gap_min, abs=1e-12)
    assert (engaged.passed, left.passed) == (True, True)
    short = loads(DRIVE.replace("engaged_mm = 90", "engaged_mm = 9"))
    assert [one.passed for one in check(short, only=["spline_overlap"])] == [False, True]
    assert [flag.field for one in articulation(short).splines for flag in one.flags] == ["shafts[0].spline.engaged"]


def test_poses_count_from_the_drive_as_drawn():
    still = DRIVE.partition("[[movements]]")[0]
    drive = loads(f'{still}[[poses]]\nname = "low"\nset = {{ "joints[1].centre_mm" = [1412, 40, -160] }}\n')
    low = POINTS.copy()
    low[2] = [1.412, 0.04, -0.16]
    way = slip(low, np.linalg.norm(POINTS[2] - POINTS[1]))
    engaged, left = check(drive, only=["spline_overlap"])
    assert engaged.value == pytest.approx(0.09 - way, abs=1e-12)
    assert left.value == pytest.approx(0.02, abs=1e-12), "in the pose there is more"


def test_a_spline_of_its_own_comes_first():
    drive = loads(DRIVE.replace("[[movements]]", f"[[shafts]]\nnumber = 2\n{SPLINE}\n[[movements]]"))
    assert slip_ends(drive) == ()
    assert [one.shaft for one in articulation(drive).splines] == [2]


def test_many_drives_slip_as_each():
    drive = loads(DRIVE)
    some = POINTS + np.random.default_rng(1).normal(scale=0.01, size=(FEW + 5, 4, 3))
    rest = lengths_at(some, np.ones(3), ())
    for many, one in zip(
        extreme_lengths(some, drive.movements, rest, (0,)),
        extreme_lengths(some[:1], drive.movements, rest[:1], (0,)),
        strict=True,
    ):
        assert many[0] == pytest.approx(one[0], abs=2e-5)  # of many by parabolas through the instants
        assert many[:, 1] == pytest.approx(rest[:, 1], abs=1e-12)


def test_friction_of_the_yoke_turns_round_with_its_slip():
    supports = "".join(
        f"[[supports]]\nshaft = {k}\nposition_mm = {at}\naxial = true\ntilt = true\n" for k, at in ((1, -200), (3, 150))
    )
    drive = loads(f"{DRIVE}{supports}[duty]\nspeed_rpm = 90\ntorque_Nm = 500\n")
    found = forces(drive, angle=np.linspace(0.0, 4.0 * np.pi, 81), movement=drive.movements)
    times = np.asarray(found.angle) / found.speed[0, 0]
    moved = moving_points(POINTS, drive.movements, times)[0]
    way = np.gradient([slip(one, np.linalg.norm(POINTS[2] - POINTS[1])) for one in moved], times)
    thrust = np.asarray(found.spline_thrust)[0]
    clear = np.abs(way) > 1e-2
    assert clear.sum() > 50
    assert np.all(np.sign(thrust[clear]) == np.sign(thrust[clear][0] * way[clear][0] * way[clear]))
    assert thrust[clear].min() < 0.0 < thrust[clear].max()
