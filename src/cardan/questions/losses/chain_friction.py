"""What does friction in the journals of a whole chain take? Exact over a turn, joint by joint, in batches."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, crosses
from cardan.drive.models.kinematics_model import Chain
from cardan.errors import refuse
from cardan.formulas.friction import joint_friction, swings
from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.cycle_statistics import mean_between
from cardan.texts import _


@dataclass(frozen=True, eq=False, kw_only=True)
class ChainFriction:
    """What the journals take over a turn at constant torque; leading axes are those of the drives."""

    efficiency: Array  # (...): useful work over work put in, over a turn; nan where the drive locks
    first_order: Array  # (...): product of the joints' own efficiencies, friction not acting on itself
    # driving_loss, driven_loss (..., n): mean power lost in the journals in the driving and in the driven yoke of each
    # joint, over the power of the constant torque at the mean speed
    driving_loss: Array
    driven_loss: Array  # (..., n)
    # (...): what the power balance misses, over the power of the constant torque: power in, out and lost are integrated
    # apart
    residual: Array
    locked: Array  # (..., n) of bool: joints that friction holds
    status: Array  # (...) of int: `cardan.formulas.friction.Turning`

    @property
    def joint_loss(self) -> Array:
        """Mean power lost in each joint over the power of the constant torque, array (..., n)."""
        return self.driving_loss + self.driven_loss


@dataclass(frozen=True, eq=False, kw_only=True)
class Stance:
    """How every joint stands and turns at some input angles."""

    # driving, driven (..., n, p): tan of the angle of the cross's normal from the driving and from the driven shaft,
    # not negative
    driving: Array
    driven: Array  # (..., n, p)
    ratio: Array  # (..., n+1, p): ω_i/ω_1


def stance(chain: Chain, angle: Array) -> Stance:
    """Return how the joints of drives stand at input angles of their own.

    chain (...): kinematics of the drives; angle (..., p) [rad]: input angles φ_1, other ones for each drive.
    A joint stretches the vector (cos θ, sin θ) to (√cos α cos θ, sin θ/√cos α), whose direction is θ' and whose squared
    length is the inverse speed ratio; between joints the vector turns by μ. The same product as that of Möbius pairs,
    in real numbers.
    """
    xp = namespace(chain.joint_angle, angle)
    alpha, mu = chain.joint_angle[..., None], chain.turn_before[..., None]
    x, y = xp.cos(angle), xp.sin(angle)
    leans, ratios = [], [1.0 / (x * x + y * y)]
    for i in range(chain.joints):
        cosine, sine = xp.cos(mu[..., i, :]), xp.sin(mu[..., i, :])
        x, y = cosine * x - sine * y, sine * x + cosine * y
        leans.append(swings(y, x, alpha[..., i, :]))
        root = xp.sqrt(xp.cos(alpha[..., i, :]))
        x, y = root * x, y / root
        ratios.append(1.0 / (x * x + y * y))
    driving, driven = (xp.stack([lean[side] for lean in leans], axis=-2) for side in (0, 1))
    return Stance(driving=driving, driven=driven, ratio=xp.stack(ratios, axis=-2))


def kinks(chain: Chain) -> Array:
    """Return the input angles at which a cross stops in a yoke and its friction turns about.

    chain (...): kinematics of the drives.
    Returns (..., 2n) [rad]: in (-π, π], each good modulo π: where some θ_i is a multiple of π/2.
    """
    xp = namespace(chain.joint_angle)
    mu = chain.turn_before
    found = []
    for i in range(chain.joints):
        for x0, y0 in ((1.0, 0.0), (0.0, 1.0)):
            x, y = x0 + 0.0 * mu[..., i], y0 + 0.0 * mu[..., i]
            for k in range(i, -1, -1):
                cosine, sine = xp.cos(mu[..., k]), xp.sin(mu[..., k])
                x, y = cosine * x + sine * y, cosine * y - sine * x
                if k:
                    root = xp.sqrt(xp.cos(chain.joint_angle[..., k - 1]))
                    x, y = x / root, root * y
            found.append(xp.atan2(y, x))
    return xp.stack(found, axis=-1)


def chain_friction(
    drive: Drive | Drives | Chain, drag: ArrayLike, *, torque_at: str = "output", backwards: bool = False
) -> ChainFriction:
    """Return what the journals of drives take over a turn, exactly, friction acting on itself.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.
    drag : array (..., n)
        κ_i = μ d_c/d of each joint; broadcasts with the drives.
    torque_at : str
        Where the torque is constant, ``output`` or ``input``.
    backwards : bool
        Power flows from the output to the input: the load drives, as in coasting.

    Returns
    -------
    ChainFriction

    Notes
    -----
    Without masses, power passes joint i as P_{i+1} = P_i (1 - κ tan θ_2)/(1 + κ tan θ_1), signs of κ the other way
    backwards; the product over the joints is integrated between the angles at which any cross stops in a yoke. Book
    (139) multiplies the joints' own efficiencies instead and errs by κ² and by the swinging of the torques between.

    Examples
    --------
    >>> from cardan.units import deg
    >>> found = chain_friction(Drive.from_angles([20 * deg, 20 * deg]), [0.0125, 0.0125])
    >>> print(found.efficiency, found.first_order)
    0.988600148 0.988633125
    """
    chain = crosses(drive, _("losses"))
    xp = namespace(chain.joint_angle, drag)
    kappa = _each_joint(drag, chain, xp)
    locked = kappa * xp.tan(chain.joint_angle) >= 1.0
    stuck = xp.any(locked, axis=-1)
    held = xp.where(stuck[..., None], xp.full_like(kappa, xp.nan), kappa)
    sense = -1.0 if backwards else 1.0

    def powers(angle: Array) -> Array:
        """Return power in, power out, and what the two pairs of journals of each joint take, for unit torque."""
        at = stance(chain, angle)
        driving, driven = held[..., None] * at.driving, held[..., None] * at.driven
        passes = (1.0 - sense * driven) / (1.0 + sense * driving)
        flow = [(at.ratio[..., -1, :] if torque_at == "output" else 1.0) * xp.ones_like(passes[..., 0, :])]
        for i in range(chain.joints):
            k = chain.joints - 1 - i if torque_at == "output" else i
            flow.append(flow[-1] / passes[..., k, :] if torque_at == "output" else flow[-1] * passes[..., k, :])
        power = xp.stack(flow[::-1] if torque_at == "output" else flow, axis=-2)
        lost = (
            power[..., 1:, :] * driven / (1.0 - sense * driven),
            power[..., :-1, :] * driving / (1.0 + sense * driving),
        )
        return xp.concat((power[..., :1, :], power[..., -1:, :], *lost), axis=-2)

    mean = mean_between(powers, kinks(chain), period=xp.pi)
    first, last, n = mean[..., 0], mean[..., 1], chain.joints
    lost = xp.sum(mean[..., 2:], axis=-1)
    given_drives = (torque_at == "input") != backwards
    return ChainFriction(
        efficiency=1.0 - lost if given_drives else 1.0 / (1.0 + lost),
        first_order=xp.prod(joint_friction(chain.joint_angle, kappa, torque_at="output").first_order, axis=-1),
        driving_loss=mean[..., 2 : 2 + n],
        driven_loss=mean[..., 2 + n :],
        residual=xp.abs(xp.abs(first - last) - lost),
        locked=locked,
        status=xp.astype(stuck, xp.int64),
    )


def _each_joint(drag: ArrayLike, chain: Chain, xp: object) -> Array:
    """Return κ of every joint, and refuse what does not fit the drives."""
    kappa = real(drag, xp)
    if not kappa.ndim or kappa.shape[-1] != chain.joints:
        given = kappa.shape[-1] if kappa.ndim else 1
        raise refuse("drag", _("{given} values given, {wanted} needed").format(given=given, wanted=chain.joints))
    return kappa
