"""No verdict is green by the torque of a motion that grows: checks, strength and what is told of them."""

from dataclasses import replace

import pytest

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks.checks import check
from cardan.checks.strength.answer import answer, ask
from cardan.checks.strength.strength import strength
from cardan.choices.check_answer import sentence
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import with_values
from cardan.drive.material import Material
from cardan.drive.settings import Pose
from cardan.io import example
from cardan.units import mm, rpm

GREEN = ("passed", "unconfirmed", "close")

RESTING = {
    ("tube_strength", "shafts[0]"),
    ("tube_fatigue", "shafts[0]"),
    ("tube_buckling", "shafts[0]"),
    ("twist", ""),
    ("torsional_resonance", "shafts[0]"),
}
"""Verdicts on the stand that rest on the torque of its vibration."""


def stand(speed: float, torque: float = 60.0) -> Drive:
    """Return the stand that is unstable at 1340 rpm, its soft shaft a tube that can be judged."""
    drive = example("unstable-drive")
    steel = Material(yield_strength=600e6, ultimate_strength=800e6)
    tube = replace(drive.shafts[0], outer=50 * mm, wall=3 * mm, length=600 * mm, mass=2.0, inertia=0.0, material=steel)
    duty = replace(drive.duty, speed=speed * rpm, torque=torque)
    return replace(drive, shafts=(tube, *drive.shafts[1:]), duty=duty)


def states(drive: Drive) -> dict[tuple[str, str], str]:
    return {(one.check, one.subject): one.state for one in check(drive) if not one.advice}


@pytest.mark.slow
def test_no_check_is_green_by_the_torque_of_a_motion_that_grows():
    beside, amid = states(stand(1290.0)), states(stand(1340.0))
    for key in RESTING:
        assert beside[key] in GREEN, key
        assert amid[key] == "not_run", key
    rest = beside.keys() - RESTING - {("parametric_stability", "")}
    assert {key: beside[key] for key in rest} == {key: amid[key] for key in rest}
    assert (beside["parametric_stability", ""], amid["parametric_stability", ""]) == ("passed", "failed")
    assert states(stand(1340.0, 1500.0))["twist", ""] == "failed"


def test_a_range_that_holds_a_speed_at_which_the_motion_grows_is_no_better():
    drive = stand(1290.0)
    wide = replace(drive, duty=replace(drive.duty, speed_range=(1280 * rpm, 1330 * rpm)))
    assert all(states(wide)[key] == "not_run" for key in RESTING)


def test_strength_carries_and_rates_nothing_by_a_motion_that_grows():
    drive = stand(1340.0)
    said = answer(drive, ask(drive))
    assert told(said.sentence, USUAL).startswith("not judged: met by the torque of a motion that is unstable")
    assert (said.code, said.keys, said.facts["enough"]) == (0, (), None)
    assert [told(one.text, USUAL) for one in said.remarks if one.alarm and "unstable" in told(one.text, USUAL)]
    broken = stand(1340.0, 1500.0)
    said = answer(broken, ask(broken))
    assert "too weak for 1" in told(said.sentence, USUAL)
    assert "not rated" in told(said.sentence, USUAL)
    assert (said.code, said.keys) == (1, ())
    assert strength(stand(1290.0)).rated_torque == pytest.approx(670.0, rel=0.01)  # as the range of 1280 to 1400 rpm


def test_why_one_check_alone_judges_nothing_is_told():
    (one,) = check(stand(1340.0), only=["tube_fatigue"])
    assert told(sentence([one]), USUAL) == f"nothing could be judged: {one.unfit}."


@pytest.mark.parametrize(("drawn", "posed"), [(2.0, 18.0), (18.0, 2.0)])
def test_a_pose_in_which_the_motion_grows_is_judged_by_no_other(drawn, posed):
    drive = stand(1340.0)
    stands = with_values(drive, {"joints[0].joint_angle_deg": drawn})
    pose = Pose(name="other", set=(("joints[0].joint_angle_deg", posed),))
    assert all(states(stands)[key] in GREEN for key in RESTING) is (drawn < 10.0)
    found = states(replace(stands, poses=(pose,)))
    assert all(found[key] == "not_run" for key in RESTING)
    assert not strength(replace(stands, poses=(pose,))).binding
