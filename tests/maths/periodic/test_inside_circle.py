"""Proved stability against Meissner's equation, whose matrices and edges are closed."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq

from cardan.maths.periodic.inside_circle import inside_circle

STIFF, SOFT = 1.0 + 3e-4, 1.0 - 3e-4


def meissner(speed, damping=1e-5):
    """Return the matrices over a period π/speed of x'' + 2n x' + (ω² + n²) x = 0, ω one and another for half of it."""
    speed = np.asarray(speed, dtype=float)
    whole = np.broadcast_to(np.eye(2), (*speed.shape, 2, 2))
    half = 0.5 * np.pi / speed
    for omega in (STIFF, SOFT):
        c, s = np.cos(omega * half), np.sin(omega * half)
        part = np.stack([np.stack([c, s / omega], axis=-1), np.stack([-omega * s, c], axis=-1)], axis=-2)
        whole = part @ whole
    return np.exp(-2.0 * damping * half)[..., None, None] * whole


def largest(matrix, _place=None, _slope=None):
    return np.max(np.abs(np.linalg.eigvals(matrix)), axis=-1)


def edge(a, b):
    return brentq(lambda speed: float(largest(meissner(speed))) - 1.0, a, b, xtol=1e-13)


def everywhere(places):
    return meissner(places), np.ones(places.shape, dtype=bool), np.zeros(places.shape)


def test_a_zone_that_any_grid_misses_is_found_to_its_edges() -> None:
    """It is 4e-4 wide, in a range of 2.5."""
    found = inside_circle(everywhere, 0.55, 3.0, largest=largest, width=1e-8)
    assert found.outside.shape == (1, 2)
    np.testing.assert_allclose(found.outside[0], [edge(0.999, 1.0), edge(1.0, 1.001)], rtol=3e-8)
    assert not len(found.unproved)
    grid = np.setdiff1d(np.linspace(0.55, 3.0, 2451), [1.0])
    assert not np.any(largest(meissner(grid[np.abs(grid - 1.0) > 5e-4])) > 1.0)
    assert found.samples < 300


def test_a_zone_that_damping_closes_is_proved_to_be_closed() -> None:
    def damped(places):
        return meissner(places, 3e-4), np.ones(places.shape, dtype=bool), np.zeros(places.shape)

    found = inside_circle(damped, 0.55, 3.0, largest=largest)
    assert not len(found.outside)
    assert not len(found.unproved)
    assert np.max(largest(meissner(np.linspace(0.999, 1.001, 101), 3e-4))) > 1.0 - 6e-4


@pytest.mark.slow
def test_one_real_eigenvalue_may_be_left_out() -> None:
    """In a basis that hides it; beyond 1 and below, beside vibration that dies out."""
    mixed = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0] @ np.diag([1.0, 1.3, 0.7])

    def sample(places):
        whole = np.zeros((*places.shape, 3, 3))
        whole[..., 0, 0] = 1.0 + 1e-4 * np.sin(3.0 * places)
        whole[..., 1:, 1:] = meissner(places, 2e-3)
        whole[..., 0, 1] = 0.1
        return mixed @ whole @ np.linalg.inv(mixed), np.ones(places.shape, dtype=bool), np.zeros(places.shape)

    def others(matrix, _place, _slope):
        values = np.linalg.eigvals(matrix)
        near = np.argmin(np.where(np.abs(values.imag) < 1e-9, np.abs(values - 1.0), 9.0), axis=-1)
        values[np.arange(len(values)), near] = 0.0
        return np.max(np.abs(values), axis=-1)

    kept = inside_circle(sample, 0.6, 2.0, largest=others, one_apart=True)
    assert not len(kept.outside)
    assert not len(kept.unproved)
    counted = inside_circle(sample, 0.6, 2.0, largest=largest)
    beyond = counted.outside[:, 1] - counted.outside[:, 0]
    assert np.sum(beyond) == pytest.approx(np.pi / 3.0 - 0.6, abs=2e-3)  # where the sine is positive


def test_where_there_is_no_matrix_nothing_is_proved() -> None:
    def sample(places):
        return meissner(places, 3e-4), (places < 1.5) | (places > 1.7), np.zeros(places.shape)

    found = inside_circle(sample, 0.55, 3.0, largest=largest)
    assert found.unproved[0, 0] <= 1.5
    assert found.unproved[-1, 1] >= 1.7
    assert np.sum(found.unproved[:, 1] - found.unproved[:, 0]) < 0.3
    assert np.array_equal(found.unsampled, found.unproved)


def test_a_jump_that_is_known_costs_nothing() -> None:
    def sample(places):
        damping = np.where(places < 1.2345, 3e-4, 6e-4)
        return meissner(places, damping), np.ones(places.shape, dtype=bool), np.zeros(places.shape)

    known = inside_circle(sample, 0.55, 3.0, largest=largest, breaks=(1.2345,))
    assert not len(known.unproved)
    blind = inside_circle(sample, 0.55, 3.0, largest=largest)
    assert blind.unproved.shape == (1, 2)
    assert blind.unproved[0, 0] < 1.2345 < blind.unproved[0, 1]
    assert known.samples < blind.samples


def test_what_was_stopped_is_unproved() -> None:
    found = inside_circle(everywhere, 0.55, 3.0, largest=largest, progress=lambda _share: "stop")
    assert found.stopped
    assert len(found.unproved)


def test_work_that_is_limited_leaves_the_rest_unfinished() -> None:
    """A number that jumps everywhere would be halved for ever; what was not reached is told."""
    jumps = np.random.default_rng(7).uniform(1.0, 3.0, 40)

    def sample(places):
        damping = 3e-4 * (1.0 + 0.5 * (np.searchsorted(np.sort(jumps), places) % 2))
        return meissner(places, damping), np.ones(places.shape, dtype=bool), np.zeros(places.shape)

    found = inside_circle(sample, 0.55, 3.0, largest=largest, most=800)
    assert found.samples <= 800
    assert len(found.unfinished)
    middle = found.unfinished.mean(axis=-1)[:, None]
    assert np.all(np.any((found.unproved[:, 0] < middle) & (middle < found.unproved[:, 1]), axis=-1))
    whole = inside_circle(sample, 0.55, 3.0, largest=largest)
    assert not len(whole.unfinished)
    assert whole.samples > 800
