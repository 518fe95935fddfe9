"""Which of several uncertain quantities an answer owes its spread to: Sobol' indices, and one quantity at a time."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.batch.points.distributions import Distribution, uniforms
from cardan.batch.work import STATUS, Column
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _
from cardan.units import nearest

from .goals import Evaluator, Progress, answered

RESAMPLES = 400  # samples drawn anew from the samples, for the ranges of the indices
MOST = 2**22  # numbers of such samples held at once
LEAST = 8  # samples with an answer, at least
ROOM = 2**27  # numbers that all points together may hold


@dataclass(frozen=True, eq=False, kw_only=True)
class Sensitivity:
    """Sobol' indices of answers (s) over fields (d).

    Attributes
    ----------
    fields, answers : tuple of Column
        What varied, and what was asked.
    first, total : array (s, d)
        Share of the variance that goes when a field is known; share that is left when all others are. The total ones
        count what fields do together, so that they add up to more than 1. nan where the answer does not vary.
    first_range, total_range : array (s, d, 2)
        Within which they lie with the confidence.
    confidence : float
        0.95 unless told otherwise.
    mean, deviation : array (s,)
        Of the answers, in the units of their columns.
    samples : int
        That had an answer wherever they were asked.
    left_out : int
        That had not.
    evaluations : int
        How often the answers were computed.
    status : str
        "done" or "cancelled"; then there are no numbers but nan.
    """

    fields: tuple[Column, ...]
    answers: tuple[Column, ...]
    first: Array
    total: Array
    first_range: Array
    total_range: Array
    confidence: float
    mean: Array
    deviation: Array
    samples: int
    left_out: int
    evaluations: int
    status: str = "done"

    def ranked(self, answer: int = 0) -> tuple[int, ...]:
        """Return the fields by their total share of an answer, the greatest first."""
        share = np.nan_to_num(self.total[answer], nan=-1.0)
        return tuple(np.argsort(-share, kind="stable").tolist())


def sensitivity(
    ask: Evaluator,
    spread: Sequence[Distribution],
    *,
    answers: Sequence[str] = (),
    samples: int = 1024,
    seed: int = 0,
    confidence: float = 0.95,
    progress: Progress | None = None,
) -> Sensitivity:
    """Return which share of the variance of answers each field brings about, alone and together with others.

    Parameters
    ----------
    ask : Evaluator
        What answers, over d fields.
    spread : sequence of Distribution
        How each field is distributed, independently of the others.
    answers : sequence of str
        Names of the columns looked at; all by default.
    samples : int
        Of which each is asked at d + 2 points; a power of 2 fills the space most evenly.
    seed : int
        The same gives the same samples.
    confidence : float
        Of the ranges.
    progress : function, optional
        Told the share done; when it answers "stop", the work ends.

    Returns
    -------
    Sensitivity

    Raises
    ------
    InputError
        Not one spread for each field, a column that is not there, too few samples, or too few that have an answer.

    See Also
    --------
    one_at_a_time, evaluator

    Notes
    -----
    Points A and B from a scrambled Sobol' sequence in 2d dimensions, A_i with field i from B:
    S_i = mean(f_B (f_Ai - f_A)) / V and T_i = mean((f_A - f_Ai)²) / 2V (Saltelli and others 2010). The ranges are those
    of the bootstrap over the samples.

    Examples
    --------
    >>> from cardan.batch.answering.asking import Formula
    >>> from cardan.sweeps import Uniform, sensitivity
    >>> ask = Formula.of(["x", "y"], {"z": lambda x, y: 3.0 * x + y})
    >>> found = sensitivity(ask, [Uniform(low=0.0, high=1.0)] * 2, samples=512)
    >>> print(found.first.round(2), found.total.round(2))
    [[0.9 0.1]] [[0.9 0.1]]
    """
    fields = ask.points
    chosen = _chosen(ask, spread, answers, samples, confidence)
    points = _design(spread, samples, seed)
    names = [column.name for column in chosen]
    rows = answered(ask, points.reshape(-1, len(fields)), names, progress)
    shape = (len(names), len(fields))
    if rows is None:
        unknown = np.full(shape, math.nan)
        pair = np.full((*shape, 2), math.nan)
        row = unknown[:, 0] if shape[1] else np.full(shape[0], math.nan)
        return Sensitivity(
            fields=fields,
            answers=chosen,
            first=unknown,
            total=unknown,
            first_range=pair,
            total_range=pair,
            confidence=confidence,
            mean=row,
            deviation=row,
            samples=0,
            left_out=0,
            evaluations=0,
            status="cancelled",
        )
    values = np.stack([rows[name] for name in names]).reshape(len(names), len(fields) + 2, samples)
    known = np.all(np.isfinite(values), axis=(0, 1)) & np.all(rows[STATUS].reshape(-1, samples) == 0, axis=0)
    if np.count_nonzero(known) < LEAST:
        text = _("only {known} of {samples} samples have an answer everywhere; narrow the spreads")
        check([Problem("samples", text.format(known=int(np.count_nonzero(known)), samples=samples), "out_of_range")])
    values = values[..., known]
    both = values[:, :2].reshape(len(names), -1)
    mean = np.mean(both, axis=1)
    first, total = _indices(values - mean[:, None, None], np.full((1, values.shape[-1]), 1.0))
    ranges = _ranges(values - mean[:, None, None], confidence, seed)
    return Sensitivity(
        fields=fields,
        answers=chosen,
        first=first[0],
        total=total[0],
        first_range=ranges[0],
        total_range=ranges[1],
        confidence=confidence,
        mean=mean,
        deviation=np.std(both, axis=1),
        samples=values.shape[-1],
        left_out=samples - values.shape[-1],
        evaluations=samples * (len(fields) + 2),
    )


def _chosen(
    ask: Evaluator, spread: Sequence[Distribution], answers: Sequence[str], samples: int, confidence: float
) -> tuple[Column, ...]:
    """Return the columns looked at, if all that was given fits."""
    problems = []
    known = {column.name: column for column in ask.answers}
    if len(spread) != len(ask.points) or not spread:
        text = _("{given} distributions given, {wanted} needed: one for each field that varies")
        problems.append(Problem("spread", text.format(given=len(spread), wanted=len(ask.points))))
    for name in answers:
        if name not in known:
            close = nearest(name, known) or ", ".join(known)
            problems.append(Problem("answers", _("{name} is not asked; there is {near}").format(name=name, near=close)))
    if samples < LEAST:
        text = _("{given} samples are too few; at least {least} are needed")
        problems.append(Problem("samples", text.format(given=samples, least=LEAST), "out_of_range"))
    elif samples * len(spread) * (len(spread) + 2) > ROOM:
        text = _("{given} samples are too many; at most {most} can be held")
        most = ROOM // (len(spread) * (len(spread) + 2))
        problems.append(Problem("samples", text.format(given=samples, most=most), "out_of_range"))
    if not 0.0 < confidence < 1.0:
        text = _("{given} is not between 0 and 1")
        problems.append(Problem("confidence", text.format(given=confidence), "out_of_range"))
    check(problems)
    return tuple(known[name] for name in answers) if answers else tuple(ask.answers)


def _design(spread: Sequence[Distribution], samples: int, seed: int) -> Array:
    """Return the points A, B and A with one field from B each, array (d + 2, samples, d)."""
    d = len(spread)
    share = uniforms("sobol", 2 * d, seed, 0, samples, samples)
    one, two = (np.stack([spread[k].at(part[:, k]) for k in range(d)], axis=1) for part in (share[:, :d], share[:, d:]))
    points = np.stack([one, two, *[one] * d])
    for k in range(d):
        points[2 + k, :, k] = two[:, k]
    return points


def _indices(values: Array, weight: Array) -> tuple[Array, Array]:
    """Return first and total indices (r, s, d) of values (s, d + 2, n) about their mean, samples (r, n) weighted."""
    a, b, mixed = values[:, None, 0], values[:, None, 1], values[:, 2:]
    count = np.sum(weight, axis=1)[:, None]

    def mean(of: Array) -> Array:
        """Return weighted means (r, ...) of arrays (..., n)."""
        sums = (of.reshape(-1, of.shape[-1]) @ weight.T).reshape(*of.shape[:-1], -1)
        found: Array = np.moveaxis(sums, -1, 0) / count.reshape(-1, *[1] * (of.ndim - 1))
        return found

    ends = values[:, :2]
    variance = np.mean(mean(ends**2), axis=-1) - np.mean(mean(ends), axis=-1) ** 2
    size = np.mean(ends**2, axis=(1, 2))
    variance = np.where(variance > 1e-24 * size, variance, math.nan)[..., None]
    with np.errstate(invalid="ignore", divide="ignore"):
        return mean(b * (mixed - a)) / variance, 0.5 * mean((a - mixed) ** 2) / variance


def _ranges(values: Array, confidence: float, seed: int) -> tuple[Array, Array]:
    """Return the ranges (s, d, 2) of first and total indices, by samples drawn anew."""
    count = values.shape[-1]
    draw = np.random.default_rng([seed, 1])
    step = max(1, MOST // count)
    found: list[tuple[Array, Array]] = []
    for start in range(0, RESAMPLES, step):
        rows = min(step, RESAMPLES - start)
        found.append(_indices(values, draw.multinomial(count, np.full(count, 1.0 / count), size=rows).astype(float)))
    tail = 0.5 * (1.0 - confidence)
    first, total = (
        np.moveaxis(np.quantile(np.concatenate([one[k] for one in found]), [tail, 1.0 - tail], axis=0), 0, -1)
        for k in (0, 1)
    )
    return first, total


@dataclass(frozen=True, eq=False, kw_only=True)
class OneAtATime:
    """What answers (s) do when one field (d) at a time goes from one end of its range to the other.

    Attributes
    ----------
    fields, answers : tuple of Column
    here : array (d,)
        Where the others stand.
    low, high : array (d,)
        Ends of the ranges.
    middle : array (s,)
        Answers there.
    at_low, at_high : array (s, d)
        Answers with one field at the end of its range; nan where there is none.
    """

    fields: tuple[Column, ...]
    answers: tuple[Column, ...]
    here: Array
    low: Array
    high: Array
    middle: Array
    at_low: Array
    at_high: Array


def one_at_a_time(ask: Evaluator, here: Sequence[float], low: Sequence[float], high: Sequence[float]) -> OneAtATime:
    """Return the answers with one field at a time at either end of its range: 2d + 1 points.

    Parameters
    ----------
    ask : Evaluator
        What answers, over d fields.
    here, low, high : sequence of float (d,)
        Where the others stand, and the ends of the ranges.

    Returns
    -------
    Swings

    See Also
    --------
    sensitivity, evaluator

    Examples
    --------
    >>> from cardan.batch.answering.asking import Formula
    >>> from cardan.sweeps import one_at_a_time
    >>> ask = Formula.of(["x", "y"], {"z": lambda x, y: 3.0 * x + y})
    >>> found = one_at_a_time(ask, [0.0, 0.0], [-1.0, -1.0], [1.0, 1.0])
    >>> print(found.at_low, found.at_high)
    [[-3. -1.]] [[3. 1.]]
    """
    d = len(ask.points)
    middle, ends = np.asarray(here, dtype=float), [np.asarray(low, dtype=float), np.asarray(high, dtype=float)]
    points = np.tile(middle, (2 * d + 1, 1))
    for side, end in enumerate(ends):
        rows = 1 + side * d + np.arange(d)
        points[rows, np.arange(d)] = end
    rows_of = ask(points)
    table = np.stack([np.asarray(rows_of[column.name], dtype=float) for column in ask.answers])
    return OneAtATime(
        fields=ask.points,
        answers=ask.answers,
        here=middle,
        low=ends[0],
        high=ends[1],
        middle=table[:, 0],
        at_low=table[:, 1 : d + 1],
        at_high=table[:, d + 1 :],
    )
