"""Calculations of the life of joints: loads of the cross, needle bearings, the book's rating, ISO 281, duty cycles."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.analysis.bearing_life import CONVENTIONS, bearing_life, maker_life
from cardan.analysis.duty_cycle import WHOLE, combined_life
from cardan.analysis.joint_rating import (
    LIFE_RANGE,
    SPEED_ANGLE_RANGE,
    book_life,
    life_factor,
    nominal_torque,
    rated_bend,
    rated_torque,
    speed_angle_factor,
    within,
)
from cardan.analysis.life_cautions import clamped, extrapolated
from cardan.analysis.needle_bearing import book_load, critical_swing, needle_contact, needle_rating
from cardan.analysis.single_joint_forces import cross_loads
from cardan.errors import Problem
from cardan.texts import _
from cardan.units import deg, rpm

from .calculation import Calculation, Given, Values, given, gives, rows
from .kinematics import RIGHT

HOUR = 3600.0

SLACK = 1e-12
"""What sums of decimal fractions may be off."""

WARNINGS = gives("warnings", _("what to mind, in alphabetical order"))


def _positive(key: str, doc: str, dimension: str | None = None, **options: Any) -> Given:
    return given(key, doc, dimension, above=0.0, **options)


def _not_negative(key: str, doc: str, dimension: str | None = None) -> Given:
    return given(key, doc, dimension, low=0.0)


CAPACITY = _positive("C_N", _("dynamic capacity of one bearing"), "force")
ARM = _positive("R_mm", _("from the axis of the shaft to the middle of a bearing, half the span"), "length")
SPEED = _positive("speed_rpm", _("speed of the shaft"), "angular_speed")
BEND = given("alpha_deg", _("bend of the joint"), "angle", low=0.0, below=RIGHT)
TORQUE = _positive("torque_Nm", _("torque of the shaft"), "torque")
SHOCK = given("shock_factor", _("factor for shocks, 1 for moderate to 1.38 for strong ones"), low=1.0, default=1.0)
SIDE = given(
    "torque_side", _("shaft on which the torque is constant"), kind="word", choices=("input", "output"), default="input"
)
METHOD = given(
    "method",
    _("law of the factor, or the table with its misprints put right"),
    kind="word",
    choices=("power_law", "table"),
    default="power_law",
)
NEEDLES = given("needles", _("number of needles in a bearing"), kind="whole", above=0.0)
NEEDLE = _positive("needle_d_mm", _("diameter of a needle"), "length")
NEEDLE_LENGTH = _positive("needle_length_mm", _("effective length of a needle"), "length")
JOURNAL = _positive("journal_d_mm", _("diameter of the journal"), "length")


def _limited(life: Any) -> Any:
    """Return lives with nan, which is written as null, for what is unlimited."""
    return np.where(np.isinf(life), np.nan, life)


def _said(**found: Any) -> list[str]:
    """Return the names of the warnings that hold, in alphabetical order."""
    return sorted(name for name, holds in found.items() if np.any(holds))


def _cross(values: Values) -> Values:
    angle = np.atleast_1d(values["phi"])
    found = cross_loads(
        values["alpha"],
        angle,
        values["torque"],
        span=2.0 * values["R"],
        torque_at=values["torque_side"],
    )
    at = ... if np.ndim(values["phi"]) else 0
    return {
        "journal_force_N": found.journal[at],
        "couple_input_shaft_Nm": found.driving_couple[at],
        "couple_output_shaft_Nm": found.driven_couple[at],
        "journal_force_max_N": found.journal_max,
        "couple_input_max_Nm": found.driving_couple_max,
        "couple_output_max_Nm": found.driven_couple_max,
    }


def _static(values: Values) -> Values:
    return {"load_allow_N": book_load(values["needles"], values["needle_d"], values["needle_length"], _rate(values))}


def _rate(values: Values) -> float:
    """Return the swings in a second."""
    return float(values["cycles_per_min"]) / 60.0


def _rating(values: Values) -> Values:
    found = needle_rating(*(values[name] for name in ("needles", "needle_d", "needle_length", "journal_d")))
    return {
        "pitch_d_mm": found.pitch_diameter,
        "gamma": found.slimness,
        "C0r_N": found.static,
        "f_c": found.factor,
        "Cr_N": found.dynamic,
    }


def _contact(values: Values) -> Values:
    names = ("journal_force", "needles", "needle_d", "needle_length", "journal_d")
    found = needle_contact(*(values[name] for name in names))
    return {
        "needle_force_max_N": found.force,
        "pressure_max_MPa": found.pressure,
        "half_width_mm": found.half_width,
    }


def _swing(values: Values) -> Values:
    inner, outer = critical_swing(values["needles"], values["needle_d"], values["journal_d"])
    return {
        "alpha_crit_inner_deg": inner,
        "alpha_crit_outer_deg": outer,
        "warnings": _said(small_oscillation=values["alpha"] < inner),
    }


def _outside(name: str, ends: tuple[float, float], unit: str, scale: float) -> Callable[..., Iterator[Problem]]:
    """Return a check that a table is not asked beyond its ends."""

    def check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
        value = values.get(name)
        if value is not None and values.get("method") == "table" and not np.all(within(value, ends)):
            text = _("the table reaches from {low:g} to {high:g} {unit}; the power law goes beyond")
            said = text.format(low=ends[0] / scale, high=ends[1] / scale, unit=unit)
            yield Problem(key(name), said, "out_of_range")

    return check


def _life_factor(values: Values) -> Values:
    life = values["life"]
    return {
        "f_h": life_factor(life, method=values["method"]),
        "warnings": _said(extrapolated=~within(life, LIFE_RANGE)),
    }


def _speed_factor(values: Values) -> Values:
    product = values["n_alpha"]
    return {
        "f_na": speed_angle_factor(product, method=values["method"]),
        "warnings": _said(extrapolated=~within(product, SPEED_ANGLE_RANGE)),
    }


def _warned(values: Values, life: Any) -> list[str]:
    """Return the warnings on a bend and on the tables of the book."""
    product = values["speed"] * rated_bend(values["alpha"])
    return _said(angle_clamped_3deg=clamped(values["alpha"]), extrapolated=extrapolated(product, life))


def _torque(values: Values) -> Values:
    nominal = nominal_torque(values["C"], values["R"])
    case = {"speed": values["speed"], "bend": values["alpha"], "life": values["life"], "shock": values["shock_factor"]}
    return {
        "M_nominal_Nm": nominal,
        "M_max_Nm": rated_torque(nominal, **case),
        "warnings": _warned(values, values["life"]),
    }


def _joint_life(values: Values) -> Values:
    found = _book(values, values)
    return {"life_h": found, "warnings": _warned(values, found)}


def _book(values: Values, regime: Values) -> Any:
    """Return the life of a joint by the book in a regime [s]."""
    return book_life(
        nominal_torque(values["C"], values["R"]),
        regime["torque"],
        speed=regime["speed"],
        bend=regime["alpha"],
        shock=values["shock_factor"],
    )


def _iso(values: Values) -> Values:
    found = bearing_life(
        values["C"],
        values["R"],
        values["torque"],
        speed=values["speed"],
        bend=values["alpha"],
        torque_at=values["torque_side"],
    )
    names = {"L10h_simple": found.simple, "L10h_driving_bearings": found.driving, "L10h_driven_bearings": found.driven}
    return {key: life / HOUR for key, life in names.items()}


def _still(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield a joint that does not bend."""
    if values.get("alpha") == 0.0:
        yield Problem(
            key("alpha"), _("a joint that does not bend has bearings that do not roll: no rating"), "singular"
        )


