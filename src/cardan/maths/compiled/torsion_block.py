"""A block of drives in the memory of the kernel, and its way through time."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import accumulate

import numpy as np

from cardan.maths.arrays import Array

from . import torsion_line as lines
from . import torsion_steps as kernels
from .lanes import BYTES, LANES
from .torsion_forms import MILD, SPEED_WEIGHTS, STAGES
from .torsion_line import Line, State

_EXTREMES = ("high", "low", "high_time", "low_time", "before", "rate")
"""Rows of every curve."""

_CODES = {
    lines.CONSTANT: kernels.CONSTANT,
    lines.FALLING: kernels.FALLING,
    lines.KLOSS: kernels.KLOSS,
    lines.SWINGING: kernels.SWINGING,
}


class Rows:
    """Where the numbers of a drive are, in bytes."""

    def __init__(self, line: Line) -> None:
        r, p, e = line.coordinates, line.places, len(line.ends)
        k = p - r
        sizes = {
            **{"q": r, "v": r, "work": 1, "alive": 1, "ended": 1, "acceleration": STAGES * r},
            **{"x": p, "u": p, "power": 1, "torque": p, "lever": 2 * k, "mass": r, "sine": r, "cosine": r},
            **{"carried": e, "rate": p + e, "spare": 1, "own": r, "inverse": r, "ground": p, "law": 5 * k},
            **{"element": 4 * e, "motion": 3, "extreme": 6 * line.quantities},
            "number": sum(len(load.numbers) for load in line.loads),
        }
        self.sizes = sizes
        self.first = dict(zip(sizes, accumulate(sizes.values(), initial=0), strict=False))
        self.count = sum(sizes.values())

    def __call__(self, name: str, k: int = 0) -> int:
        """Return where the row k of some begins."""
        return BYTES * (self.first[name] + k)


class Block:
    """Some drives of a line, from one to as many as fit the caches.

    state: where they begin; `state` tells where they are later.
    """

    def __init__(self, line: Line, state: State) -> None:
        self.line, self.drives, self.length = line, state.q.shape[-1], state.length
        self.groups = -(-self.drives // LANES)
        self.where = Rows(line)
        self.filled = np.minimum(np.arange(self.groups * LANES), self.drives - 1).reshape(self.groups, LANES)
        self.memory = np.zeros(self.groups * self.where.count * LANES)
        self.rows = self.memory.reshape(self.groups, self.where.count, LANES).swapaxes(0, 1)
        for name in ("q", "v", "work", "alive", "ended"):
            self._put(name, getattr(state, name))
        self._put("extreme", np.stack([getattr(state, name) for name in _EXTREMES], axis=1))
        for name, values in _numbers(line).items():
            self._put(name, values)
        self.program = np.asarray(list(_program(line, self.where)), dtype=np.intp).reshape(-1)
        tables = [part for load in line.loads for part in (load.times, load.values)]
        self.tables = np.concatenate([np.zeros(1), *tables])

    def _part(self, name: str) -> Array:
        first = self.where.first[name]
        return self.rows[first : first + self.where.sizes[name]]

    def _put(self, name: str, values: Array) -> None:
        """Write rows; registers that no drive fills get the last one's numbers."""
        room = self._part(name)
        if room.size:
            room[:] = np.reshape(values, (-1, values.shape[-1]))[:, self.filled % values.shape[-1]]

    def _get(self, name: str) -> Array:
        room = self._part(name)
        return room.reshape(len(room), -1)[:, : self.drives].copy()

    def advance(
        self, time: float, steps: int, h: float, motion: tuple[Array, Array, Array] | None, *, last: bool
    ) -> None:
        """Take steps of one length; see `cardan.maths.compiled.plain.advance`."""
        if motion is not None:
            self._put("motion", np.stack([np.broadcast_to(one, (self.drives,)) for one in motion]))
        kernels.kernel(self.memory, self.program, self.tables, self.groups, steps, time, h, self.length, last)
        if steps:
            self.length = h

    def now(self) -> tuple[Array, Array, Array]:
        """Return angles, speeds (R, b) and work (b,)."""
        return self._get("q"), self._get("v"), self._get("work")[0]

    def state(self) -> State:
        """Return where the drives are."""
        extremes = self._get("extreme").reshape(-1, 6, self.drives)
        return State(
            q=self._get("q"),
            v=self._get("v"),
            **{name: self._get(name)[0] for name in ("work", "alive", "ended")},
            **{name: extremes[:, k] for k, name in enumerate(_EXTREMES)},
            length=self.length,
        )


def _numbers(line: Line) -> dict[str, Array]:
    """Return what the drives are, by rows."""
    with np.errstate(divide="ignore"):
        inverse = 1.0 / line.mass
    numbers = [load.numbers for load in line.loads]
    return {
        **{"own": line.mass, "inverse": inverse, "ground": line.ground},
        "law": np.stack((line.tau, line.cosine, line.sine, line.ahead, line.inertia), axis=1),
        "element": np.stack((line.stiffness, line.damping, line.rest, line.half), axis=1),
        "number": np.concatenate(numbers) if numbers else np.zeros((0, line.mass.shape[-1])),
    }


