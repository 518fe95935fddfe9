"""How does every shaft turn?"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.drives import Drives, kinematics
from cardan.drive.models.kinematics_model import Chain, given_chain, unmapped
from cardan.drive.models.wobble import SAMPLES, course, wobbling
from cardan.errors import Problem, check, refuse
from cardan.maths.arrays import Array, ArrayLike, namespace, real, unit_complex
from cardan.maths.curves.extremes import sampled_series, series_at
from cardan.maths.kernel import mobius
from cardan.texts import _

TURN = 361
"""Positions of one turn, both ends included, when no angles are given."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Motion:
    """Motion of every shaft over the input angle; leading axes are those of the drives.

    Attributes
    ----------
    angle : array (p,) [rad]
        Input angle φ_1 from the start position.
    shaft_angle : array (..., n+1, p) [rad]
        φ_i of every shaft, continuous over any number of turns, zero at the start.
    shaft_ratio : array (..., n+1, p)
        ω_i/ω_1.
    shaft_slope : array (..., n+1, p) [1/rad]
        Derivative of the speed ratio by φ_1.
    yoke_rotation : array (..., n, p) [rad]
        θ_i, angle of the driving yoke or mark of joint i from the plane of the joint.
    joint_angle : array (..., n) [rad]
        α_i.
    crossed : tuple of bool (n)
        Which joints are Hooke joints, whose crosses turn as the properties below tell; all of them when empty.
    followed : bool
        Whether the drive was followed joint by joint, because one of them turns by a law of its own.
    speed : float or array (...) [rad/s]
        ω_1; None when the drive does not say.
    acceleration : float or array (...) [rad/s²]
        ε_1.
    """

    angle: Array
    shaft_angle: Array
    shaft_ratio: Array
    shaft_slope: Array
    yoke_rotation: Array
    joint_angle: Array
    speed: ArrayLike | None = None
    acceleration: ArrayLike = 0.0
    crossed: tuple[bool, ...] = ()
    followed: bool = False

    @property
    def output_angle(self) -> Array:
        """φ_{n+1}, array (..., p) [rad]."""
        return self.shaft_angle[..., -1, :]

    @property
    def ratio(self) -> Array:
        """Speed ratio ω_{n+1}/ω_1 of the drive, array (..., p)."""
        return self.shaft_ratio[..., -1, :]

    @property
    def slope(self) -> Array:
        """Derivative of the drive's speed ratio by φ_1, array (..., p) [1/rad]."""
        return self.shaft_slope[..., -1, :]

    @property
    def angle_error(self) -> Array:
        """How far each shaft runs ahead of the input, φ_i - φ_1, array (..., n+1, p) [rad]."""
        return self.shaft_angle - self.angle

    @property
    def shaft_speed(self) -> Array:
        """ω_i, array (..., n+1, p) [rad/s]; needs ``speed``."""
        return self.shaft_ratio * self._each(self.speed)

    @property
    def shaft_acceleration(self) -> Array:
        """ε_i = ε_1 i + ω_1² di/dφ_1, array (..., n+1, p) [rad/s²]; needs ``speed``."""
        return self._each(self.acceleration) * self.shaft_ratio + self._each(self.speed) ** 2 * self.shaft_slope

    @property
    def cross_driving(self) -> Array:
        """Turn η' of each cross in its driving yoke about u_i, array (..., n, p) [rad]; tan η' = tan α sin θ."""
        xp = namespace(self.joint_angle)
        return self._of_crosses(xp.atan(xp.tan(self.joint_angle)[..., None] * xp.sin(self.yoke_rotation)))

    @property
    def cross_driven(self) -> Array:
        """Turn η'' of each cross in its driven yoke about v_{i+1}, array (..., n, p) [rad]; sin η'' = -sin α cos θ."""
        xp = namespace(self.joint_angle)
        return self._of_crosses(-xp.asin(xp.sin(self.joint_angle)[..., None] * xp.cos(self.yoke_rotation)))

    @property
    def cross_driving_rate(self) -> Array:
        """dη'/dφ_1, array (..., n, p)."""
        xp = namespace(self.joint_angle)
        tangent = xp.tan(self.joint_angle)[..., None]
        sine, cosine = xp.sin(self.yoke_rotation), xp.cos(self.yoke_rotation)
        return self._of_crosses(self.shaft_ratio[..., :-1, :] * tangent * cosine / (1.0 + (tangent * sine) ** 2))

    @property
    def cross_driven_rate(self) -> Array:
        """dη''/dφ_1, array (..., n, p)."""
        xp = namespace(self.joint_angle)
        sine = xp.sin(self.joint_angle)[..., None]
        across = xp.sqrt(1.0 - (sine * xp.cos(self.yoke_rotation)) ** 2)
        return self._of_crosses(self.shaft_ratio[..., :-1, :] * sine * xp.sin(self.yoke_rotation) / across)

    def _of_crosses(self, values: Array) -> Array:
        """Return values (..., n, p) with nan for joints that are no Hooke joints."""
        if all(self.crossed):
            return values
        xp = namespace(values)
        return xp.where(xp.asarray(self.crossed)[:, None], values, xp.nan)

    def _each(self, value: ArrayLike | None) -> Array:
        if value is None:
            raise refuse("duty.speed", _("missing; speeds and accelerations need the input speed"), "missing")
        xp = namespace(self.angle)
        given = real(value, xp)
        return given[..., None, None] if given.ndim else given


