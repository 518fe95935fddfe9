"""Losses: one joint, a chain of joints, splines, branches, seals, coefficients of journals."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.calc.motion.kinematics import START, YOKES, between, drives, joint_angles, joints_of, points, twists
from cardan.errors import Problem, check
from cardan.formulas.friction import (
    branch_efficiency,
    joint_friction,
    reduced_friction,
    seal_friction,
    spline_efficiency,
)
from cardan.questions.losses.chain_friction import chain_friction
from cardan.reading.given import at_least_zero, joint_angle, positive, word
from cardan.texts import _

formula = Formulas(__doc__)

CONSTANT = word("constant_torque", "where the torque is constant", "output", "input", default="output")
"""Where the torque is constant."""


def _bearings(v: Values) -> Problems:
    """Yield what misses beside the friction of the shafts' bearings."""
    if v.get("mu_bearing_reduced"):
        yield from v.missing(v.key("mu_bearing_reduced"), "bearing_diameter", "bearing_span")


def _frictions(v: Values) -> Problems:
    """Yield what is wrong with a chain, and a list that has not one coefficient for each joint."""
    yield from between(v)
    joints = joints_of(v)
    if joints is not None:
        yield from v.miscounted(joints, "kappa_mu_dc_over_d")


_SPLINE = ("mu_spline", "stroke", "strokes_per_s", "spline_diameter", "rev_per_s")
_BRANCHES = ("branch_useful_work", "branch_eta")


def _parts(v: Values) -> Problems:
    """Yield a part of which some is given and some is missing, and lists of branches that differ in length."""
    given_any = False
    for group in (_SPLINE, _BRANCHES, ("mu_material",)):
        there = [name for name in group if v.get(name) is not None]
        given_any |= bool(there) or any(name not in v for name in group)
        if there:
            yield from v.missing(v.key(there[0]), *group)
    if not given_any:
        yield v.wrong("mu_spline", _("missing; give a spline, or branch_useful_work_J, or mu_material"))
    work, eta = (v.get(name) for name in _BRANCHES)
    if work is not None and not np.sum(work) > 0.0:
        yield v.wrong("branch_useful_work", _("no branch does any work"))
    if work is not None and eta is not None:
        yield from v.miscounted(work.shape[-1], "branch_eta")


@formula(
    "friction work of a turn and efficiency of one Hooke joint: exact, first order, and by the small angle",
    "Kozhevnikov & Perfil'ev (1978), eq. 127–137, restored",
    joint_angle("alpha_deg", "joint angle of the joint", axes=(0, 1)),
    at_least_zero("mu_pin_reduced", "reduced coefficient of friction of the journals"),
    positive("pin_diameter_m", "diameter of the journals"),
    positive("pin_span_m", "span of the cross"),
    CONSTANT,
    at_least_zero("mu_bearing_reduced", "reduced coefficient of friction of the shafts' bearings", default=0.0),
    at_least_zero("bearing_diameter_m", "diameter of those bearings", default=None),
    positive("bearing_span_m", "distance of the two bearings of a shaft", default=None),
    "pin_work_per_rev_over_torque = pin_work: friction work of a turn in the journals over the torque",
    "bearing_work_per_rev_over_torque = bearing_work: friction work of a turn in the bearings over the torque",
    "eta_first_order = first_order: efficiency, friction not acting on itself",
    "eta_pins_small_angle_137 = small_angle: efficiency of the journals by the rule for small angles",
    "eta_pins_self_consistent = exact: efficiency of the journals, friction acting on itself",
    "mean_pin_force_times_span_over_torque = mean_pin_load: mean load of a journal times span over torque",
    check=_bearings,
)
def _efficiency_joint(v: Values) -> Any:
    joint_angle, mu = np.asarray(v.alpha), v.mu_pin_reduced
    drag = mu * v.pin_diameter / v.pin_span
    rest = v.mu_bearing_reduced
    bearing = rest * v.bearing_diameter / v.bearing_span if rest else 0.0
    found = joint_friction(joint_angle, drag, bearing_drag=bearing, torque_at=v.constant_torque)
    text = _(
        "{mu:.6g} locks the joint at an angle of {joint_angle:.4g}°: friction over the journals, κ tan α, reaches 1"
    )
    steepest = float(np.max(joint_angle))
    check(
        [Problem("mu_pin_reduced", text.format(mu=mu, joint_angle=np.degrees(steepest)))]
        if np.any(found.status)
        else []
    )
    return found


