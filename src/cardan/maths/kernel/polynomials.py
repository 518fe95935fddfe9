"""Polynomials in batches, coefficients from the constant one up along the last axis."""

from __future__ import annotations

import numpy as np

from cardan.maths.arrays import Array


def polynomial(*coefficients: Array) -> Array:
    """Return the polynomial with these coefficients, the constant one first."""
    return np.stack(np.broadcast_arrays(*coefficients), axis=-1)


def added(one: Array, other: Array) -> Array:
    """Return the sum of two polynomials."""
    size = max(one.shape[-1], other.shape[-1])
    total = np.zeros((*np.broadcast_shapes(one.shape[:-1], other.shape[:-1]), size))
    total[..., : one.shape[-1]] += one
    total[..., : other.shape[-1]] += other
    return total


def product(one: Array, other: Array) -> Array:
    """Return the product of two polynomials."""
    outer = np.broadcast_shapes(one.shape[:-1], other.shape[:-1])
    total = np.zeros((*outer, one.shape[-1] + other.shape[-1] - 1))
    for k in range(one.shape[-1]):
        total[..., k : k + other.shape[-1]] += one[..., k, None] * other
    return total


def derivative(one: Array) -> Array:
    """Return the derivative."""
    found: Array = one[..., 1:] * np.arange(1, one.shape[-1])
    return found


def roots(one: Array) -> Array:
    """Return all roots, complex; the leading coefficient must not be 0. Eigenvalues of the companion matrix."""
    degree = one.shape[-1] - 1
    companion = np.zeros((*one.shape[:-1], degree, degree))
    companion[..., np.arange(1, degree), np.arange(degree - 1)] = 1.0
    companion[..., -1] = -one[..., :-1] / one[..., -1:]
    found: Array = np.linalg.eigvals(companion).astype(complex)
    return found
