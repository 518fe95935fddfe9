"""Calculations of losses: one joint, a chain of joints, splines, branches, coefficients of journals."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.calc.calculation import Calculation, Given, Values, given, gives
from cardan.calc.motion.kinematics import RIGHT, START, YOKES, between, drives, joint_angles, points, twists
from cardan.errors import Problem, check
from cardan.formulas.friction import branch_efficiency, joint_friction, reduced_friction, spline_efficiency
from cardan.questions.losses.chain_friction import chain_friction
from cardan.texts import _, mark

CONSTANT = given(
    "constant_torque",
    mark("where the torque is constant"),
    kind="word",
    choices=("output", "input"),
    default="output",
)
"""Where the torque is constant."""


def _coefficient(key: str, doc: str, **options: object) -> Given:
    return given(key, doc, low=0.0, **options)  # type: ignore[arg-type]


def _bearings(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what misses beside the friction of the shafts' bearings."""
    if values.get("mu_bearing_reduced"):
        for name in ("bearing_diameter", "bearing_span"):
            if name in values and values[name] is None:
                yield Problem(key(name), _("missing; {other} needs it").format(other=key("mu_bearing_reduced")))


def _joint(values: Values) -> Values:
    joint_angle, mu = np.asarray(values["alpha"]), values["mu_pin_reduced"]
    drag = mu * values["pin_diameter"] / values["pin_span"]
    rest = values["mu_bearing_reduced"]
    bearing = rest * values["bearing_diameter"] / values["bearing_span"] if rest else 0.0
    found = joint_friction(joint_angle, drag, bearing_drag=bearing, torque_at=values["constant_torque"])
    text = _(
        "{mu:.6g} locks the joint at an angle of {joint_angle:.4g}°: friction over the journals, κ tan α, reaches 1"
    )
    steepest = float(np.max(joint_angle))
    check(
        [Problem("mu_pin_reduced", text.format(mu=mu, joint_angle=np.degrees(steepest)))]
        if np.any(found.status)
        else []
    )
    return {
        "pin_work_per_rev_over_torque": found.pin_work,
        "bearing_work_per_rev_over_torque": found.bearing_work,
        "eta_first_order": found.first_order,
        "eta_pins_small_angle_137": found.small_angle,
        "eta_pins_self_consistent": found.exact,
        "mean_pin_force_times_span_over_torque": found.mean_pin_load,
    }


