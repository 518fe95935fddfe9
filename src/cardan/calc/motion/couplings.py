"""Other joints: centred double joints, pin couplings, couplings with profiles, crossed axes."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.drive.joints import clemens, double_cardan, offset_cross, pin_coupling
from cardan.errors import refuse
from cardan.formulas.joint_geometry import MARGIN, best_centring, best_pins
from cardan.reading.given import RIGHT, Given, at_least_zero, given, gives, joint_angle, positive, record, whole, word
from cardan.texts import _
from cardan.units import deg

formula = Formulas(__doc__)

EDGE = 1e-12
"""Slants this near an end of their range [rad] stand on it, whatever rounding says."""

JOINT_ANGLE = joint_angle("alpha_deg", "joint angle between the outer shafts")
TURN = given("phi1_deg", "input angle from the inner side of the joint angle", axes=(0, 1))


def _ratios(first: float, second: float, *, crossed: bool = False) -> tuple[float, float, float]:
    """Return largest and smallest speed ratio, and the speed fluctuation."""
    gain = double_cardan.gain(first, second, crossed=crossed)
    uneven = abs(double_cardan.unevenness(first, second, crossed=crossed))
    return max(gain, 1.0 / gain), min(gain, 1.0 / gain), uneven


RATIOS = (
    "ratio_max: largest speed ratio over a turn",
    "ratio_min: smallest speed ratio over a turn",
    "irregularity: speed fluctuation of the output",
)


def _between(v: Values) -> Problems:
    least, most = v.get("alpha_min"), v.get("alpha_max")
    if least is not None and most is not None and least >= most:
        yield v.wrong("alpha_min", _("is not below {other}"), "inconsistent", other=v.key("alpha_max"))


def _slants(v: Values) -> Problems:
    """Yield slants of pins with which they do not turn all the way round."""
    if v.get("alpha") is None:
        return
    low, high = pin_coupling.slant_range(v.alpha)
    for name in ("theta1", "theta2", "theta"):
        slant = v.get(name)
        if slant is not None and not low + EDGE < slant < high - EDGE:
            text = _(
                "{value}° is not between {low}° and {high}°, where pins turn all the way round at this joint angle"
            )
            shown = {"value": slant / deg, "low": low / deg, "high": high / deg}
            text = text.format(**{what: f"{angle:.6g}" for what, angle in shown.items()})
            yield v.wrong(name, text, "out_of_range")


def _support(v: Values) -> Problems:
    offset, reach = v.get("cross_offset"), v.get("support_distance")
    if offset is not None and reach is not None and reach <= offset:
        text = _("is not above {other}: the support would stand within the joint")
        yield v.wrong("support_distance", text.format(other=v.key("cross_offset")), "inconsistent")
    if v.get("cross_sign") not in (None, -1, 1):
        yield v.wrong("cross_sign", _("{value} is neither 1 nor -1"), value=v.cross_sign)


def _profile(number: int) -> Given:
    return record(
        f"circle{number}",
        _("circular profile of shaft {number} in its meridian plane").format(number=number),
        given("axial_m", "height of the centre along the shaft, from the crossing of the axes"),
        given("radial_m", "distance of the centre from the axis"),
        positive("radius_m", "radius of the profile"),
    )


ANGLE_ERROR = "phi2_minus_phi1_rad: lead of the output over the input"
RATIO = "ratio_21: speed ratio"
FORCE = gives("contact_force_per_torque_N_per_Nm", "contact force without friction for each N·m of input torque", None)


@formula(
    "joint angles of a double cardan joint centred by a ball on one shaft, and its speed fluctuation",
    "triangle of the centres, exact; Kozhevnikov & Perfil'ev (1978), eq. 8–12",
    JOINT_ANGLE,
    positive("lambda_", "distance of the ball from the first centre over that of the centres", below=1.0),
    "alpha12_rad: joint angle of the first joint",
    "alpha23_rad: joint angle of the second joint",
    "Delta_rad: by how much the joint angle is not halved",
    "Delta_book12_rad: the same by the book's approximation",
    "x_over_l: distance of the ball from the second centre over that of the centres",
    *RATIOS,
)
def _double_cardan_centring(v: Values) -> Any:
    joint_angle, share = v.alpha, v.lambda_
    first, second = double_cardan.split(joint_angle, share)
    lag, book = double_cardan.lag(joint_angle, share), double_cardan.lag_book(joint_angle, share)
    return first, second, lag, book, double_cardan.slide(joint_angle, share), *_ratios(first, second)


@formula(
    "centring ratio of a double cardan joint that is most uniform over a range of joint angles",
    "minimax of the exact speed fluctuation",
    positive("alpha_max_deg", "largest joint angle", below=RIGHT),
    joint_angle("alpha_min_deg", "smallest joint angle", default=0.0),
    "lambda_minimax: best centring ratio",
    "irregularity_max: largest speed fluctuation with it",
    "lambda_sync_at_alpha_max: centring ratio that is exact at the largest joint angle",
    "irregularity_max_lambda_half: largest speed fluctuation with the ball in the middle",
    check=_between,
)
def _centring_optimum(v: Values) -> Any:
    found = best_centring(v.alpha_max, v.alpha_min)
    return found.share, found.speed_fluctuation, found.even_share, found.middle_speed_fluctuation


@formula(
    "speed fluctuation of two joints whose three axes lie in one plane",
    "Möbius product; the equivalent joint in closed form",
    joint_angle("alpha12_deg", "joint angle of the first joint"),
    joint_angle("alpha23_deg", "joint angle of the second joint"),
    word("yokes", "how the inner yokes stand to each other", "in_plane", "crossed", default="in_plane"),
    *RATIOS,
)
def _double_cardan_irregularity(v: Values) -> Any:
    return _ratios(v.alpha12, v.alpha23, crossed=v.yokes == "crossed")


@formula(
    "where the straight pins of a pin coupling touch, and its speed fluctuation",
    "line and cone, exact; completes Kozhevnikov & Perfil'ev (1978), eq. 3–7",
    JOINT_ANGLE,
    positive("a_m", "distance from the crossing of the axes at which pin 1 starts"),
    positive("b_m", "distance from the crossing of the axes at which pin 2 starts"),
    given("theta1_deg", "slant of pin 1 to its axis"),
    given("theta2_deg", "slant of pin 2 to its axis"),
    (TURN, ANGLE_ERROR),
    "x_m: distance of the contact along pin 1",
    "y_m: distance of the contact along pin 2",
    (RATIO, FORCE),
    check=_slants,
)
def _pin_coupling(v: Values) -> Any:
    names = ("alpha", "a", "b", "theta1", "theta2")
    found = pin_coupling.pin_contact(np.asarray(v.phi1, dtype=float), *(v[name] for name in names))
    if not np.all(np.isfinite(found.first)):
        text = _("pin 1 does not meet pin 2 all the way round with these distances and slants")
        raise refuse("theta2", text, "singular")
    return found.deviation, found.first, found.second, found.ratio, found.force


@formula(
    "how far the contact of a pin coupling with pins alike runs along them",
    "closed form of the contact in the bisecting plane",
    JOINT_ANGLE,
    positive("a_m", "distance from the crossing of the axes at which the pins start"),
    given("theta_deg", "slant of the pins to their axes"),
    "x_min_m: least distance of the contact along a pin",
    "x_max_m: greatest distance of the contact along a pin",
    "ball_path_eccentricity: eccentricity of the ellipse on which the contact runs",
    "theta_min_deg: slant above which the pins turn all the way round",
    "theta_max_deg: slant below which they do",
    check=_slants,
)
def _pin_stroke(v: Values) -> Any:
    least, most = pin_coupling.stroke(v.alpha, v.a, v.theta)
    low, high = pin_coupling.slant_range(v.alpha)
    return least, most, pin_coupling.eccentricity(v.alpha, v.theta), low, high


@formula(
    "pins alike that touch with the smallest force in a given room",
    "smallest largest contact force of the exact contact",
    positive("alpha_max_deg", "largest joint angle", below=RIGHT),
    positive("radius_m", "largest distance of the contact from the axes"),
    joint_angle("margin_deg", "how far the slant stays from both ends of its range", default=MARGIN),
    "theta_deg = slant: slant of the pins to their axes",
    "a_m = distance: distance from the crossing of the axes at which the pins start",
    "stroke_m = stroke: way of the contact along a pin at the largest joint angle",
    "length_m = length: length that a pin needs from its start",
    FORCE,
    "lead_per_m_rad = angle_error: largest lead for each metre by which the distances of both pins differ",
    "theta_min_deg: slant above which the pins turn all the way round",
    "theta_max_deg: slant below which they do",
)
def _pin_geometry(v: Values) -> Any:
    found = best_pins(v.alpha_max, v.radius, margin=v.margin)
    return found, {
        "contact_force_per_torque_N_per_Nm": found.force,
        "theta_min_deg": found.slant_range[0],
        "theta_max_deg": found.slant_range[1],
    }


@formula(
    "speed fluctuation of a coupling with circular profiles: Clemens, curved grooves",
    "contact of two circles in their meridian planes",
    (JOINT_ANGLE, _profile(1), _profile(2), TURN, ANGLE_ERROR, RATIO),
    "contact_axial1_m: height of the contact along shaft 1",
    "contact_radial1_m: distance of the contact from the axis of shaft 1",
    "contact_axial2_m: height of the contact along shaft 2",
    "contact_radial2_m: distance of the contact from the axis of shaft 2",
    FORCE,
)
def _profile_coupling(v: Values) -> Any:
    first, second = (clemens.Circle(**v[name]) for name in ("circle1", "circle2"))
    found = clemens.profile_contact(np.asarray(v.phi1, dtype=float), v.alpha, first, second)
    if not np.all(np.isfinite(found.deviation)):
        raise refuse("circle2", _("the profile does not meet that of shaft 1 all the way round"), "singular")
    return found.deviation, found.ratio, found.height1, found.radius1, found.height2, found.radius2, found.force


@formula(
    "turn and wobble of the output shaft of a joint whose cross axes do not meet",
    "loop of the joint, exact; Kozhevnikov & Perfil'ev (1978), Fig. 6",
    joint_angle("alpha_deg", "angle between shaft 1 and the line from pin 1 to the support"),
    at_least_zero("cross_offset_m", "distance of the axes of the cross"),
    positive("support_distance_m", "distance of the output support from pin 1"),
    given("phi1_deg", "input angle of pin 1 from the plane of the shafts", axes=(0, 1)),
    whole("cross_sign", "1 where pin 2 lies toward the support, -1 where away", default=1),
    "phi2_rad: output angle",
    "shaft_tilt_rad: angle of the output shaft with the line to its support",
    "joint_to_support_m: length of the output shaft from pin 2 to its support",
    "nutation_half_angle_rad: half angle of its wobble, to first order",
    check=_support,
)
def _offset_cross(v: Values) -> Any:
    angle, joint_angle = np.asarray(v.phi1, dtype=float), v.alpha
    size = v.cross_offset, v.support_distance
    case = angle, joint_angle, *size, v.cross_sign
    turned, wobble = offset_cross.output_angle(angle, joint_angle), offset_cross.wobble(joint_angle, *size)
    return turned, offset_cross.tilt(*case), offset_cross.span(*case), wobble
