"""Synthesis: the yoke angles that make a chain synchronous, freely chosen or by spline teeth."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.drive.drive import Drive
from cardan.drive.models.chain import chain
from cardan.errors import Problem
from cardan.questions.phases.phases import phases
from cardan.questions.phases.setting import settings
from cardan.questions.phases.spline_pitch import best_pitched, steps
from cardan.reading.given import Given, given, gives, whole
from cardan.texts import _

from .kinematics import between, joint_angles, points, twists

formula = Formulas(__doc__)


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
    "hyperbolic polygon; Book (77)-(86) is its first order",
    joint_angles(axes=1, default=None),
    (twists(axes=1), points(default=None)),
    _yokes("gamma_deg", "present yoke angle of shafts 2 to n"),
    given("fixed_gamma_deg", "yoke angles that must stay, by shaft number", kind="table", default=None),
    "delta_min = irregularity_min: smallest speed fluctuation",
    "delta_max = irregularity_max: largest speed fluctuation",
    "synchronous_feasible = feasible: whether the chain can be synchronous",
    "alpha_eq_min_deg = bend_min: smallest equivalent angle",
    "alpha_eq_max_deg = bend_max: largest equivalent angle",
    "gamma_deg: best yoke angles",
    "gamma_deg_sets: best yoke angles and their mirror image",
    "delta: speed fluctuation that the best yoke angles leave",
    "delta_of_each_shaft: speed fluctuation of shafts 2 to n+1 then",
    "psi_mod180_deg: phase angle of each joint then",
    gives("delta_per_rad", "growth of the speed fluctuation for each yoke turned, per radian", None),
    "limiting_joint = limiting_joint: number of the joint that bends too much for the others",
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
