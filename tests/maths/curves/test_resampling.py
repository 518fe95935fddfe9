import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan.maths.curves.resampling import halved, read_slowly


@settings(max_examples=25, deadline=None)
@given(st.floats(0.0, 0.8), st.floats(0.0, 6.28), st.floats(0.3, 5.0))
def test_a_tone_is_read_between_its_values(share, phase, step):
    place = np.arange(60.0, 540.0, step)
    tone = np.cos(share * np.pi * np.arange(600.0) + phase)
    # A Kaiser window of 24 values to each side with β = 9 leaves 3e-5 at 0.8 of half the rate.
    assert np.allclose(
        read_slowly(tone, place, np.ones(place.size)), np.cos(share * np.pi * place + phase), rtol=0, atol=1e-4
    )


def test_values_themselves_and_straight_lines_stay():
    line = np.linspace(-1.0, 3.0, 41)
    assert read_slowly(line, np.arange(41.0), np.ones(41)) == pytest.approx(line, abs=1e-14)
    assert read_slowly(line, np.asarray([1.0, 39.75]), np.ones(2)) == pytest.approx([-0.9, 2.975], abs=1e-4)
    long = np.linspace(-1.0, 3.0, 201)
    assert halved(long) == pytest.approx(long[::2], abs=1e-3)  # turned about its ends, a line goes on


def test_short_records_are_read_too():
    assert read_slowly(np.asarray([1.0, 3.0]), np.asarray([0.0, 0.5, 1.0]), np.ones(3)) == pytest.approx(
        [1.0, 2.0, 3.0]
    )


@settings(max_examples=25, deadline=None)
@given(st.floats(1.0, 12.0), st.floats(0.0, 1.0))
def test_a_slow_tone_survives_and_a_fast_one_is_gone(step, share):
    count = np.arange(6000.0)
    place = np.arange(900.0, 5100.0, step)
    slow = share * 0.25 / step  # cycles a value: four points in a period are the least
    read = read_slowly(np.cos(2 * np.pi * slow * count), place, np.full(place.size, step))
    assert np.allclose(read, np.cos(2 * np.pi * slow * place), rtol=0, atol=2e-4)
    echo = min(0.49, 0.77 / step)  # would fold onto 0.23 of the rate of the points
    if echo * step > 0.76:
        read = read_slowly(np.cos(2 * np.pi * echo * count), place, np.full(place.size, step))
        turned = np.exp(-2j * np.pi * (1.0 / step - echo) * place) * np.hanning(place.size)
        assert abs(np.sum(read * turned)) / np.sum(np.hanning(place.size)) < 2e-4
