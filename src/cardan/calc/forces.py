"""Calculations of forces: kinetostatics of any drive, single and double joints, clearances, splines, swinging axes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.analysis.double_joint_forces import double_joint_forces, largest_middle_couple
from cardan.analysis.forces import kinetostatics
from cardan.analysis.gap_closure import gap_closure
from cardan.analysis.single_joint_forces import single_joint_forces
from cardan.analysis.spline_thrust import spline_thrust
from cardan.analysis.swing_couple import parallel_ends, swing_couple
from cardan.drive.train import Hold, Train, spline_grip, train_of_points
from cardan.errors import Problem
from cardan.maths import frames, paths
from cardan.texts import _

from .calculation import Calculation, Given, Values, given, gives, rows
from .kinematics import ACCELERATION, ANGLE, RIGHT, START, between, points

SHAFT = given("shaft", _("number of the shaft"), kind="whole", low=1)

BEARING = (
    SHAFT,
    given("x_from_shaft_start_m", _("place from the beginning of the shaft along it"), "length"),
    given("radial", _("whether it holds the shaft sideways"), kind="flag", default=True),
    given("axial", _("whether it holds the shaft lengthwise"), kind="flag", default=False),
)
"""Keys of a bearing in a list of them."""

YOKES = given("gamma_deg", _("yoke angle of shafts 2 to n, driving to driven yoke"), "angle", axes=(1,), default=None)

SPEED = given("omega1_rad_s", _("input speed"), "angular_speed", default=0.0)

LOAD = given("M_out_Nm", _("torque that resists the output"), "torque")

_FREE: dict[str, Any] = {"default": None, "axes": (1,)}

_LENGTHS = {
    "extra_resisting_torque": 1,
    "J": 1,
    "mass": 1,
    "cg_from_shaft_start": 1,
    "cross_inertia_b_c_n": 0,
    "cross_mass": 0,
}
"""Lists with a value for each joint, and for how many shafts more."""


def chain_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what is wrong with the points, and lists without a value for each shaft or joint."""
    yield from between(values, key)
    place = values.get("points")
    if place is None:
        return
    joints = place.shape[0] - 2
    for name, more in _LENGTHS.items():
        value = values.get(name)
        if value is not None and len(value) != joints + more:
            text = _("{given} values given, {wanted} needed")
            yield Problem(key(name), text.format(given=len(value), wanted=joints + more))
    seen: set[int] = set()
    for name in ("bearings", "splines"):
        for k, row in enumerate(values.get(name) or ()):
            if row["shaft"] > joints + 1:
                text = _("row {row}: there is no shaft {number}; the shafts are 1 to {last}")
                yield Problem(key(name), text.format(row=k + 1, number=row["shaft"], last=joints + 1))
            elif name == "splines" and row["shaft"] in seen:
                yield Problem(key(name), _("row {row}: shaft {number} has two").format(row=k + 1, number=row["shaft"]))
            elif name == "bearings" and not (row["radial"] or row["axial"]):
                yield Problem(key(name), _("row {row} holds nothing").format(row=k + 1))
            if name == "splines":
                seen.add(row["shaft"])


def held(row: Values) -> tuple[int, tuple[Hold, ...]]:
    """Return shaft, counted from 0, and holds of a bearing."""
    holds: list[Hold] = [*(["radial"] if row["radial"] else []), *(["axial"] if row["axial"] else [])]  # type: ignore[list-item]
    return row["shaft"] - 1, tuple(holds)


def train_of(values: Values, **parts: Any) -> Train:
    """Return the points, yokes and bearings of a drive given by points."""
    bearings = values.get("bearings") or []
    return train_of_points(
        values["points"],
        yoke_angle=values["gamma"],
        start_phase=values["psi1"],
        bearings=tuple(held(row) for row in bearings),
        position=np.asarray([row["x_from_shaft_start"] for row in bearings]),
        **parts,
    )


def _each(values: Values) -> Callable[[Any], Any]:
    """Return what puts the axis of the positions first, or takes it away where a single angle was given."""
    single = np.ndim(values["phi1"]) == 0

    def first(table: Any) -> Any:
        if table is None:
            return None
        moved = np.moveaxis(table, 1, 0)
        return moved[0] if single else moved

    return first


