"""Growth of disturbances under joints and an order that does not repeat with them, against integration in time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan.maths.periodic.floquet import monodromy
from cardan.questions.torsion.model.inputs import Falling, Swinging
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.steady.run_stability import Verdict, floquet
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.two_frequencies import moving
from cardan.questions.torsion.steady.two_frequency_stability import coefficients_of, matrices_of, with_torques
from cardan.units import deg

JOINT, YOKE, LAST, SPRING, ORDER = 25 * deg, 0.01, 0.4, 1000.0, 3.315
ZONE, TWICE = 49.386, 29.8  # amid the principal zone of the only mode; where the order meets it twice


def grown(amplitude: float, speed: float, damper: float, start: Sequence[float], periods: int, off: float) -> float:
    """Return the growth rate [1/s] of the distance of two motions, by scipy and an equation written here.

    The input turns evenly; the spring leads to the driving yoke, angle q; behind the joint the last mass, on which a
    torque swings with its own angle. start: q and its speed at the beginning, at periods that are left out before.
    """
    cosine, square, tau = np.cos(JOINT), np.sin(JOINT) ** 2, np.tan(JOINT / 2) ** 2

    def rates(t: float, state: np.ndarray) -> list[float]:
        q, v = state
        below = 1.0 - square * np.cos(q) ** 2
        first, second = cosine / below, -cosine * square * np.sin(2.0 * q) / below**2
        turned = q + np.arctan2(tau * np.sin(2.0 * q), 1.0 - tau * np.cos(2.0 * q))
        torque = SPRING * (speed * t - q) + damper * (speed - v) + first * amplitude * np.sin(ORDER * turned)
        return [v, (torque - LAST * first * second * v**2) / (YOKE + LAST * first**2)]

    period = np.pi / speed
    ends = period * np.arange(periods + 1)
    way = {"method": "DOP853", "t_eval": ends, "rtol": 1e-12, "atol": 1e-13}
    one, other = (
        solve_ivp(rates, (0.0, ends[-1]), np.asarray(start) + np.asarray([0.0, more]), **way).y for more in (0.0, off)
    )
    apart = np.log(np.hypot(speed * (other[0] - one[0]), other[1] - one[1]))
    steps = np.diff(apart[12:]) / period  # the directions of growth are found by then
    share = (np.arange(len(steps)) + 0.5) / len(steps)
    return float(np.average(steps, weights=np.exp(-1.0 / (share * (1.0 - share)))))


def line(speed: float, damper: float, joint: float = JOINT) -> TorsionalModel:
    return torsional_line(
        [[1.0, YOKE], [LAST]],
        stiffness=[[SPRING], []],
        damping=[[damper], []],
        joint_angle=[joint],
        input_speed=speed,
    )


def swinging(amplitude: float, order: float = ORDER, station: int = 2) -> tuple[Torque, ...]:
    return (Torque(station=station, law=Swinging(amplitude=amplitude, frequency=order)),)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("amplitude", "speed", "damper", "verdict", "alone", "off"),
    [
        (240.0, ZONE, 3.0, Verdict.STABLE, Verdict.STABLE, 1e-2),  # dies out 7 % slower than without the order
        (240.0, ZONE, 0.2, Verdict.UNSTABLE, Verdict.UNSTABLE, 1e-6),
        (120.0, TWICE, 3.0, Verdict.UNSTABLE, Verdict.STABLE, 1e-6),  # the order alone makes it grow
    ],
)
def test_growth_is_that_of_two_neighbouring_motions(
    amplitude: float, speed: float, damper: float, verdict: Verdict, alone: Verdict, off: float
) -> None:
    steady = periodic_response(line(speed, damper))
    known = floquet(steady)
    found, exact = with_torques(steady.orbit, known, swinging(amplitude))
    assert exact.all()
    assert (known.verdict[()], found.verdict[()]) == (alone, verdict)
    motion = moving(steady.orbit, np.asarray([0]), ORDER, swinging(amplitude), 3, finer=3)
    x, v, _a = (float(one[0, 0, 0, 0]) for one in motion.torus.along(np.zeros(1), np.zeros(1)))
    start = (x, speed + float(motion.turning.frequency[0]) * v)
    assert float(found.growth_rate) == pytest.approx(grown(amplitude, speed, damper, start, 80, off), rel=0.01)
    assert abs(float(found.determinant_residual)) < 1e-9  # the sum of the exponents, by Liouville
    assert found.zone.by_torques == (verdict != alone)


def test_without_amplitude_it_is_that_of_the_joints() -> None:
    steady = periodic_response(line(ZONE, 3.0))
    known = floquet(steady)
    found, exact = with_torques(steady.orbit, known, swinging(1e-6))
    assert exact.all()
    assert found.multipliers == pytest.approx(known.multipliers, rel=1e-6)
    assert (found.kind, found.zone.name()) == (known.kind, known.zone.name())


@pytest.mark.parametrize("speed", [TWICE, -TWICE])
def test_an_order_that_does_repeat_is_judged_as_by_its_own_period(speed: float) -> None:
    """Order 3 repeats with a turn: Floquet multipliers of a turn, against exponents of half turns."""
    model, torque = line(speed, 3.0), swinging(180.0, 3.0)
    steady = periodic_response(model)
    found, exact = with_torques(steady.orbit, floquet(steady), torque)
    whole = floquet(periodic_response(replace(model, torques=torque)))
    assert exact.all()
    assert float(found.growth_rate) == pytest.approx(float(whole.growth_rate), rel=1e-3)
    assert np.abs(found.multipliers) ** 2 == pytest.approx(np.abs(whole.multipliers), rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("governed", [True, False])
def test_of_free_drives_the_shift_in_time_and_the_drift_are_left_out(governed: bool) -> None:
    load = Falling(standstill=0.0, slope=1.0) if governed else Falling(standstill=-40.0, slope=0.0)
    model = replace(line(TWICE, 3.0), input_speed=None, torques=(Torque(station=2, law=load),))
    torque = swinging(60.0, 3.5)  # repeats with two turns
    steady = periodic_response(model, speed=41.0)
    found, exact = with_torques(steady.orbit, floquet(steady), torque)
    whole = floquet(periodic_response(replace(model, torques=(*model.torques, *torque)), speed=41.0))
    assert exact.all()
    assert found.removed == whole.removed == (1 if governed else 2)
    assert float(found.growth_rate) == pytest.approx(float(whole.growth_rate), rel=1e-3)


def test_the_shift_in_time_of_a_free_drive_goes_on_as_the_motion_does() -> None:
    model = replace(
        line(TWICE, 3.0), input_speed=None, torques=(Torque(station=2, law=Falling(standstill=0.0, slope=1.0)),)
    )
    steady = periodic_response(model, speed=41.0)
    motion = moving(steady.orbit, np.asarray([0]), ORDER, swinging(60.0), 3, finer=3)
    theta = np.asarray([0.3])
    matrix = monodromy(coefficients_of(motion, np.asarray([0]), theta), np.asarray([np.pi / 41.0]))[0]
    ends = []
    for at in (theta, theta + 2.0 * np.pi * motion.ratio):
        _x, v, a = (one[0, 0, 0] for one in motion.torus.along(np.zeros(1), at))
        rate = float(motion.turning.frequency[0])
        ends.append(np.concatenate([41.0 + rate * v, rate**2 * a]))
    assert matrix @ ends[0] == pytest.approx(ends[1], rel=1e-4, abs=1e-4 * float(np.max(np.abs(ends[1]))))
    assert matrices_of(motion, np.asarray([0]), theta)[0].shape[-1] == len(matrix) - 1


def test_what_is_not_known_stays_as_it_is_without_these_orders() -> None:
    steady = periodic_response(line(ZONE, 3.0))
    known = floquet(steady)
    several = (*swinging(60.0), *swinging(60.0, 2.718))
    for torques in (several, ()):
        found, exact = with_torques(steady.orbit, known, torques)
        assert found is known
        assert not exact.any()
