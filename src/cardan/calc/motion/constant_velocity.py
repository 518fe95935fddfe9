"""Calculations of joints of constant velocity: pilot lever, planes of balls, grooves, Tracta, tripod."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.calc.calculation import Calculation, Given, Values, given, gives, positive
from cardan.drive.joints.laws import offset_grooves, pilot_lever, tilted_plane, tracta, tripod
from cardan.errors import InputError, Problem, refuse
from cardan.formulas.groove_offset import groove_offset
from cardan.formulas.pilot_lever import lever_choice
from cardan.texts import _, mark
from cardan.units import deg

from .kinematics import RIGHT


def _joint_angle(key: str, doc: str, **options: Any) -> Given:
    return given(key, doc, "angle", low=0.0, below=RIGHT, **options)


JOINT_ANGLE = _joint_angle("alpha_deg", mark("joint angle, the angle between the shafts"))
LEVER_JOINT_ANGLE = _joint_angle("alpha12_deg", mark("joint angle, the angle between the shafts"))
DIVISION = positive("b_over_a", mark("part of the lever on the side of the fixed ball end over the other part"))
LENGTH = positive("c_over_a", mark("distance of the fixed ball end from the centre of the joint over the same part"))


def _lever(values: Values) -> Values:
    alpha, b, c = (values[name] for name in ("alpha12", "b_over_a", "c_over_a"))
    error = pilot_lever.plane_error(alpha, b, c)
    return {
        "alpha2_rad": pilot_lever.cage_tilt(alpha, b, c),
        "plane_error_rad": error,
        "single_ball_irregularity": tilted_plane.speed_fluctuation(alpha, error),
    }


def _reaches(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield a lever that is too short for its distance."""
    names = ("alpha12", "b_over_a", "c_over_a")
    if all(name in values for name in names):
        alpha, b, c = (values[name] for name in names)
        if c * math.sin(alpha) >= 1.0 + b:
            text = _("{value:.6g} is too far: the lever reaches the axis of the other shaft below {limit:.6g}")
            limit = (1.0 + b) / math.sin(alpha)
            yield Problem(key("c_over_a"), text.format(value=c, limit=limit), "out_of_range")


def _even_lever(values: Values) -> Values:
    found = float(pilot_lever.even_length(values["alpha12"], values["b_over_a"]))
    if math.isnan(found):
        text = _("{value:.6g} is too much: a lever halves this joint angle only where b cos α_12 is less than a")
        raise refuse("b_over_a", text.format(value=values["b_over_a"]), "out_of_range")
    return {"c_over_a": found}


def _best_lever(values: Values) -> Values:
    try:
        found = lever_choice(values["b_over_a"], values["alpha_max"], smallest=values["alpha_min"])
    except InputError as error:
        raise error.renamed(lambda _field: "b_over_a") from None
    return {
        "c_over_a": found.c,
        "plane_error_max_rad": found.error,
        "bend_of_largest_lag_deg": found.below,
        "bend_of_largest_lead_deg": found.above,
        "exact_bend_deg": found.even,
    }


