"""How does the cross of each joint move along its journals over a turn, by errors and within tolerances?

Errors of length are made up for by the cross, which moves along its journals in the bearings of both yokes, and by the
driven shaft along its axis. Over a turn the way changes: so much play the journals need, or the joint binds.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.curves.extremes import peak
from cardan.maths.kernel import loops

from .accuracy import (
    Errors,
    coefficients,
    error_arrays,
    given_errors,
    located_shafts,
    one_turn,
    own_kinds,
    still,
    walked,
)
from .own_laws import turned as turned_by
from .tolerance import ToleranceBand, WorstCase, change, spreads, stacked

YOKES = ("driving", "driven")
"""The yokes in which a cross moves, in the order of the axis of arrays."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CrossPlay:
    """How the cross of one joint moves along its journals in one of its yokes."""

    joint: int  # number of the joint, from 1
    yoke: str  # "driving" or "driven"
    free: bool  # whether the cross slides there, so that nothing can bind
    known: Array  # (p,) [m]: way over the turn by the known errors, exactly
    reach: Array  # (p,) [m]: ± what the tolerances add to it, by the method
    play: float  # [m]: the play that the journals need over a turn, by both together

    @property
    def ends(self) -> tuple[float, float]:
        """Least and largest way over the turn [m]."""
        return float(np.min(self.known - self.reach)), float(np.max(self.known + self.reach))


def cross_slides(
    drive: Drive | Chain,
    angle: ArrayLike | None = None,
    *,
    errors: Errors = None,
    located: tuple[int, ...] | None = None,
) -> Array:
    """Return how the crosses move along their driving and driven journals, array (n, 2, p) [m], exactly.

    drive: its joints of other kinds by their laws; angle (p,) [rad]: input angle φ_1 from the start
    position, one turn of 360 positions by default; errors: of the joints by name, those of the drive where nothing is
    given; located: numbers of the shafts that a bearing holds along their axis, those with axial supports by default.
    s_2 and s_3 of `loop_slides`.
    """
    return loop_slides(drive, angle, errors=errors, located=located)[:, :2]


def loop_slides(
    drive: Drive | Chain,
    angle: ArrayLike | None = None,
    *,
    errors: Errors = None,
    located: tuple[int, ...] | None = None,
) -> Array:
    """Return s_2, s_3, s_4 of the loop of each joint, array (n, 3, p) [m]; arguments as those of `cross_slides`.

    Each at the angle and with the shift that the joint before it really gives; nan where it does not close.
    Kozhevnikov & Perfil'ev (1978), eq. 171.
    """
    chain, own = walked(drive), own_kinds(drive)
    held = located_shafts(drive) if located is None else located
    turned, shifted = given_errors(drive, chain.joints, errors)
    mu = chain.turn_before
    theta, shift, found = np.asarray(one_turn() if angle is None else angle) + mu[0], np.asarray(0.0), []
    for j, joint_angle in enumerate(chain.joint_angle.tolist()):
        theta = theta + (mu[j] if j else 0.0) + turned[j, 0]
        alpha = np.asarray([0.5 * np.pi, 0.5 * np.pi, 0.5 * np.pi, joint_angle]) + turned[j, 1:5]
        before = 0.0 * shift if j + 1 in held else shift
        if own and (joint := own[j]) is not None:
            lead, ratio = turned_by(joint, joint_angle, turned[j], theta)
            theta, shift = theta + lead - (0.0 if joint.crossed else 0.5 * np.pi), ratio * before
            found.append(np.stack((0.0 * theta, 0.0 * theta, -shift)))
            continue
        loop = loops.rccc(alpha, theta, length=shifted[j, 1:], slide=before + shifted[j, 0])
        found.append(np.moveaxis(loop.slide, -1, 0))
        theta, shift = 0.5 * np.pi - loop.angle[..., 2], -loop.slide[..., 2]
    return np.stack(found)


def cross_sensitivity(drive: Drive | Drives | Chain, angle: Array, *, located: tuple[int, ...] = ()) -> Array:
    """Return how the ways of perfect crosses feel errors of length, array (n, 2, p, n, 5): by the `WAYS` of each joint.

    drive: one; angle (p,) [rad]; located: numbers of the shafts that a bearing holds along their axis.
    """
    moved = still(drive, angle)
    table = coefficients(moved)  # (n, p, 3, 5)
    count = len(table)
    before, rows = np.zeros((len(angle), count, 5)), []
    for j, own in enumerate(table):
        carried = 0.0 * before if j + 1 in located else before
        ways = own[:, :, :1, None] * carried[:, None]  # (p, 3, n, 5)
        ways[:, :, j] += own
        rows.append(np.moveaxis(ways[:, :2], 1, 0))
        before = -ways[:, 2]
    return np.stack(rows)


def cross_play(drive: Drive, band: ToleranceBand | None) -> tuple[CrossPlay, ...]:
    """Return how the cross of each joint moves in both its yokes; empty where no error or tolerance of length is given.

    band: what the tolerances do to the output: tells how they add up, of samples as the root of squares.
    """
    limits = np.zeros((len(drive.joints), 5)) if band is None else error_arrays(spreads(drive, None), drive.joints)[1]
    held, phi = located_shafts(drive), one_turn() if band is None else band.angle
    known = cross_slides(drive, phi)
    parts = cross_sensitivity(drive, phi, located=held) * limits
    if not np.any(known) and not np.any(limits):
        return ()
    return tuple(_plays(drive, known, parts, 1 if band is not None and isinstance(band.method, WorstCase) else 2))


def _plays(drive: Drive, known: Array, parts: Array, power: int) -> Iterator[CrossPlay]:
    for j, joint in enumerate(drive.joints):
        if not joint.single_cross:
            continue
        slides = joint.cross.slides if joint.cross else False
        for k, yoke in enumerate(YOKES):
            flat = parts[j, k].reshape(parts.shape[2], -1)
            way = known[j, k]
            yield CrossPlay(
                joint=j + 1,
                yoke=yoke,
                free=slides is True or slides == yoke,
                known=way,
                reach=stacked(flat, power),
                play=float(peak(way) + peak(-way)) + change(flat[..., None], power),
            )
