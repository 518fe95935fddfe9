"""Whether the rated torque of every joint, by its maker's convention, is enough for the life asked for."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case
from cardan.checks.moving import stands
from cardan.checks.verdict import Verdict
from cardan.formulas.joint_rating import LEAST_JOINT_ANGLE, NOMINAL, POWER, rated_joint_angle
from cardan.maths.arrays import Array
from cardan.questions.life.bearing_life import CONVENTIONS
from cardan.texts import _, mark

SOURCES = {
    "Tc": mark("rating by T_c: 5000 h at 3° and 100 rpm; L = 1.5·10⁶/(nα)·(T_c/M)^(10/3)"),
    "CR": mark("rating by C·R: L = 1.5·10⁷/(nα)·(C·R/M)^(10/3)"),
    "book": mark("Kozhevnikov & Perfil'ev (1978), eq. 267: 5000 h at 3° and 33.3 rpm"),
}


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    torque, rating = f"joints[{i}].rating.torque", design.drive.joints[i].rating
    running = [(share, one, case) for share, one in stands(design) for case in one.running if share]
    lacking = (*design.missing(torque, "duty.life"), *design.unloaded, *design.unmoved)
    if lacking or not running or rating is None:
        yield Verdict(missing=tuple(dict.fromkeys(lacking)) or ("duty.torque",))
        return
    convention = rating.convention
    rated = np.asarray(design.value(torque), dtype=float)
    if convention == "book":
        rated = rated / NOMINAL
    # Torque that does the damage of the whole duty at its mean speed times joint angle.
    paces = [
        share * np.asarray(case.share) * np.asarray(case.speed) * _rated(one, case, i) for share, one, case in running
    ]
    pace: Array = sum(paces)
    loads = [case.severity * case.joint_torque[..., i] for _share, _one, case in running]
    worn: Array = sum(own * load**POWER for own, load in zip(paces, loads, strict=True))
    whole: Array = sum(share * np.asarray(case.share) for share, _one, case in running)
    yield Verdict(
        value=design.shock * (worn / pace) ** (1.0 / POWER),
        limit=rated * (CONVENTIONS[convention] / (pace / whole * design.value("duty.life"))) ** (1.0 / POWER),
        source=_(SOURCES[convention]),
        design_variables=(
            torque,
            *design.joint_angles_of(i),
            *design.torque_design_variables,
            *design.speed_design_variables,
            "duty.life",
        ),
        note=_("a joint angle below 3° counts as 3°") if np.any(design.joint_angle[..., i] < LEAST_JOINT_ANGLE) else "",
    )


def _rated(design: Design, case: Case, i: int) -> Array:
    """Return the joint angle that makers count of a joint in a way of running, the mean over the movements [rad]."""
    moved = None
    if case.chain is design.chain:
        moved = design.while_moving(lambda chain: rated_joint_angle(chain.joint_angle[..., [i]]), mean=True)
    return rated_joint_angle(case.joint_angle[..., i]) if moved is None else moved.most[..., 0]


CHECK = Check(
    name="rated_torque",
    doc=mark("torque of the duty against the rated torque of every joint for the life"),
    joint=_judge,
    title=mark("rated torque of joint {number} for its life"),
    dimension="torque",
    unit="Nm",
    power=1.0,
    crosses="each",
    gathers="sum",
)
