"""Friction of lip seals: by hand, in every condition, beside all other friction."""

from dataclasses import replace
from math import cos, pi, radians

import numpy as np
import pytest

from cardan import Drive, losses
from cardan.answers.quantity import Quantity, told
from cardan.answers.reader import USUAL
from cardan.drive.cross import Cross
from cardan.drive.duty import Case, Duty, Harmonic
from cardan.drive.joints import Hooke
from cardan.drive.support import Support
from cardan.errors import InputError
from cardan.formulas.friction import seal_friction
from cardan.io import example
from cardan.questions.forces import answer as forces_answer
from cardan.questions.losses.answer import answer, lacking
from cardan.questions.losses.figure import loss_parts
from cardan.questions.losses.losses import loss_map
from cardan.units import deg, mm, rpm

DUTY = Duty(speed=1500 * rpm, torque=120.0)
SEALED = (
    Support(shaft=1, position=-0.1, seal_diameter=35 * mm, seals=2),
    Support(name="far", shaft=2, position=0.1, seal_diameter=40 * mm),
)


def hooke(alpha=20.0, friction=None, supports=SEALED, **fields):
    drive = Drive.from_angles([alpha * deg])
    joint = replace(drive.joints[0], friction=friction, cross=Cross(span=80 * mm, journal=20 * mm))
    return replace(drive, joints=(joint,), supports=supports, duty=DUTY, **fields)


def test_the_formula_is_that_of_the_technical_report():
    for d, n in ((40, 1500), (85, 900), (400, 120)):
        assert seal_friction(d * mm) * n * rpm == pytest.approx(7.69e-6 * d**2 * n, rel=1e-12)
    assert seal_friction(np.asarray([0.01, 0.02])).shape == (2,)


@pytest.mark.parametrize("speed", [1500.0, -1500.0])
@pytest.mark.parametrize("torque", [120.0, -120.0])
@pytest.mark.parametrize("at", ["output", "input"])
def test_seals_alone_take_their_torque_times_the_mean_speed(speed, torque, at):
    found = losses(hooke(), Duty(speed=speed * rpm, torque=torque, torque_at=at))
    watts = np.asarray([2 * 7.69e-6 * 35**2 * 1500, 7.69e-6 * 40**2 * 1500])
    assert found.seals == pytest.approx(watts, rel=1e-12)
    assert found.heat == pytest.approx(np.sum(watts), rel=1e-12)
    assert found.input_power - found.output_power == pytest.approx(found.heat, rel=1e-9)
    if torque * speed > 0.0 and at == "output":
        useful = 120.0 * 1500 * rpm
        assert found.efficiency == pytest.approx(useful / (useful + np.sum(watts)), rel=1e-12)


def test_a_seal_behind_a_bent_joint_loads_it_with_its_torque():
    """T_1 = (T_2 + M) ω_2/ω_1 over the turn, and ω_2/ω_1 is largest at 1/cos α."""
    found = losses(hooke(alpha=30.0))
    own = 2 * seal_friction(35 * mm)
    after = 120.0 + seal_friction(40 * mm)
    assert np.max(found.input_torque) == pytest.approx(own + after / cos(radians(30)), rel=1e-9)
    assert np.min(found.input_torque) == pytest.approx(own + after * cos(radians(30)), rel=1e-9)


def test_beside_friction_of_journals_the_balance_closes():
    rubbing = losses(hooke(friction=0.02))
    without = losses(hooke(friction=0.02, supports=()))
    assert rubbing.residual < 1e-12
    assert float(rubbing.joints[0]) > float(without.joints[0])  # it passes the torque of the seal behind it, too
    load = 1.0 + seal_friction(40 * mm) / 120.0
    assert float(rubbing.joints[0] / without.joints[0]) == pytest.approx(load, rel=1e-12)


