import numpy as np
import pytest

from cardan.maths.curves.extremes import peak, peaks


def test_smooth_peaks_are_found_to_rounding():
    shifts = np.linspace(0.1, 6.0, 7)

    def curves(x):
        return np.stack([np.exp(np.cos(x - shift)) for shift in shifts])

    places = np.linspace(0.0, 2 * np.pi, 361)
    place, value = peaks(curves, places, curves(places))
    np.testing.assert_allclose(place, shifts, atol=2e-6)
    # The value is flat at its peak: the square of that.
    np.testing.assert_allclose(value, np.e, rtol=1e-11)


def test_of_two_tops_nearly_as_high_the_higher_counts_whatever_samples_lie_nearer():
    """The higher one lies half a step beside its samples, the lower one on one."""
    step = 2.0 * np.pi / 90
    angle = np.arange(90) * step
    one, other = 14.5 * step, 60.0 * step

    def curve(x):
        return np.exp(8.0 * (np.cos(x - one) - 1.0)) + (1.0 - 1e-3) * np.exp(8.0 * (np.cos(x - other) - 1.0))

    assert np.argmax(curve(angle)) == 60
    assert peak(curve(angle), smooth=True) == pytest.approx(curve(one), abs=1e-5)


def test_a_single_place_is_its_own_peak():
    place, value = peaks(np.atleast_2d, np.asarray([0.3]), np.asarray([[0.7]]))
    assert (place[0], value[0]) == (0.3, 0.7)


def test_no_curves_have_no_peaks():
    place, value = peaks(lambda x: np.zeros((0, x.size)), np.linspace(0, 1, 5), np.zeros((0, 5)))
    assert place.size == value.size == 0


def test_of_places_equally_high_the_first_counts():
    coarse = np.linspace(0.0, 2.0 * np.pi, 361)

    def curves(x):
        # Twice a turn the same, but for what rounding does: the second is higher by some last digits.
        return (1.0 + 1e-14 * x) * np.sin(2.0 * x)[None]

    place, value = peaks(curves, coarse, curves(coarse))
    assert place[0] == pytest.approx(0.25 * np.pi, abs=1e-5)
    assert value[0] == pytest.approx(1.0, rel=1e-10)
