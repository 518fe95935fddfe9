"""Is steady running stable? Floquet multipliers of torsional models, their kind, and the zone that comes nearest."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields, replace
from enum import IntEnum

import numpy as np

from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.periodic.floquet import STAGES, Coefficients, collocation, monodromy, propagators, without_direction
from cardan.maths.periodic.harmonics import HarmonicBalance, Status, harmonic_balance
from cardan.maths.periodic.switching_orbit import Pieces, periodic_pieces
from cardan.questions.torsion.model.torsional_balance import slopes
from cardan.questions.torsion.model.torsional_layouts import Turning
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.model.torsional_modes import base_order
from cardan.texts import _

from .orbit import Backlashed, Orbit, straight_frequencies, straight_stiffness
from .steady_result import SteadyResponse

NEUTRAL = 1e-7
"""A multiplier this close to modulus 1 neither grows nor dies out."""

ZONES = 4
"""Zones that are named: m = 1 … 4, twice as many where joints swing once a turn."""

SECOND = 4.0
"""Highest order of the joints whose zones count where nothing grows."""


class Verdict(IntEnum):
    """What becomes of a small disturbance."""

    STABLE = 0
    NEUTRAL = 1
    UNSTABLE = 2
    UNKNOWN = 3
    """No steady motion was found."""


def verdict_words() -> tuple[str, ...]:
    """Return what people are told of each `Verdict`."""
    return (_("stable"), _("neutral"), _("unstable"), _("unknown"))


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
    """Zone of parametric resonance nearest to the speed, by the natural frequencies of the straight drive."""

    # (..., 2) of int: numbers of the two modes from 1, alike for a zone of one mode; 0 where there is none
    modes: Array
    sign: Array  # (...) of int: 1 for the sum of their frequencies, -1 for the difference
    # (...) of int: m: number of the zone, the principal one is 1; 0 where torques whose order does not repeat make what
    # no zone of the joints does: the speed is then that of the drive
    multiple: Array
    speed: Array  # (...) [rad/s]: (ω_i ± ω_j)/(2m), or (ω_i ± ω_j)/m where joints swing once a turn

    @property
    def by_torques(self) -> Array:
        """Whether torques whose order does not repeat make a disturbance grow that would not without them (...)."""
        return (self.multiple == 0) & np.isfinite(self.speed)

    def name(self, index: tuple[int, ...] = ()) -> str:
        """Return the name of one of the zones."""
        if self.by_torques[index]:
            return _("torques of an order that does not repeat")
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
    """Stability of steady running; leading axes (...) are those of the drives and speeds."""

    # (..., m), complex: what each disturbance is multiplied by over a period, the largest first; nan at the end where
    # it is left out. So are of a free drive the 1 of a shift in time and, where no torque changes with the speed, the
    # drift to another speed; of any drive what has neither inertia nor damper, which cannot be disturbed by itself.
    multipliers: Array
    removed: Array  # (...) of int: how many were left out of a free drive
    period: float  # [rad]: shaft angle of a period
    # (...) [1/s]: ln max|ρ| over the duration of a period; negative where disturbances die out, -inf where there are
    # none
    growth_rate: Array
    verdict: Array  # (...) of int: a `Verdict` each
    kind: Array  # (...) of int: a `Kind` each, of the largest multiplier
    # (...): lowest order of the shaft at which that disturbance swings; the others differ by whole multiples of
    # 2π/period, either way
    order: Array
    zone: Zone  # nearest zone, of that kind where the disturbance grows
    # (...): ln of the product of all multipliers less the integral of the damping, which must be equal (Liouville)
    determinant_residual: Array

    @property
    def modulus(self) -> Array:
        """|ρ|, the largest first, array (..., m)."""
        return np.abs(self.multipliers)

    @property
    def spectral_radius(self) -> Array:
        """Largest |ρ|, array (...); not a number where nothing can be disturbed, and where no motion was found."""
        if not self.multipliers.shape[-1]:
            return np.full(self.multipliers.shape[:-1], np.nan)
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
    end. A free drive may run a moment later. Where no torque changes with the speed it may run at any other one too,
    but for what vibration takes, and a drive that nothing governs drifts up or down; the mean speed is given here, so
    something governs it, and such a drift is no vibration. It is a real multiplier above 1 where the torque that
    keeps the mean speed falls as that rises, as above a resonance: of several that which the slope of the torque makes;
    where it rises, what is above 1 is a jump.

    Examples
    --------
    >>> from .steady import periodic_response
    >>> from cardan.questions.torsion.model.torsional_model import torsional_line
    >>> drive = torsional_line([[1.0, 0.01], [0.4]], stiffness=[[1000.0], []], damping=[[0.2], []],
    ...     joint_angle=[np.radians(25)], input_speed=49.386)
    >>> found = floquet(periodic_response(drive))
    >>> found.modulus, found.zone.name()
    (array([1.14415176, 0.84726756]), 'principal zone of mode 1')
    """
    orbit = response.orbit if isinstance(response, SteadyResponse) else response
    angle_error, count = orbit.angle_error, orbit.count
    there = np.isfinite(orbit.coefficient).all(axis=(-1, -2)).reshape(-1)
    smooth = np.asarray([there[k] and k not in orbit.pieces for k in range(count)])
    order = np.argsort(-orbit.time.reshape(-1), kind="stable")
    order = order[smooth[order]]
    parts: list[tuple[Array, Array, Array, Array]] = []
    for first in range(0, len(order), CHUNK):
        rows = order[first : first + CHUNK]
        parts.append((rows, *multipliers_of(orbit, rows)))
    for row in orbit.pieces:
        parts.append((np.asarray([row]), *multipliers_in_pieces(orbit, row)))
    width = max((part[1].shape[-1] for part in parts), default=0)
    multipliers = np.full((count, width), np.nan + 0j)
    removed, residual = np.zeros(count, dtype=int), np.full(count, np.nan)
    frequencies = straight_frequencies(orbit.drives(np.arange(count)))
    for rows, values, gone, missed in parts:
        multipliers[rows], removed[rows], residual[rows] = values, gone, missed
    frequencies = frequencies[:, 1:] if orbit.model.free else frequencies
    found = judged(
        multipliers,
        removed,
        residual,
        frequencies,
        orbit.speed.reshape(-1),
        orbit.period,
        there,
        base=base_order(orbit.model),
    )
    if orbit.model.rubs:  # without its friction a sum may grow; with it nobody knows
        grows = smooth & (found.verdict == Verdict.UNSTABLE)
        found = replace(found, verdict=np.where(grows, Verdict.UNKNOWN, found.verdict))
    return shaped(found, angle_error)


