"""Which tolerances keep the output within its allowed error at the least cost?"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

import numpy as np

from cardan.drive.accuracy import Tolerance
from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array
from cardan.texts import _

from .accuracy import WAYS, error_arrays, located_shafts, one_turn, sensitivity, transmission_error, way_names
from .own_laws import dimension, seats, table_of
from .pair_errors import PairError, pair_errors
from .tolerance import Linear, Spread, WorstCase, norm, spreads

FLAT = 1e-9
"""Influences below this share of the largest are none."""

BETWEEN = 100
"""Positions looked at to either side of one where the error has a peak."""

NEAR = 0.999
"""Peaks above this share of the target may exceed it between the positions looked at."""

OVER = 1e-7
"""Share of the target by which it may be exceeded."""

PASSES = 6
"""Most times that positions between are added; it takes one or two."""

SHARE = 1e-6
"""Share of the largest price above which a position decides."""

SQUARES = Linear()
"""How errors add up where nothing else is said."""


class Of(StrEnum):
    """What is to be kept small."""

    ANGLE = "angle"
    """Error of the output angle at any position [rad]."""
    CHANGE = "change"
    """Error of the output angle less its mean over the turn, which setting the drive up takes away [rad]."""
    SHIFT = "shift"
    """Shift of the output shaft at any position [m]."""


@dataclass(frozen=True, kw_only=True, slots=True)
class Allotted:
    """One tolerance as allotted."""

    joint: int  # number of its joint, from 1
    key: str  # its key, ``alpha2``
    dimension: str = "angle"  # of it, "" of a pure number
    tolerance: float  # ± in SI; infinite where it has no influence
    cost: float  # what it costs, its weight over the tolerance
    weight: float  # its weight in the cost
    kept: bool  # whether it was given and not to be changed
    before: float  # the tolerance of the drive so far; 0 where none is given

    @property
    def field(self) -> str:
        """Path of the tolerance in the drive."""
        return f"joints[{self.joint - 1}].tolerance.{self.key}"


@dataclass(frozen=True, eq=False, kw_only=True)
class Allocation:
    """The cheapest tolerances for an allowed error of the output.

    Attributes
    ----------
    target : float
        The error allowed, ± [rad or m].
    of : Of
        Of what.
    method : Linear or WorstCase
        How errors add up.
    rows : tuple of Allotted
        Every tolerance that was to be found or was kept, joint by joint.
    spread : tuple of n Tolerance
        The tolerances found, those without influence left out, to be asked on.
    cost : float
        Cost of all tolerances that were found.
    equal_cost : float
        Cost if each of them took the same share of the target.
    largest : float
        Error that they leave at the worst position by the method: the target.
    angle : array (p,) [rad]
        Input angles over half a turn or a turn.
    error : array (p,)
        What the tolerances found add up to there.
    binding : tuple of float [rad]
        Input angles at which the error allowed is reached.
    optimality : float
        By how much the conditions of the least cost are missed, as a share: the gap between the cost and a bound below
        which no tolerances keep the target.
    """

    target: float
    of: Of
    method: Linear | WorstCase
    rows: tuple[Allotted, ...]
    spread: tuple[Tolerance, ...]
    cost: float
    equal_cost: float
    largest: float
    angle: Array
    error: Array
    binding: tuple[float, ...]
    optimality: float


def allocate(
    drive: Drive,
    target: float,
    *,
    of: Of | str = Of.ANGLE,
    method: Linear | WorstCase = SQUARES,
    spread: Spread = None,
    keep: Sequence[str] = (),
) -> Allocation:
    """Return the cheapest tolerances that keep the output within an allowed error all round a turn.

    Parameters
    ----------
    drive : Drive
        The drive; the costs of its tolerances are weights w, a tolerance t costs w/t; 1 where none is given. Lengths
        and ratios inside a joint count by their share of the size. What its known errors make is taken off the target,
        and what tolerances of pairs in mechanism files do counts as kept.
    target : float
        The error allowed, ± [rad], of the shift [m].
    of : Of
        "angle", "change" or "shift".
    method : Linear or WorstCase
        Root of the sum of squares, or the worst case.
    spread : Tolerance, or n of them, optional
        Costs, and tolerances to be kept; those of the drive by default.
    keep : sequence of str
        Paths of tolerances to be kept as given, ``joints[0].tolerance.alpha4``.

    Returns
    -------
    Allocation

    Raises
    ------
    InputError
        The target is not above zero; known errors and what is kept use it up; what is kept is not given.

    See Also
    --------
    tolerance, transmission_error

    Notes
    -----
    Least Σ w/t under Σ \\|C(φ)\\|^q t^q ≤ target^q at every φ, q = 2 or 1. In x = t^q the bounds are linear and the
    cost is strictly convex: there is one optimum. If one position alone decides, t = (w/(q λ \\|C\\|^q))^(1/(q+1));
    else λ \\|C\\|^q is a sum over the positions where the bound is reached, found by an interior-point method and
    proved by the bound that λ gives. Positions between those looked at are added where they exceed the target.

    Examples
    --------
    >>> from cardan import Drive, allocate
    >>> from cardan.units import deg
    >>> found = allocate(Drive.from_angles([30 * deg]), 0.1 * deg)
    >>> [f"{one.field.split('.')[-1]} {one.tolerance / deg:.3f}°" for one in found.rows]
    ['phase 0.051°', 'alpha1 0.111°', 'alpha2 0.049°', 'alpha3 0.088°', 'alpha4 0.125°']
    """
    kind = _kind(of)
    names = way_names(drive.joints) if kind is Of.SHIFT else seats(drive.joints)
    given = spreads(drive, spread)
    limits = error_arrays(given, drive.joints)[int(kind is Of.SHIFT)]
    weights = np.asarray(
        [
            [_weight(row, name, joint) for name in one]
            for joint, row, one in zip(drive.joints, given, names, strict=True)
        ]
    )
    scale = np.asarray([_scale(joint, name) for joint, one in zip(drive.joints, names, strict=True) for name in one])
    fields = [f"joints[{j}].tolerance.{name}" if name else "" for j, row in enumerate(names) for name in row]
    kept = np.asarray([field in keep for field in fields])
    check(_problems(target, keep, fields, limits.reshape(-1)))
    budget = _Budget(drive, kind, power=1 if isinstance(method, WorstCase) else 2, target=target)
    flat, weight = limits.reshape(-1), weights.reshape(-1) * scale
    phi = one_turn()
    most = np.max(budget(phi)[0], axis=0)
    free = ~kept & np.asarray([bool(field) for field in fields]) & (most > FLAT**budget.power * np.max(most))
    if not np.any(free):
        raise refuse("keep", _("no tolerance with an influence is left to be found"))
    place, more, tolerances = phi, phi[:0], np.full(len(fields), np.inf)
    tolerances[kept] = flat[kept]
    for _pass in range(PASSES):
        place = np.concatenate((place, more))
        found, use = _cheapest(budget, place, flat, weight, kept, free)
        tolerances[free] = found.value
        finite = np.where(np.isfinite(tolerances), tolerances, 0.0)
        more = _between(budget.error, finite, phi, target)
        if not len(more):
            break
    costs = weight / tolerances
    equal = _equal(use, budget.power)
    return Allocation(
        target=target,
        of=kind,
        method=method,
        rows=tuple(
            Allotted(
                joint=k // len(names[0]) + 1,
                key=key,
                dimension=dimension(drive.joints[k // len(names[0])], key),
                tolerance=float(tolerances[k]),
                cost=float(costs[k]),
                weight=float(weight[k] / scale[k]),
                kept=bool(kept[k]),
                before=float(flat[k]),
            )
            for k, key in enumerate(name for row in names for name in row)
            if key
        ),
        spread=_spread(drive, given, names, finite.reshape(limits.shape)),
        cost=float(np.sum(costs[free])),
        equal_cost=float(np.sum(weight[free] / equal)),
        largest=float(np.max(budget.error(place, finite))),
        angle=phi,
        error=budget.error(phi, finite),
        binding=_binding(place, found.price, float(phi[1])),
        optimality=found.gap,
    )


class _Budget:
    """What each tolerance uses of the error allowed, and what there is, to the power at which errors add up."""

    def __init__(self, drive: Drive, kind: Of, *, power: int, target: float) -> None:
        self.drive, self.kind, self.power, self.target = drive, kind, power, target
        self.held = located_shafts(drive) if kind is Of.SHIFT else ()
        turn = one_turn()
        table, centre = self._at(turn)
        change = kind is Of.CHANGE
        self.mean = table.mean(axis=0) if change else 0.0 * table[0]
        self.pair_means = [one.table.mean(axis=0) if change else np.zeros(3) for one in self._pairs(turn)]
        self.centre = float(np.mean(centre)) if change else 0.0

    def _at(self, phi: Array) -> tuple[Array, Array]:
        known = transmission_error(self.drive, phi)
        table = sensitivity(self.drive, phi, located=self.held)
        table = table[..., : len(WAYS)] if self.kind is Of.SHIFT else table
        centre = known.output_shift if self.kind is Of.SHIFT else known.error
        return table.reshape(len(phi), -1), centre

    def _pairs(self, phi: Array) -> tuple[PairError, ...]:
        """Return what pairs inside joints may be off: their tolerances are kept as their mechanism files have them."""
        return () if self.kind is Of.SHIFT else pair_errors(self.drive, phi)

    def _kept(self, phi: Array) -> Array:
        """Return the powers (p,) of what these make, together."""
        rows = zip(self._pairs(phi), self.pair_means, strict=True)
        return sum((norm(one.tolerance * (one.table - mean)) ** self.power for one, mean in rows), 0.0 * phi)

    def __call__(self, phi: Array) -> tuple[Array, Array]:
        """Return the powers of the influences (p, m) and of what known errors leave of the target (p,), signed."""
        table, centre = self._at(phi)
        left = self.target - np.abs(centre - self.centre)
        room = np.sign(left) * np.abs(left) ** self.power - self._kept(phi)
        return np.abs(table - self.mean) ** self.power, room

    def error(self, phi: Array, tolerances: Array) -> Array:
        """Return known errors and tolerances (m,) together at each position."""
        table, centre = self._at(phi)
        own = np.abs(table - self.mean) ** self.power @ tolerances**self.power
        spread: Array = (own + self._kept(phi)) ** (1.0 / self.power)
        return np.abs(centre - self.centre) + spread


def _cheapest(
    budget: _Budget, place: Array, flat: Array, weight: Array, kept: Array, free: Array
) -> tuple[Cheapest, Array]:
    """Return the cheapest tolerances for given positions, and what share of the room each uses there."""
    influence, room = budget(place)
    left = room - influence[:, kept] @ flat[kept] ** budget.power
    if np.any(left <= 0.0):
        raise refuse("target", _("known errors and the tolerances that are kept use up the error allowed"))
    use = influence[:, free] / left[:, None]
    return cheapest(weight[free], use, budget.power), use


def _between(error: Callable[[Array, Array], Array], tolerances: Array, turn: Array, target: float) -> Array:
    """Return places between those of a turn at which tolerances exceed the target."""
    here = error(turn, tolerances)
    top = (here > np.roll(here, 1)) & (here >= np.roll(here, -1)) & (here > NEAR * target)
    around = turn[top][:, None] + float(turn[1]) * np.linspace(-1.0, 1.0, 2 * BETWEEN + 1)
    if not around.size:
        return turn[:0]
    there = error(around.reshape(-1), tolerances).reshape(around.shape)
    best = np.take_along_axis(around, np.argmax(there, axis=-1)[:, None], axis=-1)[:, 0]
    found: Array = np.mod(best[np.max(there, axis=-1) > (1.0 + OVER) * target], 2.0 * np.pi)
    return found


def _binding(place: Array, price: Array, step: float) -> tuple[float, ...]:
    """Return the positions that decide, neighbours taken together by their prices."""
    order = np.argsort(place)
    place, price = place[order], price[order]
    some = price > SHARE * np.max(price)
    place, price = place[some], price[some]
    groups = np.split(np.arange(len(place)), np.flatnonzero(np.diff(place) > 1.5 * step) + 1)
    return tuple(float(np.average(place[one], weights=price[one])) for one in groups)


def _kind(of: Of | str) -> Of:
    try:
        return Of(of)
    except ValueError:
        text = _("{value} is none of {choices}")
        raise refuse("of", text.format(value=repr(of), choices=", ".join(Of))) from None


def _weight(row: Tolerance | None, name: str, joint: Joint) -> float:
    cost = table_of(joint, "cost")() if row is None or row.cost is None else row.cost
    weight: float = getattr(cost, name, 1.0)
    return weight


def _scale(joint: Joint, name: str) -> float:
    """Return what a tolerance is measured by in its cost: a size of a kind by itself, all else by its unit of SI."""
    size = joint.sizes().get(name)
    return abs(size) if size and dimension(joint, name) != "angle" else 1.0


def _problems(target: float, keep: Sequence[str], fields: Sequence[str], limits: Array) -> list[Problem]:
    problems = []
    if not (np.isfinite(target) and target > 0.0):
        problems.append(Problem("target", _("{given} given; it must be above zero").format(given=target)))
    for name in keep:
        if name not in fields:
            text = _("{name} is none of {choices}")
            problems.append(Problem("keep", text.format(name=name, choices=", ".join(filter(None, fields)))))
        elif limits[fields.index(name)] <= 0.0:
            problems.append(Problem(name, _("missing; it is to be kept")))
    return problems


def _equal(use: Array, power: int) -> Array:
    """Return tolerances that each take the same share of the target at its own worst position."""
    share: Array = (1.0 / (use.shape[-1] * np.max(use, axis=0))) ** (1.0 / power)
    return share


def _spread(
    drive: Drive, given: Sequence[Tolerance | None], names: Sequence[Sequence[str]], values: Array
) -> tuple[Tolerance, ...]:
    rows = [table_of(joint)() if row is None else row for joint, row in zip(drive.joints, given, strict=True)]
    found: list[dict[str, Any]] = [
        {name: float(value) for name, value in zip(names[j], row, strict=True) if name} for j, row in enumerate(values)
    ]
    return tuple(replace(row, **one) for row, one in zip(rows, found, strict=True))


# The cheapest of numbers that must share a budget at every one of several places.

ROUNDS = 80
"""Most steps of the interior-point method; it takes about twenty."""

GAP = 1e-13
"""Share of the cost by which the optimum may be missed."""

TINY = 1e-25
"""Below this share of the cost at a place nothing is left to be gained but rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Cheapest:
    """The cheapest numbers, and the proof."""

    value: Array  # (m,): the numbers t
    price: Array  # (p,): what a bound at each place costs at the margin, λ ≥ 0; zero where there is room left
    # cost less the bound that λ proves, as a share of the cost; no numbers within the bounds cost less than that
    gap: float


