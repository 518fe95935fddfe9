"""Life of joints: the book's rating, ISO 281, makers' formulas, duty cycles, needles of a cross."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.book.joint_forces import cross_loads
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import Problem
from cardan.formulas.ball_bearing import ball_life, equivalent_load, static_load
from cardan.formulas.joint_rating import (
    LIFE_RANGE,
    SPEED_ANGLE_RANGE,
    book_life,
    book_load,
    critical_swing,
    life_factor,
    needle_contact,
    needle_rating,
    nominal_torque,
    rated_joint_angle,
    rated_torque,
    speed_angle_factor,
    within,
)
from cardan.questions.life.bearing_life import CONVENTIONS, bearing_life, maker_life
from cardan.questions.life.duty_cycle import WHOLE, combined_life
from cardan.questions.life.life_cautions import clamped, extrapolated
from cardan.reading.given import at_least_zero, given, gives, joint_angle, positive, rows, whole, word
from cardan.texts import _
from cardan.units import deg, hour, rpm

formula = Formulas(__doc__)

SLACK = 1e-12
"""What sums of decimal fractions may be off."""

WARNINGS = "warnings: what to mind, in alphabetical order"

CAPACITY = positive("C_N", "dynamic capacity of one bearing")
ARM = positive("R_mm", "from the axis of the shaft to the middle of a bearing, half the span")
SPEED = positive("speed_rpm", "speed of the shaft")
JOINT_ANGLE = joint_angle("alpha_deg", "joint angle of the joint")
TORQUE = positive("torque_Nm", "torque of the shaft")
SHOCK = given("shock_factor", "factor for shocks, 1 for moderate to 1.38 for strong ones", low=1.0, default=1.0)
SIDE = word("torque_side", "shaft on which the torque is constant", "input", "output", default="input")
METHOD = word(
    "method", "law of the factor, or the table with its misprints put right", "power_law", "table", default="power_law"
)


def _limited(life: Any) -> Any:
    """Return lives with nan, which is written as null, for what is unlimited."""
    return np.where(np.isinf(life), np.nan, life)


def said(**found: Any) -> list[str]:
    """Return the names of the warnings that hold, in alphabetical order."""
    return sorted(name for name, holds in found.items() if np.any(holds))


def _outside(name: str, ends: tuple[float, float], unit: str, scale: float) -> Callable[..., Iterator[Problem]]:
    """Return a check that a table is not asked beyond its ends."""

    def check(v: Values) -> Problems:
        value = v.get(name)
        if value is not None and v.get("method") == "table" and not np.all(within(value, ends)):
            text = _("the table reaches from {low:g} to {high:g} {unit}; the power law goes beyond")
            reach = text.format(low=ends[0] / scale, high=ends[1] / scale, unit=unit)
            yield v.wrong(name, reach, "out_of_range")

    return check


def _warned(v: Values, life: Any) -> list[str]:
    """Return the warnings on a joint angle and on the tables of the book."""
    product = v.speed * rated_joint_angle(v.alpha)
    return said(angle_clamped_3deg=clamped(v.alpha), extrapolated=extrapolated(product, life))


def _book(v: Values, regime: Values) -> Any:
    """Return the life of a joint by the book in a regime [s]."""
    return book_life(
        nominal_torque(v.C, v.R), regime.torque, speed=regime.speed, joint_angle=regime.alpha, shock=v.shock_factor
    )


def _still(v: Values) -> Problems:
    """Yield a joint that does not bend."""
    if v.get("alpha") == 0.0:
        yield v.wrong("alpha", _("a joint at 0° has bearings that do not roll: no rating"), "singular")


def _shares(v: Values) -> Problems:
    """Yield a duty cycle without parts, and one whose parts do not make up the whole time."""
    regimes = v.get("regimes")
    if regimes is None:
        return
    if not regimes:
        yield v.wrong("regimes", _("empty; a duty cycle has at least one regime"), "empty")
        return
    whole = sum(regime.share for regime in regimes)
    if abs(whole - 1.0) > WHOLE + SLACK:
        yield v.wrong(
            "regimes", _("the shares add up to {whole:.6g} %, not to 100 %"), "inconsistent", whole=100.0 * whole
        )


@formula(
    "factor of life of the book's rating",
    "Kozhevnikov & Perfil'ev (1978), table 6",
    positive("life_h", "life"),
    METHOD,
    gives("f_h", "factor", None),
    WARNINGS,
    check=_outside("life", LIFE_RANGE, "h", hour),
)
def _f_h(v: Values) -> Any:
    life = v.life
    return life_factor(life, method=v.method), said(extrapolated=~within(life, LIFE_RANGE))


@formula(
    "factor of speed times joint angle of the book's rating",
    "Kozhevnikov & Perfil'ev (1978), table 7",
    positive("n_alpha_rpm_deg", "speed times joint angle"),
    METHOD,
    "f_na: factor",
    WARNINGS,
    check=_outside("n_alpha", SPEED_ANGLE_RANGE, "rpm·°", rpm * deg),
)
def _f_na(v: Values) -> Any:
    product = v.n_alpha
    return speed_angle_factor(product, method=v.method), said(extrapolated=~within(product, SPEED_ANGLE_RANGE))


@formula(
    "torque that a joint may carry for a life, by the book",
    "Kozhevnikov & Perfil'ev (1978), eq. 267, restored",
    (CAPACITY, ARM, SPEED, JOINT_ANGLE),
    positive("life_h", "life"),
    SHOCK,
    "M_nominal_Nm: nominal torque: 5000 h at 33.3 rpm and 3°",
    "M_max_Nm: torque allowed",
    WARNINGS,
)
def _joint_rating(v: Values) -> Any:
    nominal = nominal_torque(v.C, v.R)
    case = {"speed": v.speed, "joint_angle": v.alpha, "life": v.life, "shock": v.shock_factor}
    return nominal, rated_torque(nominal, **case), _warned(v, v.life)


@formula(
    "life of a joint, by the book",
    "Kozhevnikov & Perfil'ev (1978), eq. 267, restored, solved for the life",
    (CAPACITY, ARM, SPEED, JOINT_ANGLE, TORQUE, SHOCK),
    "life_h: life",
    WARNINGS,
)
def _joint_life(v: Values) -> Any:
    found = _book(v, v)
    return found, _warned(v, found)


@formula(
    "life L10 of the bearings of one joint, by the mean load and by the exact integral over the turn",
    "ISO 281",
    (CAPACITY, ARM, TORQUE, SIDE, SPEED, JOINT_ANGLE),
    "L10h_simple: by the mean load [h]",
    "L10h_driving_bearings: of the bearings in the driving yoke [h]",
    "L10h_driven_bearings: of the bearings in the driven yoke [h]",
    check=_still,
)
def _iso_life(v: Values) -> Any:
    found = bearing_life(v.C, v.R, v.torque, **v.of("speed", joint_angle="alpha", torque_at="torque_side"))
    return tuple(life / hour for life in (found.simple, found.driving, found.driven))


@formula(
    "equivalent loads and life L10 of a deep groove ball bearing",
    "ISO 281, table of X and Y for normal clearance; ISO 76",
    positive("C_N", "dynamic capacity"),
    positive("C0_N", "static capacity"),
    at_least_zero("radial_force_N", "radial force"),
    at_least_zero("axial_force_N", "axial force", default=0.0),
    SPEED,
    "P_N: equivalent load",
    "P0_N: equivalent load at rest",
    "L10h: life; null is unlimited [h]",
)
def _ball_bearing_life(v: Values) -> Any:
    load = equivalent_load(v.radial_force, v.axial_force, v.C0)
    life = _limited(ball_life(v.C, load, speed=v.speed))
    return load, static_load(v.radial_force, v.axial_force), life / hour


@formula(
    "life L10 of a joint by a maker's formula",
    "makers' catalogues; constants differ, never mix rating and formula",
    word("convention", "what the rating means", *CONVENTIONS),
    positive("rating_Nm", "rated torque Tc, or dynamic capacity times arm"),
    (TORQUE, SPEED, JOINT_ANGLE, SHOCK),
    "L10h: life [h]",
    WARNINGS,
)
def _catalogue_life(v: Values) -> Any:
    case = {"speed": v.speed, "joint_angle": v.alpha, "shock": v.shock_factor}
    found = maker_life(v.rating, v.torque, convention=v.convention, **case)
    return found / hour, said(angle_clamped_3deg=clamped(v.alpha))


@formula(
    "life of a joint in a duty cycle, by the book",
    "Kozhevnikov & Perfil'ev (1978), eq. 268, 269, restored",
    (CAPACITY, ARM, SHOCK),
    rows(
        "regimes",
        "parts of the duty cycle",
        at_least_zero("torque_Nm", "torque"),
        SPEED,
        JOINT_ANGLE,
        at_least_zero("share_percent", "share of the whole time"),
    ),
    "life_each_h: life if each regime ran all the time; null is unlimited",
    "life_equivalent_h: life in the duty cycle; null is unlimited",
    WARNINGS,
    check=_shares,
)
def _duty_cycle_life(v: Values) -> Any:
    regimes = v.regimes
    lives = np.asarray([_book(v, regime) for regime in regimes], dtype=float)
    share = np.asarray([regime.share for regime in regimes])
    whole = combined_life(lives, share)
    names = {
        name for regime, life in zip(regimes, lives, strict=True) if np.isfinite(life) for name in _warned(regime, life)
    }
    return _limited(lives), float(_limited(whole)), sorted(names)


NEEDLES = whole("needles", "number of needles in a bearing", above=0.0)
NEEDLE = positive("needle_d_mm", "diameter of a needle")
NEEDLE_LENGTH = positive("needle_length_mm", "effective length of a needle")
JOURNAL = positive("journal_d_mm", "diameter of the journal")


def _rate(v: Values) -> float:
    """Return the swings in a second."""
    return float(v.cycles_per_min) / 60.0


@formula(
    "load of the journals and secondary couples of a joint over the turn, and their largest values",
    "Kozhevnikov & Perfil'ev (1978), eq. 100, 114; balance of the cross",
    at_least_zero("torque_Nm", "torque, constant on one shaft"),
    (SIDE, JOINT_ANGLE, ARM),
    given("phi_deg", "angle of the driving yoke from the plane of the shafts", axes=(0, 1)),
    "journal_force_N: load of each journal",
    "couple_input_shaft_Nm: secondary couple on the input shaft",
    "couple_output_shaft_Nm: secondary couple on the output shaft",
    "journal_force_max_N = journal_max: largest load of a journal over the turn",
    "couple_input_max_Nm = driving_couple_max: largest couple on the input shaft",
    "couple_output_max_Nm = driven_couple_max: largest couple on the output shaft",
)
def _cross_loads(v: Values) -> Any:
    angle = np.atleast_1d(v.phi)
    found = cross_loads(v.alpha, angle, v.torque, span=2.0 * v.R, torque_at=v.torque_side)
    at = ... if np.ndim(v.phi) else 0
    return found, {
        "journal_force_N": found.journal[at],
        "couple_input_shaft_Nm": found.driving_couple[at],
        "couple_output_shaft_Nm": found.driven_couple[at],
    }


@formula(
    "load that the book allows on a needle bearing; ISO 76 limits it at low speeds",
    "Kozhevnikov & Perfil'ev (1978), eq. 266",
    (NEEDLES, NEEDLE_LENGTH, NEEDLE),
    positive("cycles_per_min", "oscillations a minute; one for every turn of the shaft", None),
    "load_allow_N: load allowed on one bearing",
)
def _needle_static_book(v: Values) -> Any:
    return book_load(v.needles, v.needle_d, v.needle_length, _rate(v))


@formula(
    "static and dynamic capacity of a full row of needles",
    "ISO 76, ISO 281",
    (NEEDLES, NEEDLE_LENGTH, NEEDLE, JOURNAL),
    "pitch_d_mm: pitch diameter",
    "gamma: needle over pitch diameter",
    "C0r_N: static capacity",
    "f_c: factor of ISO 281",
    "Cr_N: dynamic capacity",
)
def _needle_iso(v: Values) -> Any:
    found = needle_rating(*(v[name] for name in ("needles", "needle_d", "needle_length", "journal_d")))
    return found.pitch_diameter, found.slimness, found.static, found.factor, found.dynamic


@formula(
    "contact of the most loaded needle with its journal",
    "Hertz, line contact; Stribeck's distribution of the load",
    at_least_zero("journal_force_N", "load of the journal"),
    (NEEDLES, NEEDLE_LENGTH, NEEDLE, JOURNAL),
    "needle_force_max_N: load of the most loaded needle",
    "pressure_max_MPa: largest pressure",
    "half_width_mm: half the width of the contact",
)
def _needle_hertz(v: Values) -> Any:
    names = ("journal_force", "needles", "needle_d", "needle_length", "journal_d")
    found = needle_contact(*(v[name] for name in names))
    return found.force, found.pressure, found.half_width


@formula(
    "joint angles from which needles reach their neighbours' tracks; below them false brinelling",
    "kinematics of pure rolling",
    (NEEDLES, NEEDLE, JOURNAL, JOINT_ANGLE),
    "alpha_crit_inner_deg: on the journal",
    "alpha_crit_outer_deg: on the outer race",
    WARNINGS,
)
def _small_oscillation(v: Values) -> Any:
    inner, outer = critical_swing(v.needles, v.needle_d, v.journal_d)
    return inner, outer, said(small_oscillation=v.alpha < inner)
