"""Which types and sizes of joints would do the work of the drive's, and why the others would not."""

from __future__ import annotations

import math
from collections.abc import Sequence

from cardan.choices.selection import Candidate, Need, select_joint
from cardan.choices.selection_reasons import SizeFit, fitting_sizes, need_of, reasons
from cardan.errors import InputError
from cardan.figures.wording import significant
from cardan.texts import _, plural
from cardan.units import deg, mm, rpm

from .block import Block, Cell, Column, Page, Table, Tone, Words, number, words
from .lacking import Lacking, named
from .subject import Subject

TONES: dict[str, Tone] = {"ok": "good", "conditional": "warning", "rejected": "failed"}


def choosing(on: Subject, joint: int | None = None) -> Page | None:
    """Return the page of what could be taken; None where the file says no torque or no speed.

    Parameters
    ----------
    on : Subject
        The drive.
    joint : int, optional
        Number of the joint to choose; what does the work of all of them when not given.
    """
    if of_selection(on):
        return None
    need = need_of(on.drive, joint=joint, known=on.known)
    found = select_joint(need, known=on.known)
    sizes = fitting_sizes(need, known=on.known)
    blocks: list[Block] = [_types(found, need)]
    if sizes:
        blocks.append(_sizes(sizes))
    if any(one.fits and one.row.confidence == "made_up" for one in sizes):
        text = _("The shipped sizes are made up for examples; a maker's own rows come with a catalogue file.")
        blocks.append(Words(text=text, tone="warning"))
    return Page(name="selection", title=_("Choice of joints"), answer=_answer(need, found), blocks=blocks)


def of_selection(on: Subject) -> Lacking:
    """Return what the choice lacks."""
    try:
        need_of(on.drive, known=on.known)
    except InputError as error:
        return named([one.field for one in error.problems])
    return ()


def _answer(need: Need, found: Sequence[Candidate]) -> str:
    accepted = sum(one.state == "ok" for one in found)
    under = sum(one.state == "conditional" for one in found)
    work = _("{torque} N·m at {bend}° and {speed} rpm").format(
        torque=significant(need.torque * need.service_factor),
        bend=significant(need.bend / deg, 3),
        speed=significant(need.speed / rpm),
    )
    done = plural("one type of joint does it", "{count} types of joints do it", accepted).format(count=accepted)
    if not accepted:
        done = _("no type of joint does it without conditions")
    more = plural("one more under conditions", "{count} more under conditions", under).format(count=under)
    if not under:
        more = _("none under conditions")
    return _("{work}: {done}, {more}.").format(work=work, done=done, more=more)


def _types(found: Sequence[Candidate], need: Need) -> Table:
    said = {"ok": _("accepted"), "conditional": _("with conditions"), "rejected": _("rejected")}
    rows = [
        [
            words(one.row.name or one.row.id),
            words(said[one.state], TONES[one.state]),
            _room(one.headroom),
            words("; ".join(reason.message for reason in reasons(one, need))),
            words(one.row.source),
        ]
        for one in found
    ]
    return Table(
        title=_("Types of joints"),
        columns=(
            Column(heading=_("type"), left=True),
            Column(heading=_("verdict"), left=True),
            Column(heading=_("its torque over that needed")),
            Column(heading=_("why"), left=True),
            Column(heading=_("source"), left=True),
        ),
        rows=rows,
        note=_("A figure that the source of a type does not give is a condition: look it up at the maker's."),
    )


def _sizes(sizes: Sequence[SizeFit]) -> Table:
    rows = [
        [
            words(one.row.id),
            words(_("fits") if one.fits else _("too small"), "good" if one.fits else "failed"),
            _size(None if one.row.rating is None else one.row.rating.outer, mm),
            _size(one.row.mass, 1.0),
            _room(one.headroom),
            words("; ".join(reason.message for reason in one.reasons)),
        ]
        for one in sizes
    ]
    return Table(
        title=_("Sizes of the catalogue by their makers' ratings"),
        columns=(
            Column(heading=_("size"), left=True),
            Column(heading=_("verdict"), left=True),
            Column(heading=_("outer diameter"), unit="mm"),
            Column(heading=_("mass"), unit="kg"),
            Column(heading=_("its torque over that needed")),
            Column(heading=_("why"), left=True),
        ),
        rows=rows,
    )


def _size(value: float | None, unit: float) -> Cell:
    return words("–") if value is None else number(significant(value / unit), value / unit)


def _room(value: float) -> Cell:
    return words("–") if math.isnan(value) else number(significant(value, 3), value)
