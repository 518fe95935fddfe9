"""Drives in time: from their steady motion, up through a resonance, under a load step."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError, example
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.duty import Duty
from cardan.drive.machine import ConstantTorque, RunUp, TorqueHistory
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.questions.motion.motion import motion
from cardan.questions.torsion.steady.torsion_response import torsion_response
from cardan.questions.torsion.transient.answer import answer
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.questions.torsion.transient.transient import Adaptive
from cardan.units import deg, rpm
from tests.builders.any_drive import any_drive

LINE = replace(
    Drive.from_angles([20 * deg]),
    shafts=(Shaft(number=1, stiffness=1000.0, damping=2.0),),
    stations=(Station(shaft=1, end="start", inertia=0.5), Station(shaft=2, inertia=0.4, name="mill")),
    duty=Duty(speed=40.0, torque=60.0),
)
ROUGH = Adaptive(rtol=1e-7, atol=1e-8)


def test_a_stiff_line_keeps_its_small_torque() -> None:
    """A shaft of 9 MN·m/rad bears 2.5 N·m: an angle off by 1e-9 is a torque off by 0.01 N·m."""
    drive = any_drive(8020172)
    wanted, span = torsion_response(drive), 2.0 * 2.0 * math.pi / float(drive.duty.speed or 0.0)
    found = transient(drive, replace(drive.duty, run_up=None), span=span, times=3, start="settled")
    assert found.train.model.stiffness.max() > 9e6
    assert found.motion.extremes.torque_high == pytest.approx(wanted.torque_highest, abs=1e-3)
    assert found.motion.extremes.torque_low == pytest.approx(wanted.torque_lowest, abs=1e-3)


@pytest.mark.parametrize("free", [False, True])
def test_a_settled_start_stays_settled(free: bool) -> None:
    duty = replace(LINE.duty, input="free" if free else None)
    wanted = torsion_response(LINE, duty)
    found = transient(LINE, duty, span=1.0, start="settled", method=ROUGH)
    assert found.complete
    assert found.motion.extremes.torque_high == pytest.approx(wanted.torque_highest, rel=1e-5)
    assert found.motion.extremes.torque_low == pytest.approx(wanted.torque_lowest, rel=1e-5)


@pytest.mark.slow
def test_of_peaks_that_repeat_the_first_is_told() -> None:
    """The settled motion of cross joints repeats after half a turn, 0.05 s; four peaks are alike but for rounding."""
    found = transient(example("truck-supports"), Duty(speed=600.0 * rpm, torque=400.0), span=0.2, start="settled")
    for time in (found.motion.extremes.torque_high_time, found.motion.extremes.torque_low_time):
        assert np.all(time[0] < 0.05 + 1e-6)


@pytest.mark.slow
def test_an_even_start_turns_every_shaft_as_a_rigid_one() -> None:
    """Ratios of the axes' own motion, found without torsion; no damper is pulled from the first moment on."""
    shafts = tuple(Shaft(number=k, stiffness=4000.0, damping=5.0) for k in (1, 2, 3))
    bent = Drive.from_angles([25 * deg, 18 * deg], plane_twists=[0.4], yoke_angles=[0.3], start_phase=0.3)
    one = replace(bent, shafts=shafts, stations=(Station(shaft=3, inertia=0.4, end="end"),), duty=Duty(speed=50.0))
    found = transient(one, span=0.01, method=ROUGH)
    ratio = motion(one, angle=[0.0]).shaft_ratio[:, 0]
    wanted = 50.0 * ratio[list(found.train.model.shaft)]
    assert np.ptp(wanted) > 3.0
    np.testing.assert_allclose(found.motion.speed[0], wanted, rtol=1e-12)
    np.testing.assert_allclose(found.motion.torque[0], 0.0, atol=1e-9)


def test_a_load_step_on_a_straight_shaft_swings_to_twice_its_torque() -> None:
    straight = replace(
        LINE,
        joints=(replace(LINE.joints[0], joint_angle=0.0),),
        shafts=(Shaft(number=1, stiffness=1000.0, damping=0.0),),
    )
    found = transient(straight, span=0.1, method=ROUGH)
    assert found.motion.extremes.torque_high == pytest.approx([120.0], rel=1e-6)
    assert found.motion.extremes.torque_high_time[0] == pytest.approx(math.pi / math.sqrt(1000.0 / 0.4), rel=1e-3)


@pytest.mark.slow
def test_what_swings_fast_to_the_end_goes_in_fixed_steps() -> None:
    """A thousand swings without damping: M (1 - cos ωt), with ω = 5000 rad/s."""
    stiff = Shaft(number=1, stiffness=5000.0**2 * 0.4, damping=0.0)
    straight = replace(LINE, joints=(replace(LINE.joints[0], joint_angle=0.0),), shafts=(stiff,))
    found = transient(straight, span=1.2)
    assert found.motion.method == "fixed steps"
    wanted = 60.0 * (1.0 - np.cos(5000.0 * found.motion.times))
    np.testing.assert_allclose(found.motion.torque[:, 0], wanted, atol=60.0 * 1e-6)
    assert found.motion.extremes.torque_high == pytest.approx([120.0], rel=1e-5)
    assert found.motion.imbalance < 1e-9
    damped = replace(straight, shafts=(replace(stiff, damping=200.0),))
    assert transient(damped, span=1.2).motion.method != "fixed steps"


