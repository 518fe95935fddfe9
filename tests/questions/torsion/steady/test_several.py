"""Several steady motions at one speed, against equations of one mass written apart and integrated from many starts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import Drive, example
from cardan.answers.data import data
from cardan.answers.quantity import told as told_text
from cardan.answers.reader import USUAL
from cardan.maths.periodic.harmonics import Status
from cardan.questions.torsion.model.inputs import Constant, Swinging
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.stability.answer import answer as stability_answer
from cardan.questions.torsion.stability.floquet_map import floquet_map
from cardan.questions.torsion.stability.torsion_stability import TOLD, judged, stability
from cardan.questions.torsion.steady.answer import answer
from cardan.questions.torsion.steady.dynamic_torque import dynamic_torque
from cardan.questions.torsion.steady.run_stability import Kind, Verdict, floquet
from cardan.questions.torsion.steady.settling import ramped as ramps_of
from cardan.questions.torsion.steady.several import stable_motions
from cardan.questions.torsion.steady.steady import steady_orbits
from cardan.questions.torsion.steady.steady_result import read_off
from cardan.questions.torsion.steady.torsion_response import TorsionResponse, loaded_model, torsion_response
from cardan.units import rpm
from tests.builders.torsion_in_time import flow

STIFFNESS, INERTIA = 1000.0, 0.1


def line(*, load: float, swing: float, damping: float, backlash: float = 0.0) -> TorsionalModel:
    """Return a mass on a spring behind a forced speed, with a torque of order 1 on it."""
    return torsional_line(
        [[1.0, INERTIA]],
        stiffness=[[STIFFNESS]],
        damping=[[damping]],
        backlash=[[backlash]],
        input_speed=50.0,
        torques=[
            Torque(station=1, law=Constant(value=-load)),
            Torque(station=1, law=Swinging(amplitude=swing, frequency=1.0)),
        ],
    )


def settled(
    spring: Callable[[np.ndarray, np.ndarray], np.ndarray], speed: float, load: float, swing: float
) -> list[tuple[float, float]]:
    """Return the extremes of the twist to which a mass settles from 60 places and speeds, the widest first."""
    draw = np.random.default_rng(1)
    x, v = draw.uniform(-0.08, 0.08, 60), draw.uniform(-6.0, 6.0, 60)
    count, periods = 120, 150
    h = 2.0 * np.pi / speed / count
    low, high = np.full(60, np.inf), np.full(60, -np.inf)

    def pushed(t: float, x: np.ndarray, v: np.ndarray) -> np.ndarray:
        return (spring(-x, -v) - load + swing * np.sin(speed * t + x)) / INERTIA

    for k in range(periods * count):
        t = k * h
        if k >= (periods - 2) * count:
            low, high = np.minimum(low, -x), np.maximum(high, -x)
        a = pushed(t, x, v)
        b = pushed(t + h / 2, x + h / 2 * v, v + h / 2 * a)
        c = pushed(t + h / 2, x + h / 2 * v + h * h / 4 * a, v + h / 2 * b)
        d = pushed(t + h, x + h * v + h * h / 2 * b, v + h * c)
        x, v = x + h * v + h * h / 6 * (a + b + c), v + h / 6 * (a + 2 * b + 2 * c + d)
    found: list[tuple[float, float]] = []
    for pair in sorted(zip(low.tolist(), high.tolist(), strict=True), key=lambda one: one[0] - one[1]):
        if not found or abs(pair[1] - found[-1][1]) > 5e-4:
            found.append(pair)
    return found


def ramped(
    spring: Callable[[float, float], float], speed: float, load: float, swing: float, begin: float
) -> tuple[float, float]:
    """Return the extremes of the twist after 30 s in which the speed changes evenly from another one."""
    time, h = 30.0, 2.0 * np.pi / speed / 120
    x, v, twists = -load / STIFFNESS, 0.0, []

    def pushed(t: float, x: float, v: float) -> float:
        ramp = min(t, time)
        turned = begin * ramp + 0.5 * (speed - begin) / time * ramp**2 + speed * (t - ramp)
        rate = (speed - begin) / time if t < time else 0.0
        return (spring(-x, -v) - load + swing * float(np.sin(turned + x))) / INERTIA - rate

    for k in range(int(time / h) + 60 * 120):
        t = k * h
        a = pushed(t, x, v)
        b = pushed(t + h / 2, x + h / 2 * v, v + h / 2 * a)
        c = pushed(t + h / 2, x + h / 2 * v + h * h / 4 * a, v + h / 2 * b)
        d = pushed(t + h, x + h * v + h * h / 2 * b, v + h * c)
        x, v = x + h * v + h * h / 6 * (a + b + c), v + h / 6 * (a + 2 * b + 2 * c + d)
        twists.append(-x)
    return min(twists[-240:]), max(twists[-240:])


def told(model: TorsionalModel, speed: float) -> list[tuple[float, float]]:
    """Return the extremes of the twist of the motion that is told, then of the others, the widest first."""
    orbit, status, beside = stable_motions(*steady_orbits(model, speed=[speed]))
    assert status[0] == Status.CONVERGED
    assert floquet(orbit).verdict[0] == Verdict.STABLE
    highest = read_off(orbit, 1).highest[0, 0]
    assert all(one.highest[0] < highest for one in beside if one.reached)
    angles = np.linspace(0.0, orbit.period, 2000)
    twists = [np.subtract(*one.at(angles)[0][0].T) for one in (orbit, *(one.orbit for one in beside))]
    return [(float(np.min(one)), float(np.max(one))) for one in twists]


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "count"), [(63.0, 2), (69.0, 2), (75.0, 3), (100.0, 1)])
def test_play_has_all_motions_to_which_it_settles_and_tells_the_widest_that_a_slow_ramp_reaches(
    speed: float, count: int
) -> None:
    """At 75 rad/s the widest motion is reached by no slow run-up nor run-down; it is told beside."""
    half, damping = 0.01, 1.5

    def one_spring(twist: float, rate: float) -> float:
        over = twist - half if twist > half else twist + half if twist < -half else 0.0
        return STIFFNESS * over + (damping * rate if over else 0.0)

    def spring(twist: np.ndarray, rate: np.ndarray) -> np.ndarray:
        over = np.where(twist > half, twist - half, np.where(twist < -half, twist + half, 0.0))
        return STIFFNESS * over + np.where(over != 0.0, damping * rate, 0.0)

    ends = sorted((ramped(one_spring, speed, 4.0, 2.0, share * speed) for share in (0.5, 1.5)), key=np.diff)
    truth = settled(spring, speed, 4.0, 2.0)
    truth += [one for one in ends if all(abs(one[1] - other[1]) > 5e-4 for other in truth)]
    found = told(line(load=4.0, swing=2.0, damping=damping, backlash=2.0 * half), speed)
    assert len(found) == len(truth) == count
    np.testing.assert_allclose(sorted(found), sorted(truth), atol=1e-4)  # what the start, steps across contacts leave
    np.testing.assert_allclose(found[0], ends[-1], atol=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [63.0, 69.0])
def test_stability_at_a_speed_judges_the_motion_that_response_tells(speed: float) -> None:
    """The first motion found keeps its play closed and dies out faster, as b/2J; the wider one counts."""
    model, where = line(load=4.0, swing=2.0, damping=1.5, backlash=0.02), np.asarray([speed])
    assert floquet_map(model, speed=where).floquet.growth_rate[0] == pytest.approx(-0.5 * 1.5 / INERTIA, rel=1e-6)
    orbit, _status, _beside = stable_motions(*steady_orbits(model, speed=where))
    found = judged(model, where)
    assert found.growth_rate[0] == pytest.approx(floquet(orbit).growth_rate[0], rel=1e-6)
    assert found.growth_rate[0] > -0.4 * 1.5 / INERTIA


@pytest.mark.slow
def test_stability_of_a_drive_with_play_is_that_of_response_and_a_map_says_where_it_may_not_be() -> None:
    made = example("pto-flywheel")
    made = replace(made, duty=replace(made.duty, torque=100.0, speed=614.0 * rpm))
    found, told = stability(made), torsion_response(made)
    assert int(found.verdict) == int(told.floquet.verdict)
    assert float(found.growth_rate) == pytest.approx(float(told.floquet.growth_rate), rel=1e-6)
    word = "that which torsion response tells"
    for count in (TOLD, TOLD + 1):
        speeds = np.linspace(610.0, 618.0, count)
        over = stability(made, over={"duty.speed_rpm": speeds})
        said = " ".join(told_text(one.text, USUAL) for one in stability_answer(made, over).remarks)
        assert (word in said) == (count > TOLD)


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "count"), [(95.0, 1), (115.0, 2), (118.0, 2), (125.0, 1)])
def test_a_hardening_spring_near_its_resonance_has_both_motions(speed: float, count: int) -> None:
    """Duffing's: torque c x + d x³, d by a table so fine that its corners do not count."""
    cubic, damping, swing = 8e5, 0.8, 2.4
    at = np.linspace(-0.15, 0.15, 1201)
    model = line(load=0.0, swing=swing, damping=damping)
    table = (tuple(at.tolist()), tuple((cubic * at**3).tolist()))
    model = replace(model, tables=(table,), friction=np.zeros(1), creep=np.ones(1))
    truth = settled(lambda x, v: STIFFNESS * x + cubic * x**3 + damping * v, speed, 0.0, swing)
    assert len(truth) == count
    np.testing.assert_allclose(told(model, speed), truth, rtol=2e-3)


