"""Drift of the mean speed against growth of vibration, by equations written apart and integrated in time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cardan import example, stability, torsion_response
from cardan.maths.compiled.method import Compiled, Plain
from cardan.questions.torsion.stability.floquet_map import floquet_map
from cardan.questions.torsion.stability.proved_speeds import proved_speeds
from cardan.questions.torsion.stability.stability_kernel import vibration_growth
from cardan.questions.torsion.steady.run_stability import Verdict, drift_of, floquet, vibrating
from cardan.questions.torsion.steady.steady import periodic_response, steady_orbits
from cardan.questions.torsion.steady.torsion_response import loaded_model, parted
from cardan.units import deg, rpm

FIRST, LAST, SOFT, STUB, DAMPER, LOAD, JOINT = 0.9, 0.4, 6000.0, 60000.0, 0.5, 60.0, 18 * deg
"""Of the shipped test stand: motor, brake, coupling before the joint, stub behind it."""


def stand(speed):
    """Return the stand with its motion at a speed [rpm]."""
    drive = example("unstable-drive")
    return drive, torsion_response(drive, speed=speed * rpm)


def in_time(found, governor, span, push):
    """Return times, mean speed over the steady one, and torque before the joint, of the stand from its steady motion.

    governor [N·m·s/rad]: torque on the motor against what the turning of both masses, weighed, is off the mean speed;
    it does not feel vibration of the straight line. push [rad/s]: on the motor at the beginning.
    """
    omega, phase = float(found.speed), float(found.train.model.phase[0])
    tau, cosine, square = np.tan(JOINT / 2) ** 2, np.cos(JOINT), np.sin(JOINT) ** 2

    def law(angle):
        turned = angle + np.arctan2(tau * np.sin(2 * angle), 1 - tau * np.cos(2 * angle))
        return turned, cosine / (1 - square * np.cos(angle) ** 2)

    start, mean = law(phase)[0], float(found.steady.orbit.force)

    def rates(_time, state):
        q1, v1, q2, q3, v3 = state
        turned, slope = law(q2 + phase)
        turned -= start
        yoke = (SOFT * (q1 - q2) + DAMPER * v1 - slope * (STUB * (turned - q3) - DAMPER * v3)) / (
            DAMPER * (1 + slope**2)
        )
        before = SOFT * (q1 - q2) + DAMPER * (v1 - yoke)
        behind = STUB * (turned - q3) + DAMPER * (slope * yoke - v3)
        held = mean - governor * (FIRST * v1 + LAST * v3 - (FIRST + LAST) * omega)
        return [v1, (held - before) / FIRST, yoke, v3, (behind - LOAD) / LAST]

    q, rate, _acceleration = (one[0] for one in found.steady.orbit.at([0.0]))
    state = [q[0], rate[0] + push, q[1], q[2], rate[2]]
    times = np.linspace(0.0, span, round(4000 * span))
    way = solve_ivp(rates, (0.0, span), state, "LSODA", times, rtol=1e-9, atol=1e-10)
    q1, v1, q2, _q3, v3 = way.y
    return times, (FIRST * v1 + LAST * v3) / ((FIRST + LAST) * omega), SOFT * (q1 - q2)


@pytest.mark.slow
@pytest.mark.parametrize("speed", [680.0, 690.0])
def test_above_a_resonance_the_mean_speed_runs_away_and_vibration_does_not(speed):
    """Under a constant torque it runs up, at the rate of the multiplier that is left out; governed, nothing grows."""
    drive, found = stand(speed)
    assert found.floquet.stable
    told = replace(drive, stations=(replace(drive.stations[0], ground_damping=1e-9), drive.stations[1]))
    drift = torsion_response(told, speed=speed * rpm).floquet.multipliers[0]
    assert drift.imag == 0.0
    assert drift.real > 1.3
    times, mean, _torque = in_time(found, 0.0, 0.6, 1e-4)
    period = np.pi / (speed * rpm)
    ends = period * np.arange(4, 10)
    off = np.interp(ends, times, mean) - np.interp(ends, times, in_time(found, 0.0, 0.6, 0.0)[1])
    assert (off[-1] / off[0]) ** 0.2 == pytest.approx(drift.real, rel=0.02)
    _times, mean, torque = in_time(found, 200.0, 3.0, 1e-3)
    late = slice(-2000, None)
    assert abs(np.mean(mean[late]) - 1.0) < 1e-3
    assert 0.5 * np.ptp(torque[late]) == pytest.approx(float(found.swing[0]), rel=0.08)


@pytest.mark.slow
def test_what_is_proved_and_what_is_sampled_say_so_too():
    """Only where the motion jumps, three motions at one speed, something is left; the principal zone stays."""

    def build(speeds):
        drive = example("unstable-drive")
        return parted(loaded_model(drive, drive.duty, speeds)[1])[0]

    proof = proved_speeds(build, 500 * rpm, 1500 * rpm)
    np.testing.assert_allclose(proof.lowest[-1:] / rpm, [1320.94], atol=0.01)
    assert len(proof.lowest) == 1
    assert np.all((668 * rpm < proof.unproved) & (proof.unproved < 671 * rpm))
    assert proof.hidden < 0.2 * rpm
    speeds = np.asarray([640.0, 675.0, 680.0, 690.0, 700.0, 1340.0]) * rpm
    for method in (Plain(), Compiled()):
        verdict = floquet_map(build(speeds), speed=speeds, method=method).floquet.verdict
        assert (verdict == Verdict.UNSTABLE).tolist() == [False] * 5 + [True]
    orbit = periodic_response(build(speeds), speed=speeds).orbit
    assert ((vibration_growth(orbit, np.arange(6)) > 1e-5).tolist()) == [False] * 5 + [True]


def test_a_jump_is_no_drift():
    """At 669.25 rpm, of three motions the middle one: its torque rises with the speed, and it grows all the same."""
    drive, speed = example("unstable-drive"), np.asarray(669.25 * rpm)
    orbit = steady_orbits(parted(loaded_model(drive, drive.duty, speed)[1])[0], speed=speed)[0]
    assert drift_of(orbit, np.zeros(1, dtype=int))[0] < 0.0
    assert floquet(orbit).verdict == Verdict.UNSTABLE
    assert drift_of(stand(680.0)[1].steady.orbit, np.zeros(1, dtype=int))[0] > 0.0
    assert drift_of(stand(640.0)[1].steady.orbit, np.zeros(1, dtype=int))[0] < 0.0


@pytest.mark.slow
@pytest.mark.parametrize("speed", [669.0, 669.42, 669.6, 670.0])
def test_the_middle_one_of_three_motions_is_told_by_nobody(speed):
    """Slow ways from below and from above lead to two others, both stable; by rule that of the larger torque counts."""
    drive, found = stand(speed)
    assert found.floquet.stable
    assert stability(replace(drive, duty=replace(drive.duty, speed=speed * rpm))).verdict == Verdict.STABLE
    assert len(found.beside) == 1
    assert found.beside[0].swing.max() < found.swing.max()
    assert found.steady.residual < 1e-6
    assert found.steady.power_residual < 1e-9


@pytest.mark.slow
def test_the_motion_told_amid_three_stays_in_time():
    """Governed and pushed, the stand at 669.42 rpm keeps it for three seconds, some seventy periods."""
    _drive, found = stand(669.42)
    _times, mean, torque = in_time(found, 200.0, 3.0, 1e-3)
    late = slice(-2000, None)
    assert abs(np.mean(mean[late]) - 1.0) < 1e-3
    assert 0.5 * np.ptp(torque[late]) == pytest.approx(float(found.swing[0]), rel=0.08)


@pytest.mark.slow
def test_a_range_with_a_jump_says_what_its_speeds_say():
    drive = example("unstable-drive")
    found = stability(drive, over={"duty.speed_rpm": [600.0, 669.0, 669.3, 669.42, 669.6, 670.0, 760.0]})
    assert np.all(found.verdict == Verdict.STABLE)
    assert not len(found.proof.lowest)
    assert found.proof.hidden < 0.2 * rpm
    assert np.all((668 * rpm < found.proof.unproved) & (found.proof.unproved < 671 * rpm))


def test_which_multiplier_is_the_drift():
    """Where the torque falls with the speed, of those above 1 that which the slope makes; none above where it rises."""
    values = np.asarray([[1.4, 0.95, 0.7], [1.4, 0.95, 0.7], [1.01, 0.3, -0.9], [1.03, 1.0002, 0.92]], dtype=complex)
    drift = np.asarray([0.5, -0.1, 0.02, 0.00021])
    left = vibrating(values, 1, lambda rows: drift[rows])
    assert np.sort(left.real).tolist() == [[0.7, 0.95], [0.7, 1.4], [-0.9, 0.3], [0.92, 1.03]]
    shifted = np.concatenate([values, np.ones((4, 1))], axis=-1)
    again = vibrating(shifted, 2, lambda rows: drift[rows])
    assert np.sort(again.real).tolist() == np.sort(left.real).tolist()


def test_backward_turning_drifts_alike():
    drive = example("cured-drive")
    there, back = (floquet(torsion_response(drive, speed=sign * 680 * rpm).steady) for sign in (1.0, -1.0))
    assert there.stable
    assert back.stable
