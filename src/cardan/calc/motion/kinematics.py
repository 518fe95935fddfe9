"""Motion at fixed geometry: single joint, chain, equivalent joint, yoke angles that make it even."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from cardan.book.comparison import book_series
from cardan.book.single_joint import book_coefficients, fourier, joint_extremes
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.drive.drive import Drive
from cardan.drive.drives import Drives
from cardan.drive.fields.validity import point_problems
from cardan.drive.models.geometry import geometry_from_points
from cardan.drive.models.kinematics_model import chain
from cardan.errors import Problem
from cardan.questions.motion.equivalence import equivalent_joint
from cardan.questions.motion.motion import Motion, initial_phases, motion
from cardan.questions.phases.phases import phases
from cardan.questions.phases.setting import settings
from cardan.questions.phases.spline_pitch import best_pitched, steps
from cardan.reading.given import Given, given, gives, joint_angle, whole
from cardan.texts import _

formula = Formulas(__doc__)


def joint_angles(**options: Any) -> Given:
    """Declare the joint angles of a chain."""
    doc = _("joint angle of each joint")
    return joint_angle("alpha_deg", doc, **{"axes": (1, 2)} | options)


def twists(**options: Any) -> Given:
    """Declare the plane twists of a chain."""
    return given("beta_deg", "plane twist of joints 2 to n", **{"axes": (1, 2), "default": None} | options)


def points(**options: Any) -> Given:
    """Declare the points of a drive's axis."""
    doc = "point of the input axis, joint centres, point of the output axis"
    return given("points_m", doc, axes=2, width=3, **options)


YOKES = given("gamma_deg", "yoke angle of shafts 2 to n, driving to driven yoke", axes=(1, 2), default=None)
START = given("psi1_deg", "phase angle of joint 1 at the start", default=0.0)
ANGLE = given("phi1_deg", "input angle from the start position", axes=(0, 1))
SPEED = given("omega1_rad_s", "input speed", default=None)
ACCELERATION = given("eps1_rad_s2", "input angular acceleration", default=0.0)


def joints_of(v: Values) -> int | None:
    """Return how many joints the joint angles, or the points, of a chain tell of."""
    place, alpha = v.get("points"), v.get("alpha")
    return alpha.shape[-1] if alpha is not None else place.shape[0] - 2 if place is not None else None


def between(v: Values) -> Problems:
    """Yield what is wrong with points, and lists that do not have a value for each of the n-1 inner shafts."""
    place, alpha = v.get("points"), v.get("alpha")
    if "points" in v and "alpha" in v:
        if place is None and alpha is None:
            yield v.wrong("alpha", _("missing; give it, or {points}"), points=v.key("points"))
        if place is not None and alpha is not None:
            yield v.wrong("points", _("given beside {alpha}; give one of them"), alpha=v.key("alpha"))
    if place is not None:
        if v.get("beta") is not None:
            yield v.wrong("beta", _("the points already give the plane twists"))
        for problem in point_problems(place.tolist()):
            named = v.key("points")
            yield Problem(problem.field.replace("points", named), problem.message.replace("points[", f"{named}["))
    joints = joints_of(v)
    if joints is not None and joints < 1 and alpha is not None:
        yield v.wrong("alpha", _("an empty list has no joint"))
    elif joints is not None:
        yield from v.miscounted(max(joints - 1, 0), "beta", "gamma", "spline_teeth", "gamma_offset")


def drives(v: Values) -> Drives:
    """Return the drives that bends and twists, or points, describe."""
    if v.get("points") is not None:
        place = geometry_from_points(v.points)
        joint_angle, twist = place.joint_angle, place.plane_twist
    else:
        joint_angle, twist = v.alpha, v.get("beta")
    return Drives.from_angles(joint_angle, plane_twist=twist, yoke_angle=v.get("gamma"), start_phase=v.get("psi1", 0.0))


def _motion(v: Values) -> tuple[Motion, Callable[[Any], Any]]:
    """Return the motion, and what takes the axis of angles away again where a single angle was given."""
    return motion(drives(v), v.phi1, speed=v.omega1, acceleration=v.get("eps1", 0.0)), v.single("phi1")