def judged(
    multipliers: Array,
    removed: Array,
    residual: Array,
    frequencies: Array,
    speed: Array,
    period: float,
    there: Array,
    neutral: float | Array = NEUTRAL,
    base: float = 2.0,
) -> Floquet:
    """Return what multipliers (b, m) of drives say, known to ``neutral``, where a motion is there; see `Floquet`.

    base: order of which those of the joints are multiples.
    """
    first = multipliers[:, 0] if multipliers.shape[-1] else np.zeros(len(multipliers), dtype=complex)
    first = np.where(there, np.where(np.isfinite(first), first, 0.0), np.nan)
    radius, omega = np.abs(first), np.abs(speed)
    verdict = np.where(radius > 1.0 + neutral, Verdict.UNSTABLE, np.where(radius < 1.0 - neutral, 0, Verdict.NEUTRAL))
    verdict = np.where(there, verdict, Verdict.UNKNOWN)
    plain = np.abs(first.imag) <= 1e-7 * radius
    kind = np.where(plain, np.where(first.real < 0.0, Kind.DOUBLING, Kind.REPEATING), Kind.COMBINATION)
    wanted = np.where(verdict == Verdict.UNSTABLE, kind, -1)
    with np.errstate(divide="ignore"):
        growth = np.log(radius) * omega / period
    return Floquet(
        multipliers=multipliers,
        removed=removed,
        period=period,
        growth_rate=growth,
        verdict=verdict,
        kind=kind,
        order=np.abs(np.angle(first)) / period,
        zone=nearest_zone(frequencies, omega, wanted, base),
        determinant_residual=residual,
    )


