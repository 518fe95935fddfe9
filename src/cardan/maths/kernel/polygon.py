"""Closing a polygon in the hyperbolic plane whose sides are SU(1,1) pairs and whose corners may turn.

A chain of pairs with free turns between them walks from the origin along sides of given lengths. How near to the origin
it can end, and the turns that take it there, follow from lengths alone, side by side, by the law of cosines of one
triangle each: no iteration, no starting value. The *diagonals* D_k, lengths of the first k sides together, are the free
choice; all closed polygons together are a convex polytope in them.

Everything works in batches (...) and as well on plain numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from cardan.maths.arrays import Array, argument, namespace, unit_complex

from . import mobius
from .mobius import Pair

BISECTIONS = 56
"""Halvings of a window of diagonals: as many as a double has digits."""


POINT = 1e-15
"""Below this length [-] a side is a point to rounding: its direction means nothing."""


class Closure(NamedTuple):
    """A closed, or nearly closed, polygon."""

    turns: list[Array]  # list of array (...) [rad]: angle added before side 2, 3 … of each polygon, modulo π
    pair: Pair  # (...): product of all sides and turns
    # list of bool array (...): where a turn has no effect, because the polygon is at the origin or the side has no
    # length
    loose: list[Array]


def reach(lengths: Sequence[Array]) -> tuple[Array, Array]:
    """Return the shortest and longest way from start to end of a polygon with sides of given lengths.

    By the triangle inequality exactly [max(0, 2 L_max - ΣL), ΣL].
    """
    xp = namespace(*lengths)
    total, longest = lengths[0], lengths[0]
    for one in lengths[1:]:
        total, longest = total + one, xp.maximum(longest, one)
    return xp.maximum(0.0 * total, 2.0 * longest - total), total


def windows(lengths: Sequence[Array], end: Array) -> list[tuple[Array, Array]]:
    """Return for each k the interval in which the diagonal D_k must lie if D_n is to be ``end``."""
    xp = namespace(end, *lengths)
    low = high = end
    found = [(low, high)]
    for side in reversed(lengths[1:]):
        low, high = xp.maximum(0.0 * low, xp.maximum(low - side, side - high)), high + side
        found.append((low, high))
    return found[::-1]


def shortest_diagonals(lengths: Sequence[Array], weights: Sequence[float], end: Array) -> list[Array]:
    """Return the diagonals to aim at so that Σ w_k sinh D_k becomes smallest.

    lengths, sequence of n arrays (...); weights: w_k ≥ 0 of the diagonal D_k; end (...): D_n.
    Returns list of n arrays (...): aim for D_k, given that every later diagonal follows its own aim; `close` keeps to
    the reachable.
    The reachable diagonals are a convex polytope and the sum is convex, so the least sum of the diagonals from k on is
    a convex function V_k of D_k, and the best D_k is the minimiser of V_k moved into the interval that D_{k-1} leaves.
    The aims are those minimisers, found from the end by halving on the sign of V_k'.
    """
    xp = namespace(end, *lengths)
    room = windows(lengths, end)
    n = len(lengths)
    aims = [low for low, _ in room]
    for k in range(n - 4, 0, -1):
        low, high = room[k]
        for _step in range(BISECTIONS):
            middle = 0.5 * (low + high)
            rising = _slope(middle, k, lengths, weights, aims) >= 0.0
            low, high = xp.where(rising, low, middle), xp.where(rising, middle, high)
        at_low = _slope(room[k][0], k, lengths, weights, aims) >= 0.0
        aims[k] = xp.where(at_low, room[k][0], high)
    return aims


def _slope(start: Array, k: int, lengths: Sequence[Array], weights: Sequence[float], aims: Sequence[Array]) -> Array:
    """Return V_k' at D_k = ``start``: the sum along the path that the later aims give."""
    xp = namespace(start, *lengths)
    here, sense = start, 1.0 + 0.0 * start
    total = weights[k] * xp.cosh(start)
    for j in range(k + 1, len(lengths) - 2):
        side, aim = lengths[j], aims[j]
        inner, outer = xp.abs(here - side), here + side
        bent = xp.where(here < side, -sense, sense)
        sense = xp.where(aim < inner, bent, xp.where(aim > outer, sense, 0.0 * sense))
        if not xp.any(sense != 0.0):
            break
        here = xp.where(aim < inner, inner, xp.where(aim > outer, outer, aim))
        total = total + weights[j] * xp.cosh(here) * sense
    return total


def close(
    sides: Sequence[Pair],
    *,
    end: Array | None = None,
    aims: Sequence[Array] | None = None,
    folds: Sequence[float] | None = None,
    keep: Sequence[Array] | None = None,
) -> Closure:
    """Return turns between the sides that bring the end of the polygon to a given distance from its start.

    sides, sequence of n Pair (...): the sides in order.
    end (...): distance between start and end, within `reach`; the shortest by default.
    aims, sequence of n arrays (...): diagonals wished for; each is moved into what the sides before and after allow.
    The shortest by default.
    folds: +1 or -1: to which side the polygon turns at side k; -1 everywhere mirrors it. The first one is not used.
    keep, sequence of n-1 arrays (...) [rad]: turns to keep where they have no effect.

    With D = D_{k-1}, L = L_k, X = D_k: sin²m = sinh((D+L+X)/2) sinh((D+L-X)/2)/(sinh D sinh L), cos²m =
    sinh((X+D-L)/2) sinh((X-D+L)/2)/(sinh D sinh L); the turn is μ_k = ±m - arg(a b c d*)/2 for the product (a, b) so
    far and the side (c, d). The half-angle form keeps all digits where an acos keeps half of them.
    """
    lengths = [mobius.length(side) for side in sides]
    target = reach(lengths)[0] if end is None else end
    room = windows(lengths, target)
    here = sides[0]
    xp = namespace(*here)
    turns: list[Array] = []
    loose: list[Array] = []
    for k in range(1, len(sides)):
        side, step = sides[k], lengths[k]
        far = mobius.length(here)
        low, high = room[k]
        least, most = xp.maximum(xp.abs(far - step), low), xp.minimum(far + step, high)
        wish = least if aims is None else xp.minimum(xp.maximum(aims[k], least), xp.maximum(most, least))
        fold = 1.0 if folds is None else folds[k]
        free = (far <= POINT) | (step <= POINT)
        angle = fold * _half_turn(far, step, wish) - 0.5 * argument(here[0] * here[1] * side[0] * xp.conj(side[1]))
        if keep is not None:
            angle = xp.where(free, keep[k - 1], angle)
        spin = unit_complex(angle)
        here = mobius.compose(side, (spin * here[0], spin * here[1]))
        turns.append(angle)
        loose.append(free)
    return Closure(turns, here, loose)


def _half_turn(far: Array, step: Array, wish: Array) -> Array:
    """Return m in [0, π/2] for the triangle with sides ``far``, ``step`` and ``wish``."""
    xp = namespace(far, step, wish)
    total = far + step
    sine = xp.sinh(0.5 * (total + wish)) * xp.sinh(0.5 * (total - wish))
    cosine = xp.sinh(0.5 * (wish + far - step)) * xp.sinh(0.5 * (wish - far + step))
    zero = 0.0 * sine
    return xp.atan2(xp.sqrt(xp.maximum(sine, zero)), xp.sqrt(xp.maximum(cosine, zero)))
