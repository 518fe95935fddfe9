"""The table of deviations tells what the cases come to."""

from dataclasses import replace

from tests.reference.residuals import Residual, _pairs


def test_angles_deviate_on_their_circle_and_lists_by_their_largest():
    computed = {"psi_mod180_deg": [179.5, 90.0], "delta": 0.25, "name": "a"}
    expected = {"psi_mod180_deg": [-0.5, 90.0], "delta": 0.5, "name": "a", "reason": 3.0}
    assert list(_pairs(computed, expected)) == [(0.0, 90.0), (0.0, 90.0), (0.25, 0.5)]


def test_a_deviation_is_told_by_its_class():
    one = Residual("statics", "x", cases=1, numbers=3, largest=3e-10)
    assert one.told == "< 1e-9"
    assert replace(one, largest=2e-14).told == "rounding"
    assert replace(one, numbers=0).told == "–"
