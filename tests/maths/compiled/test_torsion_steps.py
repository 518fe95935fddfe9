"""The kernel against its plain form, and both against what they approximate."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import mpmath as mp
import numpy as np
import pytest

from cardan.maths.compiled import plain as plain_torsion
from cardan.maths.compiled import torsion_forms as forms
from cardan.maths.compiled import torsion_forms as method
from cardan.maths.compiled.torsion_line import begin
from cardan.questions.torsion.model.inputs import Asynchronous, Constant, Falling, History, SpeedTable, Swinging
from cardan.questions.torsion.model.torsional_balance import accelerations, power
from cardan.questions.torsion.model.torsional_layouts import line_of
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel, torsional_line

SPEED, DRIVES = 20.0, 11


def model(*, forced: bool = False, backlash: float = 0.0, steep: float = 0.0) -> TorsionalModel:
    """Return drives of four shafts with every kind of torque: bound by three joints, light and heavy followers."""
    angle_error = np.linspace(0.0, 0.1, DRIVES)[:, None]
    torques = (
        Torque(station=7, law=Falling(standstill=-3.0, slope=0.2)),
        Torque(station=1, law=Swinging(amplitude=np.linspace(4.0, 6.0, DRIVES), frequency=1.5, phase=0.3)),
        Torque(station=0, law=Asynchronous(synchronous_speed=30.0, pullout_torque=40.0, pullout_slip=0.2)),
        Torque(
            station=6,
            law=SpeedTable(speeds=np.asarray([0.0, 19.0, 21.0, 40.0]), torques=np.asarray([4.0, 1.0, -5.0, -9.0])),
        ),
        Torque(station=4, law=History(times=np.asarray([0.0, 0.02, 0.05]), torques=np.asarray([0.0, 5.0, -3.0]))),
        Torque(station=3, law=Constant(value=2.0)),
    )
    return torsional_line(
        [[1.0, 0.02], [0.0], [0.02, 0.2, 0.02], [0.4, 0.1]],
        stiffness=[[4000.0], [], [900.0, 900.0], [500.0]],
        damping=[[1.0], [], [0.3, 0.2], [0.1]],
        backlash=[[backlash], [], [0.0, 0.0], [0.0]],
        ground_damping=[[0.1, 0.2], [0.3], [0.1, 0.1, 0.1], [0.0, 0.2]],
        joint_angle=np.asarray([0.4 + steep, 0.5, 0.3]) + angle_error,
        phase=[0.1, 1.2, 2.0],
        torques=torques,
        input_speed=SPEED if forced else None,
    )


def stepped(drives: TorsionalModel, block: object, steps: int = 60, h: float = 1e-3) -> plain_torsion.State:
    """Return where drives are after steps in two pieces of different length."""
    line = line_of(drives, DRIVES)
    rank = drives.coordinates
    start = begin(line, np.zeros((rank, DRIVES)), np.full((rank, DRIVES), SPEED))
    walk = block(line, start)  # type: ignore[operator]
    motion = None if drives.free else (np.zeros(DRIVES), np.full(DRIVES, SPEED), np.zeros(DRIVES))
    walk.advance(0.0, steps // 2, h, motion, last=False)
    if motion is not None:
        motion = (SPEED * h * (steps // 2) + np.zeros(DRIVES), *motion[1:])
    walk.advance(h * (steps // 2), steps, 0.5 * h, motion, last=True)
    return walk.state()


@pytest.mark.slow
@pytest.mark.parametrize("forced", [False, True])
@pytest.mark.parametrize(("backlash", "steep"), [(0.0, 0.0), (0.004, 0.0), (0.0, 0.8)])
def test_the_kernel_does_what_the_plain_form_does(forced: bool, backlash: float, steep: float) -> None:
    """Sums in another order, fused multiplications: rounding of speeds of 20 rad/s, carried on through 60 steps."""
    pytest.importorskip("numba")
    from cardan.maths.compiled.torsion_block import Block

    drives = model(forced=forced, backlash=backlash, steep=steep)
    plain, compiled = stepped(drives, plain_torsion.Block), stepped(drives, Block)
    for name in ("q", "v", "work", "alive", "ended", "high", "low", "high_time", "low_time", "before", "rate"):
        wanted, found = getattr(plain, name), getattr(compiled, name)
        assert found.shape == wanted.shape
        size = max(1.0, float(np.max(np.abs(wanted))))
        np.testing.assert_allclose(found, wanted, rtol=0.0, atol=1e-10 * size, err_msg=name)


@pytest.mark.parametrize("forced", [False, True])
def test_what_acts_is_what_the_equations_say(forced: bool) -> None:
    drives = model(forced=forced)
    line = line_of(drives, DRIVES)
    rng = np.random.default_rng(3)
    q = np.cumsum(rng.normal(size=(5, DRIVES)) * 0.01, axis=0) + rng.normal(size=DRIVES)
    v = SPEED + rng.normal(size=(5, DRIVES))
    if forced:
        v[0] = SPEED
    found = plain_torsion.moment(line, q, v, 0.03, np.zeros(DRIVES) if forced else None)
    wide = replace(drives, torques=tuple(drives.torques))
    np.testing.assert_allclose(found.acceleration, accelerations(wide, q.T, v.T, 0.03).T, rtol=1e-10, atol=1e-8)
    if not forced:
        given, lost = power(wide, q.T, v.T, 0.03)
        np.testing.assert_allclose(found.power, given - lost, rtol=1e-10, atol=1e-9)


def test_halving_the_step_divides_the_error_by_two_to_the_eighth() -> None:
    """A pendulum of one joint: J F'² q̈ + J F' F'' q̇² = 0 has F' q̇ constant."""
    line = torsional_line([[0.0], [1.0]], stiffness=[[], []], joint_angle=[0.6])
    errors = []
    for steps in (12, 24):
        state = begin(line_of(line, 1), np.zeros((1, 1)), np.full((1, 1), 1.0))
        block = plain_torsion.Block(line_of(line, 1), state)
        block.advance(0.0, steps, np.pi / steps, None, last=True)
        q, v, _work = block.now()
        first = np.cos(0.6) / (1.0 - np.sin(0.6) ** 2 * np.cos(q[0, 0]) ** 2)
        errors.append(abs(first * v[0, 0] - 1.0 / np.cos(0.6)))
    assert 2.0**7 < errors[0] / errors[1] < 2.0**10


