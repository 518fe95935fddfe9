"""A weak motor stays below the resonance of the joints' order 2; a strong one, or a milder bend, passes it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from cardan.maths.compiled.method import Compiled
from cardan.questions.torsion.model.inputs import Asynchronous, Falling, Law
from cardan.questions.torsion.model.torsional_balance import power
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line
from cardan.questions.torsion.transient.fixed_steps import FixedStep
from cardan.questions.torsion.transient.simulation import Simulation
from cardan.questions.torsion.transient.torsion_transient import sommerfeld
from cardan.questions.torsion.transient.transient import simulate

NO_LOAD = 80.0


def line(push: Law, joint_angle: float) -> TorsionalModel:
    """Return two flywheels with a joint between; half their natural frequency is 21.8 rad/s."""
    return torsional_line(
        [[0.5, 0.02], [0.02, 0.5]],
        stiffness=[[1000.0], [1000.0]],
        damping=[[0.3], [0.3]],
        joint_angle=[joint_angle],
        torques=[Torque(station=0, law=push)],
    )


def run(model: TorsionalModel, span: float = 30.0, sense: float = 1.0) -> Simulation:
    """Start from a creeping speed."""
    way = FixedStep(per_period=12, compute=Compiled(threads=1))
    found = simulate(model, span=span, times=round(100 * span) + 1, speed=sense, method=way)
    assert found.imbalance < 1e-6
    return found


def motor(torque: float) -> Falling:
    return Falling(standstill=torque, slope=torque / NO_LOAD)


def test_a_motor_hangs_below_half_the_natural_frequency() -> None:
    model = line(motor(8.0), 0.6)
    found = run(model)
    (hang,) = sommerfeld(model, found)
    assert 0.9 * 21.8 < hang.speed < 21.8
    assert hang.did < 0.01 * hang.could
    assert hang.end > 29.0
    # All that the motor gives goes into the dampers: its power at that speed, and what they take in the meantime.
    assert hang.power == pytest.approx((8.0 - 0.1 * hang.speed) * hang.speed, rel=1e-2)
    late = found.times > 10.0
    _given, lost = power(model, found.coordinate[late], found.rate[late], found.times[late])
    assert np.mean(lost) == pytest.approx(hang.power, rel=0.2)  # the swing beats slowly, 20 s hold no whole number


@pytest.mark.parametrize(("torque", "joint_angle"), [(8.0, 0.3), (3.0, 0.2)])
def test_less_bend_lets_it_pass(torque: float, joint_angle: float) -> None:
    model = line(motor(torque), joint_angle)
    found = run(model)
    assert sommerfeld(model, found) == ()
    assert found.speed[-1, 0] > 40.0


def test_backwards_it_hangs_as_well() -> None:
    model = line(Falling(standstill=-8.0, slope=0.1), 0.6)
    (hang,) = sommerfeld(model, run(model, sense=-1.0))
    assert -21.8 < hang.speed < -0.9 * 21.8
    assert hang.power > 0.0


def test_a_motor_at_its_running_speed_does_not_hang() -> None:
    push = Asynchronous(synchronous_speed=60.0, pullout_torque=40.0, pullout_slip=0.3)
    model = line(push, 0.1)
    found = run(model)
    assert sommerfeld(model, found) == ()
    assert found.speed[-1, 0] == pytest.approx(60.0, rel=2e-2)


def test_forced_drives_and_short_runs_do_not_hang() -> None:
    model = line(motor(8.0), 0.6)
    assert sommerfeld(model, run(model, span=0.5)) == ()
    forced = replace(model, input_speed=np.asarray(20.0))
    assert sommerfeld(forced, run(forced, span=5.0)) == ()
