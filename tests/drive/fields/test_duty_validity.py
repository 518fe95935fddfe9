"""Duty cycles and ratings that contradict themselves are refused by name."""

import pytest

from cardan import Drive, InputError
from cardan.drive.duty import Block, Case, Duty, History
from cardan.drive.joint_parts import Rating
from cardan.drive.joints import Hooke
from cardan.io import loads


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


def test_load_cases_are_refused_with_all_that_is_wrong():
    cases = (
        Case(name="a", torque=1.0, share=0.5, cycles=10.0),
        Case(name="a", torque=1.0, speed=1.0, speed_range=(1.0, 2.0), pose="up"),
        Case(name="b", torque=1.0, speed_range=(3.0, 2.0), movement="down"),
    )
    with pytest.raises(InputError) as caught:
        drive(cases=cases, blocks=cycle(1.0))
    assert {one.field for one in caught.value.problems} == {
        "duty.cases[0].cycles",
        "duty.life",
        "duty.cases[0].speed",
        "duty.cases[1].name",
        "duty.cases[1].speed_range",
        "duty.cases[2].speed_range",
        "duty.cases",
    }


def test_shares_of_load_cases_leave_the_rest_to_the_torque_of_the_duty():
    some = (Case(name="a", torque=1.0, speed=1.0, share=0.4),)
    assert drive(cases=some, torque=5.0, speed=1.0).duty.cases == some
    with pytest.raises(InputError, match="40 %"):
        drive(cases=some)


def test_a_file_has_the_poses_and_movements_that_its_load_cases_name():
    text = """
        format = 1
        joints = [{ joint_angle_deg = 5 }, { joint_angle_deg = 5 }]
        duty.cases = [{ name = "a", torque_Nm = 1, share_percent = 100, pose = "up", movement = "down" }]
    """
    with pytest.raises(InputError) as caught:
        loads(text)
    assert [one.field for one in caught.value.problems] == ["duty.cases[0].pose", "duty.cases[0].movement"]
    pose = '[[poses]]\nname = "turned"\nset = { "joints[1].joint_angle_deg" = 9 }\n'
    with pytest.raises(InputError, match="no pose 'up'; there are: turned"):
        loads(text + pose)
    loads((text + pose).replace('"up"', '"turned"').replace(', movement = "down"', ""))
