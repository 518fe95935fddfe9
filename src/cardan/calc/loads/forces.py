"""Forces of drives given by points, of one joint or two: kinetostatics, closure of clearances, closed forms."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.book.joint_forces import double_joint_forces, largest_middle_couple, single_joint_forces, spline_thrust
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.calc.motion.kinematics import ACCELERATION, ANGLE, START, between, points
from cardan.drive.models.dynamics_model import Hold, Train, spline_grip, train_of_points
from cardan.errors import Problem
from cardan.maths.curves import paths
from cardan.maths.kernel import frames
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.forces.gap_closure import gap_closure
from cardan.questions.forces.kinetostatics import gyroscopic_couple, parallel_ends
from cardan.reading.given import RIGHT, at_least_zero, flag, given, joint_angle, positive, rows, whole, word
from cardan.texts import _

formula = Formulas(__doc__)
SHAFT = whole("shaft", "number of the shaft")

BEARING = (
    SHAFT,
    given("x_from_shaft_start_m", "place from the beginning of the shaft along it"),
    flag("radial", "whether it holds the shaft sideways", default=True),
    flag("axial", "whether it holds the shaft lengthwise"),
)
"""Keys of a bearing in a list of them."""

YOKES = given("gamma_deg", "yoke angle of shafts 2 to n, driving to driven yoke", axes=1, default=None)

SPEED = given("omega1_rad_s", "input speed", default=0.0)

LOAD = given("M_out_Nm", "torque that resists the output")

_FREE: dict[str, Any] = {"default": None, "axes": (1,)}


def chain_check(v: Values) -> Problems:
    """Yield what is wrong with the points, and lists without a value for each shaft or joint."""
    yield from between(v)
    place = v.get("points")
    if place is None:
        return
    joints = place.shape[0] - 2
    yield from v.miscounted(joints + 1, "extra_resisting_torque", "J", "mass", "cg_from_shaft_start")
    yield from v.miscounted(joints, "cross_inertia_b_c_n", "cross_mass", axis=0)
    for name in ("bearings", "splines"):
        if v.get(name):
            yield from unknown_shafts(v[name], joints + 1, v.key(name))
    yield from _bearing_problems(v)
    yield from _spline_problems(v)


def unknown_shafts(given_rows: Sequence[Values], last: int, field: str) -> Iterator[Problem]:
    """Yield the rows of a list that stand on a shaft that is not there."""
    for k, row in enumerate(given_rows):
        if not 1 <= row.get("shaft", 1) <= last:
            text = _("row {row}: there is no shaft {number}; the shafts are 1 to {last}")
            yield Problem(field, text.format(row=k + 1, number=row.shaft, last=last))


def _bearing_problems(v: Values) -> Problems:
    """Yield bearings that hold nothing, and a list without any."""
    if "bearings" not in v:
        return
    if not v.bearings:
        yield v.wrong("bearings", _("an empty list holds no shaft"))
    for k, row in enumerate(v.bearings):
        if not (row.get("radial", True) or row.get("axial", True)):
            yield v.wrong("bearings", _("row {row} holds nothing"), row=k + 1)


def _spline_problems(v: Values) -> Problems:
    """Yield shafts with two splines, and friction of a spline whose thrust has no size or no sense."""
    seen: set[int] = set()
    for k, row in enumerate(v.get("splines") or ()):
        if row.get("shaft") in seen:
            yield v.wrong("splines", _("row {row}: shaft {number} has two"), row=k + 1, number=row.shaft)
        seen.add(row.get("shaft", 0))
        if not row.get("mu"):
            continue
        if row.get("d", 1.0) is None:
            yield Problem(f"{v.key('splines')}[{k}].d_m", _("missing; {other} needs it").format(other="mu"))
        if row.get("direction") not in (None, -1.0, 1.0):
            yield Problem(
                f"{v.key('splines')}[{k}].direction", _("{value} is neither 1 nor -1").format(value=row.direction)
            )


def held(row: Values) -> tuple[int, tuple[Hold, ...]]:
    """Return shaft, counted from 0, and holds of a bearing."""
    both: dict[Hold, bool] = {"radial": row.radial, "axial": row.axial}
    return row.shaft - 1, tuple(hold for hold, there in both.items() if there)


def train_of(v: Values, **parts: Any) -> Train:
    """Return the points, yokes and bearings of a drive given by points."""
    bearings = v.get("bearings") or []
    return train_of_points(
        v.points,
        yoke_angle=v.gamma,
        start_phase=v.psi1,
        bearings=tuple(held(row) for row in bearings),
        position=np.asarray([row.x_from_shaft_start for row in bearings]),
        **parts,
    )


def _each(v: Values) -> Callable[[Any], Any]:
    """Return what puts the axis of the positions first, or takes it away where a single angle was given."""
    single = np.ndim(v.phi1) == 0

    def first(table: Any) -> Any:
        if table is None:
            return None
        moved = np.moveaxis(table, 1, 0)
        return moved[0] if single else moved

    return first


@formula(
    "torques, secondary couples, joint forces and bearing reactions of any drive, with inertia and weight",
    "Kozhevnikov & Perfil'ev (1978), pp. 129–150",
    (points(), START, YOKES, ANGLE, SPEED, ACCELERATION),
    replace(LOAD, default=0.0),
    given("extra_resisting_torque_Nm", "torque that resists each shaft", **_FREE),
    at_least_zero("J_kg_m2", "inertia of each shaft about its axis", **_FREE),
    at_least_zero("mass_kg", "mass of each shaft", **_FREE),
    given("cg_from_shaft_start_m", "centre of mass of each shaft from its beginning", **_FREE),
    given("gravity_m_s2", "acceleration of free fall", axes=1, width=3, default=None),
    at_least_zero(
        "cross_inertia_b_c_n_kg_m2",
        "inertia of each cross about driving journals, driven journals and normal",
        axes=2,
        width=3,
        default=None,
    ),
    at_least_zero("cross_mass_kg", "mass of each cross", **_FREE),
    flag("cross_slides_on_pins", "whether every cross slides along its journals"),
    rows("bearings", "what holds the shafts", *BEARING),
    rows(
        "splines",
        "sliding splines",
        SHAFT,
        given("x_from_shaft_start_m", "place from the beginning of the shaft along it"),
        at_least_zero("mu", "coefficient of friction", default=0.0),
        positive("d_m", "mean diameter, with friction", default=None),
        given("direction", "+1 where friction pushes the parts apart, -1 where it pulls", default=1.0),
        default=(),
    ),
    "M_in_Nm: torque that drives the input",
    "shaft_torque_Nm: torque that enters each shaft",
    "omega_rad_s: speed of each shaft",
    "eps_rad_s2: acceleration of each shaft",
    "couple_on_driving_yoke_Nm: couple of each cross on its driving yoke",
    "couple_on_driven_yoke_Nm: couple of each cross on its driven yoke",
    "joint_force_on_driven_shaft_N: force in each joint centre on the driven shaft",
    "bearing_reaction_N: force of each bearing on its shaft",
    "secondary_couple_on_shaft_Nm: couple across each shaft",
    "equations: number of equations",
    "unknowns: number of unknowns",
    check=chain_check,
)
def _kinetostatics(v: Values) -> Any:
    splines = v.splines
    joints = len(v.points) - 2
    slide = v.cross_slides_on_pins
    whole = train_of(
        v,
        centre_of_mass=np.zeros(joints + 1) if v.cg_from_shaft_start is None else v.cg_from_shaft_start,
        slides=((slide, slide),) * joints,
        splines=tuple(row.shaft - 1 for row in splines),
        cut=np.asarray([row.x_from_shaft_start for row in splines]),
        grip=np.asarray([spline_grip(row.mu, row.d) if row.mu else 0.0 for row in splines]),
        sliding=np.asarray([float(row.direction) for row in splines]),
        **v.of(
            "mass",
            "cross_mass",
            "gravity",
            inertia="J",
            resisting_torque="extra_resisting_torque",
            cross_inertia="cross_inertia_b_c_n",
        ),
    )
    found = kinetostatics(
        whole,
        np.atleast_1d(np.asarray(v.phi1, dtype=float)),
        field="bearings",
        **v.of(torque="M_out", speed="omega1", acceleration="eps1"),
    )
    at = _each(v)
    torque, driving = at(found.shaft_torque), at(-found.driving_couple)
    more = found.driven_couple, found.joint_force, found.reaction, found.secondary_couple
    moved = at(found.speed), at(found.acceleration)
    return torque[..., 0], torque, *moved, driving, *map(at, more), found.equations, found.unknowns


@formula(
    "whether the load keeps the clearances of all joints closed against inertia over a turn",
    "Kozhevnikov & Perfil'ev (1978), eq. 121, 122 for any drive",
    (points(), START, YOKES, SPEED, ACCELERATION, LOAD),
    at_least_zero("J_kg_m2", "inertia of each shaft about its axis", axes=1),
    "min_pin_couple_over_turn_Nm = least_couple: least couple of each joint over a turn",
    "phi1_at_min_deg = least_angle: input angle where it occurs",
    "min_M_out_for_closure_Nm = load_needed: least load that keeps all joints closed",
    "closed: whether all joints stay closed",
    "open_share_of_turn = open_share: share of the turn in which the couple of each joint is reversed",
    "phi1_at_sign_changes_deg: input angles where the couple of each joint turns about",
    check=chain_check,
)
def _gap_closure(v: Values) -> Any:
    found = gap_closure(train_of(v, inertia=v.J), **v.of(load="M_out", speed="omega1", acceleration="eps1"))
    return found, {"phi1_at_sign_changes_deg": list(found.openings)}


def _single_check(v: Values) -> Problems:
    variant = v.get("variant")
    if variant is None:
        return
    name, other = "a2_bearing_span", "b2_joint_to_bearing"
    needed, spare = (other, name) if variant == "located_cross" else (name, other)
    yield from v.missing(variant, needed)
    if v.get(spare) is not None:
        yield v.wrong(spare, _("{variant} has no use for it"), variant=variant)


def _gyro_check(v: Values) -> Problems:
    if "alpha0" in v and "A" in v and abs(v.alpha0) + abs(v.A) >= RIGHT:
        yield v.wrong("alpha0", _("the joint angle reaches 90° with the given amplitude"))


IN_THE_JOINT = Formulas("the friction thrust of a spline and its parts in the joint before it")


@IN_THE_JOINT(
    "friction thrust of the spline of the driven shaft and its parts in the joint",
    "Kozhevnikov & Perfil'ev (1978), eq. 123, 124, corrected",
    joint_angle("alpha_deg", "joint angle"),
    given("phi1_deg", "angle of the driving yoke from the plane of the joint", axes=(0, 1)),
    given("M2_Nm", "torque at the spline"),
    at_least_zero("mu", "coefficient of friction of the spline"),
    positive("d_spline_m", "mean diameter of the spline"),
    "T_N = thrust: friction thrust",
    "axial_on_shaft1_N = axial: its part along shaft 1",
    "radial_on_shaft1_N = radial: its part across shaft 1",
    "along_pin_B_N = along_driving_arm: its part along the driving journals",
    "along_pin_C_N = along_driven_arm: its part along the driven journals",
    "along_cross_normal_N = along_normal: its part along the normal of the cross",
)
def _spline_axial_force(v: Values) -> Any:
    return spline_thrust(v.alpha, v.phi1, v.M2, spline_grip(v.mu, v.d_spline))


(SPLINE_THRUST,) = IN_THE_JOINT.calculations


@formula(
    "torques, journal loads and bearing loads of a single joint at constant torque of the driven shaft",
    "Kozhevnikov & Perfil'ev (1978), eq. 100–112, corrected",
    word("variant", "how the cross is held", "sliding_cross", "located_cross"),
    joint_angle("alpha_deg", "joint angle"),
    given("phi1_deg", "angle of the driving yoke from the plane of the joint", axes=(0, 1)),
    given("M2_Nm", "torque of the driven shaft"),
    positive("d_pin_span_m", "span of the cross"),
    positive("a1_bearing_span_m", "distance of the bearings of shaft 1"),
    at_least_zero("c1_overhang_m", "distance of the joint from the near bearing of shaft 1"),
    positive("a2_bearing_span_m", "distance of the bearings of shaft 2, sliding cross", default=None),
    positive("b2_joint_to_bearing_m", "distance of the bearing of shaft 2, located cross", default=None),
    "M1_Nm = driving_torque: torque of the driving shaft",
    "R_pin_inplane_N = journal: load of each journal in the plane of the cross",
    "R_B_tangential_N = driving_across: its part across the driving yoke",
    "R_B_yoke_plane_N = driving_along: its part in the plane of the driving yoke",
    "R_C_tangential_N = driven_across: its part across the driven yoke",
    "R_C_yoke_plane_N = driven_along: its part in the plane of the driven yoke",
    "R_bearing1_far_radial_N = far: radial load of the far bearing of shaft 1",
    "R_bearing1_near_radial_N = near: radial load of its near bearing",
    "R_bearing1_axial_N = axial: axial load of shaft 1",
    "R_bearing2_near_or_only_N = driven_bearing: radial load of each bearing of shaft 2",
    "omega2_over_omega1 = ratio: speed ratio",
    check=_single_check,
)
def _joint_reactions(v: Values) -> Any:
    located = v.variant == "located_cross"
    return single_joint_forces(
        v.alpha,
        v.phi1,
        v.M2,
        reach=v["b2_joint_to_bearing" if located else "a2_bearing_span"],
        located=located,
        **v.of(span="d_pin_span", bearing_span="a1_bearing_span", overhang="c1_overhang"),
    )


@formula(
    "secondary couples of a double joint and the pair of forces that balances those of the middle shaft",
    "Kozhevnikov & Perfil'ev (1978), eq. 113–120, corrected",
    joint_angle("alpha12_deg", "joint angle of joint 1"),
    joint_angle("alpha23_deg", "joint angle of joint 2"),
    given("beta13_deg", "plane twist of joint 2", default=0.0),
    given("gamma2_deg", "yoke angle of shaft 2", default=0.0),
    given("phi1_deg", "angle of the driving yoke from the plane of joint 1", axes=(0, 1)),
    given("M3_Nm", "torque of the last shaft"),
    positive("l2_m", "length of the middle shaft"),
    "M1_Nm = driving_torque: torque of the first shaft",
    "M12_secondary_on_shaft1_Nm = first_couple: secondary couple of joint 1 on shaft 1",
    "M12_secondary_on_shaft2_Nm = middle_first: secondary couple of joint 1 on shaft 2",
    "M23_secondary_on_shaft2_Nm = middle_second: secondary couple of joint 2 on shaft 2",
    "M23_secondary_on_shaft3_Nm = last_couple: secondary couple of joint 2 on shaft 3",
    "M2_resultant_secondary_Nm = middle_couple: resultant on shaft 2",
    "N_joint_radial_force_N = pair_force: force in the joints that balances it",
    "N_along_yoke_arm_N = along_arm: its part along the driven arm on shaft 2",
    "N_across_yoke_arm_N = across_arm: its part across that arm",
    "axial_on_shaft1_N = first_axial: axial load of shaft 1",
    "axial_on_shaft3_N = last_axial: axial load of shaft 3",
    "M2_resultant_max_over_turn_Nm: largest resultant on shaft 2 over a turn",
)
def _double_joint_reactions(v: Values) -> Any:
    angles = {"plane_twist": v.beta13, "yoke_angle": v.gamma2, "torque": v.M3}
    joint_angles = v.alpha12, v.alpha23
    found = double_joint_forces(*joint_angles, np.atleast_1d(v.phi1), length=v.l2, **angles)
    largest = largest_middle_couple(*joint_angles, **angles)[0]
    return v.single("phi1", 0)(found), {"M2_resultant_max_over_turn_Nm": largest}


@formula(
    "gyroscopic couple and couple of transverse inertia of the middle shaft of a swinging double joint",
    "Kozhevnikov & Perfil'ev (1978), eq. 125, completed",
    word("description", "words on the case; not used", default=None),
    given("phi1_rad", "angle of the driving yoke from the plane of the joints"),
    given("omega1_rad_s", "spin of the input shaft"),
    given("alpha0_rad", "mean joint angle"),
    given("A_rad", "amplitude of the joint angle"),
    given("W_rad_s", "angular frequency of the joint angle"),
    given("t_s", "time"),
    given("gamma2_rad", "yoke angle of the middle shaft", default=0.0),
    at_least_zero("J_polar_kg_m2", "inertia of the middle shaft about its axis"),
    at_least_zero("J_transverse_kg_m2", "its inertia across, about its centre of mass"),
    "alpha_rad: joint angle",
    "alpha_dot_rad_s: its rate",
    "alpha_ddot_rad_s2: its acceleration",
    "omega2_rad_s: spin of the middle shaft",
    "eps2_rad_s2: its rate",
    "omega3_rad_s: spin of the output shaft",
    "gyroscopic_couple_Nm: gyroscopic couple",
    "transverse_inertia_couple_Nm: couple of transverse inertia",
    "total_transverse_couple_Nm: both together",
    check=_gyro_check,
)
def _moving_axis_gyro(v: Values) -> Any:
    swung = paths.swing(v.A, v.W, 0.0, np.asarray(v.t, dtype=float))
    joint_angle = paths.plus(paths.resting(np.asarray(v.alpha0, dtype=float)), swung)
    axes, spins = parallel_ends(joint_angle, v.phi1, speed=v.omega1, yoke_angle=v.gamma2)
    middle = tuple(one[..., 1, :] for one in axes)
    spin = spins.spin
    found = gyroscopic_couple(middle, spin[..., 1], v.J_polar, v.J_transverse)
    couples = (frames.norm(one) for one in (found.gyroscopic, found.transverse, found.whole))
    return *joint_angle, spin[..., 1], spins.spin_acceleration[..., 1], spin[..., 2], *couples
