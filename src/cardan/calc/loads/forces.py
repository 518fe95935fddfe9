"""Forces in drives given by points: kinetostatics, closure of clearances."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.book.gap_closure import gap_closure
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.calc.motion.kinematics import ACCELERATION, ANGLE, START, between, points
from cardan.drive.models.train import Hold, Train, spline_grip, train_of_points
from cardan.errors import Problem
from cardan.questions.forces.forces import kinetostatics
from cardan.reading.given import at_least_zero, flag, given, positive, rows, whole
from cardan.texts import _

formula = Formulas(__doc__)


SHAFT = whole("shaft", "number of the shaft")

BEARING = (
    SHAFT,
    given("x_from_shaft_start_m", "place from the beginning of the shaft along it"),
    flag("radial", "whether it holds the shaft sideways", default=True),
    flag("axial", "whether it holds the shaft lengthwise"),
)
"""Keys of a bearing in a list of them."""

YOKES = given("gamma_deg", "yoke angle of shafts 2 to n, driving to driven yoke", axes=1, default=None)

SPEED = given("omega1_rad_s", "input speed", default=0.0)

LOAD = given("M_out_Nm", "torque that resists the output")

_FREE: dict[str, Any] = {"default": None, "axes": (1,)}

_LENGTHS = {
    "extra_resisting_torque": 1,
    "J": 1,
    "mass": 1,
    "cg_from_shaft_start": 1,
    "cross_inertia_b_c_n": 0,
    "cross_mass": 0,
}
"""Lists with a value for each joint, and for how many shafts more."""


def chain_check(v: Values) -> Problems:
    """Yield what is wrong with the points, and lists without a value for each shaft or joint."""
    yield from between(v)
    place = v.get("points")
    if place is None:
        return
    joints = place.shape[0] - 2
    for name, more in _LENGTHS.items():
        value = v.get(name)
        if value is not None and len(value) != joints + more:
            text = _("{given} values given, {wanted} needed")
            yield v.wrong(name, text.format(given=len(value), wanted=joints + more))
    for name in ("bearings", "splines"):
        if v.get(name):
            yield from unknown_shafts(v[name], joints + 1, v.key(name))
    yield from _bearing_problems(v)
    yield from _spline_problems(v)


def unknown_shafts(given_rows: Sequence[Values], last: int, field: str) -> Iterator[Problem]:
    """Yield the rows of a list that stand on a shaft that is not there."""
    for k, row in enumerate(given_rows):
        if not 1 <= row.get("shaft", 1) <= last:
            text = _("row {row}: there is no shaft {number}; the shafts are 1 to {last}")
            yield Problem(field, text.format(row=k + 1, number=row.shaft, last=last))


def _bearing_problems(v: Values) -> Problems:
    """Yield bearings that hold nothing, and a list without any."""
    if "bearings" not in v:
        return
    if not v.bearings:
        yield v.wrong("bearings", _("an empty list holds no shaft"))
    for k, row in enumerate(v.bearings):
        if not (row.get("radial", True) or row.get("axial", True)):
            yield v.wrong("bearings", _("row {row} holds nothing").format(row=k + 1))


def _spline_problems(v: Values) -> Problems:
    """Yield shafts with two splines, and friction of a spline whose thrust has no size or no sense."""
    seen: set[int] = set()
    for k, row in enumerate(v.get("splines") or ()):
        if row.get("shaft") in seen:
            yield v.wrong("splines", _("row {row}: shaft {number} has two").format(row=k + 1, number=row.shaft))
        seen.add(row.get("shaft", 0))
        if not row.get("mu"):
            continue
        if row.get("d", 1.0) is None:
            yield Problem(f"{v.key('splines')}[{k}].d_m", _("missing; {other} needs it").format(other="mu"))
        if row.get("direction") not in (None, -1.0, 1.0):
            yield Problem(
                f"{v.key('splines')}[{k}].direction", _("{value} is neither 1 nor -1").format(value=row.direction)
            )


def held(row: Values) -> tuple[int, tuple[Hold, ...]]:
    """Return shaft, counted from 0, and holds of a bearing."""
    holds: list[Hold] = [*(["radial"] if row.radial else []), *(["axial"] if row.axial else [])]  # type: ignore[list-item]
    return row.shaft - 1, tuple(holds)


def train_of(v: Values, **parts: Any) -> Train:
    """Return the points, yokes and bearings of a drive given by points."""
    bearings = v.get("bearings") or []
    return train_of_points(
        v.points,
        yoke_angle=v.gamma,
        start_phase=v.psi1,
        bearings=tuple(held(row) for row in bearings),
        position=np.asarray([row.x_from_shaft_start for row in bearings]),
        **parts,
    )


def _each(v: Values) -> Callable[[Any], Any]:
    """Return what puts the axis of the positions first, or takes it away where a single angle was given."""
    single = np.ndim(v.phi1) == 0

    def first(table: Any) -> Any:
        if table is None:
            return None
        moved = np.moveaxis(table, 1, 0)
        return moved[0] if single else moved

    return first


@formula(
    "torques, secondary couples, joint forces and bearing reactions of any drive, with inertia and weight",
    "Book pp. 129-150",
    (points(), START, YOKES, ANGLE, SPEED, ACCELERATION),
    replace(LOAD, default=0.0),
    given("extra_resisting_torque_Nm", "torque that resists each shaft", **_FREE),
    at_least_zero("J_kg_m2", "inertia of each shaft about its axis", **_FREE),
    at_least_zero("mass_kg", "mass of each shaft", **_FREE),
    given("cg_from_shaft_start_m", "centre of mass of each shaft from its beginning", **_FREE),
    given("gravity_m_s2", "acceleration of free fall", axes=1, width=3, default=None),
    at_least_zero(
        "cross_inertia_b_c_n_kg_m2",
        "inertia of each cross about driving journals, driven journals and normal",
        axes=2,
        width=3,
        default=None,
    ),
    at_least_zero("cross_mass_kg", "mass of each cross", **_FREE),
    flag("cross_slides_on_pins", "whether every cross slides along its journals"),
    rows("bearings", "what holds the shafts", *BEARING),
    rows(
        "splines",
        "sliding splines",
        SHAFT,
        given("x_from_shaft_start_m", "place from the beginning of the shaft along it"),
        at_least_zero("mu", "coefficient of friction", default=0.0),
        positive("d_m", "mean diameter, with friction", default=None),
        given("direction", "+1 where friction pushes the parts apart, -1 where it pulls", default=1.0),
        default=(),
    ),
    "M_in_Nm: torque that drives the input",
    "shaft_torque_Nm: torque that enters each shaft",
    "omega_rad_s: speed of each shaft",
    "eps_rad_s2: acceleration of each shaft",
    "couple_on_driving_yoke_Nm: couple of each cross on its driving yoke",
    "couple_on_driven_yoke_Nm: couple of each cross on its driven yoke",
    "joint_force_on_driven_shaft_N: force in each joint centre on the driven shaft",
    "bearing_reaction_N: force of each bearing on its shaft",
    "secondary_couple_on_shaft_Nm: couple across each shaft",
    "equations: number of equations",
    "unknowns: number of unknowns",
    check=chain_check,
)
def _kinetostatics(v: Values) -> Any:
    splines = v.splines
    joints = len(v.points) - 2
    slide = v.cross_slides_on_pins
    whole = train_of(
        v,
        centre_of_mass=np.zeros(joints + 1) if v.cg_from_shaft_start is None else v.cg_from_shaft_start,
        slides=((slide, slide),) * joints,
        splines=tuple(row.shaft - 1 for row in splines),
        cut=np.asarray([row.x_from_shaft_start for row in splines]),
        grip=np.asarray([spline_grip(row.mu, row.d) if row.mu else 0.0 for row in splines]),
        sliding=np.asarray([float(row.direction) for row in splines]),
        **v.of(
            "mass",
            "cross_mass",
            "gravity",
            inertia="J",
            resisting_torque="extra_resisting_torque",
            cross_inertia="cross_inertia_b_c_n",
        ),
    )
    found = kinetostatics(
        whole,
        np.atleast_1d(np.asarray(v.phi1, dtype=float)),
        field="bearings",
        **v.of(torque="M_out", speed="omega1", acceleration="eps1"),
    )
    at = _each(v)
    return {
        "M_in_Nm": at(found.shaft_torque)[..., 0],
        "shaft_torque_Nm": at(found.shaft_torque),
        "omega_rad_s": at(found.speed),
        "eps_rad_s2": at(found.acceleration),
        "couple_on_driving_yoke_Nm": at(-found.driving_couple),
        "couple_on_driven_yoke_Nm": at(found.driven_couple),
        "joint_force_on_driven_shaft_N": at(found.joint_force),
        "bearing_reaction_N": at(found.reaction),
        "secondary_couple_on_shaft_Nm": at(found.secondary_couple),
        "equations": found.equations,
        "unknowns": found.unknowns,
    }


@formula(
    "whether the load keeps the clearances of all joints closed against inertia over a turn",
    "Book (121), (122) for any drive",
    (points(), START, YOKES, SPEED, ACCELERATION, LOAD),
    at_least_zero("J_kg_m2", "inertia of each shaft about its axis", axes=1),
    "min_pin_couple_over_turn_Nm = least_couple: least couple of each joint over a turn",
    "phi1_at_min_deg = least_angle: input angle where it occurs",
    "min_M_out_for_closure_Nm = load_needed: least load that keeps all joints closed",
    "closed = closed: whether all joints stay closed",
    "open_share_of_turn = open_share: share of the turn in which the couple of each joint is reversed",
    "phi1_at_sign_changes_deg: input angles where the couple of each joint turns about",
    check=chain_check,
)
def _gap_closure(v: Values) -> Any:
    found = gap_closure(train_of(v, inertia=v.J), **v.of(load="M_out", speed="omega1", acceleration="eps1"))
    return found, {"phi1_at_sign_changes_deg": list(found.openings)}
