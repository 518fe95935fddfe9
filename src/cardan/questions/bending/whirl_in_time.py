"""Motion in time of shafts that whirl: steps of order eight, curves at given instants, and their orders."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import scipy

from cardan.errors import refuse
from cardan.formulas.run_up import Progress
from cardan.maths.arrays import Array
from cardan.texts import _

RELATIVE = 1e-11
"""Tolerance of a step."""

MOST = 2_000_000
"""Steps of a run at most."""


def followed(
    rate: Callable[[float, Array], Array],
    state: Array,
    time: Array,
    small: Array,
    longest: float,
    progress: Progress | None = None,
) -> tuple[Array, bool]:
    """Return the states at rising instants, from the first of them on.

    rate: from time and state (n,) to the rates of it; state (n,); time (t,) [s]; small (n,): sizes of no matter.
    longest [s]: longest step.
    Returns states (m, n): as many as were reached.

    >>> swing, _stopped = followed(lambda t, y: np.array([y[1], -y[0]]), np.array([1.0, 0.0]), np.array([0.0, np.pi]),
    ...                            np.full(2, 1e-12), 1.0)
    >>> swing[-1].round(9)
    array([-1., -0.])
    """
    if (time[-1] - time[0]) / longest > MOST:
        raise refuse("end", _("more than {most:.0e} steps would be needed").format(most=MOST), "out_of_range")
    if time.size < 2 or time[-1] == time[0]:
        return np.tile(state, (time.size, 1)), False
    solver = scipy.integrate.DOP853(rate, time[0], state, time[-1], rtol=RELATIVE, atol=small, max_step=longest)
    found = np.empty((time.size, state.size))
    found[0], done, told = state, 1, 0.0
    while done < time.size:
        with np.errstate(all="ignore"):
            solver.step()
        if solver.status == "failed" or not np.isfinite(solver.y).all():
            text = _("the motion grows beyond all numbers after {time:.4g} s")
            raise refuse("end", text.format(time=solver.t), "out_of_range")
        upto = int(np.searchsorted(time, solver.t, side="right"))
        if upto > done:
            found[done:upto] = solver.dense_output()(time[done:upto]).T
            done = upto
        share = (solver.t - time[0]) / (time[-1] - time[0])
        if progress is not None and (share >= told + 0.01 or done == time.size):
            told = share
            if progress(float(share)) == "stop" and done < time.size:
                return found[:done], True
    return found, False


def longest_step(*frequencies: float) -> float:
    """Return the longest step that follows swings of these frequencies [rad/s], an eighth of a turn of the fastest."""
    return 0.25 * math.pi / max(frequencies)


def fitted_orders(
    angle: Array, deflection: Array, *, turns: int = 8, reach: int = 4, parts: int = 1
) -> tuple[Array, Array]:
    """Return the orders of whirling over the last turns, by least squares.

    angle (t,) [rad]: θ, rising; deflection (t,) [m], complex: X + iY.
    turns: how many of the last whole turns; fewer where there are no more.
    parts: into how many parts the step from order to order is divided.
    Returns order (N,); amplitude (N,) [m], complex: Z_n of Σ Z_n e^(inθ).

    >>> turn = np.linspace(0.0, 30.0, 400)
    >>> order, size = fitted_orders(turn, 1e-3 * np.exp(-2j * turn), reach=2)
    >>> order, (1e3 * abs(size)).round(6)
    (array([-2., -1.,  0.,  1.,  2.]), array([1., 0., 0., 0., 0.]))
    """
    whole = max(1, min(turns, int((angle[-1] - angle[0]) / (2.0 * math.pi))))
    late = angle >= angle[-1] - 2.0 * math.pi * whole * (1.0 + 1e-12)
    theta, z = angle[late], deflection[late]
    order = np.arange(-reach * parts, reach * parts + 1) / parts
    weight = np.sqrt(np.maximum(np.gradient(theta), 0.0))
    wave = np.exp(1j * np.outer(theta, order))
    found: Array = np.linalg.lstsq(weight[:, None] * wave, weight * z, rcond=None)[0]
    return order, found
