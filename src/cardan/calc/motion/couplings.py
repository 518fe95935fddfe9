"""Calculations of other joints: centred double joints, pin couplings, couplings with profiles, crossed axes."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.calc.calculation import Calculation, Given, Values, at_least_zero, given, gives, positive, record
from cardan.drive.joints.laws import double_cardan, offset_cross, pin_coupling, profile_coupling
from cardan.errors import Problem, refuse
from cardan.formulas.centring import best_centring
from cardan.formulas.pin_geometry import MARGIN, best_pins
from cardan.texts import _, mark
from cardan.units import deg

from .kinematics import RIGHT

EDGE = 1e-12
"""Slants this near an end of their range [rad] stand on it, whatever rounding says."""


def _joint_angle(key: str, doc: str) -> Given:
    return given(key, doc, "angle", low=0.0, below=RIGHT)


JOINT_ANGLE = _joint_angle("alpha_deg", mark("joint angle between the outer shafts"))
TURN = given("phi1_deg", mark("input angle from the inner side of the joint angle"), "angle", axes=(0, 1))


def _ratios(first: float, second: float, *, crossed: bool = False) -> Values:
    gain = double_cardan.gain(first, second, crossed=crossed)
    return {
        "ratio_max": max(gain, 1.0 / gain),
        "ratio_min": min(gain, 1.0 / gain),
        "irregularity": abs(double_cardan.unevenness(first, second, crossed=crossed)),
    }


RATIOS = (
    gives("ratio_max", mark("largest speed ratio over a turn")),
    gives("ratio_min", mark("smallest speed ratio over a turn")),
    gives("irregularity", mark("speed fluctuation of the output")),
)


def _centring(values: Values) -> Values:
    joint_angle, share = values["alpha"], values["lambda_"]
    first, second = double_cardan.split(joint_angle, share)
    return {
        "alpha12_rad": first,
        "alpha23_rad": second,
        "Delta_rad": double_cardan.lag(joint_angle, share),
        "Delta_book12_rad": double_cardan.lag_book(joint_angle, share),
        "x_over_l": double_cardan.slide(joint_angle, share),
        **_ratios(first, second),
    }


def _optimum(values: Values) -> Values:
    found = best_centring(values["alpha_max"], values["alpha_min"])
    return {
        "lambda_minimax": found.share,
        "irregularity_max": found.speed_fluctuation,
        "lambda_sync_at_alpha_max": found.even_share,
        "irregularity_max_lambda_half": found.middle_speed_fluctuation,
    }


def _two_joints(values: Values) -> Values:
    return _ratios(values["alpha12"], values["alpha23"], crossed=values["yokes"] == "crossed")


def _between(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    least, most = values.get("alpha_min"), values.get("alpha_max")
    if least is not None and most is not None and least >= most:
        yield Problem(key("alpha_min"), _("is not below {other}").format(other=key("alpha_max")), "inconsistent")


def _slants(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield slants of pins with which they do not turn all the way round."""
    if values.get("alpha") is None:
        return
    low, high = pin_coupling.slant_range(values["alpha"])
    for name in ("theta1", "theta2", "theta"):
        slant = values.get(name)
        if slant is not None and not low + EDGE < slant < high - EDGE:
            text = _(
                "{value}° is not between {low}° and {high}°, where pins turn all the way round at this joint angle"
            )
            shown = {"value": slant / deg, "low": low / deg, "high": high / deg}
            text = text.format(**{what: f"{angle:.6g}" for what, angle in shown.items()})
            yield Problem(key(name), text, "out_of_range")


def _pins(values: Values) -> Values:
    names = ("alpha", "a", "b", "theta1", "theta2")
    found = pin_coupling.pin_contact(np.asarray(values["phi1"], dtype=float), *(values[name] for name in names))
    if not np.all(np.isfinite(found.first)):
        text = _("pin 1 does not meet pin 2 all the way round with these distances and slants")
        raise refuse("theta2", text, "singular")
    return {
        "phi2_minus_phi1_rad": found.deviation,
        "x_m": found.first,
        "y_m": found.second,
        "ratio_21": found.ratio,
        "contact_force_per_torque_N_per_Nm": found.force,
    }


def _stroke(values: Values) -> Values:
    least, most = pin_coupling.stroke(values["alpha"], values["a"], values["theta"])
    low, high = pin_coupling.slant_range(values["alpha"])
    return {
        "x_min_m": least,
        "x_max_m": most,
        "ball_path_eccentricity": pin_coupling.eccentricity(values["alpha"], values["theta"]),
        "theta_min_deg": low,
        "theta_max_deg": high,
    }


def _geometry(values: Values) -> Values:
    found = best_pins(values["alpha_max"], values["radius"], margin=values["margin"])
    return {
        "theta_deg": found.slant,
        "a_m": found.distance,
        "stroke_m": found.stroke,
        "length_m": found.length,
        "contact_force_per_torque_N_per_Nm": found.force,
        "lead_per_m_rad": found.angle_error,
        "theta_min_deg": found.slant_range[0],
        "theta_max_deg": found.slant_range[1],
    }