def motion(
    drive: Drive | Drives | Chain,
    angle: ArrayLike | None = None,
    *,
    speed: ArrayLike | None = None,
    acceleration: ArrayLike | None = None,
) -> Motion:
    """Return angle, speed ratio and acceleration of every shaft, exactly.

    Parameters
    ----------
    drive : Drive or Drives (...)
        One drive, or many as arrays.
    angle : array (p,) [rad], optional
        Input angle φ_1 from the start position; one turn in steps of a degree by default.
    speed : float or array (...) [rad/s], optional
        Input speed; that of the drive's duty by default.
    acceleration : float or array (...) [rad/s²], optional
        Input acceleration; that of the drive's duty by default.

    Returns
    -------
    Motion
        shaft_angle, shaft_ratio, shaft_slope : arrays (..., n+1, p).

    Raises
    ------
    JointAngleLimitError
        A joint angle is 90 degrees or more.
    InputError
        A joint with its sizes does not turn at its joint angle.

    See Also
    --------
    extremes, traces, equivalent_joint

    Notes
    -----
    Joints of other kinds whose map is tan θ' = κ tan θ count as the Hooke joints that turn alike, see
    `cardan.drive.models.kinematics_model`; a drive with a joint that turns by another law is followed joint by joint.

    Every shaft directly from φ_1 by the product of the joints' Möbius matrices: i = 1/\\|b̄ w + ā\\|², w = e^(2iφ_1);
    equal to the recurrences of Book (32), (33), (38) to rounding, and the cost of a position does not grow with n.

    Examples
    --------
    >>> from cardan import Drive, motion
    >>> from cardan.units import deg
    >>> single = Drive.from_angles([20 * deg])
    >>> motion(single, [0.0]).ratio
    array([1.06417777])
    """
    duty = drive.duty if isinstance(drive, Drive) else None
    given: dict[str, Any] = {
        "speed": speed if speed is not None or duty is None else duty.speed,
        "acceleration": acceleration if acceleration is not None else duty.acceleration if duty else 0.0,
    }
    if isinstance(drive, Drive) and wobbling(drive):
        return Motion(**wobbled(drive, positions(angle, np)), **given)
    if isinstance(drive, Drive) and unmapped(drive.joints):
        return Motion(**followed(drive, positions(angle, np)), **given)
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle, angle)
    phi = positions(angle, xp)
    w = unit_complex(phi)
    w = w * w
    start = xp.ones_like(w[..., :1])
    ratios, slopes, turns = [xp.ones_like(phi)], [xp.zeros_like(phi)], [phi]
    before: list[Array] = []
    shape = (*chain.joint_angle.shape[:-1], phi.shape[0])
    mu = chain.turn_before
    psi = mu[..., 0]
    for i, (a, b) in enumerate(chain.products()):
        pair = (a[..., None], b[..., None])
        begin = mobius.angle_error(pair, start)
        before.append(xp.broadcast_to(turns[-1] + psi[..., None], shape))
        angle_error, ratio, slope = mobius.course(pair, w)
        turns.append(phi + (angle_error - begin))
        ratios.append(ratio)
        slopes.append(slope)
        if i + 1 < chain.joints:
            psi = _next_phase(psi, chain.joint_angle[..., i]) + mu[..., i + 1]
    at, laws = xp.stack(before, axis=-2), chain.laws
    return Motion(
        angle=phi,
        shaft_angle=_stacked(turns, shape, xp),
        shaft_ratio=_stacked(ratios, shape, xp),
        shaft_slope=_stacked(slopes, shape, xp),
        yoke_rotation=at if laws is None else at - laws.ahead[..., None],
        joint_angle=chain.joint_angle if laws is None else laws.joint_angle,
        crossed=() if laws is None else tuple(not own for own in laws.own),
        **given,
    )


def initial_phases(drive: Drive | Drives | Chain) -> Array:
    """Return the phase angles ψ_i, the joint angles θ_i at the start; array (..., n) [rad].

    Notes
    -----
    Book (31), (38) with the term it drops: ψ_i = π/2 - γ_i - β_i + T(ψ_{i-1}), tan T(θ) = tan θ/cos α.
    """
    chain = kinematics(drive)
    xp = namespace(chain.joint_angle)
    mu = chain.turn_before
    phases = [mu[..., 0]]
    for i in range(1, chain.joints):
        phases.append(_next_phase(phases[-1], chain.joint_angle[..., i - 1]) + mu[..., i])
    found = xp.stack(phases, axis=-1)
    return found if chain.laws is None else found - chain.laws.ahead


