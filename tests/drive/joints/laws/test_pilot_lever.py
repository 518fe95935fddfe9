"""Against the lever drawn with its two ball ends on two lines."""

from __future__ import annotations

import array_api_strict as strict
import mpmath
import numpy as np
import pytest
from scipy.optimize import brentq

from cardan.drive.joints import rzeppa
from cardan.units import deg


def drawn(joint_angle, b, c):
    """Put B on the second axis, find A on the first at the length of the lever, and look at C from O."""
    end = c * np.array([np.cos(joint_angle), np.sin(joint_angle)])
    a_end = brentq(lambda x: np.hypot(*(end - [x, 0.0])) - (1 + b), end[0], end[0] + 1 + b, xtol=1e-15)
    ball = np.array([a_end, 0.0]) + (end - [a_end, 0.0]) / (1 + b)
    return np.arctan2(ball[1], ball[0])


@pytest.mark.parametrize("joint_angle", [1e-3, 5 * deg, 35 * deg, 80 * deg])
@pytest.mark.parametrize(("b", "c"), [(0.35, 0.72), (0.1, 0.2), (0.9, 1.2)])
def test_the_drawn_lever_tilts_the_cage_so(joint_angle, b, c):
    # brentq stops within 2e-15 of the place, as seen from about 1 away.
    assert float(rzeppa.cage_tilt(joint_angle, b, c)) == pytest.approx(drawn(joint_angle, b, c), rel=0, abs=6e-15)
    assert float(rzeppa.plane_error(joint_angle, b, c)) == pytest.approx(
        drawn(joint_angle, b, c) - joint_angle / 2, abs=6e-15
    )


@pytest.mark.parametrize("joint_angle", [5 * deg, 35 * deg, 70 * deg])
@pytest.mark.parametrize("b", [0.1, 0.35, 0.8])
def test_the_even_length_is_where_the_drawn_lever_divides(joint_angle, b):
    want = brentq(
        lambda c: drawn(joint_angle, b, c) - joint_angle / 2, 0.01, 0.999 * (1 + b) / np.sin(joint_angle), xtol=1e-15
    )
    c = float(rzeppa.even_length(joint_angle, b))
    assert c == pytest.approx(want, rel=1e-12)  # 6e-15 rad over a slope of 1e-2 to 1 rad
    quadratic = c**2 * (1 + b**2) - b**2 * (1 + b) ** 2 - 2 * c**2 * b * np.cos(joint_angle)  # Book (15), a = 1
    assert abs(quadratic) < 4e-15 * c**2


def test_the_squared_equation_has_roots_that_do_not_divide():
    joint_angle, b = 30 * deg, 1.3
    squared = b * (1 + b) / np.sqrt(1 + b * b - 2 * b * np.cos(joint_angle))
    assert abs(float(rzeppa.plane_error(joint_angle, b, squared))) > 1.5 * deg
    assert np.isnan(rzeppa.even_length(joint_angle, b))
    # Between 1 and 1/cos α there is one still.
    assert float(rzeppa.plane_error(joint_angle, 1.1, rzeppa.even_length(joint_angle, 1.1))) == pytest.approx(
        0, abs=1e-14
    )


@pytest.mark.parametrize("joint_angle", ["1e-9", "1e-4", "0.3", "1.5"])
@pytest.mark.parametrize("c", ["0.7269230769", "0.72", "0.5"])
def test_errors_near_nought_keep_their_digits(joint_angle, c):
    with mpmath.workdps(50):
        alpha, near, far = mpmath.mpf(float(joint_angle)), mpmath.mpf(0.35), mpmath.mpf(float(c))
        root = mpmath.sqrt((1 + near) ** 2 - (far * mpmath.sin(alpha)) ** 2)
        along = far * (1 + near) * mpmath.cos(alpha) + near * root
        want = mpmath.atan2(far * mpmath.sin(alpha), along) - alpha / 2
    # (1 - b) c - b (1 + b) is right to 1e-16; the error of angle is that times about α/2.
    found = float(rzeppa.plane_error(float(joint_angle), 0.35, float(c)))
    assert found == pytest.approx(float(want), rel=4e-15, abs=4e-16 * float(joint_angle))


@pytest.mark.parametrize(
    ("joint_angle", "b", "c"),
    [(0.5, 0.35, 1.35 / np.sin(0.5)), (0.5, 0.35, 9.0), (0.5, 0.0, 1.0), (0.5, 0.3, -1.0), (np.nan, 0.3, 0.7)],
)
def test_levers_that_do_not_reach_have_no_angle(joint_angle, b, c):
    assert np.isnan(rzeppa.cage_tilt(joint_angle, b, c))
    assert np.isnan(rzeppa.plane_error(joint_angle, b, c))


def test_a_straight_joint_is_divided_by_any_lever():
    assert np.all(rzeppa.plane_error(0.0, [0.2, 0.5], 0.7) == 0.0)
    assert float(rzeppa.even_length(0.0, 0.35)) == pytest.approx(0.35 * 1.35 / 0.65, rel=4e-16)


def test_any_array_library_computes_them():
    joint_angle = strict.asarray([0.1, 0.6])
    found = rzeppa.plane_error(joint_angle, strict.asarray(0.35), strict.asarray(0.7))
    assert np.array_equal(np.asarray(found), rzeppa.plane_error([0.1, 0.6], 0.35, 0.7))
    assert np.asarray(rzeppa.even_length(joint_angle, strict.asarray(0.35))).shape == (2,)
