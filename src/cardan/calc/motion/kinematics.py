"""Calculations of motion at fixed geometry: single joint, chain, geometry, equivalent joint."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.book.comparison import book_series
from cardan.book.single_joint import book_coefficients, fourier, joint_extremes
from cardan.calc.calculation import Calculation, Given, Values, given, gives
from cardan.drive.drives import Drives
from cardan.drive.fields.validity import point_problems
from cardan.drive.models.geometry import geometry_from_points
from cardan.errors import Problem
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import Motion, initial_phases, motion
from cardan.texts import _, mark

RIGHT = 0.5 * math.pi


def joint_angles(**options: Any) -> Given:
    """Declare the joint angles of a chain."""
    doc = _("joint angle of each joint")
    return given("alpha_deg", doc, "angle", low=0.0, below=RIGHT, **{"axes": (1, 2)} | options)


def twists(**options: Any) -> Given:
    """Declare the plane twists of a chain."""
    return given(
        "beta_deg", mark("plane twist of joints 2 to n"), "angle", **{"axes": (1, 2), "default": None} | options
    )


def points(**options: Any) -> Given:
    """Declare the points of a drive's axis."""
    doc = _("point of the input axis, joint centres, point of the output axis")
    return given("points_m", doc, "length", axes=(2,), width=3, **options)


YOKES = given(
    "gamma_deg", mark("yoke angle of shafts 2 to n, driving to driven yoke"), "angle", axes=(1, 2), default=None
)
START = given("psi1_deg", mark("phase angle of joint 1 at the start"), "angle", default=0.0)
ANGLE = given("phi1_deg", mark("input angle from the start position"), "angle", axes=(0, 1))
SPEED = given("omega1_rad_s", mark("input speed"), "angular_speed", default=None)
ACCELERATION = given("eps1_rad_s2", mark("input angular acceleration"), "angular_acceleration", default=0.0)


