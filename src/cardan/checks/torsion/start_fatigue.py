"""Whether every shaft lasts through the starts of its life, by the damage of each and of running between them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.quantity import Joined, Quantity, say
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.event_loads import event_name, followed, plays
from cardan.checks.strength.section import sections
from cardan.checks.strength.shaft_life import (
    STRENGTHS,
    fatigue_life,
    fatigue_used,
    fatigue_variables,
    start_damage,
)
from cardan.checks.verdict import Verdict
from cardan.drive.torsional_layout import has_torsion
from cardan.texts import _, mark

from .line import NO_MODEL


def _judge(design: Design, k: int) -> Iterator[Verdict]:
    found = list(sections(design, k))
    events = design.events
    if not events or not found or design.drive.shafts[k].layup is not None:
        return
    strengths = [section.of_material(name) for section in found for name in STRENGTHS]
    lacking = (*design.missing(*strengths), *design.unloaded)
    if not has_torsion(design.drive):
        lacking = (*NO_MODEL, *lacking)
    every = [] if lacking else [followed(design.drive, one) for _k, one, _count in events]
    short = [one for cycles in every if isinstance(cycles, tuple) for one in cycles]
    absent = dict.fromkeys(one.field for one in short if one.code == "missing")
    if lacking or absent:
        yield Verdict(missing=(*lacking, *absent))
        return
    if short:
        yield Verdict(unfit="; ".join(dict.fromkeys(map(str, short))))
        return
    if not any(k in cycles for cycles in every):
        return
    used, lives = fatigue_used(design, k), design.value("duty.life") is not None
    if used is None:
        yield Verdict(missing=("duty.life",))
        return
    notes = [
        say(
            _("{share} of the fatigue life per start, {count} starts")
            if one is None
            else _("{share} per event ({event}), {count} of them"),
            share=Quantity(float(np.max(start_damage(design, k, one))), "share", 3),
            count=Quantity(float(np.max(count)), trim=True),
            event=event_name(one),
        )
        for _k, one, count in events
    ]
    if plays(design.drive):
        notes.append(say(_("with the backlash of joints and splines closed")))
    if not lives and not np.all(np.isinf(fatigue_life(design, k))):
        notes.append(say(_("without running, whose time the file does not give")))
    yield Verdict(
        value=used,
        limit=1.0,
        source=_("starts and events in time, rainflow by ASTM E1049, Palmgren-Miner; S-N line of Shigley chapter 6"),
        design_variables=(
            *fatigue_variables(design, k),
            *(() if design.value("duty.starts") is None else ("duty.starts",)),
            *(f"duty.events[{j}].count" for j in range(len(design.duty.events))),
            *(("duty.life",) if lives else ()),
        ),
        note=Joined(notes, between="; ") if len(notes) > 1 else notes[0],
    )


CHECK = Check(
    name="start_fatigue",
    doc=mark("fatigue damage of every shaft by the starts of its life and by running"),
    shaft=_judge,
    title=mark("fatigue damage of shaft {number} by starts and running"),
    gathers="sum",
)
