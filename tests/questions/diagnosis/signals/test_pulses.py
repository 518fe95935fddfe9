import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import InputError
from cardan.questions.diagnosis.signals.signal import Channel
from cardan.questions.diagnosis.signals.turning import counted, edges
from tests.builders.recordings import angle_of


def tacho(values, rate=2000.0):
    return Channel(name="tacho", quantity="pulses", values=values, rate=rate)


def key_phasor(times, seconds=5.0, rate=2000.0, width=0.004):
    """Return a channel that is high for a moment after each of some times."""
    time = np.arange(int(seconds * rate)) / rate
    return tacho(np.any((time[:, None] >= times) & (time[:, None] < np.asarray(times) + width), axis=1) * 5.0, rate)


def test_edges_are_timed_between_values():
    time = np.arange(8000) / 2000
    found, level = edges(tacho(3 + np.sin(angle_of(time, 9.3) + 0.4)))
    # A sine of 9.3 Hz at 2000 values a second is straight about its middle to 1e-4 of a step.
    assert found == pytest.approx((np.arange(1, found.size + 1) - 0.4 / (2 * np.pi)) / 9.3, abs=1e-7)
    assert level == pytest.approx(3.0, abs=1e-3)


def test_noise_within_the_hysteresis_makes_no_pulses():
    time = np.arange(20000) / 2000
    values = np.sin(angle_of(time, 9.3)) + np.random.default_rng(2).normal(scale=0.05, size=time.size)
    assert counted(tacho(values)).time.size == pytest.approx(93, abs=1)
    assert edges(tacho(values), hysteresis=0.0)[0].size > 100


def test_a_spike_does_not_set_the_level():
    time = np.arange(20000) / 2000
    values = np.sin(angle_of(time, 9.3))
    values[777] = 500.0
    assert counted(tacho(values)).time.size == pytest.approx(93, abs=1)


@settings(max_examples=25, deadline=None)
@given(st.lists(st.integers(4, 40), unique=True, max_size=3), st.floats(0.0, 1.5))
def test_missing_pulses_are_counted_over(gone, gain):
    number = np.arange(46)
    first = 10.0
    times = 0.2 + (number / first if gain < 1e-3 else (np.sqrt(first**2 + 2 * gain * number) - first) / gain)
    kept = np.delete(number, gone)
    found = counted(key_phasor(times[kept]))
    assert found.missing == len(gone)
    assert found.extra == 0
    assert found.count.tolist() == kept.tolist()
    assert found.doubtful == 0.0 if not gone else found.doubtful > 0.0


@pytest.mark.parametrize("between", [0.25, 0.5, 0.8])
def test_pulses_that_are_none_are_left_out(between):
    times = 0.2 + np.arange(45) / 10
    found = counted(key_phasor(np.sort([*times, times[20] + 0.1 * between])))
    assert (found.missing, found.extra) == (0, 1)
    assert found.time == pytest.approx(times, abs=1e-3)


def test_a_run_up_from_standstill_has_no_missing_pulses():
    times = 0.1 + np.sqrt(np.arange(1, 60) / 3.0)
    found = counted(key_phasor(times))
    assert (found.missing, found.extra) == (0, 0)


def test_too_few_pulses_are_refused():
    with pytest.raises(InputError, match="tacho: has 2 pulses; at least 4"):
        counted(key_phasor([1.0, 2.0]))
    with pytest.raises(InputError, match="has 0 pulses"):
        counted(tacho(np.zeros(100)))
