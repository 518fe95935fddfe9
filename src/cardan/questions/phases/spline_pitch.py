"""The best yoke angles that spline teeth allow: all of them looked at, none left out.

A shaft with z teeth lets its yokes stand in steps of 360°/z from where they are; modulo 180° these are z places, z/2
when z is even. All settings of all shafts are enumerated. Where they are too many, the chain is cut in two and only the
halves are enumerated: each setting of a half is a point of the hyperbolic disk, the speed fluctuation of the whole is
the distance between a point of the one and a point of the other half, and the nearest pairs come from a search tree.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from cardan.drive.models.kinematics_model import Chain
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import mobius, polygon
from cardan.maths.kernel.mobius import Pair
from cardan.texts import _

from .family import blocks
from .setting import wrapped

DIRECT = 1 << 18
"""Up to this many settings all are computed; more are met in the middle."""

LIMIT = 1 << 20
"""Most points of one half, and most settings where yokes to be set freely stand between."""

EVERY = 1 << 16
"""Up to so many settings on teeth are looked at one by one where a formula cannot tell which are the best."""

TIE = 1e-12
"""SpeedFluctuations nearer than this are equal; the setting nearer to the present one comes first."""


def steps(teeth: int) -> int:
    """Return how many different yoke angles a spline of ``teeth`` teeth allows."""
    return teeth // 2 if teeth % 2 == 0 else teeth


def on_teeth(base: Array, yoke_angle: Array, teeth: Mapping[int, int]) -> Array:
    """Return the settings that splines allow, array (s, n-1) [rad]: all, or those a tooth beside one where too many.

    base (n-1,) [rad]: a setting whose yoke angles without teeth are kept; yoke_angle (n-1,) [rad]: present yoke
    angles, from which the teeth count; teeth: index 0 … n-2 of a yoke angle -> teeth of the spline there.
    """
    every = math.prod(steps(z) for z in teeth.values()) <= EVERY
    places = []
    for k, z in sorted(teeth.items()):
        pitch = np.pi / steps(z)
        near = round(float(base[k] - yoke_angle[k]) / pitch)
        places.append(yoke_angle[k] + pitch * (np.arange(steps(z)) if every else near + np.arange(-1, 2)))
    grid = np.stack([one.ravel() for one in np.meshgrid(*places, indexing="ij")], axis=-1) if places else base[None, :0]
    rows = np.repeat(base[None], len(grid), axis=0)
    rows[:, sorted(teeth)] = grid
    return rows


@dataclass(frozen=True, eq=False, kw_only=True)
class _Run:
    """Joints in a row and the places of the yokes between them."""

    joints: range
    pitched: tuple[int, ...]
    counts: tuple[int, ...]


def best_pitched(
    chain: Chain, yoke_angle: Array, teeth: Mapping[int, int], free: Sequence[int] = (), *, count: int = 6
) -> Array:
    """Return the settings with the smallest speed fluctuation that splines allow, best first.

    chain: one drive; yoke_angle (n-1,) [rad]: present yoke angles, from which the teeth count.
    teeth: index 0 … n-2 of a yoke angle -> teeth of the spline there.
    free: indices of yoke angles that have no teeth but may be chosen at will; each gets its best angle.
    count: how many settings to return, fewer if there are fewer.
    Returns (s, n-1) [rad].
    Raises InputError: there are too many settings to look at.
    """
    places = {k: yoke_angle[k] + np.arange(steps(z)) * (np.pi / steps(z)) for k, z in sorted(teeth.items())}
    if free:
        return _with_free(chain, yoke_angle, places, free, count)
    run = _run(chain, range(chain.joints), places)
    if math.prod(run.counts) <= DIRECT:
        pair = _enumerated(chain, yoke_angle, places, run)
        index = _smallest(mobius.speed_fluctuation(pair), run, places, yoke_angle, count)
    else:
        index = _met(chain, yoke_angle, places, run, count)
    return _rows(yoke_angle, places, run.pitched, run.counts, index)


def _run(chain: Chain, joints: range, places: Mapping[int, Array]) -> _Run:
    pitched = tuple(k for k in places if joints.start <= k < joints.stop - 1)
    return _Run(joints=joints, pitched=pitched, counts=tuple(len(places[k]) for k in pitched))


def _enumerated(chain: Chain, yoke_angle: Array, places: Mapping[int, Array], run: _Run) -> Pair:
    """Return the pairs of all settings of a run of joints, the last yoke changing fastest."""
    joint_angle = chain.joint_angle.tolist()
    a, b = (np.asarray([part]) for part in mobius.hooke(joint_angle[run.joints.start]))
    for i in run.joints[1:]:
        a, b = _turned((a, b), _turns(chain, yoke_angle, places, i - 1))
        a, b = mobius.compose(mobius.hooke(np.asarray(joint_angle[i])), (a, b))
    return a, b


def _turns(chain: Chain, yoke_angle: Array, places: Mapping[int, Array], k: int) -> Array:
    return 0.5 * np.pi - chain.plane_twist[k] - places.get(k, yoke_angle[k : k + 1])


def _turned(pair: Pair, angle: Array) -> Pair:
    spin = np.exp(1j * angle)
    return (pair[0][:, None] * spin).ravel(), (pair[1][:, None] * spin).ravel()


def _smallest(uneven: Array, run: _Run, places: Mapping[int, Array], yoke_angle: Array, count: int) -> Array:
    """Return the indices of the smallest values, ties by the smaller turn from the present yokes."""
    count = min(count, len(uneven))
    bound = np.partition(uneven, count - 1)[count - 1]
    found = np.flatnonzero(uneven <= bound + TIE)
    return _ordered(found, uneven[found], run.pitched, run.counts, places, yoke_angle)[:count]


def _ordered(
    index: Array,
    uneven: Array,
    pitched: tuple[int, ...],
    counts: tuple[int, ...],
    places: Mapping[int, Array],
    yoke_angle: Array,
) -> Array:
    change = wrapped(_rows(yoke_angle, places, pitched, counts, index) - yoke_angle)
    return index[np.lexsort((index, np.round(np.sum(change**2, axis=-1), 9), np.round(uneven / TIE)))]


def _rows(
    yoke_angle: Array, places: Mapping[int, Array], pitched: tuple[int, ...], counts: tuple[int, ...], index: Array
) -> Array:
    rows = np.repeat(yoke_angle[None], len(index), axis=0)
    if pitched:
        for k, place in zip(pitched, np.unravel_index(index, counts), strict=True):
            rows[:, k] = places[k][place]
    return wrapped(rows)


def _met(chain: Chain, yoke_angle: Array, places: Mapping[int, Array], run: _Run, count: int) -> Array:
    """Return the indices of the best settings by the nearest points of two halves.

    For the half (a, b) up to and with the turn in the middle and the half (p, q) behind it, |b_whole| =
    |p| |a| |u - v| with the points u = b/a*, v = -q/p of the unit disk.
    """
    cut = min(range(1, len(run.pitched) + 1), key=lambda c: max(math.prod(run.counts[:c]), math.prod(run.counts[c:])))
    largest = max(math.prod(run.counts[:cut]), math.prod(run.counts[cut:]))
    if largest > LIMIT:
        raise _too_many(math.prod(run.counts), largest)
    middle = run.pitched[cut - 1]
    first = _run(chain, range(middle + 1), places)
    a, b = _turned(_enumerated(chain, yoke_angle, places, first), _turns(chain, yoke_angle, places, middle))
    p, q = _enumerated(chain, yoke_angle, places, _run(chain, range(middle + 1, chain.joints), places))
    u, v = b / np.conj(a), -q / p
    tree = scipy.spatial.cKDTree(np.column_stack((u.real, u.imag)))
    target = np.column_stack((v.real, v.imag))
    near = min(count, len(u))
    distance, other = (np.reshape(x, (len(v), near)) for x in tree.query(target, k=near))
    size = np.abs(p)
    half = distance * size[:, None] * np.abs(a)[other]
    bound = np.partition(half.ravel(), min(count, half.size) - 1)[min(count, half.size) - 1]
    radius = (bound * (1.0 + 1e-9) + TIE) / (size * np.abs(a).min())
    found = [(other.ravel(), np.repeat(np.arange(len(v)), near))]
    many = tree.query_ball_point(target, radius, return_length=True)
    if many.sum() <= LIMIT:
        within = [np.asarray(w, dtype=int) for w in tree.query_ball_point(target, radius)]
        found.append((np.concatenate(within), np.repeat(np.arange(len(v)), many)))
    i, j = (np.concatenate(x) for x in zip(*found, strict=True))
    index = np.unique(i * len(v) + j)
    i, j = index // len(v), index % len(v)
    whole = mobius.speed_fluctuation(mobius.compose((p[j], q[j]), (a[i], b[i])))
    kept = np.argsort(whole, kind="stable")[: 8 * count]
    return _ordered(index[kept], whole[kept], run.pitched, run.counts, places, yoke_angle)[:count]


def _with_free(chain: Chain, yoke_angle: Array, places: Mapping[int, Array], free: Sequence[int], count: int) -> Array:
    """Return the best settings where yokes without teeth stand between: each side has its own choices."""
    ends = [0, *(k + 1 for k in sorted(free)), chain.joints]
    runs = [_run(chain, range(ends[s], ends[s + 1]), places) for s in range(len(ends) - 1)]
    counts = tuple(c for run in runs for c in run.counts)
    total = math.prod(counts)
    if total > LIMIT:
        raise _too_many(total, total)
    grids = []
    for s, run in enumerate(runs):
        length = mobius.length(_enumerated(chain, yoke_angle, places, run))
        shape = [1] * len(runs)
        shape[s] = -1
        grids.append(np.reshape(length, shape))
    low, _high = polygon.reach(grids)
    pitched = tuple(k for run in runs for k in run.pitched)
    whole = _Run(joints=range(chain.joints), pitched=pitched, counts=counts)
    index = _smallest(2.0 * np.sinh(low.ravel()), whole, places, yoke_angle, count)
    rows = _rows(yoke_angle, places, pitched, counts, index)
    done = []
    for row in rows:
        ways = blocks(chain, row, sorted(free)).closed()
        done.append(ways[int(np.argmin(np.sum(wrapped(ways - yoke_angle) ** 2, axis=-1)))])
    return wrapped(np.stack(done))


def _too_many(total: int, half: int) -> Exception:
    return refuse(
        "shafts",
        _(
            "the splines allow {total:.3g} settings; even cut in halves {half:.3g} would have to be looked at, and "
            "{limit:.3g} is the limit; hold some yokes (yoke_fixed)"
        ).format(total=float(total), half=float(half), limit=float(LIMIT)),
    )
