"""Springs by a table and dry friction in time, against SciPy's integration of equations written apart."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import Drive, InputError
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.duty import Duty
from cardan.drive.machine import HarmonicTorque
from cardan.drive.shaft import Shaft
from cardan.drive.station import Station, ToNext
from cardan.questions.torsion.model.answer import assumptions
from cardan.questions.torsion.model.torsional_balance import balance, energy, slopes, spring_torque
from cardan.questions.torsion.model.torsional_train import in_full, torsional_train
from cardan.questions.torsion.steady.answer import answer
from cardan.questions.torsion.steady.dynamic_torque import dynamic_torque
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.questions.torsion.steady.torsion_response import torsion_response
from cardan.questions.torsion.transient.fixed_steps import FixedStep
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.questions.torsion.transient.transient import Adaptive
from cardan.units import rpm

TWISTS, TORQUES = (-0.2, -0.05, 0.0, 0.05, 0.2), (-700.0, -100.0, 0.0, 100.0, 700.0)
BEND, SPEED, INERTIA, LOAD = math.radians(12.0), 60.0, 0.4, 80.0
FAST = Adaptive(rtol=1e-8, atol=1e-9)


def drive(part: ToNext) -> Drive:
    """Return a forced input, a part that twists, a joint and a mill behind it."""
    return replace(
        Drive.from_angles([BEND]),
        shafts=(Shaft(number=1),),
        stations=(
            Station(shaft=1, end="start", inertia=1.0, to_next=part),
            Station(shaft=1, end="end", inertia=0.05),
            Station(shaft=2, inertia=INERTIA),
        ),
        duty=Duty(speed=SPEED, torque=LOAD),
    )


def plain(times: np.ndarray, friction: float, damping: float, start: tuple[float, float] = (0.0, SPEED)) -> np.ndarray:
    """Return the torque of the part: yoke and mill as one mass, spring by the table, friction that really sticks.

    Sticking the yoke turns with the input; it slips as long as its speed differs, each stretch integrated by itself.
    """

    def inertia(a: float) -> tuple[float, float, float]:
        below = 1.0 - math.sin(BEND) ** 2 * math.cos(a) ** 2
        i, bend = math.cos(BEND) / below, -math.cos(BEND) * math.sin(BEND) ** 2 * math.sin(2.0 * a) / below**2
        return 0.05 + INERTIA * i * i, INERTIA * i * bend, i

    def table(x: float) -> float:
        stiff, soft = 4000.0, 2000.0
        return soft * x if abs(x) <= 0.05 else math.copysign(100.0 + stiff * (abs(x) - 0.05), x)

    def asked(t: float, a: float) -> float:  # torque that keeps the yoke at the speed of the input
        _mass, turning, i = inertia(a)
        return turning * SPEED**2 + i * LOAD

    def slip(way: float):
        def slope(t, y):
            mass, turning, i = inertia(y[0])
            x = SPEED * t - y[0]
            carried = table(x) + damping * (SPEED - y[1]) + way * friction
            return [y[1], (carried - i * LOAD - turning * y[1] ** 2) / mass]

        return slope

    found = np.zeros(len(times))
    slips = SPEED - start[1]
    now, state, way = 0.0, np.asarray(start), math.copysign(1.0, slips) if abs(slips) > 1e-3 * SPEED else 0.0
    while now < times[-1]:
        if way == 0.0:  # how long does it stick
            twist = SPEED * now - state[0]
            fine = np.linspace(now, times[-1], 400001)
            over = np.abs([asked(t, SPEED * t - twist) - table(twist) for t in fine]) > friction
            end = fine[int(np.argmax(over))] if over.any() else times[-1] + 1.0
            here = (times >= now) & (times < end)
            found[here] = [asked(t, SPEED * t - twist) for t in times[here]]
            way = math.copysign(1.0, asked(end, SPEED * end - twist) - table(twist))
            now, state = end, np.asarray([SPEED * end - twist, SPEED])
            continue

        def event(t, y, way=way, now=now):
            return way * (SPEED - y[1]) + (1e-9 if t < now + 1e-6 else 0.0)

        event.terminal, event.direction = friction > 0.0, -1.0
        run = solve_ivp(
            slip(way),
            (now, times[-1]),
            state,
            events=event,
            method="DOP853",
            rtol=1e-9,
            atol=1e-11,
            max_step=1e-3,
            dense_output=True,
        )
        here = (times >= now) & (times <= run.t[-1])
        a, v = run.sol(times[here])
        found[here] = [table(x) for x in SPEED * times[here] - a] + damping * (SPEED - v) + way * friction
        now, state = run.t[-1], run.y[:, -1]
        twist = SPEED * now - state[0]
        left = asked(now, state[0]) - table(twist)
        way = 0.0 if abs(left) < friction else math.copysign(1.0, left)
    return found


@pytest.mark.slow
def test_a_spring_by_its_table_follows_scipy() -> None:
    found = transient(drive(ToNext(twists=TWISTS, torques=TORQUES, damping=1.0)), span=0.8, method=FAST).motion
    wanted = plain(found.times, 0.0, 1.0)
    assert np.max(wanted) > 150.0  # beyond the first bend of the table
    np.testing.assert_allclose(found.torque[:, 0], wanted, atol=1e-3)
    assert found.imbalance < 1e-7


@pytest.mark.slow
def test_dry_friction_sticks_and_slips_as_scipy_says() -> None:
    part = ToNext(twists=TWISTS, torques=TORQUES, damping=0.5, friction=25.0)
    found = transient(drive(part), span=0.5, method=FAST).motion
    wanted = plain(found.times, 25.0, 0.5)
    # where it sticks the part creeps within a band of 0.012 rad/s, and slips again so much later: a jump of 50 N·m
    off = np.abs(found.torque[1:, 0] - wanted[1:])
    assert np.quantile(off, 0.98) < 0.01 * np.max(wanted)
    assert np.sqrt(np.mean(off**2)) < 0.01 * np.max(wanted)
    assert found.imbalance < 1e-6


def test_hysteresis_takes_four_times_friction_and_amplitude_a_cycle() -> None:
    """Free swing about a held input: the amplitude falls by 2 M/c in half a period, as Coulomb says."""
    straight = drive(ToNext(stiffness=2000.0, damping=0.0, friction=6.0))
    joints = (replace(straight.joints[0], joint_angle=0.0),)
    found = transient(replace(straight, joints=joints), span=0.6, times=6001, method=FAST).motion
    twist = found.angle[:, 0] - found.angle[:, 1]
    turns = np.flatnonzero(np.diff(np.sign(np.diff(twist))) != 0)[:4] + 1
    middle = np.abs(twist[turns] - LOAD / 2000.0)
    falls = -np.diff(np.concatenate(([LOAD / 2000.0], middle)))
    np.testing.assert_allclose(falls, 2.0 * 6.0 / 2000.0, rtol=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(("friction", "off"), [(0.0, 1e-4), (5.0, 2e-3), (25.0, 5e-3)])
def test_steady_running_with_tables_and_friction_is_what_scipy_keeps_to(friction: float, off: float) -> None:
    """From where the steady motion begins SciPy's integration runs through it again, with the same extremes."""
    part = ToNext(twists=TWISTS, torques=TORQUES, damping=2.0, friction=friction)
    found = torsion_response(drive(part), speed=np.asarray([SPEED]))
    q, rate, _change = (one[0, 0] for one in found.steady.orbit.of(np.asarray([0]), [0.0]))
    turn = math.pi / SPEED
    times = np.linspace(0.0, 3.0 * turn, 3001)
    wanted = plain(times, friction, 2.0, (float(q[1]), float(rate[1])))
    size = np.ptp(wanted)
    assert size > 60.0
    for values in (wanted, wanted[2000:]):
        assert found.torque_highest[0, 0] == pytest.approx(np.max(values), abs=off * size)
        assert found.torque_lowest[0, 0] == pytest.approx(np.min(values), abs=off * size)
    assert found.floquet.stable[0]


