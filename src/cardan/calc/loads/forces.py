"""Calculations of forces in drives given by points: kinetostatics, closure of clearances."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from cardan.calc.calculation import Calculation, Given, Values, given, gives, rows
from cardan.calc.motion.kinematics import ACCELERATION, ANGLE, START, between, points
from cardan.drive.models.train import Hold, Train, spline_grip, train_of_points
from cardan.errors import Problem
from cardan.questions.forces.forces import kinetostatics
from cardan.questions.forces.gap_closure import gap_closure
from cardan.texts import _, mark

SHAFT = given("shaft", mark("number of the shaft"), kind="whole")

BEARING = (
    SHAFT,
    given("x_from_shaft_start_m", mark("place from the beginning of the shaft along it"), "length"),
    given("radial", mark("whether it holds the shaft sideways"), kind="flag", default=True),
    given("axial", mark("whether it holds the shaft lengthwise"), kind="flag", default=False),
)
"""Keys of a bearing in a list of them."""

YOKES = given(
    "gamma_deg", mark("yoke angle of shafts 2 to n, driving to driven yoke"), "angle", axes=(1,), default=None
)

SPEED = given("omega1_rad_s", mark("input speed"), "angular_speed", default=0.0)

LOAD = given("M_out_Nm", mark("torque that resists the output"), "torque")

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


def chain_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield what is wrong with the points, and lists without a value for each shaft or joint."""
    yield from between(values, key)
    place = values.get("points")
    if place is None:
        return
    joints = place.shape[0] - 2
    for name, more in _LENGTHS.items():
        value = values.get(name)
        if value is not None and len(value) != joints + more:
            text = _("{given} values given, {wanted} needed")
            yield Problem(key(name), text.format(given=len(value), wanted=joints + more))
    for name in ("bearings", "splines"):
        if values.get(name):
            yield from unknown_shafts(values[name], joints + 1, key(name))
    yield from _bearing_problems(values, key)
    yield from _spline_problems(values, key)


def unknown_shafts(given_rows: Sequence[Values], last: int, field: str) -> Iterator[Problem]:
    """Yield the rows of a list that stand on a shaft that is not there."""
    for k, row in enumerate(given_rows):
        if not 1 <= row.get("shaft", 1) <= last:
            text = _("row {row}: there is no shaft {number}; the shafts are 1 to {last}")
            yield Problem(field, text.format(row=k + 1, number=row["shaft"], last=last))