def _frictions(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what is wrong with a chain, and a list that has not one coefficient for each joint."""
    yield from between(values, key)
    place, alpha, drag = values.get("points"), values.get("alpha"), values.get("kappa_mu_dc_over_d")
    joints = alpha.shape[-1] if alpha is not None else place.shape[0] - 2 if place is not None else None
    if drag is not None and joints is not None and drag.shape[-1] != joints:
        text = _("{given} values given, {wanted} needed")
        yield Problem(key("kappa_mu_dc_over_d"), text.format(given=drag.shape[-1], wanted=joints))


def _chain(values: Values) -> Values:
    drag = values["kappa_mu_dc_over_d"]
    found = chain_friction(drives(values), drag, torque_at=values["constant_torque"])
    text = _("{drag:.6g} locks joint {number}: κ tan α reaches 1")
    stuck = np.flatnonzero(np.any(np.atleast_2d(found.locked), axis=0))
    check(Problem(f"kappa_mu_dc_over_d[{i}]", text.format(drag=np.max(drag[..., i]), number=i + 1)) for i in stuck)
    return {
        "eta_self_consistent": found.efficiency,
        "eta_product_of_joint_first_order": found.first_order,
        "pin_loss_of_each_joint_over_mean_power": found.joint_loss,
    }


_SPLINE = ("mu_spline", "stroke", "strokes_per_s", "spline_diameter", "rev_per_s")
_BRANCHES = ("branch_useful_work", "branch_eta")


def _parts(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield a part of which some is given and some is missing, and lists of branches that differ in length."""
    given_any = False
    for group in (_SPLINE, _BRANCHES, ("mu_material",)):
        there = [name for name in group if values.get(name) is not None]
        given_any |= bool(there) or any(name not in values for name in group)
        if there:
            text = _("missing; {other} needs it")
            yield from (
                Problem(key(name), text.format(other=key(there[0])))
                for name in group
                if name in values and values[name] is None
            )
    if not given_any:
        yield Problem(key("mu_spline"), _("missing; give a spline, or branch_useful_work_J, or mu_material"))
    work, eta = (values.get(name) for name in _BRANCHES)
    if work is not None and not np.sum(work) > 0.0:
        yield Problem(key("branch_useful_work"), _("no branch does any work"))
    if work is not None and eta is not None and work.shape != eta.shape:
        text = _("{given} values given, {wanted} needed")
        yield Problem(key("branch_eta"), text.format(given=eta.shape[-1], wanted=work.shape[-1]))


def _rules(values: Values) -> Values:
    found: Values = {}
    if values["mu_spline"] is not None:
        eta = spline_efficiency(*(values[name] for name in _SPLINE))
        text = _("{strokes:.6g} displacements a second rub away all of the power: efficiency {eta:.4g}")
        lost = Problem("strokes_per_s", text.format(strokes=values["strokes_per_s"], eta=float(eta)))
        check([lost] if not eta > 0.0 else [])
        found["eta_spline"] = eta
    if values["branch_eta"] is not None:
        found["eta_branches"] = branch_efficiency(values["branch_useful_work"], values["branch_eta"])
    if values["mu_material"] is not None:
        found["mu_reduced_new_pin"] = reduced_friction(values["mu_material"])
        found["mu_reduced_worn_pin"] = reduced_friction(values["mu_material"], fit="run_in")
    return found


CALCULATIONS = (
    Calculation(
        name="efficiency_joint",
        doc=mark(
            "friction work of a turn and efficiency of one Hooke joint: exact, first order, and by the small angle"
        ),
        source="Kozhevnikov & Perfil'ev (1978), eq. 127–137, restored",
        takes=(
            given("alpha_deg", mark("joint angle of the joint"), "angle", axes=(0, 1), low=0.0, below=RIGHT),
            _coefficient("mu_pin_reduced", mark("reduced coefficient of friction of the journals")),
            given("pin_diameter_m", mark("diameter of the journals"), "length", above=0.0),
            given("pin_span_m", mark("span of the cross"), "length", above=0.0),
            CONSTANT,
            _coefficient(
                "mu_bearing_reduced", mark("reduced coefficient of friction of the shafts' bearings"), default=0.0
            ),
            given("bearing_diameter_m", mark("diameter of those bearings"), "length", low=0.0, default=None),
            given("bearing_span_m", mark("distance of the two bearings of a shaft"), "length", above=0.0, default=None),
        ),
        returns=(
            gives("pin_work_per_rev_over_torque", mark("friction work of a turn in the journals over the torque")),
            gives("bearing_work_per_rev_over_torque", mark("friction work of a turn in the bearings over the torque")),
            gives("eta_first_order", mark("efficiency, friction not acting on itself")),
            gives("eta_pins_small_angle_137", mark("efficiency of the journals by the rule for small angles")),
            gives("eta_pins_self_consistent", mark("efficiency of the journals, friction acting on itself")),
            gives("mean_pin_force_times_span_over_torque", mark("mean load of a journal times span over torque")),
        ),
        answer=_joint,
        check=_bearings,
    ),
    Calculation(
        name="efficiency_chain",
        doc=mark("efficiency of a chain of joints with friction in their journals, exact and as a product of joints"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 139; exact by couples of the crosses",
        takes=(
            joint_angles(default=None),
            twists(),
            points(default=None),
            YOKES,
            START,
            _coefficient(
                "kappa_mu_dc_over_d",
                mark("reduced coefficient of friction times journal diameter over span, of each joint"),
                axes=(1,),
            ),
            CONSTANT,
        ),
        returns=(
            gives("eta_self_consistent", mark("efficiency, friction acting on itself")),
            gives("eta_product_of_joint_first_order", mark("product of the joints' efficiencies of first order")),
            gives("pin_loss_of_each_joint_over_mean_power", mark("share of the power that each joint turns to heat")),
        ),
        answer=_chain,
        check=_frictions,
    ),
    Calculation(
        name="efficiency_spline_branches_factors",
        doc=mark("efficiency of a sliding spline, of parallel branches, and reduced coefficients of plain journals"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 138, 140, restored",
        takes=(
            _coefficient("mu_spline", mark("coefficient of friction of the spline"), default=None),
            given("stroke_m", mark("mean way of one displacement, one way"), "length", low=0.0, default=None),
            _coefficient("strokes_per_s", mark("displacements a second"), default=None),
            given("spline_diameter_m", mark("mean diameter of the spline"), "length", above=0.0, default=None),
            given("rev_per_s", mark("turns of the shaft a second"), above=0.0, default=None),
            given("branch_useful_work_J", mark("useful work of each branch"), "work", axes=(1,), low=0.0, default=None),
            given("branch_eta", mark("efficiency of each branch"), axes=(1,), above=0.0, high=1.0, default=None),
            _coefficient("mu_material", mark("coefficient of friction of the journals' materials"), default=None),
        ),
        returns=(
            gives("eta_spline", mark("efficiency of the spline")),
            gives("eta_branches", mark("efficiency of the branches together")),
            gives("mu_reduced_new_pin", mark("reduced coefficient of a new journal")),
            gives("mu_reduced_worn_pin", mark("reduced coefficient of a journal run in")),
        ),
        answer=_rules,
        check=_parts,
    ),
)