def shaped(found: Floquet, outer: tuple[int, ...]) -> Floquet:
    """Return the same with the axes ``angle_error`` in place of the first one."""

    def whole(values: Array) -> Array:
        return values.reshape((*outer, *values.shape[1:]))

    zone = Zone(**{one.name: whole(getattr(found.zone, one.name)) for one in fields(Zone)})
    rest = {one.name: getattr(found, one.name) for one in fields(Floquet) if one.name not in ("zone", "period")}
    return Floquet(zone=zone, period=found.period, **{name: whole(values) for name, values in rest.items()})


def replaced(known: Floquet, rows: Array, others: Floquet, own: Array) -> Floquet:
    """Return the same with what is said of some other motions (n,) in place of that of some rows.

    rows (k,) of int: counted through the leading axes; own (k,) of int: which of the others.
    """

    def put(values: Array, new: Array) -> Array:
        flat = np.array(values).reshape(known.verdict.size, *values.shape[known.verdict.ndim :])
        if flat.dtype.kind == "c":
            flat, new = as_wide(flat, new)
        flat[rows] = new[own]
        return flat

    zone = Zone(
        **{one.name: put(getattr(known.zone, one.name), getattr(others.zone, one.name)) for one in fields(Zone)}
    )
    names = [one.name for one in fields(Floquet) if one.name not in ("zone", "period")]
    flat = {name: put(getattr(known, name), getattr(others, name)) for name in names}
    return shaped(replace(known, zone=zone, **flat), known.verdict.shape)


def as_wide(one: Array, other: Array) -> tuple[Array, Array]:
    """Return multipliers (a, m) and (b, k) of motions, of which one may have more than the other: nan at the end."""
    wide = max(one.shape[-1], other.shape[-1])
    first, second = (
        np.pad(each, ((0, 0), (0, wide - each.shape[-1])), constant_values=np.nan) for each in (one, other)
    )
    return first, second


def joined(one: Floquet, other: Floquet, order: Array) -> Floquet:
    """Return what is said of motions (a,) and of others (b,) in an order of all of them, array of int (a + b,)."""

    def both(values: Array, others: Array) -> Array:
        if values.dtype.kind == "c":
            values, others = as_wide(values, others)
        whole: Array = np.concatenate([values, others])[order]
        return whole

    zone = Zone(**{f.name: both(getattr(one.zone, f.name), getattr(other.zone, f.name)) for f in fields(Zone)})
    names = [f.name for f in fields(Floquet) if f.name not in ("zone", "period")]
    return Floquet(
        zone=zone, period=one.period, **{name: both(getattr(one, name), getattr(other, name)) for name in names}
    )


def nearest_zone(frequencies: Array, speed: Array, kind: Array, base: float = 2.0) -> Zone:
    """Return the zone of parametric resonance nearest to each speed.

    frequencies (b, n) [rad/s]: natural ones of the straight drives; speed (b,) [rad/s].
    kind (b,) of int: `Kind` of the disturbance that grows: zones of one mode or combinations of two; -1 where none
    does, for zones of one mode and sums of two, none higher than that at which order `SECOND` stirs them.
    base: order ν of which those of the joints are multiples, 2 of cross joints: Ω = (ω_i ± ω_j)/(mν), i = j with the
    sum alone.
    """
    count, rows = frequencies.shape[-1], np.arange(len(speed))
    pairs = [(i, j, 1) for i in range(count) for j in range(i, count)]
    pairs += [(i, j, -1) for i in range(count) for j in range(i + 1, count)]
    choices = [(i, j, sign, m) for i, j, sign in pairs for m in range(1, round(2.0 * ZONES / base) + 1)]
    if not choices:
        nothing = np.zeros(len(speed), dtype=int)
        modes = np.zeros((len(speed), 2), dtype=int)
        return Zone(modes=modes, sign=nothing, multiple=nothing, speed=np.full(len(speed), np.nan))
    table = np.asarray(choices)
    i, j, sign, m = table.T
    where = np.abs(frequencies[:, i] + sign * frequencies[:, j]) / (base * m)
    grows = (kind == Kind.COMBINATION)[:, None] == (i != j)
    fitting = np.where((kind < 0)[:, None], (sign > 0) & (base * m <= SECOND), grows)
    far = np.where(fitting, np.abs(where - speed[:, None]), np.inf)
    best = np.argmin(far, axis=-1)
    none = ~np.isfinite(far[rows, best])
    return Zone(
        modes=np.where(none[:, None], 0, table[best][:, :2] + 1),
        sign=sign[best],
        multiple=m[best],
        speed=np.where(none, np.nan, where[rows, best]),
    )


