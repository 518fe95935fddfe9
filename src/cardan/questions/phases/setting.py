"""A set of yoke angles and what it leaves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array, namespace, unit_complex
from cardan.maths.kernel import mobius
from cardan.maths.kernel.mobius import Pair
from cardan.questions.motion.equivalence import SYNCHRONOUS as EVEN
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import initial_phases
from cardan.units import deg


@dataclass(frozen=True, eq=False, kw_only=True)
class YokeSetting:
    """One choice of the yoke angles of a drive.

    Attributes
    ----------
    label : str
        What to call it in a table.
    yoke_angle : array (n-1,) [rad]
        γ of shafts 2 … n in (-π/2, π/2].
    speed_fluctuation : float
        δ of the output.
    shaft_speed_fluctuation : array (n,)
        δ of shafts 2 … n+1.
    initial_phase : array (n,) [rad]
        ψ of each joint.
    sensitivity : array (n-1,) [1/rad]
        Growth of δ when the yoke of shaft 2 … n is turned, see `sensitivity`.
    one_off : array (n-1,)
        Growth of δ when the yoke of shaft 2 … n stands a degree off, see `growth`; in the worst of drive and poses.
    vertex : complex array (n+1,)
        Corners of the phase polygon in the unit disk.
    change : array (n-1,) [rad]
        Turn from the yoke angles as built, in (-π/2, π/2].
    pose_speed_fluctuation : array (p,)
        δ in each pose; empty when the drive has none.
    start_phase : float or None [rad]
        ψ_1 that goes with it; None where it stays as in the file.
    """

    label: str
    yoke_angle: Array
    speed_fluctuation: float
    shaft_speed_fluctuation: Array
    initial_phase: Array
    sensitivity: Array
    one_off: Array
    vertex: Array
    change: Array
    pose_speed_fluctuation: Array = field(default_factory=lambda: np.zeros(0))
    start_phase: float | None = None


STEP = 1e-9
"""Yokes turned by less than this [rad] stay as they are in the file."""


def values_of(setting: YokeSetting, drive: Drive) -> dict[str, float]:
    """Return what a setting changes in the file of a drive, by paths with their unit.

    drive: as it stands in the file.

    >>> from cardan import phases
    >>> drive = Drive.from_angles([0.2, 0.2], yoke_angles=[0.3])
    >>> values_of(phases(drive).settings[0], drive)
    {'shafts[1].yoke_angle_deg': 0.0}
    """
    shafts = [(f"shafts[{shaft.number - 1}].yoke_angle_deg", shaft.yoke_angle) for shaft in drive.shafts[1:-1]]
    moved = {
        key: float(angle)
        for (key, present), angle, change in zip(shafts, setting.yoke_angle, setting.change, strict=True)
        if max(abs(float(np.sin(angle - present))), abs(float(change))) > STEP
    }
    first = setting.start_phase
    if first is not None and abs(np.sin(first - drive.input.start_phase)) > STEP:
        moved["input.start_phase_deg"] = first
    return {key: round(float(np.rad2deg(angle)), 12) + 0.0 for key, angle in moved.items()}


def wrapped(angle: Array) -> Array:
    """Return a yoke angle modulo π in (-π/2, π/2].

    >>> print(wrapped(np.asarray([-1.5707963267948966, 3.0])))
    [ 1.57079633 -0.14159265]
    """
    xp = namespace(angle)
    half = 0.5 * xp.pi
    steps = xp.ceil((angle - half) / xp.pi - 1e-15)
    return xp.minimum(angle - xp.pi * steps, half + 0.0 * angle)


def with_yokes(chain: Chain, yoke_angle: Array) -> Chain:
    """Return the chain with other yoke angles, array (..., n-1) [rad]; leading axes make a batch."""
    xp = namespace(chain.joint_angle, yoke_angle)
    return Chain(
        joint_angle=xp.broadcast_to(chain.joint_angle, (*yoke_angle.shape[:-1], chain.joints)),
        plane_twist=chain.plane_twist,
        yoke_angle=yoke_angle,
        start_phase=chain.start_phase,
    )


def turned(chain: Chain) -> tuple[Pair, Array, Array]:
    """Return the pair (a, b) of the drive and its derivatives by the yoke angles.

    Returns (a, b) (...): the whole drive; da, db (..., n-1) [1/rad], complex: derivatives by γ_2 … γ_n.
    G = S_j R(μ_j) P_{j-1} with the products S_j of joints j … n and P_{j-1} of joints 1 … j-1; dR/dμ = diag(i, -i) R
    and dμ_j/dγ_j = -1.
    """
    before = chain.products()
    turn = chain.turn_before
    xp = namespace(chain.joint_angle)
    after = mobius.hooke(chain.joint_angle[..., -1])
    da, db = [], []
    for j in range(chain.joints - 1, 0, -1):
        spin = unit_complex(turn[..., j])
        a, b = before[j - 1]
        p, q = after
        da.append(-1j * (p * spin * a - q * xp.conj(spin * b)))
        db.append(-1j * (p * spin * b - q * xp.conj(spin * a)))
        after = mobius.compose(
            mobius.compose(after, mobius.turn(turn[..., j])), mobius.hooke(chain.joint_angle[..., j - 1])
        )
    return before[-1], _stack(da, chain), _stack(db, chain)


def _stack(columns: list[Array], chain: Chain) -> Array:
    xp = namespace(chain.joint_angle)
    if not columns:
        return xp.zeros((*chain.joint_angle.shape[:-1], 0), dtype=xp.complex128)
    return xp.stack(columns[::-1], axis=-1)


def sensitivity(chain: Chain) -> Array:
    """Return how fast δ grows as each yoke is turned, array (..., n-1) [1/rad].

    Where δ > 0 this is the derivative dδ/dγ, zero at a minimum and negative where turning forward helps. Where the
    drive is synchronous δ has a corner: it grows equally to both sides, and this is that slope.
    δ = 4 |a| |b|, exactly differentiated. At closure the slope is 4 |a| |db/dγ|, for small joint angles
    8 |Σ_{k≥j} τ_k e^{2iΨ_k}|.

    >>> from cardan import Drive
    >>> from cardan.drive.models.kinematics_model import chain
    >>> sensitivity(chain(Drive.from_angles([20 * deg, 20 * deg]))) * deg
    array([0.00434...])
    """
    (a, b), da, db = turned(chain)
    xp = namespace(chain.joint_angle)
    size_a, size_b = xp.abs(a)[..., None], xp.abs(b)[..., None]
    closed = 4.0 * size_a * size_b < EVEN
    along_b = xp.real(xp.conj(b)[..., None] * db) / xp.where(closed, 1.0 + 0.0 * size_b, size_b)
    along_a = xp.real(xp.conj(a)[..., None] * da) / size_a
    return 4.0 * xp.where(closed, size_a * xp.abs(db), size_a * along_b + size_b * along_a)


def growth(chain: Chain, yoke_angle: Array, error: float = deg) -> Array:
    """Return by how much δ grows when one yoke stands off, to the worse side, array (..., n-1).

    yoke_angle (..., n-1) [rad]: settings of its yokes; error [rad]: how far each yoke stands off, one at a time.
    max δ(γ ± error) - δ(γ), exact. At a smooth minimum the slope, see `sensitivity`, is 0 and this is not.

    >>> from cardan import Drive
    >>> from cardan.drive.models.kinematics_model import chain
    >>> drive = chain(Drive.from_angles([20 * deg, 20.01 * deg]))
    >>> growth(drive, drive.yoke_angle), bool(abs(sensitivity(drive)) < 1e-12)
    (array([0.00422...]), True)
    """
    count = yoke_angle.shape[-1]
    off = error * np.concatenate((np.eye(count), -np.eye(count)))
    moved = equivalent_joint(with_yokes(chain, yoke_angle[..., None, :] + off)).speed_fluctuation
    here = equivalent_joint(with_yokes(chain, yoke_angle)).speed_fluctuation
    found: Array = np.max(moved.reshape(*moved.shape[:-1], 2, count), axis=-2) - here[..., None]
    return found


def settings(
    chain: Chain, yoke_angle: Array, labels: Sequence[str], as_built: Array, poses: Sequence[Chain] = ()
) -> tuple[YokeSetting, ...]:
    """Evaluate sets of yoke angles by the exact model.

    yoke_angle (s, n-1) [rad]; as_built (n-1,) [rad]: present yoke angles; poses: the drive in its poses.
    """
    tidy = wrapped(yoke_angle)
    batch = with_yokes(chain, tidy)
    joint = equivalent_joint(batch)
    psi = initial_phases(batch)
    slope = sensitivity(batch)
    off = np.max([growth(one, tidy) for one in (chain, *poses)], axis=0)
    change = wrapped(tidy - as_built)
    posed = [equivalent_joint(with_yokes(pose, tidy)).speed_fluctuation for pose in poses]
    each = np.stack(posed, axis=-1) if posed else np.zeros((len(labels), 0))
    return tuple(
        YokeSetting(
            label=label,
            yoke_angle=tidy[s],
            speed_fluctuation=float(joint.speed_fluctuation[s]),
            shaft_speed_fluctuation=joint.shaft_speed_fluctuation[s],
            initial_phase=psi[s],
            sensitivity=slope[s],
            one_off=off[s],
            vertex=joint.vertex[s],
            change=change[s],
            pose_speed_fluctuation=each[s],
        )
        for s, label in enumerate(labels)
    )


# What to choose among yoke settings that leave the same speed fluctuation.


@dataclass(frozen=True, eq=False, kw_only=True)
class Choice:
    """What a goal may look at."""

    chain: Chain  # the drive
    as_built: Array  # (n-1,) [rad]: present yoke angles
    weight: Array  # (n-1,): weights of shafts 2 … n


@dataclass(frozen=True, kw_only=True)
class LeastIntermediate:
    """Least speed fluctuation of the intermediate shafts, Σ w δ over shafts 2 … n.

    Parameters
    ----------
    weights : tuple of float, optional
        Weights of shafts 2 … n; those of the drive's shafts by default.
    """

    blurs: ClassVar[tuple[float, ...]] = (1e-3, 1e-5, 1e-7)
    weights: tuple[float, ...] | None = None

    def cost(self, choice: Choice, yoke_angle: Array, *, blur: float = 0.0) -> Array:
        """Return the weighted sum for sets of yoke angles (..., n-1), array (...).

        ``blur`` rounds the corners that δ has where it vanishes.
        """
        xp = namespace(yoke_angle)
        uneven = equivalent_joint(with_yokes(choice.chain, yoke_angle)).shaft_speed_fluctuation[..., :-1]
        weight = choice.weight if self.weights is None else xp.asarray(self.weights, dtype=xp.float64)
        return xp.sum(weight * xp.sqrt(uneven * uneven + blur * blur), axis=-1)


@dataclass(frozen=True, kw_only=True)
class NearestYokes:
    """Smallest change of the present yoke angles, Σ w (turn)² [rad²] over shafts 2 … n.

    Parameters
    ----------
    weights : tuple of float, optional
        Weights of shafts 2 … n; equal by default.
    """

    blurs: ClassVar[tuple[float, ...]] = (0.0,)
    weights: tuple[float, ...] | None = None

    def cost(self, choice: Choice, yoke_angle: Array, *, blur: float = 0.0) -> Array:
        """Return the weighted sum of squares for sets of yoke angles (..., n-1), array (...)."""
        xp = namespace(yoke_angle)
        turn = wrapped(yoke_angle - choice.as_built)
        square = turn * turn
        return xp.sum(square if self.weights is None else square * xp.asarray(self.weights, dtype=xp.float64), axis=-1)


Goal = LeastIntermediate | NearestYokes
"""What has a method ``cost(choice, yoke_angle, *, blur)``, and the blurs with which a search follows it in turn."""

SYNCHRONOUS = LeastIntermediate()
NEAREST = NearestYokes()
