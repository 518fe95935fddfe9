"""Stepped shafts: critical speeds with supports, masses and hinges along them."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.book.stepped import Node, placed_speeds, stepped_speeds
from cardan.calc.bores import segment_bores
from cardan.calc.calculation import Formulas, Problems, Values
from cardan.errors import Problem
from cardan.maths.linear.rotor_beams import Section, round_section
from cardan.reading.given import at_least_zero, flag, given, positive, rows, word
from cardan.texts import _

from .bending import DENSITY, INNER, LENGTH, MILLIMETRES, OUTER, SPEEDS, YOUNGS, mode_count

formula = Formulas(__doc__)


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


PLACE = at_least_zero(
    "x_mm",
    "place from the start of the shaft",
)


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
