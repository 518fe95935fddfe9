"""What do the tolerances of the joints do to the motion of the output?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from cardan.drive.accuracy import Tolerance
from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.texts import _

from .accuracy import WAYS, error_arrays, located_shafts, one_turn, per_joint, sensitivity, transmission_error
from .own_laws import dimension, seats
from .pair_errors import PairError, pair_errors
from .sampling import SIGMA, Convergence, MonteCarlo, Sample, sampled

NORMAL_95 = 1.959963984540054
"""Standard deviations on both sides that hold 95 % of a normal law."""

ALIKE = 9
"""Digits of shares by which contributions are sorted: what differs by less is alike, and stays in its order."""

FELT = 1e-18
"""Share of the variance below which a pair does nothing but rounding: a billionth of what errs."""

DIRECTIONS = 90
"""Phases at which the amplitude of an order is looked at."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Linear:
    """Root of the sum of squares of the influences: three standard deviations where all errors are normal."""


@dataclass(frozen=True, kw_only=True, slots=True)
class WorstCase:
    """Every error at the end of its tolerance, each on the side that adds up."""


Method: TypeAlias = Linear | WorstCase | MonteCarlo
Spread: TypeAlias = Tolerance | Sequence[Tolerance | None] | None


@dataclass(frozen=True, kw_only=True, slots=True)
class Contribution:
    """What one tolerance contributes."""

    joint: int  # number of its joint, from 1
    key: str  # its key, ``alpha2``; of a pair inside the joint its path there
    pair: str = ""  # what that pair is called
    dimension: str = "angle"  # of it, "" of a pure number
    tolerance: float  # the tolerance, ± in SI; of a pair the largest length of the vector by which it is off
    share: float  # its share of the variance over the turn
    largest: float  # the largest error it makes by itself, at the worst position [rad or m]
    # mean, first, second: the parts of that error that stay, come once a turn, and come twice a turn [rad or m]
    mean: float
    first: float
    second: float

    @property
    def field(self) -> str:
        """Path of the tolerance in the drive, ``joints[0].tolerance.alpha2``."""
        return f"joints[{self.joint - 1}].{'' if self.pair else 'tolerance.'}{self.key}"


@dataclass(frozen=True, eq=False, kw_only=True)
class Band:
    """Between which bounds an error of the output lies, over one turn; [rad] for its angle, [m] for its shift."""

    centre: Array  # (p,): error that the known errors of the drive make, exactly; zero without any
    # lower, upper (p,): bounds by the method: ± root of the sum of squares, ± worst case, or the 0.15 % and 99.85 %
    # quantiles
    lower: Array
    upper: Array  # (p,)
    lower_95: Array  # lower_95, upper_95 (p,): bounds that hold 95 % of the drives at each position
    upper_95: Array  # (p,)
    deviation: Array  # (p,): standard deviation by the distributions of the errors
    # mean, first, second: bounds of the size of the parts that stay over a turn, come once and come twice; of the
    # tolerances alone
    mean: float
    first: float
    second: float
    peak_to_peak: float  # bound of the change over a turn; of the tolerances alone
    contributions: tuple[Contribution, ...]  # every tolerance that has a part in it, the largest share first

    @property
    def largest(self) -> float:
        """Largest size of the bounds over the turn."""
        return float(max(np.max(np.abs(self.lower)), np.max(np.abs(self.upper))))


@dataclass(frozen=True, eq=False, kw_only=True)
class ToleranceBand:
    """What tolerances leave open at the output.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angles over one turn from the start position.
    output : Band
        Error of the output angle [rad], against the perfect drive at the same input angle.
    shift : Band
        Shift of the output shaft along its axis [m], where nothing but the last joint holds it.
    method : Linear, WorstCase or MonteCarlo
        How it was found.
    convergence : Convergence or None
        How far the samples are to be trusted.
    cancelled : bool
        Whether ``progress`` stopped the sampling; the result then rests on what was drawn.
    places : array (n, 3) [m, m, rad] or None
        Of samples, what 99.7 % of them keep: way of the shaft behind each joint across itself at the joint and at its
        far end, and how far it leans.
    """

    angle: Array
    output: Band
    shift: Band
    method: Method
    convergence: Convergence | None = None
    cancelled: bool = False
    places: Array | None = None


