"""The book's rating against its own tables, and against lives worked out by hand."""

import numpy as np
import pytest

from cardan.catalogue import catalogue
from cardan.catalogue.rows import LifeFactor
from cardan.formulas.joint_rating import (
    book_life,
    life_factor,
    nominal_torque,
    rated_joint_angle,
    rated_torque,
    speed_angle_factor,
)
from cardan.units import deg, hour, rpm


@pytest.mark.parametrize(
    ("name", "factor", "unit", "largest"),
    [("life_factors", life_factor, hour, 0.0025), ("speed_angle_factors", speed_angle_factor, rpm * deg, 0.004)],
)
def test_the_tables_are_the_power_law_but_for_their_misprints(name, factor, unit, largest):
    """Corrected columns keep within 0.25 % and 0.4 % of the law; every correction lies nearer to it than the print."""
    rows = list(catalogue().table(name, LifeFactor).values())
    at = np.asarray([row.at for row in rows])
    law = factor(at * unit)
    own, printed = (np.asarray([getattr(row, key) for row in rows]) for key in ("factor", "printed"))
    assert np.max(np.abs(own / law - 1.0)) < largest
    wrong = own != printed
    assert np.any(wrong)
    assert np.all(np.abs(own / law - 1.0)[wrong] < np.abs(printed / law - 1.0)[wrong])
    np.testing.assert_allclose(factor(at * unit, method="table"), own, rtol=1e-12)


def test_between_its_points_a_table_is_straight_on_logarithmic_paper():
    """3500 h lies between 3000 h (1.71) and 4000 h (1.865)."""
    share = np.log(3500 / 3000) / np.log(4000 / 3000)
    assert life_factor(3500 * hour, method="table") == pytest.approx(1.71 ** (1 - share) * 1.865**share, rel=1e-12)
    assert np.isnan(life_factor([99 * hour, 100001 * hour], method="table")).all()
    assert life_factor(100000 * hour, method="table") == pytest.approx(4.90)


def test_by_hand():
    """c = 20 kN, R = 40 mm: M_nom = 2.6 * 20000 * 0.04 = 2080 N·m. At 1000 rpm and 6°, n α = 6000:

    f_na = 60^0.3 = 3.4154, f_h(2000 h) = 4^0.3 = 1.5157, so M = 2*2080/(1.38*1.5157*3.4154) = 582.3 N·m.
    """
    nominal = nominal_torque(20e3, 0.040)
    assert nominal == pytest.approx(2080.0)
    found = rated_torque(nominal, speed=1000 * rpm, joint_angle=6 * deg, life=2000 * hour, shock=1.38)
    assert found == pytest.approx(582.3, abs=0.05)


def test_life_and_rating_undo_each_other():
    n, alpha, shock = np.asarray([33.3, 900.0, 4000.0]) * rpm, np.asarray([0.5, 7.0, 25.0]) * deg, 1.2
    torque = rated_torque(1500.0, speed=n, joint_angle=alpha, life=3000 * hour, shock=shock)
    np.testing.assert_allclose(
        book_life(1500.0, torque, speed=-n, joint_angle=alpha, shock=shock), 3000 * hour, rtol=1e-12
    )


def test_small_bends_count_as_three_degrees_and_nothing_wears_without_torque():
    np.testing.assert_allclose(rated_joint_angle(np.asarray([0.0, 3.0, 9.0]) * deg) / deg, [3.0, 3.0, 9.0])
    assert book_life(1000.0, 0.0, speed=1.0, joint_angle=0.1) == np.inf
    assert book_life(1000.0, -50.0, speed=1.0, joint_angle=0.1) == book_life(1000.0, 50.0, speed=1.0, joint_angle=0.1)
