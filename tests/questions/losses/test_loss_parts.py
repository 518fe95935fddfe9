import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.drive.cross import Cross
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.shaft import Spline
from cardan.drive.support import Support
from cardan.questions.losses.losses import losses
from tests.builders.rubbing import CROSS, STEADY, single, sliding


def fields(parts):
    return [one.field for one in parts]


def test_what_is_left_out_is_named_with_its_key():
    drive, _swing = sliding()
    assert fields(losses(drive, STEADY).uncounted) == ["supports", "movements"]
    assert fields(losses(sliding(Spline(teeth=16))[0], STEADY).uncounted) == ["supports", "shafts[1].spline.friction"]
    joints = (
        Hooke(joint_angle=0.1, friction=0.1, cross=CROSS),
        Hooke(joint_angle=0.1),
        Hooke(joint_angle=0.1, friction=0.1),
    )
    assert fields(losses(Drive(joints=joints), STEADY).uncounted) == [
        "joints[1].friction",
        "joints[2].cross.span",
        "supports",
    ]
    partly = (
        Hooke(joint_angle=0.1, friction=0.1, cross=Cross(span=0.1)),
        Hooke(joint_angle=0.1, friction=0.1, cross=CROSS),
    )
    assert fields(losses(Drive(joints=partly), STEADY).uncounted) == ["joints[0].cross.journal", "supports"]


@pytest.mark.parametrize(
    ("supports", "say"),
    [
        ([(1, -0.1, False), (2, 0.1, False)], "leave the drive"),
        ([(1, -0.1, True), (1, -0.3, True), (2, 0.1, True), (2, 0.4, False)], "more than balance"),
    ],
)
def test_supports_that_balance_cannot_tell_apart_are_left_out(supports, say):
    held = tuple(
        Support(shaft=shaft, position=place, axial=axial, bore=0.04, friction=0.01) for shaft, place, axial in supports
    )
    found = losses(single(supports=held), STEADY)
    assert fields(found.uncounted) == ["supports"]
    assert say in found.uncounted[0].message
    assert np.all(found.supports == 0)


def test_a_drive_of_which_nothing_rubs_is_told_what_to_add():
    with pytest.raises(InputError) as caught:
        losses(Drive.from_angles([0.1, 0.2]), Duty())
    assert [problem.field for problem in caught.value.problems] == [
        "duty.speed",
        "duty.torque",
        "joints[0].friction",
        "joints[1].friction",
        "supports",
    ]
    with pytest.raises(InputError, match="standstill"):
        losses(single(), Duty(speed=0.0, torque=1.0))
