"""Does a mechanism turn far, not only a little? Its loops closed step by step while one joint is driven."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial, reduce
from itertools import pairwise

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames, screws
from cardan.mechanism.constraints import FRAME, constraints, spanning_tree
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.rounding import exactly
from cardan.mechanism.turning import travel, turned
from cardan.texts import _
from cardan.units import deg, nearest

from .drive_mechanism import mechanism_of

STEP = 4 * deg
"""Largest step of the driven joint; loops are followed from one position to the next."""

MOST_STEPS = 10_000
"""More steps are refused: they would take minutes. As many follow a joint over 111 turns."""

ROUNDS = 200
"""Most rounds of one closure; where loops close a few do."""

SHUT, NEAR = 1e-30, 1e-22
"""Sum of squares at which a closure is complete, and below which it ends when it hardly gets better: rounding."""

FINE = 1e-6
"""Share of a range to which its end is found."""

CLOSED = 1e-8
"""Misfit of the loops below which they count as closed [m, rad]."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FiniteMobility:
    """Loops of a mechanism while one joint is driven.

    Attributes
    ----------
    mechanism : Mechanism
        What was looked at.
    position : array (p,) [rad]
        How far the joint is driven, the start included; [m] where it slides.
    residual : array (p,)
        What keeps the loops from closing: root of the sum of squares of gaps [m] and turns [rad] at all cut joints.
    gap : array (p,) [m]
        Largest gap at a cut joint.
    turn : array (p,) [rad]
        Largest turn at a cut joint.
    displacement : array (p, n, 4, 4)
        Displacement of every moving link from the position given.
    tolerance : float
        Residual up to which loops count as closed.
    cancelled : bool
        Whether ``progress`` said "stop"; the arrays then end there.
    slides : bool
        Whether the driven joint slides.
    """

    mechanism: Mechanism
    position: Array
    residual: Array
    gap: Array
    turn: Array
    displacement: Array
    tolerance: float
    cancelled: bool = False
    slides: bool = False

    @property
    def closes(self) -> bool:
        """Whether the loops close at every step."""
        return bool(np.all(self.residual < self.tolerance))

    @property
    def worst(self) -> int:
        """At which step the residual is largest."""
        return int(np.argmax(self.residual))

    def at(self, step: int) -> Mechanism:
        """Return the mechanism as it stands after a step."""
        return displaced(self.mechanism, self.displacement[step])


def finite_mobility(
    mechanism: Mechanism,
    *,
    driven_joint: str = "",
    angle: float | None = None,
    tolerance: float = CLOSED,
    steps: int | None = None,
    progress: Callable[[float], object] | None = None,
) -> FiniteMobility:
    """Return how well the loops of a mechanism close while one joint turns.

    Parameters
    ----------
    mechanism : Mechanism
        In its assembled position.
    driven_joint : str
        Name of a joint that turns or slides; that of the input where none is named.
    angle : float [rad], optional
        How far it is driven; [m] where it slides. A whole turn by default, of the input to the end of its range.
    tolerance : float
        Residual up to which loops count as closed [m, rad].
    steps : int, optional
        Number of steps; as many as keep each below 4° by default.
    progress : function, optional
        Called with the share done; answering "stop" ends there.

    Returns
    -------
    FiniteMobility
        residual, gap, turn : arrays (p,); displacement : array (p, n, 4, 4)

    Raises
    ------
    InputError
        No such joint; an angle, a tolerance or a number of steps that is none, or no angle of a joint that slides.

    See Also
    --------
    mobility, mobility_over_turn

    Notes
    -----
    Displacements of the links are products of exponentials of the joints' screws along a spanning tree; all other joint
    coordinates are chosen so that gaps and turns at the joints that the tree leaves out are least (Levenberg and
    Marquardt, from the position before). Where a mechanism is held too much by its nature, not by its special
    geometry, the residual is the play or the give that it must find.

    Examples
    --------
    >>> from cardan.mechanisms import Mechanism, Pair, finite_mobility
    >>> def hinge(name, links, x, y):
    ...     return Pair(id=name, type="R", links=links, point=(x, y, 0.0), axis=(0.0, 0.0, 1.0))
    >>> rhombus = Mechanism(
    ...     frame="0",
    ...     joints=(
    ...         hinge("A", ("0", "1"), 0.0, 0.0),
    ...         hinge("B", ("1", "2"), 0.1, 0.1),
    ...         hinge("C", ("2", "3"), 0.4, 0.1),
    ...         hinge("D", ("3", "0"), 0.3, 0.0),
    ...     ),
    ... )
    >>> finite_mobility(rhombus, driven_joint="A", angle=0.5).closes
    True
    """
    number = _driven(mechanism, driven_joint)
    if angle is None:
        low, high = _range(mechanism, number)
        angle = high or low
    check_numbers(angle, tolerance, steps)
    count = _count(angle, steps, _step(mechanism, number))
    along = np.linspace(0.0, angle, count + 1)
    if any(pair.kind.rolls for pair in mechanism.joints):
        return _rolled(mechanism, number, along, tolerance)
    loops = _Loops(mechanism, number)
    rows = [loops.start()]
    stopped = False
    for k, amount in enumerate(along[1:], 1):
        rows.append(loops.closed(float(amount)))
        if progress is not None and progress(k / count) == "stop":
            stopped = True
            break
    residual, gap, turn, displacement = (np.asarray(column) for column in zip(*rows, strict=True))
    return FiniteMobility(
        mechanism=mechanism,
        position=along[: len(rows)],
        residual=residual,
        gap=gap,
        turn=turn,
        displacement=displacement,
        tolerance=tolerance,
        cancelled=stopped,
        slides=not mechanism.joints[number].kind.turns,
    )


