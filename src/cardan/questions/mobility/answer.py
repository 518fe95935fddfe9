"""What there is to say of mobility: whether it turns, its redundant constraints, what part errors load, remedies."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Say, Text, Written, say
from cardan.answers.question import Lacking, all_of
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.fields.wording import key_text
from cardan.drive.models.machine_held import balls_of, machines_of
from cardan.errors import InputError, refuse
from cardan.figures.figure import Figure
from cardan.later import later
from cardan.mechanism.counting import Partition, joins, partition
from cardan.mechanism.mechanism import PAIRS, Mechanism
from cardan.mechanism.rounding import exactly
from cardan.mechanism.turning import travel
from cardan.questions.assumed import held_by_machines
from cardan.texts import _, mark, plural

from .constraint_release import Repair, advice, strain, working
from .drive_mechanism import SUPPORT, mechanism_of, support_name
from .finite_mobility import FiniteMobility, MobilityTurn, finite_mobility, mobility_over_turn, reach
from .mobility import JointHold, Mobility, mobility
from .rounded import rounded

drawn = later("cardan.questions.mobility.figure")

__all__ = ["COLUMNS", "Turned", "answer", "ask", "brief", "lacking", "otherwise", "turned"]

SHOWN = 3
"""Remedies that people are told of."""

SPECIAL = 8
"""Special positions that people are told of."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Turned:
    """What a turn of the input shows."""

    positions: MobilityTurn  # mobility at every position
    closure: FiniteMobility | None = None  # how the loops close, of a mechanism that does not turn
    end: float | None = None  # how far its input goes [rad or m], of one with a range that it does not go through


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the mobility."""
    try:
        mobility(drive)
    except InputError as error:
        return all_of([one.field for one in error.problems])
    return ()


def ask(drive: Drive) -> Mobility | None:
    """Return the mobility of a drive; None where its file leaves bearings out."""
    found = mobility(drive)
    return None if found.parasitic else found


def otherwise(drive: Drive) -> str:
    """Return why nothing can be told although nothing is missing."""
    return _(
        "The drive file leaves bearings out: shafts that nothing holds say nothing of redundant constraints; add "
        "supports."
    )


def turned(thing: Drive | Mechanism, progress: Callable[[float], object] | None = None) -> Turned:
    """Return what a turn of the input shows."""
    if isinstance(thing, Drive):
        thing = mechanism_of(thing)
    thing = exactly(thing)
    if not thing.input_link:
        raise refuse("--turn", _("the file names no input_link that could be turned"))

    def half(start: float) -> Callable[[float], object] | None:
        return None if progress is None else lambda share: progress(start + 0.5 * share)

    positions = mobility_over_turn(thing, progress=half(0.0))
    if positions.turns:
        return Turned(positions=positions)
    if positions.whole:
        return Turned(positions=positions, closure=finite_mobility(thing, progress=half(0.5)))
    first = float(positions.position[~positions.reached][np.argmin(np.abs(positions.position[~positions.reached]))])
    low, high = travel(thing)
    asked = high if first > 0.0 else low
    closure = finite_mobility(thing, angle=asked, progress=half(0.5))
    return Turned(positions=positions, closure=closure, end=reach(thing, asked))


def answer(thing: Drive | Mechanism, result: Mobility, around: Turned | None = None) -> Answer:
    """Return what there is to say of the mobility of a drive or of any mechanism. around: over a turn of the input."""
    return _answer(thing, result, working(result.mechanism, most=SHOWN, links=isinstance(thing, Mechanism)), around)


def brief(thing: Drive | Mechanism, result: Mobility) -> Answer:
    """Return the same without the remedies, which take a search."""
    return _answer(thing, result, ())


def _answer(
    thing: Drive | Mechanism, result: Mobility, remedies: Sequence[Repair], around: Turned | None = None
) -> Answer:
    mechanism = result.mechanism
    given = mechanism.input_link
    counted = partition(joins(mechanism), frame=mechanism.frame, input_link=given) if given else None
    return Answer(
        name="mobility",
        title=_("Mobility"),
        sentence=_sentence(result),
        tone=_tone(result, around),
        figures=lambda: _figures(result, around),
        tables=tuple(_tables(result, counted)),
        remarks=tuple(_remarks(thing, result, remedies, around)),
        keys=(
            KeyFigure(
                name="redundant_constraints",
                title=_("redundant constraints"),
                value=Quantity(float(result.redundant), decimals=0),
            ),
        )
        if result.redundant
        else (),
        facts=_facts(thing, result, counted, remedies, around),
        full=lambda: _joints(result, result.joints, links=True),
    )


def _figures(result: Mobility, around: Turned | None) -> tuple[Figure, ...]:
    over = () if around is None else drawn().turn_figures(around.positions)
    closure = () if around is None or around.closure is None else drawn().closure_figures(around.closure)
    return (*drawn().mobility_figures(result), *over, *closure)


def _tone(result: Mobility, around: Turned | None) -> Tone:
    if result.driven == 0 or (around is not None and not around.positions.turns):
        return "failed"
    return "warning" if result.redundant or result.underconstrained else "good"


def _sentence(result: Mobility) -> Say:
    redundant = plural("{n} redundant constraint", "{n} redundant constraints", result.redundant)
    values = {"n": result.mobility, "redundant": say(redundant, n=result.redundant)}
    if result.driven == 0:
        return say(_("locked: its input cannot move; {redundant}."), **values)
    if result.redundant:
        return say(_("mobility {n}, {redundant} (overconstrained): part errors cause internal loads."), **values)
    if result.underconstrained:
        return say(_("mobility {n}, underconstrained; no redundant constraints."), **values)
    return say(_("mobility {n}, no redundant constraints: part errors cause no internal loads."), **values)


def _tables(result: Mobility, counted: Partition | None) -> Iterator[Table]:
    if result.redundant:
        yield _joints(result, [one for one in result.joints if one.strained], links=False)
    rows: list[tuple[str, int | None, int | None]] = [(_("Grübler count"), result.formula, None)]
    if counted is not None:
        more = counted.excess
        rows.append((_("graph of the joints"), counted.mobility + more, counted.redundant + more))
    rows.append((_("rank of the constraints"), result.mobility, result.redundant))
    methods, moves, surplus = zip(*rows, strict=True)
    yield Table(
        columns=(
            Column(key="method", heading=_("method"), values=methods),
            Column(key="mobility", heading=_("mobility"), values=moves),
            Column(key="redundant", heading=_("redundant constraints"), values=surplus),
        ),
        note=_(
            "Grübler: 6 for each link, less what the joints hold. Where graph and rank differ, axes that meet or are "
            "parallel are the cause."
        ),
    )


def _joints(result: Mobility, shown: Sequence[JointHold], *, links: bool) -> Table:
    """Return the table of joints, with the links they join where there is room."""
    between = (Column(key="links", heading=_("between"), values=[" – ".join(one.links) for one in shown]),)
    gap = (
        Column(
            key="misalignment", heading=_("part error"), values=[one.misalignment for one in shown], dimension="length"
        ),
    )
    return Table(
        title=_("What part errors can load"),
        columns=(
            Column(key="joint", heading=_("joint"), values=[one.id for one in shown]),
            Column(key="kind", heading=_("kind"), values=[_(PAIRS[one.type].name) for one in shown]),
            *(between if links else ()),
            *(gap if result.misalignment else ()),
            Column(
                key="strained_by", heading=_("redundant constraint"), values=[strain(one) for one in shown], wrap=True
            ),
        ),
    )


def _remarks(
    thing: Drive | Mechanism, result: Mobility, remedies: Sequence[Repair], around: Turned | None
) -> Iterator[Remark]:
    if isinstance(thing, Drive):
        own = balls_of(thing, pivots=True)
        yield from held_by_machines(tuple(number for number in machines_of(thing) if number - 2 not in own))
        yield from _repeated(thing)
    else:
        yield from rounded(thing)
    if result.misalignment:
        text = _("Warning: as given the parts do not fit: {gap} have to be forced into place.")
        yield Remark(text=say(text, gap=Quantity(result.misalignment, "length", 3)), tone="warning")
    yield from _loose(result)
    if not result.certain:
        text = _("Warning: it stands next to a special position, and the numbers are uncertain: move it a little.")
        yield Remark(text=text, tone="warning")
    yield from _turned(around)
    yield from _remedies(thing, result, remedies)
    if result.agrees:
        text = _("Checked: mobility and redundant constraints counted around the loops are the same.")
        yield Remark(text=text, aside=True)
    else:  # pragma: no cover - never met
        text = _("Failed: the count around the loops disagrees; do not trust these numbers.")
        yield Remark(text=text, tone="failed")
    if around is None and (result.mechanism.input_link or not isinstance(thing, Mechanism)):
        text = _("Over a turn of the input:")
        yield Remark(text=text, command=("cardan", "mobility", FILE, "--turn"), tone="next")


def _repeated(drive: Drive) -> Iterator[Remark]:
    """Yield what parts alike within its joints hold more than once, which the numbers of the drive leave out."""
    for number, joint in enumerate(drive.joints, 1):
        if joint.repeated:
            text = plural(
                "Joint {number} ({kind}) repeats {n} constraint within itself, not counted here: its parts share the "
                "load by play or give.",
                "Joint {number} ({kind}) repeats {n} constraints within itself, not counted here: its parts share the "
                "load by play or give.",
                joint.repeated,
            )
            yield Remark(text=say(text, number=number, kind=joint.in_words(), n=joint.repeated))


def _loose(result: Mobility) -> Iterator[Remark]:
    """Yield what can move and should not."""
    if (result.driven or 0) > 1:
        text = _("Warning: the input has {n} degrees of freedom instead of one: hold it.")
        yield Remark(text=say(text, n=result.driven), tone="warning")
    if result.parasitic:
        text = plural(
            "Warning: {n} motion is left while the input stands still, of {links}: hold it.",
            "Warning: {n} motions are left while the input stands still, of {links}: hold them.",
            result.parasitic,
        )
        yield Remark(text=say(text, n=result.parasitic, links=", ".join(result.adrift)), tone="warning")
    if result.local and result.mechanism.output_link:
        text = plural(
            "{n} motion leaves input and output at rest, as balls and rods do that spin.",
            "{n} motions leave input and output at rest, as balls and rods do that spin.",
            result.local,
        )
        yield Remark(text=say(text, n=result.local))
    elif result.local:
        text = plural(
            "{n} motion leaves the input at rest; name output_link, and it is told whether the output stays too.",
            "{n} motions leave the input at rest; name output_link, and it is told whether the output stays too.",
            result.local,
        )
        yield Remark(text=say(text, n=result.local))


def _place(over: MobilityTurn, value: float) -> Quantity:
    return Quantity(float(value), "length" if over.slides else "angle", decimals=0)


def _turned(around: Turned | None) -> Iterator[Remark]:
    """Yield whether it turns through a whole turn."""
    if around is None:
        return
    over, closure = around.positions, around.closure
    if closure is not None and not closure.closes:
        worst, least = closure.worst, closure.tolerance
        gap, turn = (float(one) if one > least else 0.0 for one in (closure.gap[worst], closure.turn[worst]))
        text = _(
            "Failed: it does not turn through 360°: at {angle} its loops miss each other by {gap} and {turn}, a "
            "clearance that it needs."
        )
        if around.end is not None:
            text = _(
                "Failed: its input reaches an end at {end}, within its range of {low} to {high}: at {angle} its loops "
                "miss each other by {gap} and {turn}."
            )
        said = say(
            text,
            end=_place(over, around.end or 0.0),
            **_range(over),
            angle=_place(over, closure.position[worst]),
            gap=Quantity(gap, "length", 3),
            turn=Quantity(turn, "angle", 3),
        )
        yield Remark(text=said, tone="failed")
    elif len(over.special):
        text = _(
            "Warning: it turns through 360°; in or next to special positions at {angles} more constraints are "
            "redundant."
        )
        if not over.whole:
            text = _(
                "Warning: its input moves over its range of {low} to {high}; in or next to special positions at "
                "{angles} more constraints are redundant."
            )
        places = Joined([_place(over, one) for one in over.special[:SPECIAL]])
        yield Remark(text=say(text, angles=places, **_range(over)), tone="warning")
    else:
        text = _("It turns through 360° with constant mobility.")
        if not over.whole:
            text = _("Its input moves over its range of {low} to {high} with constant mobility.")
        yield Remark(text=say(text, **_range(over)), tone="plain" if over.structural else "good")


def _range(over: MobilityTurn) -> dict[str, Any]:
    low, high = (_place(over, one) for one in (over.position[0], over.position[-1]))
    return {} if over.whole else {"low": low, "high": high}


def _remedies(thing: Drive | Mechanism, result: Mobility, remedies: Sequence[Repair]) -> Iterator[Remark]:
    if not result.redundant:
        return
    if not remedies:
        text = _(
            "No change that was tried removes them and lets it turn all round; a bearing in rubber lowers the forces "
            "but does not take them away."
        )
        yield Remark(text=text)
    for k, repair in enumerate(remedies):
        what = _("; ").join(advice(change, result.mechanism) for change in repair.changes)
        if repair.after:
            text = plural(
                "{what}: {n} redundant constraint is left.", "{what}: {n} redundant constraints are left.", repair.after
            )
            yield Remark(text=say(text, what=what[:1].upper() + what[1:], n=repair.after))
        elif k:
            yield Remark(text=say(_("Or {what}."), what=what))
        else:
            keys = list(_keys(thing, repair))
            told: list[Text] = [what, BRACKET, Joined(keys, last=_(" and ")), BRACKETED] if keys else [what]
            yield Remark(text=say(_("Remedy: {what}."), what=Joined(told, between="")))


BRACKET, BRACKETED = Written(" (", ""), Written(")", "")
"""What stands about keys, for those who are told keys."""


def _keys(thing: Drive | Mechanism, repair: Repair) -> Iterator[Written]:
    """Yield what to write in a drive file for changes of its supports."""
    if not isinstance(thing, Drive):
        return
    number = {support_name(thing, k): k for k in range(len(thing.supports))}
    holds = {kind: kept for kept, kind in SUPPORT.items()}
    for change in repair.changes:
        k = number.get(change.joint)
        if k is None:
            continue
        if not change.after:
            yield key_text(f"supports[{k}]", "", _("{support} omitted").format(support="{key}"))
            continue
        before, after = holds[change.before], holds[change.after]
        for name, was, kept in zip(("radial", "axial", "tilt"), before, after, strict=True):
            if was and not kept:
                yield key_text(f"supports[{k}].{name}", "", "{key} = false")


def _facts(
    thing: Drive | Mechanism,
    result: Mobility,
    counted: Partition | None,
    remedies: Sequence[Repair],
    around: Turned | None,
) -> dict[str, Any]:
    facts: dict[str, Any] = {
        "name": result.mechanism.name,
        "moving_links": result.links,
        "loops": result.loops,
        "sum_constraints": result.constraints,
        "rank": result.rank,
        "mobility": result.mobility,
        "redundant": result.redundant,
        "formula": result.formula,
        "driven": result.driven,
        "local": result.local,
        "parasitic": result.parasitic,
        "adrift": result.adrift,
        "certain": result.certain,
        "checked_by_loops": result.agrees,
        "misalignment": Quantity(result.misalignment, "length"),
        "joints": [
            {
                "joint": one.id,
                "type": one.type,
                "links": one.links,
                "axes": one.axes,
                "turning": one.turning,
                "sliding": one.sliding,
                "strained_by": strain(one) or None,
                "force": Quantity(one.force, "force"),
                "couple": Quantity(one.couple, "torque"),
                "misalignment": Quantity(one.misalignment, "length"),
            }
            for one in result.joints
        ],
        "remedies": [
            {
                "redundant_after": one.after,
                "changes": [
                    {
                        "joint": change.joint,
                        "before": change.before,
                        "after": change.after or None,
                        "advice": advice(change, result.mechanism),
                    }
                    for change in one.changes
                ],
            }
            for one in remedies
        ],
    }
    if isinstance(thing, Drive):
        facts["repeated_within_joints"] = [joint.repeated for joint in thing.joints]
    if counted is not None:
        groups = counted.groups
        facts["by_graph"] = {
            "mobility": counted.mobility + counted.excess,
            "redundant": counted.redundant + counted.excess,
            "overconstrained_links": counted.overconstrained,
            "groups": None if groups is None else [{"links": one.links, "mobility": one.mobility} for one in groups],
        }
    if around is not None:
        over = around.positions
        facts["turn"] = {
            "turns_through": over.turns,
            "redundant_everywhere": over.structural,
            "special": Quantity(np.asarray(over.special), "length" if over.slides else "angle"),
            "path" if over.slides else "angle": Quantity(over.position, "length" if over.slides else "angle"),
            "mobility": over.mobility,
            "redundant": over.redundant,
            "residual": over.residual,
        }
    return facts


COLUMNS = (
    SweepQuestion(
        name="mobility",
        doc=mark("mobility of the drive and its redundant constraints"),
        told=(
            OutputColumn(name="mobility", text=mark("mobility")),
            OutputColumn(name="redundant_constraints", text=mark("redundant constraints")),
        ),
        of_result=lambda found: (float(found.mobility), float(found.redundant)),
    ),
)
"""What a sweep may ask of mobility."""
