"""What is said of forces: the numbers of the analysis, for any reader; parts loaded alike; what stops an answer."""

from dataclasses import replace

import numpy as np
import pytest

from cardan.answers.answer import FILE
from cardan.answers.data import data
from cardan.answers.printed import printed
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL, Reader
from cardan.drive.cross import Cross
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.movement import Hitch
from cardan.io import example
from cardan.maths.kernel import frames
from cardan.questions.forces import moving_answer
from cardan.questions.forces.answer import Carried, answer, ask, lacking
from cardan.questions.forces.forces import forces
from cardan.questions.forces.moving_forces import moving_forces
from cardan.questions.losses import answer as losses_answer
from cardan.texts import speaking
from cardan.units import deg

POUNDS = Reader(units={"force": "lbf", "torque": "lbft"}, decimal=",")
TRUCK = example("truck-supports")
PTO = example("pto-spline-thrust")
HITCH = Hitch(moves=("joints[1]", "output"), pivot=(0.47, 0.0, -0.3), yaw=20 * deg, frequency=3.0)


def of(drive):
    return answer(drive, ask(drive))


def column(table, key):
    return list(next(one for one in table.columns if one.key == key).values)


def remarks(said, tone):
    return [told(one.text, USUAL) for one in said.remarks if one.tone == tone]


def test_the_sentence_tells_what_the_torque_needs_and_who_carries_most():
    assert told(of(TRUCK).sentence, USUAL) == (
        "1\u202f600 N·m at the output need 1\u202f592 to 1\u202f616 N·m at the input; support 4 (pinion, front) "
        "carries most, up to 7\u202f614 N."
    )
    bare = replace(Drive.from_angles([20 * deg]), duty=Duty(torque=100.0, torque_at="input"))
    assert told(of(bare).sentence, USUAL) == (
        "100.0 N·m at the input meet 93.97 to 106.4 N·m at the output; the secondary couple is largest on shaft 1, "
        "36.40 N·m."
    )


def test_supports_that_carry_alike_are_named_together():
    found = forces(PTO)
    same = found.reaction.copy()
    same[3] = same[2] * (1.0 + 1e-15)
    said = answer(PTO, Carried(forces=replace(found, reaction=same)))
    assert "; supports 3 (implement, near) and 4 (implement, far) carry most, up to" in told(said.sentence, USUAL)
    assert told(said.sentence, USUAL).endswith(" N each.")
    (key,) = [one for one in said.keys if one.name == "support_force"]
    assert told(key.title, USUAL) == "largest force on a support, 3 (implement, near) and 4 (implement, far)"


def test_the_tables_are_those_of_the_analysis():
    found = forces(TRUCK)
    shafts, joints, supports = (one for one in of(TRUCK).tables if one.depth != "data")
    np.testing.assert_allclose(column(shafts, "torque_max"), np.max(found.shaft_torque, axis=-1), rtol=1e-5)
    both = (found, found.reverse)
    whole = np.max([np.max(frames.norm(one.reaction), axis=-1) for one in both], axis=0)
    np.testing.assert_allclose(column(supports, "force_max"), whole, rtol=1e-4)
    assert column(joints, "driven_journal_max")[1] == max(float(np.max(one.journals.size[1, :, 2:])) for one in both)
    assert column(supports, "axial_min")[1] is None


def test_readers_are_told_in_their_units_and_language():
    said = data(of(TRUCK), POUNDS)
    assert said["supports"][3]["radial_max_lbf"] == pytest.approx(710.70, abs=0.01)
    assert said["forces"]["shaft_1_torque_lbft"][0] == pytest.approx(1174.0, abs=20.0)
    assert "7 614 N" not in said["answer"]
    assert "1\u202f712 lbf" in said["answer"]
    with speaking("ru"):
        heads = [one.heading for one in printed(of(TRUCK).tables[2], USUAL).columns]
        assert heads[:2] == ["опора", "вал"]


def test_a_drive_held_too_much_says_how_many_times_and_what_to_ask_next():
    (warning,) = remarks(of(example("overconstrained-pump")), "warning")
    assert warning.startswith("Warning: statically indeterminate, degree 3: the supports share the forces")


def test_supports_that_tell_nothing_leave_the_torques():
    pump = example("overconstrained-pump")
    rigid = tuple(replace(one, stiffness=None, axial_stiffness=None) for one in pump.supports)
    result = ask(replace(pump, supports=rigid))
    said = answer(replace(pump, supports=rigid), result)
    assert result.forces.reaction is None
    assert [one.name for one in said.figures()] == ["torques"]
    (alarm,) = [told(one.text, USUAL) for one in said.remarks if one.alarm]
    assert alarm.startswith("Warning: forces on the supports are not calculated: supports")


def test_a_moving_drive_tells_its_forces_over_the_movement():
    drive = replace(PTO, movements=(HITCH,))
    result = ask(drive)
    top = float(np.max(result.moving.reaction_size))
    said = answer(drive, result)
    (line,) = [text for text in remarks(said, "plain") if text.startswith("While it moves")]
    assert "support 3 (implement, near) carries most" in line
    (most,) = [one for one in said.keys if one.name == "support_force"]
    assert most.value.value == top
    assert told(most.place, USUAL).endswith(" s of the movement")
    assert [one.name for one in said.figures()][-2:] == ["moving-reactions", "moving-torques"]


def test_why_nothing_is_told_of_a_movement():
    drive = replace(PTO, movements=(HITCH,), duty=replace(PTO.duty, acceleration=1.0))
    (warning,) = remarks(of(drive), "warning")
    assert warning.startswith("Warning: forces while the drive moves are not calculated: duty.acceleration")


def test_the_movement_alone_tells_its_extremes_and_when():
    drive = replace(PTO, movements=(HITCH,))
    found = moving_forces(drive)
    said = moving_answer.answer(drive, found)
    assert told(said.sentence, USUAL).startswith("while it moves, 400.0 N·m at the output need ")
    supports = said.tables[2]
    assert column(supports, "radial_max") == np.max(found.forces.radial, axis=-1).tolist()
    assert any("turns of the input, every 5° or closer." in text for text in remarks(said, "plain"))


def test_what_the_drive_file_lacks_is_told():
    assert lacking(TRUCK) == ()
    assert lacking(Drive.from_angles([0.3])) == (("duty.torque",), ("supports",))


def test_torques_of_rigid_shafts_say_so_where_vibration_can_be_told():
    """Statics tell 304 N·m in the telescope, of which the response makes several times as much: not without a word."""
    drive = example("pto-flywheel")
    drive = replace(
        drive, joints=tuple(replace(one, friction=0.1, cross=Cross(span=0.08, journal=0.02)) for one in drive.joints)
    )
    lost = losses_answer.answer(drive, losses_answer.ask(drive))
    for found in (of(drive), lost):
        assert [one.command for one in found.remarks if one.code == "rigid_shafts"] == [
            ("cardan", "torsion", "response", FILE)
        ]
    bare = replace(drive, stations=())
    assert not any(one.code == "rigid_shafts" for one in of(bare).remarks)
