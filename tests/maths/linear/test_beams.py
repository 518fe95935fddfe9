import itertools

import array_api_strict
import numpy as np
import pytest

from cardan.maths.linear import beams

RNG = np.random.default_rng(11)
AXIS = np.asarray([2.0, -1.0, 0.5]) / np.linalg.norm([2.0, -1.0, 0.5])
PLACE = np.asarray([0.1, 0.7, -0.2, 0.4, 0.7])
FORCE, COUPLE = RNG.normal(size=(2, 5, 3))
END = np.asarray(0.7)


def moment(x):
    """Bending moments at a section by all loads before it, one load at a time."""
    before = (x > PLACE)[:, None]
    whole = COUPLE - (x - PLACE)[:, None] * np.cross(AXIS, FORCE)
    return before * (whole - (whole @ AXIS)[:, None] * AXIS)


def gauss(function, points):
    """Integral of a function with kinks at the points: Gauss's rule is exact for its parabolas."""
    nodes, weights = np.polynomial.legendre.leggauss(4)
    total = 0.0
    for low, high in itertools.pairwise(points):
        for node, weight in zip(nodes, weights, strict=True):
            total = total + 0.5 * (high - low) * weight * function(0.5 * (low + high) + 0.5 * (high - low) * node)
    return total


def test_bending_is_the_integral_of_the_moments():
    direct = gauss(lambda x: moment(x) @ moment(x).T, sorted(PLACE))
    np.testing.assert_allclose(beams.bending(AXIS, PLACE, FORCE, COUPLE, END), direct, atol=1e-14)


@pytest.mark.parametrize("cut", [None, 0.35])
def test_stretching_is_the_integral_of_the_pulls(cut):
    def pull(x):
        other = 0.0 if cut is None else (cut > PLACE) != (x < cut)
        return (x > PLACE) * (FORCE @ AXIS) * (1.0 - other)

    points = sorted([*PLACE, *([] if cut is None else [cut])])
    direct = gauss(lambda x: np.outer(pull(x), pull(x)), points)
    found = beams.stretching(AXIS, PLACE, FORCE, END, None if cut is None else np.asarray(cut))
    np.testing.assert_allclose(found, direct, atol=1e-14)


@pytest.mark.parametrize("cut", [None, 0.35])
def test_a_stepped_beam_is_what_each_step_adds_from_there_on(cut):
    """Gauss's rule over 1/EI(x) = 2, from 0.3 on 5, from 0.6 on 1; the first stretch reaches back without end."""
    steps = [(None, 2.0), (np.asarray(0.3), 3.0), (np.asarray(0.6), -4.0)]
    points = sorted([*PLACE, 0.3, 0.6, *([] if cut is None else [cut])])

    def soft(x):
        return 2.0 if x < 0.3 else 5.0 if x < 0.6 else 1.0

    def pull(x):
        other = 0.0 if cut is None else (cut > PLACE) != (x < cut)
        return (x > PLACE) * (FORCE @ AXIS) * (1.0 - other)

    bent = sum(more * beams.bending(AXIS, PLACE, FORCE, COUPLE, END, since) for since, more in steps)
    np.testing.assert_allclose(bent, gauss(lambda x: soft(x) * moment(x) @ moment(x).T, points), atol=1e-13)
    place = None if cut is None else np.asarray(cut)
    pulled = sum(more * beams.stretching(AXIS, PLACE, FORCE, END, place, since) for since, more in steps)
    np.testing.assert_allclose(pulled, gauss(lambda x: soft(x) * np.outer(pull(x), pull(x)), points), atol=1e-13)


def test_loads_in_balance_do_not_care_where_the_beam_ends():
    # Three forces and a couple: chosen so that force and moment vanish.
    across = np.asarray([0.0, 0.0, 1.0])
    along = np.asarray([1.0, 0.0, 0.0])
    force = np.stack([across, across, across])
    x = np.asarray([0.6, -1.0, 0.4])
    place = np.asarray([0.0, 0.4, 1.0])
    results = [x @ beams.bending(along, place, force, 0 * force, np.asarray(end)) @ x for end in (1.0, 1.5)]
    # Beam of span 1 with a unit force at a, b: deflection a² b²/(3 l).
    np.testing.assert_allclose(results, (0.4 * 0.6) ** 2 / 3, rtol=1e-13)


def test_any_array_library_computes():
    xp = array_api_strict
    given = [xp.asarray(one) for one in (AXIS, PLACE, FORCE, COUPLE, END)]
    np.testing.assert_allclose(
        np.asarray(beams.bending(*given)), beams.bending(AXIS, PLACE, FORCE, COUPLE, END), rtol=1e-12, atol=1e-15
    )
    found = beams.stretching(given[0], given[1], given[2], given[4], xp.asarray(0.3))
    np.testing.assert_allclose(
        np.asarray(found), beams.stretching(AXIS, PLACE, FORCE, END, np.asarray(0.3)), rtol=1e-12, atol=1e-15
    )
