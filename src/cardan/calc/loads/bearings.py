"""Bearings of a cross: loads of its journals, capacities of needles, their contact and their swing."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.single_joint_forces import cross_loads
from cardan.calc.calculation import Formulas, Values
from cardan.formulas.needle_bearing import book_load, critical_swing, needle_contact, needle_rating
from cardan.reading.given import at_least_zero, given, positive, whole

from .life import ARM, JOINT_ANGLE, SIDE, WARNINGS, said

formula = Formulas(__doc__)


NEEDLES = whole("needles", "number of needles in a bearing", above=0.0)
NEEDLE = positive("needle_d_mm", "diameter of a needle")
NEEDLE_LENGTH = positive("needle_length_mm", "effective length of a needle")
JOURNAL = positive("journal_d_mm", "diameter of the journal")


def _rate(v: Values) -> float:
    """Return the swings in a second."""
    return float(v.cycles_per_min) / 60.0


@formula(
    "load of the journals and secondary couples of a joint over the turn, and their largest values",
    "Book (100), (114); balance of the cross",
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
    found = cross_loads(
        v.alpha,
        angle,
        v.torque,
        span=2.0 * v.R,
        torque_at=v.torque_side,
    )
    at = ... if np.ndim(v.phi) else 0
    return found, {
        "journal_force_N": found.journal[at],
        "couple_input_shaft_Nm": found.driving_couple[at],
        "couple_output_shaft_Nm": found.driven_couple[at],
    }


@formula(
    "load that the book allows on a needle bearing; ISO 76 limits it at low speeds",
    "Book (266)",
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
    "bends from which needles reach their neighbours' tracks; below them they wear patches of their own",
    "kinematics of pure rolling",
    (NEEDLES, NEEDLE, JOURNAL, JOINT_ANGLE),
    "alpha_crit_inner_deg: on the journal",
    "alpha_crit_outer_deg: on the outer race",
    WARNINGS,
)
def _small_oscillation(v: Values) -> Any:
    inner, outer = critical_swing(v.needles, v.needle_d, v.journal_d)
    return {
        "alpha_crit_inner_deg": inner,
        "alpha_crit_outer_deg": outer,
        "warnings": said(small_oscillation=v.alpha < inner),
    }
