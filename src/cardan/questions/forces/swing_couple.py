"""What it takes to swing the axis of a turning shaft: gyroscopic couple and couple of transverse inertia."""

from __future__ import annotations

from dataclasses import dataclass

from cardan.maths.arrays import Array, ArrayLike, namespace, real
from cardan.maths.curves.paths import Jet
from cardan.maths.kernel import frames
from cardan.questions.motion.moving_chain import Spins, moving_axes


@dataclass(frozen=True, eq=False, kw_only=True)
class SwingCouple:
    """Couples that the shaft puts on what holds it while its axis swings, both across the axis."""

    gyroscopic: Array  # (..., 3) [N·m]: -J ω ė, Book (125)
    transverse: Array  # (..., 3) [N·m]: -I_t e×ë

    @property
    def whole(self) -> Array:
        """Both together, array (..., 3) [N·m]."""
        return self.gyroscopic + self.transverse


def swing_couple(
    axis: Jet, speed: ArrayLike, inertia: ArrayLike | None, transverse_inertia: ArrayLike | None
) -> SwingCouple:
    """Return the couples of a turning shaft whose axis swings.

    Parameters
    ----------
    axis : Jet (..., 3)
        e and its rates [1/s, 1/s²].
    speed : array (...) [rad/s]
        ω, part of the angular velocity along e.
    inertia, transverse_inertia : array (...) [kg m²] or None
        J about the axis and I_t across, about the centre of mass; None for none.

    Notes
    -----
    From H = J ω e + I_t e×ė. Book (125) keeps the first couple only; for a swinging axis the second is often larger.

    Examples
    --------
    >>> import numpy as np
    >>> x, y, z = np.eye(3)
    >>> found = swing_couple((x, 0.9 * y, 12.0 * y), 120.0, 0.02, 0.4)
    >>> found.gyroscopic, found.transverse
    (array([ 0.  , -2.16,  0.  ]), array([ 0. ,  0. , -4.8]))
    """
    e, rate, curve = axis
    xp = namespace(e)
    zero = 0.0 * e
    spin = real(speed, xp)
    gyroscopic = zero if inertia is None else -(real(inertia, xp) * spin)[..., None] * rate
    across = zero if transverse_inertia is None else -real(transverse_inertia, xp)[..., None] * frames.cross(e, curve)
    return SwingCouple(gyroscopic=gyroscopic + zero, transverse=across + zero)


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
