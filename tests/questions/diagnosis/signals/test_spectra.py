import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid

from cardan import InputError
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.questions.diagnosis.signals.signal import Channel
from cardan.questions.diagnosis.signals.spectra import cepstrum, integrate

TIME = np.arange(8000) / 2000
INSIDE = slice(1500, 6500)


def test_integrals_of_vibrations_are_those_by_hand():
    tones = {12.0: (1.0, 0.3), 47.0: (0.2, 1.0)}
    values = sum(a * np.cos(2 * np.pi * f * TIME + p) for f, (a, p) in tones.items())
    moving = integrate(Channel(name="a", values=values + 5.0, rate=2000.0, place="supports[0]"), low=3.0)
    want = sum(a / (2 * np.pi * f) * np.sin(2 * np.pi * f * TIME + p) for f, (a, p) in tones.items())
    assert (moving.quantity, moving.place) == ("velocity", "supports[0]")
    assert np.allclose(moving.values[INSIDE], want[INSIDE], rtol=0, atol=1e-3 * np.max(want))
    way = integrate(moving, low=3.0)
    want = -sum(a / (2 * np.pi * f) ** 2 * np.cos(2 * np.pi * f * TIME + p) for f, (a, p) in tones.items())
    assert way.quantity == "displacement"
    assert np.allclose(way.values[INSIDE], want[INSIDE], rtol=0, atol=0.02 * np.max(want))  # the ends ring a while


def test_drift_is_cut_where_sums_run_away():
    rng = np.random.default_rng(0)
    values = np.cos(2 * np.pi * 20 * TIME) + 0.05 + rng.normal(scale=0.1, size=TIME.size)
    summed = cumulative_trapezoid(values, TIME, initial=0.0)
    found = integrate(Channel(name="a", values=values, rate=2000.0), low=5.0).values
    want = np.sin(2 * np.pi * 20 * TIME) / (2 * np.pi * 20)
    assert np.max(np.abs(summed - want)) > 0.1
    assert np.max(np.abs(found - want)[INSIDE]) < 0.002


def test_what_has_no_integral_is_refused():
    with pytest.raises(InputError) as caught:
        integrate(Channel(name="m", quantity="torque", values=TIME, rate=2000.0), low=0.0)
    assert [one.field for one in caught.value.problems] == ["channel", "low"]


def test_sidebands_make_one_peak():
    angle = 2 * np.pi * 15 * TIME
    values = (1 + 0.8 * np.cos(angle) + 0.5 * np.cos(2 * angle) + 0.3 * np.cos(3 * angle)) * np.cos(17 * angle)
    noise = np.random.default_rng(1).normal(scale=0.01, size=TIME.size)
    shaft = Rotation(time=TIME[::50], angle=angle[::50])
    found = cepstrum(Channel(name="a", values=values + noise, rate=2000.0), shaft, highest=30.0)
    lag, _height = found.peak(0.3, 1.5)
    assert found.unit == "turn"
    assert lag == pytest.approx(1.0, abs=0.02)
