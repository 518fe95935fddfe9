"""What holds a drive while its journals rub: the forces on its supports, for the friction in them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.models.train import Train, place_of
from cardan.maths.arrays import Array
from cardan.maths.kernel import frames
from cardan.questions.forces.kinetostatics import Stand, standing
from cardan.questions.forces.reactions import Frame, Load, forces_of, frame, right_side, solved, weights
from cardan.texts import _


def trouble(train: Train) -> str:
    """Return why the forces on the supports are not determinate, in one sentence; empty where they are.

    train: one drive.
    """
    held = _held(train, np.zeros(1))[1]
    more = held.unknowns - held.equations
    if more > 0:
        return _("the supports hold the drive {count} times more than balance can tell apart").format(count=more)
    if more < 0:
        return _("the supports leave the drive {count} ways to give").format(count=-more)
    regular = solved(held, np.zeros((1, held.matrix.shape[-2])))[1]
    return "" if bool(np.all(regular)) else _("the supports hold the drive twice one way and not at all another way")


@dataclass(frozen=True, eq=False, kw_only=True)
class Response:
    """Forces on the supports per couple of each cross, at some positions."""

    weight: Array  # (..., p, k, 3) [N]: what weights put on the supports
    pull: Array  # (..., p, n, k, 3) [1/m]: forces per couple T_i of the crosses
    # (..., p, n, k, 3) [1/m]: forces per |T_i| by the friction of the journals, for an input that turns the positive
    # way
    rub: Array

    def load(self, couple: Array, sense: Array) -> Array:
        """Return \\|R_b\\| for couples (..., n, p) and senses (...) of turning, array (..., k, p) [N]."""
        turned = np.moveaxis(couple, -1, -2)[..., None, :]
        way = np.asarray(sense)[..., None, None, None]
        shape = *self.pull.shape[:-2], -1
        both = np.matmul(turned, np.reshape(self.pull, shape)) + way * np.matmul(
            np.abs(turned), np.reshape(self.rub, shape)
        )
        force = np.reshape(both, (*both.shape[:-2], *self.weight.shape[-2:])) + self.weight
        found: Array = np.moveaxis(frames.norm(force), -1, -2)
        return found


def response(train: Train, drag: Array, angle: Array) -> Response:
    """Return the forces on the supports per couple of each cross.

    train: one drive, its supports determinate; drag (n,): κ of each joint; angle (..., p) [rad]: input angles.
    The couple T n ∓ κ|T| u ± κ|T| v of every cross bends its two shafts; what its part across them needs, and
    the weights, is in balance with the forces in the joints and supports. That balance is linear, so each part is
    solved for once. Thrust of splines is left out: at rest lengthwise they need not push.
    """
    n = train.joints
    stand, held = _held(train, np.reshape(angle, -1))
    e, u, v = stand.axis, stand.driving_arm, stand.driven_arm
    slip = np.sign(frames.dot(u, e[..., 1:, :]))[..., None] * u - np.sign(frames.dot(v, e[..., :-1, :]))[..., None] * v
    couples = frames.cross(u, v), -drag[:, None] * slip

    def solved_for(across: Array, loads: list[Load]) -> Array:
        none = np.zeros((*across.shape[:-2], len(train.splines)))
        reaction = forces_of(held, solved(held, right_side(held, across, loads, none))[0])[1]
        found: Array = np.reshape(reaction, (*angle.shape, *reaction.shape[-2:]))
        return found

    still = np.zeros((angle.size, n + 1, 3))
    parts = [np.stack([solved_for(_across(e, one, i), []) for i in range(n)], axis=-3) for one in couples]
    return Response(weight=solved_for(still, weights(train, held, stand, None)), pull=parts[0], rub=parts[1])


def _held(train: Train, angle: Array) -> tuple[Stand, Frame]:
    """Return how the drive stands at input angles (p,), and how it is held."""
    place = place_of(train)
    stand = standing(train.chain, place.axis, place.normal, angle, speed=1.0)
    return stand, frame(train, stand, train.points[None])


def _across(axis: Array, couple: Array, i: int) -> Array:
    """Return what the couple of cross i alone leaves across each shaft, array (p, n+1, 3)."""
    whole = np.zeros((couple.shape[0], axis.shape[-2], 3))
    whole[:, i], whole[:, i + 1] = -couple[:, i], couple[:, i]
    found: Array = whole - frames.dot(whole, axis)[..., None] * axis
    return found