def _kinetostatics(values: Values) -> Values:
    splines = values["splines"]
    joints = len(values["points"]) - 2
    slide = values["cross_slides_on_pins"]
    whole = train_of(
        values,
        inertia=values["J"],
        mass=values["mass"],
        centre_of_mass=np.zeros(joints + 1) if values["cg_from_shaft_start"] is None else values["cg_from_shaft_start"],
        resisting_torque=values["extra_resisting_torque"],
        cross_inertia=values["cross_inertia_b_c_n"],
        cross_mass=values["cross_mass"],
        gravity=values["gravity"],
        slides=((slide, slide),) * joints,
        splines=tuple(row["shaft"] - 1 for row in splines),
        cut=np.asarray([row["x_from_shaft_start"] for row in splines]),
        grip=np.asarray([spline_grip(row["mu"], row["d"]) for row in splines]),
        sliding=np.asarray([float(row["direction"]) for row in splines]),
    )
    found = kinetostatics(
        whole,
        np.atleast_1d(np.asarray(values["phi1"], dtype=float)),
        torque=values["M_out"],
        speed=values["omega1"],
        acceleration=values["eps1"],
        field="bearings",
    )
    at = _each(values)
    return {
        "M_in_Nm": at(found.shaft_torque)[..., 0],
        "shaft_torque_Nm": at(found.shaft_torque),
        "omega_rad_s": at(found.speed),
        "eps_rad_s2": at(found.acceleration),
        "couple_on_driving_yoke_Nm": at(-found.driving_couple),
        "couple_on_driven_yoke_Nm": at(found.driven_couple),
        "joint_force_on_driven_shaft_N": at(found.joint_force),
        "bearing_reaction_N": at(found.reaction),
        "secondary_couple_on_shaft_Nm": at(found.secondary_couple),
        "equations": found.equations,
        "unknowns": found.unknowns,
    }


def _single(values: Values) -> Values:
    located = values["variant"] == "located_cross"
    found = single_joint_forces(
        values["alpha"],
        values["phi1"],
        values["M2"],
        span=values["d_pin_span"],
        bearing_span=values["a1_bearing_span"],
        overhang=values["c1_overhang"],
        reach=values["b2_joint_to_bearing" if located else "a2_bearing_span"],
        located=located,
    )
    return {
        "M1_Nm": found.driving_torque,
        "R_pin_inplane_N": found.journal,
        "R_B_tangential_N": found.driving_across,
        "R_B_yoke_plane_N": found.driving_along,
        "R_C_tangential_N": found.driven_across,
        "R_C_yoke_plane_N": found.driven_along,
        "R_bearing1_far_radial_N": found.far,
        "R_bearing1_near_radial_N": found.near,
        "R_bearing1_axial_N": found.axial,
        "R_bearing2_near_or_only_N": found.driven_bearing,
        "omega2_over_omega1": found.ratio,
    }


def _single_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    variant = values.get("variant")
    if variant is None:
        return
    name, other = "a2_bearing_span", "b2_joint_to_bearing"
    needed, spare = (other, name) if variant == "located_cross" else (name, other)
    if values.get(needed, 0.0) is None:
        yield Problem(key(needed), _("missing; {variant} needs it").format(variant=variant))
    if values.get(spare) is not None:
        yield Problem(key(spare), _("{variant} has no use for it").format(variant=variant))


def _double(values: Values) -> Values:
    angles = {"plane_twist": values["beta13"], "yoke_angle": values["gamma2"], "torque": values["M3"]}
    bends = values["alpha12"], values["alpha23"]
    found = double_joint_forces(*bends, np.atleast_1d(values["phi1"]), length=values["l2"], **angles)
    single = np.ndim(values["phi1"]) == 0

    def at(table: Any) -> Any:
        return table[0] if single else table

    return {
        "M1_Nm": at(found.driving_torque),
        "M12_secondary_on_shaft1_Nm": at(found.first_couple),
        "M12_secondary_on_shaft2_Nm": at(found.middle_first),
        "M23_secondary_on_shaft2_Nm": at(found.middle_second),
        "M23_secondary_on_shaft3_Nm": at(found.last_couple),
        "M2_resultant_secondary_Nm": at(found.middle_couple),
        "N_joint_radial_force_N": at(found.pair_force),
        "N_along_yoke_arm_N": at(found.along_arm),
        "N_across_yoke_arm_N": at(found.across_arm),
        "axial_on_shaft1_N": at(found.first_axial),
        "axial_on_shaft3_N": at(found.last_axial),
        "M2_resultant_max_over_turn_Nm": largest_middle_couple(*bends, **angles)[0],
    }


