"""Several driven axles, and instruments: slot cam, friction drive, disc and roller."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.axles import cascade_ratios, cascade_shares, wind_up
from cardan.book.instruments import (
    Contact,
    SlotCam,
    cam_forces,
    least_press,
    press,
    roller_speed,
    roller_turn,
    speed_ratio,
)
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import refuse
from cardan.reading.given import RIGHT, at_least_zero, given, gives, positive, whole, word
from cardan.texts import _, mark
from cardan.units import deg

formula = Formulas(__doc__)


def _wheels(v: Values) -> Problems:
    """Yield radii in the wrong order, and shares that are not one for each axle."""
    small, large = v.get("wheel_radius_min"), v.get("wheel_radius_max")
    if small is not None and large is not None and small > large:
        text = _("{value:.6g} mm is above {other}, {limit:.6g} mm")
        text = text.format(value=1e3 * small, other=v.key("wheel_radius_max"), limit=1e3 * large)
        yield v.wrong("wheel_radius_min", text, "inconsistent")
    if v.get("axles") is not None:
        yield from v.miscounted(v.axles, "torque_share", code="inconsistent")


JAMS = mark("{value:.6g}° is not above {limit:.6g}°, the angles of friction of slot and guide: the follower jams")


def _jams(v: Values) -> Problems:
    """Yield slots in which a follower jams."""
    for slope, *frictions in (("beta2", "fE", "fN"), ("beta4", "fF", "fS")):
        if slope in v and all(name in v for name in frictions):
            limit = float(sum(np.arctan(v[name]) for name in frictions))
            if v[slope] <= limit:
                text = _(JAMS).format(value=v[slope] / deg, limit=limit / deg)
                yield v.wrong(slope, text, "out_of_range")


@formula(
    "differentials of several driven axles, and how axles wind one another up without them",
    "Kozhevnikov & Perfil'ev (1978), pp. 84–85",
    whole("axles", "number of driven axles", low=1, high=100),
    positive("wheel_radius_max_m", "largest rolling radius"),
    positive("wheel_radius_min_m", "smallest rolling radius"),
    positive("torque_share", "shares of the torque that the axles shall get", axes=1, default=None),
    positive("stiffness_Nm_per_rad", "stiffness of the line between two axles, at the wheels", default=None),
    positive("slip_torque_Nm", "torque at which the wheels of an axle slip", default=None),
    "differentials: differentials that free the axles",
    "simple_ratios: ratio of each with its carrier held, in size",
    "torque_share: share of each axle with these",
    "redundant_loops_without_differentials: closed loops without them",
    gives("windup_rad_per_m", "twist between two axles for each metre travelled [rad/m]", None),
    "relative_slip: difference of the radii over their mean",
    gives("circulating_torque_Nm_per_m", "torque between two axles gained on each metre [N·m/m]", None),
    "slips_after_m: way after which a wheel slips",
    check=_wheels,
)
def _multi_drive(v: Values) -> Any:
    count = v.axles
    share = v.torque_share
    ratios = cascade_ratios(np.ones(count) if share is None else share)
    small, large = v.wheel_radius_min, v.wheel_radius_max
    stiffness, grip = (np.nan if one is None else one for one in (v.stiffness, v.slip_torque))
    wound = wind_up(small, large, stiffness=stiffness, grip=grip)
    known = v.stiffness is not None and wound.rate > 0.0
    return {
        "differentials": count - 1,
        "simple_ratios": ratios if share is not None else list(range(count - 1, 0, -1)),
        "torque_share": cascade_shares(ratios),
        "redundant_loops_without_differentials": count - 1,
        "windup_rad_per_m": wound.rate,
        "relative_slip": wound.slip,
        "circulating_torque_Nm_per_m": wound.torque_rate if known else None,
        "slips_after_m": wound.distance if known and v.slip_torque is not None else None,
    }


@formula(
    "forces on a drum cam with helical slots that shifts two followers against friction",
    "Litvin (6.164)-(6.182), with the balance of the followers restored and the sign of a_41 put right",
    positive("r3_m", "radius of the cam"),
    positive("l_m", "length of the cam"),
    at_least_zero("G3_N", "weight of the cam"),
    at_least_zero("Q2_N", "load of follower 2 along the axis"),
    at_least_zero("Q4_N", "load of follower 4 along the axis"),
    positive("beta2_deg", "slope of slot 2 from the generatrix", high=RIGHT),
    positive("beta4_deg", "slope of slot 4 from the generatrix", high=RIGHT),
    at_least_zero("fE", "friction of slot 2 and its follower"),
    at_least_zero("fF", "friction of slot 4 and its follower"),
    at_least_zero("fN", "friction of follower 2 in its guide"),
    at_least_zero("fS", "friction of follower 4 in its guide"),
    at_least_zero("fC", "friction at the rim of the end that is pushed against the housing"),
    at_least_zero("fC_end", "friction at the plane of that end"),
    at_least_zero("fD", "friction at the rim of the other end"),
    given("psi_deg", "angle at which the driving force acts"),
    given("zE_m", "place of follower 2 along the axis, from the middle"),
    given("zF_m", "place of follower 4"),
    given("zP_m", "place of the driving force"),
    given("zG_m", "place of the centre of mass", default=0.0),
    "R23E_N = first: force of follower 2",
    "R43F_N = second: force of follower 4",
    "P_N = drive: driving force",
    "RCm_N = end: reaction of the end plane",
    "RCn_N = rim: normal reaction at the rim of that end",
    "RDn_N = far: normal reaction at the rim of the other end",
    "xC_m: place of the first, along the weight",
    "yC_m: place of the first, across the weight",
    "xD_m: place of the other, along the weight",
    "yD_m: place of the other, across the weight",
    "sign_zC: 1 or -1: end of the cam that is pushed against the housing",
    "imbalance: largest of the six sums of forces and moments, as a share of the largest force",
    check=_jams,
)
def _helical_cam(v: Values) -> Any:
    cam = SlotCam(
        **v.of(
            radius="r3",
            length="l",
            weight="G3",
            first_slope="beta2",
            second_slope="beta4",
            first_place="zE",
            second_place="zF",
            drive_place="zP",
            weight_place="zG",
            first_friction="fE",
            second_friction="fF",
            first_guide_friction="fN",
            second_guide_friction="fS",
            rim_friction="fC",
            end_friction="fC_end",
            far_friction="fD",
        )
    )
    found = cam_forces(cam, v.Q2, v.Q4, v.psi)
    if found.status == Contact.UNSETTLED:
        raise refuse("fC", _("the reactions do not settle: friction all but stops the cam"), "singular")
    if found.status != Contact.BOTH_ENDS:
        text = _("no reactions at the rims of both ends hold the cam: it touches its housing in another way")
        raise refuse("psi", text, "singular")
    return found, {
        "xC_m": found.rim_point[..., 0],
        "yC_m": found.rim_point[..., 1],
        "xD_m": found.far_point[..., 0],
        "yD_m": found.far_point[..., 1],
        "sign_zC": int(found.end_side),
    }


@formula(
    "how hard two smooth wheels must be pressed together to carry a torque",
    "Litvin (7.1)-(7.3)",
    at_least_zero("torque_Nm", "torque on the driven wheel"),
    positive("radius_m", "radius of that wheel"),
    positive("friction", "coefficient of friction of rest"),
    given("safety", "safety against slipping, usually 2 to 3", low=1.0, default=2.5),
    positive("driving_radius_m", "radius of the driving wheel", default=None),
    "press_min_N: normal force below which the wheels slip",
    "press_N: normal force with the safety",
    "ratio: speed of the driving wheel over that of the driven one",
)
def _friction_drive(v: Values) -> Any:
    torque, radius, friction = (v[name] for name in ("torque", "radius", "friction"))
    ratio = None if v.driving_radius is None else speed_ratio(v.driving_radius, radius)
    return least_press(torque, radius, friction), press(torque, radius, friction, v.safety), ratio


@formula(
    "turn of a roller that moves over a turning disc",
    "Litvin (7.4)",
    given("omega1_rad_s", "speed of the disc"),
    positive("roller_radius_m", "radius of the roller"),
    given("rho_start_m", "distance of the roller from the middle of the disc at the start"),
    given("rho_end_m", "the same at the end"),
    at_least_zero("duration_s", "time between"),
    word("law", "how the roller moves", "linear", default="linear"),
    "phi2_rad: turn of the roller",
    "omega2_start_rad_s: speed of the roller at the start",
    "omega2_end_rad_s: speed of the roller at the end",
    "warnings: dead_zone: the roller crosses the middle of the disc, where it slips",
)
def _disc_integrator(v: Values) -> Any:
    speed, radius = v.omega1, v.roller_radius
    places = np.asarray([v.rho_start, v.rho_end])
    turn = roller_turn(np.asarray([0.0, speed * v.duration]), places, radius)
    start, end = roller_speed(speed, places, radius)
    return turn[-1], start, end, ["dead_zone"] if places[0] * places[1] <= 0.0 else []
