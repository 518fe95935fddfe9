import math
import pickle
from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.drive.described import Input, Output
from cardan.drive.duty import Duty
from cardan.drive.fields.validity import MAX_JOINTS
from cardan.drive.joints import JOINTS, Hooke
from cardan.drive.movement import MOVEMENTS, Harmonic
from cardan.drive.shaft import Shaft, Spline
from cardan.units import deg

LINE = [[0, 0, 0], [1, 0, 0], [2, 0.1, 0], [3, 0.1, 0]]


def fields(make):
    with pytest.raises(InputError) as caught:
        make()
    return sorted(problem.field for problem in caught.value.problems)


def test_drives_compare_hash_and_cross_processes():
    one, two = Drive.from_points(LINE, yoke_angles=[0.1]), Drive.from_points(np.asarray(LINE), yoke_angles=[0.1])
    assert one == two
    assert hash(one) == hash(two)
    assert pickle.loads(pickle.dumps(one)) == one
    assert one != replace(one, name="other")
    with pytest.raises(FrozenInstanceError):
        one.name = "x"


@pytest.mark.parametrize(
    ("drive", "form"),
    [
        (Drive.from_points(LINE), "points"),
        (Drive.from_angles([0.1, 0.2]), "angles"),
        (
            Drive(
                joints=(Hooke(),),
                shafts=(
                    Shaft(number=1, side_slope=0.0, plan_slope=0.0),
                    Shaft(number=2, side_slope=0.1, plan_slope=0.0),
                ),
            ),
            "slopes",
        ),
    ],
)
def test_the_form_is_the_one_given(drive, form):
    assert drive.form == form
    assert [shaft.number for shaft in drive.shafts] == list(range(1, len(drive.joints) + 2))


def test_shafts_not_given_are_filled_in():
    drive = Drive(joints=Drive.from_angles([0.1, 0.1, 0.1]).joints, shafts=(Shaft(number=3, yoke_angle=0.5),))
    assert [shaft.yoke_angle for shaft in drive.shafts] == [0, 0, 0.5, 0]


BAD = {
    "no joint": (lambda: Drive(joints=()), ["joints"]),
    "no joint angle": (lambda: Drive.from_angles([]), ["joints"]),
    "a right angle": (lambda: Drive.from_angles([math.pi / 2]), ["joints[0].joint_angle"]),
    "a negative bend": (lambda: Drive.from_angles([0.1, -0.1]), ["joints[1].joint_angle"]),
    "two bad bends": (lambda: Drive.from_angles([2.0, math.nan]), ["joints[0].joint_angle", "joints[1].joint_angle"]),
    "too few twists": (lambda: Drive.from_angles([0.1] * 3, plane_twists=[0.1]), ["plane_twists"]),
    "too many yokes": (lambda: Drive.from_angles([0.1], yoke_angles=[0.1]), ["yoke_angles"]),
    "an infinite yoke": (lambda: Drive.from_angles([0.1] * 2, yoke_angles=[math.inf]), ["shafts[1].yoke_angle"]),
    "an infinite start": (lambda: Drive.from_angles([0.1], start_phase=math.nan), ["input.start_phase"]),
    "two points": (lambda: Drive.from_points([[0, 0, 0], [1, 0, 0]]), ["points"]),
    "no points": (lambda: Drive.from_points([]), ["points"]),
    "equal points": (lambda: Drive.from_points([[0, 0, 0], [0, 0, 0], [1, 0, 0]]), ["points[1]"]),
    "two infinite points": (
        lambda: Drive.from_points([[0, 0, math.nan], [1, 0, 0], [2, math.inf, 0]]),
        ["points[0]", "points[2]"],
    ),
    "a fold": (lambda: Drive.from_points([[0, 0, 0], [1, 0, 0], [0.9, 0, 0]]), ["points"]),
    "too many joints": (lambda: Drive.from_angles([0.1] * (MAX_JOINTS + 1)), ["joints"]),
    "half a geometry": (
        lambda: Drive(input=Input(point=(0, 0, 0)), joints=(Hooke(centre=(1, 0, 0)), Hooke())),
        ["joints[1].centre", "output.point"],
    ),
    "two geometries": (
        lambda: Drive(
            input=Input(point=(0, 0, 0)),
            output=Output(point=(2, 0, 0)),
            joints=(Hooke(centre=(1, 0, 0), joint_angle=0.1),),
        ),
        ["joints[0].joint_angle"],
    ),
    "a yoke angle on an end": (
        lambda: Drive(joints=(Hooke(joint_angle=0.1),), shafts=(Shaft(number=1, yoke_angle=0.1),)),
        ["shafts[0].yoke_angle"],
    ),
    "a shaft too many": (
        lambda: Drive(joints=(Hooke(joint_angle=0.1),), shafts=(Shaft(number=4),)),
        ["shafts[3].number"],
    ),
    "a shaft twice": (
        lambda: Drive(joints=(Hooke(joint_angle=0.1),), shafts=(Shaft(number=2), Shaft(number=2))),
        ["shafts[1].number"],
    ),
    "no teeth": (
        lambda: Drive(joints=(Hooke(joint_angle=0.1),) * 2, shafts=(Shaft(number=2, spline=Spline(teeth=0)),)),
        ["shafts[1].spline.teeth"],
    ),
    "half a tooth": (
        lambda: Drive(joints=(Hooke(joint_angle=0.1),) * 2, shafts=(Shaft(number=2, spline=Spline(teeth=16.5)),)),
        ["shafts[1].spline.teeth"],
    ),
    "a length that the points give": (
        lambda: replace(Drive.from_points(LINE), shafts=(Shaft(number=2, length=1.0),)),
        ["shafts[1].length"],
    ),
    "an infinite speed": (lambda: replace(Drive.from_points(LINE), duty=Duty(speed=math.inf)), ["duty.speed"]),
    "a point that does not exist": (
        lambda: replace(
            Drive.from_points(LINE),
            movements=(Harmonic(moves=("joints[2]",), amplitude=(0.0, 0.0, 0.1), frequency=1.0),),
        ),
        ["movements[0].moves"],
    ),
}


@pytest.mark.parametrize(("make", "wanted"), BAD.values(), ids=BAD)
def test_what_is_no_drive_is_refused_by_name(make, wanted):
    assert fields(make) == wanted


def test_messages_carry_the_value_and_what_is_allowed():
    with pytest.raises(
        InputError, match=r"joints\[0\]\.joint_angle: 94° is not allowed; allowed is at least 0° and less than 90°"
    ):
        Drive.from_angles([94 * deg])


def test_the_most_joints_allowed_work():
    from cardan import motion

    drive = Drive.from_angles([0.05] * MAX_JOINTS)
    assert np.all(np.isfinite(motion(drive, [1.0]).slope))


@pytest.mark.parametrize(("registry", "package"), [(JOINTS, "cardan.drive.joints"), (MOVEMENTS, None)])
def test_no_kind_is_left_out(registry, package):
    from importlib import import_module
    from pkgutil import iter_modules

    for kind, made in registry.items():
        assert made.kind == kind
    if package:
        folder = import_module(package)
        modules = {module.name for module in iter_modules(folder.__path__)} - {"joint", "laws", "common"}
        assert modules == {made.__module__.rsplit(".", 1)[1] for made in registry.values()}
    else:
        from cardan.drive import movement

        classes = {thing for thing in vars(movement).values() if isinstance(thing, type)}
        declared = {made for made in classes if "kind" in vars(made)}
        assert declared == set(registry.values())
