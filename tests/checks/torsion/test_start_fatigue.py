"""Damage by starts: the run-up against another integration, its cycles one by one, and what fails with many of them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cardan import Drive, InputError
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.checks.design import design
from cardan.checks.strength.answer import answer, ask
from cardan.checks.strength.shaft_life import fatigue_life, start_damage
from cardan.checks.strength.strength import strength
from cardan.drive.duty import Duty
from cardan.drive.joints import Hooke
from cardan.drive.machine import ConstantTorque, Event, RunUp
from cardan.drive.material import Material
from cardan.drive.shaft import Notch, Shaft, Spline
from cardan.drive.station import Station
from cardan.questions.life.rainflow import rainflow
from cardan.questions.torsion.transient.torsion_transient import run_up_torque, transient
from cardan.questions.torsion.transient.transient import Adaptive
from cardan.units import deg, mm, rpm

pytestmark = pytest.mark.slow


def drive(**duty):
    """A flywheel behind two unequal joints, run up through the resonance of order 2 at 307 rpm."""
    steel = Material(yield_strength=355e6, ultimate_strength=600e6)
    tube = Shaft(number=2, length=1.0, outer=46 * mm, wall=4 * mm, loss_factor=0.04, material=steel)
    joints = (Hooke(joint_angle=14 * deg), Hooke(joint_angle=9 * deg))
    return replace(
        Drive(joints=joints, shafts=(tube,)),
        stations=(Station(shaft=3, inertia=4.5),),
        duty=Duty(
            speed=540 * rpm,
            torque=300.0,
            life=3600.0 * 5000,
            run_up=RunUp(end=540 * rpm, duration=4.0),
            **duty,
        ),
    )


def test_the_run_up_is_that_of_an_integration_with_steps_of_its_own():
    torque, shafts = run_up_torque(drive())
    exact = transient(drive(), method=Adaptive(rtol=1e-8, atol=1e-9)).motion.extremes
    assert shafts == (1,)
    assert torque.max() == pytest.approx(float(exact.torque_high[0]), rel=5e-3)  # 40 samples a period
    assert torque.min() == pytest.approx(float(exact.torque_low[0]), rel=5e-3)


def test_the_damage_of_a_start_cycle_by_cycle():
    """σ_a = √((2M/W)² + 3(T_a/W)²), σ_m = √3 T_m/W, N = (σ_r/A)^(1/B) where Goodman's safety is below 1."""
    subject = design(drive(starts=1.0))
    torque, _shafts = run_up_torque(subject.drive)
    first = int(np.argmax(torque[:, 0]))  # every start begins again where the last one did: from peak to peak
    cycles = rainflow([*torque[first:, 0], *torque[: first + 1, 0]])
    modulus = math.pi * (0.046**4 - 0.038**4) / (16 * 0.046)
    swing, mean = 0.5 * cycles.range / modulus, np.abs(cycles.mean) / modulus
    case = subject.loaded[0]
    bent = 2 * float(case.end_bending[1] / case.shaft_torque[1]) * (swing + mean)
    endurance = 4.51 * 600**-0.265 * 1.24 * 46**-0.107 * 0.897 * 300e6
    alternating, steady = np.sqrt(bent**2 + 3 * swing**2), math.sqrt(3) * mean
    use = alternating / endurance + steady / 600e6
    slope = -math.log10(0.9 * 600e6 / endurance) / 3
    life = (alternating / (1 - steady / 600e6) / ((0.9 * 600e6) ** 2 / endurance)) ** (1 / slope)
    by_hand = float(np.sum(np.where(use > 1.0, cycles.count / np.maximum(life, 1.0), 0.0)))
    assert by_hand > 1e-4
    assert float(start_damage(subject, 1)) == pytest.approx(by_hand, rel=1e-3)


def test_many_starts_break_what_few_do_not():
    (few,) = check(drive(starts=100.0), only=["start_fatigue"])
    (many,) = check(drive(starts=12000.0), only=["start_fatigue"])
    assert few.state == "passed"
    assert many.state == "failed"
    assert many.value == pytest.approx(120.0 * few.value, rel=1e-6)  # running alone does no damage
    assert strength(drive(starts=12000.0)).shafts[1].fatigue_life == pytest.approx(3600.0 * 5000 / many.value)


def test_a_given_number_of_starts_needs_no_life_to_be_judged():
    """Running does no damage: the life asked for only says over how long the starts are spread."""
    for starts, state in ((100.0, "passed"), (12000.0, "failed")):
        lasting = drive(starts=starts)
        bare = replace(lasting, duty=replace(lasting.duty, life=None))
        (wanted,), (found,) = (check(one, only=["start_fatigue"]) for one in (lasting, bare))
        assert (found.state, float(found.value)) == (state, pytest.approx(float(wanted.value), rel=1e-9))
        assert "duty.life" not in found.design_variables
        said = answer(bare, ask(bare))
        assert ("starts and events take" in told(said.sentence, USUAL)) == (state == "failed")
        assert said.code == 1  # the peak torque of the start yields the shaft
        assert not any("not judged" in told(one.text, USUAL) for one in said.remarks)