@formula(
    "efficiency of a chain of joints with friction in their journals, exact and as a product of joints",
    "Kozhevnikov & Perfil'ev (1978), eq. 139; exact by couples of the crosses",
    (joint_angles(default=None), twists(), points(default=None), YOKES, START),
    at_least_zero(
        "kappa_mu_dc_over_d", "reduced coefficient of friction times journal diameter over span, of each joint", axes=1
    ),
    CONSTANT,
    "eta_self_consistent: efficiency, friction acting on itself",
    "eta_product_of_joint_first_order: product of the joints' efficiencies of first order",
    "pin_loss_of_each_joint_over_mean_power: share of the power that each joint turns to heat",
    check=_frictions,
)
def _efficiency_chain(v: Values) -> Any:
    drag = v.kappa_mu_dc_over_d
    found = chain_friction(drives(v), drag, torque_at=v.constant_torque)
    text = _("{drag:.6g} locks joint {number}: κ tan α reaches 1")
    stuck = np.flatnonzero(np.any(np.atleast_2d(found.locked), axis=0))
    check(Problem(f"kappa_mu_dc_over_d[{i}]", text.format(drag=np.max(drag[..., i]), number=i + 1)) for i in stuck)
    return found.efficiency, found.first_order, found.joint_loss


@formula(
    "efficiency of a sliding spline, of parallel branches, and reduced coefficients of plain journals",
    "Kozhevnikov & Perfil'ev (1978), eq. 138, 140, restored",
    at_least_zero("mu_spline", "coefficient of friction of the spline", default=None),
    at_least_zero("stroke_m", "mean way of one displacement, one way", default=None),
    at_least_zero("strokes_per_s", "displacements a second", None, default=None),
    positive("spline_diameter_m", "mean diameter of the spline", default=None),
    positive("rev_per_s", "turns of the shaft a second", None, default=None),
    at_least_zero("branch_useful_work_J", "useful work of each branch", axes=1, default=None),
    positive("branch_eta", "efficiency of each branch", axes=1, high=1.0, default=None),
    at_least_zero("mu_material", "coefficient of friction of the journals' materials", default=None),
    "eta_spline: efficiency of the spline",
    "eta_branches: efficiency of the branches together",
    "mu_reduced_new_pin: reduced coefficient of a new journal",
    "mu_reduced_worn_pin: reduced coefficient of a journal run in",
    check=_parts,
)
def _efficiency_spline_branches_factors(v: Values) -> Any:
    found: dict[str, Any] = {}
    if v.mu_spline is not None:
        eta = spline_efficiency(*(v[name] for name in _SPLINE))
        text = _("{strokes:.6g} displacements a second rub away all of the power: efficiency {eta:.4g}")
        lost = Problem("strokes_per_s", text.format(strokes=v.strokes_per_s, eta=float(eta)))
        check([lost] if not eta > 0.0 else [])
        found["eta_spline"] = eta
    if v.branch_eta is not None:
        found["eta_branches"] = branch_efficiency(v.branch_useful_work, v.branch_eta)
    if v.mu_material is not None:
        found["mu_reduced_new_pin"] = reduced_friction(v.mu_material)
        found["mu_reduced_worn_pin"] = reduced_friction(v.mu_material, fit="run_in")
    return found


@formula(
    "friction torque of a rotary shaft lip seal, and what it turns to heat at a speed",
    "ISO/TR 14179-2; a guide value for one lip in oil",
    positive("seal_diameter_m", "diameter of the shaft under the lip", axes=(0, 1)),
    positive("speed_rpm", "speed of the shaft", axes=(0, 1), default=None),
    "friction_torque_Nm: friction torque",
    "power_loss_W: power turned to heat; where the speed is given",
)
def _seal_friction(v: Values) -> Any:
    torque = seal_friction(v.seal_diameter)
    return {"friction_torque_Nm": torque, **({} if v.speed is None else {"power_loss_W": torque * v.speed})}
