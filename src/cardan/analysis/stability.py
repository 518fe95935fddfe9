"""Is steady running stable? Floquet multipliers of torsional models, their kind, and the zone that comes nearest."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.floquet import Coefficients, monodromy, without_direction
from cardan.texts import _

from .orbit import Orbit
from .steady_result import SteadyResponse
from .steady_start import straight_frequencies
from .torsional_balance import slopes

NEUTRAL = 1e-8
"""A multiplier this close to modulus 1 neither grows nor dies out."""

LOOSE = 1e-6
"""A second multiplier of a free drive this close to 1 says that it may turn at any speed."""

ZONES = 4
"""Zones that are named: m = 1 … 4."""

CHUNK = 64
"""Drives whose periods are integrated at once."""


class Verdict(IntEnum):
    """What becomes of a small disturbance."""

    STABLE = 0
    NEUTRAL = 1
    UNSTABLE = 2
    UNKNOWN = 3
    """No steady motion was found."""


class Kind(IntEnum):
    """How the disturbance that dies out slowest, or grows fastest, swings."""

    REPEATING = 0
    """Real and positive multiplier: the disturbance repeats with the period."""
    DOUBLING = 1
    """Real and negative multiplier: it repeats with two periods."""
    COMBINATION = 2
    """Pair of complex multipliers: it has a frequency of its own. Where it grows, two modes combine."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Zone:
    """Zone of parametric resonance nearest to the speed, by the natural frequencies of the straight drive.

    Attributes
    ----------
    modes : array of int (..., 2)
        Numbers of the two modes from 1, alike for a zone of one mode; 0 where there is none.
    sign : array of int (...)
        1 for the sum of their frequencies, -1 for the difference.
    multiple : array of int (...)
        m: how many swings of the parameters the frequency holds.
    speed : array (...) [rad/s]
        (ω_i ± ω_j)/m over the swings of the parameters in a radian of shaft angle.
    """

    modes: Array
    sign: Array
    multiple: Array
    speed: Array

    def name(self, index: tuple[int, ...] = ()) -> str:
        """Return the name of one of the zones."""
        i, j = (int(one) for one in self.modes[index])
        m = int(self.multiple[index])
        if i == 0:
            return _("none")
        if i == j:
            text = _("principal zone of mode {i}") if m == 1 else _("zone {m} of mode {i}")
        else:
            text = _("sum of modes {i} and {j}") if int(self.sign[index]) > 0 else _("difference of modes {j} and {i}")
            text = text if m == 1 else text + _(", zone {m}")
        return text.format(i=i, j=j, m=m)


@dataclass(frozen=True, eq=False, kw_only=True)
class Floquet:
    """Stability of steady running; leading axes (...) are those of the drives and speeds.

    Attributes
    ----------
    multipliers : array (..., m), complex
        What each disturbance is multiplied by over a period, the largest first. Of a free drive the 1 of a shift in
        time is left out, and a second 1 where any speed is possible (then nan stands at the end).
    removed : array of int (...)
        How many were left out.
    period : float [rad]
        Shaft angle of a period.
    growth_rate : array (...) [1/s]
        ln max|ρ| over the duration of a period; negative where disturbances die out.
    verdict : array of int (...)
        A `Verdict` each.
    kind : array of int (...)
        A `Kind` each, of the largest multiplier.
    order : array (...)
        Lowest order of the shaft at which that disturbance swings; the others differ by whole multiples of 2π/period,
        either way.
    zone : Zone
        Nearest zone, of that kind where the disturbance grows.
    determinant_residual : array (...)
        ln of the product of all multipliers less the integral of the damping, which must be equal (Liouville).
    """

    multipliers: Array
    removed: Array
    period: float
    growth_rate: Array
    verdict: Array
    kind: Array
    order: Array
    zone: Zone
    determinant_residual: Array

    @property
    def modulus(self) -> Array:
        """|ρ|, the largest first, array (..., m)."""
        return np.abs(self.multipliers)

    @property
    def spectral_radius(self) -> Array:
        """Largest |ρ|, array (...)."""
        return self.modulus[..., 0]

    @property
    def stable(self) -> Array:
        """Whether every disturbance dies out, array of bool (...)."""
        return self.verdict == Verdict.STABLE


