"""Implicit equations F(t, y, y') = 0 in time: collocation at Radau points, five stages, order nine.

For motions with rates far above those of interest, and where some of the unknowns have no derivative of their own: the
end of a step is a stage, so constraints hold there, and what is fast and damped dies out in one step.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Protocol, TypeAlias

import numpy as np

from cardan.maths.arrays import Array

STAGES = 5

ROUNDS = 12
"""Newton's corrections before a step is tried again shorter."""

SHORTEST = 16.0 * np.finfo(float).eps
"""Steps below this share of the time, or of the whole span, make no way."""


class System(Protocol):
    """Equations F(t, y, y') = 0 and their slopes, at many moments at once."""

    def residual(self, time: Array, y: Array, slope: Array) -> Array:
        """Return F: times (m,), y and y' (m, n) -> (m, n)."""

    def linearised(self, time: Array, y: Array, slope: Array) -> tuple[Array, Array, Array]:
        """Return F (m, n), ∂F/∂y and ∂F/∂y' (m, n, n)."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Tableau:
    """Coefficients of the stages."""

    nodes: Array  # (s,): c
    matrix: Array  # (s, s): a: Y_i = y + h Σ A_ij Y'_j; its last row are the weights of the step
    filter: float  # γ_0, the one real eigenvalue of A
    misses: Array  # (s,): (b - b̂)/γ_0 of the formula of order s that judges the step
    powers: Array  # (s, s): coefficients of the stages' Lagrange polynomials: ℓ_j(θ) = Σ_k powers[k, j] θ^k


@cache
def tableau(stages: int = STAGES) -> Tableau:
    """Return the coefficients of Radau's collocation; an odd number of stages."""
    legendre = np.polynomial.legendre.Legendre
    ends = legendre.basis(stages) - legendre.basis(stages - 1)
    nodes = 0.5 * (1.0 + np.sort(ends.roots().real))
    nodes[-1] = 1.0
    orders = np.arange(stages)
    powers = np.linalg.inv(nodes[:, None] ** orders)
    matrix = (nodes[:, None] ** (orders + 1.0) / (orders + 1.0)) @ powers
    values = np.linalg.eigvals(matrix)
    gamma = float(values[np.argmin(np.abs(values.imag))].real)
    moments = 1.0 / (orders + 1.0)
    moments[0] -= gamma
    other = np.linalg.solve((nodes[:, None] ** orders).T, moments)
    return Tableau(nodes=nodes, matrix=matrix, filter=gamma, misses=(matrix[-1] - other) / gamma, powers=powers)


@dataclass(frozen=True, eq=False, kw_only=True)
class Step:
    """One step, and the polynomial through its stages."""

    start: float  # start, end: times
    end: float
    before: Array  # before, after (n,): y at both
    after: Array  # (n,)
    slopes: Array  # (s, n): y' at the stages

    @property
    def stages(self) -> tuple[Array, Array, Array]:
        """Times (s,) and y (s, n) and y' (s, n) of the stages."""
        form = tableau(len(self.slopes))
        h = self.end - self.start
        return self.start + h * form.nodes, self.before + h * (form.matrix @ self.slopes), self.slopes

    def integral(self, values: Array) -> float:
        """Return the integral over the step of what has these values (s,) at the stages."""
        return float((self.end - self.start) * (tableau(len(self.slopes)).matrix[-1] @ values))

    def at(self, time: Array, values: Array | None = None) -> Array:
        """Return y (m, n) at times (m,) within the step; or the integral from its start of ``values`` (s,)."""
        powers = tableau(len(self.slopes)).powers
        orders = np.arange(len(powers)) + 1.0
        h = self.end - self.start
        theta = (np.asarray(time) - self.start) / h
        weights = (theta[:, None] ** orders / orders) @ powers
        return h * (weights @ values) if values is not None else self.before + h * (weights @ self.slopes)

    def slope(self, time: Array) -> Array:
        """Return y' (m, n) at times (m,) within the step or a little beyond."""
        powers = tableau(len(self.slopes)).powers
        theta = (np.asarray(time) - self.start) / (self.end - self.start)
        return (theta[:, None] ** np.arange(len(powers)) @ powers) @ self.slopes


Scale: TypeAlias = Callable[[Array], Array]
"""From y (n,) to the error allowed in each number (n,)."""


