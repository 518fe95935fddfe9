"""How do torques vibrate whose order no two turns hold a whole number of times, beside the joints? With side bands.

The motion has two phases, that of the shaft and that of the torques, and passes every pair of them. Joints turn a
torque of the order ν into the orders |ν ± 2r|, any of which may meet a mode.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np

from cardan.maths.arrays import Array
from cardan.maths.periodic.harmonics import Linearised
from cardan.maths.periodic.torus import Torus, samples_of, torus_balance, torus_phases
from cardan.questions.torsion.model.inputs import Swinging
from cardan.questions.torsion.model.torsional_balance import element_torques, linearised
from cardan.questions.torsion.model.torsional_layouts import Turning, chosen
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel

from .orbit import Orbit
from .steady import closed, stays_closed

HARMONICS = (4, 6)
"""Least and most harmonics of half a turn."""

OTHERS = (2, 3)
"""Harmonics of the torques, and those with which motions are sought again whose last ones are not small."""

KINKED = 4
"""Further ones where springs bend or friction slips."""

SMALL = 0.03
"""Largest of the last harmonics of the torques, over the largest of all of them, that is small: the next ones are of
the order of its square."""

CHUNK = 32
"""Speeds solved at once."""

FINE = 2
"""Samples of a phase between two of the solution at which extremes are looked for."""

PHASES = 24
"""Samples of the phase of several torques in a swing of the highest of them: its top is missed by less than 1 %."""

DENOMINATORS = 12
"""Orders of which one is so small a multiple of a part of another have a phase in common."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SideBands:
    """Torques of a drive under its joints and torques that do not repeat with them; b speeds."""

    base: float  # order of which those of the torques are multiples
    order: Array  # (k,): orders of the torques and of their side bands, rising
    amplitude: Array  # (b, E, k), complex [N·m]: of every element
    # lowest, highest (b, E) [N·m]: extremes of the whole torque, reached sooner or later
    lowest: Array
    highest: Array  # (b, E) [N·m]
    found: Array  # (b,) of bool: whether there is such a motion with all backlash closed


SOFTER = 50.0
"""By how much the band of dry friction is wider than it is, so that sums on two phases hold it."""


def grouped(loose: tuple[Torque, ...]) -> Iterator[tuple[float, tuple[Torque, ...]]]:
    """Yield torques whose orders are multiples of one, with that order."""
    rest = list(loose)
    while rest:
        lead = abs(_order(rest[0]))
        shares = [Fraction(abs(_order(one)) / lead).limit_denominator(DENOMINATORS) for one in rest]
        alike = [
            abs(float(share) * lead - abs(_order(one))) < 1e-9 * lead for one, share in zip(rest, shares, strict=True)
        ]
        parts = [share.denominator for share, kept in zip(shares, alike, strict=True) if kept]
        yield lead / int(np.lcm.reduce(parts)), tuple(one for one, kept in zip(rest, alike, strict=True) if kept)
        rest = [one for one, kept in zip(rest, alike, strict=True) if not kept]


def _order(torque: Torque) -> float:
    assert isinstance(torque.law, Swinging)
    return float(torque.law.frequency)


def side_bands(
    orbit: Orbit, base: float, loose: tuple[Torque, ...], rows: Array | None = None, *, follow: bool = True
) -> SideBands:
    """Return how torques vibrate about steady motions under torques of other orders.

    orbit (...): the motions without these torques; base: order of which theirs are multiples.
    rows (b,) of int: which motions, counted through the leading axes; all by default. follow: see `motions`.
    Returns: motions in one axis.
    """
    wanted = np.arange(orbit.count) if rows is None else rows
    parts = [motion.bands for _some, motion in motions(orbit, base, loose, wanted, follow=follow)]
    order = np.unique(np.concatenate([part.order for part in parts]).round(9))
    amplitude = np.zeros((len(wanted), len(orbit.model.elements), len(order)), dtype=complex)
    begin = 0
    for part in parts:
        columns = np.searchsorted(order, part.order.round(9))
        amplitude[begin : begin + len(part.found), :, columns] = part.amplitude
        begin += len(part.found)
    return SideBands(
        base=base,
        order=order,
        amplitude=amplitude,
        **{name: np.concatenate([getattr(one, name) for one in parts]) for name in ("lowest", "highest", "found")},
    )


def motions(
    orbit: Orbit, base: float, loose: tuple[Torque, ...], rows: Array, *, follow: bool = True
) -> Iterator[tuple[Array, Moving]]:
    """Yield motions under both by their rows, some of (b,) at a time.

    follow: whether those that Newton's steps miss are followed as the torques grow, some tenths of a second each.
    """
    least, most = others_of(orbit, base, loose)
    for first in range(0, len(rows), CHUNK):
        some = rows[first : first + CHUNK]
        found = moving(orbit, some, base, loose, least, follow=follow)
        own = np.max(np.abs(found.torus.coefficient), axis=(1, 2))[:, 1 : least + 1]
        if least < most and np.any(own[:, -1] > SMALL * np.max(own, axis=-1)):
            found = moving(orbit, some, base, loose, most, near=found.near, follow=follow)
        yield some, found


