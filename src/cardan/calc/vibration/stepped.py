"""Calculations of stepped shafts: critical speeds with supports, masses and hinges along them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from cardan.book.stepped import Node, placed_speeds, stepped_speeds
from cardan.calc.bores import segment_bores
from cardan.calc.calculation import Calculation, Values, given, gives, rows
from cardan.errors import Problem
from cardan.maths.linear.rotor_beams import Section, round_section
from cardan.texts import _, mark

from .bending import DENSITY, INNER, LENGTH, MILLIMETRES, OUTER, SPEEDS, YOUNGS, length, mode_count

THEORIES = ("euler_bernoulli", "timoshenko")
WHIRLS = ("forward_at_speed", "synchronous_forward")


def _sections(segments: list[Values], outer: str, inner: str, *, timoshenko: bool) -> Section:
    """Return the cross sections of the segments of a table."""

    def column(name: str) -> np.ndarray:
        return np.asarray([segment[name] for segment in segments], dtype=float)

    return round_section(
        column(outer),
        column(inner),
        column("E"),
        column("density"),
        poisson=column("poisson") if timoshenko else None,
    )


def _stepped_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from segment_bores("outer_diameter", "inner_diameter")(values, key)
    if "segments" not in values or "nodes" not in values:
        return
    nodes, here = values["nodes"], key("nodes")
    if values["segments"] and len(nodes) != len(values["segments"]) + 1:
        text = _("{given} nodes given, {wanted} needed: one more than segments")
        yield Problem(here, text.format(given=len(nodes), wanted=len(values["segments"]) + 1), "inconsistent")
        return
    for k, node in enumerate(nodes):
        inside = 0 < k < len(nodes) - 1
        if inside and node.get("end") is not None:
            yield Problem(key(f"nodes[{k}].end"), _("only the first and the last node are ends"), "inconsistent")
        if not inside and node.get("hinge") and node.get("end") == "fixed":
            text = _("a fixed end holds the slope that a hinge releases")
            yield Problem(key(f"nodes[{k}].hinge"), text, "inconsistent")
    pinned = [node for node in nodes if node.get("pinned") or node.get("end") == "pinned"]
    other = [node for node in nodes if node.get("support_stiffness") or node.get("tilt_stiffness")]
    if len(pinned) == 1 and not other and not any(node.get("end") == "fixed" for node in nodes):
        text = _("one support alone lets the shaft pivot; give a second one, or a stiffness")
        yield Problem(here, text, "singular")


def _stepped(values: Values) -> Values:
    last = len(values["nodes"]) - 1
    nodes = [
        Node(
            held=node["pinned"] or node["end"] in ("pinned", "fixed"),
            clamped=node["end"] == "fixed",
            hinge=node["hinge"] and 0 < k < last,
            stiffness=node["support_stiffness"],
            tilt_stiffness=node["tilt_stiffness"],
            mass=node["mass"],
            diametral_inertia=node["diametral_inertia"],
            polar_inertia=node["polar_inertia"],
        )
        for k, node in enumerate(values["nodes"])
    ]
    segments = values["segments"]
    found = stepped_speeds(
        [segment["length"] for segment in segments],
        _sections(segments, "outer_diameter", "inner_diameter", timoshenko=values["theory"] == "timoshenko"),
        nodes,
        modes=values["modes"],
        spin=None if values["whirl"] == "synchronous_forward" else values["speed"],
    )
    return {"omega_rad_s": found.speed, "rigid_modes": found.rigid, "lost_modes": found.lost}


def _beam_check(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    yield from segment_bores("d_out", "d_in")(values, key)
    segments = values.get("segments")
    if not segments:
        return
    whole = sum(segment["length"] for segment in segments)
    text = _("{place:.6g} mm lies beyond the shaft, which is {length:.6g} mm long")
    for table in ("springs", "masses", "supports"):
        for k, row in enumerate(values.get(table, ())):
            if row["x"] > whole * (1.0 + 1e-9):
                message = text.format(place=1e3 * row["x"], length=1e3 * whole)
                yield Problem(key(f"{table}[{k}].x"), message, "out_of_range")


def _beam(values: Values) -> Values:
    segments = values["segments"]
    speed = placed_speeds(
        [segment["length"] for segment in segments],
        _sections(segments, "d_out", "d_in", timoshenko=False),
        springs=[(row["x"], row["k"]) for row in values["springs"]],
        masses=[(row["x"], row["mass"]) for row in values["masses"]],
        supports=[(row["x"], row["type"]) for row in values["supports"]],
    )
    return {"n_critical_1_rpm": speed[0], "n_critical_2_rpm": speed[1]}


PLACE = length("x_mm", mark("place from the start of the shaft"), low=0.0)


CALCULATIONS = (
    Calculation(
        name="critical_speed_stepped",
        doc=mark("critical speeds of a stepped shaft with supports, masses and hinges at its nodes, exactly"),
        source=mark("transfer matrices of Timoshenko's beam, Wittrick-Williams count"),
        takes=(
            given(
                "theory",
                mark("with or without shear and rotary inertia"),
                kind="word",
                choices=THEORIES,
                default=THEORIES[1],
            ),
            given(
                "whirl",
                mark("at a given spin, or as fast as it whirls"),
                kind="word",
                choices=WHIRLS,
                default=WHIRLS[1],
            ),
            given("speed_rad_s", mark("spin; 0 at rest, negative against the whirl"), "angular_speed", default=0.0),
            mode_count(3),
            rows(
                "segments",
                mark("sections from end to end"),
                LENGTH,
                OUTER,
                INNER,
                YOUNGS,
                DENSITY,
                given("poisson", mark("Poisson's ratio"), low=0.0, below=0.5, default=0.3),
            ),
            rows(
                "nodes",
                mark("ends of the sections, one more than these"),
                given(
                    "end", mark("how an end is held"), kind="word", choices=("pinned", "fixed", "free"), default=None
                ),
                given("pinned", mark("whether a rigid bearing holds it"), kind="flag", default=False),
                given("hinge", mark("whether a joint passes no moment there"), kind="flag", default=False),
                given("support_stiffness_N_per_m", mark("stiffness of a support"), "stiffness", low=0.0, default=0.0),
                given(
                    "tilt_stiffness_Nm_per_rad",
                    mark("stiffness against tilting"),
                    "turning_stiffness",
                    low=0.0,
                    default=0.0,
                ),
                given("mass_kg", mark("mass"), "mass", low=0.0, default=0.0),
                given("diametral_inertia_kgm2", mark("moment of inertia across"), "inertia", low=0.0, default=0.0),
                given("polar_inertia_kgm2", mark("moment of inertia about the shaft"), "inertia", low=0.0, default=0.0),
            ),
        ),
        returns=(
            SPEEDS,
            gives("rigid_modes", mark("how many of them are zero: motions without bending")),
            gives("lost_modes", mark("modes without a critical speed, for parts with more inertia about than across")),
        ),
        answer=_stepped,
        check=_stepped_check,
    ),
    Calculation(
        name="critical_speed_beam",
        doc=mark("first two critical speeds of a stepped shaft with springs, masses and supports anywhere along it"),
        source=mark("transfer matrices without shear and rotary inertia"),
        takes=(
            rows("segments", mark("sections from end to end"), *MILLIMETRES),
            rows(
                "springs",
                mark("springs that hold it sideways"),
                PLACE,
                given("k_N_per_m", mark("stiffness"), "stiffness", above=0.0),
                default=(),
            ),
            rows(
                "masses",
                mark("yokes, slip parts, bearings"),
                PLACE,
                given("mass_kg", mark("mass"), "mass", low=0.0),
                default=(),
            ),
            rows(
                "supports",
                mark("rigid supports"),
                PLACE,
                given(
                    "type",
                    mark("whether it holds the slope too"),
                    kind="word",
                    choices=("pinned", "fixed"),
                    default="pinned",
                ),
                default=(),
            ),
        ),
        returns=(
            gives("n_critical_1_rpm", mark("first critical speed"), "angular_speed"),
            gives("n_critical_2_rpm", mark("second critical speed"), "angular_speed"),
        ),
        answer=_beam,
        check=_beam_check,
    ),
)