# What a small disturbance of steady running is multiplied by over a period; turning as a whole apart from it.

CHUNK = 64
"""Drives whose periods are integrated at once."""

REAL = 2e-3
"""Imaginary part, over the modulus, up to which a multiplier is real: two of 1 are apart by the root of their error."""

SLOW, BESIDE = 0.02, 0.5
"""Growth within a period up to which the only real multiplier above this second number is the drift without a look."""

CLOSE = 2e-3
"""How far from 1 a multiplier may be the drift whatever the slope of the torque says."""

ASIDE = 2e-4
"""Share of the speed by which the torque that keeps it is looked at on either side."""

PANELS = 24
"""Panels of a period over which damping is integrated, each by as many points as a step of the disturbance has."""

FADED = 20.0
"""What has died out by e to this power over a period leaves no digits to check."""


def multipliers_of(orbit: Orbit, rows: Array) -> tuple[Array, Array, Array]:
    """Return the multipliers of motions, how many were left out of free drives, and the residual of their product.

    orbit (...); rows (b,) of int: which drives, counted through the leading axes.
    Returns values (b, m), complex: the largest first; nan at the end where one is left out; removed (b,) of int;
    residual (b,): ln of their product less the integral of the damping; nan where that says nothing.
    """
    coefficients, duration = linear_motion(orbit, rows), orbit.time.reshape(-1)[rows]
    matrix = monodromy(coefficients, duration)
    residual = liouville(coefficients, duration, matrix)
    mass, damping, _stiffness = coefficients(np.linspace(0.0, 1.0, 5))
    heavy = np.any(mass != 0.0, axis=(0, 1))
    values, removed = _values(orbit, rows, matrix, heavy)
    return without_last(values, unmoved(damping, heavy)), removed, residual


def multipliers_in_pieces(orbit: Orbit, row: int) -> tuple[Array, Array, Array]:
    """Return the same of one motion in pieces; its residual is nan.

    orbit (...); row: which drive, one of those in pieces.
    """
    pieces, alone = orbit.pieces[row], np.asarray([row])
    values, removed = _values(orbit, alone, monodromy_in_pieces(orbit, row)[None], pieces.heavy)
    if not pieces.heavy.all():
        switching = _disturbed(orbit, row)
        time, _weight, x, v, a = (one[:, :1] for one in pieces.points)
        damping = switching.at(pieces.sides, pieces.omega * time, x, v, a)[0].damping
        values = without_last(values, unmoved(damping.swapaxes(0, 1), pieces.heavy))
    return values, removed, np.full(1, np.nan)


def monodromy_in_pieces(orbit: Orbit, row: int) -> Array:
    """Return what a disturbance (x, ẋ) of a motion in pieces becomes over a period, array (m, m).

    orbit (...); row: which drive, one of those in pieces. Where disturbances are damped otherwise than the motion, the
    steps between the switches are those of their damping; at a switch they jump as the motion bends there.
    """
    pieces = orbit.pieces[row]
    if orbit.model.disturbed_damping is None:
        return pieces.monodromy
    switching, heavy = _disturbed(orbit, row), pieces.heavy
    time, _weight, x, v, a = pieces.points
    by = switching.at(pieces.sides, pieces.omega * time, x, v, a)[0]
    steps = propagators(by.mass[:, None], by.damping[:, None], by.stiffness[:, None], heavy, np.diff(pieces.time))[:, 0]
    whole = np.eye(steps.shape[-1])
    last = len(steps) - 1
    changes = np.any(pieces.sides[1:] != pieces.sides[:-1], axis=-1)
    for k in range(len(steps)):
        whole = steps[k] @ whole
        if k < last and changes[k]:
            whole = _jump(switching, pieces, k) @ whole
    return whole


