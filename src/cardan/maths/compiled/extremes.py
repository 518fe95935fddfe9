"""Kernel: speed fluctuation, equivalent joint and extremes of many chains, without positions."""

from __future__ import annotations

from typing import Any

import numpy as np
from numba import types

from cardan.maths.arrays import namespace

from .approximations import arctangent_unit, argument
from .lanes import BYTES, INPUT, LANES, OUTPUT, SOURCES, address, compiled, step
from .pairs import BLOCK, pair_block, room

RESULTS = 6
"""SpeedFluctuation, τ, equivalent angle, phase, largest ratio, largest acceleration."""


def reached(ar: Any, ai: Any, br: Any, bi: Any) -> tuple[Any, Any, Any, Any, Any, Any]:
    """Return what a chain reaches over a turn; see `cardan.maths.compiled.plain.extremes`."""
    xp = namespace(ar)
    far, near = xp.sqrt(ar * ar + ai * ai), xp.sqrt(br * br + bi * bi)
    speed_fluctuation = 4.0 * far * near
    tau = near / far
    ratio_max = (far + near) * (far + near)
    phase = -0.5 * argument(br * ai - bi * ar, -(br * ar + bi * ai))
    phase = xp.where(phase < 0.0, phase + np.pi, phase)
    c = 1.0 / ratio_max
    square = speed_fluctuation * c
    size = 1.0 + c * c
    k = square / size
    root = xp.sqrt(1.0 + 8.0 * k * k)
    x, short = 4.0 * k / (1.0 + root), 4.0 * c * c / (size * (1.0 + 2.0 * k + root))
    below = 2.0 * c * c + size * k * short
    steepest = 4.0 * c * square * xp.sqrt(short * (1.0 + x)) / (below * below)
    return speed_fluctuation, tau, 2.0 * arctangent_unit(xp.sqrt(tau)), phase, ratio_max, steepest


_reached = step(reached)


def _build(sources: int) -> Any:
    @compiled(
        *(INPUT[2], INPUT[2], INPUT[2], INPUT[1], types.intp, types.intp),
        *(OUTPUT, OUTPUT, OUTPUT, OUTPUT, OUTPUT, OUTPUT),
    )
    def kernel(
        joint_angle: Any,
        plane_twist: Any,
        yoke_angle: Any,
        start_phase: Any,
        first: int,
        last: int,
        speed_fluctuation: Any,
        tau: Any,
        equivalent: Any,
        phase: Any,
        ratio_max: Any,
        acceleration: Any,
    ) -> None:
        _sources = sources  # part of the key on disk
        scratch = room(joint_angle.shape[1])
        edge = np.empty(RESULTS * LANES)
        wide = 8 * BLOCK
        for block in range(first, last, BLOCK):
            count = min(BLOCK, last - block)
            pair_block(joint_angle, plane_twist, yoke_angle, start_phase, block, count, scratch)
            for group in range((count + LANES - 1) // LANES):
                a = address(scratch) + BYTES * group
                begin = block + LANES * group
                lanes = min(LANES, last - begin)
                pair = (a, a + wide, a + 2 * wide, a + 3 * wide)
                if lanes == LANES:
                    at = 8 * begin
                    whole = (
                        *(address(speed_fluctuation) + at, address(tau) + at, address(equivalent) + at),
                        *(address(phase) + at, address(ratio_max) + at, address(acceleration) + at),
                    )
                    _reached(pair, (), whole)
                else:
                    p = address(edge)
                    _reached(pair, (), (p, p + BYTES, p + 2 * BYTES, p + 3 * BYTES, p + 4 * BYTES, p + 5 * BYTES))
                    for lane in range(lanes):
                        speed_fluctuation[begin + lane] = edge[lane]
                        tau[begin + lane] = edge[LANES + lane]
                        equivalent[begin + lane] = edge[2 * LANES + lane]
                        phase[begin + lane] = edge[3 * LANES + lane]
                        ratio_max[begin + lane] = edge[4 * LANES + lane]
                        acceleration[begin + lane] = edge[5 * LANES + lane]

    return kernel


kernel = _build(SOURCES)
