"""Functions of normal, stationary coordinates: mean, deviation, spectrum, and how often a level is crossed.

The coordinates z are independent, normal, of mean 0 and deviation 1, and each has a spectrum of its own. A function of
their values at an instant is asked along rays through the origin: means are integrals over rays and radii, and a level
is crossed where a ray meets it, by the formula of Rice.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from cardan.maths.arrays import Array

from . import paths

REACH = 8.5
"""Radius beyond which no coordinate comes: once in 10¹⁴ of the time."""

RADII = 721, 181
"""Radii looked at with one coordinate, and with several."""

RAYS = 48
"""Rays among two coordinates, evenly spread."""

DRAWN = 128
"""Frames of rays among more coordinates, drawn with their opposites; then means have a standard error."""

STEP = 1e-3
"""Step of a coordinate for the slope of a function."""

LEVELS = 400
"""Levels between which the one crossed at a rate is looked for, and halvings of the step about it."""

BOUND = 1e-6
"""Nearer to its bound than this share of its range, a function has no rare level: it comes there often."""

DEGREE = 4
"""Up to this power of the coordinates the spectrum of a function counts."""

BANDS = 96
"""Steps in the narrowest spectrum of a coordinate."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Grid:
    """Rays and radii at which functions of m coordinates are asked."""

    ray: Array  # (k, m): directions, of length 1
    radius: Array  # (r,)
    weight: Array  # (k, r): of means; they add up to 1
    density: Array  # (r,): probability density of the radius
    drawn: bool  # whether the rays are drawn

    @property
    def places(self) -> Array:
        """The places, array (k·r, m)."""
        return (self.ray[:, None] * self.radius[:, None]).reshape(-1, self.ray.shape[1])


@dataclass(frozen=True, eq=False, kw_only=True)
class Chance:
    """What chance makes of some functions, arrays (c,)."""

    mean: Array
    deviation: Array
    error: Array  # standard error of the mean; 0 where rays are not drawn
    grid: Grid
    value: Array  # (c, k, r): the functions on the grid
    swiftness: Array  # (c, k, r): deviation of their rate [1/s] over their slope along the ray; inf where that is level

    def rate(self, function: int, level: Array) -> Array:
        """Return how often a function rises through levels (l,) on average, array (l,) [1/s].

        ν = E[s δ(g - u)]/√(2π), S. O. Rice, Bell System Technical Journal 24 (1945): s is the deviation of the rate of
        g at a place. Along each ray the sum over where it meets the level.
        """
        value, swift = self.value[function], self.swiftness[function]
        level = np.atleast_1d(np.asarray(level, dtype=float))
        whole = self.grid.weight.sum(axis=-1)
        found = np.zeros(level.shape)
        for k, row in enumerate(value):
            above = row[None, :] > level[:, None]
            i, j = np.nonzero(above[:, 1:] != above[:, :-1])
            share = (level[i] - row[j]) / (row[j + 1] - row[j])
            r = self.grid.radius[j] + share * (self.grid.radius[j + 1] - self.grid.radius[j])
            met = _density(r, self.grid.ray.shape[1]) * (swift[k, j] + share * (swift[k, j + 1] - swift[k, j]))
            np.add.at(found, i, whole[k] * met)
        return found / math.sqrt(2.0 * math.pi)

    def level(self, function: int, rate: float, *, least: bool = False) -> float:
        """Return the highest level, or the lowest, that a function crosses so often on average.

        rate [1/s]: once in the inverse of it; nan where it reaches no level so often, or its bound more often.
        """
        low, high = float(np.min(self.value[function])), float(np.max(self.value[function]))
        inner, outer = bounds = (high, low) if least else (low, high)
        for _round in range(4):
            levels = np.linspace(inner, outer, LEVELS)
            often = np.flatnonzero(self.rate(function, levels) >= rate)
            if not often.size:
                return math.nan
            last = int(often[-1])
            inner, outer = float(levels[last]), float(levels[min(last + 1, LEVELS - 1)])
        return inner if abs(inner - bounds[1]) > BOUND * (high - low) else math.nan