def _rolled(mechanism: Mechanism, driven: int, along: Array, tolerance: float) -> FiniteMobility:
    """Return the same of a mechanism in which something rolls; its input drives it, whatever else was named."""
    if mechanism.joints[driven] is not mechanism.driving:
        raise refuse("driven_joint", _("where something rolls, only the input link drives"), "inconsistent")
    found = turned(mechanism, along)
    gap, turn = np.max(found.misfit, axis=1).T
    return FiniteMobility(
        mechanism=mechanism,
        position=along,
        residual=np.hypot(gap, turn),
        gap=gap,
        turn=turn,
        displacement=found.displacement,
        tolerance=tolerance,
        slides=mechanism.slides,
    )


def locks_at(mechanism: Mechanism, *, driven_joint: str = "") -> float | None:
    """Return the angle [rad] of the driven joint at which the loops close no more; None where it turns all round.

    Of an input with a range, which may slide [m], over that.

    Followed as by `finite_mobility`, up to the first place that is not reached. What rolls follows whatever turns it,
    and stays out.
    """
    firm = tuple(pair for pair in mechanism.joints if not pair.kind.rolls)
    if len(firm) < len(mechanism.joints):
        mechanism = replace(mechanism, joints=firm)
    number = _driven(mechanism, driven_joint)
    for end in _range(mechanism, number):
        loops = _Loops(mechanism, number)
        places: list[float] = np.linspace(0.0, end, _count(end, None, _step(mechanism, number)) + 1)[1:].tolist()
        found = next((amount for amount in places if loops.closed(amount)[0] >= CLOSED), None)
        if found is not None:
            return found
    return None


def reach(mechanism: Mechanism, end: float) -> float:
    """Return how far the input of a mechanism goes towards an end of its range [rad or m] before it opens."""
    number = _driven(mechanism, "")
    loops = _Loops(mechanism, number)
    last, step = 0.0, end / _count(end, None, _step(mechanism, number))
    while abs(step) > FINE * abs(end) and abs(last) < abs(end):
        kept = loops.before, loops.state, loops.open
        ahead = last + step if abs(last + step) < abs(end) else end
        if loops.closed(ahead)[0] < CLOSED:
            last = ahead
        else:
            loops.before, loops.state, loops.open = kept[1], kept[1], kept[2]
            step *= 0.5
    return last


