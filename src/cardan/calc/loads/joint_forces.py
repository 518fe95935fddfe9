"""Calculations of forces in one joint or two: closed forms, splines, swinging axes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.book.double_joint_forces import double_joint_forces, largest_middle_couple
from cardan.book.single_joint_forces import single_joint_forces
from cardan.book.spline_thrust import spline_thrust
from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.calc.motion.kinematics import RIGHT
from cardan.drive.models.train import spline_grip
from cardan.errors import Problem
from cardan.maths.curves import paths
from cardan.maths.kernel import frames
from cardan.questions.forces.swing_couple import parallel_ends, swing_couple
from cardan.texts import _, mark

from .forces import size


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
    joint_angles = values["alpha12"], values["alpha23"]
    found = double_joint_forces(*joint_angles, np.atleast_1d(values["phi1"]), length=values["l2"], **angles)
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
        "M2_resultant_max_over_turn_Nm": largest_middle_couple(*joint_angles, **angles)[0],
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
    joint_angle = paths.plus(paths.resting(np.asarray(values["alpha0"], dtype=float)), swung)
    axes, spins = parallel_ends(joint_angle, values["phi1"], speed=values["omega1"], yoke_angle=values["gamma2"])
    middle = axes[0][..., 1, :], axes[1][..., 1, :], axes[2][..., 1, :]
    found = swing_couple(middle, spins.spin[..., 1], values["J_polar"], values["J_transverse"])
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


def _gyro_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if "alpha0" in values and "A" in values and abs(values["alpha0"]) + abs(values["A"]) >= RIGHT:
        yield Problem(key("alpha0"), _("the joint angle reaches 90° with the given amplitude"))


SPLINE_THRUST = Calculation(
    name="spline_axial_force",
    doc=mark("friction thrust of the spline of the driven shaft and its parts in the joint"),
    source="Kozhevnikov & Perfil'ev (1978), eq. 123, 124, corrected",
    takes=(
        given("alpha_deg", mark("joint angle"), "angle", low=0.0, below=RIGHT),
        given("phi1_deg", mark("angle of the driving yoke from the plane of the joint"), "angle", axes=(0, 1)),
        given("M2_Nm", mark("torque at the spline"), "torque"),
        given("mu", mark("coefficient of friction of the spline"), low=0.0),
        size("d_spline_m", mark("mean diameter of the spline")),
    ),
    returns=(
        gives("T_N", mark("friction thrust"), "force"),
        gives("axial_on_shaft1_N", mark("its part along shaft 1"), "force"),
        gives("radial_on_shaft1_N", mark("its part across shaft 1"), "force"),
        gives("along_pin_B_N", mark("its part along the driving journals"), "force"),
        gives("along_pin_C_N", mark("its part along the driven journals"), "force"),
        gives("along_cross_normal_N", mark("its part along the normal of the cross"), "force"),
    ),
    answer=_spline,
)
"""The thrust of a spline and its parts in the joint before it."""

CALCULATIONS = (
    Calculation(
        name="joint_reactions",
        doc=mark("torques, journal loads and bearing loads of a single joint at constant torque of the driven shaft"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 100–112, corrected",
        takes=(
            given("variant", mark("how the cross is held"), kind="word", choices=("sliding_cross", "located_cross")),
            given("alpha_deg", mark("joint angle"), "angle", low=0.0, below=RIGHT),
            given("phi1_deg", mark("angle of the driving yoke from the plane of the joint"), "angle", axes=(0, 1)),
            given("M2_Nm", mark("torque of the driven shaft"), "torque"),
            size("d_pin_span_m", mark("span of the cross")),
            size("a1_bearing_span_m", mark("distance of the bearings of shaft 1")),
            given("c1_overhang_m", mark("distance of the joint from the near bearing of shaft 1"), "length", low=0.0),
            size("a2_bearing_span_m", mark("distance of the bearings of shaft 2, sliding cross"), default=None),
            size("b2_joint_to_bearing_m", mark("distance of the bearing of shaft 2, located cross"), default=None),
        ),
        returns=(
            gives("M1_Nm", mark("torque of the driving shaft"), "torque"),
            gives("R_pin_inplane_N", mark("load of each journal in the plane of the cross"), "force"),
            gives("R_B_tangential_N", mark("its part across the driving yoke"), "force"),
            gives("R_B_yoke_plane_N", mark("its part in the plane of the driving yoke"), "force"),
            gives("R_C_tangential_N", mark("its part across the driven yoke"), "force"),
            gives("R_C_yoke_plane_N", mark("its part in the plane of the driven yoke"), "force"),
            gives("R_bearing1_far_radial_N", mark("radial load of the far bearing of shaft 1"), "force"),
            gives("R_bearing1_near_radial_N", mark("radial load of its near bearing"), "force"),
            gives("R_bearing1_axial_N", mark("axial load of shaft 1"), "force"),
            gives("R_bearing2_near_or_only_N", mark("radial load of each bearing of shaft 2"), "force"),
            gives("omega2_over_omega1", mark("speed ratio")),
        ),
        answer=_single,
        check=_single_check,
    ),
    Calculation(
        name="double_joint_reactions",
        doc=mark("secondary couples of a double joint and the pair of forces that balances those of the middle shaft"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 113–120, corrected",
        takes=(
            given("alpha12_deg", mark("joint angle of joint 1"), "angle", low=0.0, below=RIGHT),
            given("alpha23_deg", mark("joint angle of joint 2"), "angle", low=0.0, below=RIGHT),
            given("beta13_deg", mark("plane twist of joint 2"), "angle", default=0.0),
            given("gamma2_deg", mark("yoke angle of shaft 2"), "angle", default=0.0),
            given("phi1_deg", mark("angle of the driving yoke from the plane of joint 1"), "angle", axes=(0, 1)),
            given("M3_Nm", mark("torque of the last shaft"), "torque"),
            size("l2_m", mark("length of the middle shaft")),
        ),
        returns=(
            gives("M1_Nm", mark("torque of the first shaft"), "torque"),
            gives("M12_secondary_on_shaft1_Nm", mark("secondary couple of joint 1 on shaft 1"), "torque"),
            gives("M12_secondary_on_shaft2_Nm", mark("secondary couple of joint 1 on shaft 2"), "torque"),
            gives("M23_secondary_on_shaft2_Nm", mark("secondary couple of joint 2 on shaft 2"), "torque"),
            gives("M23_secondary_on_shaft3_Nm", mark("secondary couple of joint 2 on shaft 3"), "torque"),
            gives("M2_resultant_secondary_Nm", mark("resultant on shaft 2"), "torque"),
            gives("N_joint_radial_force_N", mark("force in the joints that balances it"), "force"),
            gives("N_along_yoke_arm_N", mark("its part along the driven arm on shaft 2"), "force"),
            gives("N_across_yoke_arm_N", mark("its part across that arm"), "force"),
            gives("axial_on_shaft1_N", mark("axial load of shaft 1"), "force"),
            gives("axial_on_shaft3_N", mark("axial load of shaft 3"), "force"),
            gives("M2_resultant_max_over_turn_Nm", mark("largest resultant on shaft 2 over a turn"), "torque"),
        ),
        answer=_double,
    ),
    Calculation(
        name="moving_axis_gyro",
        doc=mark("gyroscopic couple and couple of transverse inertia of the middle shaft of a swinging double joint"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 125, completed",
        takes=(
            given("description", mark("words on the case; not used"), kind="word", default=None),
            given("phi1_rad", mark("angle of the driving yoke from the plane of the joints"), "angle"),
            given("omega1_rad_s", mark("spin of the input shaft"), "angular_speed"),
            given("alpha0_rad", mark("mean joint angle"), "angle"),
            given("A_rad", mark("amplitude of the joint angle"), "angle"),
            given("W_rad_s", mark("angular frequency of the joint angle"), "angular_speed"),
            given("t_s", mark("time"), "time"),
            given("gamma2_rad", mark("yoke angle of the middle shaft"), "angle", default=0.0),
            given("J_polar_kg_m2", mark("inertia of the middle shaft about its axis"), "inertia", low=0.0),
            given("J_transverse_kg_m2", mark("its inertia across, about its centre of mass"), "inertia", low=0.0),
        ),
        returns=(
            gives("alpha_rad", mark("joint angle"), "angle"),
            gives("alpha_dot_rad_s", mark("its rate"), "angular_speed"),
            gives("alpha_ddot_rad_s2", mark("its acceleration"), "angular_acceleration"),
            gives("omega2_rad_s", mark("spin of the middle shaft"), "angular_speed"),
            gives("eps2_rad_s2", mark("its rate"), "angular_acceleration"),
            gives("omega3_rad_s", mark("spin of the output shaft"), "angular_speed"),
            gives("gyroscopic_couple_Nm", mark("gyroscopic couple"), "torque"),
            gives("transverse_inertia_couple_Nm", mark("couple of transverse inertia"), "torque"),
            gives("total_transverse_couple_Nm", mark("both together"), "torque"),
        ),
        answer=_gyro,
        check=_gyro_check,
    ),
)
