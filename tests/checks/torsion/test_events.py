"""Clutches and load steps: closed forms of two masses, SciPy's integration, damage by hand, the cheapest ramp."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import Drive, InputError
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.checks.design import design
from cardan.checks.event_loads import followed
from cardan.checks.moving import happening, stood
from cardan.checks.strength.answer import answer, ask
from cardan.checks.strength.event_damage import cheapest, event_damages, ramp_damages
from cardan.checks.strength.shaft_life import start_damage
from cardan.checks.strength.strength import strength
from cardan.drive.conditions import conditions
from cardan.drive.cross import Cross
from cardan.drive.duty import Case, Duty
from cardan.drive.joint_parts import Needles
from cardan.drive.joints import Hooke
from cardan.drive.machine import Event, RunUp
from cardan.drive.material import Material
from cardan.drive.settings import Pose
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station
from cardan.questions.life.rainflow import rainflow
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.transient.torsion_transient import _length, event_torque, run_up_torque
from cardan.texts import speaking
from cardan.units import deg, mm, rpm

FIRST, SECOND, STIFFNESS, SPEED, LOAD = 0.3, 0.8, 5000.0, 100.0, 60.0
STEP = Event(kind="load_step", count=1000.0, torque=160.0)
CLUTCH = Event(kind="clutch", count=500.0, torque=260.0)


def line(bend: float = 0.0, **duty) -> Drive:
    """Two masses on an elastic shaft, the second behind a joint."""
    return replace(
        Drive(joints=(Hooke(joint_angle=bend),), shafts=(Shaft(number=1, stiffness=STIFFNESS, damping=0.0),)),
        stations=(Station(shaft=1, end="start", inertia=FIRST), Station(shaft=2, inertia=SECOND)),
        duty=Duty(speed=SPEED, torque=LOAD, life=3.6e7, **duty),
    )


def test_a_load_step_swings_by_as_much_as_it_comes_to() -> None:
    torque, shafts = event_torque(line(), STEP)
    assert shafts == (0,)
    assert torque[0] == pytest.approx([60.0])
    assert torque.max() == pytest.approx(260.0, rel=2e-3)  # 60 + 2 (160 - 60), 40 samples a period
    slow, _shafts = event_torque(line(), replace(STEP, duration=2.0 * math.pi / math.sqrt(STIFFNESS / SECOND)))
    assert slow.max() == pytest.approx(160.0, rel=1e-3)  # a ramp of one period leaves no vibration behind


def again(torque: np.ndarray) -> np.ndarray:
    """Return what an event of this torque [N·m] does each time, from its peak to the peak of the next one."""
    twice = np.tile(torque, 2)
    first = int(np.argmax(torque))
    return twice[first : first + len(torque) + 1]


def test_what_comes_again_and_again_leaves_no_cycle_half() -> None:
    """A ramp of one period leaves no vibration behind: each step is one cycle from 60 to 160 N·m, and back."""
    slow = replace(STEP, duration=2.0 * math.pi / math.sqrt(STIFFNESS / SECOND))
    courses = followed(line(), slow)
    assert isinstance(courses, dict)
    cycles = courses[0].cycles
    (largest,) = np.flatnonzero(cycles.range > 50.0)
    assert (cycles.range[largest], cycles.count[largest]) == (pytest.approx(100.0, rel=3e-3), 1.0)
    assert set(cycles.count) <= {float(one) for one in range(1, 1000)}


def test_a_clutch_passes_on_what_it_can_and_then_all_that_is_asked() -> None:
    """Slipping with M: the shaft swings about M J2/(J1+J2) + T J1/(J1+J2), up to twice of that beyond its start."""
    torque, _shafts = event_torque(line(), CLUTCH)
    mean = (260.0 * SECOND + LOAD * FIRST) / (FIRST + SECOND)
    assert torque.max() == pytest.approx(2.0 * mean, rel=0.03)  # the load that rubs comes on with the first motion
    slip = (FIRST + SECOND) * SPEED / (260.0 - LOAD)
    period = 2.0 * math.pi / math.sqrt(STIFFNESS / SECOND)
    assert torque.shape[0] > 40 * slip / period


def plain(bend: float, closing: float, capacity: float, times: np.ndarray) -> np.ndarray:
    """Return the torque of the shaft: slip and stick as two systems of equations, each integrated to its end."""

    def joint(a: float) -> tuple[float, float]:
        below = 1.0 - math.sin(bend) ** 2 * math.cos(a) ** 2
        return math.cos(bend) / below, -math.cos(bend) * math.sin(bend) ** 2 * math.sin(2 * a) / below**2

    def yoke(a: float, v: float, twist: float) -> float:
        i, slope = joint(a)
        drag = LOAD * np.clip(i * v / (0.005 * SPEED), -1.0, 1.0)
        return (STIFFNESS * twist - i * drag - SECOND * i * slope * v**2) / (SECOND * i**2)

    def passed(t: float) -> float:
        return capacity * min(t / closing, 1.0)

    def slip(way: float):
        def slope(t, y):
            pull = STIFFNESS * (y[0] - y[2])
            return [y[1], (way * passed(t) - pull) / FIRST, y[3], yoke(y[2], y[3], y[0] - y[2])]

        return slope

    def stick(t, y):
        return [SPEED, 0.0, y[3], yoke(y[2], y[3], y[0] - y[2])]

    now, state, stuck, way = 0.0, np.zeros(4), False, 1.0
    span, torque = times[-1], np.zeros(len(times))
    while now < span:
        if stuck:
            event = lambda t, y: passed(t) * (1.0 + 1e-9) - abs(STIFFNESS * (y[0] - y[2]))  # noqa: E731
        else:
            event = lambda t, y, way=way: way * (SPEED - y[1]) + 1e-7  # noqa: E731
        event.terminal, event.direction = True, -1.0
        found = solve_ivp(
            stick if stuck else slip(way),
            (now, span),
            state,
            events=event,
            method="DOP853",
            rtol=1e-9,
            atol=1e-10,
            max_step=4e-3,
            dense_output=True,
        )
        here = times[(times >= now) & (times <= found.t[-1])]
        torque[(times >= now) & (times <= found.t[-1])] = STIFFNESS * (found.sol(here)[0] - found.sol(here)[2])
        now, state = found.t[-1], found.y[:, -1]
        if stuck:
            way = math.copysign(1.0, STIFFNESS * (state[0] - state[2]))
        else:
            state[1] = SPEED
        stuck = not stuck
    return torque


@pytest.mark.slow
def test_a_clutch_before_a_bent_joint_slips_and_sticks_as_scipy_says() -> None:
    event = replace(CLUTCH, torque=130.0, duration=0.1)
    torque, _shafts = event_torque(line(10 * deg), event)
    slipping = 0.1 + (FIRST + SECOND) * SPEED / (130.0 - LOAD)
    span, count = _length(torsional_train(line(10 * deg)).model, slipping, SPEED)
    wanted = plain(10 * deg, 0.1, 130.0, np.linspace(0.0, span, count))
    # thirty changes of sticking, each interpolated between samples
    np.testing.assert_allclose(torque[:, 0], wanted, atol=0.02 * np.max(np.abs(wanted)))


def test_a_clutch_that_cannot_turn_the_load_is_refused() -> None:
    with pytest.raises(InputError, match="slips without end unless it passes on more than 60"):
        event_torque(line(), replace(CLUTCH, torque=50.0))


def tube(**duty) -> Drive:
    """A flywheel behind two unequal joints, run up through the resonance of order 2 at 307 rpm."""
    steel = Material(yield_strength=355e6, ultimate_strength=600e6)
    middle = Shaft(number=2, length=1.0, outer=46 * mm, wall=4 * mm, loss_factor=0.04, material=steel)
    joints = (Hooke(joint_angle=14 * deg), Hooke(joint_angle=9 * deg))
    return replace(
        Drive(joints=joints, shafts=(middle,)),
        stations=(Station(shaft=1, inertia=0.2), Station(shaft=3, inertia=4.5)),
        duty=Duty(speed=540 * rpm, torque=300.0, life=3600.0 * 5000, **duty),
    )


@pytest.mark.slow
def test_the_damage_of_an_event_cycle_by_cycle() -> None:
    """σ_a = √((2M/W)² + 3(T_a/W)²), σ_m = √3 T_m/W, N = (σ_r/A)^(1/B) where Goodman's safety is below 1."""
    step = Event(kind="load_step", count=2000.0, torque=1500.0)
    subject = design(tube(events=(step,)))
    cycles = rainflow(again(event_torque(subject.drive, step)[0][:, 0]))
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
    assert by_hand > 1e-5
    assert float(start_damage(subject, 1, step)) == pytest.approx(by_hand, rel=2e-2)
    (found,) = event_damages(subject.drive)
    assert (found.shaft, found.count, found.share) == (2, 2000.0, pytest.approx(2000.0 * by_hand, rel=2e-2))
    (verdict,) = check(tube(events=(step,)), only=["start_fatigue"])
    assert verdict.value == pytest.approx(found.share, rel=1e-6)
    assert strength(tube(events=(step,))).shafts[1].fatigue_life == pytest.approx(3600.0 * 5000 / verdict.value)


