"""What tolerances of the pairs inside a joint do, to first order: by what each carries of a torque on its shaft."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.joints import Joint
from cardan.drive.joints.joint import SHIFTS
from cardan.maths.arrays import Array
from cardan.mechanism.kinetostatics import each_carried, influence
from cardan.questions.motion.joint_mechanism import ASIDE, BEFORE, NORMAL, JointCarried, joint_carried

from . import places
from .accuracy import still
from .own_laws import STEP, WEIGHTS

AXES = BEFORE, ASIDE, NORMAL
"""Along which `SHIFTS` are counted."""

PLACES = 128
"""Even places of a turn at which pairs are looked at; between them by the harmonics, which have faded by then."""


@dataclass(frozen=True, eq=False, kw_only=True)
class PairError:
    """How the output of a drive feels that the second half of a pair is off, a vector that goes with its link."""

    joint: int  # number of its joint, from 1
    pair: str  # what its mechanism file calls it
    key: str  # path of its tolerance in the joint
    dimension: str  # of it
    tolerance: float  # largest length of the vector [m or rad]
    # (p, 3): output angle over the vector, along the axes in which the file draws the pair
    table: Array
    start: Array  # (p, 3, 3): shift of the driven shaft in its joint, along `SHIFTS`, over the vector
    # (n, 3, p, 3, 3): ways of all shafts, as `places.Moved` has them, over the vector; None where it moves none
    ways: Array | None = None


def pair_errors(drive: Drive, phi: Array) -> tuple[PairError, ...]:
    """Return how the output feels each pair that has a tolerance. phi (p,) [rad]: input angles."""
    if not any(joint.tolerated for joint in drive.joints):
        return ()
    moved = still(drive, phi)
    found = []
    for j, joint in enumerate(drive.joints):
        if not joint.tolerated:
            continue
        behind = moved.shaft_ratio[-1] / moved.shaft_ratio[j + 1]
        shifts = _shifts(drive, phi, j)
        for one in _of_joint(joint, float(moved.joint_angle[j])):
            table, start = (_between(rows, moved.yoke_rotation[j]) for rows in (one.table, one.start))
            table, ways = behind[..., None] * table, None
            if shifts is not None:
                table = table + np.einsum("pk,pkv->pv", shifts.angle, start)
                ways = np.einsum("nwpxk,pkv->nwpxv", shifts.ways, start)
            found.append(replace(one, joint=j + 1, table=table, start=start, ways=ways))
    return tuple(found)


def _shifts(drive: Drive, phi: Array, j: int) -> places.Moved | None:
    """Return what it does that the driven shaft of a joint starts off its centre, along each of `SHIFTS` as last axis.

    To first order; None where that shaft keeps its place, or the joint leaves it free to shift.
    """
    if places.unmoved(drive, j + 1):
        return None
    step = places.LENGTH * STEP
    each, weight = (np.asarray(row) for row in zip(*WEIGHTS, strict=True))
    rows = []
    for key in SHIFTS:
        off = [
            {name: (each if name == key else 0.0 * each) * step for name in SHIFTS} if k == j else {}
            for k in range(len(drive.joints))
        ]
        rows.append(places.moved(drive, phi, off))
    angle, ways = (
        np.stack([np.tensordot(weight / step, getattr(one, name), 1) for one in rows], axis=-1)
        for name in ("angle", "ways")
    )
    return places.Moved(angle=angle, ways=ways)


def _between(rows: Array, theta: Array) -> Array:
    """Return rows (P, ...) at even places of a turn at other angles (p,) [rad], by their harmonics."""
    wave = np.fft.rfft(rows, axis=0) / len(rows)
    wave[1:-1] *= 2.0
    turns = np.exp(1j * np.outer(theta, np.arange(len(wave))))
    return np.real(np.tensordot(turns, wave, 1))


@lru_cache(
    maxsize=32
)  # asked for again by each way in which errors add up, and at every place that an optimum looks at
def _of_joint(joint: Joint, joint_angle: float) -> tuple[PairError, ...]:
    """Return the same of the driven mark of a joint, at even places of a turn of its driving mark."""
    return tuple(_felt(joint, joint_angle))


def _felt(joint: Joint, joint_angle: float) -> Iterator[PairError]:
    carried = joint_carried(joint, joint_angle, np.arange(PLACES) * (2.0 * np.pi / PLACES))
    felt = -influence(carried.placed, carried.found, 1.0)  # a half that is off one way sends its link the other way
    starts = [_pushed(carried, axis) for axis in AXES]
    for k, pair in enumerate(carried.pairs[: carried.inner]):
        off = pair.tolerated
        if off is None:
            continue
        every = np.stack([rows[:, k] for rows in (felt, *starts)], axis=1)  # (p, 4, 6)
        ways = (
            ("tolerance", "length", off.shift, every[..., 3:] @ off.axes),
            ("tolerance_turn", "angle", off.turn, every[..., :3] @ off.axes),
        )
        for key, dimension, tolerance, row in ways:
            if tolerance:
                yield PairError(
                    joint=0,
                    pair=off.name,
                    key=f"{off.field}.{key}",
                    dimension=dimension,
                    tolerance=tolerance,
                    table=row[:, 0],
                    start=row[:, 1:],
                )


def _pushed(carried: JointCarried, axis: Array) -> Array:
    """Return how far errors of pairs shift the driven shaft in its joint along an axis, array (p, m, 6)."""
    load = np.zeros((*carried.placed.point.shape[:-2], carried.placed.links, 6))
    load[:, 1, 3:] = -axis
    about = np.concatenate((AXES[0], np.zeros(3)))
    return -influence(
        carried.placed, each_carried(carried.placed, [((), True)], input_link=0, about=about, load=load)[0], 1.0
    )
