"""Calculations of the book, by name, to be compared with the exact ones."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.book.comparison import book_comparison, book_series, collinear_joint_angle, rule_of_practice
from cardan.book.forms import OutputMotion, arrangement_phase, blokh, double_joint, double_joint_law
from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.errors import Problem
from cardan.texts import _, mark

from .kinematics import ANGLE, RIGHT, START, YOKES, between, drives, joint_angles, points, twists

_CHAIN = (joint_angles(default=None), twists(), points(default=None), YOKES, START)
_MOTION = (
    gives("lead_deg", mark("output angle minus input angle, continuous"), "angle"),
    gives("phi_out_deg", mark("output angle from the start, continuous"), "angle"),
    gives("ratio", mark("speed ratio")),
    gives("eps_over_omega1_sq", mark("acceleration over the square of the input speed")),
)


def _at(values: Values) -> Callable[[Any], Any]:
    return (lambda array: array[..., 0]) if np.ndim(values["phi1"]) == 0 else (lambda array: array)


def _curves(values: Values, moved: OutputMotion) -> Values:
    at = _at(values)
    return {
        "lead_deg": at(moved.angle_error),
        "phi_out_deg": at(moved.output_angle),
        "ratio": at(moved.ratio),
        "eps_over_omega1_sq": at(moved.slope),
    }


def _blokh(values: Values) -> Values:
    return _curves(values, blokh(drives(values), np.atleast_1d(values["phi1"])))


def _series(values: Values) -> Values:
    found = book_series(drives(values), values["order"], amplitude=values["amplitude"], phases=values["phases"])
    at, phi = _at(values), np.atleast_1d(values["phi1"])
    return {
        "lead_deg": at(found.angle_error(phi)),
        "phi_out_deg": at(phi + found.angle_error(phi)),
        "ratio": at(found.ratio(phi)),
        "eps_over_omega1_sq": at(found.slope(phi)),
        "theta_deg": found.constant,
        "a_n1": found.a1,
        "b_n1": found.b1,
        "a_n2": found.a2,
        "b_n2": found.b2,
        "s_n1": found.amplitude,
        "delta_n1_mod180_deg": found.phase,
        "delta_80": found.speed_fluctuation,
    }


def _comparison(values: Values) -> Values:
    found = book_comparison(drives(values))
    return {
        "delta": found.speed_fluctuation,
        "delta_80": found.speed_fluctuation_80,
        "delta_80_mean_phases": found.speed_fluctuation_mean_phases,
        "delta_80_without_theta": found.speed_fluctuation_without_theta,
        "worst_first_order_deg": found.worst_first_order,
        "worst_second_order_deg": found.worst_second_order,
        "alpha_eq_deg": found.joint_angle,
        "alpha_eq_rule_deg": found.rule_of_practice,
    }


def _double(values: Values) -> Values:
    phase = arrangement_phase(values["arrangement"], plane_twist=values["beta2"], yoke_angle=values["gamma2"])
    one, two = values["alpha12"], values["alpha23"]
    law = double_joint_law(one, two, phase)
    moved = double_joint(one, two, phase, np.atleast_1d(values["phi1"]))
    return {
        "psi2_deg": phase,
        "delta": law.speed_fluctuation,
        "alpha_eq_deg": law.joint_angle,
        **_curves(values, moved),
    }


def _rule(values: Values) -> Values:
    return {
        "alpha_eq_rule_deg": rule_of_practice(drives(values)),
    }


def _collinear(values: Values) -> Values:
    return {"alpha_eq_deg": collinear_joint_angle(values["alpha"], values["sign"])}


def _collinear_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    alpha, sign = values.get("alpha"), values.get("sign")
    if alpha is not None and not alpha.shape[-1]:
        yield Problem(key("alpha"), _("an empty list has no joint"))
    if sign is not None and not np.all(np.abs(sign) == 1):
        yield Problem(key("sign"), _("only 1 and -1 are signs"))
    if alpha is not None and sign is not None and sign.shape not in (alpha.shape, alpha.shape[-1:]):
        text = _("shape {shape} does not fit the joint angles; {wanted} is needed")
        yield Problem(key("sign"), text.format(shape=sign.shape, wanted=alpha.shape))


def _series_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from between(values, key)
    if values.get("order") == 2 and values.get("phases", "exact") != "exact":
        yield Problem(key("phases"), _("the second order takes exact phases"))


CALCULATIONS = (
    Calculation(
        name="blokh",
        doc=mark("output motion by Blokh's closed form, freed of its poles"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 35–37",
        takes=(*_CHAIN, ANGLE),
        returns=_MOTION,
        answer=_blokh,
        check=between,
    ),
    Calculation(
        name="book_series",
        doc=mark("output motion by the book's series of first or second order"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 47–74",
        takes=(
            *_CHAIN,
            ANGLE,
            given("order", mark("order of the series"), kind="whole", low=1, high=2, default=1),
            given(
                "amplitude",
                mark("amplitude of a joint: α²/4 or tan²(α/2)"),
                kind="word",
                choices=("quarter", "tau"),
                default="quarter",
            ),
            given(
                "phases",
                mark("phases of the joints"),
                kind="word",
                choices=("exact", "mean", "without_theta"),
                default="exact",
            ),
        ),
        returns=(
            *_MOTION,
            gives("theta_deg", mark("constant Θ_n"), "angle"),
            gives("a_n1", mark("coefficient of sin 2φ [rad]")),
            gives("b_n1", mark("coefficient of cos 2φ [rad]")),
            gives("a_n2", mark("coefficient of sin 4φ [rad]")),
            gives("b_n2", mark("coefficient of cos 4φ [rad]")),
            gives("s_n1", mark("amplitude of the second order of the turn [rad]")),
            gives("delta_n1_mod180_deg", mark("its phase"), "angle"),
            gives("delta_80", mark("speed fluctuation by (80)")),
        ),
        answer=_series,
        check=_series_check,
    ),
    Calculation(
        name="book_comparison",
        doc=mark("what the book's approximations say of a chain, beside the exact answer"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 59–80",
        takes=_CHAIN,
        returns=(
            gives("delta", mark("speed fluctuation, exact")),
            gives("delta_80", mark("speed fluctuation by (80), exact phases")),
            gives("delta_80_mean_phases", mark("speed fluctuation by (80), mean phases")),
            gives("delta_80_without_theta", mark("speed fluctuation by (80), phases without Θ")),
            gives("worst_first_order_deg", mark("largest angle error of the first order over a turn"), "angle"),
            gives("worst_second_order_deg", mark("largest angle error of the second order over a turn"), "angle"),
            gives("alpha_eq_deg", mark("equivalent angle, exact"), "angle"),
            gives("alpha_eq_rule_deg", mark("equivalent angle by the rule of practice"), "angle"),
        ),
        answer=_comparison,
        check=between,
    ),
    Calculation(
        name="double_joint",
        doc=mark("double joint in one of the four arrangements of Fig. 62"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 26–30, Fig. 62",
        takes=(
            given("alpha12_deg", mark("joint angle of joint 1"), "angle", low=0.0, below=RIGHT),
            given("alpha23_deg", mark("joint angle of joint 2"), "angle", low=0.0, below=RIGHT),
            given("arrangement", mark("letter of the arrangement"), kind="word", choices=("a", "b", "c", "d")),
            given("beta2_deg", mark("plane twist, arrangements c and d"), "angle", default=None),
            given("gamma2_deg", mark("yoke angle of shaft 2, arrangements b and d"), "angle", default=None),
            given("phi1_deg", mark("input angle from the start position"), "angle", axes=(0, 1), default=0.0),
        ),
        returns=(
            gives("psi2_deg", mark("phase angle of joint 2"), "angle"),
            gives("delta", mark("irregularity")),
            gives("alpha_eq_deg", mark("equivalent angle"), "angle"),
            *_MOTION,
        ),
        answer=_double,
    ),
    Calculation(
        name="rule_of_practice",
        doc=mark("equivalent angle by the rule of practice √|Σ ±α²|"),
        source=mark("workshop practice; first order of the hyperbolic polygon"),
        takes=_CHAIN,
        returns=(gives("alpha_eq_rule_deg", mark("equivalent angle"), "angle"),),
        answer=_rule,
        check=between,
    ),
    Calculation(
        name="collinear_joints",
        doc=mark("exact equivalent angle of joints that work with or straight against one another"),
        source="cos α_eq = Π cos^±1 α_i",
        takes=(
            joint_angles(),
            given(
                "sign",
                mark("1 for a joint that works with the first, -1 against it"),
                kind="whole",
                axes=(1, 2),
                low=-1,
            ),
        ),
        returns=(gives("alpha_eq_deg", mark("equivalent angle"), "angle"),),
        answer=_collinear,
        check=_collinear_check,
    ),
)