def _closure(values: Values) -> Values:
    found = gap_closure(
        train_of(values, inertia=values["J"]),
        load=values["M_out"],
        speed=values["omega1"],
        acceleration=values["eps1"],
    )
    return {
        "min_pin_couple_over_turn_Nm": found.least_couple,
        "phi1_at_min_deg": found.least_angle,
        "min_M_out_for_closure_Nm": found.load_needed,
        "closed": found.closed,
        "open_share_of_turn": found.open_share,
        "phi1_at_sign_changes_deg": list(found.openings),
    }


def _spline(values: Values) -> Values:
    grip = spline_grip(values["mu"], values["d_spline"])
    found = spline_thrust(values["alpha"], values["phi1"], values["M2"], grip)
    return {
        "T_N": found.thrust,
        "axial_on_shaft1_N": found.axial,
        "radial_on_shaft1_N": found.radial,
        "along_pin_B_N": found.along_driving_arm,
        "along_pin_C_N": found.along_driven_arm,
        "along_cross_normal_N": found.along_normal,
    }


def _gyro(values: Values) -> Values:
    swung = paths.swing(values["A"], values["W"], 0.0, np.asarray(values["t"], dtype=float))
    bend = paths.plus(paths.resting(np.asarray(values["alpha0"], dtype=float)), swung)
    axes, spins = parallel_ends(bend, values["phi1"], speed=values["omega1"], yoke_angle=values["gamma2"])
    middle = axes[0][..., 1, :], axes[1][..., 1, :], axes[2][..., 1, :]
    found = swing_couple(middle, spins.spin[..., 1], values["J_polar"], values["J_transverse"])
    return {
        "alpha_rad": bend[0],
        "alpha_dot_rad_s": bend[1],
        "alpha_ddot_rad_s2": bend[2],
        "omega2_rad_s": spins.spin[..., 1],
        "eps2_rad_s2": spins.spin_acceleration[..., 1],
        "omega3_rad_s": spins.spin[..., 2],
        "gyroscopic_couple_Nm": frames.norm(found.gyroscopic),
        "transverse_inertia_couple_Nm": frames.norm(found.transverse),
        "total_transverse_couple_Nm": frames.norm(found.whole),
    }


def _gyro_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if "alpha0" in values and "A" in values and abs(values["alpha0"]) + abs(values["A"]) >= RIGHT:
        yield Problem(key("alpha0"), _("the bend reaches 90° with the given amplitude"))


def _size(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, "length", **{"above": 0.0} | options)


