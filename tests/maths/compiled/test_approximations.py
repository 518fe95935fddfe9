"""Polynomials against forty digits. Bounds are the errors seen on dense grids, rounded up."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest

from cardan.maths.compiled import approximations as near
from tests.builders import polynomials


def exact(function, *arguments):
    with mp.workdps(40):
        return [function(*(mp.mpf(float(x)) for x in row)) for row in zip(*arguments, strict=True)]


def error(found, wanted):
    with mp.workdps(40):
        return float(max(abs(mp.mpf(float(one)) - two) for one, two in zip(found, wanted, strict=True)))


def relative(found, wanted):
    with mp.workdps(40):
        return float(max(abs(mp.mpf(float(one)) / two - 1) for one, two in zip(found, wanted, strict=True) if two != 0))


@pytest.mark.parametrize("name", ["ARCTANGENT", "SINE", "COSINE"])
def test_coefficients_are_those_of_their_builder(name):
    assert getattr(near, name) == polynomials.coefficients()[name]


def test_arctangent():
    u = np.concatenate([np.linspace(-1, 1, 801) * np.tan(np.pi / 8), 10.0 ** -np.arange(1.0, 300, 20)])
    assert relative(near.arctangent(u), exact(mp.atan, u)) < 4e-16
    u = np.linspace(-1, 1, 801)
    assert relative(near.arctangent_unit(u), exact(mp.atan, u)) < 8e-16


def test_argument_of_the_right_half_plane():
    angle = np.concatenate([np.linspace(-1, 1, 801) * 1.5707963, [1e-12, -1e-200]])
    y, x = np.sin(angle), np.cos(angle)
    assert relative(near.argument_right(y, x), exact(mp.atan2, y, x)) < 1.2e-15


def test_argument_all_round_and_on_the_axes():
    angle = np.linspace(-np.pi, np.pi, 1601)
    y, x = 3.0 * np.sin(angle), 3.0 * np.cos(angle)
    assert error(near.argument(y, x), exact(mp.atan2, y, x)) < 4e-15  # what performance demands of arctangents
    y, x = np.asarray([0.0, 1.0, 0.0, -1.0, 1e-300]), np.asarray([1.0, 0.0, -1.0, 0.0, -1e-300])
    np.testing.assert_array_equal(near.argument(y, x), np.arctan2(y, x))


def test_sine_and_cosine():
    r = np.concatenate([np.linspace(-1, 1, 1001) * np.pi / 2, [1e-9, -1e-300]])
    assert relative(near.sine(r), exact(mp.sin, r)) < 6e-16
    assert error(near.cosine(r), exact(mp.cos, r)) < 6e-16


def test_cosine_of_a_bend_keeps_its_digits_near_a_right_angle():
    joint_angle = np.concatenate([np.linspace(0, 1.57, 500), np.pi / 2 - 10.0 ** -np.arange(3.0, 16)])
    assert relative(near.joint_angle_cosine(joint_angle), exact(mp.cos, joint_angle)) < 6e-16
    assert near.joint_angle_cosine(np.asarray(0.0)) == 1.0


def test_reduction_to_half_a_turn():
    rng = np.random.default_rng(1)
    angle = np.concatenate([rng.uniform(-1, 1, 500) * near.LARGEST_ANGLE, np.pi * np.arange(-2000, 2000, 37)])
    reduced = near.within_half_turn(angle)
    assert np.max(np.abs(reduced)) < 1.5707963268
    with mp.workdps(40):
        turns = [(mp.mpf(float(x)) - mp.mpf(float(r))) / mp.pi for x, r in zip(angle, reduced, strict=True)]
        off = max(abs(turn - mp.nint(turn)) * mp.pi for turn in turns)
    assert off < 2.3e-16  # half a unit in the last place of the result