@pytest.mark.slow
def test_the_fastest_ramp_through_a_resonance_costs_least() -> None:
    drive = tube(run_up=RunUp(end=540 * rpm, duration=4.0), starts=1000.0, events=(replace(CLUTCH, torque=900.0), STEP))
    ramps = ramp_damages(drive)
    assert [one.duration for one in ramps] == [1.0, 2.0, 4.0, 8.0, 16.0]
    assert all(one.damage < two.damage for one, two in pairwise(ramps))
    assert cheapest(ramps) == 0
    events = event_damages(drive)
    assert [one.name for one in events] == ["run-up", "closing of the clutch", "load step"]
    assert events[0].damage == pytest.approx(ramps[2].damage)
    told = answer(drive, ask(drive))
    names = {table.name for table in told.tables}
    assert {"events", "ramps"} <= names
    short = strength(drive).shafts[1].fatigue_life < drive.duty.life
    (verdict,) = check(drive, only=["start_fatigue"])
    assert short == (verdict.state == "failed") == (told.code == 1) == ("asked" in str(told.sentence))
    assert short


def test_events_need_a_speed_and_a_torque() -> None:
    with pytest.raises(InputError, match=r"duty\.speed: missing; an event starts from it"):
        replace(line(), duty=Duty(torque=10.0, events=(STEP,)))
    with pytest.raises(InputError, match=r"duty\.events\[0\]\.start: belongs to a clutch"):
        replace(line(), duty=Duty(speed=9.0, torque=10.0, events=(replace(STEP, start=3.0),)))


