"""Duty cycles and ratings that contradict themselves are refused by name."""

import pytest

from cardan import Drive, InputError
from cardan.drive.duty import Block, Duty, History
from cardan.drive.joint_parts import Rating
from cardan.drive.joints import Hooke


def cycle(*shares):
    return tuple(Block(torque=10.0, speed=1.0, share=share) for share in shares)


def drive(**duty):
    return Drive(joints=(Hooke(joint_angle=0.1),), duty=Duty(**duty))


def test_blocks_make_up_the_whole_time_within_a_ten_thousandth():
    assert drive(blocks=cycle(0.3, 0.6999)).duty.blocks[1].share == 0.6999
    for shares in ((0.5,), (0.3, 0.6998), (0.6, 0.6)):
        with pytest.raises(InputError, match="add up to") as caught:
            drive(blocks=cycle(*shares))
        assert [(one.field, one.code) for one in caught.value.problems] == [("duty.blocks", "inconsistent")]


@pytest.mark.parametrize(
    ("times", "torques", "text"),
    [((0.0, 1.0), (1.0,), "1 values given for 2"), ((1.0, 0.0), (1.0, 2.0), "does not rise"), ((), (1.0,), "empty")],
)
def test_rows_of_a_history_are_a_table(times, torques, text):
    with pytest.raises(InputError, match=text) as caught:
        drive(torque_history=History(file="x.csv", times=times, torques=torques))
    assert caught.value.field == "duty.torque_history"


def test_a_convention_belongs_to_a_rated_torque():
    with pytest.raises(InputError, match="rated torque") as caught:
        Drive(joints=(Hooke(joint_angle=0.1), Hooke(joint_angle=0.1, rating=Rating(convention="CR"))))
    assert caught.value.field == "joints[1].rating.convention"
    assert Hooke(joint_angle=0.1, rating=Rating(convention="CR", torque=10.0)).rating
