"""Calculations of several driven axles and of instruments: slot cam, friction drive, disc and roller."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.book.axles import cascade_ratios, cascade_shares, wind_up
from cardan.book.disc_integrator import roller_speed, roller_turn
from cardan.book.friction_drive import least_press, press, speed_ratio
from cardan.book.slot_cam import Contact, SlotCam, cam_forces
from cardan.calc.calculation import Calculation, Given, Values, at_least_zero, given, gives, positive
from cardan.errors import Problem, refuse
from cardan.texts import _, mark
from cardan.units import deg

from .kinematics import RIGHT


def _axles(values: Values) -> Values:
    count = values["axles"]
    share = values["torque_share"]
    ratios = cascade_ratios(np.ones(count) if share is None else share)
    small, large = values["wheel_radius_min"], values["wheel_radius_max"]
    stiffness, grip = (np.nan if one is None else one for one in (values["stiffness"], values["slip_torque"]))
    wound = wind_up(small, large, stiffness=stiffness, grip=grip)
    known = values["stiffness"] is not None and wound.rate > 0.0
    return {
        "differentials": count - 1,
        "simple_ratios": ratios if share is not None else list(range(count - 1, 0, -1)),
        "torque_share": cascade_shares(ratios),
        "redundant_loops_without_differentials": count - 1,
        "windup_rad_per_m": wound.rate,
        "relative_slip": wound.slip,
        "circulating_torque_Nm_per_m": wound.torque_rate if known else None,
        "slips_after_m": wound.distance if known and values["slip_torque"] is not None else None,
    }


def _wheels(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield radii in the wrong order, and shares that are not one for each axle."""
    small, large = values.get("wheel_radius_min"), values.get("wheel_radius_max")
    if small is not None and large is not None and small > large:
        text = _("{value:.6g} mm is above {other}, {limit:.6g} mm")
        text = text.format(value=1e3 * small, other=key("wheel_radius_max"), limit=1e3 * large)
        yield Problem(key("wheel_radius_min"), text, "inconsistent")
    share, count = values.get("torque_share"), values.get("axles")
    if share is not None and count is not None and len(share) != count:
        text = _("{given} values given, {wanted} needed").format(given=len(share), wanted=count)
        yield Problem(key("torque_share"), text, "inconsistent")


JAMS = mark("{value:.6g}° is not above {limit:.6g}°, the angles of friction of slot and guide: the follower jams")


def _cam(values: Values) -> Values:
    cam = SlotCam(
        radius=values["r3"],
        length=values["l"],
        weight=values["G3"],
        first_slope=values["beta2"],
        second_slope=values["beta4"],
        first_place=values["zE"],
        second_place=values["zF"],
        drive_place=values["zP"],
        weight_place=values["zG"],
        first_friction=values["fE"],
        second_friction=values["fF"],
        first_guide_friction=values["fN"],
        second_guide_friction=values["fS"],
        rim_friction=values["fC"],
        end_friction=values["fC_end"],
        far_friction=values["fD"],
    )
    found = cam_forces(cam, values["Q2"], values["Q4"], values["psi"])
    if found.status == Contact.UNSETTLED:
        raise refuse("fC", _("the reactions do not settle: friction all but stops the cam"), "singular")
    if found.status != Contact.BOTH_ENDS:
        text = _("no reactions at the rims of both ends hold the cam: it touches its housing in another way")
        raise refuse("psi", text, "singular")
    return {
        "R23E_N": found.first,
        "R43F_N": found.second,
        "P_N": found.drive,
        "RCm_N": found.end,
        "RCn_N": found.rim,
        "RDn_N": found.far,
        "xC_m": found.rim_point[..., 0],
        "yC_m": found.rim_point[..., 1],
        "xD_m": found.far_point[..., 0],
        "yD_m": found.far_point[..., 1],
        "sign_zC": int(found.end_side),
        "imbalance": found.imbalance,
    }