def between(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what is wrong with points, and lists that do not have a value for each of the n-1 inner shafts."""
    place, alpha = values.get("points"), values.get("alpha")
    if "points" in values and "alpha" in values:
        if place is None and alpha is None:
            yield Problem(key("alpha"), _("missing; give it, or {points}").format(points=key("points")))
        if place is not None and alpha is not None:
            yield Problem(key("points"), _("given beside {alpha}; give one of them").format(alpha=key("alpha")))
    if place is not None:
        if values.get("beta") is not None:
            yield Problem(key("beta"), _("the points already give the plane twists"))
        for problem in point_problems(place.tolist()):
            named = key("points")
            yield Problem(problem.field.replace("points", named), problem.message.replace("points[", f"{named}["))
    joints = alpha.shape[-1] if alpha is not None else place.shape[0] - 2 if place is not None else None
    if joints is None:
        return
    if joints < 1 and alpha is not None:
        yield Problem(key("alpha"), _("an empty list has no joint"))
        return
    for name in ("beta", "gamma", "spline_teeth", "gamma_offset"):
        wanted = max(joints - 1, 0)
        value = values.get(name)
        if value is not None and value.shape[-1] != wanted:
            yield Problem(
                key(name), _("{given} values given, {wanted} needed").format(given=value.shape[-1], wanted=wanted)
            )


def drives(values: Values) -> Drives:
    """Return the drives that bends and twists, or points, describe."""
    if values.get("points") is not None:
        place = geometry_from_points(values["points"])
        joint_angle, twist = place.joint_angle, place.plane_twist
    else:
        joint_angle, twist = values["alpha"], values.get("beta")
    return Drives.from_angles(
        joint_angle, plane_twist=twist, yoke_angle=values.get("gamma"), start_phase=values.get("psi1", 0.0)
    )


def _motion(values: Values) -> tuple[Motion, Callable[[Any], Any]]:
    """Return the motion, and what takes the axis of angles away again where a single angle was given."""
    moved = motion(drives(values), values["phi1"], speed=values["omega1"], acceleration=values.get("eps1", 0.0))
    single = np.ndim(values["phi1"]) == 0
    return moved, (lambda array: array[..., 0]) if single else (lambda array: array)


def _single_joint(values: Values) -> Values:
    moved, at = _motion({**values, "alpha": np.asarray(values["alpha"])[..., None]})
    known = values["omega1"] is not None
    return {
        "phi2_deg": at(moved.output_angle),
        "ratio_21": at(moved.ratio),
        "omega2_rad_s": at(moved.shaft_speed[..., -1, :]) if known else None,
        "eps2_rad_s2": at(moved.shaft_acceleration[..., -1, :]) if known else None,
        "cross_vs_driving_yoke_deg": at(moved.cross_driving[..., 0, :]),
        "cross_vs_driven_yoke_deg": at(moved.cross_driven[..., 0, :]),
    }


def _extremes(values: Values) -> Values:
    found = joint_extremes(np.asarray(values["alpha"]))
    return {
        "ratio_max": found.ratio_max,
        "ratio_min": found.ratio_min,
        "delta": found.speed_fluctuation,
        "lead_max_deg": found.angle_error,
        "phi1_at_lead_max_deg": found.angle_of_error,
        "eps_max_over_omega1_sq": found.acceleration,
        "phi1_at_first_negative_eps_extreme_deg": found.angle_of_acceleration,
    }


def _fourier(values: Values) -> Values:
    joint_angle = np.asarray(values["alpha"])
    book = book_coefficients(joint_angle)
    return {
        "c_exact": fourier(joint_angle, values["kmax"]),
        "c11_book_alpha2_over_4": book.c11_quarter,
        "c11_book_series_3terms": book.c11,
        "c12_book_series_2terms": book.c12,
        "c13_book_series_1term": book.c13,
    }


def _geometry(values: Values) -> Values:
    place = geometry_from_points(values["points"])
    whole = equivalent_joint(drives(values))
    found = {
        "axis": place.axis,
        "normal": place.normal,
        "length_m": place.length,
        "alpha_deg": place.joint_angle,
        "beta_deg": place.plane_twist,
        "delta": whole.speed_fluctuation,
        "ratio_max": whole.ratio_max,
        "ratio_min": whole.ratio_min,
        "psi_mod180_deg": np.remainder(initial_phases(drives(values)), np.pi),
    }
    if values["phi1"] is None:
        return found
    moved, at = _motion(values)
    known = values["omega1"] is not None
    return found | {
        "phi_out_deg": at(moved.output_angle),
        "omega_out_rad_s": at(moved.shaft_speed[..., -1, :]) if known else None,
        "eps_out_rad_s2": at(moved.shaft_acceleration[..., -1, :]) if known else None,
    }


def _chain(values: Values) -> Values:
    moved, at = _motion(values)
    known = values["omega1"] is not None
    return {
        "phi_deg": at(moved.shaft_angle),
        "ratio_to_input": at(moved.shaft_ratio),
        "omega_rad_s": at(moved.shaft_speed) if known else None,
        "eps_rad_s2": at(moved.shaft_acceleration) if known else None,
        "psi_mod180_deg": np.remainder(initial_phases(drives(values)), np.pi),
        "cross_vs_driving_yoke_deg": at(moved.cross_driving),
        "cross_vs_driven_yoke_deg": at(moved.cross_driven),
    }


def _equivalent(values: Values) -> Values:
    whole = drives(values)
    joint = equivalent_joint(whole)
    return {
        "delta": joint.speed_fluctuation,
        "ratio_max": joint.ratio_max,
        "ratio_min": joint.ratio_min,
        "delta_of_each_shaft": joint.shaft_speed_fluctuation,
        "book_first_order_delta_80_with_theta": book_series(whole).speed_fluctuation,
        "tau_eq": joint.tau,
        "alpha_eq_deg": joint.joint_angle,
        "psi_eq_mod180_deg": joint.phase,
        "eps_max_over_omega1_sq": joint.max_acceleration,
        "lead_max_deg": joint.max_angle_error,
    }


CALCULATIONS = (
    Calculation(
        name="single_joint",
        doc=mark("angle, speed and acceleration of the shaft driven by one Hooke joint, and the turns of its cross"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 17–25, 103",
        takes=(
            given("alpha_deg", mark("joint angle of the joint"), "angle", axes=(0, 1), low=0.0, below=RIGHT),
            START,
            ANGLE,
            SPEED,
            ACCELERATION,
        ),
        returns=(
            gives("phi2_deg", mark("angle of the driven shaft from the start, continuous"), "angle"),
            gives("ratio_21", mark("speed ratio")),
            gives("omega2_rad_s", mark("speed of the driven shaft"), "angular_speed"),
            gives("eps2_rad_s2", mark("acceleration of the driven shaft"), "angular_acceleration"),
            gives("cross_vs_driving_yoke_deg", mark("turn of the cross in the driving yoke"), "angle"),
            gives("cross_vs_driven_yoke_deg", mark("turn of the cross in the driven yoke"), "angle"),
        ),
        answer=_single_joint,
    ),
    Calculation(
        name="single_joint_extremes",
        doc=mark("largest and smallest ratio, lead and acceleration of one Hooke joint"),
        source="Kozhevnikov & Perfil'ev (1978), Table 4, recomputed",
        takes=(given("alpha_deg", mark("joint angle of the joint"), "angle", axes=(0, 1), low=0.0, below=RIGHT),),
        returns=(
            gives("ratio_max", mark("largest speed ratio")),
            gives("ratio_min", mark("smallest speed ratio")),
            gives("delta", mark("irregularity")),
            gives("lead_max_deg", mark("largest lead of the driven shaft"), "angle"),
            gives("phi1_at_lead_max_deg", mark("input angle of that lead"), "angle"),
            gives("eps_max_over_omega1_sq", mark("largest acceleration over the square of the input speed")),
            gives("phi1_at_first_negative_eps_extreme_deg", mark("input angle of that acceleration"), "angle"),
        ),
        answer=_extremes,
    ),
    Calculation(
        name="fourier_single",
        doc=mark("Fourier amplitudes of the angle error of one Hooke joint, exact and by the book's series"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 39–46",
        takes=(
            given("alpha_deg", mark("joint angle of the joint"), "angle", axes=(0, 1), low=0.0, below=RIGHT),
            given("kmax", mark("how many amplitudes"), kind="whole", low=1, high=10_000, default=5),
        ),
        returns=(
            gives("c_exact", mark("amplitudes of orders 2, 4 … 2 kmax [rad]")),
            gives("c11_book_alpha2_over_4", mark("first amplitude, α²/4")),
            gives("c11_book_series_3terms", mark("first amplitude, three terms")),
            gives("c12_book_series_2terms", mark("second amplitude, two terms")),
            gives("c13_book_series_1term", mark("third amplitude, one term")),
        ),
        answer=_fourier,
    ),
    Calculation(
        name="geometry_from_points",
        doc=mark("joint angles, plane twists and lengths from joint centres, and the motion of the output"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 87–89",
        takes=(
            points(),
            YOKES,
            START,
            given("phi1_deg", mark("input angle from the start position"), "angle", axes=(0, 1), default=None),
            SPEED,
            ACCELERATION,
        ),
        returns=(
            gives("axis", mark("direction of each shaft")),
            gives("normal", mark("normal of each joint's plane")),
            gives("length_m", mark("length of each shaft"), "length"),
            gives("alpha_deg", mark("joint angle of each joint"), "angle"),
            gives("beta_deg", mark("plane twist of joints 2 to n"), "angle"),
            gives("delta", mark("irregularity")),
            gives("ratio_max", mark("largest speed ratio")),
            gives("ratio_min", mark("smallest speed ratio")),
            gives("psi_mod180_deg", mark("phase angle of each joint"), "angle"),
            gives("phi_out_deg", mark("angle of the output shaft from the start, continuous"), "angle"),
            gives("omega_out_rad_s", mark("speed of the output shaft"), "angular_speed"),
            gives("eps_out_rad_s2", mark("acceleration of the output shaft"), "angular_acceleration"),
        ),
        answer=_geometry,
        check=between,
    ),
    Calculation(
        name="chain",
        doc=mark("angle, speed and acceleration of every shaft of a chain of joints"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 31–33, 38",
        takes=(joint_angles(), twists(), YOKES, START, ANGLE, SPEED, ACCELERATION),
        returns=(
            gives("phi_deg", mark("angle of each shaft from the start, continuous"), "angle"),
            gives("ratio_to_input", mark("speed ratio of each shaft to the input")),
            gives("omega_rad_s", mark("speed of each shaft"), "angular_speed"),
            gives("eps_rad_s2", mark("acceleration of each shaft"), "angular_acceleration"),
            gives("psi_mod180_deg", mark("phase angle of each joint"), "angle"),
            gives("cross_vs_driving_yoke_deg", mark("turn of each cross in its driving yoke"), "angle"),
            gives("cross_vs_driven_yoke_deg", mark("turn of each cross in its driven yoke"), "angle"),
        ),
        answer=_chain,
        check=between,
    ),
    Calculation(
        name="equivalent_joint",
        doc=mark("the single joint that moves like the whole chain, and the speed fluctuation after each joint"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 78–80; exact by Möbius pairs",
        takes=(joint_angles(default=None), twists(), points(default=None), YOKES, START),
        returns=(
            gives("delta", mark("irregularity")),
            gives("ratio_max", mark("largest speed ratio")),
            gives("ratio_min", mark("smallest speed ratio")),
            gives("delta_of_each_shaft", mark("speed fluctuation of shafts 2 to n+1")),
            gives("book_first_order_delta_80_with_theta", mark("speed fluctuation by the book's first order")),
            gives("tau_eq", mark("tan² of half the equivalent angle")),
            gives("alpha_eq_deg", mark("equivalent angle"), "angle"),
            gives("psi_eq_mod180_deg", mark("phase of the equivalent joint; None when synchronous"), "angle"),
            gives("eps_max_over_omega1_sq", mark("largest acceleration over the square of the input speed")),
            gives("lead_max_deg", mark("largest angle error of the output about its mean"), "angle"),
        ),
        answer=_equivalent,
        check=between,
    ),
)