def steep(damping: float) -> TorsionalModel:
    """Return a mass behind a joint of 40° that has three motions, two of them stable, at 49.5 rad/s."""
    return torsional_line(
        [[1.0, 0.001], [0.001, 0.1]],
        stiffness=[[3000.0], [1500.0]],
        damping=[[0.0], [damping]],
        joint_angle=[np.radians(40.0)],
        input_speed=49.5,
    )


@pytest.mark.slow
def test_of_three_motions_of_a_steep_joint_the_unstable_middle_one_is_left_for_the_others() -> None:
    model = steep(0.5)
    orbit, status = steady_orbits(model, speed=[49.5])
    middle = floquet(orbit)
    assert (middle.verdict[0], middle.kind[0]) == (Verdict.UNSTABLE, Kind.REPEATING)
    whole, _status, beside = stable_motions(orbit, status)
    assert len(beside) == 1
    for one in (whole, beside[0].orbit):
        q, rate, _acceleration = (values[0, 0, 1:] for values in one.at([0.0]))
        start = np.concatenate([q, rate])
        turned = np.pi * (np.arange(4) < 2)
        np.testing.assert_allclose(flow(model, 49.5, np.pi / 49.5, start) - start, turned, atol=1e-6)
        pushed = flow(model, 49.5, 40 * np.pi / 49.5, start * [1.002, 1.002, 1.0, 1.0])
        np.testing.assert_allclose(pushed - start, 40 * turned, atol=5e-3)  # it comes back


