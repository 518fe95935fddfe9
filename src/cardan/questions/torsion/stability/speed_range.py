"""How does a drive run over a range of speeds? Order maps of steady running, and where that is unstable."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np

from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.compiled.method import chosen as chosen_method
from cardan.maths.periodic.harmonics import HarmonicBalance
from cardan.maths.periodic.switching_orbit import Shooting
from cardan.questions.torsion.model.torques import Law
from cardan.questions.torsion.model.torsional_batch import ARRAYS, SHARED, chosen, leading
from cardan.questions.torsion.model.torsional_model import Torque, TorsionalModel
from cardan.questions.torsion.steady.run_stability import Verdict, Zone, nearest_zone
from cardan.questions.torsion.steady.steady import periodic_response
from cardan.questions.torsion.steady.steady_result import SteadyResponse
from cardan.questions.torsion.steady.steady_start import straight_frequencies
from cardan.texts import _

from .floquet_map import Progress, floquet_map

POINTS = 240
"""Speeds at which a range is looked at first."""

AROUND = (0.0, 1e-3, 3e-3, 1e-2, 3e-2)
"""Further ones around every zone of the straight drive, as shares of its speed."""

ROUNDS = 6
"""Times that the speeds around a peak of growth, or an edge, get closer; each time to a tenth."""


def speed_sweep(
    model: TorsionalModel,
    speeds: ArrayLike,
    *,
    method: HarmonicBalance | Shooting | None = None,
    orders: float = 10.0,
    progress: Progress | None = None,
) -> SteadyResponse:
    """Return the steady running of drives at many speeds: what an order map shows.

    model (...): its own input speed does not count; speeds (k,) [rad/s]: of the input, or mean speeds of free drives.
    method, orders, progress: as `cardan.questions.torsion.steady.steady.periodic_response` takes them.
    Returns (..., k).
    """
    where = np.asarray(speeds, dtype=float)
    if where.ndim != 1 or not where.size:
        raise refuse("speeds", _("a list of speeds is needed"))
    arrays = {name: getattr(model, name)[..., None, :] for name in ARRAYS if getattr(model, name) is not None}
    torques = tuple(Torque(station=torque.station, law=_widened(torque.law)) for torque in model.torques)
    wide = replace(model, torques=torques, input_speed=None if model.free else where, **arrays)
    return periodic_response(wide, speed=where, method=method, orders=orders, progress=progress)


def _widened(law: Law) -> Law:
    own = {one.name: np.asarray(getattr(law, one.name)) for one in fields(law) if one.name not in SHARED}  # type: ignore[arg-type]
    return replace(law, **{name: value[..., None] for name, value in own.items() if value.ndim})  # type: ignore[type-var]


@dataclass(frozen=True, eq=False, kw_only=True)
class UnstableSpeeds:
    """Ranges of speeds in which steady running is unstable, within the range looked at."""

    # lowest, highest (k,) [rad/s]: ends of each range; those at an end of what was looked at are no edges
    lowest: Array
    highest: Array  # (k,) [rad/s]
    worst: Array  # (k,) [rad/s]: speed of the fastest growth in each
    growth_rate: Array  # (k,) [1/s]
    kind: Array  # (k,) of int: `cardan.questions.torsion.steady.run_stability.Kind` there
    zone: Zone  # (k,)
    looked: tuple[float, float]  # [rad/s]: from where to where
    unknown: int  # speeds at which no steady running was found
    cancelled: bool = False  # whether the work was stopped: no ranges are told then

    def margin(self, speed: float) -> float:
        """Return how far a speed is from the nearest range [rad/s]: negative inside one, nan where there is none."""
        if not len(self.lowest):
            return float("nan")
        return float(np.min(np.maximum(self.lowest - speed, speed - self.highest)))


def unstable_speeds(
    model: TorsionalModel, lowest: float, highest: float, *, points: int = POINTS, progress: Progress | None = None
) -> UnstableSpeeds:
    """Return the ranges of speed in which steady running of a drive is unstable.

    model: one drive; its own input speed does not count.
    lowest, highest [rad/s]: where to look.
    points: speeds looked at first, beside those around the zones of the straight drive.
    Peaks of growth between the speeds looked at are climbed, so that narrow zones are not passed over; the edges of
    every range are then found to a millionth of the step.
    """
    check(_problems(model, lowest, highest))
    one = chosen(model, (), np.zeros(1, dtype=int))
    frequencies = straight_frequencies(one)[:, 1 if model.free else 0 :]
    zones = _zones(frequencies[0])
    beside = np.concatenate([zones * (1.0 + side * share) for share in AROUND for side in (1.0, -1.0)])
    speeds = np.unique(np.concatenate([np.linspace(lowest, highest, points), beside]))
    speeds = speeds[(speeds >= lowest) & (speeds <= highest)]
    told = None if progress is None else (lambda share: progress(0.6 * share))
    growth, verdict, kind, stopped = _growths(model, speeds, told)
    for turn in range(ROUNDS if not stopped else 0):
        more = _closer(speeds, growth, verdict)
        if not more.size:
            break
        found = _growths(model, more, None)
        order = np.argsort(np.concatenate([speeds, more]), kind="stable")
        speeds = np.concatenate([speeds, more])[order]
        growth, verdict, kind = (
            np.concatenate([old, new])[order] for old, new in zip((growth, verdict, kind), found[:3], strict=True)
        )
        stopped = progress is not None and progress(0.6 + 0.4 * (turn + 1) / ROUNDS) == "stop"
        if stopped:
            break
    grows = (verdict == Verdict.UNSTABLE) & (not stopped)
    edges = np.flatnonzero(np.diff(np.concatenate([[0], grows.astype(int), [0]])))
    starts, ends = edges[::2], edges[1::2] - 1
    peaks = np.asarray([s + int(np.argmax(growth[s : e + 1])) for s, e in zip(starts, ends, strict=True)], dtype=int)
    return UnstableSpeeds(
        lowest=speeds[starts],
        highest=speeds[ends],
        worst=speeds[peaks],
        growth_rate=growth[peaks],
        kind=kind[peaks],
        zone=nearest_zone(np.repeat(frequencies, len(peaks), axis=0), speeds[peaks], kind[peaks]),
        looked=(lowest, highest),
        unknown=int(np.sum(verdict == Verdict.UNKNOWN)),
        cancelled=stopped,
    )


def _problems(model: TorsionalModel, lowest: float, highest: float) -> list[Problem]:
    found = []
    if not lowest > 0.0:
        found.append(Problem("lowest", _("{value:.6g} given; more than 0 is needed").format(value=lowest)))
    if not highest > lowest:
        found.append(Problem("highest", _("{value:.6g} given; more than the lowest is needed").format(value=highest)))
    if leading(replace(model, input_speed=None)) != ():
        found.append(Problem("model", _("many drives given; one is needed")))
    return found


def _zones(frequencies: Array) -> Array:
    """Return the speeds of the zones of the straight drive, the first two of every pair of modes."""
    i, j = np.triu_indices(len(frequencies))
    sums = np.concatenate([frequencies[i] + frequencies[j], np.abs(frequencies[i] - frequencies[j])])
    sums = sums[sums > 0.0]
    return np.concatenate([sums / 2.0, sums / 4.0])


def _growths(model: TorsionalModel, speeds: Array, progress: Progress | None) -> tuple[Array, Array, Array, bool]:
    """Return growth rates, verdicts and kinds at speeds, and whether the work was stopped."""
    free = replace(model, input_speed=None) if model.free else replace(model, input_speed=speeds)
    found = floquet_map(free, speed=speeds, method=chosen_method(None, np, large=True), progress=progress)
    growth = np.where(np.isfinite(found.floquet.growth_rate), found.floquet.growth_rate, -np.inf)
    return growth, found.floquet.verdict, found.floquet.kind, found.cancelled


def _closer(speeds: Array, growth: Array, verdict: Array) -> Array:
    """Return speeds around the edges of unstable ranges and around peaks of growth that is still negative."""
    grows = verdict == Verdict.UNSTABLE
    change = np.flatnonzero(grows[1:] != grows[:-1])
    parts = [np.linspace(speeds[k], speeds[k + 1], 12)[1:-1] for k in change]
    inner = np.arange(1, len(speeds) - 1)
    top = inner[
        ~grows[inner] & (growth[inner] >= growth[inner - 1]) & (growth[inner] >= growth[inner + 1]) & ~grows[inner - 1]
    ]
    rise = np.minimum(growth[top] - growth[top - 1], growth[top] - growth[top + 1])
    near = top[(growth[top] + 4.0 * np.abs(rise) > 0.0) & ~grows[top + 1]]
    for k in near:
        if speeds[k + 1] - speeds[k - 1] > 1e-6 * speeds[k]:
            parts += [np.linspace(speeds[k - 1], speeds[k], 7)[1:-1], np.linspace(speeds[k], speeds[k + 1], 7)[1:-1]]
    return np.concatenate(parts) if parts else np.zeros(0)