def _output_speed(v: Values, moved: Motion) -> tuple[Any, Any]:
    """Return speed and acceleration of the output, where that of the input is known."""
    if v.omega1 is None:
        return None, None
    at = v.single("phi1")
    return at(moved.shaft_speed[..., -1, :]), at(moved.shaft_acceleration[..., -1, :])


@formula(
    "angle, speed and acceleration of the shaft driven by one Hooke joint, and the turns of its cross",
    "Kozhevnikov & Perfil'ev (1978), eq. 17–25, 103",
    joint_angle("alpha_deg", "joint angle of the joint", axes=(0, 1)),
    (START, ANGLE, SPEED, ACCELERATION),
    "phi2_deg: angle of the driven shaft from the start, continuous",
    "ratio_21: speed ratio",
    "omega2_rad_s: speed of the driven shaft",
    "eps2_rad_s2: acceleration of the driven shaft",
    "cross_vs_driving_yoke_deg: turn of the cross in the driving yoke",
    "cross_vs_driven_yoke_deg: turn of the cross in the driven yoke",
)
def _single_joint(v: Values) -> Any:
    moved, at = _motion(v.but(alpha=np.asarray(v.alpha)[..., None]))
    cross = at(moved.cross_driving[..., 0, :]), at(moved.cross_driven[..., 0, :])
    return at(moved.output_angle), at(moved.ratio), *_output_speed(v, moved), *cross


@formula(
    "largest and smallest ratio, lead and acceleration of one Hooke joint",
    "Kozhevnikov & Perfil'ev (1978), Table 4, recomputed",
    joint_angle("alpha_deg", "joint angle of the joint", axes=(0, 1)),
    "ratio_max: largest speed ratio",
    "ratio_min: smallest speed ratio",
    "delta = speed_fluctuation: speed fluctuation",
    "lead_max_deg = angle_error: largest lead of the driven shaft",
    "phi1_at_lead_max_deg = angle_of_error: input angle of that lead",
    "eps_max_over_omega1_sq = acceleration: largest acceleration over the square of the input speed",
    "phi1_at_first_negative_eps_extreme_deg = angle_of_acceleration: input angle of that acceleration",
)
def _single_joint_extremes(v: Values) -> Any:
    return joint_extremes(np.asarray(v.alpha))


@formula(
    "Fourier amplitudes of the angle error of one Hooke joint, exact and by the book's series",
    "Kozhevnikov & Perfil'ev (1978), eq. 39–46",
    joint_angle("alpha_deg", "joint angle of the joint", axes=(0, 1)),
    whole("kmax", "how many amplitudes", low=1, high=10000, default=5),
    "c_exact: amplitudes of orders 2, 4 … 2 kmax [rad]",
    "c11_book_alpha2_over_4: first amplitude, α²/4",
    "c11_book_series_3terms: first amplitude, three terms",
    "c12_book_series_2terms: second amplitude, two terms",
    "c13_book_series_1term: third amplitude, one term",
)
def _fourier_single(v: Values) -> Any:
    joint_angle = np.asarray(v.alpha)
    book = book_coefficients(joint_angle)
    return fourier(joint_angle, v.kmax), book.c11_quarter, book.c11, book.c12, book.c13


@formula(
    "joint angles, plane twists and lengths from joint centres, and the motion of the output",
    "Kozhevnikov & Perfil'ev (1978), eq. 87–89",
    (points(), YOKES, START),
    given("phi1_deg", "input angle from the start position", axes=(0, 1), default=None),
    (SPEED, ACCELERATION),
    "axis: direction of each shaft",
    "normal: normal of each joint's plane",
    "length_m: length of each shaft",
    "alpha_deg: joint angle of each joint",
    "beta_deg: plane twist of joints 2 to n",
    "delta: speed fluctuation",
    "ratio_max: largest speed ratio",
    "ratio_min: smallest speed ratio",
    "psi_mod180_deg: phase angle of each joint",
    "phi_out_deg: angle of the output shaft from the start, continuous",
    "omega_out_rad_s: speed of the output shaft",
    "eps_out_rad_s2: acceleration of the output shaft",
    check=between,
)
def _geometry_from_points(v: Values) -> Any:
    place = geometry_from_points(v.points)
    whole = equivalent_joint(drives(v))
    found = {
        "axis": place.axis,
        "normal": place.normal,
        "length_m": place.length,
        "alpha_deg": place.joint_angle,
        "beta_deg": place.plane_twist,
        "delta": whole.speed_fluctuation,
        "ratio_max": whole.ratio_max,
        "ratio_min": whole.ratio_min,
        "psi_mod180_deg": np.remainder(initial_phases(drives(v)), np.pi),
    }
    if v.phi1 is None:
        return found
    moved, at = _motion(v)
    speed, acceleration = _output_speed(v, moved)
    return found | {"phi_out_deg": at(moved.output_angle), "omega_out_rad_s": speed, "eps_out_rad_s2": acceleration}