def _catalogue(values: Values) -> Values:
    case = {"speed": values["speed"], "bend": values["alpha"], "shock": values["shock_factor"]}
    found = maker_life(values["rating"], values["torque"], convention=values["convention"], **case)
    return {"L10h": found / HOUR, "warnings": _said(angle_clamped_3deg=clamped(values["alpha"]))}


def _cycle(values: Values) -> Values:
    regimes = values["regimes"]
    lives = np.asarray([_book(values, regime) for regime in regimes], dtype=float)
    share = np.asarray([regime["share"] for regime in regimes])
    whole = combined_life(lives, share)
    said = {
        name for regime, life in zip(regimes, lives, strict=True) if np.isfinite(life) for name in _warned(regime, life)
    }
    return {
        "life_each_h": _limited(lives),
        "life_equivalent_h": float(_limited(whole)),
        "warnings": sorted(said),
    }


def _shares(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield a duty cycle without parts, and one whose parts do not make up the whole time."""
    regimes = values.get("regimes")
    if regimes is None:
        return
    if not regimes:
        yield Problem(key("regimes"), _("empty; a duty cycle has at least one regime"), "empty")
        return
    whole = sum(regime["share"] for regime in regimes)
    if abs(whole - 1.0) > WHOLE + SLACK:
        text = _("the shares add up to {whole:.6g} %, not to 100 %")
        yield Problem(key("regimes"), text.format(whole=100.0 * whole), "inconsistent")


CALCULATIONS = (
    Calculation(
        name="cross_loads",
        doc=_("load of the journals and secondary couples of a joint over the turn, and their largest values"),
        source="Book (100), (114); balance of the cross",
        takes=(
            _not_negative("torque_Nm", _("torque, constant on one shaft"), "torque"),
            SIDE,
            BEND,
            ARM,
            given("phi_deg", _("angle of the driving yoke from the plane of the shafts"), "angle", axes=(0, 1)),
        ),
        returns=(
            gives("journal_force_N", _("load of each journal"), "force"),
            gives("couple_input_shaft_Nm", _("secondary couple on the input shaft"), "torque"),
            gives("couple_output_shaft_Nm", _("secondary couple on the output shaft"), "torque"),
            gives("journal_force_max_N", _("largest load of a journal over the turn"), "force"),
            gives("couple_input_max_Nm", _("largest couple on the input shaft"), "torque"),
            gives("couple_output_max_Nm", _("largest couple on the output shaft"), "torque"),
        ),
        answer=_cross,
    ),
    Calculation(
        name="needle_static_book",
        doc=_("load that the book allows on a needle bearing; ISO 76 limits it at low speeds"),
        source="Book (266)",
        takes=(
            NEEDLES,
            NEEDLE_LENGTH,
            NEEDLE,
            _positive("cycles_per_min", _("swings a minute; one for every turn of the shaft")),
        ),
        returns=(gives("load_allow_N", _("load allowed on one bearing"), "force"),),
        answer=_static,
    ),
    Calculation(
        name="needle_iso",
        doc=_("static and dynamic capacity of a full row of needles"),
        source="ISO 76, ISO 281",
        takes=(NEEDLES, NEEDLE_LENGTH, NEEDLE, JOURNAL),
        returns=(
            gives("pitch_d_mm", _("pitch diameter"), "length"),
            gives("gamma", _("needle over pitch diameter")),
            gives("C0r_N", _("static capacity"), "force"),
            gives("f_c", _("factor of ISO 281")),
            gives("Cr_N", _("dynamic capacity"), "force"),
        ),
        answer=_rating,
    ),
    Calculation(
        name="needle_hertz",
        doc=_("contact of the most loaded needle with its journal"),
        source=_("Hertz, line contact; Stribeck's distribution of the load"),
        takes=(
            _not_negative("journal_force_N", _("load of the journal"), "force"),
            NEEDLES,
            NEEDLE_LENGTH,
            NEEDLE,
            JOURNAL,
        ),
        returns=(
            gives("needle_force_max_N", _("load of the most loaded needle"), "force"),
            gives("pressure_max_MPa", _("largest pressure"), "stress"),
            gives("half_width_mm", _("half the width of the contact"), "length"),
        ),
        answer=_contact,
    ),
    Calculation(
        name="small_oscillation",
        doc=_("bends from which needles reach their neighbours' tracks; below them they wear patches of their own"),
        source=_("kinematics of pure rolling"),
        takes=(NEEDLES, NEEDLE, JOURNAL, BEND),
        returns=(
            gives("alpha_crit_inner_deg", _("on the journal"), "angle"),
            gives("alpha_crit_outer_deg", _("on the outer race"), "angle"),
            WARNINGS,
        ),
        answer=_swing,
    ),
    Calculation(
        name="f_h",
        doc=_("factor of life of the book's rating"),
        source=_("Book, table 6"),
        takes=(_positive("life_h", _("life"), "time"), METHOD),
        returns=(gives("f_h", _("factor")), WARNINGS),
        answer=_life_factor,
        check=_outside("life", LIFE_RANGE, "h", HOUR),
    ),
    Calculation(
        name="f_na",
        doc=_("factor of speed times bend of the book's rating"),
        source=_("Book, table 7"),
        takes=(_positive("n_alpha_rpm_deg", _("speed times bend"), "speed_angle"), METHOD),
        returns=(gives("f_na", _("factor")), WARNINGS),
        answer=_speed_factor,
        check=_outside("n_alpha", SPEED_ANGLE_RANGE, "rpm·°", rpm * deg),
    ),
    Calculation(
        name="joint_rating",
        doc=_("torque that a joint may carry for a life, by the book"),
        source=_("Book (267), restored"),
        takes=(CAPACITY, ARM, SPEED, BEND, _positive("life_h", _("life"), "time"), SHOCK),
        returns=(
            gives("M_nominal_Nm", _("nominal torque: 5000 h at 33.3 rpm and 3°"), "torque"),
            gives("M_max_Nm", _("torque allowed"), "torque"),
            WARNINGS,
        ),
        answer=_torque,
    ),
    Calculation(
        name="joint_life",
        doc=_("life of a joint, by the book"),
        source=_("Book (267), restored, solved for the life"),
        takes=(CAPACITY, ARM, SPEED, BEND, TORQUE, SHOCK),
        returns=(gives("life_h", _("life"), "time"), WARNINGS),
        answer=_joint_life,
    ),
    Calculation(
        name="iso_life",
        doc=_("life L10 of the bearings of one joint, by the mean load and by the exact integral over the turn"),
        source="ISO 281",
        takes=(CAPACITY, ARM, TORQUE, SIDE, SPEED, BEND),
        returns=(
            gives("L10h_simple", _("by the mean load [h]")),
            gives("L10h_driving_bearings", _("of the bearings in the driving yoke [h]")),
            gives("L10h_driven_bearings", _("of the bearings in the driven yoke [h]")),
        ),
        answer=_iso,
        check=_still,
    ),
    Calculation(
        name="catalogue_life",
        doc=_("life L10 of a joint by a maker's formula"),
        source=_("makers' catalogues; constants differ, never mix rating and formula"),
        takes=(
            given("convention", _("what the rating means"), kind="word", choices=tuple(CONVENTIONS)),
            _positive("rating_Nm", _("rated torque Tc, or dynamic capacity times arm"), "torque"),
            TORQUE,
            SPEED,
            BEND,
            SHOCK,
        ),
        returns=(gives("L10h", _("life [h]")), WARNINGS),
        answer=_catalogue,
    ),
    Calculation(
        name="duty_cycle_life",
        doc=_("life of a joint in a duty cycle, by the book"),
        source=_("Book (268), (269), restored"),
        takes=(
            CAPACITY,
            ARM,
            SHOCK,
            rows(
                "regimes",
                _("parts of the duty cycle"),
                _not_negative("torque_Nm", _("torque"), "torque"),
                SPEED,
                BEND,
                _not_negative("share_percent", _("share of the whole time"), "share"),
            ),
        ),
        returns=(
            gives("life_each_h", _("life if each regime ran all the time; null is unlimited"), "time"),
            gives("life_equivalent_h", _("life in the duty cycle; null is unlimited"), "time"),
            WARNINGS,
        ),
        answer=_cycle,
        check=_shares,
    ),
)
