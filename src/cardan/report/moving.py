"""Page 5: what movement does to the drive."""

from __future__ import annotations

import numpy as np

from cardan.figures.wording import fixed, percent, significant
from cardan.questions.motion.articulation import Articulation
from cardan.questions.motion.figures.articulation import articulation_figures
from cardan.texts import _
from cardan.units import deg, mm

from .block import Block, Cell, Column, Page, Picture, Table, number, of_shaft, words
from .subject import Subject


def moving(on: Subject) -> Page:
    """Return the page of the movement; the drive has one."""
    found = on.moving
    assert found is not None
    figures = articulation_figures(found)
    blocks: list[Block] = [Picture(figure=figure) for figure in figures]
    blocks.append(_worst(found))
    if found.splines:
        blocks.append(_sliding(found, posed=bool(on.drive.poses)))
    return Page(name="articulation", title=_("Articulation"), answer=figures[0].sentence, blocks=blocks)


def _worst(found: Articulation) -> Table:
    names = {
        "bend": _("bend of joint {number}"),
        "irregularity": _("irregularity of the output if it stopped there"),
        "moving_irregularity": _("irregularity of the output while moving"),
        "speed_error": _("speed error of the output"),
        "acceleration": _("acceleration of the output"),
        "length_max": _("longest shaft {number}"),
        "length_min": _("shortest shaft {number}"),
    }
    rows: list[list[Cell]] = []
    for one in found.worst:
        if one.what == "bend":
            cell, unit = number(fixed(one.value / deg), one.value / deg), "°"
        elif one.what.startswith("length"):
            cell, unit = number(fixed(one.value / mm, 1), one.value / mm), "mm"
        elif one.what == "acceleration":
            cell, unit = number(significant(one.value), one.value), "rad/s²"
        else:
            cell, unit = number(percent(one.value).removesuffix(" %"), 100.0 * one.value), "%"
        name = names.get(one.what, one.what).format(number=one.number)
        rows.append([words(name), cell, words(unit), number(significant(one.time, 3), one.time)])
    return Table(
        title=_("Worst instants"),
        columns=(
            Column(heading=_("what"), left=True),
            Column(heading=_("value")),
            Column(heading="", left=True),
            Column(heading=_("at"), unit="s"),
        ),
        rows=rows,
    )


def _sliding(found: Articulation, *, posed: bool) -> Table:
    def length(value: float | None, flagged: bool) -> Cell:
        if value is None:
            return words("–")
        return number(fixed(value / mm, 1), value / mm, "failed" if flagged else "plain")

    rows = [
        [
            of_shaft(one.shaft),
            length(one.length_min, False),
            length(one.length_max, False),
            length(one.stroke, False),
            number(significant(one.max_rate / mm, 3), one.max_rate / mm),
            number(significant(one.max_acceleration, 3), one.max_acceleration),
            length(one.slip_path, False),
            length(one.engaged_min, any(flag.field.endswith("engaged") for flag in one.flags)),
            length(one.gap_min, any(flag.field.endswith("gap") for flag in one.flags)),
        ]
        for one in found.splines
    ]
    heads = (
        (_("shortest"), "mm"),
        (_("longest"), "mm"),
        (_("stroke"), "mm"),
        (_("top speed"), "mm/s"),
        (_("acceleration"), "m/s²"),
        (_("slip path"), "mm"),
        (_("engaged, least"), "mm"),
        (_("gap, least"), "mm"),
    )
    note = _("Over the {span} s looked at; the slip path is the whole way back and forth.").format(
        span=significant(float(np.ptp(found.times)), 3)
    )
    if posed:
        note += " " + _("The movement starts from the drive as drawn; its poses are judged with the limits.")
    return Table(
        title=_("Sliding shafts"),
        columns=(Column(heading=_("shaft"), left=True), *(Column(heading=name, unit=unit) for name, unit in heads)),
        rows=rows,
        note=note,
    )