@pytest.mark.slow
def test_every_steady_answer_has_tables_and_friction() -> None:
    part = ToNext(twists=TWISTS, torques=TORQUES, damping=2.0, friction=25.0)
    rubbing, smooth = drive(part), drive(replace(part, friction=0.0))
    speeds = np.asarray([40.0, SPEED])
    found, straight = (torsion_response(one, speed=speeds) for one in (rubbing, smooth))
    assert straight.swing[0, 0] > 400.0 > 30.0 > found.swing[0, 0]  # at the resonance
    strong = dynamic_torque(rubbing, speed=speeds)
    np.testing.assert_allclose(strong.high[:, 0], found.torque_highest[:, 0], rtol=1e-6)
    np.testing.assert_allclose(strong.low[:, 0], found.torque_lowest[:, 0], rtol=1e-6)
    run = transient(rubbing, span=0.2, start="settled", method=FAST).motion
    assert np.max(run.torque[:, 0]) == pytest.approx(found.torque_highest[1, 0], rel=0.01)


@pytest.mark.slow
def test_what_would_grow_without_its_friction_is_not_called_unstable() -> None:
    """A torque amid the resonance: by `simulate` the torque comes from rest to -75.87 … 269.19 N·m and stays."""
    buffer = ToNext(
        twists=tuple(np.radians([-8.0, -3.0, 0.0, 3.0, 8.0])),
        torques=(-900.0, -100.0, 0.0, 100.0, 900.0),
        friction=25.0,
    )
    made = replace(
        Drive.from_angles([BEND]),
        shafts=(Shaft(number=1, length=0.5), Shaft(number=2, length=0.9, outer=0.06, wall=0.003)),
        stations=(
            Station(shaft=1, inertia=1.2, to_next=buffer),
            Station(shaft=1, end="end", inertia=0.05),
            Station(shaft=2, name="mill", end="end", inertia=0.4),
        ),
        duty=Duty(speed=600 * rpm, torque=80.0, torques=(HarmonicTorque(amplitude=60.0, order=1.0, station="mill"),)),
    )
    found = torsion_response(made)
    assert found.torque_lowest[0] == pytest.approx(-75.87, abs=1.5)
    assert found.torque_highest[0] == pytest.approx(269.19, abs=1.5)
    assert found.floquet.spectral_radius > 1.2  # its springs and dampers alone
    assert found.floquet.verdict == Verdict.UNKNOWN
    said = answer(made, found)
    assert (said.tone, said.code) == ("warning", 0)
    assert "is not known: dry friction" in told(said.sentence, USUAL)


