"""Sizes, materials and figures that contradict each other are refused, all at once, each with its path."""

import math
from dataclasses import replace

import pytest

from cardan import Drive, InputError
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty, Vehicle
from cardan.drive.joint_parts import Needles
from cardan.drive.joints import Hooke
from cardan.drive.material import Material
from cardan.drive.shaft import Layup, Notch, Ply, Shaft, Spline
from cardan.units import mm

PLY = Ply(along=135e9, across=10e9, shear=5e9)
PLAIN = Drive.from_angles([0.1, 0.1])


def refused(**changes):
    with pytest.raises(InputError) as error:
        replace(PLAIN, **changes)
    return {problem.field for problem in error.value.problems}


def tube(**fields):
    return (Shaft(number=2, **fields),)


@pytest.mark.parametrize(
    ("fields", "path"),
    [
        ({"notch": Notch(bending=1.5)}, "shafts[1].notch"),
        ({"finish": "ground"}, "shafts[1].finish"),
        ({"layup": Layup(angles=(0.1,), ply_thickness=1 * mm, ply=PLY)}, "shafts[1].layup"),
        (
            {"outer": 0.01, "layup": Layup(angles=(0.1,) * 6, ply_thickness=1 * mm, ply=PLY)},
            "shafts[1].layup.ply_thickness",
        ),
        ({"outer": 0.1, "wall": 0.002, "layup": Layup(angles=(0.1,), ply_thickness=1 * mm, ply=PLY)}, "shafts[1].wall"),
        ({"outer": 0.1, "layup": Layup(angles=(), ply_thickness=1 * mm, ply=PLY)}, "shafts[1].layup.angles"),
        ({"spline": Spline(outer=0.04, root=0.04)}, "shafts[1].spline.root"),
        ({"spline": Spline(outer=0.04, root=0.036, chamfer=1 * mm)}, "shafts[1].spline.chamfer"),
        (
            {"outer": 0.1, "material": Material(yield_strength=4e8, ultimate_strength=3e8)},
            "shafts[1].material.ultimate_strength",
        ),
    ],
)
def test_sizes_of_a_shaft_that_do_not_go_together(fields, path):
    assert path in refused(shafts=tube(**fields))


def test_all_of_them_are_told_at_once():
    cross = Cross(
        span=0.1, journal=0.02, journal_bore=0.02, material=Material(yield_strength=2.0, ultimate_strength=1.0)
    )
    joints = (replace(PLAIN.joints[0], cross=cross), PLAIN.joints[1])
    vehicle = Vehicle(engine_torque=100.0, engine_power=5e4, engine_speed=300.0)
    assert refused(joints=joints, duty=Duty(vehicle=vehicle)) == {
        "joints[0].cross.journal_bore",
        "joints[0].cross.material.ultimate_strength",
        "duty.vehicle.engine_power",
        "duty.vehicle.engine_speed",
    }


def test_what_goes_together_is_taken():
    layup = Layup(angles=(0.1, -0.1), ply_thickness=1 * mm, ply=PLY)
    made = replace(
        PLAIN, shafts=tube(outer=0.1, layup=layup, notch=Notch(torsion=1.2), spline=Spline(outer=0.05, root=0.04))
    )
    assert made.shafts[1].layup == layup


@pytest.mark.parametrize(("count", "fine"), [(23, True), (24, False), (40, False)])
def test_needles_that_have_no_room_around_their_journal(count, fine):
    """23 cylinders of 2.5 mm touch each other on a pitch circle of 18.35 mm: 2.5/sin(π/23)."""
    assert 2.5 / math.sin(math.pi / 23) < 16.0 + 2.5 < 2.5 / math.sin(math.pi / 24)
    needles = Needles(count=count, diameter=2.5e-3, length=14e-3)

    def made():
        return Drive(joints=(Hooke(joint_angle=0.1, cross=Cross(span=0.08, journal=0.016), needles=needles),))

    if fine:
        assert made().joints[0].needles == needles
        return
    with pytest.raises(InputError, match=r"no room around a journal of 16 mm; 23 have"):
        made()
