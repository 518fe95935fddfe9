"""Torsion along a movement against equations written apart: one joint, α(t) of a lifted output, a disc on a spring.

The input turns evenly and the joint has no mass, so the driven yoke does F = T(Ωt; α) whatever the disc does, and the
torque of the spring is that of a linear system: exact by the series T = θ + Σ τ^k/k sin 2kθ, or integrated with α(t).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.stats import norm

from cardan.answers.quantity import told
from cardan.answers.reader import USUAL
from cardan.drive.drive import Drive
from cardan.drive.duty import Duty
from cardan.drive.duty import Harmonic as Wave
from cardan.drive.movement import Harmonic, Movement, Random, Spectrum, Table
from cardan.drive.shaft import Shaft
from cardan.drive.station import Absorber, Station
from cardan.errors import InputError
from cardan.questions.motion.standing import still
from cardan.questions.torsion.road.answer import answer
from cardan.questions.torsion.road.places import Standing, sign_changes
from cardan.questions.torsion.road.road import RoadTorsion, road_torsion, standing_torques
from cardan.questions.torsion.steady.torsion_response import torsion_response

STIFFNESS, DAMPING, INERTIA, LOAD, LIFT = 4000.0, 4.0, 0.4, 100.0, 0.1


def lifted(movement: Movement, speed: float = 200.0, load: float = LOAD, damping: float = DAMPING) -> Drive:
    """Return the drive: a spring behind the joint, its output 0.1 m up on a length of 1 m and moved up and down."""
    return replace(
        Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1, 0, LIFT)]),
        movements=(movement,),
        shafts=(Shaft(number=2, stiffness=STIFFNESS, damping=damping),),
        stations=(Station(shaft=2, inertia=INERTIA),),
        duty=Duty(speed=speed, torque=load),
    )


def swing(size: float, rate: float) -> Harmonic:
    return Harmonic(moves=("output",), amplitude=(0.0, 0.0, size), frequency=rate)


WAVES = np.exp(2j * np.outer(np.linspace(0.0, math.pi, 2001), np.arange(1, 21)))
"""Orders 2, 4, … 40 over half a turn."""


def orders(joint_angle: float, speed: float, damping: float = DAMPING) -> np.ndarray:
    """Return the amplitudes of orders 2, 4, … 40 of the spring, complex: a linear system driven by τ^k/k sin 2kΩt."""
    tau, k = math.tan(0.5 * joint_angle) ** 2, np.arange(1, 21)
    omega = 2.0 * k * speed
    spring = STIFFNESS + 1j * omega * damping
    found: np.ndarray = -1j * tau**k / k * spring * (-(omega**2) * INERTIA) / (spring - omega**2 * INERTIA)
    return found


def course(joint_angle: float, speed: float, damping: float = DAMPING) -> np.ndarray:
    """Return the torque of the spring over half a turn."""
    found: np.ndarray = LOAD + (WAVES @ orders(joint_angle, speed, damping)).real
    return found


def integrated(drive: Drive, rate: float, size: float, times: np.ndarray, settle: float) -> np.ndarray:
    """Return the torque of the spring at times, from SciPy with α(t) and all that it moves."""
    speed = drive.duty.speed or 0.0

    def yoke(time: float) -> tuple[float, float]:
        lift, lift_rate = LIFT + size * math.sin(rate * time), size * rate * math.cos(rate * time)
        alpha, turn = math.atan(lift), lift_rate / (1.0 + lift**2)
        theta = speed * time
        tau = math.tan(0.5 * alpha) ** 2
        inner = 1.0 - 2.0 * tau * math.cos(2.0 * theta) + tau**2
        angle = theta + math.atan2(tau * math.sin(2.0 * theta), 1.0 - tau * math.cos(2.0 * theta))
        by_tau = math.sin(2.0 * theta) / inner
        by_angle = math.cos(alpha) / (1.0 - math.sin(alpha) ** 2 * math.cos(theta) ** 2)
        tau_rate = math.tan(0.5 * alpha) / math.cos(0.5 * alpha) ** 2 * turn
        return angle, by_angle * speed + by_tau * tau_rate

    def torque(time: float, state: np.ndarray) -> float:
        angle, turning = yoke(time)
        return STIFFNESS * (angle - state[0]) + DAMPING * (turning - state[1])

    def slopes(time: float, state: np.ndarray) -> list[float]:
        return [state[1], (torque(time, state) - LOAD) / INERTIA]

    begin = float(times[0]) - settle
    start = [speed * begin - LOAD / STIFFNESS, speed]
    done = solve_ivp(slopes, (begin, times[-1]), start, method="DOP853", t_eval=times, rtol=1e-9, atol=1e-10)
    return np.asarray([torque(time, state) for time, state in zip(times, done.y.T, strict=True)])


@pytest.fixture(scope="module")
def slow() -> RoadTorsion:
    return road_torsion(lifted(swing(0.2, 1.0)))


def test_every_instant_is_the_exact_motion_there(slow: RoadTorsion) -> None:
    assert slow.moving is None
    assert slow.lag.share < 0.01
    places = slow.standing
    assert places.times is not None
    for k in (0, 40, 90, 200, 300):
        angle = math.atan(LIFT + 0.2 * math.sin(places.times[k]))
        torque = course(angle, 200.0)
        assert places.low[k, 0] == pytest.approx(np.min(torque), rel=1e-5)
        assert places.high[k, 0] == pytest.approx(np.max(torque), rel=1e-5)
        assert places.mean[k, 0] == pytest.approx(LOAD, rel=1e-6)
        np.testing.assert_allclose(places.amplitude[k, 0], np.abs(orders(angle, 200.0))[:4], rtol=1e-4, atol=1e-5)
    peak = np.max(course(math.atan(LIFT + 0.2), 200.0))
    assert slow.peak == (pytest.approx(peak, rel=1e-5), 0, pytest.approx(0.5 * math.pi, abs=1e-4))


def test_order_two_grows_with_the_square_of_the_joint_angle(slow: RoadTorsion) -> None:
    """By hand: τ |c + 2iΩb| ν²/(ν² - 1), τ = tan²(α/2) ≈ α²/4, ν = 2Ω/ω; far above ω the damper moves no mass."""
    places = slow.standing
    assert places.amplitude is not None
    alpha, second = places.joint_angle[:, 0], places.amplitude[:, 0, 0]
    k = [k for k in range(len(alpha)) if alpha[k] > 0.02]
    ratio = second[k] / alpha[k] ** 2
    np.testing.assert_allclose(ratio, ratio[0], rtol=0.03)
    nu = 2.0 * 200.0 / math.sqrt(STIFFNESS / INERTIA)
    spring = abs(STIFFNESS + 400j * DAMPING)
    assert second[90] == pytest.approx(0.25 * alpha[90] ** 2 * spring * nu**2 / (nu**2 - 1.0), rel=0.03)


def test_a_slow_movement_is_that_of_the_integration(slow: RoadTorsion) -> None:
    """The whole second about the worst instant, by SciPy with α(t): its highest torque in every half turn."""
    times = np.arange(1.0, 2.0, math.pi / 200.0 / 64.0)
    torque = integrated(lifted(swing(0.2, 1.0)), 1.0, 0.2, times, 3.0)
    tops = np.max(torque[: len(times) // 64 * 64].reshape(-1, 64), axis=-1)
    middle = times[32::64][: len(tops)]
    assert slow.standing.times is not None
    np.testing.assert_allclose(np.interp(middle, slow.standing.times, slow.standing.high[:, 0]), tops, rtol=0.01)


QUICK = lifted(swing(0.2, 12.0), speed=52.0)
"""Order 2 at 104 rad/s near ω = 100, which dies out at 5 1/s: it lags behind a movement of 12 rad/s."""


@pytest.fixture(scope="module")
def quick() -> RoadTorsion:
    return road_torsion(QUICK)


@pytest.mark.slow
def test_a_quick_movement_is_followed_in_time(quick: RoadTorsion) -> None:
    assert quick.lag.share > 1.0
    assert not quick.why
    assert quick.moving is not None
    assert quick.moving.times is not None
    window = math.pi / 52.0
    count = len(quick.moving.times)
    times = quick.moving.times[0] + (np.arange(64 * count + 1) / 64.0 - 0.5) * window
    whole = integrated(QUICK, 12.0, 0.2, times, 4.0)
    torque = np.stack([whole[64 * k : 64 * k + 65] for k in range(count)])
    np.testing.assert_allclose(quick.moving.high[:, 0], np.max(torque, axis=-1), rtol=0.02, atol=2.0)
    np.testing.assert_allclose(quick.moving.low[:, 0], np.min(torque, axis=-1), rtol=0.02, atol=2.0)
    assert quick.peak[0] == pytest.approx(np.max(np.abs(torque)), rel=0.01)
    standing = float(np.max(quick.standing.high))
    assert not 0.9 < quick.peak[0] / standing < 1.1  # the movement is too quick for the resonance to follow


@pytest.mark.slow
def test_resonance_is_a_share_of_the_time(quick: RoadTorsion, slow: RoadTorsion) -> None:
    """Far from the mode it never is; near it where the integrated torque is above twice the mean, or order 2 strong."""
    assert slow.resonance == 0.0
    assert quick.meets[0][:2] == (2.0, 1)
    standing = road_torsion(lifted(swing(0.2, 0.05), speed=58.0))
    lifts = LIFT + 0.2 * np.sin(np.linspace(0.0, 2.0 * math.pi, 4001))
    angles = np.arctan(np.abs(lifts))
    strong = np.asarray([abs(orders(one, 58.0)[0]) >= 0.2 * LOAD for one in angles])
    assert standing.resonance == pytest.approx(np.mean(strong), abs=0.004)
    assert 0.3 < standing.resonance < 0.95


def test_reversals_are_counted() -> None:
    """Four a turn where the alternating torque is above the mean, and two stretches a swing through both sides."""
    found = road_torsion(lifted(swing(0.3, 0.05), speed=58.0))
    assert found.moving is None
    angle = np.arctan(np.abs(LIFT + 0.3 * np.sin(np.linspace(0.0, 2.0 * math.pi, 2001))))
    turning = np.asarray([sign_changes(course(one, 58.0)) for one in angle[::4]])
    assert found.reversals[0] == pytest.approx(np.mean(turning) * 58.0 / math.pi, rel=0.02)
    inside = np.asarray([np.min(course(one, 58.0)) < 0.0 for one in angle])
    begins = int(np.sum(inside[1:] & ~inside[:-1]))
    assert begins >= 1
    assert found.entries[0] == pytest.approx(begins * 0.05 / (2.0 * math.pi), rel=1e-9)


def random_lift(deviation: float) -> Random:
    flat = Spectrum(frequency=(0.02, 0.08), density=(1.0, 1.0))
    return Random(moves=("output",), axis=(0.0, 0.0, 1.0), deviation=deviation, spectrum=flat, duration=6000.0)


def test_random_movements_by_rice() -> None:
    """The least torque falls with |α| alone: it passes 0 where z does a level, by Rice ν = (Ω/2π) e^(-z²/2)."""
    deviation = 0.08
    found = road_torsion(lifted(random_lift(deviation), speed=58.0))
    assert found.chance is not None
    assert found.moving is None
    turns = brentq(lambda angle: float(np.min(course(angle, 58.0))), 0.01, 1.0)
    ends = [(sign * math.tan(turns) - LIFT) / deviation for sign in (1.0, -1.0)]
    rate = math.sqrt((0.08**3 - 0.02**3) / 3.0 / (0.08 - 0.02))
    expected = sum(rate / (2.0 * math.pi) * math.exp(-0.5 * end**2) for end in ends)
    assert found.entries[0] == pytest.approx(expected, rel=2e-3)
    inside = norm.cdf(-ends[0]) + norm.cdf(ends[1])
    places = found.standing
    assert places.part(places.low[:, 0] < 0.0) == pytest.approx(inside, rel=0.02)
    level = math.sqrt(2.0 * math.log(rate / (2.0 * math.pi) * found.span))  # of z once in the span, one side alone
    far = course(math.atan(LIFT + deviation * level), 58.0)
    assert found.peak[0] == pytest.approx(np.max(far), rel=2e-3)
    wave = np.fft.rfft(far[:-1] if np.isclose(far[0], far[-1]) else far)
    second = found.order.tolist().index(2.0)
    assert found.envelope[0, second] == pytest.approx(2.0 * np.max(np.abs(wave[1:])) / len(far), rel=1e-2)
    least, largest = found.extremes
    assert (least[0], largest[0]) == pytest.approx((np.min(far), np.max(far)), rel=4e-3)


def half_turn(
    joint_angle: float, state: np.ndarray, speed: float, spring: tuple[float, float], load: float
) -> np.ndarray:
    """Return x = q - Ωt and its rate half a turn later: a spring before the joint, the disc behind it."""
    c, b = spring

    def slopes(time: float, y: np.ndarray) -> list[float]:
        q, rate = speed * time + y[0], speed + y[1]
        below = 1.0 - math.sin(joint_angle) ** 2 * math.cos(q) ** 2
        first = math.cos(joint_angle) / below
        second = -math.cos(joint_angle) * math.sin(joint_angle) ** 2 * math.sin(2.0 * q) / below**2
        force = -c * y[0] - b * y[1] - first * load - INERTIA * first * second * rate**2
        return [y[1], force / (INERTIA * first**2)]

    return solve_ivp(slopes, (0.0, math.pi / speed), state, method="DOP853", rtol=1e-10, atol=1e-12).y[:, -1]


def largest_multiplier(joint_angle: float, speed: float, spring: tuple[float, float], load: float) -> float:
    """Return the largest modulus of the multipliers: Newton on the map of half a turn, its slopes by differences."""
    state = np.asarray([-load / spring[0], 0.0])
    for _round in range(8):
        end = half_turn(joint_angle, state, speed, spring, load)
        steps = 1e-6 * np.eye(2)
        slope = np.stack(
            [(half_turn(joint_angle, state + h, speed, spring, load) - end) / 1e-6 for h in steps], axis=-1
        )
        state = state - np.linalg.solve(slope - np.eye(2), end - state)
    return float(np.max(np.abs(np.linalg.eigvals(slope))))


DAMPER = 1.3
"""Of the spring before the joint, so that vibration dies out over the whole movement."""


@pytest.fixture(scope="module")
def growing() -> RoadTorsion:
    drive = replace(
        Drive.from_points([(-0.3, 0, 0), (0, 0, 0), (1, 0, 0.3)]),
        movements=(swing(0.3, 0.2),),
        shafts=(Shaft(number=1, stiffness=1000.0, damping=DAMPER),),
        stations=(Station(shaft=2, inertia=INERTIA),),
        duty=Duty(speed=50.0, torque=20.0),
    )
    return road_torsion(drive)


@pytest.mark.slow
def test_unstable_share_and_growth(growing: RoadTorsion) -> None:
    """Parametric resonance near Ω = ω from the joint angle on at which a multiplier passes 1."""
    edge = brentq(lambda a: largest_multiplier(a, 50.0, (1000.0, DAMPER), 20.0) - 1.0, 0.1, 0.5, xtol=1e-4)
    angle = np.arctan(0.3 + 0.3 * np.sin(np.linspace(0.0, 2.0 * math.pi, 20001)))
    share = float(np.mean(angle > edge))
    assert 0.1 < share < 0.7
    assert growing.unstable == pytest.approx(share, abs=0.004)
    at = np.linspace(edge, math.atan(0.6), 5)
    rates = [math.log(largest_multiplier(a, 50.0, (1000.0, DAMPER), 20.0)) * 50.0 / math.pi for a in at]
    places = growing.standing
    assert places.growth is not None
    for one, rate in zip(at[1:], rates[1:], strict=True):
        k = int(np.argmin(np.abs(places.joint_angle[:, 0] - one)))
        assert places.growth[k] == pytest.approx(rate, abs=0.05)
    assert growing.mean_growth < 0.0
    rows = places.growth > 0.0
    assert places.times is not None
    assert growing.grown == pytest.approx(np.sum(places.growth[rows]) * (places.times[1] - places.times[0]), rel=0.01)


def test_what_cannot_be_told_is_refused() -> None:
    with pytest.raises(InputError, match="movement"):
        road_torsion(replace(QUICK, movements=()))
    with pytest.raises(InputError, match="speed"):
        road_torsion(replace(QUICK, duty=Duty(torque=100.0)))


def test_a_table_is_followed_from_its_first_row() -> None:
    rows = np.linspace(0.0, 12.0, 49)
    table = Table(
        moves=("output",),
        file="rise.csv",
        times=tuple(rows.tolist()),
        shifts=tuple((0.0, 0.0, 0.2 * math.sin(0.5 * time)) for time in rows.tolist()),
    )
    found, wave = road_torsion(lifted(table)), road_torsion(lifted(swing(0.2, 0.5)))
    assert not found.periodic
    assert found.span == pytest.approx(12.0)
    assert found.peak[0] == pytest.approx(wave.peak[0], rel=1e-3)


def test_orders_that_do_not_repeat_count_to_first_order() -> None:
    """Against the exact motion of both frequencies at two instants: within a hundredth of the largest torque."""
    plain = lifted(swing(0.2, 1.0), speed=120.0)
    drive = replace(plain, duty=replace(plain.duty, harmonics=(Wave(order=3.315, torque=40.0),)))
    found = road_torsion(drive)
    places = found.standing
    assert places.times is not None
    for k in (10, 90):
        exact = torsion_response(still(drive, float(places.times[k])))
        assert places.high[k, 0] == pytest.approx(float(exact.torque_highest[0]), rel=0.01)
        assert places.low[k, 0] == pytest.approx(float(exact.torque_lowest[0]), abs=0.01 * places.high[k, 0])
        assert places.high[k, 0] > 2.0 + road_torsion(plain).standing.high[k, 0]


@pytest.mark.slow
def test_play_opens_where_the_torque_falls_through_zero() -> None:
    """At the instant of the largest torque, against a mass behind a gap integrated in time until it repeats."""
    speed, half = 70.0, 0.002
    drive = lifted(swing(0.06, 0.05), speed=speed, load=8.0)
    loose = replace(drive, joints=(replace(drive.joints[0], backlash=2.0 * half),))
    found = road_torsion(loose)
    assert found.opened is not None
    assert road_torsion(drive).opened is None
    k = int(np.argmax(np.max(found.opened.largest, axis=-1)))
    alpha = float(found.standing.joint_angle[found.opened.row[k], 0])
    tau = math.tan(0.5 * alpha) ** 2

    def rates(time: float, state: np.ndarray) -> list[float]:
        theta = speed * time
        yoke = theta + math.atan2(tau * math.sin(2.0 * theta), 1.0 - tau * math.cos(2.0 * theta))
        turn = speed * math.cos(alpha) / (1.0 - (math.sin(alpha) * math.cos(theta)) ** 2)
        twist = yoke - state[0]
        over = math.copysign(max(abs(twist) - half, 0.0), twist)
        torque = STIFFNESS * over + (DAMPING * (turn - state[1]) if over else 0.0)
        return [state[1], (torque - 8.0) / INERTIA]

    begin, end = 400 * math.pi / speed, 402 * math.pi / speed
    times = np.linspace(begin, end, 2001)
    path = solve_ivp(rates, (0.0, end), [0.0, speed], t_eval=times, rtol=1e-9, atol=1e-11, max_step=2e-3).y
    theta = speed * times
    yoke = theta + np.arctan2(tau * np.sin(2.0 * theta), 1.0 - tau * np.cos(2.0 * theta))
    assert found.opened.high[k, 0] == pytest.approx(STIFFNESS * (np.max(yoke - path[0]) - half), rel=0.01)


@pytest.mark.slow
def test_steep_random_movements_are_bounded_and_say_what_is_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """120 mm over a stub shaft of 150 mm: from 72° on nothing runs steadily, and no ray is asked far beyond that."""
    asked: list[int] = []
    at = Standing.at

    def counted(self, points, progress=None):
        found = at(self, points, progress)
        asked.append(int(np.sum(~found.found)))
        return found

    monkeypatch.setattr(Standing, "at", counted)
    drive = replace(
        Drive.from_points([(-0.15, 0, 0), (0, 0, 0), (0.6, 0, 0.05), (0.75, 0, 0.05)]),
        shafts=(Shaft(number=2, stiffness=4000.0, damping=4.0),),
        stations=(Station(shaft=1, inertia=0.5), Station(shaft=3, inertia=0.4)),
        duty=Duty(speed=100.0, torque=100.0),
        movements=(random_lift(0.12),),
    )
    shares: list[float] = []
    found = road_torsion(drive, progress=shares.append)
    assert 12 <= sum(asked) <= 3 * 64
    assert len(shares) > 10
    assert shares == sorted(shares)
    places = found.standing
    lost = 1.0 - float(np.sum(places.share[places.found]))
    assert 1e-4 < lost < 1e-2
    said = [told(one.text, USUAL) for one in answer(drive, found).remarks]
    assert any("no steady motion was found in" in one for one in said)


def test_torques_by_which_checks_find_instants_are_those_of_the_road():
    """They are asked without whether the motions are stable, for hundreds of variants of a drive."""
    drive = lifted(swing(0.05, 1.0))
    road = road_torsion(drive).standing
    found = standing_torques(drive, road.times)
    assert np.ptp(found, axis=1).max() > 1.0
    np.testing.assert_allclose(found, np.concatenate([road.high, -road.low], axis=-1).T, rtol=1e-8, atol=1e-6)


def test_a_line_on_which_but_an_absorber_swings_has_nothing_to_follow() -> None:
    """Its shafts are rigid: it is refused, as in time, with what to give."""
    hung = Station(shaft=2, inertia=INERTIA, absorber=Absorber(inertia=0.05, stiffness=2000.0, damping=1.0))
    rigid = replace(lifted(swing(0.05, 1.0)), shafts=(), stations=(hung,))
    with pytest.raises(InputError, match="every shaft counts as rigid"):
        road_torsion(rigid)
