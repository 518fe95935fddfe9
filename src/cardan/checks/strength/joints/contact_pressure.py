"""The pressure between the most loaded needle and its journal."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.verdict import Verdict
from cardan.formulas.joint_rating import STATIC_PRESSURE, Contact, needle_contact
from cardan.texts import _, mark

from .journal_strength import journal_load
from .needle_static import sizes_of


def lacking(design: Design, i: int) -> tuple[str, ...]:
    """Return what the contact of the needles of a joint lacks."""
    return design.missing(f"joints[{i}].cross.span", f"joints[{i}].cross.journal", *sizes_of(i))


def contact(design: Design, i: int) -> tuple[Contact, str]:
    """Return the contact of the most loaded needle of a joint, counted from 0, and a sentence on what decides it."""
    load, note = journal_load(design, i)
    count, diameter, length = (design.value(path) for path in sizes_of(i))
    return needle_contact(load, count, diameter, length, design.value(f"joints[{i}].cross.journal")), note


def _judge(design: Design, i: int) -> Iterator[Verdict]:
    missing = (*lacking(design, i), *design.unloaded)
    if missing:
        yield Verdict(missing=missing)
        return
    found, note = contact(design, i)
    yield Verdict(
        value=found.pressure,
        limit=STATIC_PRESSURE,
        source=_("Hertz; 4000 MPa stands behind ISO 76"),
        design_variables=(
            f"joints[{i}].cross.span",
            *sizes_of(i),
            f"joints[{i}].cross.journal",
            *design.torque_design_variables,
        ),
        note=note,
    )


CHECK = Check(
    name="contact_pressure",
    doc=mark("pressure of Hertz on the needles of every joint"),
    joint=_judge,
    title=mark("contact pressure of the needles of joint {number}"),
    dimension="stress",
    unit="MPa",
    advice=True,
    power=0.5,
    crosses="each",
    events=True,
)
