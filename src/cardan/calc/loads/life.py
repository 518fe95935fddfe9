"""Calculations of the life of joints: the book's rating, ISO 281, makers' formulas, duty cycles."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.calc.calculation import Calculation, Values, at_least_zero, given, gives, positive, rows
from cardan.calc.motion.kinematics import RIGHT
from cardan.errors import Problem
from cardan.formulas.joint_rating import (
    LIFE_RANGE,
    SPEED_ANGLE_RANGE,
    book_life,
    life_factor,
    nominal_torque,
    rated_joint_angle,
    rated_torque,
    speed_angle_factor,
    within,
)
from cardan.questions.life.bearing_life import CONVENTIONS, bearing_life, maker_life
from cardan.questions.life.duty_cycle import WHOLE, combined_life
from cardan.questions.life.life_cautions import clamped, extrapolated
from cardan.texts import _, mark
from cardan.units import deg, rpm

HOUR = 3600.0

SLACK = 1e-12
"""What sums of decimal fractions may be off."""

WARNINGS = gives("warnings", mark("what to mind, in alphabetical order"))


CAPACITY = positive("C_N", mark("dynamic capacity of one bearing"), "force")
ARM = positive("R_mm", mark("from the axis of the shaft to the middle of a bearing, half the span"), "length")
SPEED = positive("speed_rpm", mark("speed of the shaft"), "angular_speed")
JOINT_ANGLE = given("alpha_deg", mark("joint angle of the joint"), "angle", low=0.0, below=RIGHT)
TORQUE = positive("torque_Nm", mark("torque of the shaft"), "torque")
SHOCK = given("shock_factor", mark("factor for shocks, 1 for moderate to 1.38 for strong ones"), low=1.0, default=1.0)
SIDE = given(
    "torque_side",
    mark("shaft on which the torque is constant"),
    kind="word",
    choices=("input", "output"),
    default="input",
)
METHOD = given(
    "method",
    mark("law of the factor, or the table with its misprints put right"),
    kind="word",
    choices=("power_law", "table"),
    default="power_law",
)


def _limited(life: Any) -> Any:
    """Return lives with nan, which is written as null, for what is unlimited."""
    return np.where(np.isinf(life), np.nan, life)


def said(**found: Any) -> list[str]:
    """Return the names of the warnings that hold, in alphabetical order."""
    return sorted(name for name, holds in found.items() if np.any(holds))


def _outside(name: str, ends: tuple[float, float], unit: str, scale: float) -> Callable[..., Iterator[Problem]]:
    """Return a check that a table is not asked beyond its ends."""

    def check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
        value = values.get(name)
        if value is not None and values.get("method") == "table" and not np.all(within(value, ends)):
            text = _("the table reaches from {low:g} to {high:g} {unit}; the power law goes beyond")
            reach = text.format(low=ends[0] / scale, high=ends[1] / scale, unit=unit)
            yield Problem(key(name), reach, "out_of_range")

    return check


def _life_factor(values: Values) -> Values:
    life = values["life"]
    return {
        "f_h": life_factor(life, method=values["method"]),
        "warnings": said(extrapolated=~within(life, LIFE_RANGE)),
    }


def _speed_factor(values: Values) -> Values:
    product = values["n_alpha"]
    return {
        "f_na": speed_angle_factor(product, method=values["method"]),
        "warnings": said(extrapolated=~within(product, SPEED_ANGLE_RANGE)),
    }


def _warned(values: Values, life: Any) -> list[str]:
    """Return the warnings on a joint angle and on the tables of the book."""
    product = values["speed"] * rated_joint_angle(values["alpha"])
    return said(angle_clamped_3deg=clamped(values["alpha"]), extrapolated=extrapolated(product, life))


def _torque(values: Values) -> Values:
    nominal = nominal_torque(values["C"], values["R"])
    case = {
        "speed": values["speed"],
        "joint_angle": values["alpha"],
        "life": values["life"],
        "shock": values["shock_factor"],
    }
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
        joint_angle=regime["alpha"],
        shock=values["shock_factor"],
    )


def _iso(values: Values) -> Values:
    found = bearing_life(
        values["C"],
        values["R"],
        values["torque"],
        speed=values["speed"],
        joint_angle=values["alpha"],
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
    case = {"speed": values["speed"], "joint_angle": values["alpha"], "shock": values["shock_factor"]}
    found = maker_life(values["rating"], values["torque"], convention=values["convention"], **case)
    return {"L10h": found / HOUR, "warnings": said(angle_clamped_3deg=clamped(values["alpha"]))}


def _cycle(values: Values) -> Values:
    regimes = values["regimes"]
    lives = np.asarray([_book(values, regime) for regime in regimes], dtype=float)
    share = np.asarray([regime["share"] for regime in regimes])
    whole = combined_life(lives, share)
    names = {
        name for regime, life in zip(regimes, lives, strict=True) if np.isfinite(life) for name in _warned(regime, life)
    }
    return {
        "life_each_h": _limited(lives),
        "life_equivalent_h": float(_limited(whole)),
        "warnings": sorted(names),
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
        name="f_h",
        doc=mark("factor of life of the book's rating"),
        source=mark("Kozhevnikov & Perfil'ev (1978), table 6"),
        takes=(positive("life_h", mark("life"), "time"), METHOD),
        returns=(gives("f_h", mark("factor")), WARNINGS),
        answer=_life_factor,
        check=_outside("life", LIFE_RANGE, "h", HOUR),
    ),
    Calculation(
        name="f_na",
        doc=mark("factor of speed times bend of the book's rating"),
        source=mark("Kozhevnikov & Perfil'ev (1978), table 7"),
        takes=(positive("n_alpha_rpm_deg", mark("speed times bend"), "speed_angle"), METHOD),
        returns=(gives("f_na", mark("factor")), WARNINGS),
        answer=_speed_factor,
        check=_outside("n_alpha", SPEED_ANGLE_RANGE, "rpm·°", rpm * deg),
    ),
    Calculation(
        name="joint_rating",
        doc=mark("torque that a joint may carry for a life, by the book"),
        source=mark("Kozhevnikov & Perfil'ev (1978), eq. 267, restored"),
        takes=(CAPACITY, ARM, SPEED, JOINT_ANGLE, positive("life_h", mark("life"), "time"), SHOCK),
        returns=(
            gives("M_nominal_Nm", mark("nominal torque: 5000 h at 33.3 rpm and 3°"), "torque"),
            gives("M_max_Nm", mark("torque allowed"), "torque"),
            WARNINGS,
        ),
        answer=_torque,
    ),
    Calculation(
        name="joint_life",
        doc=mark("life of a joint, by the book"),
        source=mark("Kozhevnikov & Perfil'ev (1978), eq. 267, restored, solved for the life"),
        takes=(CAPACITY, ARM, SPEED, JOINT_ANGLE, TORQUE, SHOCK),
        returns=(gives("life_h", mark("life"), "time"), WARNINGS),
        answer=_joint_life,
    ),
    Calculation(
        name="iso_life",
        doc=mark("life L10 of the bearings of one joint, by the mean load and by the exact integral over the turn"),
        source="ISO 281",
        takes=(CAPACITY, ARM, TORQUE, SIDE, SPEED, JOINT_ANGLE),
        returns=(
            gives("L10h_simple", mark("by the mean load [h]")),
            gives("L10h_driving_bearings", mark("of the bearings in the driving yoke [h]")),
            gives("L10h_driven_bearings", mark("of the bearings in the driven yoke [h]")),
        ),
        answer=_iso,
        check=_still,
    ),
    Calculation(
        name="catalogue_life",
        doc=mark("life L10 of a joint by a maker's formula"),
        source=mark("makers' catalogues; constants differ, never mix rating and formula"),
        takes=(
            given("convention", mark("what the rating means"), kind="word", choices=tuple(CONVENTIONS)),
            positive("rating_Nm", mark("rated torque Tc, or dynamic capacity times arm"), "torque"),
            TORQUE,
            SPEED,
            JOINT_ANGLE,
            SHOCK,
        ),
        returns=(gives("L10h", mark("life [h]")), WARNINGS),
        answer=_catalogue,
    ),
    Calculation(
        name="duty_cycle_life",
        doc=mark("life of a joint in a duty cycle, by the book"),
        source=mark("Kozhevnikov & Perfil'ev (1978), eq. 268, 269, restored"),
        takes=(
            CAPACITY,
            ARM,
            SHOCK,
            rows(
                "regimes",
                mark("parts of the duty cycle"),
                at_least_zero("torque_Nm", mark("torque"), "torque"),
                SPEED,
                JOINT_ANGLE,
                at_least_zero("share_percent", mark("share of the whole time"), "share"),
            ),
        ),
        returns=(
            gives("life_each_h", mark("life if each regime ran all the time; null is unlimited"), "time"),
            gives("life_equivalent_h", mark("life in the duty cycle; null is unlimited"), "time"),
            WARNINGS,
        ),
        answer=_cycle,
        check=_shares,
    ),
)
