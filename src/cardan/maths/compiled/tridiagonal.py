"""Kernel: forced response of many chains, eight frequencies at a time; see `cardan.maths.linear.tridiagonal`."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from cardan.maths.arrays import namespace

from .lanes import BYTES, LANES, OUTPUT, SOURCES, address, compiled, step

NUMBERS = 9
"""Numbers of a place: mass, ground (real, imaginary, drag), load (real, imaginary), coupling to the next (the same)."""

TINY = 1e-100
"""As in `cardan.maths.linear.tridiagonal`."""


def own(w: Any, mass: Any, gr: Any, gi: Any, gd: Any) -> tuple[Any, Any]:
    """Return the dynamic stiffness of a place by itself."""
    return gr - w * (w * mass), gi + w * gd


def through(
    w: Any, zr: Any, zi: Any, kr: Any, ki: Any, d: Any, mass: Any, gr: Any, gi: Any, gd: Any
) -> tuple[Any, Any, Any, Any, Any, Any]:
    """Return k/(Z + k), the stiffness Z felt through the coupling k, and both with the next place added."""
    xp = namespace(w)
    ki = ki + w * d
    br, bi = zr + kr, zi + ki
    size = br * br + bi * bi
    there = size > 0.0
    br, bi = xp.where(there, br, TINY * kr), xp.where(there, bi, TINY * ki)
    inverse = 1.0 / (br * br + bi * bi)
    tr, ti = (kr * br + ki * bi) * inverse, (ki * br - kr * bi) * inverse
    pr, pi = zr * tr - zi * ti, zr * ti + zi * tr
    or_, oi = own(w, mass, gr, gi, gd)
    return tr, ti, pr, pi, or_ + pr, oi + pi


def driven(zr: Any, zi: Any, pr: Any, pi: Any, fr: Any, fi: Any) -> tuple[Any, Any]:
    """Return the displacement of a place under its own load, with the stiffnesses of both sides; nan in resonance."""
    zr, zi = zr + pr, zi + pi
    inverse = 1.0 / (zr * zr + zi * zi)
    return (fr * zr + fi * zi) * inverse, (fi * zr - fr * zi) * inverse


def onward(ar: Any, ai: Any, tr: Any, ti: Any, er: Any, ei: Any) -> tuple[Any, Any]:
    """Return the displacement under all loads up to a place."""
    return er + (tr * ar - ti * ai), ei + (tr * ai + ti * ar)


def back(
    br: Any, bi: Any, er: Any, ei: Any, tr: Any, ti: Any, lr: Any, li: Any, ar: Any, ai: Any, pr: Any, pi: Any
) -> tuple[Any, Any, tuple[Any, Any], tuple[Any, Any]]:
    """Return the displacement under the loads behind a place, that under all loads, and the flow to the next place."""
    br, bi = br + er, bi + ei
    flow = (pr * ar - pi * ai) - (lr * br - li * bi), (pr * ai + pi * ar) - (lr * bi + li * br)
    br, bi = tr * br - ti * bi, tr * bi + ti * br
    return br, bi, (ar + br, ai + bi), flow


_own, _through, _driven = step(own), step(through), step(driven)
_onward, _back = step(onward), step(back)

_PAIR = 2 * BYTES
"""Bytes of eight complex numbers."""

_ROWS = 7
"""Complex numbers kept of each place: driven, onward, left stiffness, and both sweeps' share and passed stiffness."""


def _build(sources: int) -> Any:
    @compiled(OUTPUT, types.intp, OUTPUT, OUTPUT, OUTPUT, types.intp, types.intp)
    def kernel(table: Any, places: int, omega: Any, moved: Any, flow: Any, first: int, last: int) -> None:
        _sources = sources  # part of the key on disk
        groups = omega.size // LANES
        scratch, state = np.zeros((_ROWS * places + 1) * 2 * LANES), np.zeros(2 * LANES)
        wide = _PAIR * places
        driven_at = address(scratch)
        onward_at = driven_at + wide
        left, left_share, left_felt = onward_at + wide, onward_at + 2 * wide, onward_at + 3 * wide
        right_share, right_felt = onward_at + 4 * wide, onward_at + 5 * wide
        b = address(state)
        for job in range(first, last):
            row, group = job // groups, job % groups
            w = address(omega) + BYTES * group
            begin = row * places * NUMBERS
            q = begin
            _own((w,), (table[q], table[q + 1], table[q + 2], table[q + 3]), (left, left + BYTES))
            for s in range(places - 1):
                q = begin + s * NUMBERS
                p, z, go = q + NUMBERS, left + _PAIR * s, _PAIR * s
                _through(
                    (w, z, z + BYTES),
                    (table[q + 6], table[q + 7], table[q + 8], table[p], table[p + 1], table[p + 2], table[p + 3]),
                    (
                        *(left_share + go, left_share + go + BYTES, left_felt + go, left_felt + go + BYTES),
                        *(z + _PAIR, z + _PAIR + BYTES),
                    ),
                )
            q = begin + (places - 1) * NUMBERS
            _own((w,), (table[q], table[q + 1], table[q + 2], table[q + 3]), (b, b + BYTES))
            for k in range(places - 1):
                s = places - 2 - k
                q, go = begin + s * NUMBERS, _PAIR * s
                _through(
                    (w, b, b + BYTES),
                    (table[q + 6], table[q + 7], table[q + 8], table[q], table[q + 1], table[q + 2], table[q + 3]),
                    (
                        *(right_share + go, right_share + go + BYTES, right_felt + go, right_felt + go + BYTES),
                        *(b, b + BYTES),
                    ),
                )
            for s in range(places):
                q, go = begin + s * NUMBERS, _PAIR * s
                e, a = driven_at + go, onward_at + go
                if table[q + 4] != 0.0 or table[q + 5] != 0.0:
                    z, p = left + go, right_felt + go  # nothing was ever felt behind the last place
                    _driven((z, z + BYTES, p, p + BYTES), (table[q + 4], table[q + 5]), (e, e + BYTES))
                else:
                    for lane in range(2 * LANES):
                        scratch[2 * LANES * s + lane] = 0.0
                if s == 0:
                    for lane in range(2 * LANES):
                        scratch[2 * LANES * places + lane] = scratch[lane]
                else:
                    t = right_share + go - _PAIR
                    _onward((a - _PAIR, a - _PAIR + BYTES, t, t + BYTES, e, e + BYTES), (), (a, a + BYTES))
            for lane in range(2 * LANES):
                state[lane] = 0.0
            go = _PAIR * (places - 1)
            to = 2 * (row * places * groups * LANES + group * LANES)
            for s in range(places - 1, -1, -1):
                go = _PAIR * s
                a, t, felt, p = onward_at + go, left_share + go, left_felt + go, right_felt + go
                e = driven_at + go + _PAIR
                if s == places - 1:
                    e = driven_at + _ROWS * wide  # zeros behind the last place
                place = 8 * (to + 2 * s * groups * LANES)
                _back(
                    (*(b, b + BYTES, e, e + BYTES, t, t + BYTES, felt, felt + BYTES), *(a, a + BYTES, p, p + BYTES)),
                    (),
                    (b, b + BYTES, address(moved) + place, address(flow) + place),
                )

    return kernel


kernel = _build(SOURCES)