def floquet(response: SteadyResponse | Orbit) -> Floquet:
    """Return whether steady running is stable.

    Parameters
    ----------
    response : SteadyResponse or Orbit (...)
        As `periodic_response` gives it.

    Returns
    -------
    Floquet

    Notes
    -----
    The balance linearised about the motion, M δq̈ + C δq̇ + K δq = 0 with K holding the torque that the drive carries,
    integrated over a period; the eigenvalues of the matrix that maps the disturbance at its beginning to that at its
    end.

    Examples
    --------
    >>> from .steady import periodic_response
    >>> from .torsional_model import torsional_line
    >>> drive = torsional_line([[1.0, 0.01], [0.4]], stiffness=[[1000.0], []], damping=[[0.2], []],
    ...     bend=[np.radians(25)], input_speed=49.386)
    >>> found = floquet(periodic_response(drive))
    >>> found.modulus, found.zone.name()
    (array([1.14415176, 0.84726756]), 'principal zone of mode 1')
    """
    orbit = response.orbit if isinstance(response, SteadyResponse) else response
    lead, count = orbit.lead, orbit.count
    there = np.isfinite(orbit.coefficient).all(axis=(-1, -2)).reshape(-1)
    order = np.argsort(-orbit.time.reshape(-1), kind="stable")
    order = order[there[order]]
    free = orbit.model.free
    parts: list[tuple[Array, Array, Array, Array]] = []
    for first in range(0, len(order), CHUNK):
        rows = order[first : first + CHUNK]
        parts.append((rows, *_multipliers(orbit, rows)))
    width = max((part[1].shape[-1] for part in parts), default=0)
    multipliers = np.full((count, width), np.nan + 0j)
    removed, residual = np.zeros(count, dtype=int), np.full(count, np.nan)
    frequencies = straight_frequencies(orbit.drives(np.arange(count)))
    for rows, values, gone, missed in parts:
        multipliers[rows], removed[rows], residual[rows] = values, gone, missed
    return _judged(orbit, multipliers, removed, residual, frequencies[:, 1:] if free else frequencies, there, lead)


def _multipliers(orbit: Orbit, rows: Array) -> tuple[Array, Array, Array]:
    """Return the multipliers of some drives, how many were left out, and the residual of their product."""
    drives = orbit.drives(rows)
    omega = orbit.speed.reshape(-1)[rows]
    duration = orbit.period / np.abs(omega)
    first = 0 if drives.free else 1
    forward = np.where(omega < 0.0, -orbit.period, orbit.period)
    turned = bool(np.any(omega < 0.0))

    def coefficients(share: Array) -> tuple[Array, Array, Array]:
        q, rate, acceleration = orbit.of(rows, share * orbit.period)
        if turned:  # the phase runs backwards where the shaft does
            back = orbit.of(rows, -share * orbit.period)
            mask = (forward < 0.0)[:, None, None]
            q, rate, acceleration = (np.where(mask, b, a) for a, b in zip((q, rate, acceleration), back, strict=True))
        found = slopes(drives, q, rate, acceleration)
        return found.mass[..., first:], found.damping[..., first:, first:], found.stiffness[..., first:, first:]

    matrix = monodromy(coefficients, duration)
    residual = _liouville(coefficients, duration, matrix)
    removed = np.zeros(len(rows), dtype=int)
    if drives.free:
        _q, rate, acceleration = (one[:, 0] for one in orbit.of(rows, [0.0]))
        heavy = np.any(coefficients(np.linspace(0.0, 1.0, 5))[0] != 0.0, axis=(0, 1))
        matrix = without_direction(matrix, np.concatenate([rate, acceleration[:, heavy]], axis=-1))
        removed += 1
    values: Array = np.linalg.eigvals(matrix)
    if drives.free:
        near = np.abs(values - 1.0)
        best = np.argmin(near, axis=-1)
        loose = near[np.arange(len(rows)), best] < LOOSE
        values[np.flatnonzero(loose), best[loose]] = np.nan
        removed += loose
    size = np.where(np.isfinite(values), np.abs(values), -1.0)
    values = np.take_along_axis(values, np.argsort(-size, axis=-1, kind="stable"), axis=-1)
    return values, removed, residual