def _jump(switching: Backlashed, pieces: Pieces, step: int) -> Array:
    """Return by what a disturbance is multiplied at the switch behind a step: it comes so much sooner or later."""
    heavy, when = pieces.heavy, pieces.time[step + 1]
    here = np.asarray([step, step + 1])
    since = np.asarray([when - pieces.time[step], 0.0])
    x, v, a = pieces.inside(here, since)
    rate = np.concatenate([v, a[:, heavy]], axis=-1)
    _twist, by_x, by_phase = switching.twist(np.asarray([pieces.omega * when]), x[:1])
    passing = np.flatnonzero(pieces.sides[step] != pieces.sides[step + 1])[0]
    slope = np.zeros(rate.shape[-1])
    slope[: len(heavy)] = by_x[0, passing]
    speed = float(slope @ rate[0] + pieces.omega * by_phase[0, passing])
    found: Array = np.eye(len(slope)) + np.outer(rate[1] - rate[0], slope) / speed
    return found


def _disturbed(orbit: Orbit, row: int) -> Backlashed:
    """Return a drive as an oscillator that switches, with the damping that disturbances meet."""
    part = orbit.turning.part(np.asarray([row]))
    return Backlashed(Turning(part.model.of_disturbances, part.angle_error, part.speed, part.period))


def linear_motion(orbit: Orbit, rows: Array) -> Coefficients:
    """Return mass, damping and stiffness of the free coordinates about motions, over the share of their period.

    orbit (...); rows (b,) of int: which drives, counted through the leading axes. Dry friction that slips damps no
    disturbance; where it sticks a sum wriggles about its band, and nothing is counted on.
    """
    drives = replace(orbit.drives(rows).of_disturbances, friction=None)
    backward = (orbit.speed.reshape(-1)[rows] < 0.0)[:, None, None]
    first = 0 if drives.free else 1

    def coefficients(share: Array) -> tuple[Array, Array, Array]:
        motion = orbit.of(rows, share * orbit.period)
        if np.any(backward):  # the phase runs backwards where the shaft does
            back = orbit.of(rows, -share * orbit.period)
            motion = tuple(np.where(backward, b, a) for a, b in zip(motion, back, strict=True))
        found = slopes(drives, *motion)
        return found.mass[..., first:], found.damping[..., first:, first:], found.stiffness[..., first:, first:]

    return coefficients


def _values(orbit: Orbit, rows: Array, matrix: Array, heavy: Array) -> tuple[Array, Array]:
    """Return the multipliers of monodromy matrices about motions, and how many were left out of free drives."""
    if not orbit.model.free:
        return rising_first(values_of(matrix))
    _q, rate, acceleration = (one[:, 0] for one in orbit.of(rows, [0.0]))
    tangent = np.concatenate([rate, acceleration[:, heavy]], axis=-1)
    drifts = drifting(orbit.drives(rows), orbit.speed.reshape(-1)[rows])
    return rising_first(values_of(matrix, tangent), drifts, lambda some: drift_of(orbit, rows[some]))


def unmoved(damping: Array, heavy: Array) -> Array:
    """Return how many coordinates have neither inertia nor damper: they follow the others at once, array (b,).

    damping (b, p, R, R): at moments of the motion; a damper that lets go at any of them holds nothing back over a
    period.
    heavy (R,) of bool.
    """
    light = np.flatnonzero(~heavy)
    if not light.size:
        return np.zeros(len(damping), dtype=int)
    rank = np.linalg.matrix_rank(damping[..., light[:, None], light])
    found: Array = light.size - np.min(rank, axis=-1)
    return found


def straight_damping(drives: TorsionalModel, speed: Array) -> Array:
    """Return the damping between coordinates that are not forced, joints straight, array (b, 1, R, R) [N·m·s/rad].

    drives (b,): with torques ready for moments in a second axis; speed (b,) [rad/s].
    """
    first = 0 if drives.free else 1
    found = straight_stiffness(replace(drives, stiffness=drives.of_disturbances.damping))
    for k, r in enumerate(drives.coordinate):
        found[:, r, r] += drives.ground_damping[:, k]
    here = speed[:, None]
    for torque in drives.torques:
        r = drives.coordinate[torque.station]
        found[:, r, r] -= torque.law.at(np.zeros(()), 0.0 * here, here)[2][:, 0]
    return found[:, None, first:, first:]


