"""Field balancing: a rotor written apart shakes its sensors, and what balances it is what was hidden in it."""

import numpy as np
import pytest

from cardan.errors import InputError
from cardan.formulas.unbalance_behind_joint import unbalance_behind_joint
from cardan.questions.diagnosis.field_balance import field_balance, readings_of
from cardan.questions.diagnosis.field_balance_answer import answer
from cardan.questions.diagnosis.signals.signal import Channel, Signal
from cardan.units import deg, rpm

SPEED = 1800 * rpm
PLACES = np.array([0.1, 1.1])
SUPPORTS = np.array([0.0, 1.2])
HIDDEN = np.array([180e-6 * np.exp(0.7j), 90e-6 * np.exp(-2.1j)])
COUPLE = 40.0
"""Secondary couple of the joint [N m], half static, half at order 2."""


def shaken(unbalance, angle, *, joint=0.0, unequal=1.0):
    """Displacements (2, t) along x at both supports of a rigid shaft of 8 kg; `unequal`: stiffness across over that
    along. The shaft turns behind a joint; its position comes from tan φ_2 = tan φ_1/cos α, differentiated by FFT."""
    wave = np.exp(1j * angle)
    law = unbalance_behind_joint(joint, reach=41)
    turned = sum(f * np.exp(1j * n * angle) for n, f in zip(law.order, law.force, strict=True))
    force = SPEED**2 * turned[None] * unbalance[:, None]
    mass, across, stiff, loss = 8.0, 1.0, 4e5, 60.0
    centre = 0.6
    # Coordinates: displacement and tilt; springs at both supports, in x and in y; the couple of the joint tilts.
    inertia = np.diag([mass, across])
    arms = np.stack([np.ones(2), SUPPORTS - centre])
    spring = arms @ np.diag([stiff, 1.5 * stiff]) @ arms.T
    damping = spring * (loss / stiff)
    push = np.stack([np.sum(force, axis=0), (PLACES - centre) @ force])
    push[1] = push[1] + COUPLE * (1.0 + wave**2)
    found = []
    for part, factor in ((push.real, 1.0), (push.imag, unequal)):
        lines = np.fft.fft(part, axis=-1)
        omega = SPEED * np.fft.fftfreq(angle.size, d=(angle[1] - angle[0]) / (2.0 * np.pi))
        matrix = factor * spring[None] + 1j * omega[:, None, None] * damping - omega[:, None, None] ** 2 * inertia
        found.append(np.fft.ifft(np.linalg.solve(matrix, lines.T[..., None])[..., 0].T, axis=-1).real)
    return arms.T @ found[0], arms.T @ found[1]


def recording(unbalance, *, joint=0.0, unequal=1.0, noise=0.0, name="run", both=False, speed=SPEED):
    per_turn, turns = 128, 40
    angle = 2.0 * np.pi * np.arange(per_turn * turns) / per_turn
    along, across = shaken(unbalance, angle, joint=joint, unequal=unequal)
    rng = np.random.default_rng(3)
    rate = per_turn * speed / (2.0 * np.pi)
    rows = [*along, *across] if both else list(along)
    sensors = [
        Channel(name=f"sensor {k}", quantity="displacement", rate=rate, values=row + noise * rng.normal(size=row.size))
        for k, row in enumerate(rows)
    ]
    mark = Channel(name="mark", quantity="angle", rate=rate, values=angle)
    return Signal(name=name, channels=(mark, *sensors), tacho=0)


def balanced(trials, **how):
    read = readings_of([recording(HIDDEN + one, **how) for one in np.vstack([np.zeros(2), trials])])
    return field_balance(read.value[:, :, 0], trials), read


ONE_EACH = np.diag([100e-6, 100e-6 * np.exp(1j)])
TWO_EACH = np.vstack([ONE_EACH, 1j * ONE_EACH])


def test_what_was_hidden_is_cancelled():
    found, read = balanced(ONE_EACH)
    np.testing.assert_allclose(found.correction, -HIDDEN, rtol=1e-6)
    assert np.max(np.abs(found.remaining)) < 1e-9 * np.max(np.abs(found.first))
    assert read.speed == pytest.approx(SPEED, rel=1e-6)


def test_the_second_order_of_the_joint_is_told_apart_and_stays():
    """With nothing unbalanced all that shakes is order 2; with unbalance it is the same, whatever the trial masses."""
    (bare,) = readings_of([recording(np.zeros(2), joint=10 * deg)]).value
    assert np.max(np.abs(bare[:, 0])) < 1e-8 * np.max(np.abs(bare[:, 1]))
    _found, read = balanced(ONE_EACH, joint=10 * deg)
    np.testing.assert_allclose(read.value[:, :, 1], np.broadcast_to(bare[:, 1], (3, 2)), rtol=1e-6)


@pytest.mark.parametrize(("joint", "unequal"), [(20 * deg, 1.0), (12 * deg, 2.5)])
def test_two_runs_a_plane_count_what_turns_backward(joint, unequal):
    found, _read = balanced(TWO_EACH, joint=joint, unequal=unequal)
    assert found.two_sided
    np.testing.assert_allclose(found.correction, -HIDDEN, rtol=1e-6)


def test_one_run_a_plane_leaves_what_a_joint_turns_backward():
    """τ/2 of the unbalance at most, about; a second balancing takes nearly all of it."""
    tau = np.tan(10 * deg) ** 2
    once, _read = balanced(ONE_EACH, joint=20 * deg)
    left = np.abs(once.correction + HIDDEN)
    assert 1e-4 < np.max(left / np.abs(HIDDEN)) < 2.0 * tau
    assert np.max(np.abs(balanced(ONE_EACH)[0].correction + HIDDEN)) < 1e-3 * np.max(left)


def test_more_runs_and_sensors_are_fitted_and_told_how_well():
    rng = np.random.default_rng(5)
    trials = 1e-4 * (rng.normal(size=(7, 2)) + 1j * rng.normal(size=(7, 2)))
    found, _read = balanced(trials, noise=2e-7, both=True)
    np.testing.assert_allclose(found.correction, -HIDDEN, atol=0.02 * np.max(np.abs(HIDDEN)))
    assert 0.0 < found.misfit < 0.02


def test_readings_that_say_too_little_are_refused():
    readings = np.ones((3, 2), dtype=complex)
    with pytest.raises(InputError, match="tell the 2 planes apart"):
        field_balance(readings, np.array([[1.0, 1.0], [2.0, 2.0]]))
    with pytest.raises(InputError, match="change nothing"):
        field_balance(readings, np.eye(2))
    with pytest.raises(InputError, match="one for each plane"):
        field_balance(readings[:, :1], np.eye(2))
    with pytest.raises(InputError, match="one more is needed"):
        field_balance(readings, np.eye(3))
    with pytest.raises(InputError, match="not run at the speed of the first"):
        readings_of([recording(HIDDEN), recording(HIDDEN, speed=1.1 * SPEED, name="other")])


def test_the_answer_tells_masses_and_what_stays():
    found, read = balanced(ONE_EACH, joint=10 * deg)
    said = answer(found, read, PLACES.tolist(), 0.04)
    masses = said.tables[0]
    assert list(masses.columns[3].values) == pytest.approx(np.abs(found.correction) / 0.04)
    assert list(said.tables[1].columns[3].values) == pytest.approx(np.abs(read.value[0, :, 1]))
    assert not any(one.tone == "warning" for one in said.remarks)
