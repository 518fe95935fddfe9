"""Drives as the compiled kernel of stability maps takes them: structure, numbers of each drive, tables."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.compiled.method import share
from cardan.maths.periodic.floquet import STAGES, collocation, monodromy
from cardan.questions.torsion.model.inputs import Asynchronous, Constant, Falling, Swinging
from cardan.questions.torsion.model.torsional_balance import joint_law
from cardan.questions.torsion.model.torsional_layouts import Turning, chosen
from cardan.questions.torsion.model.torsional_model import TorsionalModel
from cardan.questions.torsion.steady.orbit import Orbit, at_rest, straight_frequencies
from cardan.questions.torsion.steady.run_stability import (
    CHUNK,
    drift_of,
    drift_of_sums,
    linear_motion,
    monodromy_in_pieces,
    vibrating,
)

compiled = later("cardan.maths.compiled.floquet")

LANES = 8
"""Drives that the kernel takes at once."""

KINDS = {Constant: 0, Falling: 1, Swinging: 2, Asynchronous: 3}
"""Laws of torques that the kernel knows, and their numbers there."""

REACH = 2.0
"""Largest phase of the fastest oscillation in a step of five stages: it errs by 2e-7 of that phase, others by less."""

LADDER = (16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 768, 1024, 1536, 2048)
"""Numbers of steps of a period."""

TAIL = 1e-5
"""τ to the power of the harmonics; where resonance makes them larger the motion is sought again with more."""

ROUNDS = 12
"""Newton steps at most."""

SURE = 2e-5
"""Largest last Newton step, over the motion, of a motion that the kernel is trusted with."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Mapped:
    """What the kernel found of drives."""

    matrix: Array  # (B, m, m): monodromy matrices for (x, ẋ)
    coefficient: Array  # (B, R, H+1), complex: of the motion of the free coordinates
    force: Array  # (B,): constant torque on the first station of free drives
    moved: Array  # (B,): last Newton step over the motion; nan where there is none


def fits(model: TorsionalModel, speed: Array) -> bool:
    """Tell whether the kernel can take drives: all one way, straight springs, no backlash, cross joints, alike."""
    heavy = _inertia(model) > 0.0
    alike = np.all(heavy == heavy.reshape(-1, heavy.shape[-1])[:1])
    return (
        bool(np.any(heavy))
        and bool(alike)
        and bool(np.all(speed > 0.0) or np.all(speed < 0.0))
        and not np.any(model.backlash > 0.0)
        and model.sums is None
        and not model.special
        and all(type(torque.law) in KINDS for torque in model.torques)
    )


def _inertia(model: TorsionalModel) -> Array:
    """Return the inertia of every coordinate that is not forced, joints straight, array (..., R) [kg m²]."""
    found = np.zeros((*model.inertia.shape[:-1], model.coordinates))
    for k, r in enumerate(model.coordinate):
        found[..., r] += model.inertia[..., k]
    return found[..., 0 if model.free else 1 :]


def heavy_of(model: TorsionalModel) -> Array:
    """Return which coordinates that are not forced turn some inertia, array of bool (R,)."""
    found: Array = np.any(_inertia(model).reshape(-1, model.coordinates - (0 if model.free else 1)) > 0.0, axis=0)
    return found