def test_an_event_that_cannot_be_followed_tells_why() -> None:
    """A clutch that passes on less than the drive resists slips for ever: check and strength say so, by its message."""
    drive = tube(events=(replace(CLUTCH, torque=20.0, name="half clutch"),))
    (verdict,) = check(drive, only=["start_fatigue"])
    assert not verdict.run
    assert not verdict.missing
    assert "slips without end" in verdict.unfit
    ((name, why),) = ask(drive).lost
    assert name == "half clutch"
    assert why.startswith("duty.events.torque: 20 N·m given; the clutch slips without end")
    assert any("half clutch" in told(one.text, USUAL) for one in answer(drive, ask(drive)).remarks)
    with speaking("ru"):
        assert ask(drive).lost[0][1] != why


@pytest.mark.slow
def test_a_start_that_yields_a_shaft_fails_it_although_it_hardly_tires_it() -> None:
    """One run-up through resonance at 2,858 N·m: √(3T² + 4M²)/W past yield, where running uses two fifths of it."""
    drive = tube(run_up=RunUp(end=540 * rpm, duration=4.0), starts=1.0)
    (tired,) = check(drive, only=["start_fatigue"])
    assert tired.utilisation < 0.01
    (running,) = check(replace(drive, duty=replace(drive.duty, starts=None)), only=["tube_strength"])
    assert running.utilisation < 0.5
    (started,) = check(drive, only=["tube_strength"])
    torque = float(np.max(np.abs(run_up_torque(drive)[0])))
    case = design(drive).loaded[0]
    couple = torque * float(case.end_bending[1] / case.shaft_torque[1])
    modulus = math.pi * (0.046**4 - 0.038**4) / (16 * 0.046)
    alone, both = (math.sqrt(3.0 * torque**2 + 4.0 * one**2) / modulus for one in (0.0, couple))
    assert alone < started.value < both < 1.05 * alone  # torque and couple are largest at different angles
    assert started.value > 355e6
    assert "run-up" in str(started.note)
    found = strength(drive)
    assert found.enough is False
    assert [one.value for one in found.of("shafts[1]") if one.check == "tube_strength"] == [started.value]
    assert found.rated_torque == 0.0  # the joints alone shake it past that, whatever it carries


