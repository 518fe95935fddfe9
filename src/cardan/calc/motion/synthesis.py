"""Calculations of synthesis: the yoke angles that make a chain synchronous, freely chosen or by spline teeth."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.calc.calculation import Calculation, Given, Values, given, gives
from cardan.drive.drive import Drive
from cardan.drive.models.chain import chain
from cardan.errors import Problem
from cardan.questions.phases.phases import phases
from cardan.questions.phases.setting import settings
from cardan.questions.phases.spline_pitch import best_pitched, steps
from cardan.texts import _, mark

from .kinematics import between, joint_angles, points, twists

RUNNERS_UP = 6


def _drive(values: Values, yoke_angle: str) -> Drive:
    yokes = values[yoke_angle]
    yokes = [] if yokes is None else yokes.tolist()
    if values["points"] is not None:
        return Drive.from_points(values["points"].tolist(), yoke_angles=yokes)
    twist = [] if values["beta"] is None else values["beta"].tolist()
    return Drive.from_angles(values["alpha"].tolist(), plane_twists=twist, yoke_angles=yokes)


def _check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from between(values, key)
    alpha, place = values.get("alpha"), values.get("points")
    last = alpha.shape[0] if alpha is not None else place.shape[0] - 2 if place is not None else None
    for number in values.get("fixed_gamma") or {}:
        if last is not None and not 2 <= number <= last:
            yield Problem(
                f"{key('fixed_gamma')}.{number}",
                _("there is no such yoke angle; the shafts between two joints are 2 to {last}").format(last=last),
            )


def _continuous(values: Values) -> Values:
    found = phases(_drive(values, "gamma"), fixed=values["fixed_gamma"])
    best = found.settings[0] if found.settings else found.as_built
    return {
        "delta_min": found.speed_fluctuation_min,
        "delta_max": found.speed_fluctuation_max,
        "synchronous_feasible": found.feasible,
        "alpha_eq_min_deg": found.joint_angle_min,
        "alpha_eq_max_deg": found.joint_angle_max,
        "gamma_deg": best.yoke_angle,
        "gamma_deg_sets": [one.yoke_angle for one in found.settings],
        "delta": best.speed_fluctuation,
        "delta_of_each_shaft": best.shaft_speed_fluctuation,
        "psi_mod180_deg": np.remainder(best.initial_phase, np.pi),
        "delta_per_rad": best.sensitivity,
        "limiting_joint": found.limiting_joint,
    }


def _spline(values: Values) -> Values:
    whole = chain(_drive(values, "gamma_offset"))
    teeth = [int(z) for z in values["spline_teeth"]]
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


def _ties(one: float, other: float) -> bool:
    return one - other <= 1e-12


def _yokes(key: str, doc: str) -> Given:
    return given(key, doc, "angle", axes=(1,), default=None)


CALCULATIONS = (
    Calculation(
        name="synthesis_continuous",
        doc=mark("yoke angles that make a chain synchronous or as even as can be, and what they can reach"),
        source="hyperbolic polygon; Kozhevnikov & Perfil'ev (1978), eq. 77–86 is its first order",
        takes=(
            joint_angles(axes=(1,), default=None),
            twists(axes=(1,)),
            points(default=None),
            _yokes("gamma_deg", mark("present yoke angle of shafts 2 to n")),
            given(
                "fixed_gamma_deg",
                mark("yoke angles that must stay, by shaft number"),
                "angle",
                kind="table",
                default=None,
            ),
        ),
        returns=(
            gives("delta_min", mark("smallest speed fluctuation")),
            gives("delta_max", mark("largest speed fluctuation")),
            gives("synchronous_feasible", mark("whether the chain can be synchronous")),
            gives("alpha_eq_min_deg", mark("smallest equivalent angle"), "angle"),
            gives("alpha_eq_max_deg", mark("largest equivalent angle"), "angle"),
            gives("gamma_deg", mark("best yoke angles"), "angle"),
            gives("gamma_deg_sets", mark("best yoke angles and their mirror image"), "angle"),
            gives("delta", mark("speed fluctuation that the best yoke angles leave")),
            gives("delta_of_each_shaft", mark("speed fluctuation of shafts 2 to n+1 then")),
            gives("psi_mod180_deg", mark("phase angle of each joint then"), "angle"),
            gives("delta_per_rad", mark("growth of the speed fluctuation for each yoke turned, per radian")),
            gives("limiting_joint", mark("number of the joint that bends too much for the others")),
        ),
        answer=_continuous,
        check=_check,
    ),
    Calculation(
        name="synthesis_spline",
        doc=mark("best yoke angles that spline teeth allow, all looked at"),
        source="enumeration on the exact model",
        takes=(
            joint_angles(axes=(1,), default=None),
            twists(axes=(1,)),
            points(default=None),
            given("spline_teeth", mark("teeth of the spline on shafts 2 to n"), kind="whole", axes=(1,), low=1),
            _yokes("gamma_offset_deg", mark("yoke angle of shafts 2 to n from which the teeth count")),
        ),
        returns=(
            gives("delta_min", mark("smallest speed fluctuation")),
            gives("delta_second_best", mark("speed fluctuation of the runner-up")),
            gives("n_distinct", mark("different yoke angles each spline allows")),
            gives("gamma_deg", mark("best yoke angles"), "angle"),
            gives("gamma_deg_minimisers", mark("all equally good sets found"), "angle"),
            gives("gamma_deg_sets", mark("best sets, best first"), "angle"),
            gives("delta_of_each_set", mark("speed fluctuation each set leaves")),
            gives("delta_of_each_shaft", mark("speed fluctuation of shafts 2 to n+1 with the best set")),
            gives("psi_mod180_deg", mark("phase angle of each joint with the best set"), "angle"),
            gives("delta_per_rad", mark("growth of the speed fluctuation for each yoke turned, per radian")),
        ),
        answer=_spline,
        check=_check,
    ),
)
