"""How long the joints of the drive last, and which part of the duty cycle wears them."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.figures.wording import fixed, percent, significant
from cardan.questions.life.figure import life_figures
from cardan.questions.life.life import METHODS, Life, life
from cardan.texts import _
from cardan.units import deg, rpm

from .balance import refused
from .block import Block, Cell, Column, Page, Picture, Points, Table, Tone, Words, number, words
from .lacking import of_life
from .subject import Subject

HOUR = 3600.0

AMBER = 0.9
"""Share of the life asked for from which it is close."""

SHOWN = 12
"""Parts of a duty cycle in the table."""


def lasting(on: Subject) -> Page | None:
    """Return the page of the life; None where the file asks for none, or says nothing of bearings or of the duty."""
    drive = on.drive
    if of_life(drive):
        return None
    title = _("Life")
    try:
        found = life(drive)
    except InputError as error:
        return refused("life", title, error)
    figures = life_figures(found)
    blocks: list[Block] = [Picture(figure=figure) for figure in figures]
    blocks.append(_joints(drive, found))
    if 1 < len(found.parts) <= SHOWN:
        blocks.append(_parts(found))
    notes = [
        *(f"{one.message}." for one in found.cautions),
        *(f"{one.field}: {one.message}." for one in found.uncounted),
    ]
    if notes:
        blocks.append(Points(title=_("To mind"), items=list(dict.fromkeys(notes))))
    answer = figures[0].sentence
    alarms = [Words(text=answer, tone="failed")] if found.enough is False else []
    return Page(name="life", title=title, answer=answer, blocks=blocks, keys=list(_keys(found)), alarms=alarms)


def _keys(found: Life) -> Iterator[list[Cell]]:
    if not math.isfinite(found.drive):
        return
    name = _("life of joint {number}, the first to fail").format(number=found.governing)
    life_of, asked = found.drive / HOUR, found.demanded
    row = [words(name), number(significant(life_of), life_of), words(_("h"))]
    if asked is None:
        yield [*row, words("–"), words("–"), words("")]
        return
    used = asked / found.drive
    tone: Tone = "failed" if used > 1.0 else "warning" if used >= AMBER else "good"
    said = {"failed": _("too short"), "warning": _("near the limit"), "good": _("passed")}[tone]
    limit = number(f"≥ {significant(asked / HOUR)}", asked / HOUR)
    yield [*row, limit, number(fixed(used), used), words(said, tone)]


def _joints(drive: Drive, found: Life) -> Table:
    lives = {name: found.of(name) for name in METHODS}
    bend, load = found.share @ found.bend, found.equivalent_torque
    force = np.max(found.journal_force, axis=0)
    capacity = found.bearings.capacity
    rated = bool(np.any(np.isfinite(capacity)))
    rows = [
        [
            words(f"{i + 1} {joint.name}".strip()),
            number(fixed(float(bend[i]) / deg), float(bend[i]) / deg),
            _cell(float(load[i])),
            _cell(float(force[i])),
            *([_cell(float(capacity[i]))] if rated else []),
            _cell(float(found.speed_angle[i]) / (rpm * deg)),
            *(_cell(float(lives[name][i]) / HOUR) for name in METHODS),
        ]
        for i, joint in enumerate(drive.joints)
    ]
    text = _(
        "{share} of the joints reach these lives; the factor for shocks is {shock}. Bend is the mean over the time."
    )
    return Table(
        title=_("Joints"),
        columns=(
            Column(heading=_("joint"), left=True),
            Column(heading=_("bend"), unit="°"),
            Column(heading=_("torque that wears as much"), unit="N·m"),
            Column(heading=_("largest load of a journal"), unit="N"),
            *([Column(heading=_("dynamic capacity"), unit="N")] if rated else []),
            Column(heading=_("speed times bend"), unit="rpm·°"),
            Column(heading=_("ISO 281"), unit="h"),
            Column(heading=_("by the mean load"), unit="h"),
            Column(heading=_("maker"), unit="h"),
            Column(heading=_("book"), unit="h"),
        ),
        rows=rows,
        note=text.format(share=percent(found.reliability), shock=fixed(found.shock_factor)),
    )


def _parts(found: Life) -> Table:
    damage = 100.0 * found.damage
    rows = [
        [
            _cell(part.torque),
            _cell(part.speed / rpm),
            number(fixed(100.0 * float(share), 1), 100.0 * float(share)),
            *(number(fixed(float(one), 1), float(one)) for one in damage[k]),
        ]
        for k, (part, share) in enumerate(zip(found.parts, found.share, strict=True))
    ]
    heads = [
        Column(heading=_("damage to joint {number}").format(number=i + 1), unit="%") for i in range(damage.shape[1])
    ]
    return Table(
        title=_("Parts of the duty cycle"),
        columns=(
            Column(heading=_("torque"), unit="N·m"),
            Column(heading=_("speed"), unit="rpm"),
            Column(heading=_("time"), unit="%"),
            *heads,
        ),
        rows=rows,
    )


def _cell(value: float) -> Cell:
    if math.isnan(value):
        return words("–")
    return words("∞") if math.isinf(value) else number(significant(value), value)
