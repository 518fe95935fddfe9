"""Calculations of accuracy: the closed loop of a joint with errors, influence coefficients, tolerances, chains."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.book.joint_accuracy import joint_samples, joint_stack, stack_over_turn
from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.drive.drives import Drives
from cardan.errors import Problem, refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import loops
from cardan.questions.accuracy.accuracy import course, one_turn, transmission_error
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.texts import _, mark
from cardan.units import deg

from .kinematics import RIGHT, joint_angles

IDEAL, OTHER = "phi4=atan2(cos(alpha)cos(phi1),sin(phi1))", "phi4=atan2(-cos(alpha)cos(phi1),-sin(phi1))"
LAWS = ("normal", "uniform", "triangular")
LENGTHS = ("s1", "a1", "a2", "a3", "a4")
ANGLES = ("alpha1", "alpha2", "alpha3", "alpha4")

JOINT_ANGLE = given("alpha_deg", mark("joint angle of the joint"), "angle", low=0.0, below=RIGHT)
INPUT = given("phi1_deg", mark("angle of the driving yoke from the plane of the shafts"), "angle")
WAYS = given(
    "tol_s1_a1_a2_a3_a4_mm",
    mark("tolerances ± of the five lengths of the loop"),
    "length",
    axes=(1,),
    width=5,
    low=0.0,
)
TURNS = given(
    "tol_alpha1_2_3_4_deg", mark("tolerances ± of the four angles of the loop"), "angle", axes=(1,), width=4, low=0.0
)


def _rccc(values: Values) -> Values:
    """Return both positions of a loop; the angles between axes and around them in one frame of words."""
    alpha, phi, length, slide = values["alpha"], values["phi1"], values["a"], values["s1"]
    both = loops.rccc(alpha, phi, length=length, slide=slide, branch=np.asarray([-1.0, 1.0]))
    spread = loops.turning_range(alpha)
    _closed(alpha, spread, both.status)
    order = np.argsort(both.angle[:, 2])
    angle = np.concatenate((np.full((2, 1), phi), both.angle), axis=-1)[order]
    slides = np.concatenate((np.full((2, 1), slide), both.slide), axis=-1)[order]
    return {
        "full_rotation": bool(spread.full),
        "cos_phi1_min": _finite(spread.lowest),
        "cos_phi1_max": _finite(spread.highest),
        "solutions_sorted_by_phi4": [
            {
                **{f"phi{k}_deg": float(turned[k - 1] / deg) for k in (2, 3, 4)},
                **{f"s{k}_m": float(slid[k - 1]) for k in (2, 3, 4)},
            }
            for turned, slid in zip(angle, slides, strict=True)
        ],
        "closure_residual": float(np.max(loops.closure(alpha, angle, length, slides))),
    }


def _finite(value: Array) -> float:
    return float(value) if np.isfinite(value) else np.nan


def _closed(alpha: Array, spread: loops.Range, status: Array) -> None:
    """Refuse a loop that is not closed in both of its positions."""
    if np.all(status == loops.Status.CLOSED):
        return
    for k in (1, 2):
        if abs(np.sin(alpha[k])) < loops.NO_SIDE:
            raise refuse(f"alpha[{k}]", _("neighbouring axes are parallel; an angle of the loop is left free"))
    if np.any(status == loops.Status.OPEN):
        if not np.isfinite(spread.lowest) or spread.lowest > 1.0 or spread.highest < -1.0:
            raise refuse("angle", _("no assembly at any input angle"))
        raise refuse(
            "angle",
            _(
                "no assembly; cos φ_1 must lie within {low:.6g} and {high:.6g}: ±φ_1 from {begin:.6g}° to {end:.6g}°"
            ).format(
                low=max(-1.0, spread.lowest),
                high=min(1.0, spread.highest),
                begin=np.arccos(min(1.0, spread.highest)) / deg,
                end=np.arccos(max(-1.0, spread.lowest)) / deg,
            ),
        )
    if np.any(status == loops.Status.DEAD):
        raise refuse("angle", _("dead position: both assemblies meet, and the slides have no bound"))
    raise refuse("angle", _("the angle of the driven shaft is left free here"))


def _influence(values: Values) -> Values:
    table = loops.influence(
        values["alpha"], values["phi1"], branch=loops.IDEAL * (1 if values["branch"] == IDEAL else -1)
    )
    return {
        "rows": ["2", "3", "4"],
        "C_columns": list(LENGTHS),
        "C": table,
        "d_columns": list(ANGLES),
        "d": table[..., 1:],
    }


def _stack(values: Values) -> Values:
    tolerances = {"ways": values["tol_s1_a1_a2_a3_a4"], "turns": values["tol_alpha1_2_3_4"]}
    here = joint_stack(values["alpha"], values["phi1"], **tolerances)
    turn = stack_over_turn(values["alpha"], **tolerances)
    angle, way = values["target_phi4"], values["target_s4"]
    return {
        "worst_s2_s3_s4_m": here.worst_slide,
        "rss_s2_s3_s4_m": here.square_slide,
        "worst_phi2_phi3_phi4_rad": here.worst_angle,
        "rss_phi2_phi3_phi4_rad": here.square_angle,
        "max_over_turn_worst_phi4_rad": turn.worst_angle,
        "max_over_turn_worst_s4_m": turn.worst_slide,
        "max_over_turn_rss_phi4_rad": turn.square_angle,
        "max_over_turn_rss_s4_m": turn.square_slide,
        "share_of_alpha1_4_in_phi2_phi3_phi4": here.share_angle,
        "share_of_s1_a1_4_in_s2_s3_s4": here.share_slide,
        "required_alpha1_4_deg": None if angle is None else angle * turn.equal_turns,
        "required_s1_a1_4_m": None if way is None else way * turn.equal_ways,
    }


def _law(values: Values) -> str:
    """Return the law that a description begins with."""
    return next((law for law in LAWS if str(values["distribution"]).strip().lower().startswith(law)), "")


def _law_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if "distribution" in values and not _law(values):
        text = _("{value} begins with none of {choices}")
        yield Problem(key("distribution"), text.format(value=repr(values["distribution"]), choices=", ".join(LAWS)))


def _samples(values: Values) -> Values:
    found = joint_samples(
        values["alpha"],
        values["phi1"],
        ways=values["tol_s1_a1_a2_a3_a4"],
        turns=values["tol_alpha1_2_3_4"],
        distribution=_law(values),
        method=MonteCarlo(samples=values["samples"], seed=values["seed"]),
    )
    return {
        "std_phi2_phi3_phi4_rad": found.angle_deviation,
        "std_s2_s3_s4_m": found.slide_deviation,
        "mean_phi2_phi3_phi4_rad": found.angle_mean,
        "mean_s2_s3_s4_m": found.slide_mean,
        "quantile_95_phi2_phi3_phi4_rad": found.angle_levels[1:3],
        "quantile_95_s2_s3_s4_m": found.slide_levels[1:3],
        "quantile_997_phi2_phi3_phi4_rad": found.angle_levels[0::3],
        "quantile_997_s2_s3_s4_m": found.slide_levels[0::3],
        "samples": found.count,
        "not_assembled": found.lost,
        "seed": values["seed"],
    }


def _chain(values: Values) -> Values:
    joints = Drives.from_angles(values["alpha"], yoke_angle=RIGHT - values["kappa_between_joints"])
    count = len(values["alpha"])
    phase = values["phase_errors_before_each_joint"]
    phase = np.zeros(count) if phase is None else phase
    errors: dict[str, Any] = {
        "turns": np.concatenate((phase[:, None], values["angle_errors_alpha1_4_per_joint"]), axis=-1),
        "ways": values["linear_errors_s1_a1_4_per_joint"],
    }
    if errors["ways"] is None:
        errors["ways"] = np.zeros((count, 5))
    here = transmission_error(joints, values["phi1"], **errors)
    turn = transmission_error(joints, one_turn(), **errors)
    if not (here.closes and turn.closes):
        raise refuse("angle_errors_alpha1_4_per_joint", _("a joint with such errors cannot be assembled all round"))
    parts = course(turn.error)
    return {
        "delta_phi_out_exact_rad": here.error[0],
        "delta_phi_out_linear_rad": here.error_linear[0],
        "axial_shift_out_exact_m": here.output_shift[0],
        "axial_shift_out_linear_m": here.shift_linear[-1, 0],
        "mean_over_turn_rad": parts.mean,
        "peak_to_peak_over_turn_rad": parts.peak_to_peak,
        "first_harmonic_rad": parts.first,
        "second_harmonic_rad": parts.second,
    }


def _lists(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    if "alpha" not in values:
        return
    count = len(values["alpha"])
    if not count:
        yield Problem(key("alpha"), _("an empty list has no joint"))
        return
    wanted = {
        "kappa_between_joints": count - 1,
        "angle_errors_alpha1_4_per_joint": count,
        "phase_errors_before_each_joint": count,
        "linear_errors_s1_a1_4_per_joint": count,
    }
    for name, needed in wanted.items():
        if values.get(name) is not None and len(values[name]) != needed:
            text = _("{given} values given, {wanted} needed")
            yield Problem(key(name), text.format(given=len(values[name]), wanted=needed))


CALCULATIONS = (
    Calculation(
        name="rccc",
        doc=mark("both positions of a closed loop of one revolute and three cylindrical pairs, and its range"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 141–156",
        takes=(
            given("alpha_deg", mark("angles between neighbouring axes"), "angle", axes=(1,), width=4),
            given("a_m", mark("lengths between neighbouring axes"), "length", axes=(1,), width=4),
            given("s1_m", mark("way along axis 1"), "length"),
            given("phi1_deg", mark("input angle about axis 1"), "angle"),
        ),
        returns=(
            gives("full_rotation", mark("whether the input can turn all the way round")),
            gives("cos_phi1_min", mark("least cosine of the input angle; None where it makes no difference")),
            gives("cos_phi1_max", mark("largest cosine of the input angle; None where it makes no difference")),
            gives("solutions_sorted_by_phi4", mark("angles in degrees and slides in metres of both assemblies")),
            gives("closure_residual", mark("by how much the product of the matrices misses the unit matrix")),
        ),
        answer=_rccc,
    ),
    Calculation(
        name="influence_coefficients",
        doc=mark("by how much angles and slides of a joint follow the errors of its loop"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 171, 180",
        takes=(
            JOINT_ANGLE,
            INPUT,
            given("branch", mark("assembly of the joint"), kind="word", choices=(IDEAL, OTHER), default=IDEAL),
        ),
        returns=(
            gives("rows", mark("numbers of the axes")),
            gives("C_columns", mark("errors of lengths")),
            gives("C", mark("slides s_2, s_3, s_4 by errors of lengths")),
            gives("d_columns", mark("errors of angles")),
            gives("d", mark("angles φ_2, φ_3, φ_4 by errors of angles")),
        ),
        answer=_influence,
    ),
    Calculation(
        name="tolerance_stack",
        doc=mark("what the tolerances of one joint add up to, at worst and as root of the sum of squares"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 171, 180, pp. 186-190",
        takes=(
            JOINT_ANGLE,
            INPUT,
            WAYS,
            TURNS,
            given("target_phi4_deg", mark("allowed error of the driven angle"), "angle", above=0.0, default=None),
            given("target_s4_mm", mark("allowed shift of the driven shaft"), "length", above=0.0, default=None),
        ),
        returns=(
            gives("worst_s2_s3_s4_m", mark("worst case of the slides"), "length"),
            gives("rss_s2_s3_s4_m", mark("root of the sum of squares of the slides"), "length"),
            gives("worst_phi2_phi3_phi4_rad", mark("worst case of the angles"), "angle"),
            gives("rss_phi2_phi3_phi4_rad", mark("root of the sum of squares of the angles"), "angle"),
            gives("max_over_turn_worst_phi4_rad", mark("largest worst case of the driven angle"), "angle"),
            gives("max_over_turn_worst_s4_m", mark("largest worst case of the driven shaft's shift"), "length"),
            gives("max_over_turn_rss_phi4_rad", mark("largest root of squares of the driven angle"), "angle"),
            gives("max_over_turn_rss_s4_m", mark("largest root of squares of the driven shaft's shift"), "length"),
            gives("share_of_alpha1_4_in_phi2_phi3_phi4", mark("share of each tolerance in the sum of squares")),
            gives("share_of_s1_a1_4_in_s2_s3_s4", mark("share of each tolerance in the sum of squares")),
            gives(
                "required_alpha1_4_deg", mark("tolerances of equal share that keep the target of the angle"), "angle"
            ),
            gives("required_s1_a1_4_m", mark("tolerances of equal share that keep the target of the shift"), "length"),
        ),
        answer=_stack,
    ),
    Calculation(
        name="tolerance_montecarlo",
        doc=mark("what errors drawn at random within the tolerances of one joint do, by the exact loop"),
        source="Kozhevnikov & Perfil'ev (1978), pp. 186–190; random samples",
        takes=(
            JOINT_ANGLE,
            INPUT,
            WAYS,
            TURNS,
            given(
                "distribution", mark("law of the errors, the first word of a description"), kind="word", default=LAWS[0]
            ),
            given("samples", mark("how many joints to draw"), kind="whole", low=128, high=1e7, default=65536),
            given("seed", mark("start of the random numbers"), kind="whole", low=0, default=1),
        ),
        returns=(
            gives("std_phi2_phi3_phi4_rad", mark("standard deviations of the angles"), "angle"),
            gives("std_s2_s3_s4_m", mark("standard deviations of the slides"), "length"),
            gives("mean_phi2_phi3_phi4_rad", mark("means of what the errors add to the angles"), "angle"),
            gives("mean_s2_s3_s4_m", mark("means of the slides"), "length"),
            gives("quantile_95_phi2_phi3_phi4_rad", mark("lower and upper bounds of 95 % of the angles"), "angle"),
            gives("quantile_95_s2_s3_s4_m", mark("lower and upper bounds of 95 % of the slides"), "length"),
            gives("quantile_997_phi2_phi3_phi4_rad", mark("lower and upper bounds of 99.7 % of the angles"), "angle"),
            gives("quantile_997_s2_s3_s4_m", mark("lower and upper bounds of 99.7 % of the slides"), "length"),
            gives("samples", mark("joints that could be assembled")),
            gives("not_assembled", mark("joints that could not")),
            gives("seed", mark("start of the random numbers")),
        ),
        answer=_samples,
        check=_law_check,
    ),
    Calculation(
        name="chain_with_errors",
        doc=mark("what errors of every joint do to the output of a chain, exactly and to first order"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 171, 180, chained",
        takes=(
            joint_angles(axes=(1,)),
            given(
                "kappa_deg_between_joints", mark("angle added to that of the yokes between joints"), "angle", axes=(1,)
            ),
            given("phi1_deg", mark("angle of the first driving yoke from the plane of its joint"), "angle"),
            given(
                "angle_errors_deg_alpha1_4_per_joint",
                mark("errors of the four angles of each joint"),
                "angle",
                axes=(2,),
                width=4,
            ),
            given(
                "phase_errors_deg_before_each_joint",
                mark("errors of the angle of each driving yoke"),
                "angle",
                axes=(1,),
                default=None,
            ),
            given(
                "linear_errors_mm_s1_a1_4_per_joint",
                mark("errors of the five lengths of each joint"),
                "length",
                axes=(2,),
                width=5,
                default=None,
            ),
        ),
        returns=(
            gives("delta_phi_out_exact_rad", mark("error of the output angle"), "angle"),
            gives("delta_phi_out_linear_rad", mark("error of the output angle to first order"), "angle"),
            gives("axial_shift_out_exact_m", mark("shift of the output shaft"), "length"),
            gives("axial_shift_out_linear_m", mark("shift of the output shaft to first order"), "length"),
            gives("mean_over_turn_rad", mark("part of the error of the angle that setting up takes away"), "angle"),
            gives("peak_to_peak_over_turn_rad", mark("change of the error of the angle over a turn"), "angle"),
            gives("first_harmonic_rad", mark("amplitude of the error of the angle once a turn"), "angle"),
            gives("second_harmonic_rad", mark("amplitude of the error of the angle twice a turn"), "angle"),
        ),
        answer=_chain,
        check=_lists,
    ),
)
