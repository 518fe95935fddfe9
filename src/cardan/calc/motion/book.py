"""Formulas of the book, to be compared with the exact ones."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.comparison import (
    OutputMotion,
    arrangement_phase,
    blokh,
    book_comparison,
    book_series,
    collinear_joint_angle,
    double_joint,
    double_joint_law,
    rule_of_practice,
)
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.reading.given import given, joint_angle, whole, word
from cardan.texts import _

from .kinematics import ANGLE, START, YOKES, between, drives, joint_angles, points, twists

formula = Formulas(__doc__)

_CHAIN = (joint_angles(default=None), twists(), points(default=None), YOKES, START)
_MOTION = (
    "lead_deg: output angle minus input angle, continuous",
    "phi_out_deg: output angle from the start, continuous",
    "ratio: speed ratio",
    "eps_over_omega1_sq: acceleration over the square of the input speed",
)


_CURVES = tuple(key.partition(":")[0] for key in _MOTION)


def _curves(v: Values, moved: OutputMotion) -> dict[str, Any]:
    values = moved.angle_error, moved.output_angle, moved.ratio, moved.slope
    return dict(zip(_CURVES, map(v.single("phi1"), values), strict=True))


def _collinear_check(v: Values) -> Problems:
    alpha, sign = v.get("alpha"), v.get("sign")
    if alpha is not None and not alpha.shape[-1]:
        yield v.wrong("alpha", _("an empty list has no joint"))
    if sign is not None and not np.all(np.abs(sign) == 1):
        yield v.wrong("sign", _("only 1 and -1 are signs"))
    if alpha is not None and sign is not None and sign.shape not in (alpha.shape, alpha.shape[-1:]):
        text = _("shape {shape} does not fit the joint angles; {wanted} is needed")
        yield v.wrong("sign", text.format(shape=sign.shape, wanted=alpha.shape))


def _series_check(v: Values) -> Problems:
    yield from between(v)
    if v.get("order") == 2 and v.get("phases", "exact") != "exact":
        yield v.wrong("phases", _("the second order takes exact phases"))


@formula(
    "output motion by Blokh's closed form, freed of its poles",
    "Kozhevnikov & Perfil'ev (1978), eq. 35–37",
    (*_CHAIN, ANGLE, *_MOTION),
    check=between,
)
def _blokh(v: Values) -> Any:
    return _curves(v, blokh(drives(v), np.atleast_1d(v.phi1)))


@formula(
    "output motion by the book's series of first or second order",
    "Kozhevnikov & Perfil'ev (1978), eq. 47–74",
    (*_CHAIN, ANGLE),
    whole("order", "order of the series", low=1, high=2, default=1),
    word("amplitude", "amplitude of a joint: α²/4 or tan²(α/2)", "quarter", "tau", default="quarter"),
    word("phases", "phases of the joints", "exact", "mean", "without_theta", default="exact"),
    *_MOTION,
    "theta_deg = constant: constant Θ_n",
    "a_n1 = a1: coefficient of sin 2φ [rad]",
    "b_n1 = b1: coefficient of cos 2φ [rad]",
    "a_n2 = a2: coefficient of sin 4φ [rad]",
    "b_n2 = b2: coefficient of cos 4φ [rad]",
    "s_n1 = amplitude: amplitude of the second order of the turn [rad]",
    "delta_n1_mod180_deg = phase: its phase",
    "delta_80 = speed_fluctuation: speed fluctuation by (80)",
    check=_series_check,
)
def _book_series(v: Values) -> Any:
    found = book_series(drives(v), v.order, amplitude=v.amplitude, phases=v.phases)
    at, phi = v.single("phi1"), np.atleast_1d(v.phi1)
    ahead = found.angle_error(phi)
    return found, dict(zip(_CURVES, map(at, (ahead, phi + ahead, found.ratio(phi), found.slope(phi))), strict=True))


@formula(
    "what the book's approximations say of a chain, beside the exact answer",
    "Kozhevnikov & Perfil'ev (1978), eq. 59–80",
    *_CHAIN,
    "delta = speed_fluctuation: speed fluctuation, exact",
    "delta_80 = speed_fluctuation_80: speed fluctuation by (80), exact phases",
    "delta_80_mean_phases = speed_fluctuation_mean_phases: speed fluctuation by (80), mean phases",
    "delta_80_without_theta = speed_fluctuation_without_theta: speed fluctuation by (80), phases without Θ",
    "worst_first_order_deg = worst_first_order: largest angle error of the first order over a turn",
    "worst_second_order_deg = worst_second_order: largest angle error of the second order over a turn",
    "alpha_eq_deg = joint_angle: equivalent angle, exact",
    "alpha_eq_rule_deg = rule_of_practice: equivalent angle by the rule of practice",
    check=between,
)
def _book_comparison(v: Values) -> Any:
    return book_comparison(drives(v))


@formula(
    "double joint in one of the four arrangements of Fig. 62",
    "Kozhevnikov & Perfil'ev (1978), eq. 26–30, Fig. 62",
    joint_angle("alpha12_deg", "joint angle of joint 1"),
    joint_angle("alpha23_deg", "joint angle of joint 2"),
    word("arrangement", "letter of the arrangement", "a", "b", "c", "d"),
    given("beta2_deg", "plane twist, arrangements c and d", default=None),
    given("gamma2_deg", "yoke angle of shaft 2, arrangements b and d", default=None),
    given("phi1_deg", "input angle from the start position", axes=(0, 1), default=0.0),
    "psi2_deg: phase angle of joint 2",
    "delta: speed fluctuation",
    "alpha_eq_deg: equivalent angle",
    *_MOTION,
)
def _double_joint(v: Values) -> Any:
    phase = arrangement_phase(v.arrangement, plane_twist=v.beta2, yoke_angle=v.gamma2)
    one, two = v.alpha12, v.alpha23
    law = double_joint_law(one, two, phase)
    moved = double_joint(one, two, phase, np.atleast_1d(v.phi1))
    return {"psi2_deg": phase, "delta": law.speed_fluctuation, "alpha_eq_deg": law.joint_angle, **_curves(v, moved)}


@formula(
    "equivalent angle by the rule of practice √|Σ ±α²|",
    "workshop practice; first order of the hyperbolic polygon",
    *_CHAIN,
    "alpha_eq_rule_deg: equivalent angle",
    check=between,
)
def _rule_of_practice(v: Values) -> Any:
    return rule_of_practice(drives(v))


@formula(
    "exact equivalent angle of joints that work with or straight against one another",
    "cos α_eq = Π cos^±1 α_i",
    joint_angles(),
    whole("sign", "1 for a joint that works with the first, -1 against it", axes=(1, 2), low=-1),
    "alpha_eq_deg: equivalent angle",
    check=_collinear_check,
)
def _collinear_joints(v: Values) -> Any:
    return collinear_joint_angle(v.alpha, v.sign)