def others_of(orbit: Orbit, base: float, loose: tuple[Torque, ...]) -> tuple[int, int]:
    """Return how many harmonics of the torques motions take, at least and at most."""
    own = max(round(abs(_order(one)) / base) for one in loose)  # the highest multiple among them is to be held too
    least, most = (max(count, own + more) + (KINKED if orbit.model.special else 0) for more, count in enumerate(OTHERS))
    return least, most


def of_drives(
    model: TorsionalModel, outer: tuple[int, ...], rows: Array, loose: tuple[Torque, ...]
) -> tuple[Torque, ...]:
    """Return torques of some of the drives, counted through their axes, ready for moments in a second axis."""
    return chosen(replace(model, torques=loose), outer, rows).torques


def envelope(waves: Array, loose: tuple[Torque, ...]) -> tuple[Array, Array]:
    """Return by how much torques of other orders lower and raise others at each angle, sooner or later: (b, E, S).

    waves (n, b, E, S), complex: what each adds, as `side_waves` gives it. Multiples of one order share a phase.
    """
    low, high = np.zeros(waves.shape[1:]), np.zeros(waves.shape[1:])
    left = list(loose)
    for base, group in grouped(loose):
        own = [next(k for k, one in enumerate(left) if one is torque) for torque in group]
        if len(own) == 1:
            size = np.abs(waves[own[0]])
            low, high = low + size, high + size
            continue
        share = np.asarray([_order(torque) / base for torque in group])
        count = PHASES * round(float(np.max(np.abs(share))))
        turn = np.exp(2j * np.pi * np.multiply.outer(share, np.arange(count) / count))
        whole = np.einsum("nbes,nt->best", waves[own], turn).real
        low, high = low - np.min(whole, axis=-1), high + np.max(whole, axis=-1)
    return low, high


class _Driven:
    """The drives under both: an `Equation` at the samples of two phases.

    loose: torques that swing, of all the drives, ready for moments in a second axis.
    """

    def __init__(self, turning: Turning, base: float, loose: tuple[Torque, ...], theta: Array) -> None:
        self.turning, self.base, self.loose, self.theta = turning, base, loose, theta

    def drives(self, rows: Array, phase: Array) -> TorsionalModel:
        """Return the drives with the torques, each counted from its own phase instead of the angle of the shaft."""
        model = self.turning.drives(rows)
        shaft = phase * (self.turning.period / (2.0 * np.pi))
        more = []
        for torque in self.loose:
            law = torque.law
            assert isinstance(law, Swinging)
            phases = law.phase[rows] + law.frequency * (self.theta / self.base - shaft)
            more.append(Torque(station=torque.station, law=replace(law, amplitude=law.amplitude[rows], phase=phases)))
        return replace(model, torques=(*model.torques, *more))

    def __call__(self, rows: Array, phase: Array, x: Array, v: Array, a: Array) -> Linearised:
        """Return the balance of the coordinates that are not forced, and its slopes."""
        left, slopes = linearised(self.drives(rows, phase), *self.turning.motion(rows, phase, x, v, a))
        k = self.turning.first
        return Linearised(
            balance=left[..., k:],
            mass=slopes.mass[..., k:],
            damping=slopes.damping[..., k:, k:],
            stiffness=slopes.stiffness[..., k:, k:],
        )


@dataclass(frozen=True, eq=False, kw_only=True)
class Moving:
    """Motions of some drives under both."""

    turning: Turning  # (b,): without play, resting on the side to which mean torques push
    torus: Torus
    base: float
    loose: tuple[Torque, ...]  # of these drives, ready for moments in a second axis
    bands: SideBands

    @property
    def near(self) -> Array:
        """Parts of the motions for others to begin with, nan where none was found, array (b, R, 2H+1, 2G+1)."""
        return np.where(self.torus.found[:, None, None, None], self.torus.coefficient, np.nan)

    @property
    def ratio(self) -> float:
        """Rate of the phase of the torques over that of the shaft."""
        return self.torus.ratio

    def drives(self, rows: Array, phase: Array, theta: Array) -> TorsionalModel:
        """Return drives (n,) with all torques, at phases of the shaft and the torques, arrays that spread to (n, p)."""
        return _Driven(self.turning, self.base, self.loose, theta).drives(rows, phase)


