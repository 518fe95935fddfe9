import numpy as np
import pytest

from cardan import InputError
from cardan.questions.diagnosis.signals.signal import Channel
from cardan.questions.diagnosis.signals.torsional import torsional_vibration

RATE = 25600.0
TIME = np.arange(int(3 * RATE)) / RATE
TEETH = 40
RNG = np.random.default_rng(11)
ERROR = RNG.normal(scale=2e-4, size=TEETH)


def wheel(orders, *, gain=0.0, error=None, first=100.0, gone=()):
    """Return the pulses of a wheel whose shaft swings by {order: amplitude}, at the sampled pulses' exact edges."""
    even = first * TIME + 0.5 * gain * TIME**2
    angle = even + sum((a * np.sin(n * even + 0.3 * n) for n, a in orders.items()), np.zeros(TIME.size))
    off = np.zeros(TEETH) if error is None else error
    shift = np.interp(angle % (2 * np.pi), 2 * np.pi * np.arange(TEETH + 1) / TEETH, np.append(off, off[0]))
    phase = TEETH * (angle - shift)
    values = np.sin(phase)
    tooth = np.floor(phase / (2 * np.pi) + 0.25)
    return Channel(name="wheel", quantity="pulses", values=np.where(np.isin(tooth, gone), -1.0, values), rate=RATE)


@pytest.mark.parametrize("gain", [0.0, 30.0])
def test_orders_of_the_twist_are_those_put_in(gain):
    found = torsional_vibration(wheel({0.5: 2e-3, 2: 5e-3, 4: 1e-3}, gain=gain), TEETH)
    for order, amplitude in ((2, 5e-3), (4, 1e-3)):
        assert found.at(order) == pytest.approx(amplitude, rel=0.02)
    assert found.at(0.5) == pytest.approx(2e-3, rel=0.05)
    assert found.at(3) < 5e-5
    if not gain:
        assert np.max(np.abs(found.tooth_error)) < 2e-5
        swing = 100.0 * np.sqrt(((0.5 * 2e-3) ** 2 + (2 * 5e-3) ** 2 + (4 * 1e-3) ** 2) / 2)
        assert np.std(found.swing) == pytest.approx(swing, rel=0.02)


def test_uneven_teeth_are_left_out_above_the_orders_kept():
    swings = {2: 5e-3, 3.3: 1e-3}
    raw = torsional_vibration(wheel(swings, error=ERROR), TEETH, kept=TEETH // 2)
    mended = torsional_vibration(wheel(swings, error=ERROR), TEETH)
    known = torsional_vibration(wheel(swings, error=ERROR), TEETH, tooth_error=ERROR)

    def left(found):
        return np.sqrt(np.sum(found.twist_amplitude[found.order > 9.0] ** 2))

    assert left(mended) < 0.2 * left(raw)
    assert left(known) < 0.2 * left(raw)
    for found in (raw, mended, known):
        assert found.at(2) == pytest.approx(5e-3, rel=0.03)
    lines = np.fft.rfft(ERROR)
    lines[:9] = 0.0
    assert np.corrcoef(np.abs(np.fft.rfft(mended.tooth_error)[9:-1]), np.abs(lines[9:-1]))[0, 1] > 0.95


def test_even_turning_makes_no_twist_even_when_it_speeds_up():
    found = torsional_vibration(wheel({}, gain=50.0), TEETH)
    assert np.std(found.twist) < 1e-4
    assert found.speed[-1] > 1.3 * found.speed[0]
    assert "no larger than what the sampling rate leaves" in found.cautions[0]
    assert found.confidence <= 0.5


def test_teeth_without_a_pulse_are_bridged():
    found = torsional_vibration(wheel({2: 5e-3}, gone=[300, 777, 778]), TEETH)
    assert found.missing == 3
    assert found.at(2) == pytest.approx(5e-3, rel=0.02)
    assert "3 teeth gave no pulse" in found.cautions[0]


def test_too_little_is_refused():
    with pytest.raises(InputError, match="turns; at least 12 are needed"):
        torsional_vibration(wheel({}, first=10.0), TEETH)
    with pytest.raises(InputError) as caught:
        torsional_vibration(wheel({}), 4, kept=3, tooth_error=[0.0])
    assert [one.field for one in caught.value.problems] == ["teeth", "kept", "tooth_error"]
