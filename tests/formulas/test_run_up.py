"""Run-ups: direct integration with SciPy, limits, and peaks that a fine sweep cannot beat."""

import math
from itertools import pairwise

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import InputError
from cardan.formulas import run_up as behind
from cardan.formulas import run_up as sweep
from cardan.formulas.run_up import joint_run_up, run_up
from cardan.maths.periodic.oscillator import chirp
from cardan.units import deg


@pytest.mark.slow
@pytest.mark.parametrize(
    ("omega", "zeta", "rate", "end"),
    [
        (20.0, 0.02, 8.0, 6.0),
        (20.0, 0.02, 8.0, 1.0),
        (20.0, 0.02, 8.0, 2.6),
        (20.0, 0.3, 8.0, 6.0),
        (20.0, 0.8, 8.0, 6.0),
        (20.0, 0.99999, 8.0, 6.0),
        (20.0, 0.05, 4000.0, 2.0),
        (20.0, 0.05, 1e6, 2.0),
        (30.0, 0.1, 0.05, 900.0),
        (30.0, 0.01, 0.05, 900.0),
    ],
)
def test_no_instant_of_a_fine_sweep_is_higher_than_the_peak(omega, zeta, rate, end):
    found = run_up(omega, zeta, rate, end)
    times = np.linspace(0.0, end, 400_001)
    curve = np.abs(chirp(times, omega, zeta, rate)[0].real)
    at = int(np.argmax(curve))
    fastest = max(omega, min(rate * times[at], 50 * omega))
    miss = 0.125 * (fastest * times[1]) ** 2
    assert curve[at] <= found.peak * (1 + 1e-12)
    assert curve[at] == pytest.approx(found.peak, rel=miss + 1e-9)
    if end < 10.0:  # about slow resonances many swings are all but equally high
        assert found.peak_time == pytest.approx(times[at], abs=2 * times[1])
    assert found.residual < 1e-10


def test_slow_runs_come_to_the_steady_peak_fast_ones_stay_below():
    peaks = [run_up(20.0, 0.02, rate, 3 * 20.0 / rate).peak for rate in (0.001, 0.1, 1.0, 10.0, 100.0)]
    assert peaks[0] == pytest.approx(run_up(20.0, 0.02, 0.001, 1.0).steady_peak, rel=1e-3)
    assert all(one > other for one, other in pairwise(peaks))
    late = run_up(20.0, 0.02, 1.0, 60.0)
    assert late.peak_time > late.passing_time


def test_the_window_of_a_slow_run_holds_its_peak(monkeypatch):
    windowed = run_up(60.0, 0.05, 0.3, 400.0)
    monkeypatch.setattr(sweep, "_windows", lambda omega, zeta, rate, end: [(0.0, end)])
    assert run_up(60.0, 0.05, 0.3, 400.0).peak == pytest.approx(windowed.peak, rel=1e-13)


def test_an_endless_run_is_not_checked_step_by_step_and_still_found():
    found = run_up(60.0, 0.01, 1e-3, 1e5)
    assert math.isnan(found.residual)
    assert found.peak == pytest.approx(found.steady_peak, rel=1e-4)


def test_a_search_can_be_stopped():
    told = []

    def progress(share):
        told.append(share)
        return "stop"

    found = run_up(60.0, 0.3, 0.02, 1e4, progress=progress)
    assert found.cancelled
    assert len(told) == 1
    assert found.peak > 0.5