def moving(
    orbit: Orbit,
    rows: Array,
    base: float,
    loose: tuple[Torque, ...],
    others: int,
    *,
    finer: int = 0,
    share: float = 1.0,
    near: Array | None = None,
    follow: bool = True,
) -> Moving:
    """Return the motions of some of the drives under both.

    others: harmonics of the torques; finer: how many more of every phase; share: of their speeds; near: parts of the
    motions to begin with, see `torus_balance`; follow: see `motions`.
    """
    whole = orbit.turning.part(rows)
    if share != 1.0:
        whole = Turning(whole.model, whole.angle_error, share * whole.speed, whole.period)
    turning = closed(whole)
    if turning.model.creep is not None:
        wide = replace(turning.model, creep=SOFTER * turning.model.creep)
        turning = Turning(wide, turning.angle_error, turning.speed, turning.period)
    start = orbit.coefficient.reshape(orbit.count, *orbit.coefficient.shape[-2:])[rows][:, turning.first :]
    opened = np.any(np.asarray(whole.model.backlash) > 0.0, axis=-1)
    there = np.isfinite(start).all(axis=(1, 2)) & ~(opened & np.asarray([int(k) in orbit.pieces for k in rows]))
    there &= stays_closed(whole, start)
    begin = np.where(there[:, None, None], start, 0.0)
    half_turns = round(turning.period / np.pi)
    harmonics = (_needed(begin, half_turns) + finer * half_turns, others + finer)
    theta = torus_phases(samples_of(harmonics))[1]
    own = of_drives(orbit.model, orbit.angle_error, rows, loose)
    torus = torus_balance(
        _Driven(turning, base, own, theta),
        turning.frequency,
        turning.coordinates,
        ratio=base * turning.period / (2.0 * np.pi),
        harmonics=harmonics,
        free=turning.model.free,
        start=begin,
        near=near,
        alone=_Driven(turning, base, (), theta) if follow else None,
        rows=np.flatnonzero(there),
    )
    bands = _read(turning, torus, base, whole, there & torus.found)
    return Moving(turning=turning, torus=torus, base=base, loose=own, bands=bands)


def sampled(turning: Turning, torus: Torus) -> tuple[tuple[int, int], Array, Array]:
    """Return over how many samples of each phase motions are told, and q and q̇ there, arrays (b, S T, R)."""
    first, second = (FINE * count for count in samples_of(torus.harmonics))
    x, v, a = torus.at((first, second))
    rate = turning.frequency[:, None, None]
    z = torus_phases((first, second))[0]
    q, speed, _a = turning.motion(np.arange(len(turning.speed)), z, x, rate * v, rate**2 * a)
    return (first, second), q, speed


def _needed(start: Array, half_turns: int) -> int:
    """Return how many harmonics of a period hold motions."""
    size = np.max(np.abs(start), axis=(0, 1))
    large = np.flatnonzero(size > 1e-5 * np.max(size[1:], initial=1e-300))
    least, most = (count * half_turns for count in HARMONICS)
    return min(max(int(np.max(large, initial=0)), least), most)


def _read(turning: Turning, torus: Torus, base: float, whole: Turning, found: Array) -> SideBands:
    """Return amplitudes and extremes of the torques from a finer grid of both phases."""
    rows, harmonics = np.arange(len(turning.speed)), torus.harmonics
    shape, q, speed = sampled(turning, torus)
    torque = np.moveaxis(element_torques(turning.drives(rows), q, speed), -1, 1).reshape(len(rows), -1, *shape)
    waves = np.fft.fft2(torque) / (shape[0] * shape[1])
    m = np.arange(-harmonics[0], harmonics[0] + 1)
    n = np.arange(1, harmonics[1] + 1)
    own = 2.0 * waves[..., m[:, None], n[None, :]].reshape(*torque.shape[:2], -1)
    order = ((2.0 * np.pi / turning.period) * m[:, None] + base * n).reshape(-1)
    own = np.where(order < 0.0, own.conj(), own)
    sorting = np.argsort(np.abs(order), kind="stable")
    loose = np.any(whole.model.backlash > 0.0, axis=-1)
    lowest, highest = (extreme(torque, sign) for sign in (-1.0, 1.0))
    kept = np.all((whole.model.backlash == 0.0) | (lowest * highest > 0.0), axis=-1)
    return SideBands(
        base=base,
        order=np.abs(order)[sorting],
        amplitude=own[..., sorting],
        lowest=lowest,
        highest=highest,
        found=found & (kept | ~loose),
    )


def extreme(values: Array, sign: float) -> Array:
    """Return the lowest (-1) or highest (1) of values (b, E, S, T) that repeat both ways: a parabola each way."""
    b, e, s, t = values.shape
    flat = (sign * values).reshape(b * e, s, t)
    i, j = np.divmod(np.argmax(flat.reshape(b * e, -1), axis=-1), t)
    k = np.arange(b * e)
    top = flat[k, i, j]
    more = np.zeros_like(top)
    beside = ((flat[k, (i - 1) % s, j], flat[k, (i + 1) % s, j]), (flat[k, i, (j - 1) % t], flat[k, i, (j + 1) % t]))
    for before, behind in beside:
        bend = 2.0 * top - before - behind
        more += np.where(bend > 0.0, 0.125 * (behind - before) ** 2 / np.where(bend > 0.0, bend, 1.0), 0.0)
    found: Array = (sign * (top + more)).reshape(b, e)
    return found
