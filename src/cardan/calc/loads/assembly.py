"""Assembly: forces in a joint that is held too much, reactions of bearings that give way."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.calc.motion.kinematics import START, YOKES, between, points
from cardan.drive.models.dynamics_model import train_of_points
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.curves.extremes import peaks
from cardan.maths.kernel import frames
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.forces.support_statics import (
    Crosses,
    Hold,
    Layout,
    actions,
    crosses,
    joint_gap,
    misalignment,
    shaft_flexibility,
)
from cardan.reading.given import at_least_zero, flag, given, joint_angle, positive, rows, word
from cardan.texts import _
from cardan.units import mm

from .forces import SHAFT, held, unknown_shafts

formula = Formulas(__doc__)

SLIDES = ("pin_B", "pin_C", "shaft_2")
TURN = np.linspace(0.0, 2.0 * np.pi, 361)

BEARINGS = rows(
    "bearings",
    "bearings in any order",
    SHAFT,
    given("x_from_shaft_start_m", "place along the power flow from the point before"),
    flag("radial", "whether it holds across", default=True),
    flag("axial", "whether it holds along the shaft"),
    positive("k_radial_N_m", "radial stiffness in N/m, where statics alone cannot tell", None, default=None),
    positive("k_axial_N_m", "axial stiffness in N/m, where statics alone cannot tell", None, default=None),
    given("housing_offset_m", "displacement of its housing", axes=1, width=3, default=None),
)


def _two(v: Values) -> Problems:
    if "shafts" in v and len(v.shafts) != 2:
        yield v.wrong("shafts", _("{given} values given, {wanted} needed"), given=len(v.shafts), wanted=2)


def _stand(axis: Array, angle: Array) -> Crosses:
    """Return the cross of a joint whose plane has the normal -x, at the angles of its driving yoke from that plane."""
    none = 0.0 * angle
    driving = np.stack((-np.sin(angle), np.cos(angle), none), axis=-1)
    driven = frames.unit(frames.cross(axis[1] + 0.0 * driving, driving))
    return crosses(axis, driving[..., None, :], driven[..., None, :])


def _bearings(v: Values) -> Problems:
    yield from between(v)
    if "points" not in v or "bearings" not in v:
        return
    shafts = len(v.points) - 1
    if not v.bearings:
        yield v.wrong("bearings", _("an empty list holds no shaft"))
    yield from unknown_shafts(v.bearings, shafts, v.key("bearings"))
    for k, bearing in enumerate(v.bearings):
        if not bearing.get("radial", True) and not bearing.get("axial", True):
            yield Problem(f"bearings[{k}].radial", _("a bearing that holds neither across nor along is none"))


@formula(
    "force in a joint whose slides are blocked, from its errors of length",
    "Kozhevnikov & Perfil'ev (1978), p. 190, (171)",
    joint_angle("alpha_deg", "joint angle of the joint"),
    given("phi1_deg", "angle of the driving yoke from the plane of the joint"),
    given("errors_mm_s1_a1_a2_a3_a4", "errors s1, a1, a2, a3, a4 in mm", None, axes=1, width=5),
    word("free_slides", "what slides freely", *SLIDES, axes=1, default=()),
    rows(
        "shafts",
        "shaft 1 and shaft 2",
        positive("bearing_span_m", "distance between its two bearings"),
        at_least_zero("overhang_m", "distance from the joint to the near bearing"),
        positive("EI_Nm2", "bending stiffness in N·m²"),
        positive("EA_N", "stiffness in tension"),
        positive("k_radial_near_N_m", "radial stiffness of the near bearing in N/m", None),
        positive("k_radial_far_N_m", "radial stiffness of the far bearing in N/m", None),
        positive("k_axial_far_N_m", "axial stiffness of the far bearing in N/m", None),
    ),
    "gap_vector_frame1_m: gap in the joint centre, shaft 1 along z, joint angle about x",
    "force_magnitude_N: force in the joint centre",
    "force_abs_along_shaft1_N: its part along shaft 1",
    "force_abs_along_shaft2_N: its part along shaft 2",
    "strain_energy_J: stored energy",
    "extra_input_torque_Nm: torque that turning against the stored energy needs",
    "max_force_over_turn_N: largest force over a turn",
    check=_two,
)
def _assembly_forces(v: Values) -> Any:
    """Return the forces in one joint with blocked slides; shaft 1 lies along z, the joint angle turns about x."""
    one, two = v.shafts
    alpha, free = v.alpha, v.free_slides
    axis = np.asarray([[0.0, 0.0, 1.0], [0.0, np.sin(alpha), np.cos(alpha)]])
    ends: list[tuple[int, tuple[Hold, ...]]] = [(0, ("radial", "axial")), (0, ("radial",)), (1, ("radial",))]
    ends.append((1, ("radial",) if "shaft_2" in free else ("radial", "axial")))
    layout = Layout(joints=1, bearings=tuple(ends), slides=(("pin_B" in free, "pin_C" in free),))
    lengths = np.asarray([shaft.bearing_span + shaft.overhang for shaft in (one, two)])
    place = np.asarray([0.0, one["bearing_span"], two["overhang"], lengths[1]])
    acting = actions(axis, lengths, layout, place)
    far, near = 1.0 / one["k_radial_far_N_m"], 1.0 / one["k_radial_near_N_m"]
    soft = [0.0, 0.0, 0.0, far, far, 1.0 / one["k_axial_far_N_m"], near, near]
    soft += [1.0 / two["k_radial_near_N_m"]] * 2 + [1.0 / two["k_radial_far_N_m"]] * 2 + [1.0 / two["k_axial_far_N_m"]]
    count = len(layout.unknowns)
    body = [np.asarray([[1.0 / shaft[key]] for shaft in (one, two)]) for key in ("EI_Nm2", "EA")]
    compliance = np.diag(soft[:count]) + shaft_flexibility(acting, *body)
    error = v.errors_mm_s1_a1_a2_a3_a4[None] * mm

    def answer(angle: Array) -> tuple[Any, Array]:
        stand = _stand(axis, angle)
        gap = joint_gap(axis, np.asarray([[-1.0, 0.0, 0.0]]), stand, error)
        return misalignment(acting, layout, stand, compliance, gap, np.zeros(count)), gap[0]

    found, gap = answer(np.atleast_1d(v.phi1))
    force = found.unknowns[..., :3]

    def size(angle: Array) -> Array:
        return frames.norm(answer(angle)[0].unknowns[..., :3])[None]

    along = (float(np.abs(force[0] @ one)) for one in axis)
    most = float(peaks(size, TURN, size(TURN))[1][0])
    return -gap[0, 0], float(frames.norm(force)[0]), *along, float(found.energy[0]), float(found.torque[0]), most


@formula(
    "reactions of bearings that give way, under torque and in housings that are off",
    "least complementary energy; Kozhevnikov & Perfil'ev (1978), p. 190 for the idea",
    (points(), START, YOKES),
    given("phi1_deg", "input angle from the start position"),
    given("M_out_Nm", "torque that resists the output", default=0.0),
    BEARINGS,
    "degree_of_indeterminacy: forces and couples that balance alone leaves open",
    "bearing_reaction_N: force of each bearing on its shaft, in the order given",
    check=_bearings,
)
def _indeterminate_reactions(v: Values) -> Any:
    """Return the reactions of bearings that give way, in the housings where they are."""
    bearings = v.bearings
    stiffness = [
        [math.nan if one is None else one for one in (bearing["k_radial_N_m"], bearing["k_axial_N_m"], None)]
        for bearing in bearings
    ]
    offset = [np.zeros(3) if bearing["housing_offset"] is None else bearing["housing_offset"] for bearing in bearings]
    whole = train_of_points(
        v.points,
        yoke_angle=v.gamma,
        start_phase=v.psi1,
        bearings=tuple(held(bearing) for bearing in bearings),
        position=np.asarray([bearing["x_from_shaft_start"] for bearing in bearings], dtype=float),
        stiffness=np.asarray(stiffness),
        offset=np.asarray(offset, dtype=float),
    )
    found = kinetostatics(whole, np.atleast_1d(v.phi1), torque=v.M_out, field="bearings")
    return found.unknowns - found.equations, np.asarray(found.reaction)[:, 0]