CALCULATIONS = (
    Calculation(
        name="kinetostatics",
        doc=_("torques, secondary couples, joint forces and bearing reactions of any drive, with inertia and weight"),
        source="Book pp. 129-150",
        takes=(
            points(),
            START,
            YOKES,
            ANGLE,
            SPEED,
            ACCELERATION,
            LOAD,
            given("extra_resisting_torque_Nm", _("torque that resists each shaft"), "torque", **_FREE),
            given("J_kg_m2", _("inertia of each shaft about its axis"), "inertia", low=0.0, **_FREE),
            given("mass_kg", _("mass of each shaft"), "mass", low=0.0, **_FREE),
            given("cg_from_shaft_start_m", _("centre of mass of each shaft from its beginning"), "length", **_FREE),
            given("gravity_m_s2", _("acceleration of free fall"), "acceleration", axes=(1,), width=3, default=None),
            given(
                "cross_inertia_b_c_n_kg_m2",
                _("inertia of each cross about driving journals, driven journals and normal"),
                "inertia",
                low=0.0,
                axes=(2,),
                width=3,
                default=None,
            ),
            given("cross_mass_kg", _("mass of each cross"), "mass", low=0.0, **_FREE),
            given(
                "cross_slides_on_pins", _("whether every cross slides along its journals"), kind="flag", default=False
            ),
            rows("bearings", _("what holds the shafts"), *BEARING),
            rows(
                "splines",
                _("sliding splines"),
                SHAFT,
                given("x_from_shaft_start_m", _("place from the beginning of the shaft along it"), "length"),
                given("mu", _("coefficient of friction"), low=0.0, default=0.0),
                _size("d_m", _("mean diameter")),
                given(
                    "direction", _("+1 where friction pushes the parts apart, -1 where it pulls"), low=-1.0, high=1.0
                ),
                default=(),
            ),
        ),
        returns=(
            gives("M_in_Nm", _("torque that drives the input"), "torque"),
            gives("shaft_torque_Nm", _("torque that enters each shaft"), "torque"),
            gives("omega_rad_s", _("speed of each shaft"), "angular_speed"),
            gives("eps_rad_s2", _("acceleration of each shaft"), "angular_acceleration"),
            gives("couple_on_driving_yoke_Nm", _("couple of each cross on its driving yoke"), "torque"),
            gives("couple_on_driven_yoke_Nm", _("couple of each cross on its driven yoke"), "torque"),
            gives("joint_force_on_driven_shaft_N", _("force in each joint centre on the driven shaft"), "force"),
            gives("bearing_reaction_N", _("force of each bearing on its shaft"), "force"),
            gives("secondary_couple_on_shaft_Nm", _("couple across each shaft"), "torque"),
            gives("equations", _("number of equations")),
            gives("unknowns", _("number of unknowns")),
        ),
        answer=_kinetostatics,
        check=chain_check,
    ),
    Calculation(
        name="joint_reactions",
        doc=_("torques, journal loads and bearing loads of a single joint at constant torque of the driven shaft"),
        source="Book (100)-(112), corrected",
        takes=(
            given("variant", _("how the cross is held"), kind="word", choices=("sliding_cross", "located_cross")),
            given("alpha_deg", _("bend"), "angle", low=0.0, below=RIGHT),
            given("phi1_deg", _("angle of the driving yoke from the plane of the joint"), "angle", axes=(0, 1)),
            given("M2_Nm", _("torque of the driven shaft"), "torque"),
            _size("d_pin_span_m", _("span of the cross")),
            _size("a1_bearing_span_m", _("distance of the bearings of shaft 1")),
            given("c1_overhang_m", _("distance of the joint from the near bearing of shaft 1"), "length", low=0.0),
            _size("a2_bearing_span_m", _("distance of the bearings of shaft 2, sliding cross"), default=None),
            _size("b2_joint_to_bearing_m", _("distance of the bearing of shaft 2, located cross"), default=None),
        ),
        returns=(
            gives("M1_Nm", _("torque of the driving shaft"), "torque"),
            gives("R_pin_inplane_N", _("load of each journal in the plane of the cross"), "force"),
            gives("R_B_tangential_N", _("its part across the driving yoke"), "force"),
            gives("R_B_yoke_plane_N", _("its part in the plane of the driving yoke"), "force"),
            gives("R_C_tangential_N", _("its part across the driven yoke"), "force"),
            gives("R_C_yoke_plane_N", _("its part in the plane of the driven yoke"), "force"),
            gives("R_bearing1_far_radial_N", _("radial load of the far bearing of shaft 1"), "force"),
            gives("R_bearing1_near_radial_N", _("radial load of its near bearing"), "force"),
            gives("R_bearing1_axial_N", _("axial load of shaft 1"), "force"),
            gives("R_bearing2_near_or_only_N", _("radial load of each bearing of shaft 2"), "force"),
            gives("omega2_over_omega1", _("speed ratio")),
        ),
        answer=_single,
        check=_single_check,
    ),
    Calculation(
        name="double_joint_reactions",
        doc=_("secondary couples of a double joint and the pair of forces that balances those of the middle shaft"),
        source="Book (113)-(120), corrected",
        takes=(
            given("alpha12_deg", _("bend of joint 1"), "angle", low=0.0, below=RIGHT),
            given("alpha23_deg", _("bend of joint 2"), "angle", low=0.0, below=RIGHT),
            given("beta13_deg", _("plane twist of joint 2"), "angle", default=0.0),
            given("gamma2_deg", _("yoke angle of shaft 2"), "angle", default=0.0),
            given("phi1_deg", _("angle of the driving yoke from the plane of joint 1"), "angle", axes=(0, 1)),
            given("M3_Nm", _("torque of the last shaft"), "torque"),
            _size("l2_m", _("length of the middle shaft")),
        ),
        returns=(
            gives("M1_Nm", _("torque of the first shaft"), "torque"),
            gives("M12_secondary_on_shaft1_Nm", _("secondary couple of joint 1 on shaft 1"), "torque"),
            gives("M12_secondary_on_shaft2_Nm", _("secondary couple of joint 1 on shaft 2"), "torque"),
            gives("M23_secondary_on_shaft2_Nm", _("secondary couple of joint 2 on shaft 2"), "torque"),
            gives("M23_secondary_on_shaft3_Nm", _("secondary couple of joint 2 on shaft 3"), "torque"),
            gives("M2_resultant_secondary_Nm", _("resultant on shaft 2"), "torque"),
            gives("N_joint_radial_force_N", _("force in the joints that balances it"), "force"),
            gives("N_along_yoke_arm_N", _("its part along the driven arm on shaft 2"), "force"),
            gives("N_across_yoke_arm_N", _("its part across that arm"), "force"),
            gives("axial_on_shaft1_N", _("axial load of shaft 1"), "force"),
            gives("axial_on_shaft3_N", _("axial load of shaft 3"), "force"),
            gives("M2_resultant_max_over_turn_Nm", _("largest resultant on shaft 2 over a turn"), "torque"),
        ),
        answer=_double,
    ),
    Calculation(
        name="gap_closure",
        doc=_("whether the load keeps the clearances of all joints closed against inertia over a turn"),
        source="Book (121), (122) for any drive",
        takes=(
            points(),
            START,
            YOKES,
            SPEED,
            ACCELERATION,
            LOAD,
            given("J_kg_m2", _("inertia of each shaft about its axis"), "inertia", low=0.0, axes=(1,)),
        ),
        returns=(
            gives("min_pin_couple_over_turn_Nm", _("least couple of each joint over a turn"), "torque"),
            gives("phi1_at_min_deg", _("input angle where it occurs"), "angle"),
            gives("min_M_out_for_closure_Nm", _("least load that keeps all joints closed"), "torque"),
            gives("closed", _("whether all joints stay closed")),
            gives("open_share_of_turn", _("share of the turn in which the couple of each joint is reversed")),
            gives("phi1_at_sign_changes_deg", _("input angles where the couple of each joint turns about"), "angle"),
        ),
        answer=_closure,
        check=chain_check,
    ),
    Calculation(
        name="spline_axial_force",
        doc=_("friction thrust of the spline of the driven shaft and its parts in the joint"),
        source="Book (123), (124), corrected",
        takes=(
            given("alpha_deg", _("bend"), "angle", low=0.0, below=RIGHT),
            given("phi1_deg", _("angle of the driving yoke from the plane of the joint"), "angle", axes=(0, 1)),
            given("M2_Nm", _("torque at the spline"), "torque"),
            given("mu", _("coefficient of friction of the spline"), low=0.0),
            _size("d_spline_m", _("mean diameter of the spline")),
        ),
        returns=(
            gives("T_N", _("friction thrust"), "force"),
            gives("axial_on_shaft1_N", _("its part along shaft 1"), "force"),
            gives("radial_on_shaft1_N", _("its part across shaft 1"), "force"),
            gives("along_pin_B_N", _("its part along the driving journals"), "force"),
            gives("along_pin_C_N", _("its part along the driven journals"), "force"),
            gives("along_cross_normal_N", _("its part along the normal of the cross"), "force"),
        ),
        answer=_spline,
    ),
    Calculation(
        name="moving_axis_gyro",
        doc=_("gyroscopic couple and couple of transverse inertia of the middle shaft of a swinging double joint"),
        source="Book (125), completed",
        takes=(
            given("description", _("words on the case; not used"), kind="word", default=None),
            given("phi1_rad", _("angle of the driving yoke from the plane of the joints"), "angle"),
            given("omega1_rad_s", _("spin of the input shaft"), "angular_speed"),
            given("alpha0_rad", _("mean bend"), "angle"),
            given("A_rad", _("amplitude of the bend"), "angle"),
            given("W_rad_s", _("angular frequency of the bend"), "angular_speed"),
            given("t_s", _("time"), "time"),
            given("gamma2_rad", _("yoke angle of the middle shaft"), "angle", default=0.0),
            given("J_polar_kg_m2", _("inertia of the middle shaft about its axis"), "inertia", low=0.0),
            given("J_transverse_kg_m2", _("its inertia across, about its centre of mass"), "inertia", low=0.0),
        ),
        returns=(
            gives("alpha_rad", _("bend"), "angle"),
            gives("alpha_dot_rad_s", _("its rate"), "angular_speed"),
            gives("alpha_ddot_rad_s2", _("its acceleration"), "angular_acceleration"),
            gives("omega2_rad_s", _("spin of the middle shaft"), "angular_speed"),
            gives("eps2_rad_s2", _("its rate"), "angular_acceleration"),
            gives("omega3_rad_s", _("spin of the output shaft"), "angular_speed"),
            gives("gyroscopic_couple_Nm", _("gyroscopic couple"), "torque"),
            gives("transverse_inertia_couple_Nm", _("couple of transverse inertia"), "torque"),
            gives("total_transverse_couple_Nm", _("both together"), "torque"),
        ),
        answer=_gyro,
        check=_gyro_check,
    ),
)