def tolerance(
    drive: Drive,
    spread: Spread = None,
    *,
    method: Method = Linear(),
    progress: Callable[[float], object] | None = None,
) -> ToleranceBand:
    """Return within which bounds the output errs, given the tolerances of the joints.

    Parameters
    ----------
    drive : Drive
        The drive. Known errors of its joints shift the bounds.
    spread : Tolerance, or n of them, optional
        Tolerances of every joint, or of each; those of the drive by default. Pairs in mechanism files keep theirs.
    method : Linear, WorstCase or MonteCarlo
        Root of the sum of squares, the worst case, or exact loops on random errors.
    progress : function, optional
        Called with the share done of the sampling; answering "stop" ends it.

    Returns
    -------
    ToleranceBand
        output, shift : bounds over one turn.

    Raises
    ------
    InputError
        No joint has a tolerance.

    See Also
    --------
    allocate, transmission_error

    Notes
    -----
    Worst case Σ \\|C\\| t, root of the sum of squares √Σ (C t)², C from `accuracy.sensitivity`;
    Book (171), (180). The peak to peak is that between the two positions that can differ most. A pair of a joint of
    one's own is off by a vector that goes with its link, of any direction: it counts by the length of its influence,
    which is worst along this. Samples leave pairs out.

    Examples
    --------
    >>> from cardan import Drive, Tolerance, tolerance
    >>> from cardan.units import deg
    >>> drive = Drive.from_angles([30 * deg])
    >>> band = tolerance(drive, Tolerance(alpha1=0.1 * deg, alpha2=0.05 * deg))
    >>> f"{band.output.largest / deg:.4f}"
    '0.0707'
    >>> [(one.field, round(one.share, 2)) for one in band.output.contributions]
    [('joints[0].tolerance.alpha2', 0.67), ('joints[0].tolerance.alpha1', 0.33)]
    """
    rows = spreads(drive, spread)
    turns, ways = error_arrays(rows, drive.joints)
    sampling = isinstance(method, MonteCarlo)
    inner = any(joint.tolerated for joint in drive.joints)
    if not np.any(turns) and not np.any(ways) and (sampling or not inner):
        if inner:
            text = _(
                "missing; samples are drawn of tolerances of joints alone, not of those of pairs in mechanism files"
            )
            raise refuse("joints[0].tolerance", text)
        raise refuse(
            "joints[0].tolerance", _("missing; no joint has a tolerance: give joints[k].tolerance.alpha1_deg or others")
        )
    widths = np.asarray([[SIGMA["normal" if row is None else row.distribution]] for row in rows])
    held = located_shafts(drive)
    phi = one_turn(method.positions) if isinstance(method, MonteCarlo) else one_turn()
    pairs = pair_errors(drive, phi) if inner and not sampling else ()
    known = transmission_error(drive, phi)
    tables = (sensitivity(drive, phi), sensitivity(drive, phi, located=held)[..., : len(WAYS)])
    names: list[Sequence[Sequence[str]]] = [seats(drive.joints), [WAYS] * len(rows)]
    parts = [
        _Part(
            table=table,
            limits=limits,
            widths=widths,
            centre=centre,
            names=some,
            joints=drive.joints,
            pairs=own,
        )
        for table, limits, centre, some, own in zip(
            tables, (turns, ways), (known.error, known.output_shift), names, (pairs, ()), strict=True
        )
    ]
    if not isinstance(method, MonteCarlo):
        power = 1 if isinstance(method, WorstCase) else 2
        output, shift = (_stacked(part, power) for part in parts)
        return ToleranceBand(angle=phi, output=output, shift=shift, method=method)
    draw = sampled(drive, rows, method, progress=progress)
    output, shift = (_from_sample(part, one) for part, one in zip(parts, draw.samples, strict=True))
    return ToleranceBand(
        angle=phi,
        output=output,
        shift=shift,
        method=method,
        convergence=draw.convergence,
        cancelled=draw.cancelled,
        places=draw.places,
    )


def spreads(drive: Drive, spread: Spread) -> list[Tolerance | None]:
    """Return the tolerances of each joint."""
    joints = len(drive.joints)
    if spread is None:
        return [joint.tolerance for joint in drive.joints]
    return per_joint("spread", spread, joints)


@dataclass(frozen=True, eq=False, kw_only=True)
class _Part:
    """Sensitivity (p, n, c) of the output to errors, with their tolerances (n, c)."""

    table: Array
    limits: Array
    widths: Array  # (n, 1): standard deviations over tolerances
    centre: Array
    names: Sequence[Sequence[str]]
    joints: Sequence[Joint]
    pairs: Sequence[PairError] = ()

    def reach(self) -> Array:
        """Return what tolerances make along each direction of an error, array (p, m, 3): of a number along the first.

        Those of joints in the order of ``names``, then those of pairs.
        """
        flat = _flat(self.table * self.limits)
        alone = np.stack((flat, 0.0 * flat, 0.0 * flat), axis=-1)
        return np.concatenate((alone, *(one.tolerance * one.table[:, None] for one in self.pairs)), axis=1)

    def shares(self) -> Array:
        """Return standard deviations over tolerances, array (m,)."""
        own = np.broadcast_to(self.widths, self.limits.shape)
        return np.concatenate((own.reshape(-1), [float(self.widths[one.joint - 1, 0]) for one in self.pairs]))