class Radau:
    """Steps of an implicit system, as long as their error allows.

    time: where it begins; y (n,): consistent with the equations that hold no derivative; bound: where it ends.
    scale: error allowed in one step; first: length of the first step that is tried; longest: no step is longer.
    """

    def __init__(
        self,
        system: System,
        time: float,
        y: Array,
        bound: float,
        *,
        scale: Scale,
        first: float,
        longest: float = np.inf,
    ) -> None:
        self.system, self.time, self.y, self.bound, self.scale = system, time, np.asarray(y, dtype=float), bound, scale
        self.length = min(first, longest)
        self.longest = longest
        self.last: Step | None = None
        self.fresh = True
        self.evaluations = 0

    def step(self, upto: float | None = None) -> Step | None:
        """Return the next step and stand at its end; None where no step is short enough.

        upto: end of this step, which is then not judged: a place found inside a step that was.
        """
        form = tableau()
        shortest = SHORTEST * max(abs(self.time), abs(self.bound))
        length = self.length
        while True:
            end = self.bound if self.time + 1.01 * length >= self.bound else self.time + length
            if upto is not None:
                end = upto
            h = end - self.time
            if not h > shortest:
                return None
            slopes, rounds = self._stages(h)
            if slopes is None:
                if upto is not None:
                    return None
                length = 0.25 * h
                self.fresh = True
                continue
            after = self.y + h * (form.matrix[-1] @ slopes)
            error = 0.0 if upto is not None else self._error(h, slopes, after)
            pull = 0.9 * (2.0 * ROUNDS + 1.0) / (2.0 * ROUNDS + rounds)
            factor = pull * max(error, 1e-12) ** (-1.0 / (STAGES + 1))
            if error > 1.0:
                length = h * max(0.1, min(0.9, factor))
                self.fresh = True
                continue
            if upto is None:
                self.length = min(self.longest, h * min(1.0 if self.fresh and error > 0.5 else 5.0, max(0.2, factor)))
                self.fresh = False
            found = Step(start=self.time, end=end, before=self.y, after=after, slopes=slopes)
            self.time, self.y, self.last = end, after, found
            return found

    def _stages(self, h: float) -> tuple[Array | None, int]:
        """Return y' at the stages by Newton's method, and how many corrections that took; None where it fails."""
        form = tableau()
        n = len(self.y)
        times = self.time + h * form.nodes
        slopes = self.last.slope(times) if self.last is not None else np.zeros((STAGES, n))
        allowed = self.scale(self.y)
        size = np.inf
        matrix = None
        rate = 0.0
        for k in range(1, ROUNDS + 1):
            y = self.y + h * (form.matrix @ slopes)
            self.evaluations += 1
            if matrix is None or rate > 0.1:
                left, by_y, by_slope = self.system.linearised(times, y, slopes)
                whole = h * form.matrix[:, None, :, None] * by_y[:, :, None, :]
                whole[np.arange(STAGES), :, np.arange(STAGES), :] += by_slope
                matrix = _inverse(whole.reshape(STAGES * n, STAGES * n))
                if matrix is None:
                    return None, k
            else:
                left = self.system.residual(times, y, slopes)
            change = (matrix @ left.reshape(-1)).reshape(STAGES, n)
            if not np.all(np.isfinite(change)):
                return None, k
            slopes = slopes - change
            before, size = size, _norm(h * change, allowed)
            rate = size / before if before > 0.0 and np.isfinite(before) else 1.0
            if size <= 1e-3 or (k > 1 and rate < 0.5 and size * rate / (1.0 - rate) <= 1e-3):
                return slopes, k
            if k > 2 and rate > 1.5:
                return None, k
        return None, ROUNDS

    def _error(self, h: float, slopes: Array, after: Array) -> float:
        """Return the error of a step over what is allowed: Hairer and Wanner's filtered difference to order s."""
        form = tableau()
        lean = (form.misses @ slopes)[None]
        time = np.asarray([self.time])
        allowed = np.minimum(self.scale(self.y), self.scale(after))
        left, by_y, by_slope = self.system.linearised(time, self.y[None], lean)
        matrix = by_slope[0] / (form.filter * h) + by_y[0]
        try:
            error = -np.linalg.solve(matrix, left[0])
            if self.fresh and _norm(error, allowed) > 1.0:
                left = self.system.residual(time, (self.y + error)[None], lean)
                error = -np.linalg.solve(matrix, left[0])
        except np.linalg.LinAlgError:
            return 2.0
        size = _norm(error, allowed)
        return size if np.isfinite(size) else 1e6


def _inverse(matrix: Array) -> Array | None:
    try:
        return np.linalg.inv(matrix)
    except np.linalg.LinAlgError:
        return None


def _norm(change: Array, allowed: Array) -> float:
    return float(np.sqrt(np.mean((change / allowed) ** 2)))
