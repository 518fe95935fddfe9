"""Kernel: torsional lines stepped through time, drives in lanes; see `cardan.maths.compiled.plain`.

A step is a list of instructions that `cardan.maths.compiled.torsion_block` writes for the build of the drives: what to
do, and at which places of a drive's memory. An instruction goes through all registers of a block before the next one
begins, so that drives hide each other's waiting. All places count bytes.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numba import njit, types
from numba.extending import intrinsic

from . import torsion_forms as forms
from .lanes import BYTES, OUTPUT, SOURCES, address, compiled, step
from .torsion_forms import PLACES, SPEED, SPEED_WEIGHTS, end, stage
from .torsion_line import SPEED_LIMIT, TWIST_LIMIT

WIDTH = 10
"""Numbers of an instruction: what to do, then places and counts."""

(PUT0, PUT1, PUT2, PUT3, PUT4, PUT5, PUT6, PUT7, PUT8, PUT9, PUT10, PUT11, PUT_END) = range(13)
"""Angles and speeds of a stage: from q, v, first acceleration, to x, u, between stages, how many coordinates."""

(TIME, FORCE, BLANK, COPY, WAVES, SPIN, FOLLOW, STEEP, SWELL, WEIGHT, DRAG, ELEMENT, LOOSE) = range(13, 26)
(CONSTANT, FALLING, KLOSS, SWINGING, HINGE, HISTORY, LEVER, PRODUCT, QUOTIENT, REACT, PAY) = range(26, 37)
(BOUND, TWIST, FOLLOWER_RATE, ELEMENT_RATE, LOOSE_RATE, NOTE, CHECK, LAST) = range(37, 45)


def _noted(*given: Any) -> tuple[Any, ...]:
    return (*forms.highest(*given), *given[:2])


def _loose_rate(
    xa: Any, xb: Any, va: Any, vb: Any, aa: Any, ab: Any, c: Any, b: Any, rest: Any, half: Any
) -> tuple[Any]:
    return (forms.element_rate(va, vb, aa, ab, c, b, forms.touch(xa, xb, rest, half)),)


def _putting(formula: Callable[..., Any]) -> Any:
    """Return the function that puts angles and speeds of a stage in their places."""
    staged = step(formula)

    @njit(nogil=True, error_model="numpy")
    def put(base: int, hop: int, groups: int, at: int, h: float) -> None:
        q, v, a = base + _integer(at + 8), base + _integer(at + 16), base + _integer(at + 24)
        x, u, s = base + _integer(at + 32), base + _integer(at + 40), _integer(at + 48)
        for r in range(_integer(at + 56)):
            for g in range(groups):
                o = hop * g + BYTES * r
                b = a + o
                took = (
                    q + o,
                    v + o,
                    b,
                    b + s,
                    b + 2 * s,
                    b + 3 * s,
                    b + 4 * s,
                    b + 5 * s,
                    b + 6 * s,
                    b + 7 * s,
                    b + 8 * s,
                    b + 9 * s,
                    b + 10 * s,
                    b + 11 * s,
                )
                staged(took, (h,), (x + o, u + o))

    return put


def _loading(kind: Any) -> Any:
    """Return the kernel function that reads a number at an address: arrays would count who holds them at every call."""

    def types_and_code(context: Any, place: Any) -> Any:
        def code(_context: Any, builder: Any, _signature: Any, given: Any) -> Any:
            return builder.load(builder.inttoptr(given[0], _context.get_value_type(kind).as_pointer()))

        return kind(types.intp), code

    return intrinsic(types_and_code)


_integer, _number = _loading(types.intp), _loading(types.float64)

_waves, _follower, _steep_follower = step(forms.waves), step(forms.follower), step(forms.steep_follower)
_spun, _swelling = step(forms.spun), step(lambda *given: (forms.swelling(*given),))
_weight, _drag, _element = step(forms.weight), step(forms.drag), step(forms.element)
_loose_element, _constant, _falling = step(forms.loose_element), step(forms.constant), step(forms.falling)
_kloss, _swinging = step(forms.kloss), step(forms.swinging)
_hinge = step(lambda *given: (forms.hinge(*given),))
_given = step(lambda speed, torque, power, value: forms.constant(value, speed, torque, power))
_copied, _filled = step(lambda value: (value,)), step(lambda value: (value,))
_lever = step(lambda first, torque, force: (force + first * torque,))
_product = step(lambda force, inverse: (force * inverse,))
_quotient = step(lambda force, mass: (force / mass,))
_forced = step(lambda angle, speed, acceleration, time: forms.forced(time, angle, speed, acceleration))
_reaction = step(lambda *given: (forms.reaction(*given),))
_follower_rate = step(lambda *given: (forms.follower_rate(*given),))
_element_rate, _loose_rate_of = step(lambda *given: (forms.element_rate(*given),)), step(_loose_rate)
_noted_of = step(_noted)
_first_noted = step(lambda now, slope, time: (now, now, time, time, now, slope))
_paid = step(lambda work, power, share: (work + share * power,))
_bounded = step(lambda speed, alive: (forms.bounded(speed, SPEED_LIMIT, alive),))
_twisted = step(lambda one, two, alive: (forms.bounded(one - two, TWIST_LIMIT, alive),))
_lasted = step(lambda ended, alive, now: (forms.lasted(ended, alive, now),))

_put0, _put1, _put2 = _putting(lambda q, v, *_rest: (q, v)), _putting(stage(1)), _putting(stage(2))
_put3, _put4, _put5 = _putting(stage(3)), _putting(stage(4)), _putting(stage(5))
_put6, _put7, _put8 = _putting(stage(6)), _putting(stage(7)), _putting(stage(8))
_put9, _put10, _put11, _put_end = _putting(stage(9)), _putting(stage(10)), _putting(stage(11)), _putting(end)

_WEIGHTS = np.asarray([SPEED_WEIGHTS.get(i, 0.0) for i in range(len(SPEED))])
_PLACES = np.asarray([*PLACES, 1.0])


@njit(nogil=True, error_model="numpy")
def _read(table: int, points: int, time: float) -> Any:
    """Return what a table over time says: times, then values."""
    values = table + 8 * points
    if time <= _number(table):
        return _number(values)
    if time >= _number(values - 8):
        return _number(values + 8 * (points - 1))
    low, high = 0, points - 1
    while high - low > 1:
        middle = (low + high) // 2
        if _number(table + 8 * middle) <= time:
            low = middle
        else:
            high = middle
    start, first = _number(table + 8 * low), _number(values + 8 * low)
    share = (time - start) / (_number(table + 8 * high) - start)
    return first + (_number(values + 8 * high) - first) * share


@njit(nogil=True, error_model="numpy")
def _put(code: int, base: int, hop: int, groups: int, at: int, h: float) -> None:
    if code == PUT0:
        _put0(base, hop, groups, at, h)
    elif code == PUT1:
        _put1(base, hop, groups, at, h)
    elif code == PUT2:
        _put2(base, hop, groups, at, h)
    elif code == PUT3:
        _put3(base, hop, groups, at, h)
    elif code == PUT4:
        _put4(base, hop, groups, at, h)
    elif code == PUT5:
        _put5(base, hop, groups, at, h)
    elif code == PUT6:
        _put6(base, hop, groups, at, h)
    elif code == PUT7:
        _put7(base, hop, groups, at, h)
    elif code == PUT8:
        _put8(base, hop, groups, at, h)
    elif code == PUT9:
        _put9(base, hop, groups, at, h)
    elif code == PUT10:
        _put10(base, hop, groups, at, h)
    elif code == PUT11:
        _put11(base, hop, groups, at, h)
    else:
        _put_end(base, hop, groups, at, h)


@njit(nogil=True, error_model="numpy")
def _act(code: int, base: int, hop: int, groups: int, at: int) -> None:
    """Do what moves the drives and needs no time."""
    a, b, c = base + _integer(at + 8), base + _integer(at + 16), base + _integer(at + 24)
    d, e, f = base + _integer(at + 32), base + _integer(at + 40), base + _integer(at + 48)
    i, j, k = base + _integer(at + 56), base + _integer(at + 64), base + _integer(at + 72)
    if code == BLANK:
        for r in range(b - base):
            for g in range(groups):
                _filled((), (0.0,), (a + BYTES * r + hop * g,))
    elif code == COPY:
        for g in range(groups):
            o = hop * g
            _copied((a + o,), (), (b + o,))
    elif code == WAVES:
        for g in range(groups):
            o = hop * g
            _waves((a + o,), (), (b + o, c + o))
    elif code == SPIN:
        for g in range(groups):
            o = hop * g
            n = c + o
            turned = (a + o, b + o, n, n + BYTES, n + 2 * BYTES, n + 3 * BYTES)
            _spun(turned, (), (d + o, e + o, f + o, i + o, j + o))
    elif code == SWELL:
        for g in range(groups):
            o = hop * g
            n = c + o
            _swelling((a + o, b + o, n, n + BYTES, n + 2 * BYTES, d + o), (), (e + o,))
    elif code == FOLLOW:
        for g in range(groups):
            o = hop * g
            n = e + o
            led = (a + o, b + o, c + o, d + o, n, n + BYTES, n + 2 * BYTES, n + 3 * BYTES)
            _follower(led, (), (f + o, i + o, j + o))
    elif code == STEEP:
        for g in range(groups):
            o = hop * g
            n = e + o
            led = (a + o, b + o, c + o, d + o, n, n + BYTES, n + 2 * BYTES, n + 3 * BYTES)
            _steep_follower(led, (), (f + o, i + o, j + o))
    elif code == WEIGHT:
        for g in range(groups):
            o = hop * g
            _weight((a + o, a + BYTES + o, b + o, c + o, d + o, e + o), (), (d + o, e + o))
    elif code == DRAG:
        for g in range(groups):
            o = hop * g
            _drag((a + o, b + o, c + o, d + o), (), (c + o, d + o))
    elif code == ELEMENT:
        for g in range(groups):
            o = hop * g
            n = e + o
            ends = (a + o, b + o, c + o, d + o, n, n + BYTES, n + 2 * BYTES, f + o, i + o, k + o)
            _element(ends, (), (j + o, f + o, i + o, k + o))
    elif code == LOOSE:
        for g in range(groups):
            o = hop * g
            n = e + o
            loose = (a + o, b + o, c + o, d + o, n, n + BYTES, n + 2 * BYTES, f + o, i + o, k + o, n + 3 * BYTES)
            _loose_element(loose, (), (j + o, f + o, i + o, k + o))
    elif code == CONSTANT:
        for g in range(groups):
            o = hop * g
            _constant((a + o, c + o, d + o, e + o), (), (d + o, e + o))
    elif code == FALLING:
        for g in range(groups):
            o = hop * g
            _falling((a + o, a + BYTES + o, c + o, d + o, e + o), (), (d + o, e + o))
    elif code == KLOSS:
        for g in range(groups):
            o = hop * g
            _kloss((a + o, a + BYTES + o, a + 2 * BYTES + o, c + o, d + o, e + o), (), (d + o, e + o))
    elif code == SWINGING:
        for g in range(groups):
            o = hop * g
            swing = (a + o, a + BYTES + o, a + 2 * BYTES + o, b + o, c + o, d + o, e + o)
            _swinging(swing, (), (d + o, e + o))
    elif code == HINGE:
        for g in range(groups):
            o = hop * g
            _hinge((a + o, b + o, c + o, c + BYTES + o), (), (a + o,))
    elif code == LEVER:
        for g in range(groups):
            o = hop * g
            _lever((a + o, b + o, c + o), (), (c + o,))
    elif code == PRODUCT:
        for g in range(groups):
            o = hop * g
            _product((a + o, b + o), (), (c + o,))
    elif code == QUOTIENT:
        for g in range(groups):
            o = hop * g
            _quotient((a + o, b + o), (), (c + o,))
    elif code == REACT:
        for g in range(groups):
            o = hop * g
            _reaction((a + o, b + o, c + o, d + o, e + o), (), (e + o,))


@njit(nogil=True, error_model="numpy")
def _look(code: int, base: int, hop: int, groups: int, at: int, now: float, length: float) -> None:
    """Do what keeps extremes and bounds."""
    a, b, c = base + _integer(at + 8), base + _integer(at + 16), base + _integer(at + 24)
    d, e, f = base + _integer(at + 32), base + _integer(at + 40), base + _integer(at + 48)
    i, j = base + _integer(at + 56), base + _integer(at + 64)
    if code == BOUND:
        for g in range(groups):
            o = hop * g
            _bounded((a + o, b + o), (), (b + o,))
    elif code == TWIST:
        for g in range(groups):
            o = hop * g
            _twisted((a + o, b + o, c + o), (), (c + o,))
    elif code == FOLLOWER_RATE:
        for g in range(groups):
            o = hop * g
            _follower_rate((a + o, a + BYTES + o, b + o, c + o), (), (d + o,))
    elif code == ELEMENT_RATE:
        for g in range(groups):
            o = hop * g
            _element_rate((a + o, b + o, c + o, d + o, e + o, e + BYTES + o), (), (f + o,))
    elif code == LOOSE_RATE:
        for g in range(groups):
            o = hop * g
            n = e + o
            loose = (i + o, j + o, a + o, b + o, c + o, d + o, n, n + BYTES, n + 2 * BYTES, n + 3 * BYTES)
            _loose_rate_of(loose, (), (f + o,))
    elif length > 0.0:
        for g in range(groups):
            o = hop * g
            n = c + o
            best = (n, n + BYTES, n + 2 * BYTES, n + 3 * BYTES, n + 4 * BYTES, n + 5 * BYTES)
            took = (a + o, b + o, best[4], best[5], best[0], best[1], best[2], best[3])
            _noted_of(took, (now, length), best)
    else:
        for g in range(groups):
            o = hop * g
            n = c + o
            best = (n, n + BYTES, n + 2 * BYTES, n + 3 * BYTES, n + 4 * BYTES, n + 5 * BYTES)
            _first_noted((a + o, b + o), (now,), best)


def _build(sources: int) -> Any:
    @compiled(
        *(OUTPUT, types.Array(types.intp, 1, "C", readonly=True), types.Array(types.float64, 1, "C", readonly=True)),
        *(types.intp, types.intp, types.float64, types.float64, types.float64, types.boolean),
    )
    def kernel(
        memory: Any,
        program: Any,
        tables: Any,
        groups: int,
        steps: int,
        time: float,
        h: float,
        length: float,
        last: bool,
    ) -> None:
        _sources = sources  # part of the key on disk
        base, hop, table = address(memory), 8 * (memory.size // groups), address(tables)
        first, size, now = address(program), program.size // WIDTH, 0.0
        for n in range(steps + (1 if last else 0)):
            for line in range(size):
                at = first + 8 * WIDTH * line
                code = _integer(at)
                if code <= PUT_END:
                    _put(code, base, hop, groups, at, h)
                elif code >= BOUND:
                    if code == CHECK:
                        if n == steps:
                            break
                    elif code == LAST:
                        a, b = base + _integer(at + 8), base + _integer(at + 16)
                        for g in range(groups):
                            o = hop * g
                            _lasted((a + o, b + o), (time + now,), (a + o,))
                    else:
                        _look(code, base, hop, groups, at, time + now, length if n == 0 else h)
                elif code == TIME:
                    now = n * h + _PLACES[_integer(at + 8)] * h
                elif code == PAY:
                    a, b, share = base + _integer(at + 8), base + _integer(at + 16), h * _WEIGHTS[_integer(at + 24)]
                    for g in range(groups):
                        o = hop * g
                        _paid((a + o, b + o), (share,), (a + o,))
                elif code == FORCE:
                    a, b, c = base + _integer(at + 8), base + _integer(at + 16), base + _integer(at + 24)
                    for g in range(groups):
                        o = hop * g
                        _forced((a + o, a + BYTES + o, a + 2 * BYTES + o), (now,), (b + o, c + o))
                elif code == HISTORY:
                    value = _read(table + _integer(at + 8), _integer(at + 16), time + now)
                    c, d, e = base + _integer(at + 24), base + _integer(at + 32), base + _integer(at + 40)
                    for g in range(groups):
                        o = hop * g
                        _given((c + o, d + o, e + o), (value,), (d + o, e + o))
                else:
                    _act(code, base, hop, groups, at)

    return kernel


kernel = _build(SOURCES)
