"""Can the numbers be trusted? The same questions answered by other ways, and how far the answers differ."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cardan.drive.bodies.solids import arms
from cardan.drive.drive import Drive
from cardan.drive.models.geometry import Geometry, geometry
from cardan.drive.models.kinematics_model import Chain, chain
from cardan.maths.arrays import Array, ArrayLike
from cardan.maths.kernel import frames
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import motion
from cardan.texts import _

from .comparison import blokh

ROUNDING = 1e-13
"""Rounding that a chain of products may gather, before it is scaled by how steep the motion is."""

POSITIONS = 180
"""Positions of a turn at which two ways are compared."""


@dataclass(frozen=True, kw_only=True, slots=True)
class SelfCheck:
    """Two ways to the same number."""

    name: str  # what must be nought
    way: str  # the other way
    residual: float
    allowed: float  # what rounding may make of it

    @property
    def passed(self) -> bool:
        """Whether the residual is no more than rounding."""
        return self.residual <= self.allowed


def evidence(drive: Drive) -> tuple[SelfCheck, ...]:
    """Return what the exact motion of a drive gives when reached by other ways.

    Returns: residuals are absolute.
    The plain vectors of `ratio_by_vectors` know no planes, phases or matrices: they are the independent truth. Allowed
    is rounding times the fourth power of the steepest ratio, by which a ratio's own rounding grows.
    """
    whole = chain(drive)
    joint = equivalent_joint(whole)
    angle = 2.0 * np.pi * np.arange(POSITIONS) / POSITIONS
    found = motion(whole, angle)
    a, b = joint.pair
    steep = max(float(np.max(found.shaft_ratio)), float(joint.ratio_max), 1.0)
    allowed = ROUNDING * whole.joints * steep**4
    straight = ratio_by_vectors(geometry(drive), whole, angle)
    steps = np.sin(found.yoke_rotation) ** 2 + (np.cos(whole.joint_angle)[:, None] * np.cos(found.yoke_rotation)) ** 2
    chained = np.cumprod(np.cos(whole.joint_angle)[:, None] / steps, axis=0)
    closed = blokh(whole, angle)
    return (
        SelfCheck(
            name=_("speed ratio of every shaft"),
            way=_("plain vectors: u ⟂ v at every cross, no planes, phases or matrices"),
            residual=_largest(found.shaft_ratio - straight),
            allowed=allowed,
        ),
        SelfCheck(
            name=_("speed ratio of every shaft"),
            way=_("joint by joint, Kozhevnikov & Perfil'ev (1978), eq. 33"),
            residual=_largest(found.shaft_ratio[1:] - chained),
            allowed=allowed,
        ),
        SelfCheck(
            name=_("angle of the output"),
            way=_("Blokh's closed form, Kozhevnikov & Perfil'ev (1978), eq. 35–37, freed of its poles"),
            residual=_largest(found.angle_error[-1] - closed.angle_error),
            allowed=allowed,
        ),
        SelfCheck(
            name=_("harmonics of the angle error"),
            way=_("Fourier transform of the curve"),
            residual=_harmonics(whole, joint.harmonics(6)),
            allowed=allowed,
        ),
        SelfCheck(
            name=_("largest by smallest ratio, less 1"),
            way=_("extremes by plain vectors, at the angles the phase of the equivalent joint names"),
            residual=_extremes(drive, whole),
            allowed=allowed,
        ),
        SelfCheck(
            name=_("determinant |a|² − |b|² less 1"),
            way=_("every joint's matrix has determinant 1"),
            residual=abs(float(abs(a) ** 2 - abs(b) ** 2) - 1.0),
            allowed=allowed,
        ),
    )


def ratio_by_vectors(place: Geometry, train: Chain, angle: ArrayLike) -> Array:
    """Return the speed ratio of every shaft by plain vectors, array (n+1, p).

    place: where the drive lies; train: its yoke angles and start phase.
    angle (p,) [rad]: input angle φ_1 from the start position.
    ω_{i+1}/ω_i = (a_i·a_{i+1})/|a_{i+1} × u_i|², from u_i · v_{i+1} = 0 alone.
    """
    driving = arms(place, train, np.asarray(angle, dtype=float)).driving
    axis = place.axis[:, None, :]
    steps = frames.dot(axis[:-1], axis[1:]) / frames.dot(*[frames.cross(axis[1:], driving)] * 2)
    return np.concatenate((np.ones_like(steps[:1]), np.cumprod(steps, axis=0)))


def swing_by_vectors(drive: Drive, yoke_angle: ArrayLike) -> float:
    """Return how far the output's speed ratio swings over a turn with other yoke angles, by plain vectors.

    yoke_angle (n-1,) [rad]: γ of shafts 2 … n.
    """
    built = chain(drive)
    train = Chain(
        joint_angle=built.joint_angle,
        plane_twist=built.plane_twist,
        yoke_angle=np.asarray(yoke_angle, dtype=float),
        start_phase=built.start_phase,
    )
    angle = np.pi * np.arange(POSITIONS) / POSITIONS
    return float(np.ptp(ratio_by_vectors(geometry(drive), train, angle)[-1]))


def _extremes(drive: Drive, whole: Chain) -> float:
    phase = float(equivalent_joint(whole).phase)
    if not np.isfinite(phase):
        phase = 0.0
    top, bottom = ratio_by_vectors(geometry(drive), whole, np.asarray([-phase, 0.5 * np.pi - phase]))[-1]
    return abs(float(top * bottom) - 1.0)


def _harmonics(whole: Chain, exact: Array) -> float:
    """Return the largest difference between exact harmonics and those of the curve, sampled without aliasing."""
    tau = float(equivalent_joint(whole).tau)
    count = 64
    while count < 65536 and tau ** (count // 2) > 1e-18:
        count *= 2
    angle = np.pi * np.arange(count) / count
    wave = np.fft.rfft(motion(whole, angle).angle_error[-1]) * 2.0 / count
    return _largest(np.abs(wave[1 : len(exact) + 1]) - exact)


def _largest(difference: Array) -> float:
    return float(np.max(np.abs(difference)))