def test_parts_of_joints_bear_an_event_without_the_factor_for_shocks() -> None:
    """A load step to 160 N·m swings to 260 N·m: 100 N·m would turn the shaft evenly, 60 N·m it carries."""
    joint = Hooke(joint_angle=0.0, cross=Cross(span=0.05), needles=Needles(static_capacity=20e3))
    bare = replace(line(shock_factor=1.5), joints=(joint,))
    (steady,) = [one for one in check(bare, only=["needle_static"]) if one.run and not one.advice]
    assert steady.value == pytest.approx(1.5 * LOAD / 0.05)
    drive = replace(bare, duty=replace(bare.duty, events=(replace(STEP, name="swath"),)))
    (loaded,) = [one for one in check(drive, only=["needle_static"]) if one.run and not one.advice]
    assert loaded.value == pytest.approx(260.0 / 0.05, rel=2e-3)
    assert str(loaded.note).endswith("swath")
    slight = replace(drive, duty=replace(drive.duty, events=(replace(STEP, torque=65.0),)))
    (same,) = [one for one in check(slight, only=["needle_static"]) if one.run and not one.advice]
    assert same.value == pytest.approx(steady.value)


def test_events_load_a_drive_as_drawn_beside_its_poses() -> None:
    pose = Pose(name="raised", set=(("joints[0].joint_angle_deg", 20.0),))
    drive = replace(line(10 * deg, events=(STEP,)), poses=(pose,))
    said = [name for name, _one in happening(design(drive))]
    assert said == ["largest in time: load step"]
    assert not [one for _name, stand in stood(design(drive)) for one in happening(stand)]


@pytest.mark.slow
def test_without_torque_events_and_vibration_load_a_drive_alone() -> None:
    """A clutch closes on a flywheel that nothing resists: its torque, its damage, and no times of none at all."""
    drive = tube(events=(replace(CLUTCH, torque=900.0),))
    free = replace(drive, duty=replace(drive.duty, torque=0.0))
    (found,) = event_damages(free)
    assert found.torque == pytest.approx(np.max(np.abs(event_torque(free, free.duty.events[0])[0])))
    said = [told(one.text, USUAL) for one in answer(free, strength(free)).remarks]
    (counted,) = [one for one in said if "Torsional vibration is counted" in one]
    assert "times that without it" not in counted


@pytest.mark.slow
def test_starts_are_those_of_the_drive_as_drawn_and_running_that_of_all_poses() -> None:
    drive = tube(run_up=RunUp(end=540 * rpm, duration=2.0), starts=1000.0)
    pose = Pose(name="raised", set=(("joints[0].joint_angle_deg", 18.0),), share=0.3)
    ((alone,), (posed,)) = (check(one, only=["start_fatigue"]) for one in (drive, replace(drive, poses=(pose,))))
    assert posed.value == pytest.approx(alone.value)  # in neither does running tire it
    assert strength(replace(drive, poses=(pose,))).shafts[1].fatigue_life == pytest.approx(
        drive.duty.life / posed.value
    )


@pytest.mark.slow
def test_a_load_case_vibrates_over_the_speeds_of_the_duty_as_it_does_alone() -> None:
    """A peak without a speed of its own meets the resonance at 307 rpm, which the range of the duty holds."""
    case = Case(name="peak", torque=900.0, share=0.1)
    drive = tube(speed_range=(200 * rpm, 600 * rpm), cases=(case,))
    whole, fixed = (
        float(check(one, only=["tube_strength"])[0].value)
        for one in (drive, replace(drive, duty=replace(drive.duty, speed_range=None)))
    )
    alone = [float(check(one.drive, only=["tube_strength"])[0].value) for one in conditions(drive)]
    assert whole == pytest.approx(max(alone), rel=1e-6)
    assert alone[1] > max(alone[0], 1.5 * fixed)
