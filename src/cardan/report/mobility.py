"""Whether the bearings hold the drive just enough: its structure as links and pairs."""

from __future__ import annotations

from cardan.errors import InputError
from cardan.mechanism.pair import PAIRS
from cardan.mechanism.partition import joins, partition
from cardan.questions.mobility.figure import graph_figure
from cardan.questions.mobility.mobility import Mobility, mobility
from cardan.questions.mobility.repair import advice, repairs, strain
from cardan.texts import _, plural

from .balance import checks
from .block import Block, Cell, Column, Page, Picture, Table, Words, key, number, words
from .subject import Subject


def binding(on: Subject) -> Page | None:
    """Return the page of the structure; None where the file does not say how all shafts are held."""
    try:
        found = mobility(on.drive)
    except InputError:
        return None
    if found.parasitic or found.driven == 0:  # a file that leaves bearings out says nothing of binding
        return None
    blocks: list[Block] = [Picture(figure=graph_figure(found)), _counts(found)]
    if found.redundant:
        blocks += [_strained(found), *_cures(found)]
    blocks.append(_checks(found))
    answer = _answer(found)
    return Page(
        name="mobility",
        title=_("How it is held"),
        answer=answer,
        blocks=blocks,
        keys=[key(_("constraints held too often"), float(found.redundant), "", None, str(found.redundant))],
    )


def _answer(found: Mobility) -> str:
    if not found.redundant:
        return _("Its bearings and joints hold it just enough: nothing that is off can strain it.")
    text = plural(
        "It turns, but its bearings and joints hold it {n} time more than it needs: what is off strains it.",
        "It turns, but its bearings and joints hold it {n} times more than it needs: what is off strains it.",
        found.redundant,
    )
    return text.format(n=found.redundant)


def _counts(found: Mobility) -> Table:
    mechanism = found.mechanism
    counted = partition(joins(mechanism), frame=mechanism.frame, input_link=mechanism.input_link)
    more = counted.excess
    rows = [
        (_("counting alone: 6 a link, less what the joints hold"), found.formula, None),
        (_("who is joined to whom"), counted.mobility + more, counted.redundant + more),
        (_("true, with its geometry"), found.mobility, found.redundant),
    ]
    return Table(
        title=_("Motions, and constraints that repeat others"),
        columns=(
            Column(heading=_("told by"), left=True),
            Column(heading=_("motions")),
            Column(heading=_("held too often")),
        ),
        rows=[
            [
                words(name),
                number(str(moves), moves),
                words("–") if too_many is None else number(str(too_many), too_many),
            ]
            for name, moves, too_many in rows
        ],
        note=_("Where the last two differ, axes that meet or are parallel are the cause."),
    )


def _strained(found: Mobility) -> Table:
    return Table(
        title=_("What errors of the parts can load"),
        columns=(
            Column(heading=_("joint"), left=True),
            Column(heading=_("kind"), left=True),
            Column(heading=_("held too often against"), left=True),
        ),
        rows=[
            [Cell(text=one.id), words(_(PAIRS[one.type].name)), words(strain(one))]
            for one in found.joints
            if one.strained
        ],
    )


def _cures(found: Mobility) -> list[Words]:
    said = [
        _("; ").join(advice(change, found.mechanism) for change in repair.changes)
        for repair in repairs(found.mechanism, most=3)
        if not repair.after
    ]
    if not said:
        return [Words(text=_("No bearing of another kind cures it; another joint, or a link more, would."))]
    first = _("It would bind no more if you {what}.").format(what=said[0])
    rest = [_("Or: {what}.").format(what=what) for what in said[1:]]
    return [Words(text=" ".join([first, *rest]))]


def _checks(found: Mobility) -> Table:
    off = abs(found.mobility - found.loop_mobility) + abs(found.redundant - found.loop_redundant)
    how = _("motions and redundant constraints from the loops instead of the joints, difference")
    return checks([(_("rank"), how, float(off), 0.0)])