def test_energy_and_slopes_are_those_of_the_table() -> None:
    train = torsional_train(drive(ToNext(twists=TWISTS, torques=TORQUES, damping=0.5, friction=25.0)))
    model = in_full(train, SPEED)
    assert spring_torque((TWISTS, TORQUES), 0.1) == pytest.approx((300.0, 4000.0))
    assert spring_torque((TWISTS, TORQUES), -0.3) == pytest.approx((-1100.0, 4000.0))
    q, rate = np.asarray([[0.12, 0.03]]), np.asarray([[60.0, 59.999]])
    change = np.zeros_like(q)
    found, step = slopes(model, q, rate, change), 1e-6
    for s in range(2):
        side = np.zeros(2)
        side[s] = step
        by_q = (balance(model, q + side, rate, change) - balance(model, q - side, rate, change)) / (2 * step)
        by_v = (balance(model, q, rate + side, change) - balance(model, q, rate - side, change)) / (2 * step)
        np.testing.assert_allclose(by_q, found.stiffness[..., s], rtol=1e-5, atol=1e-2)
        np.testing.assert_allclose(by_v, found.damping[..., s], rtol=1e-5, atol=1e-2)
    stored = energy(model, np.asarray([[0.1, 0.0]]), 0.0 * rate)
    assert stored == pytest.approx(0.5 * 2000.0 * 0.05**2 + 0.5 * (100.0 + 300.0) * 0.05)


def test_linear_answers_take_the_tangent_and_say_so() -> None:
    train = torsional_train(drive(ToNext(twists=TWISTS, torques=TORQUES, friction=25.0)))
    assert train.model.stiffness == pytest.approx([2000.0])
    heavy = drive(ToNext(twists=TWISTS, torques=TORQUES))
    steep = torsional_train(replace(heavy, duty=Duty(speed=SPEED, torque=300.0)))
    assert steep.model.stiffness == pytest.approx([4000.0])
    (said,) = [one for one in assumptions(train) if "table" in str(one.text)]
    assert "stiffness at the torque of the duty" in str(said.text)
    assert not [one for one in assumptions(train, sprung=True) if "table" in str(one.text)]


def test_what_contradicts_itself_is_said() -> None:
    with pytest.raises(InputError, match=r"to_next\.stiffness: twists and torques give it already"):
        drive(ToNext(twists=TWISTS, torques=TORQUES, stiffness=1.0))
    with pytest.raises(InputError, match=r"to_next\.torques: do not rise"):
        drive(ToNext(twists=(0.0, 0.1), torques=(5.0, 5.0)))
    with pytest.raises(InputError, match="have no fixed steps"):
        transient(drive(ToNext(twists=TWISTS, torques=TORQUES)), span=0.1, method=FixedStep())