def _program(line: Line, at: Rows) -> Iterator[list[int]]:
    """Yield the instructions of a step."""

    def told(code: int, *rest: int) -> list[int]:
        return [code, *rest, *[0] * (kernels.WIDTH - 1 - len(rest))]

    r, forced = line.coordinates, int(line.forced)
    last = (BYTES * r, r - forced)
    for i in range(STAGES + 1):
        end = i == STAGES
        x, u = ("q", "v") if end else ("x", "u")
        yield told(kernels.TIME, i)
        own = (at("q", forced), at("v", forced), at("acceleration", forced), at(x, forced), at(u, forced))
        yield told(kernels.PUT_END if end else kernels.PUT0 + i, *own, *last)
        if forced:
            yield told(kernels.FORCE, at("motion"), at(x), at(u))
        if not end:
            for code, *rest in _acting(line, at, i):
                yield told(code, *rest)
            if i == 0:
                for code, *rest in _looking(line, at):
                    yield told(code, *rest)
                yield told(kernels.CHECK)
            if i in SPEED_WEIGHTS:
                yield told(kernels.PAY, at("work"), at("power"), i)


def _acting(line: Line, at: Rows, stage: int) -> Iterator[tuple[int, ...]]:
    """Yield what gives the accelerations of a stage; the first one places the followers that move nothing as well."""
    count, power = line.coordinates, at("power")
    active, heavy = line.active(), [bool(np.any(one > 0.0)) for one in line.inertia]
    mild = bool(np.all(line.tau <= MILD))
    weighed = {r for k, r in enumerate(line.turning) if heavy[k]}
    yield kernels.BLANK, power, 1 + line.places  # the torques stand behind it
    for r in range(count):
        turned = [k for k, own in enumerate(line.turning) if own == r and (active[k] or stage == 0)]
        waves, motion = (at("sine", r), at("cosine", r)), (at("x", r), at("u", r))
        if r in weighed or (line.forced and r == 0):
            yield kernels.COPY, at("own", r), at("mass", r)
        if turned and not mild:
            yield kernels.WAVES, motion[0], *waves
        for k in turned:
            law, first = at("law", 5 * k), at("lever", 2 * k)
            goal = (at("x", count + k), at("u", count + k), first)
            if mild and k == turned[0]:
                yield kernels.SPIN, *motion, law, *waves, *goal
            else:
                yield kernels.FOLLOW if mild else kernels.STEEP, *waves, *motion, law, *goal
            if heavy[k] or stage == 0:
                yield kernels.SWELL, *waves, law, first, at("lever", 2 * k + 1)
            if heavy[k]:
                yield kernels.WEIGHT, first, motion[1], at("law", 5 * k + 4), at("mass", r), at("torque", r)
    for p in range(line.places):
        if np.any(line.ground[p] > 0.0):
            yield kernels.DRAG, at("u", p), at("ground", p), at("torque", p), power
    for e, (a, b) in enumerate(line.ends):
        code = kernels.LOOSE if np.any(line.half[e] > 0.0) else kernels.ELEMENT
        ends = (at("x", a), at("x", b), at("u", a), at("u", b), at("element", 4 * e), at("torque", a), at("torque", b))
        yield code, *ends, at("carried", e), power
    yield from _loads(line, at)
    for k, r in enumerate(line.turning):
        if active[k]:
            yield kernels.LEVER, at("lever", 2 * k), at("torque", count + k), at("torque", r)
    for r in range(count):
        force, to = at("torque", r), at("acceleration", count * stage + r)
        if line.forced and r == 0:
            yield kernels.COPY, at("motion", 2), to
            yield kernels.REACT, at("mass"), to, force, at("u"), power
        elif r in weighed:
            yield kernels.QUOTIENT, force, at("mass", r), to
        else:
            yield kernels.PRODUCT, force, at("inverse", r), to


def _loads(line: Line, at: Rows) -> Iterator[tuple[int, ...]]:
    number, table = 0, 8
    for load in line.loads:
        p = load.place
        took = (at("x", p), at("u", p), at("torque", p), at("power"))
        if load.kind == lines.HISTORY:
            yield kernels.HISTORY, table, len(load.times), *took[1:]
        elif load.kind == lines.SPEEDS:
            yield kernels.COPY, at("number", number), at("spare")
            for k in range(1, len(load.numbers), 2):
                yield kernels.HINGE, at("spare"), at("u", p), at("number", number + k)
            yield kernels.CONSTANT, at("spare"), *took
        else:
            yield _CODES[load.kind], at("number", number), *took
        number += len(load.numbers)
        table += 16 * len(load.times)


def _looking(line: Line, at: Rows) -> Iterator[tuple[int, ...]]:
    """Yield what keeps extremes, and whether the drives are within bounds."""
    count, places, elements = line.coordinates, line.places, len(line.ends)
    for r in range(count):
        yield kernels.BOUND, at("u", r), at("alive")
        yield kernels.COPY, at("acceleration", r), at("rate", r)
    for k, r in enumerate(line.turning):
        yield kernels.FOLLOWER_RATE, at("lever", 2 * k), at("u", r), at("acceleration", r), at("rate", count + k)
    for e, (a, b) in enumerate(line.ends):
        yield kernels.TWIST, at("x", a), at("x", b), at("alive")
        took = (at("u", a), at("u", b), at("rate", a), at("rate", b), at("element", 4 * e), at("rate", places + e))
        code = kernels.LOOSE_RATE if np.any(line.half[e] > 0.0) else kernels.ELEMENT_RATE
        yield code, *took, at("x", a), at("x", b)
    yield kernels.LAST, at("ended"), at("alive")
    for n in range(elements + places):
        now = at("carried", n) if n < elements else at("u", n - elements)
        slope = at("rate", places + n if n < elements else n - elements)
        yield kernels.NOTE, now, slope, at("extreme", 6 * n)
