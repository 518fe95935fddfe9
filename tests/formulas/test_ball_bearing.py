"""Rating of ball bearings: the worked examples of a maker's catalogue, and what holds at the ends of its table."""

import numpy as np
import pytest

from cardan.formulas.ball_bearing import AXIAL, LEAST, RADIAL, THRUST, ball_life, equivalent_load, static_load
from cardan.units import hour, rpm

C, C0 = 25.7e3, 15.3e3  # of a 6207


def test_the_makers_example_with_radial_load_alone():
    """TPI catalogue 2202/TE, p. 11: 6207, 650 rpm, 2.8 kN: about 20 000 h."""
    assert ball_life(C, equivalent_load(2.8e3, 0.0, C0), speed=650 * rpm) / hour == pytest.approx(20000.0, rel=0.01)


def test_the_makers_example_with_axial_load_too():
    """The same page: with 1.6 kN axially e = 0.29, Y = 1.48, P = 3.94 kN, about 7 000 h."""
    load = equivalent_load(2.8e3, 1.6e3, C0)
    assert load == pytest.approx(3.94e3, rel=0.006)  # it takes e and Y from a curve, by eye
    assert ball_life(C, load, speed=650 * rpm) / hour == pytest.approx(7000.0, rel=0.04)


@pytest.mark.parametrize("k", range(len(THRUST)))
def test_rows_of_the_table_are_met(k):
    axial = THRUST[k] * C0
    assert equivalent_load(0.0, axial, C0) == pytest.approx(AXIAL[k] * axial)
    assert equivalent_load(axial, axial, C0) == pytest.approx((RADIAL + AXIAL[k]) * axial)
    across = axial / LEAST[k]
    assert equivalent_load(1.001 * across, axial, C0) == pytest.approx(1.001 * across)
    # both rules meet at F_a/F_r = e, as the printed figures have it
    assert equivalent_load(0.999 * across, axial, C0) == pytest.approx(across, rel=0.01)


def test_between_rows_it_is_straight_and_beyond_them_as_at_the_ends():
    middle = 0.5 * (THRUST[3] + THRUST[4]) * C0
    assert equivalent_load(0.0, middle, C0) == pytest.approx(0.5 * (AXIAL[3] + AXIAL[4]) * middle)
    assert equivalent_load(0.0, 1.0, C0) == pytest.approx(AXIAL[0])
    assert equivalent_load(0.0, C0, C0) == pytest.approx(AXIAL[-1] * C0)


def test_without_axial_force_the_static_capacity_does_not_count():
    assert equivalent_load(100.0, 0.0, np.nan) == 100.0


def test_load_at_rest_and_life_without_load():
    assert static_load(1000.0, 2000.0) == pytest.approx(1600.0)
    assert static_load(1000.0, 100.0) == 1000.0
    assert np.isinf(ball_life(C, 0.0, speed=100.0))
    assert ball_life(C, C, speed=-2.0 * np.pi) == pytest.approx(1e6)
