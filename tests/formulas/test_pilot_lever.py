import mpmath
import numpy as np
import pytest

from cardan import InputError
from cardan.drive.joints.rzeppa import even_length, plane_error
from cardan.formulas.joint_geometry import lever_choice
from cardan.units import deg


@pytest.mark.parametrize(("b", "smallest", "largest"), [(0.35, 0, 35), (0.1, 0, 50), (0.7, 0, 20), (0.35, 10, 35)])
def test_no_other_length_errs_less(b, smallest, largest):
    """Dense scan over lengths and bends, as coarse as it may be to stay short."""
    found = lever_choice(b, largest * deg, smallest=smallest * deg)
    joint_angles = np.linspace(smallest, largest, 4001) * deg
    lengths = found.c * (1 + np.linspace(-3e-3, 3e-3, 121))
    worst = np.abs(plane_error(joint_angles, b, lengths[:, None])).max(axis=-1)
    # Half a step of joint angle from the peak loses the square of a share of 1e-4.
    assert worst[60] == pytest.approx(found.error, rel=1e-6)
    assert worst.argmin() == 60
    assert float(plane_error(found.above, b, found.c)) == pytest.approx(found.error, rel=1e-9)
    assert float(plane_error(found.below, b, found.c)) == pytest.approx(-found.error, rel=1e-9)
    assert float(even_length(found.even, b)) == pytest.approx(found.c, rel=1e-13)


def test_small_ranges_follow_the_cubic():
    """For small joint angles the error is k α (α² - α_0²): the best zero is at √3/2 of the range."""
    with mpmath.workdps(30):
        want = float(mpmath.sqrt(3) / 2)
    found = lever_choice(0.35, 0.5 * deg)
    assert found.even / (0.5 * deg) == pytest.approx(want, rel=1e-4)
    assert found.below / (0.5 * deg) == pytest.approx(0.5, rel=1e-3)


def test_a_range_of_one_bend_is_divided_exactly():
    found = lever_choice(0.35, 20 * deg, smallest=20 * deg)
    assert found.error == 0.0
    assert found.c == float(even_length(20 * deg, 0.35))
    assert lever_choice(0.35, 0.0).c == float(even_length(0.0, 0.35))


@pytest.mark.parametrize(("b", "largest"), [(1.0, 0.0), (1.2, 20 * deg), (3.0, 80 * deg), (0.999, 3 * deg), (0.0, 0.3)])
def test_levers_that_cannot_divide_are_refused(b, largest):
    with pytest.raises(InputError) as caught:
        lever_choice(b, largest)
    assert caught.value.field == "b"
