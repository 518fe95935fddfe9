"""Page 1 of a drive with poses: what is even as drawn need not be so in them."""

import pytest

from cardan.drive.drive import Drive
from cardan.io import example, loads
from cardan.report.block import Words
from cardan.report.subject import Subject
from cardan.report.summary import changes, uniformity


def posed(joint_angles: tuple[float, float], pose: str, yoke: float = 0.0) -> Subject:
    """Return a drive of two joints with these joint angles [°], and a pose of it."""
    joints = "".join(f"[[joints]]\njoint_angle_deg = {joint_angle}\n" for joint_angle in joint_angles)
    shafts = f"[[shafts]]\nnumber = 2\nyoke_angle_deg = {yoke}\n"
    return Subject(
        drive=loads(f'format = 1\nname = "D"\n{joints}{shafts}[[poses]]\nname = "low"\nset = {{ {pose} }}\n')
    )


def told(on: Subject) -> str:
    said = changes(on)
    assert isinstance(said, Words)
    return said.text


def test_a_drive_that_is_even_only_as_drawn_is_not_called_even_in_its_poses():
    on = posed((10.0, 10.0), '"joints[0].joint_angle_deg" = 20')
    said = uniformity(on)
    # One joint of 20° against one of 10°, by hand: cos 20°/cos 10° = cos α, δ = 1/cos α - cos α = 9.38 %.
    assert said.text == "D is uniform as drawn. In the pose low the speed fluctuation is 9.38 %."
    assert said.tone == "warning"
    assert told(on) == "The yokes are phased right; what is left comes from joint angles that differ in the poses."


@pytest.mark.slow
def test_yokes_that_would_suit_the_poses_are_named():
    on = posed((0.0, 0.0), '"joints[0].joint_angle_deg" = 20, "joints[1].joint_angle_deg" = 20', yoke=90.0)
    assert "“least in the worst pose” leaves 0 % in the worst pose" in told(on)


@pytest.mark.parametrize("drive", [example("rolling-mill-upper-spindle"), Drive.from_angles([0.2, 0.2])])
def test_what_is_even_in_every_pose_needs_no_change(drive):
    on = Subject(drive=drive)
    assert "as specified" in uniformity(on).text
    assert told(on) == "Nothing needs to be changed for a uniform output."