def lasting(inner: float, speed: float) -> TorsionalModel:
    """Return three shafts, the ends without damping: what they begin with fades in thousands of periods.

    inner [kg·m²]: half of the middle shaft, whose stiffness and damping go with it.
    """
    return torsional_line(
        [[0.15, 0.15], [inner, inner], [0.25, 0.25]],
        stiffness=[[9e4], [1.97e7 * inner], [9e4]],
        damping=[[0.0], [1240.0 * inner], [0.0]],
        joint_angle=[0.149, 0.074],
        phase=[0.0, -0.5 * np.pi],
        input_speed=speed,
        torques=[Torque(station=5, law=Constant(value=-250.0))],
    )


@pytest.mark.slow
def test_where_no_ramp_settles_the_largest_motion_is_told_and_it_is_said_that_none_is_known_to_be_reached() -> None:
    orbit, status = steady_orbits(lasting(0.0226, 158.7), speed=[158.7])
    assert ramps_of(orbit.turning.part(np.asarray([0]))) == []
    whole, _status, (other,) = stable_motions(orbit, status)
    assert other.reached is None
    found = read_off(whole, 1)
    assert np.max(other.swing) < 0.5 * np.max(found.highest - found.lowest)
    drive = example("pto-flywheel")
    response = torsion_response(drive)
    beside = tuple(replace(one, periods=1, reached=None) for one in response.beside)
    said = [told_text(one.text, USUAL) for one in answer(drive, replace(response, beside=beside)).remarks]
    (others,) = [one for one in said if "Other stable" in one]
    assert "not known to which" in others
    assert "blow" not in others


@pytest.mark.slow
def test_a_ramp_of_a_drive_that_swings_far_faster_than_it_turns_is_not_followed() -> None:
    """With a shaft so stiff that a turn takes some ten thousand steps, a ramp would take minutes."""
    soft = lasting(0.02, 158.7)
    damped = replace(soft, damping=soft.damping + 20.0)
    stiff = replace(damped, stiffness=soft.stiffness * [1.0, 1.0, 1e5])
    runs = {}
    for name, model in (("soft", damped), ("stiff", stiff)):
        orbit, _status = steady_orbits(model, speed=[158.7])
        runs[name] = ramps_of(orbit.turning.part(np.asarray([0])))
    assert runs["soft"]
    assert runs["stiff"] == []