def _bearing_problems(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield bearings that hold nothing, and a list without any."""
    if "bearings" not in values:
        return
    if not values["bearings"]:
        yield Problem(key("bearings"), _("an empty list holds no shaft"))
    for k, row in enumerate(values["bearings"]):
        if not (row.get("radial", True) or row.get("axial", True)):
            yield Problem(key("bearings"), _("row {row} holds nothing").format(row=k + 1))


def _spline_problems(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield shafts with two splines, and friction of a spline whose thrust has no size or no sense."""
    seen: set[int] = set()
    for k, row in enumerate(values.get("splines") or ()):
        if row.get("shaft") in seen:
            yield Problem(key("splines"), _("row {row}: shaft {number} has two").format(row=k + 1, number=row["shaft"]))
        seen.add(row.get("shaft", 0))
        if not row.get("mu"):
            continue
        if row.get("d", 1.0) is None:
            yield Problem(f"{key('splines')}[{k}].d_m", _("missing; {other} needs it").format(other="mu"))
        if row.get("direction") not in (None, -1.0, 1.0):
            yield Problem(
                f"{key('splines')}[{k}].direction", _("{value} is neither 1 nor -1").format(value=row["direction"])
            )


def held(row: Values) -> tuple[int, tuple[Hold, ...]]:
    """Return shaft, counted from 0, and holds of a bearing."""
    holds: list[Hold] = [*(["radial"] if row["radial"] else []), *(["axial"] if row["axial"] else [])]  # type: ignore[list-item]
    return row["shaft"] - 1, tuple(holds)


def train_of(values: Values, **parts: Any) -> Train:
    """Return the points, yokes and bearings of a drive given by points."""
    bearings = values.get("bearings") or []
    return train_of_points(
        values["points"],
        yoke_angle=values["gamma"],
        start_phase=values["psi1"],
        bearings=tuple(held(row) for row in bearings),
        position=np.asarray([row["x_from_shaft_start"] for row in bearings]),
        **parts,
    )


def _each(values: Values) -> Callable[[Any], Any]:
    """Return what puts the axis of the positions first, or takes it away where a single angle was given."""
    single = np.ndim(values["phi1"]) == 0

    def first(table: Any) -> Any:
        if table is None:
            return None
        moved = np.moveaxis(table, 1, 0)
        return moved[0] if single else moved

    return first


def _kinetostatics(values: Values) -> Values:
    splines = values["splines"]
    joints = len(values["points"]) - 2
    slide = values["cross_slides_on_pins"]
    whole = train_of(
        values,
        inertia=values["J"],
        mass=values["mass"],
        centre_of_mass=np.zeros(joints + 1) if values["cg_from_shaft_start"] is None else values["cg_from_shaft_start"],
        resisting_torque=values["extra_resisting_torque"],
        cross_inertia=values["cross_inertia_b_c_n"],
        cross_mass=values["cross_mass"],
        gravity=values["gravity"],
        slides=((slide, slide),) * joints,
        splines=tuple(row["shaft"] - 1 for row in splines),
        cut=np.asarray([row["x_from_shaft_start"] for row in splines]),
        grip=np.asarray([spline_grip(row["mu"], row["d"]) if row["mu"] else 0.0 for row in splines]),
        sliding=np.asarray([float(row["direction"]) for row in splines]),
    )
    found = kinetostatics(
        whole,
        np.atleast_1d(np.asarray(values["phi1"], dtype=float)),
        torque=values["M_out"],
        speed=values["omega1"],
        acceleration=values["eps1"],
        field="bearings",
    )
    at = _each(values)
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


def _closure(values: Values) -> Values:
    found = gap_closure(
        train_of(values, inertia=values["J"]),
        load=values["M_out"],
        speed=values["omega1"],
        acceleration=values["eps1"],
    )
    return {
        "min_pin_couple_over_turn_Nm": found.least_couple,
        "phi1_at_min_deg": found.least_angle,
        "min_M_out_for_closure_Nm": found.load_needed,
        "closed": found.closed,
        "open_share_of_turn": found.open_share,
        "phi1_at_sign_changes_deg": list(found.openings),
    }


def size(key: str, doc: str, **options: Any) -> Given:
    """Declare a length that is more than zero."""
    return given(key, doc, "length", **{"above": 0.0} | options)


CALCULATIONS = (
    Calculation(
        name="kinetostatics",
        doc=mark(
            "torques, secondary couples, joint forces and bearing reactions of any drive, with inertia and weight"
        ),
        source="Kozhevnikov & Perfil'ev (1978), pp. 129–150",
        takes=(
            points(),
            START,
            YOKES,
            ANGLE,
            SPEED,
            ACCELERATION,
            given(LOAD.key, LOAD.meaning.doc, "torque", default=0.0),
            given("extra_resisting_torque_Nm", mark("torque that resists each shaft"), "torque", **_FREE),
            given("J_kg_m2", mark("inertia of each shaft about its axis"), "inertia", low=0.0, **_FREE),
            given("mass_kg", mark("mass of each shaft"), "mass", low=0.0, **_FREE),
            given("cg_from_shaft_start_m", mark("centre of mass of each shaft from its beginning"), "length", **_FREE),
            given("gravity_m_s2", mark("acceleration of free fall"), "acceleration", axes=(1,), width=3, default=None),
            given(
                "cross_inertia_b_c_n_kg_m2",
                mark("inertia of each cross about driving journals, driven journals and normal"),
                "inertia",
                low=0.0,
                axes=(2,),
                width=3,
                default=None,
            ),
            given("cross_mass_kg", mark("mass of each cross"), "mass", low=0.0, **_FREE),
            given(
                "cross_slides_on_pins",
                mark("whether every cross slides along its journals"),
                kind="flag",
                default=False,
            ),
            rows("bearings", mark("what holds the shafts"), *BEARING),
            rows(
                "splines",
                mark("sliding splines"),
                SHAFT,
                given("x_from_shaft_start_m", mark("place from the beginning of the shaft along it"), "length"),
                given("mu", mark("coefficient of friction"), low=0.0, default=0.0),
                size("d_m", mark("mean diameter, with friction"), default=None),
                given("direction", mark("+1 where friction pushes the parts apart, -1 where it pulls"), default=1.0),
                default=(),
            ),
        ),
        returns=(
            gives("M_in_Nm", mark("torque that drives the input"), "torque"),
            gives("shaft_torque_Nm", mark("torque that enters each shaft"), "torque"),
            gives("omega_rad_s", mark("speed of each shaft"), "angular_speed"),
            gives("eps_rad_s2", mark("acceleration of each shaft"), "angular_acceleration"),
            gives("couple_on_driving_yoke_Nm", mark("couple of each cross on its driving yoke"), "torque"),
            gives("couple_on_driven_yoke_Nm", mark("couple of each cross on its driven yoke"), "torque"),
            gives("joint_force_on_driven_shaft_N", mark("force in each joint centre on the driven shaft"), "force"),
            gives("bearing_reaction_N", mark("force of each bearing on its shaft"), "force"),
            gives("secondary_couple_on_shaft_Nm", mark("couple across each shaft"), "torque"),
            gives("equations", mark("number of equations")),
            gives("unknowns", mark("number of unknowns")),
        ),
        answer=_kinetostatics,
        check=chain_check,
    ),
    Calculation(
        name="gap_closure",
        doc=mark("whether the load keeps the clearances of all joints closed against inertia over a turn"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 121, 122 for any drive",
        takes=(
            points(),
            START,
            YOKES,
            SPEED,
            ACCELERATION,
            LOAD,
            given("J_kg_m2", mark("inertia of each shaft about its axis"), "inertia", low=0.0, axes=(1,)),
        ),
        returns=(
            gives("min_pin_couple_over_turn_Nm", mark("least couple of each joint over a turn"), "torque"),
            gives("phi1_at_min_deg", mark("input angle where it occurs"), "angle"),
            gives("min_M_out_for_closure_Nm", mark("least load that keeps all joints closed"), "torque"),
            gives("closed", mark("whether all joints stay closed")),
            gives("open_share_of_turn", mark("share of the turn in which the couple of each joint is reversed")),
            gives("phi1_at_sign_changes_deg", mark("input angles where the couple of each joint turns about"), "angle"),
        ),
        answer=_closure,
        check=chain_check,
    ),
)
