"""Contacts by Hertz, against the factors of ISO 76 and closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from cardan.formulas.hertz import CONTACT_MODULUS, point_contact

STEEL = 207e9 / (2.0 * (1.0 - 0.3**2))
"""E* of ISO 76 [Pa]."""


@pytest.mark.parametrize(("slimness", "factor"), [(0.0, 14.7), (0.05, 15.7), (0.1, 16.4), (0.2, 14.0)])
def test_balls_in_grooves_carry_what_iso_76_says(slimness, factor):
    """C_0r = f_0 Z D²: at 4200 MPa under Q = 5 C_0r/Z; ISO 76, table of f_0; radii of grooves 0.52 D and 0.53 D.

    The table rounds to a tenth.
    """
    ball = 10.0
    grooves = (
        (0.52, 2.0 / ball * (1.0 + slimness / (1.0 - slimness))),
        (0.53, 2.0 / ball * (1.0 - slimness / (1.0 + slimness))),
    )
    carried = []
    for conformity, along in grooves:
        across = 2.0 / ball - 1.0 / (conformity * ball)
        unit = point_contact(1.0, across * 1e3, along * 1e3, modulus=STEEL).pressure
        carried.append((4200e6 / unit) ** 3 / (5.0 * ball**2))
    assert min(carried) == pytest.approx(factor, abs=0.05)


def test_a_ball_on_a_plane_has_a_round_contact():
    """p_0 = (6 F E*²/(π³ R²))^(1/3), a = (3 F R/(4 E*))^(1/3)."""
    load, radius, modulus = 80.0, 0.006, 1e11
    found = point_contact(load, 1.0 / radius, 1.0 / radius, modulus=modulus)
    assert found.pressure == pytest.approx((6.0 * load * modulus**2 / (np.pi**3 * radius**2)) ** (1.0 / 3.0), rel=1e-8)
    assert found.long == pytest.approx((0.75 * load * radius / modulus) ** (1.0 / 3.0), rel=1e-6)


def test_the_ellipse_carries_the_force():
    """F = 2/3 π a b p_0, whichever curvature is given first."""
    found = point_contact(np.asarray([10.0, 300.0]), 20.0, 900.0)
    assert 2.0 / 3.0 * np.pi * found.long * found.short * found.pressure == pytest.approx([10.0, 300.0])
    assert point_contact(10.0, 900.0, 20.0).pressure == pytest.approx(found.pressure[0])


def test_a_slim_ellipse_is_a_line():
    """In the middle of a slim ellipse the pressure is that of a line with the force per length there, 3F/(4a)."""
    found = point_contact(100.0, 1e-6, 500.0)
    line = np.sqrt(0.75 * 100.0 * CONTACT_MODULUS * 500.0 / (np.pi * found.long))
    assert found.pressure == pytest.approx(line, rel=1e-4)