def _profiles(values: Values) -> Values:
    first, second = (profile_coupling.Circle(**values[name]) for name in ("circle1", "circle2"))
    found = profile_coupling.profile_contact(np.asarray(values["phi1"], dtype=float), values["alpha"], first, second)
    if not np.all(np.isfinite(found.deviation)):
        raise refuse("circle2", _("the profile does not meet that of shaft 1 all the way round"), "singular")
    return {
        "phi2_minus_phi1_rad": found.deviation,
        "ratio_21": found.ratio,
        "contact_axial1_m": found.height1,
        "contact_radial1_m": found.radius1,
        "contact_axial2_m": found.height2,
        "contact_radial2_m": found.radius2,
        "contact_force_per_torque_N_per_Nm": found.force,
    }


def _support(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    offset, reach = values.get("cross_offset"), values.get("support_distance")
    if offset is not None and reach is not None and reach <= offset:
        text = _("is not above {other}: the support would stand within the joint")
        yield Problem(key("support_distance"), text.format(other=key("cross_offset")), "inconsistent")
    if values.get("cross_sign") not in (None, -1, 1):
        yield Problem(key("cross_sign"), _("{value} is neither 1 nor -1").format(value=values["cross_sign"]))


def _crossed(values: Values) -> Values:
    angle, joint_angle = np.asarray(values["phi1"], dtype=float), values["alpha"]
    size = values["cross_offset"], values["support_distance"]
    return {
        "phi2_rad": offset_cross.output_angle(angle, joint_angle),
        "shaft_tilt_rad": offset_cross.tilt(angle, joint_angle, *size, values["cross_sign"]),
        "joint_to_support_m": offset_cross.span(angle, joint_angle, *size, values["cross_sign"]),
        "nutation_half_angle_rad": offset_cross.wobble(joint_angle, *size),
    }


def _profile(number: int) -> Given:
    return record(
        f"circle{number}",
        _("circular profile of shaft {number} in its meridian plane").format(number=number),
        given("axial_m", mark("height of the centre along the shaft, from the crossing of the axes"), "length"),
        given("radial_m", mark("distance of the centre from the axis"), "length"),
        positive("radius_m", mark("radius of the profile"), "length"),
    )


ANGLE_ERROR = gives("phi2_minus_phi1_rad", mark("lead of the output over the input"), "angle")
RATIO = gives("ratio_21", mark("speed ratio"))
FORCE = gives("contact_force_per_torque_N_per_Nm", mark("contact force without friction for each N·m of input torque"))

CALCULATIONS = (
    Calculation(
        name="double_cardan_centring",
        doc=mark("joint angles of a double cardan joint centred by a ball on one shaft, and how uneven it is"),
        source="triangle of the centres, exact; Kozhevnikov & Perfil'ev (1978), eq. 8–12",
        takes=(
            JOINT_ANGLE,
            given(
                "lambda_",
                mark("distance of the ball from the first centre over that of the centres"),
                above=0.0,
                below=1.0,
            ),
        ),
        returns=(
            gives("alpha12_rad", mark("joint angle of the first joint"), "angle"),
            gives("alpha23_rad", mark("joint angle of the second joint"), "angle"),
            gives("Delta_rad", mark("by how much the joint angle is not halved"), "angle"),
            gives("Delta_book12_rad", mark("the same by the book's approximation"), "angle"),
            gives("x_over_l", mark("distance of the ball from the second centre over that of the centres")),
            *RATIOS,
        ),
        answer=_centring,
    ),
    Calculation(
        name="centring_optimum",
        doc=mark("centring ratio of a double cardan joint that is most even over a range of joint angles"),
        source="minimax of the exact speed fluctuation",
        takes=(
            given("alpha_max_deg", mark("largest joint angle"), "angle", above=0.0, below=RIGHT),
            given("alpha_min_deg", mark("smallest joint angle"), "angle", low=0.0, below=RIGHT, default=0.0),
        ),
        returns=(
            gives("lambda_minimax", mark("best centring ratio")),
            gives("irregularity_max", mark("largest speed fluctuation with it")),
            gives("lambda_sync_at_alpha_max", mark("centring ratio that is exact at the largest joint angle")),
            gives("irregularity_max_lambda_half", mark("largest speed fluctuation with the ball in the middle")),
        ),
        answer=_optimum,
        check=_between,
    ),
    Calculation(
        name="double_cardan_irregularity",
        doc=mark("speed fluctuation of two joints whose three axes lie in one plane"),
        source="Möbius product; the equivalent joint in closed form",
        takes=(
            _joint_angle("alpha12_deg", mark("joint angle of the first joint")),
            _joint_angle("alpha23_deg", mark("joint angle of the second joint")),
            given(
                "yokes",
                mark("how the inner yokes stand to each other"),
                kind="word",
                choices=("in_plane", "crossed"),
                default="in_plane",
            ),
        ),
        returns=RATIOS,
        answer=_two_joints,
    ),
    Calculation(
        name="pin_coupling",
        doc=mark("where the straight pins of a pin coupling touch, and how uneven it runs"),
        source="line and cone, exact; completes Kozhevnikov & Perfil'ev (1978), eq. 3–7",
        takes=(
            JOINT_ANGLE,
            positive("a_m", mark("distance from the crossing of the axes at which pin 1 starts"), "length"),
            positive("b_m", mark("distance from the crossing of the axes at which pin 2 starts"), "length"),
            given("theta1_deg", mark("slant of pin 1 to its axis"), "angle"),
            given("theta2_deg", mark("slant of pin 2 to its axis"), "angle"),
            TURN,
        ),
        returns=(
            ANGLE_ERROR,
            gives("x_m", mark("distance of the contact along pin 1"), "length"),
            gives("y_m", mark("distance of the contact along pin 2"), "length"),
            RATIO,
            FORCE,
        ),
        answer=_pins,
        check=_slants,
    ),
    Calculation(
        name="pin_stroke",
        doc=mark("how far the contact of a pin coupling with pins alike runs along them"),
        source="closed form of the contact in the bisecting plane",
        takes=(
            JOINT_ANGLE,
            positive("a_m", mark("distance from the crossing of the axes at which the pins start"), "length"),
            given("theta_deg", mark("slant of the pins to their axes"), "angle"),
        ),
        returns=(
            gives("x_min_m", mark("least distance of the contact along a pin"), "length"),
            gives("x_max_m", mark("greatest distance of the contact along a pin"), "length"),
            gives("ball_path_eccentricity", mark("eccentricity of the ellipse on which the contact runs")),
            gives("theta_min_deg", mark("slant above which the pins turn all the way round"), "angle"),
            gives("theta_max_deg", mark("slant below which they do"), "angle"),
        ),
        answer=_stroke,
        check=_slants,
    ),
    Calculation(
        name="pin_geometry",
        doc=mark("pins alike that touch with the smallest force in a given room"),
        source="smallest largest contact force of the exact contact",
        takes=(
            given("alpha_max_deg", mark("largest joint angle"), "angle", above=0.0, below=RIGHT),
            positive("radius_m", mark("largest distance of the contact from the axes"), "length"),
            given(
                "margin_deg",
                mark("how far the slant stays from both ends of its range"),
                "angle",
                low=0.0,
                below=RIGHT,
                default=MARGIN,
            ),
        ),
        returns=(
            gives("theta_deg", mark("slant of the pins to their axes"), "angle"),
            gives("a_m", mark("distance from the crossing of the axes at which the pins start"), "length"),
            gives("stroke_m", mark("way of the contact along a pin at the largest joint angle"), "length"),
            gives("length_m", mark("length that a pin needs from its start"), "length"),
            FORCE,
            gives(
                "lead_per_m_rad",
                mark("largest lead for each metre by which the distances of both pins differ"),
                "angle",
            ),
            gives("theta_min_deg", mark("slant above which the pins turn all the way round"), "angle"),
            gives("theta_max_deg", mark("slant below which they do"), "angle"),
        ),
        answer=_geometry,
    ),
    Calculation(
        name="profile_coupling",
        doc=mark("how uneven a coupling with circular profiles runs: Clemens, curved grooves"),
        source="contact of two circles in their meridian planes",
        takes=(JOINT_ANGLE, _profile(1), _profile(2), TURN),
        returns=(
            ANGLE_ERROR,
            RATIO,
            gives("contact_axial1_m", mark("height of the contact along shaft 1"), "length"),
            gives("contact_radial1_m", mark("distance of the contact from the axis of shaft 1"), "length"),
            gives("contact_axial2_m", mark("height of the contact along shaft 2"), "length"),
            gives("contact_radial2_m", mark("distance of the contact from the axis of shaft 2"), "length"),
            FORCE,
        ),
        answer=_profiles,
    ),
    Calculation(
        name="offset_cross",
        doc=mark("turn and wobble of the output shaft of a joint whose cross axes do not meet"),
        source="loop of the joint, exact; Kozhevnikov & Perfil'ev (1978), Fig. 6",
        takes=(
            _joint_angle("alpha_deg", mark("angle between shaft 1 and the line from pin 1 to the support")),
            at_least_zero("cross_offset_m", mark("distance of the axes of the cross"), "length"),
            positive("support_distance_m", mark("distance of the output support from pin 1"), "length"),
            given("phi1_deg", mark("input angle of pin 1 from the plane of the shafts"), "angle", axes=(0, 1)),
            given("cross_sign", mark("1 where pin 2 lies toward the support, -1 where away"), kind="whole", default=1),
        ),
        returns=(
            gives("phi2_rad", mark("output angle"), "angle"),
            gives("shaft_tilt_rad", mark("angle of the output shaft with the line to its support"), "angle"),
            gives("joint_to_support_m", mark("length of the output shaft from pin 2 to its support"), "length"),
            gives("nutation_half_angle_rad", mark("half angle of its wobble, to first order"), "angle"),
        ),
        answer=_crossed,
        check=_support,
    ),
)
