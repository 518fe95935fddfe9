"""Will a mechanism move, and where is it held more than it needs?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from cardan.drive.drive import Drive
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws
from cardan.mechanism.constraints import Constraints, constraints
from cardan.mechanism.mechanism import Mechanism, Pair, axes
from cardan.mechanism.rounding import exactly

from .drive_mechanism import mechanism_of

Hold: TypeAlias = Literal["free", "needed", "strained"]

TAKES_PART = 1e-7
"""A share of a state of stress, or of a motion, below this is nothing but rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class JointHold:
    """What a joint holds, and what of it is one too many."""

    id: str  # name of the joint
    links: tuple[str, str]  # what it joins
    type: str  # its kind
    axes: Array  # (3, 3): its own axes: along it, and two across
    # turning, sliding: about and along each of its axes: free already; held, and needed; held, while other joints hold
    # the same, so that parts that are off strain it
    turning: tuple[Hold, Hold, Hold]
    sliding: tuple[Hold, Hold, Hold]
    # force, couple (m, 3) [N, N·m]: the m independent loads that errors of the parts can put on it: force of the first
    # link on the second and couple about its point, in its own axes, up to a factor
    force: Array
    couple: Array  # (m, 3) [N·m]
    misalignment: float  # [m]: how much of what it is off the mechanism cannot take up

    @property
    def strained(self) -> bool:
        """Whether it takes part in any state of stress."""
        return len(self.force) > 0


@dataclass(frozen=True, eq=False, kw_only=True)
class Mobility:
    """How a mechanism moves and how far it is over-constrained, in the position given.

    Attributes
    ----------
    mechanism : Mechanism
        What was looked at.
    links : int
        Moving links n.
    loops : int
        Independent loops k.
    constraints : int
        Sum of the constraints of all joints Σs.
    rank : int
        How many of them differ.
    mobility : int
        True mobility W = 6n - rank.
    redundant : int
        Redundant constraints q = Σs - rank.
    formula : int
        Mobility by counting, 6n - Σs = W - q.
    certain : bool
        Whether the rank is; where not, the mechanism stands next to a special position.
    loop_mobility, loop_redundant : int
        The same two numbers from the freedoms around the loops.
    driven : int or None
        In how many ways the input link moves; None where none is named.
    local : int or None
        Motions in which neither input nor output moves.
    parasitic : int or None
        Motions left while the input stands still, but for the local ones.
    joints : tuple of JointHold
        What each joint holds.
    motion : array (W, n, 6) [rad/s, m/s]
        Possible motions, orthonormal in the size of the mechanism: of each link how fast it turns, and how fast its
        point at the origin moves.
    adrift : tuple of str
        Links that can move while the input link stands still.
    misalignment : float [m]
        How much of what the parts are off has to be forced into place: root of the sum of squares of what the joints
        must give, shared as evenly as can be.
    """

    mechanism: Mechanism
    links: int
    loops: int
    constraints: int
    rank: int
    mobility: int
    redundant: int
    formula: int
    certain: bool
    loop_mobility: int
    loop_redundant: int
    driven: int | None
    local: int | None
    parasitic: int | None
    joints: tuple[JointHold, ...]
    motion: Array
    adrift: tuple[str, ...]
    misalignment: float

    @property
    def agrees(self) -> bool:
        """Whether both formulations of the rank, by joints and by loops, tell the same."""
        return (self.mobility, self.redundant) == (self.loop_mobility, self.loop_redundant)

    @property
    def underconstrained(self) -> bool:
        """Whether something can move that should not: links while the input stands still, or the input in two ways."""
        return bool(self.parasitic) or (self.driven or 0) > 1

    @property
    def strained(self) -> tuple[str, ...]:
        """Names of the joints that parts which are off can strain."""
        return tuple(one.id for one in self.joints if one.strained)


