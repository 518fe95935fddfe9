"""Calculations of what is held too much: forces of assembly in a joint, reactions of bearings that give way."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.calc.calculation import Calculation, Values, given, gives, rows
from cardan.calc.motion.kinematics import RIGHT, START, YOKES, between, points
from cardan.drive.models.train import train_of_points
from cardan.errors import Problem
from cardan.maths.arrays import Array
from cardan.maths.curves.peaks import peaks
from cardan.maths.kernel import frames
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.forces.held import Hold, Layout, actions, shaft_flexibility
from cardan.questions.forces.misfit import Crosses, crosses, joint_gap, misfit
from cardan.texts import _, mark
from cardan.units import mm

from .forces import SHAFT, unknown_shafts

SLIDES = ("pin_B", "pin_C", "shaft_2")
TURN = np.linspace(0.0, 2.0 * np.pi, 361)

BEARINGS = rows(
    "bearings",
    mark("bearings in any order"),
    SHAFT,
    given("x_from_shaft_start_m", mark("place along the power flow from the point before"), "length"),
    given("radial", mark("whether it holds across"), kind="flag", default=True),
    given("axial", mark("whether it holds along the shaft"), kind="flag", default=False),
    given("k_radial_N_m", mark("radial stiffness in N/m, where statics alone cannot tell"), above=0.0, default=None),
    given("k_axial_N_m", mark("axial stiffness in N/m, where statics alone cannot tell"), above=0.0, default=None),
    given("housing_offset_m", mark("displacement of its housing"), "length", axes=(1,), width=3, default=None),
)


def _two(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if "shafts" in values and len(values["shafts"]) != 2:
        text = _("{given} values given, {wanted} needed")
        yield Problem(key("shafts"), text.format(given=len(values["shafts"]), wanted=2))


def _blocked(values: Values) -> Values:
    """Return the forces in one joint with blocked slides; shaft 1 lies along z, the joint angle turns about x."""
    one, two = values["shafts"]
    alpha, free = values["alpha"], values["free_slides"]
    axis = np.asarray([[0.0, 0.0, 1.0], [0.0, np.sin(alpha), np.cos(alpha)]])
    ends: list[tuple[int, tuple[Hold, ...]]] = [(0, ("radial", "axial")), (0, ("radial",)), (1, ("radial",))]
    ends.append((1, ("radial",) if "shaft_2" in free else ("radial", "axial")))
    layout = Layout(joints=1, bearings=tuple(ends), slides=(("pin_B" in free, "pin_C" in free),))
    lengths = np.asarray([shaft["bearing_span"] + shaft["overhang"] for shaft in (one, two)])
    place = np.asarray([0.0, one["bearing_span"], two["overhang"], lengths[1]])
    acting = actions(axis, lengths, layout, place)
    far, near = 1.0 / one["k_radial_far_N_m"], 1.0 / one["k_radial_near_N_m"]
    soft = [0.0, 0.0, 0.0, far, far, 1.0 / one["k_axial_far_N_m"], near, near]
    soft += [1.0 / two["k_radial_near_N_m"]] * 2 + [1.0 / two["k_radial_far_N_m"]] * 2 + [1.0 / two["k_axial_far_N_m"]]
    count = len(layout.unknowns)
    body = [np.asarray([[1.0 / shaft[key]] for shaft in (one, two)]) for key in ("EI_Nm2", "EA")]
    compliance = np.diag(soft[:count]) + shaft_flexibility(acting, *body)
    error = values["errors_mm_s1_a1_a2_a3_a4"][None] * mm

    def answer(angle: Array) -> tuple[Any, Array]:
        stand = _stand(axis, angle)
        gap = joint_gap(axis, np.asarray([[-1.0, 0.0, 0.0]]), stand, error)
        return misfit(acting, layout, stand, compliance, gap, np.zeros(count)), gap[0]

    found, gap = answer(np.atleast_1d(values["phi1"]))
    force = found.unknowns[..., :3]

    def size(angle: Array) -> Array:
        return frames.norm(answer(angle)[0].unknowns[..., :3])[None]

    return {
        "gap_vector_frame1_m": -gap[0, 0],
        "force_magnitude_N": float(frames.norm(force)[0]),
        "force_abs_along_shaft1_N": float(np.abs(force[0] @ axis[0])),
        "force_abs_along_shaft2_N": float(np.abs(force[0] @ axis[1])),
        "strain_energy_J": float(found.energy[0]),
        "extra_input_torque_Nm": float(found.torque[0]),
        "max_force_over_turn_N": float(peaks(size, TURN, size(TURN))[1][0]),
    }


def _stand(axis: Array, angle: Array) -> Crosses:
    """Return the cross of a joint whose plane has the normal -x, at the angles of its driving yoke from that plane."""
    none = 0.0 * angle
    driving = np.stack((-np.sin(angle), np.cos(angle), none), axis=-1)
    driven = frames.unit(frames.cross(axis[1] + 0.0 * driving, driving))
    return crosses(axis, driving[..., None, :], driven[..., None, :])


def _bearings(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from between(values, key)
    if "points" not in values or "bearings" not in values:
        return
    shafts = len(values["points"]) - 1
    if not values["bearings"]:
        yield Problem(key("bearings"), _("an empty list holds no shaft"))
    yield from unknown_shafts(values["bearings"], shafts, key("bearings"))
    for k, bearing in enumerate(values["bearings"]):
        if not bearing.get("radial", True) and not bearing.get("axial", True):
            yield Problem(f"bearings[{k}].radial", _("a bearing that holds neither across nor along is none"))


def _elastic(values: Values) -> Values:
    """Return the reactions of bearings that give way, in the housings where they are."""
    bearings = values["bearings"]
    kinds = [(bearing["shaft"] - 1, _holds(bearing)) for bearing in bearings]
    stiffness = [
        [math.nan if one is None else one for one in (bearing["k_radial_N_m"], bearing["k_axial_N_m"], None)]
        for bearing in bearings
    ]
    offset = [
        (0.0, 0.0, 0.0) if bearing["housing_offset"] is None else bearing["housing_offset"] for bearing in bearings
    ]
    whole = train_of_points(
        values["points"],
        yoke_angle=values["gamma"],
        start_phase=values["psi1"],
        bearings=tuple(kinds),
        position=np.asarray([bearing["x_from_shaft_start"] for bearing in bearings], dtype=float),
        stiffness=np.asarray(stiffness),
        offset=np.asarray(offset, dtype=float),
    )
    found = kinetostatics(whole, np.atleast_1d(values["phi1"]), torque=values["M_out"], field="bearings")
    return {
        "degree_of_indeterminacy": found.unknowns - found.equations,
        "bearing_reaction_N": np.asarray(found.reaction)[:, 0],
    }


def _holds(bearing: Values) -> tuple[Hold, ...]:
    held: dict[Hold, bool] = {"radial": bearing["radial"], "axial": bearing["axial"]}
    return tuple(hold for hold, there in held.items() if there)


CALCULATIONS = (
    Calculation(
        name="assembly_forces",
        doc=mark("force in a joint whose slides are blocked, from its errors of length"),
        source="Kozhevnikov & Perfil'ev (1978), p. 190, (171)",
        takes=(
            given("alpha_deg", mark("joint angle of the joint"), "angle", low=0.0, below=RIGHT),
            given("phi1_deg", mark("angle of the driving yoke from the plane of the joint"), "angle"),
            given("errors_mm_s1_a1_a2_a3_a4", mark("errors s1, a1, a2, a3, a4 in mm"), axes=(1,), width=5),
            given("free_slides", mark("what slides freely"), kind="word", axes=(1,), choices=SLIDES, default=()),
            rows(
                "shafts",
                mark("shaft 1 and shaft 2"),
                given("bearing_span_m", mark("distance between its two bearings"), "length", above=0.0),
                given("overhang_m", mark("distance from the joint to the near bearing"), "length", low=0.0),
                given("EI_Nm2", mark("bending stiffness in N·m²"), above=0.0),
                given("EA_N", mark("stiffness in tension"), "force", above=0.0),
                given("k_radial_near_N_m", mark("radial stiffness of the near bearing in N/m"), above=0.0),
                given("k_radial_far_N_m", mark("radial stiffness of the far bearing in N/m"), above=0.0),
                given("k_axial_far_N_m", mark("axial stiffness of the far bearing in N/m"), above=0.0),
            ),
        ),
        returns=(
            gives("gap_vector_frame1_m", mark("gap in the joint centre, shaft 1 along z, bend about x"), "length"),
            gives("force_magnitude_N", mark("force in the joint centre"), "force"),
            gives("force_abs_along_shaft1_N", mark("its part along shaft 1"), "force"),
            gives("force_abs_along_shaft2_N", mark("its part along shaft 2"), "force"),
            gives("strain_energy_J", mark("stored energy"), "work"),
            gives("extra_input_torque_Nm", mark("torque that turning against the stored energy needs"), "torque"),
            gives("max_force_over_turn_N", mark("largest force over a turn"), "force"),
        ),
        answer=_blocked,
        check=_two,
    ),
    Calculation(
        name="indeterminate_reactions",
        doc=mark("reactions of bearings that give way, under torque and in housings that are off"),
        source=mark("least complementary energy; Kozhevnikov & Perfil'ev (1978), p. 190 for the idea"),
        takes=(
            points(),
            START,
            YOKES,
            given("phi1_deg", mark("input angle from the start position"), "angle"),
            given("M_out_Nm", mark("torque that resists the output"), "torque", default=0.0),
            BEARINGS,
        ),
        returns=(
            gives("degree_of_indeterminacy", mark("forces and couples that balance alone leaves open")),
            gives("bearing_reaction_N", mark("force of each bearing on its shaft, in the order given"), "force"),
        ),
        answer=_elastic,
        check=_bearings,
    ),
)