def test_the_coefficients_are_those_of_dop853() -> None:
    from scipy.integrate._ivp import dop853_coefficients as wanted

    for i, row in enumerate(method.SPEED):
        assert [row.get(j, 0.0) for j in range(12)] == wanted.A[i, :12].tolist()
    assert [method.SPEED_WEIGHTS.get(j, 0.0) for j in range(12)] == wanted.B.tolist()
    np.testing.assert_allclose(method.PLACES, wanted.C[:12], atol=1e-13)


def test_waves_of_large_angles() -> None:
    q = np.concatenate((np.linspace(-forms.LARGEST_ANGLE, forms.LARGEST_ANGLE, 301), np.linspace(-9.0, 9.0, 301)))
    sine, cosine = forms.waves(q)
    with mp.workdps(40):
        exact = [(mp.sin(2 * mp.mpf(x)), mp.cos(2 * mp.mpf(x))) for x in q.tolist()]
        assert max(abs(s - e[0]) for s, e in zip(sine.tolist(), exact, strict=True)) < 1e-15
        assert max(abs(c - e[1]) for c, e in zip(cosine.tolist(), exact, strict=True)) < 1e-15


@pytest.mark.parametrize("spacing", [0.3, 0.6])
def test_extremes_between_steps_are_those_of_the_cubic(spacing: float) -> None:
    """Of a sine sampled 10 or 20 times a period: a cubic by values and slopes errs by the fourth power over 384."""
    times = np.arange(0.0, 9.0, spacing) + 0.1
    high = low = np.sin(times[:1])
    high_time = low_time = times[:1]
    for one, two in pairwise(times):
        curve = (np.sin([two]), np.cos([two]), np.sin([one]), np.cos([one]))
        high, low, high_time, low_time = forms.highest(*curve, high, low, high_time, low_time, two, spacing)
    assert high[0] == pytest.approx(1.0, abs=1.1 * spacing**4 / 384)
    assert low[0] == pytest.approx(-1.0, abs=1.1 * spacing**4 / 384)
    assert np.sin(high_time[0]) == pytest.approx(1.0, abs=2e-5)
    assert np.sin(low_time[0]) == pytest.approx(-1.0, abs=2e-5)
