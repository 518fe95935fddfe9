"""Calculations of bearings of a cross: loads of its journals, capacities of needles, their contact and their swing."""

from __future__ import annotations

import numpy as np

from cardan.book.single_joint_forces import cross_loads
from cardan.calc.calculation import Calculation, Values, at_least_zero, given, gives, positive
from cardan.formulas.needle_bearing import book_load, critical_swing, needle_contact, needle_rating
from cardan.texts import mark

from .life import ARM, JOINT_ANGLE, SIDE, WARNINGS, said

NEEDLES = given("needles", mark("number of needles in a bearing"), kind="whole", above=0.0)
NEEDLE = positive("needle_d_mm", mark("diameter of a needle"), "length")
NEEDLE_LENGTH = positive("needle_length_mm", mark("effective length of a needle"), "length")
JOURNAL = positive("journal_d_mm", mark("diameter of the journal"), "length")


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
        "warnings": said(small_oscillation=values["alpha"] < inner),
    }


CALCULATIONS = (
    Calculation(
        name="cross_loads",
        doc=mark("load of the journals and secondary couples of a joint over the turn, and their largest values"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 100, 114; balance of the cross",
        takes=(
            at_least_zero("torque_Nm", mark("torque, constant on one shaft"), "torque"),
            SIDE,
            JOINT_ANGLE,
            ARM,
            given("phi_deg", mark("angle of the driving yoke from the plane of the shafts"), "angle", axes=(0, 1)),
        ),
        returns=(
            gives("journal_force_N", mark("load of each journal"), "force"),
            gives("couple_input_shaft_Nm", mark("secondary couple on the input shaft"), "torque"),
            gives("couple_output_shaft_Nm", mark("secondary couple on the output shaft"), "torque"),
            gives("journal_force_max_N", mark("largest load of a journal over the turn"), "force"),
            gives("couple_input_max_Nm", mark("largest couple on the input shaft"), "torque"),
            gives("couple_output_max_Nm", mark("largest couple on the output shaft"), "torque"),
        ),
        answer=_cross,
    ),
    Calculation(
        name="needle_static_book",
        doc=mark("load that the book allows on a needle bearing; ISO 76 limits it at low speeds"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 266",
        takes=(
            NEEDLES,
            NEEDLE_LENGTH,
            NEEDLE,
            positive("cycles_per_min", mark("oscillations a minute; one for every turn of the shaft")),
        ),
        returns=(gives("load_allow_N", mark("load allowed on one bearing"), "force"),),
        answer=_static,
    ),
    Calculation(
        name="needle_iso",
        doc=mark("static and dynamic capacity of a full row of needles"),
        source="ISO 76, ISO 281",
        takes=(NEEDLES, NEEDLE_LENGTH, NEEDLE, JOURNAL),
        returns=(
            gives("pitch_d_mm", mark("pitch diameter"), "length"),
            gives("gamma", mark("needle over pitch diameter")),
            gives("C0r_N", mark("static capacity"), "force"),
            gives("f_c", mark("factor of ISO 281")),
            gives("Cr_N", mark("dynamic capacity"), "force"),
        ),
        answer=_rating,
    ),
    Calculation(
        name="needle_hertz",
        doc=mark("contact of the most loaded needle with its journal"),
        source=mark("Hertz, line contact; Stribeck's distribution of the load"),
        takes=(
            at_least_zero("journal_force_N", mark("load of the journal"), "force"),
            NEEDLES,
            NEEDLE_LENGTH,
            NEEDLE,
            JOURNAL,
        ),
        returns=(
            gives("needle_force_max_N", mark("load of the most loaded needle"), "force"),
            gives("pressure_max_MPa", mark("largest pressure"), "stress"),
            gives("half_width_mm", mark("half the width of the contact"), "length"),
        ),
        answer=_contact,
    ),
    Calculation(
        name="small_oscillation",
        doc=mark("bends from which needles reach their neighbours' tracks; below them they wear patches of their own"),
        source=mark("kinematics of pure rolling"),
        takes=(NEEDLES, NEEDLE, JOURNAL, JOINT_ANGLE),
        returns=(
            gives("alpha_crit_inner_deg", mark("on the journal"), "angle"),
            gives("alpha_crit_outer_deg", mark("on the outer race"), "angle"),
            WARNINGS,
        ),
        answer=_swing,
    ),
)