def _jams(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield slots in which a follower jams."""
    for slope, *frictions in (("beta2", "fE", "fN"), ("beta4", "fF", "fS")):
        if slope in values and all(name in values for name in frictions):
            limit = float(sum(np.arctan(values[name]) for name in frictions))
            if values[slope] <= limit:
                text = _(JAMS).format(value=values[slope] / deg, limit=limit / deg)
                yield Problem(key(slope), text, "out_of_range")


def _press(values: Values) -> Values:
    torque, radius, friction = (values[name] for name in ("torque", "radius", "friction"))
    driving = values["driving_radius"]
    return {
        "press_min_N": least_press(torque, radius, friction),
        "press_N": press(torque, radius, friction, values["safety"]),
        "ratio": None if driving is None else speed_ratio(driving, radius),
    }


def _disc(values: Values) -> Values:
    speed, radius = values["omega1"], values["roller_radius"]
    places = np.asarray([values["rho_start"], values["rho_end"]])
    turn = roller_turn(np.asarray([0.0, speed * values["duration"]]), places, radius)
    start, end = roller_speed(speed, places, radius)
    return {
        "phi2_rad": turn[-1],
        "omega2_start_rad_s": start,
        "omega2_end_rad_s": end,
        "warnings": ["dead_zone"] if places[0] * places[1] <= 0.0 else [],
    }


def _friction(key: str, doc: str) -> Given:
    return at_least_zero(key, doc)


def _place(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, "length", **options)


CALCULATIONS = (
    Calculation(
        name="multi_drive",
        doc=mark("differentials of several driven axles, and how axles wind one another up without them"),
        source="Kozhevnikov & Perfil'ev (1978), pp. 84–85",
        takes=(
            given("axles", mark("number of driven axles"), kind="whole", low=1, high=100),
            positive("wheel_radius_max_m", mark("largest rolling radius"), "length"),
            positive("wheel_radius_min_m", mark("smallest rolling radius"), "length"),
            positive("torque_share", mark("shares of the torque that the axles shall get"), axes=(1,), default=None),
            positive(
                "stiffness_Nm_per_rad",
                mark("stiffness of the line between two axles, at the wheels"),
                "turning_stiffness",
                default=None,
            ),
            positive("slip_torque_Nm", mark("torque at which the wheels of an axle slip"), "torque", default=None),
        ),
        returns=(
            gives("differentials", mark("differentials that free the axles")),
            gives("simple_ratios", mark("ratio of each with its carrier held, in size")),
            gives("torque_share", mark("share of each axle with these")),
            gives("redundant_loops_without_differentials", mark("closed loops without them")),
            gives("windup_rad_per_m", mark("twist between two axles for each metre travelled [rad/m]")),
            gives("relative_slip", mark("difference of the radii over their mean")),
            gives("circulating_torque_Nm_per_m", mark("torque between two axles gained on each metre [N·m/m]")),
            gives("slips_after_m", mark("way after which a wheel slips"), "length"),
        ),
        answer=_axles,
        check=_wheels,
    ),
    Calculation(
        name="helical_cam",
        doc=mark("forces on a drum cam with helical slots that shifts two followers against friction"),
        source=mark(
            "Litvin (6.164)-(6.182), with the balance of the followers restored and the sign of a_41 put right"
        ),
        takes=(
            positive("r3_m", mark("radius of the cam"), "length"),
            positive("l_m", mark("length of the cam"), "length"),
            at_least_zero("G3_N", mark("weight of the cam"), "force"),
            at_least_zero("Q2_N", mark("load of follower 2 along the axis"), "force"),
            at_least_zero("Q4_N", mark("load of follower 4 along the axis"), "force"),
            given("beta2_deg", mark("slope of slot 2 from the generatrix"), "angle", above=0.0, high=RIGHT),
            given("beta4_deg", mark("slope of slot 4 from the generatrix"), "angle", above=0.0, high=RIGHT),
            _friction("fE", mark("friction of slot 2 and its follower")),
            _friction("fF", mark("friction of slot 4 and its follower")),
            _friction("fN", mark("friction of follower 2 in its guide")),
            _friction("fS", mark("friction of follower 4 in its guide")),
            _friction("fC", mark("friction at the rim of the end that is pushed against the housing")),
            _friction("fC_end", mark("friction at the plane of that end")),
            _friction("fD", mark("friction at the rim of the other end")),
            given("psi_deg", mark("angle at which the driving force acts"), "angle"),
            _place("zE_m", mark("place of follower 2 along the axis, from the middle")),
            _place("zF_m", mark("place of follower 4")),
            _place("zP_m", mark("place of the driving force")),
            _place("zG_m", mark("place of the centre of mass"), default=0.0),
        ),
        returns=(
            gives("R23E_N", mark("force of follower 2"), "force"),
            gives("R43F_N", mark("force of follower 4"), "force"),
            gives("P_N", mark("driving force"), "force"),
            gives("RCm_N", mark("reaction of the end plane"), "force"),
            gives("RCn_N", mark("normal reaction at the rim of that end"), "force"),
            gives("RDn_N", mark("normal reaction at the rim of the other end"), "force"),
            gives("xC_m", mark("place of the first, along the weight"), "length"),
            gives("yC_m", mark("place of the first, across the weight"), "length"),
            gives("xD_m", mark("place of the other, along the weight"), "length"),
            gives("yD_m", mark("place of the other, across the weight"), "length"),
            gives("sign_zC", mark("1 or -1: end of the cam that is pushed against the housing")),
            gives("imbalance", mark("largest of the six sums of forces and moments, as a share of the largest force")),
        ),
        answer=_cam,
        check=_jams,
    ),
    Calculation(
        name="friction_drive",
        doc=mark("how hard two smooth wheels must be pressed together to carry a torque"),
        source="Litvin (7.1)-(7.3)",
        takes=(
            at_least_zero("torque_Nm", mark("torque on the driven wheel"), "torque"),
            positive("radius_m", mark("radius of that wheel"), "length"),
            positive("friction", mark("coefficient of friction of rest")),
            given("safety", mark("safety against slipping, usually 2 to 3"), low=1.0, default=2.5),
            positive("driving_radius_m", mark("radius of the driving wheel"), "length", default=None),
        ),
        returns=(
            gives("press_min_N", mark("normal force below which the wheels slip"), "force"),
            gives("press_N", mark("normal force with the safety"), "force"),
            gives("ratio", mark("speed of the driving wheel over that of the driven one")),
        ),
        answer=_press,
    ),
    Calculation(
        name="disc_integrator",
        doc=mark("turn of a roller that moves over a turning disc"),
        source="Litvin (7.4)",
        takes=(
            given("omega1_rad_s", mark("speed of the disc"), "angular_speed"),
            positive("roller_radius_m", mark("radius of the roller"), "length"),
            _place("rho_start_m", mark("distance of the roller from the middle of the disc at the start")),
            _place("rho_end_m", mark("the same at the end")),
            at_least_zero("duration_s", mark("time between"), "time"),
            given("law", mark("how the roller moves"), kind="word", choices=("linear",), default="linear"),
        ),
        returns=(
            gives("phi2_rad", mark("turn of the roller"), "angle"),
            gives("omega2_start_rad_s", mark("speed of the roller at the start"), "angular_speed"),
            gives("omega2_end_rad_s", mark("speed of the roller at the end"), "angular_speed"),
            gives("warnings", mark("dead_zone: the roller crosses the middle of the disc, where it slips")),
        ),
        answer=_disc,
    ),
)
"""Calculations of this part."""