def shaken(
    stand: TorsionalModel, speed: float, start: float, load: float, periods: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the shaft that rattles at the end of some half turns [rad], and its torque over the last four [N·m].

    One mass between two joints, whose law is tan F' = tan F/cos α, integrated by SciPy from a start [rad].
    """
    (first, last), half = stand.joint_angle, 0.5 * float(stand.backlash[0])
    stiffness, damping = float(stand.stiffness[0]), float(stand.damping[0])
    near, far = float(stand.inertia[2]), float(stand.inertia[3])

    def law(angle: float, alpha: float) -> tuple[float, float, float]:
        ratio = 1.0 / np.cos(alpha)
        turned = np.arctan2(ratio * np.sin(angle), np.cos(angle))
        turned += 2.0 * np.pi * np.round((angle - turned) / (2.0 * np.pi))
        below = np.cos(angle) ** 2 + (ratio * np.sin(angle)) ** 2
        return turned, ratio / below, -ratio * (ratio**2 - 1.0) * np.sin(2.0 * angle) / below**2

    def torque(t: float, q: float, v: float) -> float:
        angle, rate, _more = law(speed * t, first)
        twist = angle - q
        over = twist - np.clip(twist, -half, half)
        return stiffness * over + damping * (rate * speed - v) * (over != 0.0)

    def pushed(t: float, state: np.ndarray) -> tuple[float, float]:
        q, v = state
        _angle, rate, more = law(q + 0.5 * np.pi, last)
        return v, (torque(t, q, v) - rate * (load + far * more * v * v)) / (near + far * rate**2)

    end = periods * np.pi / speed
    ends = np.arange(periods + 1) * np.pi / speed
    fine = np.linspace(ends[-5], end, 1601)
    found = solve_ivp(
        pushed,
        (0.0, end),
        (-0.01, speed),
        method="DOP853",
        rtol=1e-8,
        atol=1e-10,
        dense_output=True,
        max_step=end / 3e3,
    )
    q, v = found.sol(fine)
    return found.sol(ends)[0] - speed * ends, np.asarray([torque(*one) for one in zip(fine, q, v, strict=True)])


def further(drive: Drive, found: TorsionResponse) -> list[str]:
    """Return what is said of motions that repeat after several periods only, or not at all."""
    said = (told_text(one.text, USUAL) for one in answer(drive, found).remarks)
    return [one for one in said if "further motions" in one]


@pytest.mark.slow
def test_a_motion_whose_period_has_doubled_is_told() -> None:
    """The flywheel at a third of its torque: the motion of a half turn is unstable, that of a whole turn runs."""
    drive = example("pto-flywheel")
    drive = replace(drive, duty=replace(drive.duty, torque=100.0))
    found = torsion_response(drive, speed=450.0 * rpm)
    assert found.floquet.verdict == Verdict.UNSTABLE
    assert found.floquet.kind == Kind.DOUBLING
    (longer,) = found.beside
    assert longer.periods == 2
    assert longer.reached
    assert longer.runs
    stand = loaded_model(drive, drive.duty, np.asarray(450.0 * rpm))[1]
    place, torque = shaken(stand, 450.0 * rpm, -0.01, 100.0, 160)
    assert abs(place[-1] - place[-3]) < 1e-4 < 1e-2 < abs(place[-1] - place[-2])
    np.testing.assert_allclose([longer.lowest[0], longer.highest[0]], [torque.min(), torque.max()], rtol=2e-3)
    assert (found.torque_lowest[0], found.torque_highest[0]) == (longer.lowest[0], longer.highest[0])
    counted = dynamic_torque(drive, speed=[450.0 * rpm])
    assert counted.low[0, 1] == pytest.approx(torque.min(), rel=2e-3)
    said = answer(drive, found)
    assert "but every 2 periods" in told_text(said.sentence, USUAL)
    assert [one["periods"] for one in data(said, USUAL)["other_motions"]] == [2]


@pytest.mark.slow
def test_motions_of_several_periods_that_take_a_blow_are_told_and_do_not_count() -> None:
    drive = example("pto-flywheel")
    found = torsion_response(drive)
    assert found.floquet.verdict == Verdict.STABLE
    assert [one for one in found.beside if one.periods != 1]
    assert not any(one.runs or one.reached for one in found.beside)
    assert found.torque_lowest[0] > 0.0
    assert min(float(one.lowest[0]) for one in found.beside) < 0.0
    (longer,) = further(drive, found)
    assert "where a slow run-up or run-down leads to it, else it takes a blow" in longer
    dark = replace(found, beside=tuple(replace(one, reached=None) for one in found.beside))
    (longer,) = further(drive, dark)
    assert "it is not known to which motion a slow run-up or run-down leads" in longer
    assert "blow" not in longer


@pytest.mark.slow
def test_speeds_at_which_no_ramp_is_known_are_named() -> None:
    drive = example("pto-flywheel")
    found = torsion_response(drive, speed=np.asarray([535.0, 540.0]) * rpm)
    assert {one.row for one in found.beside} == {0, 1}
    dark = replace(found, beside=tuple(replace(one, reached=None if one.row else False) for one in found.beside))
    (longer,) = further(drive, dark)
    assert "else it takes a blow or an abrupt start; at 540 rpm it is not known to which motion" in longer