def _next_phase(psi: Array, joint_angle: Array) -> Array:
    """Return T(ψ), the driven angle of a joint at the driving angle ψ, unwrapped; Book (17)-(19)."""
    w = unit_complex(2.0 * psi)
    return psi + mobius.angle_error(mobius.hooke(joint_angle), w)


def positions(angle: ArrayLike | None, xp: object, *, turns: int = 1) -> Array:
    """Return the input angles to look at, whole turns in steps of a degree when none are given; array (p,) [rad]."""
    if angle is None:
        places = turns * (TURN - 1) + 1
        return xp.linspace(0.0, 2.0 * np.pi * turns, places, dtype=xp.float64)  # type: ignore[attr-defined]
    phi = real(angle, xp)
    if phi.ndim > 1:
        raise refuse("angle", _("has {count} axes; one list of angles is meant").format(count=phi.ndim))
    return phi if phi.ndim else phi[None]


def _stacked(rows: list[Array], shape: tuple[int, ...], xp: object) -> Array:
    return xp.stack([xp.broadcast_to(row, shape) for row in rows], axis=-2)  # type: ignore[attr-defined]


# The motion of a drive followed from joint to joint, each by its own law.


def followed(drive: Drive, angle: Array) -> dict[str, Any]:
    """Return how every shaft turns, for joints of any kinds.

    angle (p,) [rad]: input angle φ_1 from the start position.
    Returns: fields of `cardan.questions.motion.motion.Motion`.
    θ_1 = φ_1 + ψ_1, θ_{i+1} = T_i(θ_i) + q_i - γ - β with q = π/2 for joints with a cross, else 0; the ratio and its
    slope by the chain rule.
    """
    whole = given_chain(drive)
    phi = np.asarray(angle, dtype=float)
    theta, psi = phi + float(whole.start_phase), np.asarray([float(whole.start_phase)])
    turns, ratios, slopes = [phi], [np.ones_like(phi)], [np.zeros_like(phi)]
    before = []
    for i, joint in enumerate(drive.joints):
        joint_angle = np.asarray(whole.joint_angle)[i]
        before.append(theta)
        with np.errstate(invalid="ignore", divide="ignore"):  # what does not turn is not a number, and said so
            angle_error, ratio, slope = joint.deviation(theta, joint_angle)
            start = joint.deviation(psi, joint_angle)[0]
        stuck = not all(bool(np.all(np.isfinite(part))) for part in (angle_error, ratio, slope, start))
        check([_not_turning(drive, i, float(joint_angle))] if stuck else [])
        slopes.append(slope * ratios[-1] ** 2 + ratio * slopes[-1])
        ratios.append(ratio * ratios[-1])
        turned, begun = theta + angle_error, psi + start
        turns.append(turned - begun)
        if i + 1 < len(drive.joints):
            shift = (0.5 * np.pi if joint.crossed else 0.0) - whole.yoke_angle[i] - whole.plane_twist[i]
            theta, psi = turned + shift, begun + shift
    return {
        "angle": phi,
        "shaft_angle": np.stack(turns),
        "shaft_ratio": np.stack(ratios),
        "shaft_slope": np.stack(slopes),
        "yoke_rotation": np.stack(before),
        "joint_angle": np.asarray(whole.joint_angle),
        "followed": True,
        "crossed": tuple(joint.single_cross for joint in drive.joints),
    }


def wobbled(drive: Drive, angle: Array) -> dict[str, Any]:
    """Return how every shaft turns where shafts wobble: fields of `Motion` at input angles (p,) [rad].

    Seen at `SAMPLES` places in a turn; derivatives by the harmonics of what each shaft runs ahead.
    """
    whole = given_chain(drive)
    phi = np.asarray(angle, dtype=float)
    turn = np.arange(SAMPLES) * (2.0 * np.pi / SAMPLES)
    found = course(drive, turn)
    stuck = np.flatnonzero(~np.all(np.isfinite(found.driven), axis=(1, 2)))
    check([_not_turning(drive, int(stuck[0]), float(whole.joint_angle[stuck[0]]))] if stuck.size else [])
    each = np.unwrap(np.concatenate((found.turned, found.theta)) - turn, axis=-1)
    wave = sampled_series(each)
    value, rate, second = (part.T for part in series_at(wave, phi))
    start = series_at(wave, np.zeros(1))[0][0]
    count = len(drive.shafts)
    return {
        "angle": phi,
        "shaft_angle": phi + (value - start[:, None])[:count],
        "shaft_ratio": 1.0 + rate[:count],
        "shaft_slope": second[:count],
        "yoke_rotation": phi + value[count:],
        "joint_angle": np.asarray(whole.joint_angle),
        "followed": True,
        "crossed": tuple(joint.single_cross for joint in drive.joints),
    }


def _not_turning(drive: Drive, i: int, joint_angle: float) -> Problem:
    """Return the problem that a joint, counted from 0, does not turn at its joint angle [rad]."""
    return Problem(f"joints[{i}].joint_angle", drive.joints[i].stuck(joint_angle), "out_of_range")