@pytest.mark.slow
def test_running_up_passes_the_resonance_of_order_two() -> None:
    """Half the natural frequency is 25 rad/s; the peak comes a little after it."""
    duty = Duty(run_up=RunUp(end=60.0, duration=3.0))
    found = transient(LINE, duty, method=ROUGH)
    assert found.motion.times[-1] == pytest.approx(3.6)
    assert found.motion.speed[-1, 0] == pytest.approx(60.0)
    peak = float(found.motion.extremes.torque_high_time[0]) * 20.0
    assert 25.0 < peak < 30.0


@pytest.mark.slow
def test_a_history_is_simulated_to_its_end() -> None:
    step = TorqueHistory(file="a.csv", times=(0.0, 0.5, 0.6, 1.5), torques=(0.0, 0.0, 30.0, 30.0))
    found = transient(LINE, Duty(speed=40.0, load=step), method=ROUGH)
    assert found.motion.times[-1] == 1.5
    late = found.motion.times > 1.4
    assert np.mean(found.motion.torque[late, 0]) == pytest.approx(30.0, abs=1.5)  # swings and joint around it


def test_a_free_drive_that_nothing_drives_keeps_its_speed() -> None:
    found = transient(LINE, replace(LINE.duty, input="free"), span=0.1, method=ROUGH)
    assert np.dot(found.motion.speed[-1, [0, 2]], [0.5, 0.4]) / 0.9 == pytest.approx(40.0, rel=0.05)
    assert "duty.motor" in found.train.assumed
    braked = replace(LINE.duty, motor=ConstantTorque(torque=0.0))
    slower = transient(LINE, braked, span=0.1, method=ROUGH)
    mean = 40.0 - 60.0 * 0.1 / 0.9
    assert np.dot(slower.motion.speed[-1, [0, 2]], [0.5, 0.4]) / 0.9 == pytest.approx(mean, rel=0.05)


@pytest.mark.parametrize("free", [False, True])
def test_a_run_up_is_followed_where_the_input_is_held_and_said_not_to_be_where_it_is_free(free: bool) -> None:
    course = RunUp(start=10.0, end=12.0, duration=0.2)
    drive = replace(LINE, duty=replace(LINE.duty, input="free" if free else "uniform", run_up=course))
    found = transient(drive, method=ROUGH)
    assert (found.motion.speed[-1, 0] == pytest.approx(12.0)) != free
    said = answer(drive, found)
    assert any(column.key == "max_input_speed" for column in said.tables[0].columns) != free
    assert any("not followed" in told(one.text, USUAL) for one in said.remarks) == free


@pytest.mark.slow
def test_a_stop_keeps_what_is_done() -> None:
    shares: list[float] = []

    def stop(share: float) -> str:
        shares.append(share)
        return "stop" if share > 0.3 else ""

    found = transient(LINE, span=20.0, method=ROUGH, progress=stop)
    assert not found.complete
    assert 0.2 * 20.0 < float(found.motion.ended) < 20.0


@pytest.mark.parametrize(
    ("duty", "field"),
    [
        (Duty(run_up=RunUp(end=60.0, duration=3.0)), "duty.run_up"),
        (Duty(input="free"), "duty.speed"),
        (Duty(speed=40.0, load=TorqueHistory(file="a", times=(0.0, 1.0), torques=(0.0, 1.0))), "duty"),
    ],
)
def test_nothing_settles_where_nothing_is_steady(duty: Duty, field: str) -> None:
    with pytest.raises(InputError) as caught:
        transient(LINE, duty, start="settled")
    assert field in [problem.field for problem in caught.value.problems]


@pytest.mark.parametrize("duty", [Duty(speed=100.0), Duty(motor=ConstantTorque(torque=30.0))], ids=["turns", "swings"])
def test_no_one_waits_for_more_turns_or_swings_than_a_day_has(duty: Duty) -> None:
    with pytest.raises(InputError, match="at most 1,000,000 are followed") as caught:
        transient(LINE, duty, span=1e9)
    assert [problem.field for problem in caught.value.problems] == ["span"]


def test_a_drive_at_a_uniform_speed_needs_that_speed() -> None:
    """A drive whose speed the file does not say is not one that stands: that is said with a speed of 0."""
    with pytest.raises(InputError) as caught:
        transient(LINE, Duty(torque=30.0))
    assert [(one.field, one.code) for one in caught.value.problems] == [("duty.speed", "missing")]
    assert transient(LINE, Duty(speed=0.0, torque=30.0), span=0.01).complete


def test_a_motor_pulls_up_from_rest() -> None:
    duty = Duty(motor=ConstantTorque(torque=30.0))
    found = transient(LINE, duty, span=1.0, method=ROUGH)
    assert np.dot(found.motion.speed[-1, [0, 2]], [0.5, 0.4]) / 0.9 == pytest.approx(30.0 / 0.9, rel=0.05)