def mapped(
    turning: Turning,
    harmonics: int,
    *,
    alike: int = 1,
    near: Mapped | None = None,
    moves_only: bool = False,
    threads: int | None = None,
) -> Mapped:
    """Return motions and monodromy matrices of drives by the compiled kernel.

    turning: drives for which `fits` holds; harmonics: H.
    alike: how many drives behind each other get as many steps, so that their matrices err alike; 1 or a multiple of 8.
    near: the same drives with fewer harmonics, to begin with; moves_only: leave the matrices undone.
    Where a coordinate has no inertia the points are those of Radau: its speed at the beginning of a step then has no
    share in the end, so it is carried along as a state and left out of the matrices. What turns backwards is seen from
    the other side, where it turns forwards.
    """
    count = len(turning.speed)
    sense = 1.0 if turning.speed[0] > 0.0 else -1.0
    padded = -(-count // LANES) * LANES
    drives = _numbers(turning)
    n, states = 2 * harmonics + 1, 2 * turning.coordinates
    known = np.zeros((padded, turning.coordinates * n + 1))
    known[:count, : turning.coordinates * n : n] = sense * at_rest(turning)[:, :, 0].real
    if near is not None:
        _begin_near(known[:count], near, sense, n)
    drives, known = (
        np.concatenate([one, np.repeat(one[-1:], padded - count, axis=0)]) for one in (drives, known[:count])
    )
    phase, bases, back = _tables(harmonics, turning.period)
    steps = _steps(turning)
    if alike > 1:
        steps = np.repeat(np.max(steps.reshape(-1, alike), axis=-1), alike)
    steps = np.max(np.append(steps, np.repeat(steps[-1:], padded - count)).reshape(-1, LANES), axis=-1)
    heavy = heavy_of(turning.model)
    stiff = not heavy.all()
    steps = 0 * steps if moves_only else steps
    nodes, begins = _nodes(sorted(set(steps.tolist())), harmonics, turning.period, stiff=stiff)
    points, once = collocation(STAGES, stiff=stiff)
    scheme = np.concatenate([[STAGES], points, once.ravel(), (once @ once[:-1]).ravel()])
    matrix, moved = np.empty(padded * states * states), np.empty(padded)
    flat = known.reshape(-1)
    run = partial(
        _call,
        compiled().kernel,
        (_plan(turning.model, n, drives.shape[-1]), drives.reshape(-1), bases, back, phase, nodes, scheme),
        (np.asarray([begins[int(one)] for one in steps], dtype=np.intp), steps.astype(np.intp)),
        (turning.period, turning.model.free, ROUNDS),
        (flat, matrix, moved),
    )
    share(run, padded // LANES, threads=threads)
    table = flat.reshape(padded, -1)[:count, :-1].reshape(count, turning.coordinates, n)
    coefficient = table[..., : harmonics + 1].astype(complex)
    coefficient[..., 1:] -= 1j * table[..., harmonics + 1 :]
    kept = np.append(np.ones(len(heavy), dtype=bool), heavy)
    return Mapped(
        matrix=matrix.reshape(padded, states, states)[:count][:, kept][:, :, kept],
        coefficient=coefficient if sense > 0.0 else -coefficient.conj(),
        force=sense * flat.reshape(padded, -1)[:count, -1],
        moved=moved[:count],
    )


def _begin_near(known: Array, near: Mapped, sense: float, n: int) -> None:
    """Write motions that were found with fewer harmonics, and their force, where Newton's method begins."""
    rows = np.flatnonzero(near.moved <= SURE)
    found = near.coefficient[rows] if sense > 0.0 else -near.coefficient[rows].conj()
    width, harmonics = found.shape[-1], n // 2
    table = np.zeros((len(rows), found.shape[1], n))
    table[..., :width] = found.real
    table[..., harmonics + 1 : harmonics + width] = -found.imag[..., 1:]
    known[rows, :-1] = table.reshape(len(rows), known.shape[-1] - 1)
    known[rows, -1] = sense * near.force[rows]


def _call(kernel: object, before: tuple, steps: tuple, between: tuple, after: tuple, first: int, last: int) -> None:  # type: ignore[type-arg]
    kernel(*before, *steps, *between, first, last, *after)  # type: ignore[operator]


def _plan(model: TorsionalModel, n: int, width: int) -> Array:
    """Return the structure of drives as the kernel reads it."""
    rank, first = model.coordinates, 0 if model.free else 1
    of = model.coordinate
    coupled = np.eye(rank, dtype=bool)
    for a, b in model.elements:
        coupled[of[a], of[b]] = coupled[of[b], of[a]] = True
    pair_of = np.full((rank, rank), -1)
    free = np.arange(rank) >= first
    there = coupled & free & free[:, None]
    pair_of[there] = np.arange(int(there.sum()))
    filled = coupled[first:, first:].copy()
    for k in range(len(filled)):
        below = np.flatnonzero(filled[:, k])
        below = below[below > k]
        filled[np.ix_(below, np.flatnonzero(filled[k]))] = True
    lists = [
        [-1 if one is None else one[0] for one in model.driven],
        [-1 if one is None else one[1] for one in model.driven],
        of,
        np.asarray(model.elements, dtype=int).ravel(),
        [number for torque in model.torques for number in (torque.station, KINDS[type(torque.law)], 0)],
        pair_of.ravel(),
        filled.ravel(),
    ]
    sizes = (
        *(len(model.driven), rank, first, len(model.elements), model.joint_angle.shape[-1], len(model.torques)),
        *(int(there.sum()), width, n),
    )
    return np.concatenate([sizes, *[np.asarray(one, dtype=int) for one in lists]]).astype(np.intp)


def _numbers(turning: Turning) -> Array:
    """Return the numbers of each drive, of one that turns backwards as seen from the other side: array (B, width)."""
    model = turning.part(np.arange(len(turning.speed))).model
    count, sense = len(turning.speed), np.sign(turning.speed)[:, None]
    tau = np.tan(0.5 * model.joint_angle) ** 2
    start = joint_law(model.phase, model.joint_angle)[0] - model.phase
    cosine, square = np.cos(model.joint_angle), np.sin(model.joint_angle) ** 2
    joints = np.stack([sense * model.phase, sense * start, tau, cosine, square], axis=-1)
    rest = np.zeros_like(model.stiffness) if model.rest is None else sense * model.rest
    values = [np.broadcast_to(one, (count,)) for torque in model.torques for one in _values(torque.law, sense[:, 0])]
    columns = [
        *(model.inertia, model.ground_damping, model.stiffness, model.damping, rest, joints.reshape(count, -1)),
        *(np.reshape(values, (-1, count)).T, model.of_disturbances.damping),
        np.stack([np.abs(turning.speed), np.abs(turning.frequency)], axis=-1),
    ]
    return np.ascontiguousarray(np.concatenate(columns, axis=-1))


def _values(law: object, sense: Array) -> tuple[Array, Array, Array]:
    """Return the numbers of a law, backwards (sense -1) as seen from the other side: -M(-angle, -speed)."""
    nothing = np.zeros(())
    if isinstance(law, Constant):
        return sense * law.value, nothing, nothing
    if isinstance(law, Falling):
        return sense * law.standstill, law.slope, nothing
    if isinstance(law, Swinging):
        return law.amplitude, sense * law.phase, np.asarray(0.5 * law.frequency)
    assert isinstance(law, Asynchronous)
    return sense * law.synchronous_speed, sense * law.pullout_torque, law.pullout_slip


def _waves(phase: Array, harmonics: int) -> Array:
    """Return harmonics and their two derivatives at phases, array (p, 3, n)."""
    order = np.arange(1, harmonics + 1)
    cosine, sine = np.cos(phase[:, None] * order), np.sin(phase[:, None] * order)
    one, nothing = np.ones((len(phase), 1)), np.zeros((len(phase), 1))
    return np.stack(
        [
            np.concatenate([one, cosine, sine], axis=-1),
            np.concatenate([nothing, -order * sine, order * cosine], axis=-1),
            np.concatenate([nothing, -(order**2) * cosine, -(order**2) * sine], axis=-1),
        ],
        axis=1,
    )


def _tables(harmonics: int, period: float) -> tuple[Array, Array, Array]:
    """Return shaft angles of the samples, harmonics there, and the way back, flat."""
    samples = 4 * harmonics + 4
    phase = 2.0 * np.pi * np.arange(samples) / samples
    waves = _waves(phase, harmonics)
    back = waves[:, 0].T * (2.0 / samples)
    back[0] *= 0.5
    return phase * (period / (2.0 * np.pi)), waves.ravel(), back.ravel()


def _nodes(rungs: list[int], harmonics: int, period: float, *, stiff: bool) -> tuple[Array, dict[int, int]]:
    """Return shaft angle and harmonics at the points of the steps, flat, and where each number of steps begins."""
    points, _once = collocation(STAGES, stiff=stiff)
    parts, begins, total = [], {}, 0
    for steps in rungs:
        phase = 2.0 * np.pi * ((np.arange(steps)[:, None] + points) / steps).ravel()
        waves = _waves(phase, harmonics).reshape(len(phase), 3 * (2 * harmonics + 1))
        parts.append(np.concatenate([phase[:, None] * (period / (2.0 * np.pi)), waves], axis=-1).ravel())
        begins[steps] = total
        total += len(phase)
    return np.concatenate(parts), begins


def _steps(turning: Turning) -> Array:
    """Return how many steps of a period each drive needs: its fastest mode, quickened by the steepest joint."""
    model = turning.part(np.arange(len(turning.speed))).model
    fastest = straight_frequencies(model)[:, -1]
    steepest = np.max(1.0 / np.cos(model.joint_angle), axis=-1, initial=1.0)
    phase = fastest * steepest * turning.period / np.abs(turning.speed)
    near = np.sqrt(
        np.max(np.tan(0.5 * model.joint_angle) ** 2, axis=-1, initial=1e-9)
    )  # how near a joint comes to a pole
    smooth = turning.period / np.maximum(-0.5 * np.log(near), 1e-3)
    wanted = np.maximum(phase / REACH, smooth)
    return np.asarray(LADDER)[np.minimum(np.searchsorted(LADDER, wanted), len(LADDER) - 1)]


def harmonics_for(model: TorsionalModel, period: float) -> int:
    """Return how many harmonics of the period the motion of drives needs, from their bends."""
    tau = float(np.tan(0.5 * np.max(model.joint_angle, initial=0.0)) ** 2)
    wanted = math.ceil(math.log(TAIL) / math.log(max(tau, 1e-9)))
    own = model.own_laws
    if own is not None:
        orders = np.arange(own.shape[-2])[:, None]
        wanted = max(wanted, math.ceil(0.5 * float(np.max(orders * (np.abs(own) > TAIL)))))
    return min(max(wanted, 5), 10) * round(period / np.pi)


# How fast does vibration of running drives grow? For searches: many motions at once, drift of the mean speed aside.

WORTH = 3000.0
"""Oscillations of the fastest mode in all motions together, in radians, from which the kernel is worth loading."""


def vibration_growth(orbit: Orbit, rows: Array) -> Array:
    """Return by how much disturbances of motions grow in a period, ln max|ρ|: array (b,).

    orbit (...): as `cardan.questions.torsion.steady.alternating_torque.torque_swings` gives it.
    rows (b,) of int: which motions, counted through the leading axes.
    Returns: negative where every disturbance dies out; nan where there is no motion.
    As `run_stability.floquet`, but that the drift of free drives to another mean speed is always left out,
    also where a motor or load governs it, as a weak motor fails to above a resonance: that is no vibration, and the
    speeds of a search are given. Compiled where it is worth it.
    """
    found = np.full(len(rows), np.nan)
    there = np.isfinite(orbit.coefficient.reshape(orbit.count, -1)[rows]).all(axis=-1)
    smooth = np.flatnonzero(there & ~np.isin(rows, list(orbit.pieces)))
    for k in np.flatnonzero(there & np.isin(rows, list(orbit.pieces))):
        drift = partial(_drift, orbit, rows[[k]])
        found[k] = _largest(monodromy_in_pieces(orbit, int(rows[k]))[None], orbit.model.free, drift)[0]
    if smooth.size:
        found[smooth] = _smooth(orbit, rows[smooth])
    return found


def _smooth(orbit: Orbit, rows: Array) -> Array:
    speed = orbit.speed.reshape(-1)[rows]
    part = Turning(chosen(orbit.model, orbit.angle_error, rows, moments=False), (len(rows),), speed, orbit.period)
    found = np.full(len(rows), np.nan)
    fastest = straight_frequencies(part.drives(np.arange(len(rows))))[:, -1]
    if np.sum(fastest * orbit.period / np.abs(speed)) >= WORTH and fits(part.model, speed):
        said = mapped(part, harmonics_for(part.model, orbit.period))
        sure = np.flatnonzero((said.moved <= SURE) & np.isfinite(said.matrix).all(axis=(1, 2)))
        if sure.size:
            found[sure] = _largest(
                said.matrix[sure],
                orbit.model.free,
                lambda own: drift_of_sums(part.part(sure[own]), said.coefficient[sure[own]]),
            )
    left = np.flatnonzero(np.isnan(found))
    for first in range(0, len(left), CHUNK):
        some = left[first : first + CHUNK]
        matrix = monodromy(linear_motion(orbit, rows[some]), orbit.time.reshape(-1)[rows[some]])
        found[some] = _largest(matrix, orbit.model.free, partial(_drift, orbit, rows[some]))
    return found


def _drift(orbit: Orbit, rows: Array, own: Array) -> Array:
    return drift_of(orbit, rows[own])


def _largest(matrix: Array, free: bool, drift: Callable[[Array], Array]) -> Array:
    """Return ln of the largest modulus of the multipliers of drives, array (b,)."""
    values = np.linalg.eigvals(matrix)
    values = vibrating(values, 2, drift) if free else values
    with np.errstate(divide="ignore"):
        found: Array = np.log(np.max(np.abs(values), axis=-1, initial=0.0))
    return found
