"""Cracks: what is refused, and the marks of the section and the law."""

import numpy as np
import pytest

from cardan import InputError
from cardan.questions.bending.cracked_rotor import Crack, breathing_law, crack_section


def test_the_captions_loss_of_the_article_is_that_of_its_depth():
    found = crack_section([5e-3, 5e-3], [0.45, 0.1])
    assert found.loss_x[0] == pytest.approx(0.45, abs=0.005)  # "Δk/k_0 = 0.45"
    assert found.loss_y[0] == pytest.approx(0.1004, abs=5e-5)


@pytest.mark.parametrize("power", [1, 4])
def test_a_crack_is_open_below_and_shut_above(power):
    crack = Crack(loss_xi=0.1, loss_eta=0.02, breathing=power)
    share, slope = crack.opening(np.exp(1j * np.asarray([0.0, np.pi])))
    np.testing.assert_allclose(share, [1.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(slope, 0.0, atol=1e-15)
    np.testing.assert_array_equal(crack.coefficients, breathing_law(power))


@pytest.mark.parametrize(
    ("ask", "named"),
    [
        (lambda: Crack(loss_xi=1.0, loss_eta=-0.1, breathing=-1), ["loss_xi", "loss_eta", "breathing"]),
        (lambda: Crack(loss_xi=np.nan, loss_eta=0.0, breathing=1.5), ["loss_xi", "breathing"]),
        (lambda: breathing_law(-1), ["power"]),
        (lambda: breathing_law(100_000), ["power"]),
        (lambda: crack_section(0.0, 2.0), ["radius", "depth_ratio"]),
        (lambda: crack_section([1.0, np.inf], [0.1, -0.1]), ["radius", "depth_ratio"]),
    ],
)
def test_what_is_no_crack_is_named(ask, named):
    with pytest.raises(InputError) as caught:
        ask()
    assert [problem.field for problem in caught.value.problems] == named