def test_a_torque_smaller_than_the_seals_turns_the_flow_about_within_the_drive():
    """The load drives with less than its seal takes: both ends feed the friction, and nothing useful comes out."""
    small = replace(DUTY, torque=-0.5 * float(seal_friction(40 * mm)))
    found = losses(hooke(friction=0.02), small)
    assert found.residual < 1e-9
    assert found.input_power > 0.0 > found.output_power
    assert found.efficiency == 0.0
    swinging = replace(DUTY, torque=0.2, harmonics=(Harmonic(order=2.0, torque=0.4, phase=0.3),))
    assert losses(hooke(friction=0.02), swinging).residual < 1e-9


def test_means_over_load_cases_go_by_their_shares():
    cases = (
        Case(name="slow", torque=100.0, speed=500 * rpm, share=0.25),
        Case(name="fast", torque=50.0, speed=2500 * rpm, share=0.75),
    )
    found = losses(replace(hooke(), duty=Duty(cases=cases)))
    mean = 7.69e-6 * 40**2 * (0.25 * 500 + 0.75 * 2500)
    assert found.seals[1] == pytest.approx(mean, rel=1e-12)


def test_a_map_counts_them_and_bends_at_small_torques():
    found = loss_map(hooke(friction=0.02), [1000 * rpm, 2000 * rpm], [2.0, 200.0])
    assert found.seals[:, 0, 1] == pytest.approx([7.69e-6 * 1600 * 1000, 7.69e-6 * 1600 * 2000])
    assert np.all(found.efficiency[:, 0] < found.efficiency[:, 1] - 0.1)
    assert found.heat == pytest.approx(np.sum(found.joints, axis=-1) + np.sum(found.seals, axis=-1))


def test_they_count_where_balance_cannot_tell_the_supports_apart():
    """Two supports leave the drive ways to give: forces are not known, the torque of a seal is."""
    rubbing = tuple(replace(one, friction=0.01, bore=30 * mm) for one in SEALED)
    found = losses(hooke(supports=rubbing))
    assert np.all(found.supports == 0.0)
    assert found.seals[0] == pytest.approx(7.69e-6 * 2 * 35**2 * 1500)
    assert any(one.field == "supports" for one in found.uncounted)


def test_they_are_told_as_parts_of_their_own():
    drive = hooke()
    found = losses(drive)
    names = [part.named for part in loss_parts(found, drive)]
    assert names == ["joint 1", "support 1", "support 2 (far)", "seals of support 1", "seals of support 2 (far)"]
    assert [part.counted for part in loss_parts(found, drive)] == [False, False, False, True, True]
    told = answer(drive, found)
    assert [one.code for one in told.remarks].count("seal_guide_value") == 1
    assert not lacking(drive)
    bare = hooke(supports=(Support(shaft=1, position=-0.1),))
    assert lacking(bare)
    with pytest.raises(InputError):
        losses(bare)


@pytest.mark.parametrize(("torque", "tone"), [(0.04, "warning"), (40.0, "plain")])
def test_forces_say_that_the_torque_of_the_seals_is_on_top(torque, tone):
    bare = example("instrument-joint")
    exact = Hooke(centre=bare.joints[0].centre, cross=bare.joints[0].cross)
    bare = replace(bare, joints=(exact,), duty=replace(bare.duty, torque=torque))
    drive = replace(bare, supports=tuple(replace(one, friction=None, seal_diameter=8 * mm) for one in bare.supports))
    said = {one.code: one for one in forces_answer.answer(drive, forces_answer.ask(drive)).remarks}
    found = losses(drive)
    more = (found.input_power - found.output_power) / found.speed  # forces count none of it
    assert told(said["seals"].text, USUAL).startswith(
        f"Friction of the seals, {told(Quantity(more, 'torque'), USUAL)} in"
    )
    assert said["seals"].tone == tone
    assert "supports" not in said
    rubbing = {one.code for one in forces_answer.answer(bare, forces_answer.ask(bare)).remarks}
    assert "supports" in rubbing  # bearings of the example have friction
    assert "seals" not in rubbing


def test_a_turn_of_work_is_two_pi_times_the_torque():
    found = losses(hooke(alpha=0.0))
    turn = found.heat / (1500 / 60)
    assert turn == pytest.approx(2 * pi * float(2 * seal_friction(35 * mm) + seal_friction(40 * mm)), rel=1e-12)