def displaced(mechanism: Mechanism, displacement: Array) -> Mechanism:
    """Return a mechanism with its moving links displaced (n, 4, 4) from where they are.

    The axis of a joint goes with its first link, its point and second axis with the second.
    """
    number = {link: k for k, link in enumerate(mechanism.links)}
    joints = []
    for pair in mechanism.joints:
        first, second = (np.eye(4) if link == mechanism.frame else displacement[number[link]] for link in pair.links)
        joints.append(
            replace(
                pair,
                point=_row(second[:3, :3] @ np.asarray(pair.point) + second[:3, 3]),
                axis=None if pair.axis is None else _row(first[:3, :3] @ np.asarray(pair.axis)),
                axis2=None if pair.axis2 is None else _row(second[:3, :3] @ np.asarray(pair.axis2)),
            )
        )
    return replace(mechanism, joints=tuple(joints))


def _row(vector: Array) -> tuple[float, float, float]:
    x, y, z = (float(one) for one in vector)
    return x, y, z


def _range(mechanism: Mechanism, driven: int) -> tuple[float, float]:
    """Return between where a joint is driven [rad or m]: the input over its range, any other all round."""
    if mechanism.joints[driven] is mechanism.driving:
        low, high = travel(mechanism)
        return min(low, 0.0), max(high, 0.0)
    if mechanism.joints[driven].kind.turns:
        return 0.0, 2.0 * math.pi
    raise refuse("angle", _("missing: {name} slides").format(name=repr(mechanism.joints[driven].id)), "missing")


def _step(mechanism: Mechanism, driven: int) -> float:
    """Return the largest step of a joint, of one that slides over the size of the mechanism."""
    if mechanism.joints[driven].kind.turns:
        return STEP
    points = np.asarray([pair.point for pair in mechanism.joints], dtype=float)
    return STEP * (float(np.max(frames.norm(points - np.mean(points, axis=0)))) or 1.0)


def _count(angle: float, steps: int | None, step: float = STEP) -> int:
    """Return the number of steps; refuse what would take far too long."""
    count = steps or max(1, math.ceil(abs(angle) / step))
    if count > MOST_STEPS:
        text = _("{count} steps are too many; the limit is {limit}").format(count=count, limit=MOST_STEPS)
        raise refuse("angle" if steps is None else "steps", text, "out_of_range")
    return count


def check_numbers(angle: float, tolerance: float, steps: int | None) -> None:
    """Refuse numbers that drive nothing."""
    if not math.isfinite(angle) or angle == 0.0:
        raise refuse("angle", _("{value} drives nothing; an angle other than zero does").format(value=angle))
    if not tolerance > 0.0 or not math.isfinite(tolerance):
        raise refuse("tolerance", _("{value} is not above zero").format(value=tolerance))
    if steps is not None and steps < 1:
        raise refuse("steps", _("{value} is not a number of steps").format(value=steps))


def _driven(mechanism: Mechanism, name: str) -> int:
    """Return which joint is driven."""
    names = [pair.id for pair in mechanism.joints]
    if not name:
        if mechanism.driving is not None:
            return mechanism.joints.index(mechanism.driving)
        ends = {mechanism.frame, mechanism.input_link}
        for k, pair in enumerate(mechanism.joints):
            if mechanism.input_link and set(pair.links) == ends and pair.kind.turns:
                return k
        text = _("missing: no joint that turns or slides joins an input link with the frame")
        raise refuse("driven_joint", text, "missing")
    if name not in names:
        near = nearest(name, names)
        hint = _("; did you mean {near}?").format(near=near) if near else ""
        raise refuse("driven_joint", _("there is no joint {name}").format(name=repr(name)) + hint, "inconsistent")
    return names.index(name)


