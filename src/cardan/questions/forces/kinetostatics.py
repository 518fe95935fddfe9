"""Torque and couples of every shaft and cross while a drive turns: exact, backwards from the load, as arrays.

A cross passes on a couple along its own normal and nothing else, but for what turns the cross itself and what rubs in
its bearings. So the couple at the load gives that of every shaft before it, one joint at a time. What rubs in a joint
of another kind adds to its couple what its inner mechanism says, `InnerFriction`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.joints import Joint
from cardan.drive.models.dynamics_model import Train
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.paths import Jet
from cardan.maths.kernel import frames
from cardan.questions.motion.joint_mechanism import FEW, STRAIGHT, check_turning, rubbed_pins, rubbed_push, rubbed_share
from cardan.questions.motion.motion import Motion, motion
from cardan.questions.motion.moving_chain import Spins, moving_axes, seen

from .turn_loads import lean

STILL = 1e-12
"""Share of the speed of the shafts below which the rate of a cross against its yoke is rounding."""


@dataclass(frozen=True, eq=False, kw_only=True)
class KinematicState:
    """How shafts and crosses stand and turn; the leading axes are those of the drives, then that of the positions."""

    axis: Array  # (..., p or 1, n+1, 3): directions e_i of the shafts
    # axis_rate, axis_acceleration (p, n+1, 3) [1/s, 1/s²]: ė_i and ë_i; None where the axes stand still
    axis_rate: Array | None
    axis_acceleration: Array | None  # (p, n+1, 3) [1/s²]
    speed: Array  # speed, acceleration (..., p, n+1) [rad/s, rad/s²]: ω_i, ε_i about the axes
    acceleration: Array  # (..., p, n+1) [rad/s²]
    # driving_arm, driven_arm (..., p, n, 3): u_i, v_{i+1}: arms of the crosses in the driving and the driven yoke, or
    # marks of joints without a cross
    driving_arm: Array
    driven_arm: Array  # (..., p, n, 3)
    # (..., p, n, 3): directions of the couples that the joints pass on; None where all are normals u×v of crosses
    way: Array | None = None
    # (p, n, 3) [m]: from each joint centre to the driven pin, where its driven shaft begins, along u×v; None where no
    # joint has its pins apart
    head: Array | None = None
    head_acceleration: Array | None = None  # (p, n, 3) [m/s²]
    ahead: Array | None = None  # (n) [m]: how far along its shaft it lies in the mean; lengths count from the centre
    rest: Array | None = None  # (n+1, 3): directions of the shafts as drawn, where some wobble
    # where shafts wobble: shift (p, n, 3) [m], way of each joint centre from its place as drawn; rates [m/s] of what
    # lies between them and the driven pins (p, n, 3), and of the points (p, n+2, 3)
    shift: Array | None = None
    head_rate: Array | None = None
    point_rate: Array | None = None

    def couple_way(self, i: int) -> Array:
        """Direction of the couple that joint i passes on, array (..., p, 3)."""
        if self.way is not None:
            return self.way[..., i, :]
        return frames.cross(self.driving_arm[..., i, :], self.driven_arm[..., i, :])

    def levered(self, i: int, force: Array) -> tuple[Array, Array]:
        """Couples that go with a force (..., 3) on driven shaft i+1: on it, and of the driving one on the cross.

        A force along either pin acts in the axis of the other one: (F·v) a u and (F·u) a v, a the distance of the pins.
        """
        u, v = self.driving_arm[..., i, :], self.driven_arm[..., i, :]
        apart = 0.0 if self.head is None else frames.dot(self.head[..., i, :], frames.cross(u, v))
        along = frames.dot(force, v), frames.dot(force, u)
        return (apart * along[0])[..., None] * u, (apart * along[1])[..., None] * v

    def turning(self, i: int) -> Array:
        """Angular velocity Ω_i of shaft i, array (..., p, 3) [rad/s]."""
        about = self.speed[..., i, None] * self.axis[..., i, :]
        if self.axis_rate is None:
            return about
        return about + frames.cross(self.axis[..., i, :], self.axis_rate[..., i, :])

    def turning_rate(self, i: int) -> Array:
        """Its time derivative, array (..., p, 3) [rad/s²]."""
        about = self.acceleration[..., i, None] * self.axis[..., i, :]
        if self.axis_rate is None or self.axis_acceleration is None:
            return about
        swept = self.speed[..., i, None] * self.axis_rate[..., i, :]
        return about + swept + frames.cross(self.axis[..., i, :], self.axis_acceleration[..., i, :])


@dataclass(frozen=True, eq=False, kw_only=True)
class Couples:
    """Torques and couples; the leading axes are those of the drives, then that of the positions."""

    # (..., p, n+1) [N·m]: τ_i, torque that must enter each shaft; the first one is the torque at the input
    shaft_torque: Array
    joint_torque: Array  # (..., p, n) [N·m]: T_i, part of the couple along the normal of each cross, on the driven yoke
    # (..., p, n) [N·m]: the same part on the side of the driving yoke; the two differ by what turns the cross
    driving_torque: Array
    # driving, driven (..., p, n, 3) [N·m]: K_i⁻, couple of the driving yoke on the cross, and K_i⁺, of the cross on the
    # driven yoke
    driving: Array
    driven: Array  # (..., p, n, 3) [N·m]
    # (..., p, n+1, 3) [N·m]: S_i, couple across each shaft that its supports and the joint forces have to balance
    secondary: Array
    loss: Array  # (..., p, n) [W]: power lost in the journals of each joint
    # (..., p) [W]: what the power balance leaves; where shafts wobble without what their masses take, see `pulled`
    power: Array
    flow: Array  # (..., p) [W]: largest power in that balance, to judge what is left by
    # of each joint (..., p, 3) [N]: force that friction within it or its stiffness puts on its driven shaft, or None
    pushed: tuple[Array | None, ...]


def standing(
    chain: Chain, axis: Array, normal: Array, angle: Array, *, speed: ArrayLike, acceleration: ArrayLike = 0.0
) -> KinematicState:
    """Return how drives whose axes stand still turn.

    chain (...): yoke angles and start phase; axis (..., n+1, 3): directions of the shafts.
    normal (..., n, 3): normals N_i of the joints' planes; the first one fixes the zero of φ_1.
    angle (p,) [rad]: φ_1 from the start position; speed, acceleration (...) [rad/s, rad/s²]: ω_1, ε_1.
    The exact step u_1 = rot(e_1, φ_1+ψ_1) (N_1×e_1), v_{i+1} = unit(e_{i+1}×u_i), u_i = rot(e_i, -γ_i) v_i; joints of
    other kinds turn by their laws.
    """
    if chain.laws is not None:
        return standing_kinds(chain, axis, normal, angle, speed=speed, acceleration=acceleration)
    xp = namespace(axis, angle)
    first = frames.cross(normal[..., 0, :], axis[..., 0, :])[..., None, :]
    along = axis[..., None, 0, :]
    phi = angle + xp.asarray(chain.start_phase)[..., None]
    c, s = xp.cos(phi)[..., None], xp.sin(phi)[..., None]
    arm = c * first + s * frames.cross(along, first)
    still = axis[..., None, :, :]
    none = xp.zeros_like(still)
    spins = moving_axes(
        (still, none, none),
        arm,
        yoke_angle=xp.asarray(chain.yoke_angle)[..., None, :],
        speed=real(speed, xp)[..., None],
        acceleration=real(acceleration, xp)[..., None],
    )
    return _stand(still, None, None, spins)


def standing_kinds(
    chain: Chain, axis: Array, normal: Array, angle: Array, *, speed: ArrayLike, acceleration: ArrayLike
) -> KinematicState:
    """Return how drives with joints of any kinds turn, their axes at rest; see `standing`."""
    xp = namespace(axis, angle)
    omega, gain = real(speed, xp)[..., None, None], real(acceleration, xp)[..., None, None]
    found = motion(chain, angle)
    ratio, slope = (xp.moveaxis(part, -2, -1) for part in (found.shaft_ratio, found.shaft_slope))
    driving, driven, way = kind_arms(chain, axis, normal, found)
    return KinematicState(
        axis=axis[..., None, :, :],
        axis_rate=None,
        axis_acceleration=None,
        speed=omega * ratio,
        acceleration=gain * ratio + omega * omega * slope,
        driving_arm=driving,
        driven_arm=driven,
        way=way,
    )


def _stand(axis: Array, rate: Array | None, curve: Array | None, spins: Spins, **apart: Array | None) -> KinematicState:
    return KinematicState(
        axis=axis,
        axis_rate=rate,
        axis_acceleration=curve,
        speed=spins.spin,
        acceleration=spins.spin_acceleration,
        driving_arm=spins.driving_arm,
        driven_arm=spins.driven_arm,
        way=spins.way,
        **apart,
    )


def swinging(axes: tuple[Array, Array, Array], spins: Spins, **apart: Array | None) -> KinematicState:
    """Return how a drive whose axes move turns, from the jet of its axes (p, n+1, 3) and its spins.

    apart: what `KinematicState` says of pins that stand apart.
    """
    return _stand(*axes, spins, **apart)


def couples(train: Train, stand: KinematicState, load: Array, force: Array | None = None) -> Couples:
    """Return torques and couples of all shafts, backwards from the load.

    train (...): masses and friction; stand (..., p): how shafts and crosses stand and turn.
    load (..., p) [N·m]: torque that resists the output shaft, positive when it resists positive turning.
    force (..., p, n, 3) [N]: of the joints on their driven shafts, which turn these where pins stand apart.
    With h = Ḣ of the cross: T⁺ = [τ_{i+1} + (h·u)(u·e_{i+1})]/(n·e_{i+1}), K⁺ = T⁺ n - (h·u) u, K⁻ = K⁺ + h,
    τ_i = K⁻·e_i + L_i + J_i ε_i. Friction of the journals adds -κ|T| sgn(p) u + κ|T| sgn(q) v to both couples, p and q
    the rates of the cross against the driving and of the driven yoke against the cross; where one of them changes its
    sense, the sense right after. Book (103), (113) are cases. Other joints that rub: `inner_friction`.
    """
    xp = namespace(stand.speed, load)
    n = train.joints
    e, w = stand.axis, stand.speed
    zero = xp.zeros_like(w[..., 0])
    tau = load + _own(train, stand, n) + zero
    work = tau * w[..., n]
    flow = xp.abs(load * w[..., n])
    rows: list[list[Array]] = [[], [], [], [], []]
    torque, pushed, driving, driven, losses = rows
    entering = [tau]
    forces: list[Array | None] = []
    for i in reversed(range(n)):
        u, v = stand.driving_arm[..., i, :], stand.driven_arm[..., i, :]
        normal = stand.couple_way(i)
        lean = frames.dot(u, e[..., i + 1, :])
        into = frames.dot(normal, e[..., i + 1, :])
        swing = _cross_swing(train, stand, i, (u, v, normal))
        inside = inner_friction(train, stand, i)
        top = tau if swing is None else tau + swing.rate[0] * lean
        ahead_of, behind_of = _lever_torques(stand, i, force)
        top = top - behind_of
        if train.drag is not None:
            (p, q), (ahead, behind) = _journal_rates(stand, i, u, v, lean)
            kappa = train.drag[..., None, i]
            t = top / (into - kappa * xp.sign(top) * ahead * lean)
            rubs = kappa * xp.abs(t)
            lost = rubs * (xp.abs(p) + xp.abs(q))
            along_u, along_v = -rubs * ahead, rubs * behind
            out = t[..., None] * normal + along_u[..., None] * u + along_v[..., None] * v
        else:
            t = top / into
            lost = zero
            out = t[..., None] * normal
        if inside is not None:
            power = tau * w[..., i + 1]
            added = tau[..., None] * inside.of(power, inside.couple)
            out = out + added
            t = t + frames.dot(added, normal)
            lost = lost + frames.dot(added, stand.turning(i) - stand.turning(i + 1))
        forces.insert(0, None if inside is None else tau[..., None] * inside.of(power, inside.force))
        spring = sprung(train, stand, i)
        if spring is not None:
            out, forces[0] = out + spring[0], spring[1]
            work = work + frames.dot(spring[0], stand.turning(i) - stand.turning(i + 1))
        back, given = t, out
        if swing is not None:
            hu, hv, hn = swing.rate
            back = t + hn
            given = out + hn[..., None] * normal + hv[..., None] * v
            out = out - hu[..., None] * u
            work = work + sum(h * turn for h, turn in zip(swing.rate, swing.turning, strict=True))
        own = _own(train, stand, i)
        tau = frames.dot(given, e[..., i, :]) + ahead_of + own
        work = work + own * w[..., i] + lost
        flow = xp.maximum(flow, xp.abs(tau * w[..., i]))
        for row, value in zip(
            (torque, pushed, driving, driven, losses, entering), (t, back, given, out, lost, tau), strict=True
        ):
            row.insert(0, value)
    secondary = _secondary(train, stand, driving, driven)
    if stand.axis_rate is not None:
        for i in range(n + 1):
            across = frames.cross(e[..., i, :], stand.axis_rate[..., i, :])
            needed = swing_need(train, stand, i)
            work = work + frames.dot((secondary[i] if stand.head is None else 0.0) + needed, across)
    return Couples(
        shaft_torque=xp.stack(entering, axis=-1),
        joint_torque=xp.stack(torque, axis=-1),
        driving_torque=xp.stack(pushed, axis=-1),
        driving=xp.stack(driving, axis=-2),
        driven=xp.stack(driven, axis=-2),
        secondary=xp.stack(secondary, axis=-2),
        loss=xp.stack(losses, axis=-1),
        power=tau * w[..., 0] - work,
        flow=flow,
        pushed=tuple(forces),
    )


def resisted(train: Train, stand: KinematicState, drive: Array, force: Array | None = None) -> Array:
    """Return the torque at the output that a torque at the input holds, array (..., p) [N·m].

    train (...): masses and friction, no joint locked; stand (..., p): how shafts and crosses stand and turn.
    drive (..., p) [N·m]: torque that drives the input shaft; force: as of `couples`.
    The equations of `couples` from their other end: friction leaves the couple of each cross the sign of the torque
    that its driving shaft passes on.
    """
    xp = namespace(stand.speed, drive)
    e = stand.axis
    tau = drive + 0.0 * stand.speed[..., 0]
    for i in range(train.joints):
        u, v = stand.driving_arm[..., i, :], stand.driven_arm[..., i, :]
        normal = stand.couple_way(i)
        lean, back = frames.dot(u, e[..., i + 1, :]), frames.dot(v, e[..., i, :])
        out, into = frames.dot(normal, e[..., i, :]), frames.dot(normal, e[..., i + 1, :])
        swing = _cross_swing(train, stand, i, (u, v, normal))
        ahead_of, behind_of = _lever_torques(stand, i, force)
        left = tau - _own(train, stand, i) - ahead_of
        if swing is not None:
            left = left - swing.rate[2] * out - swing.rate[1] * back
        if train.drag is not None:
            ahead, behind = _journal_rates(stand, i, u, v, lean)[1]
            kappa = train.drag[..., None, i]
            t = left / (out + kappa * xp.sign(left) * behind * back)
            tau = t * into - kappa * xp.abs(t) * ahead * lean
        else:
            tau = left / out * into
        inside = inner_friction(train, stand, i)
        if inside is not None:
            rubs = inside.of(left * stand.speed[..., i], frames.dot(inside.couple, e[..., i, :]))
            tau = (left + behind_of * out / into) / (out / into + rubs) - behind_of
        if swing is not None:
            tau = tau - swing.rate[0] * lean
        tau = tau + behind_of
    return tau - _own(train, stand, train.joints)


def _lever_torques(stand: KinematicState, i: int, force: Array | None) -> tuple[Array | float, Array | float]:
    """Return the torques (..., p) [N·m] that the force of joint i takes from its driving and gives its driven shaft."""
    if stand.head is None or force is None:
        return 0.0, 0.0
    on_driven, on_cross = stand.levered(i, force[..., i, :])
    e = stand.axis
    return frames.dot(on_cross, e[..., i, :]), frames.dot(on_driven, e[..., i + 1, :])


@dataclass(frozen=True, eq=False, kw_only=True)
class InnerFriction:
    """What friction within a joint without a single cross adds to its couple and force on the driven shaft.

    For a torque of 1 N·m on this; first axis: while power flows forwards, and while it flows backwards.
    """

    couple: Array  # (2, ..., p, 3)
    force: Array  # (2, ..., p, 3) [1/m]

    @staticmethod
    def of(power: Array, both: Array) -> Array:
        """Return rows (...) or (..., 3) of both flows (2, ...) by the sense of a power (...)."""
        ahead = power >= 0.0
        found: Array = np.where(ahead[..., None] if both.ndim > ahead.ndim + 1 else ahead, both[0], both[1])
        return found


def seen_by(train: Train, stand: KinematicState, i: int) -> tuple[Array, Array, Array, Array, Array]:
    """Return N, N × e, θ and α as joint i sees its driving mark, see `seen`, and the direction e of its shaft."""
    before, after = stand.axis[..., i, :], stand.axis[..., i + 1, :]
    plane = None if train.normal is None else train.normal[..., None, i, :]
    return (*seen(stand.driving_arm[..., i, :], before, after, plane), before)


def inner_friction(train: Train, stand: KinematicState, i: int, *, many: bool = False) -> InnerFriction | None:
    """Return what friction within joint i adds; None where it does not rub or is a single cross.

    many: whether it is asked again at many other joint angles, see `rubbed_share`.
    Its inner mechanism tells the share s of the power of the driving shaft that it rubs away, and what it adds about
    the normal N of the plane of the shafts, `rubbed_share` and `rubbed_push`. The couple about the driven shaft is
    given, so with K·e = (K_0·e)/(1 ∓ s) the rest of it is along N × e'.
    """
    if not train.kinds or not train.kinds[i].rubs:
        return None
    if stand.head is not None and train.kinds[i].ball is not None:
        return _pin_friction(train.kinds[i], stand, i)
    after = stand.axis[..., i + 1, :]
    normal, aside, theta, alpha, before = seen_by(train, stand, i)
    many = many or np.unique(np.round(alpha, 9)).size > FEW
    shares = rubbed_share(train.kinds[i], alpha, theta, many=many)
    check_turning(f"joints[{i}].friction", train.kinds[i], alpha, theta, shares[0])
    push = rubbed_push(train.kinds[i], alpha, theta, many=many)
    way = stand.couple_way(i)
    step = frames.dot(way, before) / frames.dot(way, after)
    bent = np.where(alpha > STRAIGHT, np.sin(alpha), np.inf)
    more = np.stack([shares[0] / (1.0 - shares[0]), -shares[1] / (1.0 + shares[1])])
    across = -step * more / bent
    return InnerFriction(
        couple=across[..., None] * frames.cross(normal, after) + push[:, 0][..., None] * normal,
        force=sum(push[:, 1 + k][..., None] * axis for k, axis in enumerate((before, aside, normal))),
    )


def _pin_friction(kind: Joint, stand: KinematicState, i: int) -> InnerFriction:
    """Return the couples of friction about both pins, which stand apart; the normal makes up for the torque."""
    assert stand.rest is not None
    u, v, after = stand.driving_arm[..., i, :], stand.driven_arm[..., i, :], stand.axis[..., i + 1, :]
    _normal, _aside, theta, alpha = seen(u, stand.rest[i] + 0.0 * u, stand.rest[i + 1] + 0.0 * u)
    about = rubbed_pins(kind, alpha, theta)
    way = stand.couple_way(i)
    level = u - (frames.dot(u, after) / frames.dot(way, after))[..., None] * way
    couple = about[:, 0][..., None] * level + about[:, 1][..., None] * v
    return InnerFriction(couple=couple, force=0.0 * couple)


def sprung(train: Train, stand: KinematicState, i: int) -> tuple[Array, Array | None] | None:
    """Return couple and force of the stiffness of joint i on its driven shaft, (..., p, 3) [N·m, N]; None without any.

    The couple -c α N works on no turn of the shafts, only on their bending.
    """
    kind = train.kinds[i] if train.kinds else None
    if kind is None or not (kind.bend_spring or kind.sprung(np.zeros(1)) is not None):
        return None
    normal, aside, _theta, alpha, before = seen_by(train, stand, i)
    none, force = 0.0 * stand.speed[..., i, None], kind.sprung(alpha)
    couple = none - kind.bend_spring * alpha[..., None] * normal
    if force is None:
        return couple, None
    return couple, none + sum(force[..., k, None] * axis for k, axis in enumerate((before, aside, normal)))


def _own(train: Train, stand: KinematicState, i: int) -> Array:
    """Return what resists shaft i besides the next one, torque and inertia, array (..., p) [N·m]."""
    rest = 0.0 * stand.speed[..., i]
    if train.resisting_torque is not None:
        rest = rest + train.resisting_torque[..., None, i]
    if train.inertia is not None:
        rest = rest + train.inertia[..., None, i] * stand.acceleration[..., i]
    return rest


@dataclass(frozen=True, eq=False)
class _CrossSwing:
    """Angular velocity of a cross and the rate of its angular momentum, along u, v and n, each (..., p)."""

    turning: tuple[Array, Array, Array]
    rate: tuple[Array, Array, Array]


def _cross_swing(train: Train, stand: KinematicState, i: int, arms: tuple[Array, Array, Array]) -> _CrossSwing | None:
    """Return how cross i turns and what that takes; None where its inertia does not count.

    Ω_c = Ω_i + p u with p = (Ω_{i+1} - Ω_i)·u; Ω̇_c = Ω̇_i + ṗ u + p Ω_i×u. u, v and n are principal axes that turn
    with the cross, so Euler's equations give Ḣ.
    """
    if train.cross_inertia is None:
        return None
    inertia = train.cross_inertia[..., None, i, :]
    u, v, normal = arms
    one, two = stand.turning(i), stand.turning(i + 1)
    gain_one = stand.turning_rate(i)
    a, b, c = (frames.dot(one, arm) for arm in arms)
    # Ω_i×u = c' v - b' n in the frame of the cross, with b' and c' the parts of Ω_i along v and n.
    p = frames.dot(two, u) - a
    gain = frames.dot(stand.turning_rate(i + 1), u) + c * frames.dot(two - one, v) - b * frames.dot(two - one, normal)
    turning = a + p, b, c
    rates = gain, frames.dot(gain_one, v) + p * c, frames.dot(gain_one, normal) - p * b
    rate = []
    for k in range(3):
        j, m = (k + 1) % 3, (k + 2) % 3
        rate.append(inertia[..., k] * rates[k] + (inertia[..., m] - inertia[..., j]) * turning[j] * turning[m])
    return _CrossSwing(turning, (rate[0], rate[1], rate[2]))


def _journal_rates(
    stand: KinematicState, i: int, u: Array, v: Array, lean: Array
) -> tuple[tuple[Array, Array], list[Array]]:
    """Return the rates p, q [rad/s] of cross i against its driving yoke about u and against the driven one about v.

    Also the senses of both, ±1: where one stands still for an instant, the sense right after, with the axes at rest
    that of ṗ = ω_i ω_{i+1} (e_i×u)·e_{i+1} or q̇ = ω_i ω_{i+1} e_i·(e_{i+1}×v); 0 in a straight joint.
    """
    xp = namespace(stand.speed)
    before, after = stand.axis[..., i, :], stand.axis[..., i + 1, :]
    if stand.axis_rate is None:
        rates = stand.speed[..., i + 1] * lean, stand.speed[..., i] * frames.dot(before, v)
    else:
        one, two = stand.turning(i), stand.turning(i + 1)
        rates = frames.dot(two - one, u), frames.dot(one - two, v)
    least = STILL * xp.maximum(xp.abs(stand.speed[..., i]), xp.abs(stand.speed[..., i + 1]))
    growth = frames.dot(frames.cross(before, u), after), frames.dot(before, frames.cross(after, v))
    later = (xp.where(xp.abs(more) > STILL, xp.sign(more), 0.0 * more) for more in growth)
    return rates, [xp.where(xp.abs(rate) > least, xp.sign(rate), then) for rate, then in zip(rates, later, strict=True)]


def swing_need(train: Train, stand: KinematicState, i: int) -> Array | float:
    """Return the couple that swings the axis of shaft i, J ω ė + I_t e×ë, array (p, 3) [N·m]; 0 where it rests."""
    if stand.axis_rate is None or stand.axis_acceleration is None:
        return 0.0

    def own(table: Array | None) -> Array | None:
        return None if table is None else table[..., None, i]

    jet = stand.axis[..., i, :], stand.axis_rate[..., i, :], stand.axis_acceleration[..., i, :]
    return -gyroscopic_couple(jet, stand.speed[..., i], own(train.inertia), own(train.transverse_inertia)).whole


def _secondary(train: Train, stand: KinematicState, driving: list[Array], driven: list[Array]) -> list[Array]:
    """Return S_i of every shaft: what the couples at its ends, and its swinging, leave across its axis."""
    found = []
    for i in range(train.joints + 1):
        e = stand.axis[..., i, :]
        whole = driven[i - 1] if i else -driving[0]
        if 0 < i < train.joints:
            whole = whole - driving[i]
        across = whole - frames.dot(whole, e)[..., None] * e
        found.append(across - swing_need(train, stand, i))
    return found


# How joints of any kinds stand while a drive turns, and which way the couples point that they pass on.


def kind_arms(chain: Chain, axis: Array, normal: Array, found: Motion) -> tuple[Array, Array, Array]:
    """Return arms or marks of the joints of a chain of mixed kinds, and the directions of their couples.

    chain (..., n): with its laws.
    axis, normal (..., n+1, 3), (..., n, 3): directions of the shafts, and normals of the joints' planes.
    found (..., p).
    Returns driving, driven, way (..., p, n, 3): unit vectors.
    The couple of a joint without a cross is along (1, (1 - i cos α)/sin α, -f_α) in (e, N×e, N), see
    `cardan.questions.forces.turn_loads.across`: the bisector of e and e' where the joint is even.
    """
    laws = chain.laws
    assert laws is not None
    theta, ratio = (np.moveaxis(np.asarray(part), -2, -1) for part in (found.yoke_rotation, found.shaft_ratio))
    steps = ratio[..., 1:] / ratio[..., :-1]
    before, after, plane = axis[..., None, :-1, :], axis[..., None, 1:, :], normal[..., None, :, :]
    across, beyond = frames.cross(plane, before), frames.cross(plane, after)
    sine, cosine = np.sin(theta)[..., None], np.cos(theta)[..., None]
    driving = cosine * across + sine * plane
    steep, growth, joint_angle = (
        np.asarray(part)[..., None, :] for part in (laws.steepness, laws.growth, laws.joint_angle)
    )
    turned = np.arctan2(steep * np.sin(theta), np.cos(theta))[..., None]
    marked = np.cos(turned) * beyond + np.sin(turned) * plane
    driven = np.where(np.asarray(laws.own)[:, None], marked, frames.unit(frames.cross(after, driving)))
    aside, swept = lean(theta, steps, joint_angle, steep, growth)
    way = frames.unit(before + aside[..., None] * across - swept[..., None] * plane)
    return driving, driven, np.where(np.asarray(laws.own)[:, None], way, frames.cross(driving, driven))


# What it takes to swing the axis of a turning shaft: gyroscopic couple and couple of transverse inertia.


@dataclass(frozen=True, eq=False, kw_only=True)
class GyroscopicCouple:
    """Couples that the shaft puts on what holds it while its axis swings, both across the axis."""

    gyroscopic: Array  # (..., 3) [N·m]: -J ω ė, Book (125)
    transverse: Array  # (..., 3) [N·m]: -I_t e×ë

    @property
    def whole(self) -> Array:
        """Both together, array (..., 3) [N·m]."""
        return self.gyroscopic + self.transverse


def gyroscopic_couple(
    axis: Jet, speed: ArrayLike, inertia: ArrayLike | None, transverse_inertia: ArrayLike | None
) -> GyroscopicCouple:
    """Return the couples of a turning shaft whose axis swings, by H = J ω e + I_t e×ė.

    axis (..., 3): e and its rates [1/s, 1/s²]; speed (...) [rad/s]: ω, part of the angular velocity along e.
    inertia, transverse_inertia (...) [kg m²]: J about the axis and I_t across, about the centre of mass; None for none.
    Book (125) keeps the first couple only; for a swinging axis the second is often larger.

    >>> import numpy as np
    >>> x, y, z = np.eye(3)
    >>> found = gyroscopic_couple((x, 0.9 * y, 12.0 * y), 120.0, 0.02, 0.4)
    >>> found.gyroscopic, found.transverse
    (array([ 0.  , -2.16,  0.  ]), array([ 0. ,  0. , -4.8]))
    """
    e, rate, curve = axis
    xp = namespace(e)
    zero = 0.0 * e
    spin = real(speed, xp)
    gyroscopic = zero if inertia is None else -(real(inertia, xp) * spin)[..., None] * rate
    across = zero if transverse_inertia is None else -real(transverse_inertia, xp)[..., None] * frames.cross(e, curve)
    return GyroscopicCouple(gyroscopic=gyroscopic + zero, transverse=across + zero)


def parallel_ends(
    joint_angle: Jet, angle: ArrayLike, *, speed: ArrayLike, yoke_angle: float = 0.0
) -> tuple[Jet, Spins]:
    """Return axes and spins of a double joint in a plane whose end shafts stay parallel while its joint angles swing.

    joint_angle (...) [rad, rad/s, rad/s²]: α of joint 1; joint 2 bends back by as much.
    angle (...) [rad]: φ_1 from the plane of the joints; speed (...) [rad/s]: ω_1; yoke_angle [rad]: γ_2.
    Returns axes (..., 3, 3): directions of the three shafts.
    """
    xp = namespace(joint_angle[0])
    alpha, rate, curve = (real(part, xp) for part in joint_angle)
    none = 0.0 * alpha
    c, s = xp.cos(alpha), xp.sin(alpha)
    x = xp.stack((none + 1.0, none, none), axis=-1)
    e = xp.stack((c, s, none), axis=-1)
    aside = xp.stack((-s, c, none), axis=-1)
    swung = rate[..., None] * aside
    bent = curve[..., None] * aside - (rate**2)[..., None] * e
    axes = tuple(xp.stack((end, middle, end), axis=-2) for end, middle in ((x, e), (0.0 * x, swung), (0.0 * x, bent)))
    phi = real(angle, xp)
    arm = xp.stack((0.0 * phi, xp.cos(phi), xp.sin(phi)), axis=-1)
    jet: Jet = (axes[0], axes[1], axes[2])
    return jet, moving_axes(jet, arm, yoke_angle=[yoke_angle], speed=speed)
