"""Joints of constant velocity: pilot lever, planes of balls, grooves, Tracta, tripod."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.drive.joints import rzeppa, tracta, tripod, weiss
from cardan.drive.joints.common import laws
from cardan.errors import InputError, refuse
from cardan.formulas.joint_geometry import groove_offset, lever_choice
from cardan.reading.given import RIGHT, at_least_zero, given, joint_angle, positive, whole, word
from cardan.texts import _
from cardan.units import deg

formula = Formulas(__doc__)

JOINT_ANGLE = joint_angle("alpha_deg", "joint angle, the angle between the shafts")
LEVER_JOINT_ANGLE = joint_angle("alpha12_deg", "joint angle, the angle between the shafts")
DIVISION = positive("b_over_a", "part of the lever on the side of the fixed ball end over the other part")
LENGTH = positive("c_over_a", "distance of the fixed ball end from the centre of the joint over the same part")


def _reaches(v: Values) -> Problems:
    """Yield a lever that is too short for its distance."""
    names = ("alpha12", "b_over_a", "c_over_a")
    if all(name in v for name in names):
        alpha, b, c = (v[name] for name in names)
        if c * math.sin(alpha) >= 1.0 + b:
            text = _("{value:.6g} is too far: the lever reaches the axis of the other shaft below {limit:.6g}")
            limit = (1.0 + b) / math.sin(alpha)
            yield v.wrong("c_over_a", text.format(value=c, limit=limit), "out_of_range")


def _range(v: Values) -> Problems:
    """Yield a range of joint angles that ends before it begins."""
    least, most = v.get("alpha_min"), v.get("alpha_max")
    if least is not None and most is not None and least > most:
        text = _("{value:.6g}° is above {other}, {limit:.6g}°")
        text = text.format(value=least / deg, other=v.key("alpha_max"), limit=most / deg)
        yield v.wrong("alpha_min", text, "inconsistent")


def _tilts(v: Values) -> Problems:
    """Yield a plane that holds one of the shafts."""
    joint_angle, tilt = v.get("alpha"), v.get("plane_tilt")
    if joint_angle is not None and tilt is not None and 0.5 * joint_angle + abs(tilt) >= RIGHT:
        text = _("{value:.6g}° is too much: half the joint angle and the tilt must stay below 90° together")
        yield v.wrong("plane_tilt", text.format(value=tilt / deg), "out_of_range")


SPEED_FLUCTUATION = "single_ball_irregularity: speed fluctuation that one ball alone would give"
ANGLE_ERROR = "phi2_minus_phi1_rad: lead of the output over the input"
ANGLE = given("phi1_deg", "input angle from the inner side of the plane of the shafts", axes=(0, 1))


@formula(
    "how far the pilot lever of a Rzeppa joint holds its cage off the bisecting plane",
    "Kozhevnikov & Perfil'ev (1978), eq. 13, 14",
    (LEVER_JOINT_ANGLE, DIVISION, LENGTH),
    "alpha2_rad: angle of the cage's normal to the axis of the sliding ball end",
    "plane_error_rad: the same less half the joint angle",
    SPEED_FLUCTUATION,
    check=_reaches,
)
def _rzeppa_lever(v: Values) -> Any:
    alpha, b, c = (v[name] for name in ("alpha12", "b_over_a", "c_over_a"))
    error = rzeppa.plane_error(alpha, b, c)
    return rzeppa.cage_tilt(alpha, b, c), error, laws.speed_fluctuation(alpha, error)


@formula(
    "length of the pilot lever that halves one joint angle exactly",
    "Kozhevnikov & Perfil'ev (1978), eq. 15, 16",
    (LEVER_JOINT_ANGLE, DIVISION),
    "c_over_a: distance of the fixed ball end over the part of the lever beside the other",
)
def _rzeppa_lever_ratio(v: Values) -> Any:
    found = float(rzeppa.even_length(v.alpha12, v.b_over_a))
    if math.isnan(found):
        text = _("{value:.6g} is too much: a lever halves this joint angle only where b cos α_12 is less than a")
        raise refuse("b_over_a", text.format(value=v.b_over_a), "out_of_range")
    return found


@formula(
    "length of the pilot lever that errs least over a range of joint angles",
    "minimax of the exact error of Kozhevnikov & Perfil'ev (1978), eq. 13",
    DIVISION,
    joint_angle("alpha_max_deg", "largest joint angle"),
    joint_angle("alpha_min_deg", "smallest joint angle", default=0.0),
    "c_over_a: distance of the fixed ball end over the part of the lever beside the other",
    "plane_error_max_rad: largest error of the cage, of either sign",
    "bend_of_largest_lag_deg: joint angle at which the cage leans too little by most",
    "bend_of_largest_lead_deg: joint angle at which the cage leans too much by most",
    "exact_bend_deg: joint angle that is bisected exactly",
    check=_range,
)
def _rzeppa_lever_optimum(v: Values) -> Any:
    try:
        found = lever_choice(v.b_over_a, v.alpha_max, smallest=v.alpha_min)
    except InputError as error:
        raise error.renamed(lambda _field: "b_over_a") from None
    return found.c, found.error, found.below, found.above, found.even


@formula(
    "what the balls of a joint ask of its output where their plane misses the bisecting one",
    "ball in a tilted plane, exact; mean over the balls in closed form",
    JOINT_ANGLE,
    given("plane_tilt_deg", "tilt: the normal stands at half the joint angle and this to shaft 1"),
    word("tilt_sign", "remark on the sense of the tilt; not read", default=""),
    whole("balls", "number of balls", default=6, low=1, high=1000),
    ANGLE,
    "mean_rad: mean over the balls: what the output does",
    "spread_rad: largest less smallest: what play and contacts take",
    "max_abs_rad: largest in size",
    SPEED_FLUCTUATION,
    check=_tilts,
)
def _ball_plane_error(v: Values) -> Any:
    joint_angle, tilt = v.alpha, v.plane_tilt
    found = laws.ball_demands(v.phi1, joint_angle, tilt, v.balls)
    return found.mean, found.spread, found.largest, laws.speed_fluctuation(joint_angle, tilt)


@formula(
    "plane of balls in offset grooves, and the speed fluctuation that unequal offsets cause",
    "ball as far from one groove centre as from the other, exact; corrects Kozhevnikov & Perfil'ev (1978), p. 69",
    JOINT_ANGLE,
    positive("c1_m", "distance of the groove centre of shaft 1 from the centre of the joint"),
    positive("c2_m", "the same of shaft 2"),
    positive("groove_radius_m", "radius of both grooves"),
    ANGLE,
    "plane_tilt_rad: tilt of the plane, positive towards shaft 1",
    "plane_offset_m: distance of the plane from the centre, positive towards shaft 1",
    ANGLE_ERROR,
)
def _offset_groove_plane(v: Values) -> Any:
    joint_angle, one, two, radius = (v[name] for name in ("alpha", "c1", "c2", "groove_radius"))
    angle_error = np.asarray(weiss.deviation(v.phi1, joint_angle, one, two, radius))
    if np.any(np.isnan(angle_error)):
        text = _("{value:.6g} mm is too small: grooves so far off the centre do not meet at this joint angle")
        raise refuse("groove_radius", text.format(value=1e3 * radius), "singular")
    return (0.0 - weiss.plane_tilt(joint_angle, one, two), weiss.plane_offset(joint_angle, one, two), angle_error + 0.0)


@formula(
    "offset of ball grooves with which an axial play tilts the plane of the balls no more than allowed",
    "tilt of the plane of the balls with one centre shifted, exact",
    joint_angle("alpha_deg", "largest joint angle"),
    positive("plane_tilt_deg", "largest tilt allowed", below=RIGHT),
    at_least_zero("axial_play_m", "shift of one shaft along its axis, to either side"),
    "c_m: offset of both groove centres",
)
def _groove_offset(v: Values) -> Any:
    return groove_offset(v.alpha, v.plane_tilt, v.axial_play)


@formula(
    "joint angles within a Tracta joint, and the speed fluctuation that unequal forks cause",
    "double joint whose middle shaft is the line of the fork centres, exact",
    JOINT_ANGLE,
    positive("OA_m", "distance of the fork centre of shaft 1 from the crossing of the axes"),
    positive("OB_m", "the same of shaft 2"),
    given("phi1_deg", "angle of the swivel axis of fork 1 from the plane of the shafts", axes=(0, 1), default=None),
    "alpha1_rad: angle of shaft 1 to the line of the fork centres",
    "alpha2_rad: angle of shaft 2 to it",
    "irregularity: speed fluctuation of the output",
    ANGLE_ERROR,
)
def _tracta(v: Values) -> Any:
    joint_angle, first, second, angle = (v[name] for name in ("alpha", "OA", "OB", "phi1"))
    size = joint_angle, first, second
    ahead = None if angle is None else tracta.deviation(angle, *size)
    return *tracta.joint_angles(*size), tracta.speed_fluctuation(*size), ahead


@formula(
    "orbit of the spider of a tripod joint, and ways of its rollers; uniform while its shaft keeps its direction",
    "three rollers in three tracks, in closed form",
    JOINT_ANGLE,
    positive("track_radius_m", "distance of the tracks from the axis of the housing"),
    given("phi1_deg", "angle of the first track from the line of greatest slope of the spider's plane", axes=(0, 1)),
    positive("shaft_length_m", "from the spider to the other joint of its shaft", default=None),
    ANGLE_ERROR,
    "orbit_radius_m: radius of the circle that the spider's centre runs round three times",
    "center_x_m: spider's centre in its plane, along the line of greatest slope",
    "center_y_m: spider's centre in its plane, across that line",
    "roller_reach_m: distance of the first roller from the spider's centre",
    "track_travel_m: way of the first roller along its track from the middle",
    "shaft_tilt_rad: half angle by which the shaft nutates, for a long shaft",
)
def _tripod(v: Values) -> Any:
    angle, joint_angle, radius = (v[name] for name in ("phi1", "alpha", "track_radius"))
    x, y = tripod.spider_centre(angle, joint_angle, radius)
    length = v.shaft_length
    ahead, orbit = 0.0 * np.asarray(angle, dtype=float), tripod.orbit_radius(joint_angle, radius)
    if length is not None:
        ahead = tripod.pivot_error(joint_angle, radius, length) * np.sin(3.0 * np.asarray(angle, dtype=float))
    roller = tripod.roller_reach(angle, joint_angle, radius), tripod.track_travel(angle, joint_angle, radius)
    return ahead, orbit, x, y, *roller, None if length is None else tripod.shaft_tilt(joint_angle, radius, length)
