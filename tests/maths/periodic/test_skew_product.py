"""Exponents of products of matrices whose phase goes on by a ratio, against matrices made of known ones."""

from __future__ import annotations

import numpy as np
import pytest

from cardan.maths.periodic.skew_product import exponents, parts_of, tail, turning

RATIO = (np.sqrt(5.0) - 1.0) / 2.0


def turned(angle: np.ndarray) -> np.ndarray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.moveaxis(np.asarray([[cosine, -sine], [sine, cosine]]), -1, 0)


def made(core: np.ndarray, samples: int = 64) -> np.ndarray:
    """Return B(θ + 2πr) core B(θ)⁻¹, B a rotation that swings with θ and a stretch beside it."""
    theta = 2.0 * np.pi * np.arange(samples) / samples

    def base(at: np.ndarray) -> np.ndarray:
        return turned(0.4 * np.sin(at)) * np.exp(0.3 * np.cos(at))[:, None, None]

    return base(theta + 2.0 * np.pi * RATIO) @ core @ np.linalg.inv(base(theta))


def test_exponents_are_those_of_the_matrix_inside() -> None:
    matrices = made(np.diag([1.02, -0.6]))
    found = exponents(matrices[None], RATIO)
    assert found.growth[0] == pytest.approx(np.log([1.02, 0.6]), abs=1e-9)
    assert np.all(np.abs(found.growth - np.log([1.02, 0.6])) <= found.error + 1e-12)
    assert tail(parts_of(matrices[None]))[0] < 1e-9


def test_a_pair_that_swings_has_one_exponent_and_its_angle() -> None:
    matrices = made(0.99 * turned(np.asarray([0.7]))[0])
    found = exponents(matrices[None], RATIO)
    assert found.growth[0] == pytest.approx([np.log(0.99)] * 2, abs=1e-6)
    values, off = turning(matrices, RATIO)
    nearest = values[np.argsort(off)[:2]]
    assert np.abs(nearest) == pytest.approx([0.99] * 2, rel=1e-6)
    assert np.abs(np.angle(nearest)) == pytest.approx([0.7] * 2, rel=1e-6)
