"""Against dense scans of the triangle of the centres."""

import numpy as np
import pytest

from cardan import InputError
from cardan.formulas.joint_geometry import best_centring
from cardan.units import deg


def left(share, joint_angle):
    """Return the speed fluctuation of two joints that a ball centres, from the triangle."""
    second = np.arcsin(share * np.sin(joint_angle))
    first = joint_angle - second
    return np.abs(np.cos(second) / np.cos(first) - np.cos(first) / np.cos(second))


@pytest.mark.slow
@pytest.mark.parametrize(("most", "least"), [(20, 0), (50, 0), (80, 0), (45, 25), (30, 29)])
def test_no_other_ratio_does_better(most, least):
    found = best_centring(most * deg, least * deg)
    joint_angles = np.linspace(least, most, 2001) * deg
    assert left(found.share, joint_angles).max() == pytest.approx(found.speed_fluctuation, rel=1e-5, abs=1e-9)
    shares = np.linspace(0.45, 0.75, 601)
    assert found.speed_fluctuation <= left(shares[:, None], joint_angles).max(-1).min() * (1 + 1e-5) + 1e-9
    assert left(found.share, np.asarray(found.worst)) == pytest.approx(found.speed_fluctuation, rel=1e-6, abs=1e-12)
    assert left(0.5, joint_angles).max() == pytest.approx(found.middle_speed_fluctuation, rel=1e-9)


@pytest.mark.parametrize(
    ("most", "share", "speed_fluctuation"),
    [(20, 0.50639, 3.25e-4), (30, 0.51459, 1.69e-3), (40, 0.52651, 5.55e-3), (50, 0.54263, 1.43e-2)],
)
def test_known_values(most, share, speed_fluctuation):
    found = best_centring(most * deg)
    assert found.share == pytest.approx(share, abs=6e-6)
    assert found.speed_fluctuation == pytest.approx(speed_fluctuation, rel=3e-3)
    assert 5.0 < found.middle_speed_fluctuation / found.speed_fluctuation < 6.0


def test_small_bends_have_a_closed_form():
    """λ - ½ = (√8 - 2)/16 α² to the order of α⁴, from δ = 2μα² - α⁴/8."""
    found = best_centring(1 * deg)
    assert found.share - 0.5 == pytest.approx((np.sqrt(8) - 2) / 16 * deg**2, rel=1e-3)
    assert best_centring(1e-9).share == pytest.approx(0.5)


def test_what_is_no_range():
    with pytest.raises(InputError, match="joint_angle_max") as error:
        best_centring(90 * deg)
    assert error.value.field == "joint_angle_max"
    with pytest.raises(InputError, match="below the largest joint angle"):
        best_centring(20 * deg, 20 * deg)
