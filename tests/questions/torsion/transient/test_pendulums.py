"""Pendulums in time against Lagrange's equations of the whole system, written apart and integrated by SciPy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import Drive, InputError
from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.checks import check
from cardan.checks.strength.answer import answer as strength_answer
from cardan.checks.strength.strength import strength
from cardan.drive.duty import Duty
from cardan.drive.machine import ConstantTorque, RunUp
from cardan.drive.material import Material
from cardan.drive.shaft import Shaft
from cardan.drive.station import Pendulum, Station, ToNext
from cardan.questions.torsion.model.torsional_balance import accelerations, balance, energy, slopes
from cardan.questions.torsion.model.torsional_train import swinging, torsional_train
from cardan.questions.torsion.steady.answer import answer as steady_answer
from cardan.questions.torsion.steady.pendulum_swing import WIDE, pendulum_swing, strikes, strikes_in_use
from cardan.questions.torsion.steady.torsion_response import torsion_response
from cardan.questions.torsion.transient.answer import answer
from cardan.questions.torsion.transient.fixed_steps import FixedStep
from cardan.questions.torsion.transient.torsion_transient import transient
from cardan.questions.torsion.transient.transient import Adaptive
from cardan.units import deg

MASS, RADIUS, ARM, COUNT = 0.4, 0.12, 0.03, 2
BEND, STIFFNESS, DAMPING, MIDDLE, MILL = 14 * deg, 9000.0, 8.0, 0.08, 0.3
LOAD = 60.0
HUNG = Pendulum(mass=MASS, radius=RADIUS, length=ARM, count=COUNT)
FAST = Adaptive(rtol=1e-9, atol=1e-10)


def drive(duty: Duty, hung: Pendulum | None = HUNG, damping: float = DAMPING) -> Drive:
    """Return a forced input, an elastic shaft, pendulums on its driving yoke, a joint and a mill behind it."""
    return replace(
        Drive.from_angles([BEND]),
        shafts=(Shaft(number=1, stiffness=STIFFNESS, damping=damping),),
        stations=(
            Station(shaft=1, end="start", inertia=1.0),
            Station(shaft=1, end="end", inertia=MIDDLE, pendulum=hung),
            Station(shaft=2, inertia=MILL, name="mill"),
        ),
        duty=duty,
    )


def plain(course, begin, end, times, *, stop=None):
    """Return angle, swing and torque of the shaft by Lagrange's equations in the angle of the yoke and the swing.

    The joint turns its mill by i = cos α/(1 - sin²α cos²a); the mass of the pendulums has the velocity of its place.
    """
    cosine = np.cos(BEND)
    mass = COUNT * MASS

    def ratio(a):
        below = 1.0 - np.sin(BEND) ** 2 * np.cos(a) ** 2
        return cosine / below, -cosine * np.sin(BEND) ** 2 * np.sin(2.0 * a) / below**2

    def slope(time, y):
        a, phi, va, vphi = y
        forced, speed = course(time)
        i, bend = ratio(a)
        # the mass matrix and the forces of Lagrange's equations for (a, phi)
        c, s = np.cos(phi), np.sin(phi)
        inertia = np.array(
            [
                [MIDDLE + MILL * i**2 + mass * (RADIUS**2 + ARM**2 + 2 * RADIUS * ARM * c), 0.0],
                [0.0, mass * ARM**2],
            ]
        )
        inertia[0, 1] = inertia[1, 0] = mass * (ARM**2 + RADIUS * ARM * c)
        twist = STIFFNESS * (forced - a) + DAMPING * (speed - va)
        beyond = 0.0
        if stop is not None and abs(phi) > stop[0]:
            beyond = -stop[1] * (phi - np.sign(phi) * stop[0])
        right = np.array(
            [
                twist - LOAD * i - MILL * i * bend * va**2 + mass * RADIUS * ARM * s * (2 * va * vphi + vphi**2),
                -mass * RADIUS * ARM * s * va**2 + beyond,
            ]
        )
        return np.concatenate((y[2:], np.linalg.solve(inertia, right)))

    start = [0.0, 0.0, course(begin)[1], 0.0]
    found = solve_ivp(slope, (begin, end), start, t_eval=times, method="DOP853", rtol=1e-10, atol=1e-11, max_step=2e-3)
    forced, speed = course(times)
    torque = STIFFNESS * (forced - found.y[0]) + DAMPING * (speed - found.y[2])
    return found.y[0], found.y[1], torque


def even(speed):
    """Return a course of one speed."""
    return lambda time: (speed * time, speed + 0.0 * time)


@pytest.mark.slow
def test_pendulums_follow_lagrange_at_one_speed() -> None:
    found = transient(drive(Duty(speed=90.0, torque=LOAD)), span=0.6, method=FAST)
    motion = found.motion
    a, phi, torque = plain(even(90.0), 0.0, 0.6, motion.times)
    assert np.max(np.abs(phi)) > 0.2  # wide enough to tell a pendulum from its spring
    pivot, tip = found.train.model.elements[found.train.pendulums[0]]
    np.testing.assert_allclose(motion.angle[:, pivot], a, atol=1e-7)
    np.testing.assert_allclose(motion.angle[:, tip] - motion.angle[:, pivot], phi, atol=1e-6)
    np.testing.assert_allclose(motion.torque[:, 0], torque, atol=1e-3)
    assert found.swings == (pytest.approx(np.max(np.abs(phi)), rel=1e-6),)
    assert motion.imbalance < 1e-8


@pytest.mark.slow
def test_pendulums_follow_the_speed_of_a_run_up() -> None:
    """The spring of the start speed is not theirs: at thrice the speed it would be nine times too soft."""
    ramp = RunUp(start=40.0, end=120.0, duration=1.5)
    found = transient(drive(Duty(run_up=ramp, torque=LOAD)), method=FAST)

    def course(time):
        rate, until = 80.0 / 1.5, np.minimum(time, 1.5)
        return 40.0 * time + rate * (0.5 * until**2 + 1.5 * (time - until)), 40.0 + rate * until

    _a, phi, torque = plain(course, 0.0, 1.8, found.motion.times)
    np.testing.assert_allclose(found.motion.torque[:, 0], torque, atol=2e-3)
    assert found.swings[0] == pytest.approx(np.max(np.abs(phi)), rel=1e-5)
    assert np.max(np.abs(found.motion.torque[:, 0])) == pytest.approx(np.max(np.abs(torque)), rel=1e-6)
    small = transient(drive(Duty(speed=40.0, torque=LOAD)), span=0.1).train.model  # what counted before
    assert small.stiffness[1] == pytest.approx(COUNT * MASS * (RADIUS + ARM) ** 2 * 40.0**2 * RADIUS / ARM)


@pytest.mark.slow
def test_a_stop_is_met_and_thrown_back() -> None:
    stopped = replace(HUNG, stop_angle=8 * deg, stop_stiffness=400.0)
    found = transient(drive(Duty(speed=90.0, torque=LOAD), stopped), span=0.4, method=FAST)
    _a, phi, torque = plain(even(90.0), 0.0, 0.4, found.motion.times, stop=(8 * deg, COUNT * 400.0))
    assert np.max(np.abs(phi)) > 8 * deg
    np.testing.assert_allclose(found.motion.torque[:, 0], torque, atol=0.05)
    assert found.swings[0] == pytest.approx(np.max(np.abs(phi)), rel=1e-3)
    texts = [str(one.text) for one in answer(drive(Duty(speed=90.0, torque=LOAD), stopped), found).remarks]
    assert any("stops" in one for one in texts)


def test_the_torque_of_pendulums_is_what_their_station_misses() -> None:
    """J F̈ of the bare station is what comes through the shaft less what goes to the mill and into the pendulums."""
    found = transient(drive(Duty(speed=90.0, torque=LOAD)), span=0.3, times=30001, method=FAST)
    motion, model = found.motion, found.train.model
    pivot, tip = model.elements[found.train.pendulums[0]]
    mill = model.names.index("mill")
    step = motion.times[1]
    change = np.gradient(motion.speed, step, axis=0, edge_order=2)
    own = MIDDLE * change[:, pivot]
    ratio = motion.speed[:, mill] / motion.speed[:, pivot]
    behind = ratio * (LOAD + MILL * change[:, mill])
    e = found.train.pendulums[0]
    np.testing.assert_allclose(motion.torque[2:-2, e], (motion.torque[:, 0] - behind - own)[2:-2], atol=0.05)
    assert tip == len(model.names) - 1


def test_small_swings_are_those_of_the_absorber() -> None:
    """What steady answers count with: an absorber of m (R + l)² with the stiffness of the speed."""
    calm = replace(drive(Duty(speed=90.0, torque=1.0)), joints=(replace(Drive.from_angles([2 * deg]).joints[0]),))
    calm = replace(calm, stations=(*calm.stations[:2], replace(calm.stations[2], inertia=0.02)))
    found = transient(calm, span=1.0, start="settled", method=FAST)
    assert found.swings[0] < 0.01
    wanted, e = torsion_response(calm), found.train.pendulums[0]
    reach = found.motion.extremes.torque_high - found.motion.extremes.torque_low
    assert reach[e] == pytest.approx((wanted.torque_highest - wanted.torque_lowest)[e], rel=1e-4)
    assert np.ptp(found.motion.torque[-400:, e]) == pytest.approx(reach[e], rel=1e-4)


@pytest.mark.slow
def test_steady_answers_tell_how_far_pendulums_oscillate_and_that_they_hit_their_stops() -> None:
    """Small oscillations are those in time; with a stop that they would pass every answer says what it left out."""
    calm = replace(drive(Duty(speed=90.0, torque=1.0)), joints=(replace(Drive.from_angles([2 * deg]).joints[0]),))
    wanted = torsion_response(calm)
    (swing,) = pendulum_swing(wanted)
    assert swing == pytest.approx(transient(calm, span=1.0, start="settled", method=FAST).swings[0], rel=2e-3)
    kept, struck = (
        replace(
            calm,
            stations=(
                calm.stations[0],
                replace(calm.stations[1], pendulum=replace(HUNG, stop_angle=share * swing, stop_stiffness=400.0)),
                calm.stations[2],
            ),
        )
        for share in (1.1, 0.9)
    )
    assert list(strikes(torsion_response(drive(Duty(speed=90.0, torque=LOAD), None)))) == []
    assert list(strikes(torsion_response(drive(Duty(torque=LOAD), None), speed=[60.0, 90.0]))) == []
    for one, count in ((kept, 0), (struck, 1)):
        assert len(list(strikes(torsion_response(one)))) == count
        assert len(strikes_in_use(one)) == count
        assert len(strikes_in_use(replace(one, duty=Duty(speed_range=(60.0, 90.0), torque=1.0)))) == count
        answers = (steady_answer(one, torsion_response(one)), strength_answer(one, strength(one)))
        for remarks in (its.remarks for its in answers):
            assert sum("hits its stops" in str(its.text) for its in remarks) == count
    assert transient(struck, span=1.0, start="settled", method=FAST).swings[0] > 0.9 * swing


@pytest.mark.parametrize(("bend", "wide"), [(4 * deg, False), (8 * deg, True)])
def test_where_pendulums_swing_wide_every_answer_says_that_more_alternates_than_counted(bend, wide) -> None:
    """Near their tuning: small oscillations tell some percent too little at ±4°, a third at ±17°."""
    hung = Pendulum(mass=0.3, radius=0.1, length=0.1 / 1.9**2, count=4)
    one = replace(
        Drive.from_angles([bend]),
        shafts=(Shaft(number=2, stiffness=2e4, damping=2.0),),
        stations=(Station(shaft=2, end="end", inertia=0.3, pendulum=hung),),
        duty=Duty(speed=100.0, torque=100.0),
    )
    counted = torsion_response(one)
    ends = transient(one, span=4.0 * np.pi / 100.0, start="settled", times=301).motion.extremes
    swung = float((ends.torque_high - ends.torque_low)[0])
    assert swung / float((counted.torque_highest - counted.torque_lowest)[0]) == pytest.approx(
        1.35 if wide else 1.05, abs=0.04
    )
    assert (pendulum_swing(counted)[0] > WIDE) == wide
    assert len(strikes_in_use(one)) == wide
    for its in (steady_answer(one, counted), strength_answer(one, strength(one))):
        assert sum("too wide" in str(remark.text) for remark in its.remarks) == wide


def test_slopes_and_energy_are_those_of_the_balance() -> None:
    train = torsional_train(drive(Duty(speed=90.0, torque=LOAD)))
    model = swinging(train)
    random = np.random.default_rng(3)
    q, rate, change = (random.uniform(-2.0, 2.0, (5, model.coordinates)) * size for size in (1.0, 40.0, 900.0))
    found, step = slopes(model, q, rate, change), 1e-6
    assert found.coupled is not None
    for s in range(model.coordinates):
        side = np.zeros(model.coordinates)
        side[s] = step
        by_q = (balance(model, q + side, rate, change) - balance(model, q - side, rate, change)) / (2 * step)
        by_v = (balance(model, q, rate + side, change) - balance(model, q, rate - side, change)) / (2 * step)
        by_a = (balance(model, q, rate, change + side) - balance(model, q, rate, change - side)) / (2 * step)
        np.testing.assert_allclose(by_q, found.stiffness[..., s], atol=1e-2)
        np.testing.assert_allclose(by_v, found.damping[..., s], atol=1e-4)
        mass = found.coupled[..., s].copy()
        mass[..., s] += found.mass[..., s]
        np.testing.assert_allclose(by_a, mass, atol=1e-4)
    free = replace(model, input_speed=None, torques=(), damping=0.0 * model.damping)
    acting = accelerations(free, q, rate)
    assert np.max(np.abs(balance(free, q, rate, acting))) < 1e-8
    ahead, behind = (energy(free, q + k * step * rate, rate + k * step * acting) for k in (1.0, -1.0))
    np.testing.assert_allclose((ahead - behind) / (2 * step), 0.0, atol=1e-2)


@pytest.mark.slow
def test_stations_without_inertia_go_implicitly_to_the_same_motion() -> None:
    """The same drive with a station without inertia in the middle of its shaft: twice as stiff on either side."""
    whole = drive(Duty(speed=90.0, torque=LOAD), damping=0.0)
    light = Station(shaft=1, end=None, to_next=ToNext(stiffness=2.0 * STIFFNESS))
    first = replace(whole.stations[0], to_next=ToNext(stiffness=2.0 * STIFFNESS))
    halves = replace(whole, stations=(first, light, *whole.stations[1:]))
    direct = transient(whole, span=0.2, method=FAST).motion
    implicit = transient(halves, span=0.2, method=FAST).motion
    assert (direct.method, implicit.method) == ("explicit", "implicit")
    np.testing.assert_allclose(implicit.torque[:, 0], direct.torque[:, 0], atol=0.01)
    np.testing.assert_allclose(implicit.torque[:, -1], direct.torque[:, -1], atol=0.01)
    assert implicit.imbalance < 1e-6


def test_what_pendulums_need_is_said() -> None:
    with pytest.raises(InputError, match="pendulums with their own angle have no fixed steps"):
        transient(drive(Duty(speed=90.0, torque=LOAD)), span=0.1, method=FixedStep())
    bare = drive(Duty(speed=90.0, torque=LOAD))
    end = replace(bare.stations[1], inertia=0.0)
    light = replace(bare, stations=(bare.stations[0], end, replace(bare.stations[2], inertia=0.0)))
    with pytest.raises(InputError, match="has no inertia; pendulums in time need some"):
        transient(light, span=0.1)


def test_free_drives_swing_too() -> None:
    motor = Duty(speed=60.0, torque=LOAD, motor=ConstantTorque(torque=80.0))
    found = transient(drive(motor), span=0.3, method=FAST)
    assert found.complete
    assert found.motion.imbalance < 1e-8


@pytest.mark.slow
def test_no_check_is_green_by_the_torque_of_pendulums_that_hit_their_stops_or_swing_wide() -> None:
    """The same drive with stops far out is judged; failures stay, for the torque is larger than counted."""
    steel = Material(yield_strength=355e6, ultimate_strength=600e6)

    def states(stop: float, bend: float = 3 * deg) -> dict[tuple[str, str], str]:
        bare, bent = drive(Duty(speed=90.0, torque=1.0)), Drive.from_angles([bend])
        tubes = tuple(replace(one, outer=0.06, wall=0.003, length=0.5, material=steel) for one in bare.shafts)
        hung = replace(bare.stations[1], pendulum=replace(HUNG, stop_angle=stop, stop_stiffness=400.0))
        stations = (bare.stations[0], hung, bare.stations[2])
        whole = replace(bent, shafts=tubes, stations=stations, duty=bare.duty)
        said = told(strength_answer(whole, strength(whole)).sentence, USUAL)
        assert ("a pendulum that oscillates widely or hits its stops" in said) is (stop < 0.1 or bend > 0.1)
        return {(one.check, one.subject): one.state for one in check(whole)}

    free, struck, wide = states(3.0), states(1 * deg), states(3.0, BEND)
    loaded = [key for key in free if key[0] in ("tube_strength", "tube_fatigue", "tube_buckling", "twist")]
    loaded += [("torsional_resonance", "shafts[0]"), ("torsional_resonance", "shafts[1]")]
    assert loaded
    for key in loaded:
        assert free[key] in ("passed", "unconfirmed", "close")
        assert struck[key] == wide[key] == "not_run"
    rest = free.keys() - set(loaded)
    assert {key: free[key] for key in rest} == {key: struck[key] for key in rest}
