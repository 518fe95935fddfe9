"""Accuracy: the closed loop of a joint with errors, influence coefficients, tolerances, chains."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.joint_accuracy import joint_samples, joint_stack, stack_over_turn
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.drive.drives import Drives
from cardan.errors import refuse
from cardan.maths.arrays import Array
from cardan.maths.kernel import loops
from cardan.questions.accuracy.accuracy import course, one_turn, transmission_error
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.reading.given import RIGHT, at_least_zero, given, gives, joint_angle, positive, whole, word
from cardan.texts import _
from cardan.units import deg

from .kinematics import joint_angles

formula = Formulas(__doc__)


IDEAL, OTHER = "phi4=atan2(cos(alpha)cos(phi1),sin(phi1))", "phi4=atan2(-cos(alpha)cos(phi1),-sin(phi1))"
LAWS = ("normal", "uniform", "triangular")
LENGTHS = ("s1", "a1", "a2", "a3", "a4")
ANGLES = ("alpha1", "alpha2", "alpha3", "alpha4")

JOINT_ANGLE = joint_angle("alpha_deg", "joint angle of the joint")
INPUT = given("phi1_deg", "angle of the driving yoke from the plane of the shafts")
WAYS = at_least_zero("tol_s1_a1_a2_a3_a4_mm", "tolerances ± of the five lengths of the loop", axes=1, width=5)
TURNS = at_least_zero("tol_alpha1_2_3_4_deg", "tolerances ± of the four angles of the loop", axes=1, width=4)


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


def _law(v: Values) -> str:
    """Return the law that a description begins with."""
    return next((law for law in LAWS if str(v.distribution).strip().lower().startswith(law)), "")


def _law_check(v: Values) -> Problems:
    if "distribution" in v and not _law(v):
        text = _("{value} begins with none of {choices}")
        yield v.wrong("distribution", text.format(value=repr(v.distribution), choices=", ".join(LAWS)))


def _lists(v: Values) -> Problems:
    if "alpha" not in v:
        return
    count = len(v.alpha)
    if not count:
        yield v.wrong("alpha", _("an empty list has no joint"))
        return
    yield from v.miscounted(count - 1, "kappa_between_joints")
    rows = ("angle_errors_alpha1_4_per_joint", "phase_errors_before_each_joint", "linear_errors_s1_a1_4_per_joint")
    yield from v.miscounted(count, *rows, axis=0)


@formula(
    "both positions of a closed loop of one revolute and three cylindrical pairs, and its range",
    "Kozhevnikov & Perfil'ev (1978), eq. 141–156",
    given("alpha_deg", "angles between neighbouring axes", axes=1, width=4),
    given("a_m", "lengths between neighbouring axes", axes=1, width=4),
    given("s1_m", "way along axis 1"),
    given("phi1_deg", "input angle about axis 1"),
    "full_rotation: whether the input can turn all the way round",
    "cos_phi1_min: least cosine of the input angle; None where it makes no difference",
    "cos_phi1_max: largest cosine of the input angle; None where it makes no difference",
    "solutions_sorted_by_phi4: angles in degrees and slides in metres of both assemblies",
    "closure_residual: by how much the product of the matrices misses the unit matrix",
)
def _rccc(v: Values) -> Any:
    """Return both positions of a loop; the angles between axes and around them in one frame of words."""
    alpha, phi, length, slide = v.alpha, v.phi1, v.a, v.s1
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


@formula(
    "by how much angles and slides of a joint follow the errors of its loop",
    "Kozhevnikov & Perfil'ev (1978), eq. 171, 180",
    (JOINT_ANGLE, INPUT),
    word("branch", "assembly of the joint", IDEAL, OTHER, default=IDEAL),
    "rows: numbers of the axes",
    "C_columns: errors of lengths",
    "C: slides s_2, s_3, s_4 by errors of lengths",
    "d_columns: errors of angles",
    "d: angles φ_2, φ_3, φ_4 by errors of angles",
)
def _influence_coefficients(v: Values) -> Any:
    table = loops.influence(v.alpha, v.phi1, branch=loops.IDEAL * (1 if v.branch == IDEAL else -1))
    return ["2", "3", "4"], list(LENGTHS), table, list(ANGLES), table[..., 1:]


@formula(
    "what the tolerances of one joint add up to, at worst and as root of the sum of squares",
    "Kozhevnikov & Perfil'ev (1978), eq. 171, 180, pp. 186-190",
    (JOINT_ANGLE, INPUT, WAYS, TURNS),
    positive("target_phi4_deg", "allowed error of the driven angle", default=None),
    positive("target_s4_mm", "allowed shift of the driven shaft", default=None),
    "worst_s2_s3_s4_m = worst_slide: worst case of the slides",
    "rss_s2_s3_s4_m = square_slide: root of the sum of squares of the slides",
    "worst_phi2_phi3_phi4_rad = worst_angle: worst case of the angles",
    "rss_phi2_phi3_phi4_rad = square_angle: root of the sum of squares of the angles",
    "max_over_turn_worst_phi4_rad: largest worst case of the driven angle",
    "max_over_turn_worst_s4_m: largest worst case of the driven shaft's shift",
    "max_over_turn_rss_phi4_rad: largest root of squares of the driven angle",
    "max_over_turn_rss_s4_m: largest root of squares of the driven shaft's shift",
    gives("share_of_alpha1_4_in_phi2_phi3_phi4 = share_angle", "share of each tolerance in the sum of squares", None),
    gives("share_of_s1_a1_4_in_s2_s3_s4 = share_slide", "share of each tolerance in the sum of squares", None),
    "required_alpha1_4_deg: tolerances of equal share that keep the target of the angle",
    "required_s1_a1_4_m: tolerances of equal share that keep the target of the shift",
)
def _tolerance_stack(v: Values) -> Any:
    tolerances = {"ways": v.tol_s1_a1_a2_a3_a4, "turns": v.tol_alpha1_2_3_4}
    here = joint_stack(v.alpha, v.phi1, **tolerances)
    turn = stack_over_turn(v.alpha, **tolerances)
    angle, way = v.target_phi4, v.target_s4
    return here, {
        "max_over_turn_worst_phi4_rad": turn.worst_angle,
        "max_over_turn_worst_s4_m": turn.worst_slide,
        "max_over_turn_rss_phi4_rad": turn.square_angle,
        "max_over_turn_rss_s4_m": turn.square_slide,
        "required_alpha1_4_deg": None if angle is None else angle * turn.equal_turns,
        "required_s1_a1_4_m": None if way is None else way * turn.equal_ways,
    }


@formula(
    "what errors drawn at random within the tolerances of one joint do, by the exact loop",
    "Kozhevnikov & Perfil'ev (1978), pp. 186–190; random samples",
    (JOINT_ANGLE, INPUT, WAYS, TURNS),
    word("distribution", "law of the errors, the first word of a description", default=LAWS[0]),
    whole("samples", "how many joints to draw", low=128, high=10000000.0, default=65536),
    whole("seed", "start of the random numbers", low=0, default=1),
    "std_phi2_phi3_phi4_rad = angle_deviation: standard deviations of the angles",
    "std_s2_s3_s4_m = slide_deviation: standard deviations of the slides",
    "mean_phi2_phi3_phi4_rad = angle_mean: means of what the errors add to the angles",
    "mean_s2_s3_s4_m = slide_mean: means of the slides",
    "quantile_95_phi2_phi3_phi4_rad: lower and upper bounds of 95 % of the angles",
    "quantile_95_s2_s3_s4_m: lower and upper bounds of 95 % of the slides",
    "quantile_997_phi2_phi3_phi4_rad: lower and upper bounds of 99.7 % of the angles",
    "quantile_997_s2_s3_s4_m: lower and upper bounds of 99.7 % of the slides",
    "samples = count: joints that could be assembled",
    "not_assembled = lost: joints that could not",
    "seed: start of the random numbers",
    check=_law_check,
)
def _tolerance_montecarlo(v: Values) -> Any:
    found = joint_samples(
        v.alpha,
        v.phi1,
        ways=v.tol_s1_a1_a2_a3_a4,
        turns=v.tol_alpha1_2_3_4,
        distribution=_law(v),
        method=MonteCarlo(samples=v.samples, seed=v.seed),
    )
    return found, {
        "quantile_95_phi2_phi3_phi4_rad": found.angle_levels[1:3],
        "quantile_95_s2_s3_s4_m": found.slide_levels[1:3],
        "quantile_997_phi2_phi3_phi4_rad": found.angle_levels[0::3],
        "quantile_997_s2_s3_s4_m": found.slide_levels[0::3],
        "seed": v.seed,
    }


@formula(
    "what errors of every joint do to the output of a chain, exactly and to first order",
    "Kozhevnikov & Perfil'ev (1978), eq. 171, 180, chained",
    joint_angles(axes=1),
    given("kappa_deg_between_joints", "angle added to that of the yokes between joints", axes=1),
    given("phi1_deg", "angle of the first driving yoke from the plane of its joint"),
    given("angle_errors_deg_alpha1_4_per_joint", "errors of the four angles of each joint", axes=2, width=4),
    given("phase_errors_deg_before_each_joint", "errors of the angle of each driving yoke", axes=1, default=None),
    given(
        "linear_errors_mm_s1_a1_4_per_joint", "errors of the five lengths of each joint", axes=2, width=5, default=None
    ),
    "delta_phi_out_exact_rad: error of the output angle",
    "delta_phi_out_linear_rad: error of the output angle to first order",
    "axial_shift_out_exact_m: shift of the output shaft",
    "axial_shift_out_linear_m: shift of the output shaft to first order",
    "mean_over_turn_rad = mean: part of the error of the angle that setting up takes away",
    "peak_to_peak_over_turn_rad = peak_to_peak: change of the error of the angle over a turn",
    "first_harmonic_rad = first: amplitude of the error of the angle once a turn",
    "second_harmonic_rad = second: amplitude of the error of the angle twice a turn",
    check=_lists,
)
def _chain_with_errors(v: Values) -> Any:
    joints = Drives.from_angles(v.alpha, yoke_angle=RIGHT - v.kappa_between_joints)
    count = len(v.alpha)
    phase = v.phase_errors_before_each_joint
    phase = np.zeros(count) if phase is None else phase
    errors: dict[str, Any] = {
        "turns": np.concatenate((phase[:, None], v.angle_errors_alpha1_4_per_joint), axis=-1),
        "ways": v.linear_errors_s1_a1_4_per_joint,
    }
    if errors["ways"] is None:
        errors["ways"] = np.zeros((count, 5))
    here = transmission_error(joints, v.phi1, **errors)
    turn = transmission_error(joints, one_turn(), **errors)
    if not (here.closes and turn.closes):
        raise refuse("angle_errors_alpha1_4_per_joint", _("a joint with such errors cannot be assembled all round"))
    parts = course(turn.error)
    return parts, {
        "delta_phi_out_exact_rad": here.error[0],
        "delta_phi_out_linear_rad": here.error_linear[0],
        "axial_shift_out_exact_m": here.output_shift[0],
        "axial_shift_out_linear_m": here.shift_linear[-1, 0],
    }
