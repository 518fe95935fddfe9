"""Which torque passes each joint and shaft, friction in the journals counted? Pure arrays, in batches."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.formulas.friction import swings
from cardan.maths.arrays import Array, ArrayLike, namespace
from cardan.questions.motion.motion import Motion


@dataclass(frozen=True, eq=False, kw_only=True)
class TorqueFlow:
    """Torques and powers of a drive over some positions; leading axes are those of the cases."""

    entering: Array  # (..., n+1, p) [N·m]: τ_i, torque that enters each shaft at its beginning
    # (..., n+1, p) [N·m]: torque that leaves it at its end; that of the output shaft is what the load gets
    leaving: Array
    couple: Array  # (..., n, p) [N·m]: T_i, couple of each cross about its own normal
    # driving_loss, driven_loss (..., n, p): power rubbed away in the journals of the driving and of the driven yoke,
    # per input speed [N·m]
    driving_loss: Array
    driven_loss: Array  # (..., n, p)


def torque_flow(
    moved: Motion,
    drag: Array,
    torque: Array,
    *,
    drawn: Array | None = None,
    sense: ArrayLike = 1.0,
    torque_at: str = "output",
) -> TorqueFlow:
    """Return the torque that passes each joint and shaft, friction of the journals acting on itself.

    moved: motion of the drive at positions (p,), of one drive (n, p) or of many (..., n, p).
    drag (..., n): κ_i = μ d_c/d of each joint, κ tan α < 1.
    torque (..., p) [N·m]: torque of the load at the output, positive when it resists positive turning, or driving
    torque at the input.
    drawn (..., n+1, p) [N·m]: what each shaft takes for itself: inertia, resisting torques, friction of its bearings.
    sense (...): 1 or -1: sign of the input speed; torque_at: where ``torque`` is given, ``output`` or ``input``.

    The cross gives its driven yoke the couple K = T n - κ|T| sgn(p) u + κ|T| sgn(q̇) v, whose parts about
    the two shafts are T cos θ_1 (1 ± κ tan θ_1) and T cos θ_2 (1 ∓ κ tan θ_2), upper signs where power flows
    forwards; from the end where the torque is given to the other, joint by joint.
    """
    xp = namespace(moved.joint_angle, drag, torque)
    lean_driving, lean_driven = swings(
        xp.sin(moved.yoke_rotation), xp.cos(moved.yoke_rotation), moved.joint_angle[..., None]
    )
    cos_driving, cos_driven = (1.0 / xp.sqrt(1.0 + lean * lean) for lean in (lean_driving, lean_driven))
    driving, driven = drag[..., None] * lean_driving, drag[..., None] * lean_driven
    way = sense if isinstance(sense, float | int) else xp.asarray(sense)[..., None]
    own = xp.zeros_like(moved.shaft_ratio) if drawn is None else drawn
    n = moved.yoke_rotation.shape[-2]
    entering, leaving, couples = [], [], []
    if torque_at == "output":
        leaving.append(torque)
        for i in range(n, -1, -1):
            entering.append(leaving[-1] + own[..., i, :])
            if i:
                flow = way * xp.sign(entering[-1])
                couple = entering[-1] / (cos_driven[..., i - 1, :] * (1.0 - flow * driven[..., i - 1, :]))
                couples.append(couple)
                leaving.append(couple * cos_driving[..., i - 1, :] * (1.0 + flow * driving[..., i - 1, :]))
        entering, leaving, couples = entering[::-1], leaving[::-1], couples[::-1]
    else:
        entering.append(torque)
        for i in range(n + 1):
            leaving.append(entering[-1] - own[..., i, :])
            if i < n:
                flow = way * xp.sign(leaving[-1])
                couple = leaving[-1] / (cos_driving[..., i, :] * (1.0 + flow * driving[..., i, :]))
                couples.append(couple)
                entering.append(couple * cos_driven[..., i, :] * (1.0 - flow * driven[..., i, :]))
    cross = _stacked(couples, xp)
    load = xp.abs(cross)
    return TorqueFlow(
        entering=_stacked(entering, xp),
        leaving=_stacked(leaving, xp),
        couple=cross,
        driving_loss=load * cos_driven * driven * moved.shaft_ratio[..., 1:, :],
        driven_loss=load * cos_driving * driving * moved.shaft_ratio[..., :-1, :],
    )


def _stacked(rows: list[Array], xp: object) -> Array:
    return xp.stack(xp.broadcast_arrays(*rows), axis=-2)  # type: ignore[attr-defined]