class _Loops:
    """The loops of a mechanism, followed from position to position."""

    def __init__(self, mechanism: Mechanism, driven: int) -> None:
        number = {link: k for k, link in enumerate(mechanism.links)} | {mechanism.frame: FRAME}
        self.ends = [(number[a], number[b]) for a, b in (pair.links for pair in mechanism.joints)]
        self.tree = spanning_tree(len(mechanism.links), self.ends)
        points = np.asarray([pair.point for pair in mechanism.joints], dtype=float)
        self.middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        self.points = points - self.middle
        shift = np.eye(4)
        shift[:3, 3] = -self.middle
        twists = [screws.moved(shift, pair.freedoms) for pair in mechanism.joints]
        self.twists = np.concatenate(twists)
        starts = np.cumsum([0, *(len(one) for one in twists)])
        self.slices = [slice(int(a), int(b)) for a, b in pairwise(starts)]
        turns = {"": 1, "axis": 1, "both": 2, "all": 3}[mechanism.joints[driven].kind.turns]
        self.driven = self.slices[driven].stop - turns  # what slides comes first
        pair = mechanism.joints[driven]  # the input link moves along its axis, whichever of the two links it is
        self.sense = -1.0 if pair is mechanism.driving and pair.links[0] == mechanism.input_link else 1.0
        self.free = np.delete(np.arange(len(self.twists)), self.driven)
        self.firsts = starts[:-1]
        self.several = [j for j, one in enumerate(twists) if len(one) > 1]
        self.cut = [j for j in range(len(twists)) if j not in self.tree.parent_joint]
        self.cut_ends = np.asarray([self.ends[j] for j in self.cut], dtype=int).reshape(-1, 2)
        self.cut_points = self.points[self.cut][..., None]
        self.state = self.before = np.zeros(len(self.twists))
        self.open = False
        # of each cut joint, how each coordinate moves its two sides: along, against or not at all
        self.passed = np.zeros((len(self.cut), 2, len(self.twists)))
        for row, j in enumerate(self.cut):
            for side, end in enumerate(self.ends[j]):
                for k, sense in self.tree.path(end) + ([] if side else [(j, 1.0)]):
                    self.passed[row, side, self.slices[k]] += -sense if side else sense
        self.counted = np.sum(self.passed, axis=1)[..., None]

    def start(self) -> tuple[float, float, float, Array]:
        """Return residual, largest gap, largest turn and displacements at the start."""
        return self._told(self.state)

    def closed(self, amount: float) -> tuple[float, float, float, Array]:
        """Return the same with the driven joint at ``amount`` [rad] and the loops closed as well as they can be.

        The loops are sought where they would stand if they went on as from the position before, which leads through
        positions in which they could branch off; where that fails, from where they stood.
        """
        error, state = self._least(2.0 * self.state - self.before, amount)
        if error >= NEAR and not self.open:
            error, state = min((error, state), self._least(self.state, amount), key=lambda one: one[0])
        self.open = error >= NEAR
        self.before, self.state = self.state, state
        return self._told(state)

    def _least(self, guess: Array, amount: float) -> tuple[float, Array]:
        """Return the least sum of squares near a guess, and where it is."""
        state = guess.copy()
        state[self.driven] = self.sense * amount
        rest, slope = self._misalignment(state)
        error, damping = float(rest @ rest), 1e-9
        for _round in range(ROUNDS):
            normal, right = slope.T @ slope, slope.T @ rest
            if not rest.size or not self.free.size or error < SHUT:
                break
            weight = damping * max(float(np.max(np.diag(normal))), 1e-30)
            step = np.linalg.solve(normal + weight * np.eye(len(normal)), right)
            trial = state.copy()
            trial[self.free] -= step
            ahead, steeper = self._misalignment(trial)
            better = float(ahead @ ahead)
            near = error < NEAR
            if better < error:
                done = error - better < (0.5 if near else 1e-12) * error
                state, rest, slope, error = trial, ahead, steeper, better
                damping = max(0.1 * damping, 1e-14)
                if done:
                    break
            else:
                damping *= 10.0
                if near or damping > 1e6:
                    break
        return error, state

    def _told(self, state: Array) -> tuple[float, float, float, Array]:
        rest, _slope = self._misalignment(state)
        parts = rest.reshape(-1, 2, 3)
        sizes = np.max(frames.norm(parts), axis=0, initial=0.0)
        shift = np.eye(4)
        shift[:3, 3] = self.middle
        steps = screws.exponential(self.twists, state)
        moves = shift @ self._links(self._joints(steps))[:FRAME] @ screws.inverse(shift)
        return float(np.linalg.norm(rest)), float(sizes[0]), float(sizes[1]), moves

    def _joints(self, steps: Array) -> Array:
        """Return the displacement in every joint (m, 4, 4) from those along its coordinates."""
        whole = steps[self.firsts]
        for j in self.several:
            whole[j] = reduce(np.matmul, steps[self.slices[j]])
        return whole

    def _links(self, joints: Array) -> Array:
        """Return the displacement of every link and, as the last one, of the frame, array (n + 1, 4, 4)."""
        back = screws.inverse(joints)
        places = np.empty((len(self.tree.order) + 1, 4, 4))
        places[FRAME] = np.eye(4)
        for link in self.tree.order:
            j = self.tree.parent_joint[link]
            places[link] = places[self.tree.parent[link]] @ (joints if self.tree.along[link] > 0.0 else back)[j]
        return places

    def _misalignment(self, state: Array) -> tuple[Array, Array]:
        """Return gaps and turns at the cut joints, and their derivatives by the coordinates that are not driven."""
        steps = screws.exponential(self.twists, state)
        joints = self._joints(steps)
        links = self._links(joints)
        twist = self._carried(steps, links)
        first, second = links[self.cut_ends[:, 0]] @ joints[self.cut], links[self.cut_ends[:, 1]]
        place = np.stack([side[:, :3, :3] @ self.cut_points + side[:, :3, 3:] for side in (first, second)], axis=1)[
            ..., 0
        ]
        rest = np.stack((place[:, 0] - place[:, 1], screws.turned_by(first @ screws.inverse(second))), axis=1)
        turning, moving = twist[:, :3], twist[:, 3:]
        swept = frames.cross(
            np.broadcast_to(turning, (len(self.cut), *turning.shape)), np.swapaxes(self.passed, 1, 2) @ place
        )
        slope = np.stack((self.counted * moving + swept, self.counted * turning), axis=1)
        return rest.ravel(), np.swapaxes(slope, -1, -2).reshape(-1, len(twist))[:, self.free]

    def _carried(self, steps: Array, links: Array) -> Array:
        """Return the screw of every coordinate where it stands now, moving the second link against the first."""
        here = np.empty((len(self.twists), 4, 4))
        here[self.firsts] = links[[a for a, _b in self.ends]]
        for j in self.several:
            for k in range(self.slices[j].start, self.slices[j].stop - 1):
                here[k + 1] = here[k] @ steps[k]
        return screws.moved(here, self.twists)


