"""Whether the load keeps the gaps of all joints closed over the turn, against the inertia of the shafts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Text, numbered, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.load_case import Case, blocks, largest
from cardan.checks.speeds.shaft_inertia import shaft_inertia
from cardan.checks.verdict import Verdict, joined
from cardan.drive.models.kinematics_model import Chain
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.forces.gap_closure import least_load
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    each = [shaft_inertia(design, k) for k in range(1, design.joints + 1)]
    # The output shaft may belong to the machine; the shafts between the joints are the drive's own.
    own = each[:-1] or each
    lacking = [f"shafts[{k}].inertia" for k, one in enumerate(own, 1) if one is None]
    lacking += [*design.unloaded, *design.unmoved]
    if lacking:
        yield Verdict(missing=tuple(lacking))
        return
    held = [case for case in design.loaded if case.speed is not None and np.any(np.asarray(case.torque) > 0.0)]
    running = [case for case in held if np.any(_pressing(design, case) > 0.0)]
    turned = Verdict(unfit=_("the torque turns about, which opens the gaps: its reversal is judged by itself"))
    if not running:
        yield from [turned] if held else ()
        return
    inertia = np.stack(np.broadcast_arrays(*(np.asarray(0.0 if one is None else one) for one in each)), axis=-1)
    needs = [_needed(design, case, inertia) for case in running]
    torques = [_pressing(design, case) for case in running]
    rows = np.broadcast_arrays(*torques, *(np.maximum(np.max(one, axis=-1), 0.0) for one in needs))
    torque, needed = np.stack(rows[: len(running)]), np.stack(rows[len(running) :])
    with np.errstate(divide="ignore", invalid="ignore"):
        used = np.where(torque > 0.0, needed / torque, 0.0)
    worst = np.argmax(used, axis=0)[None]
    note: Text = ""
    if not design.varied:
        k = int(worst[0])
        first = int(foremost(needs[k]))
        joint = say(_("joint {number} needs most"), number=numbered(first + 1, design.drive.joints[first].name))
        named = _("decided by {case}").format(case=running[k].name) if running[k].name else ""
        light = _("the output shaft counts as without inertia") if each[-1] is None else ""
        rigid = _("its shafts count as rigid") if any(case.vibration is not None for case in running) else ""
        note = joined(joint if design.joints > 1 else "", named, light, rigid)
    found = Verdict(
        value=np.take_along_axis(torque, worst, axis=0)[0][()],
        limit=np.take_along_axis(needed, worst, axis=0)[0][()],
        source=_("Kozhevnikov & Perfil'ev (1978), eq. 121, 122, for all joints"),
        design_variables=(
            *design.torque_design_variables,
            *design.speed_design_variables,
            *design.joint_angle_design_variables,
            *design.yoke_design_variables,
        ),
        note=note,
    )
    yield found if len(running) == len(held) or np.any(used > 1.0) else turned


def _pressing(design: Design, case: Case) -> Array:
    """Return the torque that presses the joints one way all the time, array (...) [N·m]; 0 where it changes its sign.

    Of a measured torque it is the least; where it reverses, or torsional vibration turns the torque of a shaft about,
    `torque_reversal` tells it.
    """
    history = design.duty.torque_history
    if not case.history or history is None:
        turned = case.vibration is not None and float(np.min(case.vibration.low)) < 0.0
        return np.asarray(0.0 if turned else case.torque, dtype=float)
    low, high = min(history.torques), max(history.torques)
    return np.asarray(max(low, -high, 0.0))


def _needed(design: Design, case: Case, inertia: Array) -> Array:
    """Return the least torque that keeps each joint pressed one way, of many drives block by block (..., n) [N·m]."""
    whole = case.chain
    outer = np.broadcast_shapes(whole.joint_angle.shape[:-1], design.shape)
    speed = largest([one for one in (case.speed, case.fastest) if one is not None])
    own = design.value("duty.torque")
    torque, scale = np.asarray(case.torque, dtype=float), np.abs(np.asarray(case.scale, dtype=float))
    share = np.where(scale > 0.0, torque / np.where(scale > 0.0, scale, 1.0), 1.0)
    backwards = not case.name and own is not None and bool(np.all(np.asarray(own) < 0.0))
    many = [np.broadcast_to(np.asarray(one, dtype=float), outer).reshape(-1) for one in (speed, share)]
    heavy = np.broadcast_to(inertia, (*outer, design.joints)).reshape(-1, design.joints)
    wide = Chain(
        joint_angle=np.broadcast_to(whole.joint_angle, (*outer, design.joints)),
        plane_twist=whole.plane_twist,
        yoke_angle=whole.yoke_angle,
        start_phase=whole.start_phase,
        laws=whole.laws,
    )
    found = [
        least_load(
            part,
            heavy[rows],
            many[0][rows],
            torque_at=case.torque_at,
            harmonics=case.harmonics,
            scale=many[1][rows],
            backwards=backwards,
        )
        for rows, part in blocks(wide)
    ]
    return np.concatenate(found).reshape(*outer, design.joints)


CHECK = Check(
    name="gap_closure",
    doc=mark("load that keeps the gaps of all joints closed against the inertia of the shafts"),
    judge=_judge,
    title=mark("torque that keeps the gaps of the joints closed"),
    dimension="torque",
    unit="Nm",
    sense="at_least",
    moves=True,
)