def without_last(values: Array, count: Array) -> Array:
    """Return multipliers (b, m), the largest first, without so many of the smallest."""
    last = np.sum(np.isfinite(values), axis=-1) - count
    return np.where(np.arange(values.shape[-1]) < last[:, None], values, np.nan)


def values_of(matrix: Array, tangent: Array | None = None) -> Array:
    """Return the multipliers of monodromy matrices (b, m, m), in no order, array (b, m) or (b, m-1), complex.

    tangent (b, m): of free drives the disturbances by a shift in time, which is left out.
    """
    return np.linalg.eigvals(matrix if tangent is None else without_direction(matrix, tangent)).astype(complex)


def rising_first(
    values: Array, drifts: Array | None = None, drift: Callable[[Array], Array] | None = None
) -> tuple[Array, Array]:
    """Return multipliers (b, m), the largest first, and how many were left out of free drives, array of int (b,).

    drifts (b,) of bool: of free drives, whose shift in time is left out already: whether any speed is as good as any
    other; the drift to one is left out too, nan in its place. drift: from rows to what `vibrating` asks.
    """
    removed = np.zeros(len(values), dtype=int)
    if drifts is not None and drift is not None and values.shape[-1]:
        rows = np.flatnonzero(drifts)
        values = values.copy()
        values[rows, :-1] = vibrating(values[rows], 1, lambda some: drift(rows[some]))
        values[rows, -1] = np.nan
    if drifts is not None:
        removed += 1 + drifts
    size = np.where(np.isfinite(values), np.abs(values), -1.0)
    return np.take_along_axis(values, np.argsort(-size, axis=-1, kind="stable"), axis=-1), removed


def drifting(drives: TorsionalModel, speed: Array) -> Array:
    """Tell which free drives may turn at any speed: no drag and no torque of theirs changes with it, array (b,).

    drives (b,): with torques ready for moments in a second axis; speed (b,) [rad/s].
    """
    governed = np.any(drives.ground_damping != 0.0, axis=-1)
    here = speed[:, None]
    for torque in drives.torques:
        governed = governed | np.any(torque.law.at(np.zeros(()), 0.0 * here, here)[2] != 0.0, axis=-1)
    return ~governed


def vibrating(values: Array, count: int, drift: Callable[[Array], Array]) -> Array:
    """Return the multipliers of free drives without those of turning as a whole, array (b, m-count), in no order.

    values (b, m).
    count: how many to leave out: one, the drift to another speed, where a shift in time is left out already, else two.
    drift: from rows to how fast the mean speed would leave by itself, see `drift_of`; asked where it decides.
    Left out are the real ones nearest to 1. Amid a resonance the drift may be far from it: where the torque that keeps
    the mean speed falls as that rises, it is of the real ones above 1, or less than `CLOSE` below, that whose growth is
    nearest to what the slope of the torque makes; where it rises, none that is `CLOSE` above 1 or more. For the product
    of 1 - ρ has the sign of that slope unless the motion is one that no governor of the mean speed could hold; on which
    side of 1 a slow drift is hangs on structural damping too.
    """
    real = np.abs(values.imag) <= REAL * np.abs(values)
    far = np.where(real, np.abs(values - 1.0), 1.0 + np.abs(values))
    above = np.where(real & (values.real > 1.0 + NEUTRAL), values.real, 0.0)
    near = np.sum(real & (values.real > BESIDE), axis=-1) > count
    rows = np.flatnonzero(np.any(above > 0.0, axis=-1) & (near | np.any(above > 1.0 + SLOW, axis=-1)))
    if rows.size:
        shifted = np.argmin(far[rows], axis=-1)  # the shift in time, where it is still there
        leaving, size = np.nan_to_num(drift(rows))[:, None], values[rows].real
        may = real[rows] & (size > 1.0 - CLOSE)
        if count > 1:
            may[np.arange(len(rows)), shifted] = False
        off = np.where(may, np.abs(np.log(np.where(may, size, 1.0)) - leaving), np.inf)
        nearest = may & (np.arange(values.shape[-1]) == np.argmin(off, axis=-1)[:, None])
        back = np.where(may, np.where(size > 1.0 + CLOSE, np.inf, off), far[rows])
        far[rows] = np.where(leaving > 0.0, np.where(nearest, -1.0, far[rows]), back)
        if count > 1:
            far[rows, shifted] = -2.0
    found: Array = np.take_along_axis(values, np.argsort(far, axis=-1, kind="stable")[:, count:], axis=-1)
    return found