# Does a mechanism bind everywhere, or only in special positions? Its mobility over a turn of the input.

POSITIONS = 72
"""Positions of a turn: every 5°, dead centres at multiples of them included."""


@dataclass(frozen=True, eq=False, kw_only=True)
class MobilityTurn:
    """Mobility and redundant constraints over a turn of the input, or over the range that its file gives.

    Attributes
    ----------
    position : array (p,) [rad]
        How far the input is turned; [m] where it slides.
    mobility, redundant : arrays of int (p,)
        W and q there.
    certain : array of bool (p,)
        Whether the rank is; where not, the mechanism stands next to a special position, or in one but for rounding.
    residual : array (p,)
        What keeps the loops from closing there [m, rad].
    cancelled : bool
        Whether ``progress`` said "stop"; the arrays then end there.
    slides, whole : bool
        Whether the input slides; whether it is asked all round.
    """

    position: Array
    mobility: Array
    redundant: Array
    certain: Array
    residual: Array
    cancelled: bool = False
    slides: bool = False
    whole: bool = True

    @property
    def reached(self) -> Array:
        """Which positions the mechanism reaches without force, array of bool (p,)."""
        return self.residual < CLOSED

    @property
    def turns(self) -> bool:
        """Whether it reaches them all."""
        return bool(np.all(self.reached))

    @property
    def structural(self) -> int:
        """Redundant constraints of every position: those that come from how it is built."""
        return int(np.min(self.redundant[self.reached]))

    @property
    def special(self) -> Array:
        """Positions with more of them, or next to one with more, array [rad, m where it slides]."""
        return self.position[self.reached & ((self.redundant > self.structural) | ~self.certain)]