def integrated(joint_angle, stiffness, inertia, acceleration, end, damping, times):
    """Return the torque at some times from the absolute angle of the driven inertia, by DOP853."""
    cosine, square = math.cos(joint_angle), math.sin(joint_angle) ** 2

    def joint(t):
        theta = 0.5 * acceleration * t * t
        half_turns = math.floor(theta / math.pi + 0.5)
        inside = theta - math.pi * half_turns
        angle = math.pi * half_turns + math.atan2(math.sin(inside), cosine * math.cos(inside))
        return angle, cosine / (1 - square * math.cos(theta) ** 2) * acceleration * t

    def torque(t, y):
        angle, speed = joint(t)
        return stiffness * (angle - y[0]) + damping * (speed - y[1])

    found = solve_ivp(
        lambda t, y: [y[1], torque(t, y) / inertia],
        (0.0, end),
        [0.0, 0.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
        t_eval=times,
    )
    return np.asarray([torque(t, y) for t, y in zip(times, found.y.T, strict=True)])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("joint_angle", "acceleration", "damping"), [(20, 20.0, 0.5), (45, 60.0, 0.0), (0, 20.0, 0.5), (20, 20.0, 90.0)]
)
def test_the_torque_behind_a_joint_agrees_with_direct_integration(joint_angle, acceleration, damping):
    end = 2.2
    times = np.linspace(0.0, end, 301)
    wanted = integrated(joint_angle * deg, 2000.0, 0.5, acceleration, end, damping, times)
    found = joint_run_up(joint_angle * deg, 2000.0, 0.5, acceleration, end, damping=damping, time=times)
    np.testing.assert_array_equal(found.time, times)
    # Integration leaves 1e-11 of angles up to 150 rad, times the stiffness.
    np.testing.assert_allclose(found.torque, wanted, atol=1e-5)
    assert found.residual < 1e-12
    assert found.peak_torque >= np.abs(wanted).max() - 1e-5
    np.testing.assert_allclose(
        np.gradient(found.twist, times)[5:-5] * damping + found.twist[5:-5] * 2000.0,
        found.torque[5:-5],
        atol=0.01 * found.peak_torque + 2.0 * damping,
    )


def test_steep_joints_and_critical_damping_are_followed_too():
    for joint_angle, damping in ((80, 0.5), (89, 0.5), (20, 700.0)):
        assert joint_run_up(joint_angle * deg, 2000.0, 0.5, 20.0, 2.0, damping=damping).residual < 1e-11
    # At ζ = 1 the closed form that checks stands 1e-8 beside it.
    assert joint_run_up(20 * deg, 2000.0, 0.5, 20.0, 2.0, damping=2 * math.sqrt(1000.0)).residual < 1e-7


@pytest.mark.slow
def test_the_slower_the_run_the_higher_the_torque_up_to_the_steady_one():
    runs = [joint_run_up(20 * deg, 2000.0, 0.5, a, 2.2 * 31.6 / a, damping=1.0) for a in (0.05, 5.0, 50.0)]
    peaks = [one.peak_torque for one in runs]
    assert peaks[0] > peaks[1] > peaks[2]
    # Order 4 and the slow part stand beside order 2: some per cent.
    assert peaks[0] == pytest.approx(runs[0].steady_torque, rel=0.03)
    assert all(one.peak_speed > one.order2_speed for one in runs)


def test_without_damping_or_bend():
    assert joint_run_up(20 * deg, 2000.0, 0.5, 20.0, 1.0).steady_torque == math.inf
    straight = joint_run_up(0.0, 2000.0, 0.5, 20.0, 1.0)
    assert straight.steady_torque == 0.0
    # A sudden acceleration doubles the steady torque J a.
    assert straight.peak_torque == pytest.approx(2 * 0.5 * 20.0, rel=1e-9)


def test_a_run_behind_a_joint_can_be_stopped():
    found = joint_run_up(20 * deg, 2000.0, 0.5, 0.5, 300.0, progress=lambda share: "stop" if share > 0.2 else None)
    assert found.cancelled
    assert 60.0 < found.time[-1] < 300.0


@pytest.mark.parametrize(
    ("ask", "named"),
    [
        (lambda: run_up(0.0, 1.0, -1.0, 0.0), ["natural_frequency", "acceleration", "end", "damping_ratio"]),
        (lambda: run_up(1.0, 0.1, 1.0, 1.0, time=[-1.0]), ["time"]),
        (lambda: joint_run_up(0.5 * math.pi, 1.0, 1.0, 1.0, 1.0, damping=-1.0), ["joint_angle", "damping"]),
        (lambda: joint_run_up(0.1, 0.0, 0.0, 0.0, math.inf), ["stiffness", "inertia", "acceleration", "end"]),
        (lambda: joint_run_up(0.1, 1.0, 1.0, 1.0, 1.0, time=[0.5, 2.0]), ["time"]),
        (lambda: joint_run_up(0.1, 1.0, 1.0, 1.0, 1e5), ["end"]),
        (lambda: run_up(1e5, 0.5, 1e-3, 1e9), ["end"]),
    ],
)
def test_what_makes_no_run_is_named(ask, named):
    with pytest.raises(InputError) as caught:
        ask()
    assert [problem.field for problem in caught.value.problems] == named
    assert behind.STEPS == sweep.STEPS