def _liouville(coefficients: Coefficients, duration: Array, matrix: Array) -> Array:
    """Return ln det of the monodromy matrix plus the integral of tr C/M, nan where a coordinate has no mass."""
    share = (np.arange(128) + 0.5) / 128
    mass, damping, _stiffness = coefficients(share)
    if np.any(mass == 0.0):
        return np.full(len(duration), np.nan)
    lost = np.mean(np.einsum("bprr,bpr->bp", damping, 1.0 / mass), axis=-1) * duration
    return np.linalg.slogdet(matrix)[1] + lost


def _judged(
    orbit: Orbit,
    multipliers: Array,
    removed: Array,
    residual: Array,
    frequencies: Array,
    there: Array,
    lead: tuple[int, ...],
) -> Floquet:
    """Return what the multipliers say."""
    first = multipliers[:, 0] if multipliers.shape[-1] else np.zeros(len(multipliers), dtype=complex)
    radius = np.abs(first)
    verdict = np.where(radius > 1.0 + NEUTRAL, Verdict.UNSTABLE, np.where(radius < 1.0 - NEUTRAL, 0, Verdict.NEUTRAL))
    verdict = np.where(there, verdict, Verdict.UNKNOWN)
    plain = np.abs(first.imag) <= 1e-7 * radius
    kind = np.where(plain, np.where(first.real < 0.0, Kind.DOUBLING, Kind.REPEATING), Kind.COMBINATION)
    wanted = np.where(verdict == Verdict.UNSTABLE, kind, -1)
    with np.errstate(divide="ignore"):
        growth = np.log(radius) / orbit.time.reshape(-1)
    return Floquet(
        multipliers=multipliers.reshape(*lead, -1),
        removed=removed.reshape(lead),
        period=orbit.period,
        growth_rate=growth.reshape(lead),
        verdict=verdict.reshape(lead),
        kind=kind.reshape(lead),
        order=(np.abs(np.angle(first)) / orbit.period).reshape(lead),
        zone=nearest_zone(frequencies, np.abs(orbit.speed.reshape(-1)), orbit.period, wanted, lead),
        determinant_residual=residual.reshape(lead),
    )


def nearest_zone(frequencies: Array, speed: Array, period: float, kind: Array, lead: tuple[int, ...]) -> Zone:
    """Return the zone of parametric resonance nearest to each speed.

    Parameters
    ----------
    frequencies : array (b, n) [rad/s]
        Natural ones of the straight drives.
    speed : array (b,) [rad/s]
    period : float [rad]
        Shaft angle after which the parameters repeat.
    kind : array of int (b,)
        `Kind` of the disturbance that grows: zones of one mode or combinations of two; -1 where none does, for zones
        of one mode and sums of two, none higher than the second.
    lead : tuple of int
        Axes of the result.

    Notes
    -----
    Ω = (ω_i ± ω_j)/(m ν), ν = 2π/period the order of the parameters; i = j with the sum alone.
    """
    count = frequencies.shape[-1]
    pairs = [(i, j, 1) for i in range(count) for j in range(i, count)]
    pairs += [(i, j, -1) for i in range(count) for j in range(i + 1, count)]
    choices = [(i, j, sign, m) for i, j, sign in pairs for m in range(1, ZONES + 1)]
    if not choices:
        nothing = np.zeros(lead, dtype=int)
        return Zone(modes=np.zeros((*lead, 2), dtype=int), sign=nothing, multiple=nothing, speed=np.full(lead, np.nan))
    table = np.asarray(choices)
    i, j, sign, m = table.T
    where = np.abs(frequencies[:, i] + sign * frequencies[:, j]) * period / (2.0 * np.pi * m)
    grows = (kind == Kind.COMBINATION)[:, None] == (i != j)
    fitting = np.where((kind < 0)[:, None], (sign > 0) & (m <= 2), grows)
    far = np.where(fitting, np.abs(where - speed[:, None]), np.inf)
    best = np.argmin(far, axis=-1)
    none = ~np.isfinite(far[np.arange(len(far)), best])
    return Zone(
        modes=np.where(none[:, None], 0, table[best][:, :2] + 1).reshape(*lead, 2),
        sign=sign[best].reshape(lead),
        multiple=m[best].reshape(lead),
        speed=np.where(none, np.nan, where[np.arange(len(where)), best]).reshape(lead),
    )