def single(weight: Array, use: Array, power: int) -> Array:
    """Return the t of least Σ w/t with Σ u t^q = 1 at a single place, in closed form; array (m,).

    weight (m,): w > 0; use (m,): u > 0; power: q.
    w/t² = λ q u t^(q-1), so t = (w/u)^(1/(q+1)) times a constant.
    """
    shape = (weight / use) ** (1.0 / (power + 1))
    found: Array = shape / np.sum(use * shape**power) ** (1.0 / power)
    return found


def cheapest(weight: Array, use: Array, power: int) -> Cheapest:
    """Return the t of least Σ w/t with Σ u t^q ≤ 1 at every place.

    weight (m,): w > 0; use (p, m): u ≥ 0, each column with something above zero; power: q ≥ 1.
    In x = t^q the bounds are linear and Σ w x^(-1/q) is strictly convex. Primal-dual interior-point steps, with x kept
    within the bounds and λ ≥ 0 throughout; x = (w/(q Σ λ u))^(q/(q+1)) of the last λ, drawn into the bounds, is the
    answer, and the Lagrange function there bounds the cost from below.
    """
    places = use.shape[0]
    scale = single(weight, np.max(use, axis=0), power)  # of the right order, and within the bounds
    whole = float(np.sum(weight / scale))
    u, w = use * scale**power, weight / scale / whole
    share = 1.0 / power
    x, price = np.full(len(w), 0.5), np.full(places, 1.0 / places)
    room = 1.0 - u @ x  # followed by its own steps: the difference loses its digits where a bound is reached
    best = _proved(w, u, power, price)
    for _round in range(ROUNDS):
        if best.gap < GAP:
            break
        root = np.sqrt(share * (share + 1.0) * w * x ** (-share - 2.0))  # of the curvature of the cost
        missing = price @ u - share * w * x ** (-share - 1.0)
        target = 0.1 * float(price @ room) / places
        bent = u / root
        force = -(missing + (target / room - price) @ u) / root
        # E + bentᵀ diag(λ/room) bent by its triangular root: the product would lose E beside large λ/room.
        upper: Array = np.linalg.qr(np.concatenate((np.eye(len(w)), bent * np.sqrt(price / room)[:, None])), mode="r")
        step = np.linalg.solve(upper, np.linalg.solve(upper.T, force)) / root
        along = u @ step
        price_step = (target + price * along) / room - price
        go = min(1.0, 0.995 * min(_way(x, step), _way(room, -along), _way(price, price_step)))
        x, room, price = x + go * step, room - go * along, price + go * price_step
        now = _proved(w, u, power, price)
        best = now if now.gap < best.gap else best
        if not target > TINY:
            break
    return Cheapest(value=best.value * scale, price=best.price * whole, gap=best.gap)


def _way(values: Array, step: Array) -> float:
    """Return how far positive values can go along a step before one of them is zero."""
    down = step < 0.0
    return float(np.min(-values[down] / step[down])) if np.any(down) else np.inf


def _proved(w: Array, u: Array, power: int, price: Array) -> Cheapest:
    """Return the x that prices ask for, drawn into the bounds, and how far it is from the bound they prove."""
    share = 1.0 / power
    x = (share * w / (price @ u)) ** (power / (power + 1.0))
    bound = float(np.sum(w * x**-share) + price @ (u @ x - 1.0))
    within = x / np.max(u @ x)
    cost = float(np.sum(w * within**-share))
    return Cheapest(value=within**share, price=price, gap=max(cost - bound, 0.0) / cost)