@formula(
    "angle, speed and acceleration of every shaft of a chain of joints",
    "Kozhevnikov & Perfil'ev (1978), eq. 31–33, 38",
    (joint_angles(), twists(), YOKES, START, ANGLE, SPEED, ACCELERATION),
    "phi_deg = shaft_angle: angle of each shaft from the start, continuous",
    "ratio_to_input = shaft_ratio: speed ratio of each shaft to the input",
    "omega_rad_s: speed of each shaft",
    "eps_rad_s2: acceleration of each shaft",
    "psi_mod180_deg: phase angle of each joint",
    "cross_vs_driving_yoke_deg = cross_driving: turn of each cross in its driving yoke",
    "cross_vs_driven_yoke_deg = cross_driven: turn of each cross in its driven yoke",
    check=between,
)
def _chain(v: Values) -> Any:
    moved, at = _motion(v)
    found = {"psi_mod180_deg": np.remainder(initial_phases(drives(v)), np.pi)}
    if v.omega1 is not None:
        found |= {"omega_rad_s": at(moved.shaft_speed), "eps_rad_s2": at(moved.shaft_acceleration)}
    return at(moved), found


@formula(
    "the single joint that moves like the whole chain, and the speed fluctuation after each joint",
    "Kozhevnikov & Perfil'ev (1978), eq. 78–80; exact by Möbius pairs",
    (joint_angles(default=None), twists(), points(default=None), YOKES, START),
    "delta = speed_fluctuation: speed fluctuation",
    "ratio_max: largest speed ratio",
    "ratio_min: smallest speed ratio",
    "delta_of_each_shaft = shaft_speed_fluctuation: speed fluctuation of shafts 2 to n+1",
    "book_first_order_delta_80_with_theta: speed fluctuation by the book's first order",
    "tau_eq = tau: tan² of half the equivalent angle",
    "alpha_eq_deg = joint_angle: equivalent angle",
    "psi_eq_mod180_deg = phase: phase of the equivalent joint; None when synchronous",
    "eps_max_over_omega1_sq = max_acceleration: largest acceleration over the square of the input speed",
    "lead_max_deg = max_angle_error: largest angle error of the output about its mean",
    check=between,
)
def _equivalent_joint(v: Values) -> Any:
    whole = drives(v)
    joint = equivalent_joint(whole)
    return joint, {"book_first_order_delta_80_with_theta": book_series(whole).speed_fluctuation}


RUNNERS_UP = 6


def _drive(v: Values, yoke_angle: str) -> Drive:
    yokes = v[yoke_angle]
    yokes = [] if yokes is None else yokes.tolist()
    if v.points is not None:
        return Drive.from_points(v.points.tolist(), yoke_angles=yokes)
    twist = [] if v.beta is None else v.beta.tolist()
    return Drive.from_angles(v.alpha.tolist(), plane_twists=twist, yoke_angles=yokes)


def _check(v: Values) -> Problems:
    yield from between(v)
    alpha, place = v.get("alpha"), v.get("points")
    last = alpha.shape[0] if alpha is not None else place.shape[0] - 2 if place is not None else None
    for number in v.get("fixed_gamma") or {}:
        if last is not None and not 2 <= number <= last:
            yield Problem(
                f"{v.key('fixed_gamma')}.{number}",
                _("there is no such yoke angle; the shafts between two joints are 2 to {last}").format(last=last),
            )


def _ties(one: float, other: float) -> bool:
    return one - other <= 1e-12


def _yokes(key: str, doc: str) -> Given:
    return given(key, doc, axes=1, default=None)