def stacked(parts: Array, power: int) -> Array:
    """Return Σ \\|x\\| for the power 1, √Σ x² for 2, over the last axis.

    >>> [float(stacked(np.asarray([3.0, -4.0]), power)) for power in (1, 2)]
    [7.0, 5.0]
    """
    sizes: Array = np.abs(parts)
    return np.sum(sizes, axis=-1) if power == 1 else np.sqrt(np.sum(sizes * sizes, axis=-1))


def _stacked(part: _Part, power: int) -> Band:
    reach = part.reach()
    half = stacked(norm(reach), power)
    deviation = stacked(norm(reach) * part.shares(), 2)
    mean, orders = _orders(reach)
    return Band(
        centre=part.centre,
        lower=part.centre - half,
        upper=part.centre + half,
        lower_95=part.centre - np.minimum(half, NORMAL_95 * deviation),
        upper_95=part.centre + np.minimum(half, NORMAL_95 * deviation),
        deviation=deviation,
        mean=float(stacked(norm(mean), power)),
        first=_amplitude(orders[0], power),
        second=_amplitude(orders[1], power),
        peak_to_peak=change(reach, power),
        contributions=contributions(part),
    )


def change(reach: Array, power: int) -> float:
    """Return by how much parts (p, m, d) over a turn can differ between two positions, stacked as `stacked` does."""
    coarse = reach[:: max(1, len(reach) // 120)]
    return max(float(np.max(stacked(norm(coarse - row), power))) for row in coarse)


def _from_sample(part: _Part, sample: Sample) -> Band:
    return Band(
        centre=part.centre,
        lower=sample.lower,
        upper=sample.upper,
        lower_95=sample.lower_95,
        upper_95=sample.upper_95,
        deviation=sample.deviation,
        mean=sample.mean,
        first=sample.first,
        second=sample.second,
        peak_to_peak=sample.peak_to_peak,
        contributions=contributions(part),
    )


def contributions(part: _Part) -> tuple[Contribution, ...]:
    """Return what every tolerance contributes, the largest share first."""
    reach = part.reach()
    size = norm(reach)
    variance = np.mean((size * part.shares()) ** 2, axis=0)
    total = float(np.sum(variance))
    mean, orders = _orders(reach)
    named = [
        (j + 1, name, "", dimension(part.joints[j], name) if part.limits[j, k] else "", float(part.limits[j, k]))
        for j, row in enumerate(part.names)
        for k, name in enumerate(row)
    ]
    named += [(one.joint, one.key, one.pair, one.dimension, one.tolerance) for one in part.pairs]
    rows = [
        Contribution(
            joint=joint,
            key=key,
            pair=pair,
            dimension=kind,
            tolerance=limit,
            share=float(variance[k]) / total,
            largest=float(np.max(size[:, k])),
            mean=float(norm(mean[k])),
            first=_alone(orders[0][k]),
            second=_alone(orders[1][k]),
        )
        for k, (joint, key, pair, kind, limit) in enumerate(named)
        if limit > 0.0 and variance[k] > (FELT * total if pair else 0.0)
    ]
    return tuple(sorted(rows, key=lambda row: -float(f"{row.share:.{ALIKE}g}")))


def norm(parts: Array) -> Array:
    """Return the lengths of vectors (..., d)."""
    return np.asarray(frames.norm(parts))


def _alone(order: Array) -> float:
    """Return the largest amplitude that a vector of phasors (3,) reaches, along its worst direction."""
    return float(np.linalg.svd(np.stack((order.real, order.imag)), compute_uv=False)[0])


def _flat(table: Array) -> Array:
    flat: Array = table.reshape(len(table), -1)
    return flat


def _orders(curves: Array) -> tuple[Array, list[Array]]:
    """Return mean and complex amplitudes of orders 1 and 2 of curves (p, m, 3) over one turn, arrays (m, 3)."""
    wave = np.exp(-1j * one_turn(len(curves)))[:, None, None]
    return np.mean(curves, axis=0), [2.0 * np.mean(curves * wave**k, axis=0) for k in (1, 2)]


def _amplitude(order: Array, power: int) -> float:
    """Return the largest amplitude that phasors (m, 3) reach together, looked at from every side."""
    side = np.exp(1j * np.arange(DIRECTIONS) * (np.pi / DIRECTIONS))
    return float(np.max(stacked(norm(np.real(order * side[:, None, None])), power)))