def _range(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield a range of joint angles that ends before it begins."""
    least, most = values.get("alpha_min"), values.get("alpha_max")
    if least is not None and most is not None and least > most:
        text = _("{value:.6g}° is above {other}, {limit:.6g}°")
        text = text.format(value=least / deg, other=key("alpha_max"), limit=most / deg)
        yield Problem(key("alpha_min"), text, "inconsistent")


def _plane(values: Values) -> Values:
    joint_angle, tilt = values["alpha"], values["plane_tilt"]
    found = tilted_plane.ball_demands(values["phi1"], joint_angle, tilt, values["balls"])
    return {
        "mean_rad": found.mean,
        "spread_rad": found.spread,
        "max_abs_rad": found.largest,
        "single_ball_irregularity": tilted_plane.speed_fluctuation(joint_angle, tilt),
    }


def _tilts(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield a plane that holds one of the shafts."""
    joint_angle, tilt = values.get("alpha"), values.get("plane_tilt")
    if joint_angle is not None and tilt is not None and 0.5 * joint_angle + abs(tilt) >= RIGHT:
        text = _("{value:.6g}° is too much: half the joint angle and the tilt must stay below 90° together")
        yield Problem(key("plane_tilt"), text.format(value=tilt / deg), "out_of_range")


def _grooves(values: Values) -> Values:
    joint_angle, one, two, radius = (values[name] for name in ("alpha", "c1", "c2", "groove_radius"))
    angle_error = np.asarray(offset_grooves.deviation(values["phi1"], joint_angle, one, two, radius))
    if np.any(np.isnan(angle_error)):
        text = _("{value:.6g} mm is too small: grooves so far off the centre do not meet at this joint angle")
        raise refuse("groove_radius", text.format(value=1e3 * radius), "singular")
    return {
        # The sign of the tilt is the one of the offsets here: the normal leans to the groove that stands farther off.
        "plane_tilt_rad": 0.0 - offset_grooves.plane_tilt(joint_angle, one, two),
        "plane_offset_m": offset_grooves.plane_offset(joint_angle, one, two),
        "phi2_minus_phi1_rad": angle_error + 0.0,
    }


def _offset(values: Values) -> Values:
    return {"c_m": groove_offset(values["alpha"], values["plane_tilt"], values["axial_play"])}


def _tracta(values: Values) -> Values:
    joint_angle, first, second, angle = (values[name] for name in ("alpha", "OA", "OB", "phi1"))
    one, two = tracta.joint_angles(joint_angle, first, second)
    return {
        "alpha1_rad": one,
        "alpha2_rad": two,
        "irregularity": tracta.speed_fluctuation(joint_angle, first, second),
        "phi2_minus_phi1_rad": None if angle is None else tracta.deviation(angle, joint_angle, first, second),
    }


def _tripod(values: Values) -> Values:
    angle, joint_angle, radius = (values[name] for name in ("phi1", "alpha", "track_radius"))
    x, y = tripod.spider_centre(angle, joint_angle, radius)
    length = values["shaft_length"]
    return {
        "phi2_minus_phi1_rad": 0.0 * np.asarray(angle, dtype=float),
        "orbit_radius_m": tripod.orbit_radius(joint_angle, radius),
        "center_x_m": x,
        "center_y_m": y,
        "roller_reach_m": tripod.roller_reach(angle, joint_angle, radius),
        "track_travel_m": tripod.track_travel(angle, joint_angle, radius),
        "shaft_tilt_rad": None if length is None else tripod.shaft_tilt(joint_angle, radius, length),
    }


SPEED_FLUCTUATION = gives("single_ball_irregularity", mark("speed fluctuation that one ball alone would give"))
ANGLE_ERROR = gives("phi2_minus_phi1_rad", mark("lead of the output over the input"), "angle")
ANGLE = given("phi1_deg", mark("input angle from the inner side of the plane of the shafts"), "angle", axes=(0, 1))

CALCULATIONS = (
    Calculation(
        name="rzeppa_lever",
        doc=mark("how far the pilot lever of a Rzeppa joint holds its cage off the bisecting plane"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 13, 14",
        takes=(LEVER_JOINT_ANGLE, DIVISION, LENGTH),
        returns=(
            gives("alpha2_rad", mark("angle of the cage's normal to the axis of the sliding ball end"), "angle"),
            gives("plane_error_rad", mark("the same less half the joint angle"), "angle"),
            SPEED_FLUCTUATION,
        ),
        answer=_lever,
        check=_reaches,
    ),
    Calculation(
        name="rzeppa_lever_ratio",
        doc=mark("length of the pilot lever that halves one joint angle exactly"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 15, 16",
        takes=(LEVER_JOINT_ANGLE, DIVISION),
        returns=(
            gives("c_over_a", mark("distance of the fixed ball end over the part of the lever beside the other")),
        ),
        answer=_even_lever,
    ),
    Calculation(
        name="rzeppa_lever_optimum",
        doc=mark("length of the pilot lever that errs least over a range of joint angles"),
        source=mark("minimax of the exact error of Kozhevnikov & Perfil'ev (1978), eq. 13"),
        takes=(
            DIVISION,
            _joint_angle("alpha_max_deg", mark("largest joint angle")),
            _joint_angle("alpha_min_deg", mark("smallest joint angle"), default=0.0),
        ),
        returns=(
            gives("c_over_a", mark("distance of the fixed ball end over the part of the lever beside the other")),
            gives("plane_error_max_rad", mark("largest error of the cage, of either sign"), "angle"),
            gives("bend_of_largest_lag_deg", mark("joint angle at which the cage leans too little by most"), "angle"),
            gives("bend_of_largest_lead_deg", mark("joint angle at which the cage leans too much by most"), "angle"),
            gives("exact_bend_deg", mark("bend that is halved exactly"), "angle"),
        ),
        answer=_best_lever,
        check=_range,
    ),
    Calculation(
        name="ball_plane_error",
        doc=mark("what the balls of a joint ask of its output where their plane misses the bisecting one"),
        source=mark("ball in a tilted plane, exact; mean over the balls in closed form"),
        takes=(
            JOINT_ANGLE,
            given(
                "plane_tilt_deg", mark("tilt: the normal stands at half the joint angle and this to shaft 1"), "angle"
            ),
            given("tilt_sign", mark("remark on the sense of the tilt; not read"), kind="word", default=""),
            given("balls", mark("number of balls"), kind="whole", default=6, low=1, high=1000),
            ANGLE,
        ),
        returns=(
            gives("mean_rad", mark("mean over the balls: what the output does"), "angle"),
            gives("spread_rad", mark("largest less smallest: what play and contacts take"), "angle"),
            gives("max_abs_rad", mark("largest in size"), "angle"),
            SPEED_FLUCTUATION,
        ),
        answer=_plane,
        check=_tilts,
    ),
    Calculation(
        name="offset_groove_plane",
        doc=mark("plane of balls in offset grooves, and how uneven unequal offsets make the output"),
        source=mark(
            "ball as far from one groove centre as from the other, exact; corrects Kozhevnikov & Perfil'ev "
            "(1978), p. 69"
        ),
        takes=(
            JOINT_ANGLE,
            positive("c1_m", mark("distance of the groove centre of shaft 1 from the centre of the joint"), "length"),
            positive("c2_m", mark("the same of shaft 2"), "length"),
            positive("groove_radius_m", mark("radius of both grooves"), "length"),
            ANGLE,
        ),
        returns=(
            gives("plane_tilt_rad", mark("tilt of the plane, positive towards shaft 1"), "angle"),
            gives("plane_offset_m", mark("distance of the plane from the centre, positive towards shaft 1"), "length"),
            ANGLE_ERROR,
        ),
        answer=_grooves,
    ),
    Calculation(
        name="groove_offset",
        doc=mark("offset of ball grooves with which an axial play tilts the plane of the balls no more than allowed"),
        source=mark("tilt of the plane of the balls with one centre shifted, exact"),
        takes=(
            _joint_angle("alpha_deg", mark("largest joint angle")),
            given("plane_tilt_deg", mark("largest tilt allowed"), "angle", above=0.0, below=RIGHT),
            given("axial_play_m", mark("shift of one shaft along its axis, to either side"), "length", low=0.0),
        ),
        returns=(gives("c_m", mark("offset of both groove centres"), "length"),),
        answer=_offset,
    ),
    Calculation(
        name="tracta",
        doc=mark("bends within a Tracta joint, and how uneven unequal forks make it"),
        source=mark("double joint whose middle shaft is the line of the fork centres, exact"),
        takes=(
            JOINT_ANGLE,
            positive("OA_m", mark("distance of the fork centre of shaft 1 from the crossing of the axes"), "length"),
            positive("OB_m", mark("the same of shaft 2"), "length"),
            given(
                "phi1_deg",
                mark("angle of the swivel axis of fork 1 from the plane of the shafts"),
                "angle",
                axes=(0, 1),
                default=None,
            ),
        ),
        returns=(
            gives("alpha1_rad", mark("angle of shaft 1 to the line of the fork centres"), "angle"),
            gives("alpha2_rad", mark("angle of shaft 2 to it"), "angle"),
            gives("irregularity", mark("speed fluctuation of the output")),
            ANGLE_ERROR,
        ),
        answer=_tracta,
    ),
    Calculation(
        name="tripod",
        doc=mark("orbit of the spider of a tripod joint, and ways of its rollers; its turn is even exactly"),
        source=mark("three rollers in three tracks, in closed form"),
        takes=(
            JOINT_ANGLE,
            positive("track_radius_m", mark("distance of the tracks from the axis of the housing"), "length"),
            given(
                "phi1_deg",
                mark("angle of the first track from the line of greatest slope of the spider's plane"),
                "angle",
                axes=(0, 1),
            ),
            positive("shaft_length_m", mark("from the spider to the other joint of its shaft"), "length", default=None),
        ),
        returns=(
            ANGLE_ERROR,
            gives(
                "orbit_radius_m", mark("radius of the circle that the spider's centre runs round three times"), "length"
            ),
            gives("center_x_m", mark("spider's centre in its plane, along the line of greatest slope"), "length"),
            gives("center_y_m", mark("spider's centre in its plane, across that line"), "length"),
            gives("roller_reach_m", mark("distance of the first roller from the spider's centre"), "length"),
            gives("track_travel_m", mark("way of the first roller along its track from the middle"), "length"),
            gives("shaft_tilt_rad", mark("half angle by which the shaft nutates, for a long shaft"), "angle"),
        ),
        answer=_tripod,
    ),
)
"""Calculations of this part."""