@formula(
    "yoke angles that make a chain synchronous or as even as can be, and what they can reach",
    "hyperbolic polygon; Kozhevnikov & Perfil'ev (1978), eq. 77–86 is its first order",
    joint_angles(axes=1, default=None),
    (twists(axes=1), points(default=None)),
    _yokes("gamma_deg", "present yoke angle of shafts 2 to n"),
    given("fixed_gamma_deg", "yoke angles that must stay, by shaft number", kind="table", default=None),
    "delta_min = speed_fluctuation_min: smallest speed fluctuation",
    "delta_max = speed_fluctuation_max: largest speed fluctuation",
    "synchronous_feasible = feasible: whether the chain can be synchronous",
    "alpha_eq_min_deg = joint_angle_min: smallest equivalent angle",
    "alpha_eq_max_deg = joint_angle_max: largest equivalent angle",
    "gamma_deg: best yoke angles",
    "gamma_deg_sets: best yoke angles and their mirror image",
    "delta: speed fluctuation that the best yoke angles leave",
    "delta_of_each_shaft: speed fluctuation of shafts 2 to n+1 then",
    "psi_mod180_deg: phase angle of each joint then",
    gives("delta_per_rad", "growth of the speed fluctuation for each yoke turned, per radian", None),
    "limiting_joint: number of the joint whose angle is too large for the others",
    check=_check,
)
def _synthesis_continuous(v: Values) -> Any:
    found = phases(_drive(v, "gamma"), fixed=v.fixed_gamma)
    best = found.settings[0] if found.settings else found.as_built
    return found, {
        "gamma_deg": best.yoke_angle,
        "gamma_deg_sets": [one.yoke_angle for one in found.settings],
        "delta": best.speed_fluctuation,
        "delta_of_each_shaft": best.shaft_speed_fluctuation,
        "psi_mod180_deg": np.remainder(best.initial_phase, np.pi),
        "delta_per_rad": best.sensitivity,
    }


@formula(
    "best yoke angles that spline teeth allow, all looked at",
    "enumeration on the exact model",
    joint_angles(axes=1, default=None),
    (twists(axes=1), points(default=None)),
    whole("spline_teeth", "teeth of the spline on shafts 2 to n", axes=1, low=1),
    _yokes("gamma_offset_deg", "yoke angle of shafts 2 to n from which the teeth count"),
    "delta_min: smallest speed fluctuation",
    "delta_second_best: speed fluctuation of the runner-up",
    "n_distinct: different yoke angles each spline allows",
    "gamma_deg: best yoke angles",
    "gamma_deg_minimisers: all equally good sets found",
    "gamma_deg_sets: best sets, best first",
    "delta_of_each_set: speed fluctuation each set leaves",
    "delta_of_each_shaft: speed fluctuation of shafts 2 to n+1 with the best set",
    "psi_mod180_deg: phase angle of each joint with the best set",
    gives("delta_per_rad", "growth of the speed fluctuation for each yoke turned, per radian", None),
    check=_check,
)
def _synthesis_spline(v: Values) -> Any:
    whole = chain(_drive(v, "gamma_offset"))
    teeth = [int(z) for z in v.spline_teeth]
    rows = best_pitched(whole, whole.yoke_angle, dict(enumerate(teeth)), count=RUNNERS_UP)
    found = settings(whole, rows, [""] * len(rows), whole.yoke_angle)
    turned = [np.remainder(one.yoke_angle, np.pi) for one in found]
    return {
        "delta_min": found[0].speed_fluctuation,
        "delta_second_best": found[1].speed_fluctuation if len(found) > 1 else None,
        "n_distinct": [steps(z) for z in teeth],
        "gamma_deg": turned[0],
        "gamma_deg_minimisers": [
            angles
            for angles, one in zip(turned, found, strict=True)
            if _ties(one.speed_fluctuation, found[0].speed_fluctuation)
        ],
        "gamma_deg_sets": turned,
        "delta_of_each_set": [one.speed_fluctuation for one in found],
        "delta_of_each_shaft": found[0].shaft_speed_fluctuation,
        "psi_mod180_deg": np.remainder(found[0].initial_phase, np.pi),
        "delta_per_rad": found[0].sensitivity,
    }