def test_where_running_tires_a_shaft_too_events_need_the_life():
    """Unless they alone are too many."""
    step = Event(kind="load_step", count=1.0, torque=320.0)
    subject = drive(events=(step,))
    shafts = list(subject.shafts)
    shafts[1] = replace(shafts[1], notch=Notch(bending=3.0, torsion=3.0))
    few = replace(subject, shafts=tuple(shafts), duty=replace(subject.duty, life=None))
    assert math.isfinite(fatigue_life(design(few), 1))
    (undecided,) = check(few, only=["start_fatigue"])
    assert undecided.missing == ("duty.life",)
    said = answer(few, ask(few))
    assert said.tone in ("warning", "failed")
    assert any("not judged" in (text := told(one.text, USUAL)) and "life_h" in text for one in said.remarks)
    (many,) = check(replace(few, duty=replace(few.duty, events=(replace(step, count=1e7),))), only=["start_fatigue"])
    assert many.state == "failed"
    assert "without running" in told(many.note, USUAL)


@pytest.mark.parametrize("more", [{"input": "free"}, {"motor": ConstantTorque(torque=400.0)}], ids=["free", "motor"])
def test_starts_of_an_input_that_torques_turn_freely_are_not_judged(more):
    """Nothing forces the speed of the run-up on it: no damage, no peak torque, no time that costs least."""
    subject = drive(starts=12000.0, **more)
    (verdict,) = check(subject, only=["start_fatigue"])
    assert verdict.state == "not_run"
    assert not verdict.missing
    assert "freely" in verdict.unfit
    said = answer(subject, ask(subject))
    assert not {"events", "ramps"} & {one.name for one in said.tables}
    assert said.tone in ("warning", "failed")
    assert any("run-up" in (text := told(one.text, USUAL)) and "freely" in text for one in said.remarks)
    started = Event(kind="load_step", count=100.0, torque=400.0)
    (alone,) = check(drive(events=(started,), **more), only=["start_fatigue"])
    assert alone.run


def test_starts_need_a_run_up_and_a_model():
    with pytest.raises(InputError, match=r"duty\.run_up: missing"):
        replace(drive(), duty=Duty(torque=10.0, starts=5.0))
    (bare,) = [its for its in check(replace(drive(starts=5.0), stations=()), only=["start_fatigue"])]
    assert bare.missing[0] == "stations[0].inertia"
    assert not list(check(drive(), only=["start_fatigue"]))


def test_steps_of_a_straight_drive_that_idles_tire_as_beside_next_to_no_torque():
    step = Event(kind="load_step", count=100.0, torque=2000.0, duration=0.05)
    straight = replace(drive(events=(step,)), joints=(Hooke(joint_angle=0.0), Hooke(joint_angle=0.0)))
    loaded, idle = (replace(straight, duty=replace(straight.duty, torque=torque)) for torque in (1e-6, 0.0))
    damage = float(np.max(start_damage(design(loaded), 1, step)))
    assert damage > 1e-4
    assert float(np.max(start_damage(design(idle), 1, step))) == pytest.approx(damage, rel=1e-5)  # of the torque


@pytest.mark.parametrize(
    ("path", "values"),
    [("duty.speed_rpm", (400.0, 540.0)), ("duty.torque_Nm", (200.0, 300.0)), ("shafts[1].outer_mm", (44.0, 50.0))],
)
def test_many_drives_with_starts_are_each_alone(path, values):
    made = drive(starts=12000.0)
    (many,) = check(made, only=["start_fatigue"], vary={path: values})
    each = [check(made, only=["start_fatigue"], vary={path: value})[0].value for value in values]
    np.testing.assert_allclose(many.value, each, rtol=1e-9)
    assert np.all(np.asarray(each) > 0.0)


@pytest.mark.parametrize("play", [0.0, 0.8 * deg])
def test_that_backlash_counts_as_closed_is_told(play):
    """The run-up itself is followed with it open, and tells another torque."""
    plain = drive(starts=12000.0)
    shafts = list(plain.shafts)
    shafts[1] = replace(shafts[1], spline=Spline(backlash=play))
    loose = replace(plain, shafts=tuple(shafts))
    (found,) = [one for one in check(loose) if one.check == "start_fatigue"]
    assert ("backlash" in told(found.note, USUAL)) == (play > 0.0)
    said = answer(loose, ask(loose))
    (events,) = [one for one in said.tables if one.name == "events"]
    assert ("Backlash" in told(events.note, USUAL)) == (play > 0.0)