def mobility(thing: Drive | Mechanism) -> Mobility:
    """Return true mobility and redundant constraints of a drive or of any mechanism.

    Parameters
    ----------
    thing : Drive or Mechanism
        A drive becomes a mechanism of shafts, crosses, splines and supports in its start position, see
        `cardan.questions.mobility.drive_mechanism.mechanism_of`.

    Returns
    -------
    Mobility

    Raises
    ------
    InputError
        A drive without supports, or one with a shaft that nothing joins to the frame.

    See Also
    --------
    mobility_over_turn, release, repairs

    Notes
    -----
    Twists t of the moving links meet w·(t_b - t_a) = 0 for every wrench w that a joint holds; G has these rows, r is
    its rank by singular values, lengths over the size of the mechanism. W = 6n - r, q = Σs - r (Book p. 11-16, exact
    by screws; tmm (1.1)-(1.5) give W - q alone). The left null space of G are the states of reactions that balance each
    other. Checked by the freedoms around the loops J: W = Σf - rank J, q = 6k - rank J.

    Examples
    --------
    A Hooke joint between two shafts in stiff bearings is held three times too often:

    >>> from cardan import mobility
    >>> from cardan.mechanisms import Mechanism, Pair
    >>> def hinge(name, links, point, axis):
    ...     return Pair(id=name, type="R", links=links, point=point, axis=axis)
    >>> origin = (0.0, 0.0, 0.0)
    >>> hooke = Mechanism(
    ...     frame="0",
    ...     input_link="1",
    ...     output_link="3",
    ...     joints=(
    ...         hinge("A", ("0", "1"), (-0.3, 0.0, 0.0), (1.0, 0.0, 0.0)),
    ...         hinge("B", ("1", "2"), origin, (0.0, 1.0, 0.0)),
    ...         hinge("C", ("2", "3"), origin, (0.0, 0.0, 1.0)),
    ...         hinge("D", ("3", "0"), (0.3, 0.1, 0.0), (0.3, 0.1, 0.0)),
    ...     ),
    ... )
    >>> found = mobility(hooke)
    >>> found.formula, found.mobility, found.redundant
    (-2, 1, 3)
    >>> found.joints[3].sliding
    ('strained', 'strained', 'strained')
    """
    if isinstance(thing, Mechanism):
        return _mobility(exactly(thing))
    return _mobility(mechanism_of(thing))


def _mobility(mechanism: Mechanism) -> Mobility:
    system = constraints(mechanism)
    matrix = system.matrix()
    rank, stress, motion = screws.null_spaces(matrix)
    loops = system.loop_matrix()
    around = screws.rank(loops)
    driven, local, parasitic = _driven(mechanism, system, matrix, len(motion))
    shares = _shares(system, stress)
    return Mobility(
        mechanism=mechanism,
        links=system.links,
        loops=mechanism.loops,
        constraints=matrix.shape[0],
        rank=rank.value,
        mobility=matrix.shape[1] - rank.value,
        redundant=matrix.shape[0] - rank.value,
        formula=mechanism.formula,
        certain=rank.certain,
        loop_mobility=loops.shape[1] - around.value,
        loop_redundant=loops.shape[0] - around.value,
        driven=driven,
        local=local,
        parasitic=parasitic,
        joints=tuple(_hold(pair, system, shares, j) for j, pair in enumerate(mechanism.joints)),
        motion=_in_metres(system, motion),
        adrift=_adrift(mechanism, system, matrix, len(motion) - (driven or 0)),
        misalignment=_misalignment(mechanism.joints, system, shares),
    )


def stresses(system: Constraints) -> Array:
    """Return the states of reactions that balance each other, array (q, joints, 6): wrenches about the middle."""
    return _shares(system, screws.null_spaces(system.matrix())[1])


def _shares(system: Constraints, stress: Array) -> Array:
    """Return the wrench of every joint in each state, array (q, joints, 6)."""
    out = np.zeros((len(stress), len(system.ends), 6))
    start = 0
    for j, held in enumerate(system.wrenches):
        out[:, j] = stress[:, start : start + len(held)] @ held
        start += len(held)
    return out


def _driven(
    mechanism: Mechanism, system: Constraints, matrix: Array, free: int
) -> tuple[int | None, int | None, int | None]:
    """Return in how many ways the input moves, and the motions that are local and parasitic."""
    named = [mechanism.links.index(one) for one in (mechanism.input_link, mechanism.output_link) if one]
    local = left(system, matrix, named) if named else None
    if not mechanism.input_link:
        return None, local, None
    driven = free - left(system, matrix, named[:1])
    return driven, local, free - local - driven if local is not None else None