def mobility_over_turn(
    thing: Drive | Mechanism,
    *,
    driven_joint: str = "",
    positions: int = POSITIONS,
    progress: Callable[[float], object] | None = None,
) -> MobilityTurn:
    """Return mobility and redundant constraints over a turn of the input, or over the range that its file gives.

    Parameters
    ----------
    thing : Drive or Mechanism
    driven_joint : str
        The joint that is driven; see `cardan.questions.mobility.finite_mobility.finite_mobility`.
    positions : int
        Number of positions, evenly over the turn from the start on, or from one end of the range to the other.
    progress : function, optional
        Called with the share done; answering "stop" ends there.

    Returns
    -------
    MobilityTurn
        position, mobility, redundant : arrays (p,)

    Raises
    ------
    InputError
        A drive that is no mechanism yet, or no joint that could be driven.

    See Also
    --------
    mobility, finite_mobility

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive
    >>> from cardan.mechanisms import mobility_over_turn
    >>> from cardan.parts import Support
    >>> stiff = dict(radial=True, axial=True, tilt=True)
    >>> held = (Support(shaft=1, position=-0.3, **stiff), Support(shaft=2, position=0.3, **stiff))
    >>> found = mobility_over_turn(replace(Drive.from_angles([0.3]), supports=held), positions=8)
    >>> found.structural, len(found.special)
    (3, 0)
    """
    mechanism = exactly(thing if isinstance(thing, Mechanism) else mechanism_of(thing))
    number = _driven(mechanism, driven_joint)
    if mechanism.joints[number] is mechanism.driving and (mechanism.slides or mechanism.input_range is not None):
        return _over_range(mechanism, number, positions, progress)
    along = np.linspace(0.0, 2.0 * math.pi, positions, endpoint=False)
    per = max(1, math.ceil(POSITIONS / len(along)))
    moved = finite_mobility(
        mechanism,
        driven_joint=driven_joint,
        angle=float(along[-1]),
        steps=per * (len(along) - 1),
        progress=None if progress is None else lambda share: progress(0.8 * share),
    )
    residual = moved.residual[::per]
    rest = None if progress is None or moved.cancelled else lambda share: progress(0.8 + 0.2 * share)
    found = _counted(along[: len(residual)], lambda k: moved.at(per * k), residual, rest)
    return replace(found, cancelled=found.cancelled or moved.cancelled)


def _over_range(
    mechanism: Mechanism, driven: int, positions: int, progress: Callable[[float], object] | None
) -> MobilityTurn:
    """Return the same over the range of the input, followed from where it is drawn to both its ends."""
    low, high = _range(mechanism, driven)
    told: list[MobilityTurn] = []
    for end in (one for one in (low, high) if one):
        places = max(2, math.ceil(positions * abs(end) / (high - low)))
        per = math.ceil(_count(end, None, _step(mechanism, driven)) / (places - 1))
        name = mechanism.joints[driven].id
        moved = finite_mobility(mechanism, driven_joint=name, angle=end, steps=per * (places - 1), progress=progress)
        found = _counted(moved.position[::per], partial(_moved, moved, per), moved.residual[::per], None)
        told.append(replace(found, cancelled=moved.cancelled, slides=mechanism.slides, whole=False))
        if moved.cancelled:
            break
    return told[0] if len(told) == 1 else _joined(*told)


def _moved(moved: FiniteMobility, per: int, place: int) -> Mechanism:
    return moved.at(per * place)


def _joined(down: MobilityTurn, up: MobilityTurn) -> MobilityTurn:
    """Return what was found on the way to both ends of a range as one, the start told once."""

    def both(one: Array, other: Array) -> Array:
        return np.concatenate((one[:0:-1], other))

    return replace(
        up,
        position=both(down.position, up.position),
        mobility=both(down.mobility, up.mobility),
        redundant=both(down.redundant, up.redundant),
        certain=both(down.certain, up.certain),
        residual=both(down.residual, up.residual),
    )


def _counted(
    along: Array, place: Callable[[int], Mechanism], residual: Array, progress: Callable[[float], object] | None
) -> MobilityTurn:
    rows: list[tuple[int, int, bool]] = []
    stopped = False
    for k in range(len(along)):
        matrix = constraints(place(k)).matrix()
        rank = screws.rank(matrix)
        rows.append((matrix.shape[1] - rank.value, matrix.shape[0] - rank.value, rank.certain))
        if progress is not None and progress((k + 1) / len(along)) == "stop":
            stopped = len(rows) < len(along)
            break
    mobility, redundant, certain = (np.asarray(column) for column in zip(*rows, strict=True))
    return MobilityTurn(
        position=along[: len(rows)],
        mobility=mobility,
        redundant=redundant,
        certain=certain,
        residual=residual[: len(rows)],
        cancelled=stopped,
    )