def grid_of(coordinates: int, *, fewer: int = 1) -> Grid:
    """Return the rays and radii for functions of some coordinates.

    fewer: by how much fewer radii, and rays where there are several, do.
    """
    drawn = coordinates > 2
    if coordinates == 1:
        ray = np.asarray([[1.0], [-1.0]])
    elif coordinates == 2:
        angle = np.arange(RAYS // fewer) * (2.0 * np.pi / (RAYS // fewer))
        ray = np.stack((np.cos(angle), np.sin(angle)), axis=-1)
    else:
        # Whole frames of rays at right angles: means of squares are exact.
        frame = np.linalg.qr(np.random.default_rng(0).normal(size=(DRAWN // fewer, coordinates, coordinates)))[0]
        some = frame.reshape(-1, coordinates)
        ray = np.concatenate((some, -some))
    steps = 2 * ((RADII[coordinates > 1] - 1) // (2 * fewer))
    radius = np.linspace(0.0, REACH, steps + 1)
    simpson = np.ones(steps + 1)
    simpson[1:-1:2], simpson[2:-1:2] = 4.0, 2.0
    density = _density(radius, coordinates)
    along = simpson * density
    return Grid(
        ray=ray,
        radius=radius,
        weight=np.full((len(ray), 1), 1.0 / len(ray)) * (along / np.sum(along)),
        density=density,
        drawn=drawn,
    )


def chance(function: Callable[[Array], Array], rates: Sequence[float], grid: Grid) -> Chance:
    """Return mean, deviation and crossings of functions of normal coordinates.

    function: from places (p, m) to values (c, p).
    rates (m,) [rad/s]: deviation of the rate of each coordinate, whose own deviation is 1.

    >>> found = chance(lambda z: z.T**2, [2.0], grid_of(1))
    >>> found.mean.round(9), found.deviation.round(6)
    (array([1.]), array([1.414214]))
    >>> print(f"{found.rate(0, np.asarray([4.0]))[0] / (2 * 2.0 / (2 * math.pi) * math.exp(-2.0)):.4f}")
    1.0000
    """
    places, (k, m) = grid.places, grid.ray.shape
    shape = (k, grid.radius.size)
    value = np.asarray(function(places)).reshape(-1, *shape)
    each = np.sum(grid.weight * value, axis=-1) * k
    mean = np.mean(each, axis=-1)
    spread = np.sum(grid.weight * (value - mean[:, None, None]) ** 2, axis=(-1, -2))
    frames = np.mean((each[:, : k // 2] + each[:, k // 2 :]).reshape(len(value), -1, m), axis=-1) * 0.5
    error = np.std(frames, axis=-1, ddof=1) / math.sqrt(frames.shape[-1]) if grid.drawn else np.zeros(len(value))
    if m == 1:
        swift = np.full(value.shape, float(rates[0]))
    else:
        slopes = [
            (function(places + STEP * unit) - function(places - STEP * unit)).reshape(value.shape) / (2.0 * STEP)
            for unit in np.eye(m)
        ]
        along = sum(slope * grid.ray[:, j, None] for j, slope in enumerate(slopes))
        size = np.sqrt(sum((rate * slope) ** 2 for rate, slope in zip(rates, slopes, strict=True)))
        with np.errstate(divide="ignore", invalid="ignore"):
            swift = np.nan_to_num(size / np.abs(along), nan=0.0, posinf=0.0)
    return Chance(mean=mean, deviation=np.sqrt(spread), error=error, grid=grid, value=value, swiftness=swift)


def spectrum(found: Chance, spectra: Sequence[tuple[Sequence[float], Sequence[float]]]) -> tuple[Array, Array, Array]:
    """Return the one-sided spectra of functions of normal coordinates.

    spectra: corners and densities of the one-sided spectrum of each coordinate, of any scale [rad/s].
    Returns frequency (f,) [rad/s], density (c, f), and the share of the variance that it holds (c,): powers of the
    coordinates up to `DEGREE` count.
    By Mehler's series the covariance is Σ a_n² Π ρ_j^(n_j), with a_n = E[g Π He_(n_j)(z_j)/√(n_j!)].
    """
    top = max(corners[-1] for corners, _density in spectra)
    step = min(top / BANDS, *((corners[-1] - corners[0]) / BANDS for corners, _density in spectra))
    count = math.ceil(DEGREE * top / step) + 1
    size = 2 * count
    at = (np.fft.fftfreq(size) * size) * step
    correlation = []
    for corners, density in spectra:
        mass = paths.two_sided(corners, density, at)
        correlation.append(np.real(np.fft.fft(mass / np.sum(mass))))
    place = found.grid.places.reshape(*found.value.shape[1:], -1)
    basis = [[np.ones(place.shape[:-1]), z] for z in np.moveaxis(place, -1, 0)]
    for row in basis:
        for n in range(1, DEGREE):
            z = row[1]
            row.append((z * row[n] - math.sqrt(n) * row[n - 1]) / math.sqrt(n + 1.0))
    whole, held = np.zeros((len(found.value), size)), np.zeros(len(found.value))
    for powers in product(range(DEGREE + 1), repeat=len(spectra)):
        if not 0 < sum(powers) <= DEGREE:
            continue
        wave = np.prod([row[n] for row, n in zip(basis, powers, strict=True)], axis=0)
        part = np.sum(found.grid.weight * found.value * wave, axis=(-1, -2)) ** 2
        over = np.prod([one**n for one, n in zip(correlation, powers, strict=True)], axis=0)
        whole += part[:, None] * np.real(np.fft.ifft(over))
        held += part
    power = 2.0 * np.maximum(whole[:, :count], 0.0) / step
    variance = found.deviation**2
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(variance > 0.0, held / variance, 1.0)
    return at[:count], power, share


def _density(radius: Array, coordinates: int) -> Array:
    """Return the probability density of the distance from the origin."""
    m = coordinates
    found: Array = radius ** (m - 1) * np.exp(-0.5 * radius**2) / (2.0 ** (0.5 * m - 1.0) * math.gamma(0.5 * m))
    return found
