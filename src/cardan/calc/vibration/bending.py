"""Calculations of bending critical speeds: closed formulas, stepped shafts, how far to stay below."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from cardan.calc.bores import bores
from cardan.calc.calculation import Calculation, Values, given, gives
from cardan.calc.keys import Given
from cardan.errors import Problem
from cardan.formulas.critical_speed import (
    BOOK_CONSTANT,
    CATALOGUE,
    ENDS,
    end_roots,
    longest_tube,
    material_constant,
    scaled_speed,
    speed_margin,
    thin_tube_speed,
    tube_speed,
    uniform_speed,
)
from cardan.texts import _, mark

MOST = 50
"""Most modes that can be asked for."""

STANDARD = 980.665
"""Acceleration of free fall [cm/s²]."""


def length(key: str, doc: str, **options: object) -> Given:
    """Return a key for a length, by default one that must be given."""
    return given(key, doc, "length", **options)  # type: ignore[arg-type]


def mode_count(default: int) -> Given:
    """Return the key for how many critical speeds are wanted."""
    return given("modes", mark("how many, lowest first"), kind="whole", low=1, high=MOST, default=default)


def _lacking(values: Values, names: tuple[str, ...], key: Callable[[str], str], needs: str) -> Iterator[Problem]:
    """Yield what is not given of a group that belongs together."""
    for name in names:
        if name in values and values[name] is None:
            yield Problem(key(name), _("missing; {other} needs it").format(other=needs), "missing")


def _closed_form(values: Values) -> Values:
    ends, modes = values["end_condition"], values["modes"]
    sizes = (values[name] for name in ("length", "outer_diameter", "inner_diameter", "E", "density"))
    speed = uniform_speed(*sizes, ends=ends, modes=modes)
    return {"lambda_": end_roots(ends, modes), "omega_rad_s": speed, "speed_rpm": speed}


TUBE = ("length", "outer_diameter", "inner_diameter")
SI_MATERIAL = ("E", "density")
BOOK_MATERIAL = ("E_kgf_cm2", "specific_weight_gf_cm3")


def _book_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from bores("outer_diameter", "inner_diameter")(values, key)
    for group in (("length", "outer_diameter"), SI_MATERIAL, BOOK_MATERIAL):
        there = [name for name in group if values.get(name) is not None]
        if there:
            yield from _lacking(values, group, key, key(there[0]))
    for given_last, first in ((BOOK_MATERIAL[0], SI_MATERIAL[0]), ("lambda_", "end_condition")):
        if values.get(given_last) is not None and values.get(first) is not None:
            yield Problem(key(given_last), _("{other} gives the same already").format(other=key(first)), "inconsistent")
    if all(values.get(name, 0.0) is None for name in ("length", SI_MATERIAL[0], BOOK_MATERIAL[0])):
        yield Problem(key("length"), _("missing; give a shaft, or the material of the constant"), "missing")


def _book(values: Values) -> Values:
    constant, found = BOOK_CONSTANT, {}
    ratio = None
    if values["E"] is not None:
        ratio = values["E"], values["density"]
    elif values["E_kgf_cm2"] is not None:
        # kgf/cm² over gf/cm³ is a length of 10 m; times free fall, in cm/s² of which 100 are 1 m/s².
        ratio = 10.0 * values["E_kgf_cm2"] / values["specific_weight_gf_cm3"] * values["g_cm_s2"] / 100.0, 1.0
    if ratio is not None:
        constant = float(material_constant(*ratio))
        found = {"K_rpm_m": constant, "K_rpm_cm": 100.0 * constant}
    if values["length"] is None:
        return found
    long, outer, inner = (values[name] for name in TUBE)
    if values["lambda_"] is not None:
        constant *= (values["lambda_"] / np.pi) ** 2
    speed = float(tube_speed(long, outer, inner, constant=constant, ends=values["end_condition"] or "pinned-pinned"))
    found |= {"n_crit_rpm": speed, "n_crit_actual_rpm": values["k_n"] * speed, "half_critical_rpm": 0.5 * speed}
    if inner and outer - inner <= 0.2 * outer and values["lambda_"] is None and values["end_condition"] is None:
        found["n_crit_thin_tube_rpm"] = float(thin_tube_speed(long, 0.5 * (outer + inner), constant=constant))
    if values["max_engine_speed"] is not None:
        margin = speed_margin(speed, values["max_engine_speed"] * values["gear_ratio"], wear=values["k_n"])
        found["ratio_calculated_to_engine"] = margin.computed_ratio
        found["rule_60_percent_met"] = margin.rule_60_percent
    return found


def _simple_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from bores("d_out", "d_in")(values, key)
    needed = {"exact": ("d_out", "length", "E", "density"), "book": ("d_out", "length")}
    names = needed.get(values.get("method", ""), ("n_reference", "length_ratio"))
    for name in names if "method" in values else ():
        if name in values and values[name] is None:
            text = _("missing; the method {method} needs it")
            yield Problem(key(name), text.format(method=values["method"]), "missing")


def _simple(values: Values) -> Values:
    size = values["length"], values["d_out"], values["d_in"]
    if values["method"] == "scale":
        speed = float(scaled_speed(values["n_reference"], values["length_ratio"], values["diameter_ratio"]))
    elif values["method"] == "book":
        speed = float(tube_speed(*size, ends=values["ends"]))
    else:
        speed = float(uniform_speed(*size, values["E"], values["density"], ends=values["ends"], modes=1)[0])
    return {"n_critical_rpm": speed, "n_critical_actual_rpm": values["k_n"] * speed}


def _margin(values: Values) -> Values:
    operating = values["operating"]
    found = speed_margin(
        values["n_critical"],
        values["n_max"],
        wear=values["k_n"],
        application=values["application"],
        operating=None if operating is None else tuple(np.atleast_1d(operating).tolist()),
    )
    longest = None
    if values["d_out"] is not None:
        longest = float(longest_tube(values["n_max"], values["d_out"], values["d_in"], wear=values["k_n"]))
    return {
        "ratio": found.ratio,
        "violated": list(found.violated),
        "half_critical_band_rpm": list(found.band),
        "half_critical_inside": found.half_inside,
        "longest_length_mm": longest,
    }


LENGTH = length("length_m", mark("length between the ends"), above=0.0)
OUTER = length("outer_diameter_m", mark("outer diameter"), above=0.0)
INNER = length("inner_diameter_m", mark("inner diameter; 0 for a full shaft"), low=0.0, default=0.0)
YOUNGS = given("E_Pa", mark("Young's modulus"), "stress", above=0.0)
DENSITY = given("density_kg_m3", mark("density"), "density", above=0.0)
MILLIMETRES = (
    length("length_mm", mark("length"), above=0.0),
    length("d_out_mm", mark("outer diameter"), above=0.0),
    length("d_in_mm", mark("inner diameter; 0 for a full shaft"), low=0.0, default=0.0),
    given("E_GPa", mark("Young's modulus"), "stress", above=0.0),
    DENSITY,
)
SPEED = gives("n_critical_rpm", mark("first critical speed as computed"), "angular_speed")
ACTUAL = gives("n_critical_actual_rpm", mark("that of the real shaft"), "angular_speed")
SPEEDS = gives("omega_rad_s", mark("angular speeds, lowest first"), "angular_speed")
WEAR = given(
    "k_n",
    mark("real over computed critical speed: 0.9-0.95 new, 0.7-0.8 with a worn spline"),
    above=0.0,
    high=1.0,
    default=1.0,
)


def _ends(key: str, default: str | None) -> Given:
    return given(key, mark("how the ends are held"), kind="word", choices=ENDS, default=default)


CALCULATIONS = (
    Calculation(
        name="critical_speed_closed_form",
        doc=mark("critical speeds of a uniform shaft in bending, without shear and rotary inertia"),
        source="Kozhevnikov & Perfil'ev (1978), eq. 253–256",
        takes=(_ends("end_condition", "pinned-pinned"), LENGTH, OUTER, INNER, YOUNGS, DENSITY, mode_count(3)),
        returns=(
            gives("lambda_", mark("roots of the frequency equation")),
            SPEEDS,
            gives("speed_rpm", mark("critical speeds, lowest first"), "angular_speed"),
        ),
        answer=_closed_form,
        check=bores("outer_diameter", "inner_diameter"),
    ),
    Calculation(
        name="critical_speed_book",
        doc=mark(
            "critical speed of a shaft between joints by the book's formula, its constant, and the 60 percent rule"
        ),
        source="Kozhevnikov & Perfil'ev (1978), eq. 257–260",
        takes=(
            length("length_m", LENGTH.meaning.doc, above=0.0, default=None),
            length("outer_diameter_m", OUTER.meaning.doc, above=0.0, default=None),
            INNER,
            WEAR,
            given(
                "max_engine_speed_rpm",
                mark("engine speed at its maximum power"),
                "angular_speed",
                above=0.0,
                default=None,
            ),
            given("gear_ratio", mark("speed of the shaft over that of the engine"), above=0.0, default=1.0),
            _ends("end_condition", None),
            given("lambda_", mark("first root of the frequency equation for other ends"), above=0.0, default=None),
            given(
                "E_Pa",
                mark("Young's modulus; the book's constant for steel without it"),
                "stress",
                above=0.0,
                default=None,
            ),
            given("density_kg_m3", mark("density"), "density", above=0.0, default=None),
            given("E_kgf_cm2", mark("Young's modulus in kgf/cm²"), above=0.0, default=None),
            given("specific_weight_gf_cm3", mark("specific weight in gf/cm³"), above=0.0, default=None),
            given("g_cm_s2", mark("acceleration of free fall in cm/s²"), above=0.0, default=STANDARD),
        ),
        returns=(
            gives("K_rpm_m", mark("constant of the formula, lengths in metres"), "angular_speed"),
            gives("K_rpm_cm", mark("constant of the formula, lengths in centimetres"), "angular_speed"),
            gives("n_crit_rpm", mark("critical speed as computed"), "angular_speed"),
            gives("n_crit_actual_rpm", mark("that of the real shaft"), "angular_speed"),
            gives("half_critical_rpm", mark("half the computed critical speed"), "angular_speed"),
            gives("n_crit_thin_tube_rpm", mark("critical speed by the formula for thin tubes"), "angular_speed"),
            gives("ratio_calculated_to_engine", mark("computed critical speed over the greatest speed of the shaft")),
            gives("rule_60_percent_met", mark("whether this is 1.6 or more")),
        ),
        answer=_book,
        check=_book_check,
    ),
    Calculation(
        name="critical_speed",
        doc=mark(
            "first critical speed of a uniform shaft: exactly, by the book's sizes alone, or from a similar shaft"
        ),
        source="Kozhevnikov & Perfil'ev (1978), eq. 256–260",
        takes=(
            given("method", mark("way"), kind="word", choices=("exact", "book", "scale"), default="exact"),
            *(replace(one, default=None) if one.required else one for one in MILLIMETRES),
            _ends("ends", "pinned-pinned"),
            WEAR,
            given(
                "n_reference_rpm", mark("critical speed of a similar shaft"), "angular_speed", above=0.0, default=None
            ),
            given("length_ratio", mark("length over that of the similar shaft"), above=0.0, default=None),
            given("diameter_ratio", mark("diameters over those of the similar shaft"), above=0.0, default=1.0),
        ),
        returns=(SPEED, ACTUAL),
        answer=_simple,
        check=_simple_check,
    ),
    Calculation(
        name="critical_speed_margin",
        doc=mark("how far a drive stays below a critical speed, by the rules of articles and makers"),
        source=mark("articles (60 percent), makers' catalogues (70 and 65 percent, half-critical band)"),
        takes=(
            given("n_critical_rpm", mark("critical speed as computed"), "angular_speed", above=0.0),
            given("n_max_rpm", mark("greatest speed"), "angular_speed", above=0.0),
            WEAR,
            given("application", mark("trade"), kind="word", choices=tuple(CATALOGUE), default="automotive"),
            given("operating_rpm", mark("speeds of running"), "angular_speed", axes=(0, 1), low=0.0, default=None),
            length("d_out_mm", mark("outer diameter, for the longest shaft"), above=0.0, default=None),
            length("d_in_mm", mark("inner diameter"), low=0.0, default=0.0),
        ),
        returns=(
            gives("ratio", mark("real critical speed over the greatest speed")),
            gives("violated", mark("rules broken: article_1.6, catalogue, supercritical")),
            gives(
                "half_critical_band_rpm", mark("speeds to keep out of, about half the critical speed"), "angular_speed"
            ),
            gives("half_critical_inside", mark("whether a speed of running lies in it")),
            gives("longest_length_mm", mark("how long a steel shaft between joints may be"), "length"),
        ),
        answer=_margin,
        check=bores("d_out", "d_in"),
    ),
)