def drift_of(orbit: Orbit, rows: Array) -> Array:
    """Return of free motions how fast their mean speed would leave by itself, array (b,) [per period].

    orbit (...); rows (b,) of int: which motions. Slowly, by the slope of the torque F that keeps it: -F' T/ΣJ, above 0
    where the torque falls as the speed rises; by the motions at speeds a little apart, nan where one is not found.
    """
    found = np.full(len(rows), np.nan)
    for k in np.flatnonzero(np.isin(rows, list(orbit.pieces))).tolist():
        here, alone = orbit.pieces[int(rows[k])], orbit.turning.part(rows[[k]])
        ends = [
            periodic_pieces(Backlashed(_faster(alone, share)), share * here.omega, here, free=True)
            for share in (1.0 - ASIDE, 1.0 + ASIDE)
        ]
        forces = [one.force for one in ends if one is not None and one.status == Status.CONVERGED]
        if len(forces) == len(ends):
            found[k] = slow_drift(alone, forces)[0]
    smooth = np.flatnonzero(~np.isin(rows, list(orbit.pieces)))
    if smooth.size:
        coefficient = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])[rows[smooth]]
        found[smooth] = drift_of_sums(orbit.turning.part(rows[smooth]), coefficient)
    return found


def drift_of_sums(part: Turning, coefficient: Array) -> Array:
    """Return the same of motions by their sums (b, R, H+1), array (b,) [per period]."""
    high = max(coefficient.shape[-1] - 1, 1)
    how = HarmonicBalance(harmonics=high, most=high)
    forces, there = [], np.ones(len(coefficient), dtype=bool)
    for share in (1.0 - ASIDE, 1.0 + ASIDE):
        near = _faster(part, share)
        waves = harmonic_balance(near, near.frequency, near.coordinates, free=True, start=coefficient, method=how)
        forces.append(waves.force)
        there &= waves.status != Status.NO_CONVERGENCE
    return np.where(there, slow_drift(part, forces), np.nan)


def slow_drift(part: Turning, forces: Sequence[ArrayLike]) -> Array:
    """Return the same by the torques (b,) that keep the speeds `ASIDE` below and above, array (b,) [per period]."""
    slope = (np.asarray(forces[1]) - np.asarray(forces[0])) / (2.0 * ASIDE * part.speed)
    found: Array = -slope * part.period / (np.abs(part.speed) * np.sum(part.model.inertia, axis=-1))
    return found


def _faster(part: Turning, share: float) -> Turning:
    """Return drives at a share of their speeds."""
    return Turning(part.model, part.angle_error, share * part.speed, part.period)


def liouville(coefficients: Coefficients, duration: Array, matrix: Array) -> Array:
    """Return ln det of the monodromy matrix plus the integral of tr C/M; nan where that says nothing.

    So where a coordinate has no mass, and where what is left of a disturbance is smaller than rounding.
    """
    points, table = collocation(STAGES)
    mass, damping, _stiffness = coefficients(((np.arange(PANELS)[:, None] + points) / PANELS).ravel())
    if np.any(mass == 0.0):
        return np.full(len(duration), np.nan)
    lost = np.einsum("bprr,bpr->bp", damping, 1.0 / mass) @ np.tile(table[-1] / PANELS, PANELS) * duration
    with np.errstate(divide="ignore"):
        return np.where(lost < FADED, np.linalg.slogdet(matrix)[1] + lost, np.nan)
