"""The motion of a drive followed from joint to joint, each by its own law."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.drive.drive import Drive
from cardan.drive.models.chain import given_chain
from cardan.errors import Problem, check
from cardan.maths.arrays import Array
from cardan.texts import _


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
        text = _("a joint of kind {kind} with these sizes does not turn at its joint angle of {joint_angle:.6g}°")
        said = text.format(kind=joint.kind, joint_angle=np.degrees(joint_angle))
        check([Problem(f"joints[{i}].joint_angle", said, "out_of_range")] if stuck else [])
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
