"""Bending critical speeds: closed formulas, stepped shafts with supports and masses, how far to stay below."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from cardan.book.stepped import Node, placed_speeds, stepped_speeds
from cardan.calc.bores import bores, segment_bores
from cardan.calc.calculation import Formulas, Problems, Values
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
from cardan.maths.linear.rotor_beams import Section, round_section
from cardan.reading.given import Given, at_least_zero, flag, given, gives, positive, rows, whole, word
from cardan.texts import _

formula = Formulas(__doc__)
MOST = 50
"""Most modes that can be asked for."""

STANDARD = 980.665
"""Acceleration of free fall [cm/s²]."""


def mode_count(default: int) -> Given:
    """Return the key for how many critical speeds are wanted."""
    return whole("modes", "how many, lowest first", low=1, high=MOST, default=default)


TUBE = ("length", "outer_diameter", "inner_diameter")
SI_MATERIAL = ("E", "density")
BOOK_MATERIAL = ("E_kgf_cm2", "specific_weight_gf_cm3")


def _book_check(v: Values) -> Problems:
    yield from bores("outer_diameter", "inner_diameter")(v)
    for group in (("length", "outer_diameter"), SI_MATERIAL, BOOK_MATERIAL):
        there = [name for name in group if v.get(name) is not None]
        if there:
            yield from v.missing(v.key(there[0]), *group, code="missing")
    for given_last, first in ((BOOK_MATERIAL[0], SI_MATERIAL[0]), ("lambda_", "end_condition")):
        if v.get(given_last) is not None and v.get(first) is not None:
            yield v.wrong(given_last, _("{other} gives the same already"), "inconsistent", other=v.key(first))
    if all(v.get(name, 0.0) is None for name in ("length", SI_MATERIAL[0], BOOK_MATERIAL[0])):
        yield v.wrong("length", _("missing; give a shaft, or the material of the constant"), "missing")


def _simple_check(v: Values) -> Problems:
    yield from bores("d_out", "d_in")(v)
    needed = {"exact": ("d_out", "length", "E", "density"), "book": ("d_out", "length")}
    names = needed.get(v.get("method", ""), ("n_reference", "length_ratio"))
    for name in names if "method" in v else ():
        if name in v and v[name] is None:
            yield v.wrong(name, _("missing; the method {method} needs it"), "missing", method=v.method)


LENGTH = positive("length_m", "length between the ends")
OUTER = positive("outer_diameter_m", "outer diameter")
INNER = at_least_zero("inner_diameter_m", "inner diameter; 0 for a full shaft", default=0.0)
YOUNGS = positive("E_Pa", "Young's modulus")
DENSITY = positive("density_kg_m3", "density")
MILLIMETRES = (
    positive("length_mm", "length"),
    positive("d_out_mm", "outer diameter"),
    at_least_zero("d_in_mm", "inner diameter; 0 for a full shaft", default=0.0),
    positive("E_GPa", "Young's modulus"),
    DENSITY,
)
SPEED = "n_critical_rpm: first critical speed as computed"
ACTUAL = "n_critical_actual_rpm: that of the real shaft"
SPEEDS = "omega_rad_s: angular speeds, lowest first"
WEAR = positive(
    "k_n", "real over computed critical speed: 0.9-0.95 new, 0.7-0.8 with a worn spline", high=1.0, default=1.0
)


def _ends(key: str, default: str | None) -> Given:
    return word(key, "how the ends are held", *ENDS, default=default)


@formula(
    "critical speeds of a uniform shaft in bending, without shear and rotary inertia",
    "Kozhevnikov & Perfil'ev (1978), eq. 253–256",
    _ends("end_condition", "pinned-pinned"),
    (LENGTH, OUTER, INNER, YOUNGS, DENSITY, mode_count(3)),
    "lambda_: roots of the frequency equation",
    SPEEDS,
    "speed_rpm: critical speeds, lowest first",
    check=bores("outer_diameter", "inner_diameter"),
)
def _critical_speed_closed_form(v: Values) -> Any:
    ends, modes = v.end_condition, v.modes
    sizes = (v[name] for name in ("length", "outer_diameter", "inner_diameter", "E", "density"))
    speed = uniform_speed(*sizes, ends=ends, modes=modes)
    return end_roots(ends, modes), speed, speed


@formula(
    "critical speed of a shaft between joints by the book's formula, its constant, and the 60 percent rule",
    "Kozhevnikov & Perfil'ev (1978), eq. 257–260",
    replace(LENGTH, default=None),
    replace(OUTER, default=None),
    (INNER, WEAR),
    positive("max_engine_speed_rpm", "engine speed at its maximum power", default=None),
    positive("gear_ratio", "speed of the shaft over that of the engine", default=1.0),
    _ends("end_condition", None),
    positive("lambda_", "first root of the frequency equation for other ends", default=None),
    positive("E_Pa", "Young's modulus; the book's constant for steel without it", default=None),
    positive("density_kg_m3", "density", default=None),
    positive("E_kgf_cm2", "Young's modulus in kgf/cm²", default=None),
    positive("specific_weight_gf_cm3", "specific weight in gf/cm³", default=None),
    positive("g_cm_s2", "acceleration of free fall in cm/s²", None, default=STANDARD),
    gives("K_rpm_m", "constant of the formula, lengths in metres", "angular_speed"),
    gives("K_rpm_cm", "constant of the formula, lengths in centimetres", "angular_speed"),
    "n_crit_rpm: critical speed as computed",
    "n_crit_actual_rpm: that of the real shaft",
    "half_critical_rpm: half the computed critical speed",
    "n_crit_thin_tube_rpm: critical speed by the formula for thin tubes",
    "ratio_calculated_to_engine: computed critical speed over the greatest speed of the shaft",
    gives("rule_60_percent_met", "whether this is 1.6 or more", None),
    check=_book_check,
)
def _critical_speed_book(v: Values) -> Any:
    constant, found = BOOK_CONSTANT, {}
    ratio = None
    if v.E is not None:
        ratio = v.E, v.density
    elif v.E_kgf_cm2 is not None:
        # kgf/cm² over gf/cm³ is a length of 10 m; times free fall, in cm/s² of which 100 are 1 m/s².
        ratio = 10.0 * v.E_kgf_cm2 / v.specific_weight_gf_cm3 * v.g_cm_s2 / 100.0, 1.0
    if ratio is not None:
        constant = float(material_constant(*ratio))
        found = {"K_rpm_m": constant, "K_rpm_cm": 100.0 * constant}
    if v.length is None:
        return found
    long, outer, inner = (v[name] for name in TUBE)
    if v.lambda_ is not None:
        constant *= (v.lambda_ / np.pi) ** 2
    speed = float(tube_speed(long, outer, inner, constant=constant, ends=v.end_condition or "pinned-pinned"))
    found |= {"n_crit_rpm": speed, "n_crit_actual_rpm": v.k_n * speed, "half_critical_rpm": 0.5 * speed}
    if inner and outer - inner <= 0.2 * outer and v.lambda_ is None and v.end_condition is None:
        found["n_crit_thin_tube_rpm"] = float(thin_tube_speed(long, 0.5 * (outer + inner), constant=constant))
    if v.max_engine_speed is not None:
        margin = speed_margin(speed, v.max_engine_speed * v.gear_ratio, wear=v.k_n)
        found["ratio_calculated_to_engine"] = margin.computed_ratio
        found["rule_60_percent_met"] = margin.rule_60_percent
    return found


@formula(
    "first critical speed of a uniform shaft: exactly, by the book's sizes alone, or from a similar shaft",
    "Kozhevnikov & Perfil'ev (1978), eq. 256–260",
    word("method", "way", "exact", "book", "scale", default="exact"),
    *(replace(one, default=None) if one.required else one for one in MILLIMETRES),
    _ends("ends", "pinned-pinned"),
    WEAR,
    positive("n_reference_rpm", "critical speed of a similar shaft", default=None),
    positive("length_ratio", "length over that of the similar shaft", default=None),
    positive("diameter_ratio", "diameters over those of the similar shaft", default=1.0),
    (SPEED, ACTUAL),
    check=_simple_check,
)
def _critical_speed(v: Values) -> Any:
    size = v.length, v.d_out, v.d_in
    if v.method == "scale":
        speed = float(scaled_speed(v.n_reference, v.length_ratio, v.diameter_ratio))
    elif v.method == "book":
        speed = float(tube_speed(*size, ends=v.ends))
    else:
        speed = float(uniform_speed(*size, v.E, v.density, ends=v.ends, modes=1)[0])
    return speed, v.k_n * speed


@formula(
    "how far a drive stays below a critical speed, by the rules of articles and makers",
    "articles (60 percent), makers' catalogues (70 and 65 percent, half-critical band)",
    positive("n_critical_rpm", "critical speed as computed"),
    positive("n_max_rpm", "greatest speed"),
    WEAR,
    word("application", "trade", *CATALOGUE, default="automotive"),
    at_least_zero("operating_rpm", "speeds of running", axes=(0, 1), default=None),
    positive("d_out_mm", "outer diameter, for the longest shaft", default=None),
    at_least_zero("d_in_mm", "inner diameter", default=0.0),
    "ratio: real critical speed over the greatest speed",
    "violated: rules broken: article_1.6, catalogue, supercritical",
    "half_critical_band_rpm: speeds to keep out of, about half the critical speed",
    "half_critical_inside: whether a speed of running lies in it",
    "longest_length_mm: how long a steel shaft between joints may be",
    check=bores("d_out", "d_in"),
)
def _critical_speed_margin(v: Values) -> Any:
    operating = v.operating
    found = speed_margin(
        v.n_critical,
        v.n_max,
        wear=v.k_n,
        application=v.application,
        operating=None if operating is None else tuple(np.atleast_1d(operating).tolist()),
    )
    longest = None
    if v.d_out is not None:
        longest = float(longest_tube(v.n_max, v.d_out, v.d_in, wear=v.k_n))
    return found.ratio, list(found.violated), list(found.band), found.half_inside, longest


THEORIES = ("euler_bernoulli", "timoshenko")
WHIRLS = ("forward_at_speed", "synchronous_forward")


def _sections(segments: list[Values], outer: str, inner: str, *, timoshenko: bool) -> Section:
    """Return the cross sections of the segments of a table."""

    def column(name: str) -> np.ndarray:
        return np.asarray([segment[name] for segment in segments], dtype=float)

    return round_section(
        column(outer), column(inner), column("E"), column("density"), poisson=column("poisson") if timoshenko else None
    )


def _stepped_check(v: Values) -> Problems:
    yield from segment_bores("outer_diameter", "inner_diameter")(v)
    if "segments" not in v or "nodes" not in v:
        return
    nodes, here = v.nodes, v.key("nodes")
    if v.segments and len(nodes) != len(v.segments) + 1:
        text = _("{given} nodes given, {wanted} needed: one more than segments")
        yield Problem(here, text.format(given=len(nodes), wanted=len(v.segments) + 1), "inconsistent")
        return
    for k, node in enumerate(nodes):
        inside = 0 < k < len(nodes) - 1
        if inside and node.get("end") is not None:
            yield v.wrong(f"nodes[{k}].end", _("only the first and the last node are ends"), "inconsistent")
        if not inside and node.get("hinge") and node.get("end") == "fixed":
            text = _("a fixed end holds the slope that a hinge releases")
            yield v.wrong(f"nodes[{k}].hinge", text, "inconsistent")
    pinned = [node for node in nodes if node.get("pinned") or node.get("end") == "pinned"]
    other = [node for node in nodes if node.get("support_stiffness") or node.get("tilt_stiffness")]
    if len(pinned) == 1 and not other and not any(node.get("end") == "fixed" for node in nodes):
        text = _("one support alone lets the shaft pivot; give a second one, or a stiffness")
        yield Problem(here, text, "singular")


def _beam_check(v: Values) -> Problems:
    yield from segment_bores("d_out", "d_in")(v)
    segments = v.get("segments")
    if not segments:
        return
    whole = sum(segment.length for segment in segments)
    text = _("{place:.6g} mm lies beyond the shaft, which is {length:.6g} mm long")
    for table in ("springs", "masses", "supports"):
        for k, row in enumerate(v.get(table, ())):
            if row.x > whole * (1.0 + 1e-9):
                message = text.format(place=1e3 * row.x, length=1e3 * whole)
                yield v.wrong(f"{table}[{k}].x", message, "out_of_range")


PLACE = at_least_zero("x_mm", "place from the start of the shaft")


@formula(
    "critical speeds of a stepped shaft with supports, masses and hinges at its nodes, exactly",
    "transfer matrices of Timoshenko's beam, Wittrick-Williams count",
    word("theory", "with or without shear and rotary inertia", *THEORIES, default=THEORIES[1]),
    word("whirl", "at a given spin, or as fast as it whirls", *WHIRLS, default=WHIRLS[1]),
    given("speed_rad_s", "spin; 0 at rest, negative against the whirl", default=0.0),
    mode_count(3),
    rows(
        "segments",
        "sections from end to end",
        LENGTH,
        OUTER,
        INNER,
        YOUNGS,
        DENSITY,
        at_least_zero("poisson", "Poisson's ratio", below=0.5, default=0.3),
    ),
    rows(
        "nodes",
        "ends of the sections, one more than these",
        word("end", "how an end is held", "pinned", "fixed", "free", default=None),
        flag("pinned", "whether a rigid bearing holds it"),
        flag("hinge", "whether a joint passes no moment there"),
        at_least_zero("support_stiffness_N_per_m", "stiffness of a support", default=0.0),
        at_least_zero("tilt_stiffness_Nm_per_rad", "stiffness against tilting", default=0.0),
        at_least_zero("mass_kg", "mass", default=0.0),
        at_least_zero("diametral_inertia_kgm2", "moment of inertia across", default=0.0),
        at_least_zero("polar_inertia_kgm2", "moment of inertia about the shaft", default=0.0),
    ),
    SPEEDS,
    "rigid_modes: how many of them are zero: motions without bending",
    "lost_modes: modes without a critical speed, for parts with more inertia about than across",
    check=_stepped_check,
)
def _critical_speed_stepped(v: Values) -> Any:
    last = len(v.nodes) - 1
    nodes = [
        Node(
            held=node.pinned or node.end in ("pinned", "fixed"),
            clamped=node.end == "fixed",
            hinge=node.hinge and 0 < k < last,
            stiffness=node.support_stiffness,
            tilt_stiffness=node.tilt_stiffness,
            mass=node.mass,
            diametral_inertia=node.diametral_inertia,
            polar_inertia=node.polar_inertia,
        )
        for k, node in enumerate(v.nodes)
    ]
    segments = v.segments
    found = stepped_speeds(
        [segment.length for segment in segments],
        _sections(segments, "outer_diameter", "inner_diameter", timoshenko=v.theory == "timoshenko"),
        nodes,
        modes=v.modes,
        spin=None if v.whirl == "synchronous_forward" else v.speed,
    )
    return found.speed, found.rigid, found.lost


@formula(
    "first two critical speeds of a stepped shaft with springs, masses and supports anywhere along it",
    "transfer matrices without shear and rotary inertia",
    rows("segments", "sections from end to end", *MILLIMETRES),
    rows("springs", "springs that hold it sideways", PLACE, positive("k_N_per_m", "stiffness"), default=()),
    rows("masses", "yokes, slip parts, bearings", PLACE, at_least_zero("mass_kg", "mass"), default=()),
    rows(
        "supports",
        "rigid supports",
        PLACE,
        word("type", "whether it holds the slope too", "pinned", "fixed", default="pinned"),
        default=(),
    ),
    "n_critical_1_rpm: first critical speed",
    "n_critical_2_rpm: second critical speed",
    check=_beam_check,
)
def _critical_speed_beam(v: Values) -> Any:
    segments = v.segments
    speed = placed_speeds(
        [segment.length for segment in segments],
        _sections(segments, "d_out", "d_in", timoshenko=False),
        springs=[(row.x, row.k) for row in v.springs],
        masses=[(row.x, row.mass) for row in v.masses],
        supports=[(row.x, row.type) for row in v.supports],
    )
    return speed[0], speed[1]
