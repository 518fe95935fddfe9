"""What makes a drive: messages, limits, and problems found beside each other."""

from __future__ import annotations

import math

import numpy as np
import pytest

from cardan import Drive, InputError, motion
from cardan.drive.described import Input, Output
from cardan.drive.duty import Duty, Limits
from cardan.drive.fields.validity import point_problems
from cardan.drive.joints import Hooke
from cardan.drive.settings import Pose
from cardan.drive.shaft import Shaft, Spline
from cardan.reading.ranges import HUGE, allowed, in_range, out_of_range, shown
from cardan.units import Key, deg

LINE = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.1, 0.0), (3.0, 0.1, 0.1))
SPAN = Key("", "angle", low=0.0, below=0.5 * math.pi)


def fields(**parts: object) -> list[str]:
    with pytest.raises(InputError) as caught:
        Drive(**parts)  # type: ignore[arg-type]
    return [problem.field for problem in caught.value.problems]


def by_points(*points: tuple[float, float, float], **parts: object) -> dict[str, object]:
    return {
        "input": Input(point=points[0]),
        "output": Output(point=points[-1]),
        "joints": tuple(Hooke(centre=point) for point in points[1:-1]),
        **parts,
    }


def test_shows_values_in_the_preferred_unit_or_another() -> None:
    assert shown(20 * deg, SPAN) == "20°"
    assert shown(20 * deg, SPAN, "arcmin") == "1200 ′"
    assert shown(3.0, Key("")) == "3"


def test_tells_ranges_in_the_unit_of_the_reader() -> None:
    assert allowed(SPAN) == "at least 0° and less than 90°"
    assert allowed(SPAN, "rad") == "at least 0 rad and less than 1.5708 rad"
    assert allowed(Key("", "length", above=0.0, high=1.0), mirrored=True) == "at least -1000 mm and less than 0 mm"
    assert allowed(Key("")) == "a finite number"


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf, 2 * HUGE, -2 * HUGE])
def test_numbers_that_no_drive_has(value: float) -> None:
    key = Key("", "length")
    assert not in_range(key, value)
    assert in_range(key, HUGE)
    words = "a finite number" if not math.isfinite(value) else "no drive has such a number"
    assert words in out_of_range(str(value), key, value)


def test_every_accepted_size_can_be_computed() -> None:
    # The largest and the smallest drive that are accepted turn like the one of a metre, to rounding.
    usual = motion(Drive.from_points(LINE), [0.3]).ratio
    for size in (HUGE / 3.1, 1e-90):
        drive = Drive.from_points([[size * x for x in point] for point in LINE])
        np.testing.assert_allclose(motion(drive, [0.3]).ratio, usual, rtol=1e-13)


@pytest.mark.parametrize(
    ("points", "found"),
    [
        ([(0, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0)], ["points[2]", "points[3]"]),
        ([(0, 0, 0), (math.nan, 0, 0), (1, 0, 0), (1, 0, 0)], ["points[1]", "points[3]"]),
        ([(0, 0, 0), (1, 0, 0), (0, 0, 0), (2, 0, 0)], ["points", "points"]),
        ([(0, 0, 0), (1, 0, 0), (1, 1, 0)], ["points"]),
        ([(0, 0), (1, 0, 0), (2, 0, 0)], ["points[0]"]),
        ([(0, 0, 0), (1e-200, 0, 0), (2e-200, 0, 0)], ["points[1]", "points[2]"]),
        ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], []),
    ],
)
def test_points_of_an_axis(points: list[tuple[float, ...]], found: list[str]) -> None:
    assert [problem.field for problem in point_problems(points)] == found


def test_joints_that_coincide_or_fold_are_named() -> None:
    assert fields(**by_points((0, 0, 0), (1, 0, 0), (1, 0, 0), (2, 0, 0))) == ["joints[1].centre"]
    assert fields(**by_points((0, 0, 0), (1, 0, 0), (1, 1, 0))) == ["joints[0].centre"]
    assert fields(**by_points((0, 0, 0), (1, 0, 0), (1, 0, 0))) == ["output.point"]


@pytest.mark.parametrize(("side", "plan", "folds"), [(44.9, 0.0, False), (45.1, 0.0, True), (0.0, 60.0, True)])
def test_slopes_that_fold_are_refused(side: float, plan: float, folds: bool) -> None:
    shafts = tuple(
        Shaft(number=k, side_slope=sign * side * deg, plan_slope=sign * plan * deg) for k, sign in ((1, 1), (2, -1))
    )
    if folds:
        assert fields(joints=(Hooke(),), shafts=shafts) == ["shafts[1].side_slope"]
    else:
        assert math.degrees(motion(Drive(joints=(Hooke(),), shafts=shafts), [0.0]).joint_angle[0]) == pytest.approx(
            2 * side
        )


def test_what_no_question_can_use_is_refused() -> None:
    joints = (Hooke(joint_angle=0.1), Hooke(joint_angle=0.2))
    limits = Limits(spline_overlap=0.05)
    assert fields(joints=joints, limits=limits) == ["limits.spline_overlap"]
    splined = (Shaft(number=2, spline=Spline(engaged=0.1)),)
    assert Drive(joints=joints, limits=limits, shafts=splined).limits == limits
    ends = (Shaft(number=1, weight=2.0), Shaft(number=3, yoke_fixed=True, spline=Spline()))
    assert fields(joints=joints, shafts=ends) == ["shafts[0].weight", "shafts[2].yoke_fixed"]


def test_poses_are_judged_with_the_drive() -> None:
    joints = (Hooke(joint_angle=0.1), Hooke(joint_angle=0.2))
    poses = (
        Pose(name="a", share=0.7, set=(("joints[0].joint_angle_deg", 95.0),)),
        Pose(name="a", share=0.7, set=(("joints[2].joint_angle_deg", 5.0), ("shafts[1].yoke_angle_deg", 3.0))),
    )
    assert fields(joints=joints, poses=poses) == [
        "poses[1].name",
        "poses[1].share",
        "poses[0].set: joints[0].joint_angle_deg",
        "poses[1].set: joints[2].joint_angle_deg",
    ]


def test_a_bad_field_does_not_hide_the_others() -> None:
    parts = by_points((0, 0, 0), (1, 0, 0), (1, 0, 0), (2, 0, 0), duty=Duty(speed=math.nan))
    assert fields(**parts) == ["duty.speed", "joints[1].centre"]


def test_texts_that_terminals_would_obey_are_refused() -> None:
    joint = Hooke(joint_angle=0.1, name="two\nlines")
    assert fields(name="red\x1b[31m", joints=(joint,), poses=(Pose(name="\x9b0m", set=()),)) == [
        "name",
        "joints[0].name",
        "poses[0].name",
    ]
    Drive(name="Müller 轴 🚜", note="two\n\tlines", joints=(Hooke(joint_angle=0.1),))
