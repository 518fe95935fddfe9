"""Forces in one joint or two: closed forms, splines, swinging axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.double_joint_forces import double_joint_forces, largest_middle_couple
from cardan.book.single_joint_forces import single_joint_forces
from cardan.book.spline_thrust import spline_thrust
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.drive.models.train import spline_grip
from cardan.maths.curves import paths
from cardan.maths.kernel import frames
from cardan.questions.forces.swing_couple import parallel_ends, swing_couple
from cardan.reading.given import RIGHT, at_least_zero, given, positive, word, yoke_rotation
from cardan.texts import _

formula = Formulas(__doc__)


def _single_check(v: Values) -> Problems:
    variant = v.get("variant")
    if variant is None:
        return
    name, other = "a2_bearing_span", "b2_joint_to_bearing"
    needed, spare = (other, name) if variant == "located_cross" else (name, other)
    if v.get(needed, 0.0) is None:
        yield v.wrong(needed, _("missing; {variant} needs it").format(variant=variant))
    if v.get(spare) is not None:
        yield v.wrong(spare, _("{variant} has no use for it").format(variant=variant))


def _gyro_check(v: Values) -> Problems:
    if "alpha0" in v and "A" in v and abs(v.alpha0) + abs(v.A) >= RIGHT:
        yield v.wrong("alpha0", _("the joint angle reaches 90° with the given amplitude"))


IN_THE_JOINT = Formulas("the friction thrust of a spline and its parts in the joint before it")


@IN_THE_JOINT(
    "friction thrust of the spline of the driven shaft and its parts in the joint",
    "Book (123), (124), corrected",
    yoke_rotation("alpha_deg", "joint_angle"),
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
    "Book (100)-(112), corrected",
    word("variant", "how the cross is held", "sliding_cross", "located_cross"),
    yoke_rotation("alpha_deg", "joint_angle"),
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
    "Book (113)-(120), corrected",
    yoke_rotation("alpha12_deg", "joint angle of joint 1"),
    yoke_rotation("alpha23_deg", "joint angle of joint 2"),
    given("beta13_deg", "plane twist of joint 2", default=0.0),
    given("gamma2_deg", "yoke angle of shaft 2", default=0.0),
    given("phi1_deg", "angle of the driving yoke from the plane of joint 1", axes=(0, 1)),
    given("M3_Nm", "torque of the last shaft"),
    positive("l2_m", "length of the middle shaft"),
    "M1_Nm: torque of the first shaft",
    "M12_secondary_on_shaft1_Nm: secondary couple of joint 1 on shaft 1",
    "M12_secondary_on_shaft2_Nm: secondary couple of joint 1 on shaft 2",
    "M23_secondary_on_shaft2_Nm: secondary couple of joint 2 on shaft 2",
    "M23_secondary_on_shaft3_Nm: secondary couple of joint 2 on shaft 3",
    "M2_resultant_secondary_Nm: resultant on shaft 2",
    "N_joint_radial_force_N: force in the joints that balances it",
    "N_along_yoke_arm_N: its part along the driven arm on shaft 2",
    "N_across_yoke_arm_N: its part across that arm",
    "axial_on_shaft1_N: axial load of shaft 1",
    "axial_on_shaft3_N: axial load of shaft 3",
    "M2_resultant_max_over_turn_Nm: largest resultant on shaft 2 over a turn",
)
def _double_joint_reactions(v: Values) -> Any:
    angles = {"plane_twist": v.beta13, "yoke_angle": v.gamma2, "torque": v.M3}
    joint_angles = v.alpha12, v.alpha23
    found = double_joint_forces(*joint_angles, np.atleast_1d(v.phi1), length=v.l2, **angles)
    single = np.ndim(v.phi1) == 0

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
        "M2_resultant_max_over_turn_Nm": largest_middle_couple(*joint_angles, **angles)[0],
    }


@formula(
    "gyroscopic couple and couple of transverse inertia of the middle shaft of a swinging double joint",
    "Book (125), completed",
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
    "alpha_rad: bend",
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
    middle = axes[0][..., 1, :], axes[1][..., 1, :], axes[2][..., 1, :]
    found = swing_couple(middle, spins.spin[..., 1], v.J_polar, v.J_transverse)
    return {
        "alpha_rad": joint_angle[0],
        "alpha_dot_rad_s": joint_angle[1],
        "alpha_ddot_rad_s2": joint_angle[2],
        "omega2_rad_s": spins.spin[..., 1],
        "eps2_rad_s2": spins.spin_acceleration[..., 1],
        "omega3_rad_s": spins.spin[..., 2],
        "gyroscopic_couple_Nm": frames.norm(found.gyroscopic),
        "transverse_inertia_couple_Nm": frames.norm(found.transverse),
        "total_transverse_couple_Nm": frames.norm(found.whole),
    }
