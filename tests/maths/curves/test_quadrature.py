import array_api_strict as strict
import numpy as np
import pytest
from scipy.integrate import quad

from cardan.maths.curves.cycle_statistics import mean_between


def test_kinks_do_not_spoil_the_mean():
    def kinked(x):
        return np.abs(np.cos(x - 0.3)) * np.exp(np.cos(2 * x)) + np.abs(np.sin(x + 1.0))

    places = 0.3 + np.pi / 2, -1.0, 7.0  # the last is no kink, and does no harm
    found = mean_between(lambda x: kinked(x)[..., None, :], np.asarray(places), period=np.pi)
    want, _error = quad(kinked, 0, np.pi, points=[np.pi - 1.0, 0.3 + np.pi / 2], epsabs=1e-14)
    assert found[0] == pytest.approx(want / np.pi, rel=1e-13)


def test_a_sharp_peak_at_a_kink_is_resolved():
    """The mean of c/(1 - s² cos²) is one, of a joint however steep; at 89.9° the peak is 573 high."""
    joint_angle = np.deg2rad(np.asarray([[0.0], [45.0], [80.0], [89.0], [89.9]]))

    def ratio(x):
        c = np.cos(joint_angle)
        return (c / (np.sin(x) ** 2 + (c * np.cos(x)) ** 2))[..., None, :]

    found = mean_between(ratio, np.broadcast_to([0.0, np.pi / 2], (5, 2)), period=np.pi)
    # Rounding of the places, 1e-16, counts tan 89° = 57 times and more at the peak.
    assert np.allclose(found[:4, 0], 1.0, rtol=0, atol=1e-12)
    assert np.allclose(found[4, 0], 1.0, rtol=0, atol=1e-6)


def test_drives_have_kinks_of_their_own_and_nan_stays_where_it_is():
    kinks = np.asarray([[0.0], [1.0], [np.nan]])
    found = mean_between(lambda x: np.stack((np.sin(2 * x), np.abs(np.sin(x - kinks))), axis=-2), kinks, period=np.pi)
    # Rounding of some tens of terms.
    assert np.allclose(found[:2], [0.0, 2 / np.pi], rtol=0, atol=1e-14)
    assert np.all(np.isnan(found[2]))


def test_any_array_library_computes_them():
    kinks = strict.asarray([0.0], dtype=strict.float64)
    found = mean_between(lambda x: strict.abs(strict.sin(x))[None, :], kinks, period=np.pi)
    assert float(found[0]) == pytest.approx(2 / np.pi, rel=1e-14)
