"""Field balancing of a shaft in its drive: which masses in which planes cancel what shakes once a turn?

An unbalance behind a joint shakes with odd orders of the turns only, the secondary couple of a joint and the uneven
turning behind it with even ones: order 1 is balanced, order 2 is told beside it and stays.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cardan.errors import Problem, check
from cardan.maths.arrays import Array, ArrayLike
from cardan.texts import _

from .signals.orders import TURNS, tracked_orders
from .signals.signal import Progress, Signal
from .signals.turning import estimate_rotation

ORDERS = (1.0, 2.0, 3.0, 4.0)
"""Orders that are told apart, by the turns of the shaft."""

SAME_SPEED = 0.02
"""Share by which the speed of a run may differ from that of the first."""

RANK = 1e-6
"""Singular values of the trial masses below this share of the largest tell nothing."""

SHAKING = ("acceleration", "velocity", "displacement")
"""What balances a shaft, of all that a channel may measure."""


@dataclass(frozen=True, eq=False, kw_only=True)
class FieldBalance:
    """Corrections of a shaft from runs with trial masses.

    Attributes
    ----------
    influence : complex array (s, p)
        Reading of each sensor for a unit of unbalance in each plane [1/(kg m) of its unit].
    mirrored : complex array (s, p)
        The same for the conjugate of the unbalance: what turns backward behind a joint, or on unequal supports. Zero
        where the runs do not tell it.
    first : complex array (s,)
        Order 1 before balancing.
    correction : complex array (p,) [kg m]
        Unbalance to add in each plane, its angle counted as that of the trial masses.
    remaining : complex array (s,)
        Order 1 that the corrections leave.
    misfit : float
        What the runs miss of the influence coefficients, over the largest change; nan where they only just suffice.
    condition : float
        Largest over least singular value of the influence of the planes: how alike they shake the sensors.
    two_sided : bool
        Whether the runs tell the mirrored influence.
    """

    influence: Array
    mirrored: Array
    first: Array
    correction: Array
    remaining: Array
    misfit: float
    condition: float
    two_sided: bool


def field_balance(readings: ArrayLike, trials: ArrayLike) -> FieldBalance:
    """Return the corrections of a shaft by influence coefficients.

    Parameters
    ----------
    readings : complex array (r+1, s)
        Order 1 of each sensor, without trial masses first, then in each run with some.
    trials : complex array (r, p) [kg m]
        Unbalance of the trial masses of each run in each plane; from the same mark as the phases of the readings.

    Returns
    -------
    FieldBalance

    Raises
    ------
    InputError
        Fewer sensors or runs than planes, or runs that tell nothing of a plane.

    See Also
    --------
    tracked_orders

    Notes
    -----
    ISO 21940-13: V_r - V_0 = Σ α_j U_rj, least squares where there are more runs or sensors than planes; correction W
    with V_0 + α W = 0. Behind a joint the force of an unbalance turns backward too, so that V = α U + β U*; with two
    runs a plane at different angles β is told as well, and W solves V_0 + α W + β W* = 0. One run a plane leaves up to
    |β/α| of the unbalance, about τ/2 = tan²(α/2)/2 behind a joint; a second balancing takes it.

    Examples
    --------
    >>> import numpy as np
    >>> from cardan.recordings import field_balance
    >>> truth = np.array([[2.0, 0.5j], [0.3, 1.0 + 1.0j]])
    >>> unbalance, trials = np.array([3.0, 1.0j]), np.diag([1.0, 2.0j])
    >>> found = field_balance(np.vstack([truth @ unbalance, (unbalance + trials) @ truth.T]), trials)
    >>> (found.correction + unbalance).round(12) + 0.0
    array([0.+0.j, 0.+0.j])
    """
    seen = np.atleast_2d(np.asarray(readings, dtype=complex))
    added = np.atleast_2d(np.asarray(trials, dtype=complex))
    runs, planes = added.shape
    check(_problems(seen, added))
    change = seen[1:] - seen[0]
    both = np.hstack([added, added.conj()])
    two_sided = bool(np.linalg.matrix_rank(both, tol=RANK * np.linalg.norm(both, 2)) == 2 * planes)
    known = both if two_sided else added
    found = np.linalg.lstsq(known, change, rcond=None)[0].T
    influence = found[:, :planes]
    mirrored = found[:, planes:] if two_sided else np.zeros_like(influence)
    # Real and imaginary parts of V_0 + α W + β W* = 0.
    plus, minus = influence + mirrored, influence - mirrored
    system = np.block([[plus.real, -minus.imag], [plus.imag, minus.real]])
    solved = np.linalg.lstsq(system, -np.concatenate([seen[0].real, seen[0].imag]), rcond=None)[0]
    correction = solved[:planes] + 1j * solved[planes:]
    size = np.linalg.svd(influence, compute_uv=False)
    spare = runs > known.shape[1]
    misfit = np.max(np.abs(change - known @ found.T)) / np.max(np.abs(change)) if spare else np.nan
    return FieldBalance(
        influence=influence,
        mirrored=mirrored,
        first=seen[0],
        correction=correction,
        remaining=seen[0] + influence @ correction + mirrored @ correction.conj(),
        misfit=float(misfit),
        condition=float(size[0] / size[-1]) if size[-1] > 0.0 else np.inf,
        two_sided=two_sided,
    )


def _problems(readings: Array, trials: Array) -> list[Problem]:
    """Return what is wrong with readings and trials."""
    (rows, sensors), (runs, planes) = readings.shape, trials.shape
    if rows != runs + 1:
        text = _("{rows} rows of readings for {runs} runs with trial masses; one more is needed, of the run without")
        return [Problem("readings", text.format(rows=rows, runs=runs), "inconsistent")]
    if not (np.all(np.isfinite(readings)) and np.all(np.isfinite(trials))):
        return [Problem("readings", _("needs to be finite"), "not_finite")]
    problems = []
    if sensors < planes:
        text = _("{sensors} sensors tell {planes} planes not apart; one for each plane is needed")
        problems.append(Problem("readings", text.format(sensors=sensors, planes=planes), "inconsistent"))
    if np.linalg.matrix_rank(trials, tol=RANK * np.linalg.norm(trials, 2)) < planes:
        text = _("the runs do not tell the {planes} planes apart; a run with a trial mass in each is needed")
        problems.append(Problem("trials", text.format(planes=planes), "inconsistent"))
    elif rows > 1 and np.max(np.abs(readings[1:] - readings[0])) == 0.0:
        problems.append(Problem("readings", _("the trial masses change nothing; heavier ones are needed"), "empty"))
    return problems


@dataclass(frozen=True, eq=False, kw_only=True)
class Readings:
    """Orders of the sensors in runs at one speed."""

    sensors: tuple[str, ...]
    quantity: tuple[str, ...]  # what each measures
    speed: float  # [rad/s]: of the shaft, mean of the first run
    value: Array  # (r, s, o), complex [SI]: orders of `ORDERS`, phases against the mark on the shaft


def readings_of(signals: Sequence[Signal], progress: Progress | None = None) -> Readings:
    """Return the orders of the sensors in recordings of runs, those that all of them have.

    signals: each with a mark on the shaft, a pulse or an angle, as tacho; at one speed.
    Raises InputError: no mark, no sensor that all have, or runs at other speeds than the first.
    """
    names = [{one.name: one for one in signal.measured if one.quantity in SHAKING} for signal in signals]
    shared = [name for name in names[0] if all(name in one for one in names)]
    problems = [] if shared else [Problem("runs", _("no vibration was measured in all of them"), "missing")]
    speeds, rows = [], []
    for signal, channels in zip(signals, names, strict=True):
        rotation = estimate_rotation(signal)
        if not rotation.phased:
            text = _("{name} has no mark on the shaft: phases need one pulse a turn, or an angle")
            problems.append(Problem("tacho", text.format(name=signal.name), "missing"))
        speeds.append(0.5 * sum(rotation.speeds))
        low, high = rotation.speeds
        if high - low > 2.0 * SAME_SPEED * high or abs(speeds[-1] / speeds[0] - 1.0) > SAME_SPEED:
            text = _("{name} was not run at the speed of the first, steadily")
            problems.append(Problem("runs", text.format(name=signal.name), "inconsistent"))
        turns = min(TURNS, max(4, int(rotation.angle[-1] - rotation.angle[0]) // 7))
        tracked = [tracked_orders(channels[name], rotation, ORDERS, turns=turns) for name in shared]
        rows.append([np.mean(one.value, axis=-1) for one in tracked])
        if progress is not None and progress(len(rows) / len(signals)) == "stop":
            break
    check(problems)
    return Readings(
        sensors=tuple(shared),
        quantity=tuple(names[0][name].quantity for name in shared),
        speed=speeds[0],
        value=np.asarray(rows),
    )