def left(system: Constraints, matrix: Array, held: Sequence[int]) -> int:
    """Return how many motions are left while some links, counted from 0, are held fast."""
    return 6 * system.links - screws.rank(np.concatenate((matrix, system.holding(held)))).value


def _adrift(mechanism: Mechanism, system: Constraints, matrix: Array, freed: int) -> tuple[str, ...]:
    """Return the links that can move in any of the motions left while the input stands still."""
    if not mechanism.input_link or not freed:
        return ()
    held = system.holding([mechanism.links.index(mechanism.input_link)])
    free = screws.null_spaces(np.concatenate((matrix, held)))[2]
    if not len(free):
        return ()
    moves = np.max(np.abs(free.reshape(len(free), system.links, 6)), axis=(0, 2))
    return tuple(link for link, size in zip(mechanism.links, moves, strict=True) if size > TAKES_PART)


def _hold(pair: Pair, system: Constraints, shares: Array, j: int) -> JointHold:
    """Return what one joint holds: its states of stress at its own point and in its own axes."""
    own = axes(pair)
    point = system.place(pair.point)
    force = shares[:, j, 3:]
    couple = shares[:, j, :3] - frames.cross(np.broadcast_to(point, force.shape), force)
    free = screws.independent(system.freedoms[j])

    def holds(twists: Array, components: Array) -> tuple[Hold, Hold, Hold]:
        words: list[Hold] = []
        for twist, part in zip(twists, components.T, strict=True):
            rest = twist - free.T @ (free @ twist)
            if np.linalg.norm(rest) <= TAKES_PART * np.linalg.norm(twist):
                words.append("free")
            else:
                words.append("strained" if np.max(np.abs(part), initial=0.0) > TAKES_PART else "needed")
        return words[0], words[1], words[2]

    force, couple = force @ own.T, couple @ own.T
    turning = holds(screws.rotation(own, point), couple)
    sliding = holds(screws.translation(own), force)
    table = _echelon(np.concatenate((force, couple), axis=-1)) if len(force) else np.zeros((0, 6))
    off = float(np.linalg.norm(_off(pair, system) @ shares[:, j].T)) * system.size
    return JointHold(
        id=pair.id,
        links=pair.links,
        type=pair.type,
        axes=own,
        turning=turning,
        sliding=sliding,
        force=table[:, :3],
        couple=table[:, 3:] * system.size,
        misalignment=off if off > TAKES_PART * system.size else 0.0,
    )


def _echelon(rows: Array) -> Array:
    """Return a basis of the span of rows (q, c) in which each has a component of its own equal to one."""
    table = np.asarray(rows, dtype=float).copy()
    done = 0
    for column in range(table.shape[1]):
        if done == len(table):
            break
        best = done + int(np.argmax(np.abs(table[done:, column])))
        if abs(table[best, column]) <= TAKES_PART:
            continue
        table[[done, best]] = table[[best, done]]
        table[done] /= table[done, column]
        for k in range(len(table)):
            if k != done:
                table[k] -= table[k, column] * table[done]
        done += 1
    table[np.abs(table) <= TAKES_PART] = 0.0
    return table[:done]


def _off(pair: Pair, system: Constraints) -> Array:
    """Return the misalignment of a joint as a small displacement (6,) of its second link, about the middle."""
    turn, shift = np.asarray(pair.misalignment_turn), np.asarray(pair.misalignment) / system.size
    return np.concatenate((turn, shift + frames.cross(system.place(pair.point), turn)))


def _misalignment(pairs: Sequence[Pair], system: Constraints, shares: Array) -> float:
    gap = sum((shares[:, j] @ _off(pair, system) for j, pair in enumerate(pairs)), np.zeros(len(shares)))
    found = float(np.linalg.norm(gap)) * system.size
    return found if found > TAKES_PART * system.size else 0.0


def _in_metres(system: Constraints, motion: Array) -> Array:
    """Return motions (W, 6n) about the middle as those about the origin [rad/s, m/s]."""
    twists = motion.reshape(len(motion), system.links, 6)
    turning = twists[..., :3]
    moving = twists[..., 3:] * system.size - frames.cross(turning, np.broadcast_to(system.middle, turning.shape))
    return np.concatenate((turning, moving), axis=-1)


__all__ = ["JointHold", "Mobility", "mobility", "stresses"]
