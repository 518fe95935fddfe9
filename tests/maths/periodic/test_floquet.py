"""Monodromy matrices against exponentials, Mathieu's boundaries, Hill's matrix and condensed systems."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.special import mathieu_a, mathieu_b

from cardan.maths.periodic.floquet import collocation, monodromy, without_direction
from tests.builders.hill import hill_multipliers


def swinging(rank=3, seed=2, light=()):
    """Return a chain whose stiffness and damping swing, some of its places without mass."""
    rng = np.random.default_rng(seed)
    springs, waves, dampers = (
        rng.uniform(1.0, 4.0, rank + 1),
        rng.uniform(0.1, 0.5, rank + 1),
        rng.uniform(0.05, 0.2, rank + 1),
    )
    masses = np.where(np.isin(np.arange(rank), light), 0.0, rng.uniform(0.5, 1.5, rank))

    def coefficients(share):
        angle = 2.0 * np.pi * share
        mass = masses * (1.0 + 0.2 * np.cos(angle)[:, None])
        stiffness, damping = np.zeros((len(share), rank, rank)), np.zeros((len(share), rank, rank))
        for k in range(rank + 1):
            lever = np.zeros(rank)
            lever[max(k - 1, 0)], lever[min(k, rank - 1)] = 1.0, -1.0 if 0 < k < rank else 1.0
            lever = np.where(np.arange(rank) == (0 if k == 0 else rank - 1), 1.0, 0.0) if k in (0, rank) else lever
            stiffness += (springs[k] * (1.0 + waves[k] * np.cos(angle + k)))[:, None, None] * np.outer(lever, lever)
            held = 0.0 if set(light) & {k - 1, k} else dampers[k]
            damping += held * np.outer(lever, lever)
        return mass[None], damping[None], stiffness[None]

    return coefficients


@pytest.mark.parametrize("stiff", [False, True])
def test_points_of_collocation_integrate_polynomials_exactly(stiff: bool) -> None:
    points, table = collocation(4, stiff=stiff)
    highest = 6 if stiff else 7  # order 2s - 1 and 2s
    for power in range(highest + 1):
        assert table[-1] @ points**power == pytest.approx(1.0 / (power + 1), abs=1e-14)
    for power in range(4):
        np.testing.assert_allclose(table[:-1] @ points**power, points ** (power + 1) / (power + 1), atol=1e-14)


def test_without_swinging_the_matrix_is_an_exponential() -> None:
    rng = np.random.default_rng(1)
    mass = rng.uniform(0.5, 2.0, 2)
    damping, stiffness = 0.1 * np.eye(2), np.asarray([[5.0, -2.0], [-2.0, 3.0]])

    def steady(share):
        one = np.ones((1, len(share), 1))
        return one * mass, one[..., None] * damping, one[..., None] * stiffness

    first = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness / mass[:, None], -damping / mass[:, None]]])
    np.testing.assert_allclose(monodromy(steady, [3.0])[0], expm(3.0 * first), atol=1e-12)


def test_the_order_is_ten() -> None:
    coefficients, exact = swinging(), None
    exact = monodromy(swinging(), [4.0], steps=64)
    errors = [np.max(np.abs(monodromy(coefficients, [4.0], steps=steps) - exact)) for steps in (3, 6)]
    assert errors[0] / errors[1] > 2.0**9


@pytest.mark.parametrize("q", [0.05, 0.7, 3.0])
def test_on_mathieus_boundaries_half_the_trace_is_one(q: float) -> None:
    edges = np.asarray([mathieu_a(0, q), mathieu_b(1, q), mathieu_a(1, q), mathieu_b(2, q), mathieu_a(2, q)])

    def mathieu(share):
        wave = edges[:, None] - 2.0 * q * np.cos(2.0 * np.pi * share)
        one = np.ones((len(edges), len(share), 1))
        return one, 0.0 * one[..., None], wave[..., None, None]

    trace = np.trace(monodromy(mathieu, np.full(5, np.pi)), axis1=1, axis2=2)
    np.testing.assert_allclose(0.5 * trace, [1.0, -1.0, -1.0, 1.0, 1.0], atol=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 3, 4])
def test_hills_matrix_agrees_with_integration(seed: int) -> None:
    coefficients = swinging(seed=seed)
    integrated = np.linalg.eigvals(monodromy(coefficients, [2.5])[0])
    np.testing.assert_allclose(
        np.sort(np.abs(hill_multipliers(coefficients, 2.5, harmonics=16))), np.sort(np.abs(integrated)), atol=1e-9
    )


def test_places_without_mass_act_as_if_condensed() -> None:
    whole = swinging(light=(1,))

    def condensed(share):
        mass, damping, stiffness = whole(share)
        keep = [0, 2]
        across = stiffness[..., keep, :][..., [1]]
        inner = stiffness[..., keep, :][..., keep] - across * across.swapaxes(-1, -2) / stiffness[..., [1], :][..., [1]]
        return mass[..., keep], damping[..., keep, :][..., keep], inner

    found = np.linalg.eigvals(monodromy(whole, [3.0])[0])
    wanted = np.linalg.eigvals(monodromy(condensed, [3.0])[0])
    heavy = found[np.abs(found) > 1e-12]
    assert len(found) == 5  # three places and two speeds
    # Radau's points lose an order or two against those of Gauss.
    np.testing.assert_allclose(np.sort(np.abs(heavy)), np.sort(np.abs(wanted)), atol=1e-9)


def test_a_direction_left_out_leaves_the_other_eigenvalues() -> None:
    rng = np.random.default_rng(8)
    matrix = rng.normal(size=(3, 5, 5))
    values, vectors = np.linalg.eig(matrix)
    one = np.argmin(np.abs(values.imag), axis=-1)  # an odd real matrix has a real one
    direction = np.stack([vectors[k, :, one[k]].real for k in range(3)])
    rest = np.linalg.eigvals(without_direction(matrix, direction))
    for k in range(3):
        wanted = np.delete(values[k], one[k])
        np.testing.assert_allclose(np.sort_complex(rest[k]), np.sort_complex(wanted), atol=1e-10)


def test_nothing_that_may_move_has_no_multipliers() -> None:
    """A drive whose only coordinate is forced: its disturbances are none, not an error."""

    def coefficients(share):
        return np.zeros((2, len(share), 0)), np.zeros((2, len(share), 0, 0)), np.zeros((2, len(share), 0, 0))

    assert monodromy(coefficients, np.asarray([0.5, 0.7])).shape == (2, 0, 0)
