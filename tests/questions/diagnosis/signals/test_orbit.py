import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from cardan import InputError
from cardan.questions.diagnosis.signals.orbit import Ellipse, orbit
from cardan.questions.diagnosis.signals.rotation import Rotation
from cardan.questions.diagnosis.signals.signal import Channel
from tests.builders.recordings import angle_of

TIME = np.arange(8000) / 2000
ANGLE = angle_of(TIME, 8.0, 1.0)
SHAFT = Rotation(time=TIME[::50], angle=ANGLE[::50])


def sensors(z, **given):
    rows = np.real(z), np.imag(z)
    return [Channel(name="xy"[k], quantity="displacement", values=rows[k], rate=2000.0, **given) for k in range(2)]


@settings(max_examples=20, deadline=None)
@given(*[st.complex_numbers(max_magnitude=3.0) for _ in range(4)])
def test_circles_with_and_against_the_shaft_are_those_put_in(one_f, one_b, two_f, two_b):
    z = 2 - 1j + one_f * np.exp(1j * ANGLE) + one_b * np.exp(-1j * ANGLE)
    z = z + two_f * np.exp(2j * ANGLE) + two_b * np.exp(-2j * ANGLE)
    found = orbit(*sensors(z), SHAFT)
    size = 1e-3 * max(1.0, abs(one_f), abs(one_b), abs(two_f), abs(two_b))
    for ellipse, forward, backward in zip(found.ellipses, (one_f, two_f), (one_b, two_b), strict=True):
        assert ellipse.forward == pytest.approx(forward, abs=size)
        assert ellipse.backward == pytest.approx(backward, abs=size)
    assert found.mean == pytest.approx((2.0, -1.0), abs=size)
    assert found.residual < size
    x, y = found.filtered()
    assert np.allclose(x, found.x, atol=3 * size)
    assert np.allclose(y, found.y, atol=3 * size)


@settings(max_examples=30)
@given(
    st.complex_numbers(min_magnitude=0.1, max_magnitude=3.0), st.complex_numbers(min_magnitude=0.1, max_magnitude=3.0)
)
def test_axes_of_an_ellipse_are_its_farthest_and_nearest_points(forward, backward):
    one = Ellipse(order=1.0, forward=forward, backward=backward)
    x, y = one.points(7201)
    far = np.hypot(x, y)
    assert one.major == pytest.approx(np.max(far), rel=1e-6)
    assert abs(one.minor) == pytest.approx(np.min(far), abs=1e-3 * one.major)
    if abs(one.minor) < 0.99 * one.major:
        k = int(np.argmax(far))
        assert np.abs(np.sin(np.arctan2(y[k], x[k]) - one.incline)) < 0.1
    turned = np.sum(x[:-1] * np.diff(y) - y[:-1] * np.diff(x))
    assert np.sign(turned) == np.sign(one.minor) or abs(one.minor) < 1e-3


def test_sensors_at_any_angles_see_the_same_orbit():
    z = np.exp(1j * ANGLE) + 0.4 * np.exp(-1j * ANGLE)
    angles = np.radians([45.0, 120.0])
    slanted = np.stack([np.real(z * np.exp(-1j * one)) for one in angles])
    found = orbit(*sensors(slanted[0] + 1j * slanted[1]), SHAFT, orders=[1.0], angles=tuple(angles))
    assert found.ellipses[0].forward == pytest.approx(1.0, abs=1e-3)
    assert found.ellipses[0].backward == pytest.approx(0.4, abs=1e-3)


def test_the_orbit_is_that_of_the_time_asked_for():
    z = TIME * np.exp(1j * ANGLE)
    early, late = (orbit(*sensors(z), SHAFT, turns=4, at=at) for at in (1.0, 3.0))
    assert early.ellipses[0].major == pytest.approx(1.0, abs=0.02)
    assert late.ellipses[0].major == pytest.approx(3.0, abs=0.02)
    assert late.speed == pytest.approx(2 * np.pi * 11.0, rel=0.01)


def test_what_does_not_go_together_is_refused():
    x, y = sensors(np.exp(1j * ANGLE))
    other = Channel(name="v", quantity="velocity", values=y.values, rate=2000.0, place="supports[1]")
    with pytest.raises(InputError) as caught:
        orbit(x, other, SHAFT, angles=(0.0, np.pi))
    assert [one.field for one in caught.value.problems] == ["y", "y", "angles"]
