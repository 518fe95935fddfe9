"""``cardan mobility``: will it turn, where is it held too often, and what to let go?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural

from .mobility_content import Turned, content
from .options import AsCsv, AsJson, Plot

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.mechanism.mechanism import Mechanism
    from cardan.mechanism.partition import Partition
    from cardan.questions.mobility.mobility import Mobility
    from cardan.questions.mobility.repair import Repair

    from .answer import Answer, Cell, Remark, Table, Tone


def mobility(
    file: Annotated[
        Path,
        typer.Argument(
            metavar="FILE",
            help=_("Drive or mechanism file, TOML or JSON; - reads standard input."),
            show_default=False,
        ),
    ],
    turn: Annotated[
        bool, typer.Option("--turn", help=_("Follow it over a turn of the input."), show_default=False)
    ] = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell whether a drive or mechanism moves as it should, or binds."""
    from .asked import keys_of
    from .progress import watching
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)

    from cardan.questions.mobility.mobility import mobility as question

    thing = _read(file)
    with keys_of(file), watching(_("following a turn")) as progress:
        found = question(thing)
        around = _around(thing, progress) if turn else None
    return show(_answer(thing, file, found, around), json=json, csv=csv, plot=plot)


def _read(path: Path) -> Drive | Mechanism:
    """Return the drive or mechanism of a file, or of standard input when the path is ``-``."""
    from cardan.io import load_either, loads_either

    from .failure import about
    from .source import STDIN, form_of, stdin_text

    name = _("standard input") if path == STDIN else str(path)
    with about(name):
        if path != STDIN:
            return load_either(path)
        text = stdin_text()
        return loads_either(text, form=form_of(path, text), name=name)


def _around(thing: Drive | Mechanism, progress: Any) -> Turned:
    from cardan.errors import refuse
    from cardan.mechanism.mechanism import Mechanism
    from cardan.questions.mobility.finite_mobility import finite_mobility
    from cardan.questions.mobility.mobility_turn import mobility_over_turn

    if isinstance(thing, Mechanism) and not thing.input_link:
        raise refuse("--turn", _("the file names no input_link that could be turned"))
    if not isinstance(thing, Mechanism):
        return Turned(mobility_over_turn(thing, progress=progress), None)
    positions = mobility_over_turn(thing, progress=lambda share: progress(0.5 * share))
    if positions.turns:
        return Turned(positions, None)
    return Turned(positions, finite_mobility(thing, progress=lambda share: progress(0.5 + 0.5 * share)))


def _answer(thing: Drive | Mechanism, file: Path, found: Mobility, around: Turned | None) -> Answer:
    from cardan.mechanism.partition import joins, partition
    from cardan.questions.mobility.repair import repairs

    from .answer import Answer

    mechanism = found.mechanism
    cures = repairs(mechanism)
    given = mechanism.input_link
    counted = partition(joins(mechanism), frame=mechanism.frame, input_link=given) if given else None

    def drawn() -> Any:
        from .asked import figures

        more = [] if around is None else [around.positions, *([around.closure] if around.closure else [])]
        return figures(found, *more)

    def tables() -> Sequence[Table]:
        shown = [_joints(found, strained=True)] if found.redundant else []
        return (*shown, _counts(found, counted))

    return Answer(
        sentence=_sentence(thing, file, found),
        tone=_tone(found, around),
        tables=tables,
        remarks=tuple(_remarks(thing, file, found, cures, around)),
        content=lambda: content(file, found, counted, cures, around),
        csv=lambda: _joints(found, strained=False),
        figure=drawn,
    )


def _tone(found: Mobility, around: Turned | None) -> Tone:
    if found.driven == 0 or (around is not None and not around.positions.turns):
        return "failed"
    return "warning" if found.redundant or found.parasitic else "good"


def _sentence(thing: Drive | Mechanism, file: Path, found: Mobility) -> str:
    from .source import STDIN

    name = thing.name or (_("the mechanism") if file == STDIN else file.stem)
    times = plural("{n} time", "{n} times", found.redundant).format(n=found.redundant)
    if found.driven == 0:
        text = _("{name}: locked; its input cannot move, and it is held {times} too often.")
        return text.format(name=name, times=times)
    moves = plural("{n} motion", "{n} motions", found.mobility).format(n=found.mobility)
    if found.redundant:
        text = _("{name}: it moves ({moves}) but is held {times} too often; errors of its parts strain it.")
        return text.format(name=name, moves=moves, times=times)
    if found.parasitic:
        text = _("{name}: not held enough; {moves} in all, and it does not bind.")
        return text.format(name=name, moves=moves)
    return _("{name}: held just enough ({moves}); it does not bind, however far its parts are off.").format(
        name=name, moves=moves
    )


def _joints(found: Mobility, *, strained: bool) -> Table:
    """Return the table of the joints: those that can be strained, or all."""
    from cardan.mechanism.pair import PAIRS
    from cardan.questions.mobility.repair import strain
    from cardan.units import mm

    from .answer import Column, Table

    shown = [one for one in found.joints if one.strained or not strained]
    columns = {
        "joint": Column(key="joint", heading=_("joint"), left=True),
        "kind": Column(key="kind", heading=_("kind"), left=True),
        "links": Column(key="links", heading=_("between"), left=True),
        "strained_by": Column(key="strained_by", heading=_("held too often against"), left=True, wrap=True),
    }
    cells: dict[str, list[Cell]] = {
        "joint": [one.id for one in shown],
        "kind": [_(PAIRS[one.type].name) for one in shown],
        "links": [" – ".join(one.links) for one in shown],
        "strained_by": [strain(one) for one in shown],
    }
    if found.misfit:
        last = columns.pop("strained_by")
        columns |= {"misfit_mm": Column(key="misfit_mm", heading=_("misfit"), unit=_("mm")), "strained_by": last}
        cells["misfit_mm"] = [one.misfit / mm for one in shown]
    if strained:  # the terminal is narrow, and the file tells what a joint joins
        del columns["links"]
    return Table(columns=tuple(columns.values()), rows=list(zip(*(cells[key] for key in columns), strict=True)))


def _counts(found: Mobility, counted: Partition | None) -> Table:
    from .answer import Column, Table

    rows: list[tuple[str, int | None, int | None]] = [(_("counting alone"), found.formula, None)]
    if counted is not None:
        more = counted.excess
        rows.append((_("who is joined to whom"), counted.mobility + more, counted.redundant + more))
    rows.append((_("true, with its geometry"), found.mobility, found.redundant))
    columns = (
        Column(key="by", heading=_("told by"), left=True),
        Column(key="motions", heading=_("motions")),
        Column(key="redundant", heading=_("held too often")),
    )
    return Table(columns=columns, rows=rows)


def _remarks(
    thing: Drive | Mechanism, file: Path, found: Mobility, cures: Sequence[Repair], around: Turned | None
) -> Iterator[Remark]:
    from cardan.units import mm

    from .answer import Remark, significant

    if found.misfit:
        text = _("As given its parts do not fit: {gap} mm have to be forced into place.")
        yield Remark(text=text.format(gap=significant(found.misfit / mm, 3)), tone="warning")
    yield from _loose(found)
    if not found.certain:
        text = _("It stands next to a special position, and the numbers are uncertain: move it a little.")
        yield Remark(text=text, tone="warning")
    if not found.agrees:  # pragma: no cover - never met
        yield Remark(text=_("The count around the loops disagrees; do not trust these numbers."), tone="failed")
    yield from _turned(around)
    yield from _cure(thing, found, cures)
    if around is None and (found.mechanism.input_link or not _is_mechanism(thing)):
        text = _("Over a turn of the input:")
        yield Remark(text=text, command=("cardan", "mobility", str(file), "--turn"), tone="next")


def _is_mechanism(thing: Drive | Mechanism) -> bool:
    from cardan.mechanism.mechanism import Mechanism

    return isinstance(thing, Mechanism)


def _loose(found: Mobility) -> Iterator[Remark]:
    from .answer import Remark

    links = ", ".join(found.adrift)
    if (found.driven or 0) > 1:
        text = _("The input itself moves in {n} ways, not one: hold it.")
        yield Remark(text=text.format(n=found.driven), tone="warning")
    if found.parasitic:
        text = plural(
            "{n} motion is left while the input stands still, of {links}: hold it.",
            "{n} motions are left while the input stands still, of {links}: hold them.",
            found.parasitic,
        )
        yield Remark(text=text.format(n=found.parasitic, links=links), tone="warning")
    if found.local:
        moves = plural("{n} motion leaves", "{n} motions leave", found.local).format(n=found.local)
        if found.mechanism.output_link:
            text = _("{motions} input and output at rest, as balls and rods do that spin.")
        else:
            text = _("{motions} the input at rest; name output_link, and it is told whether the output stays too.")
        yield Remark(text=text.format(motions=moves))


def _turned(around: Turned | None) -> Iterator[Remark]:
    from cardan.units import deg, mm

    from .answer import Remark, significant

    if around is None:
        return
    over = around.positions
    if around.closure is not None and not around.closure.closes:
        worst = around.closure.worst
        text = _("It does not come round: at {angle:.0f}° its loops miss by {gap} mm and {turn}°, play it would need.")
        text = text.format(
            angle=float(around.closure.angle[worst]) / deg,
            gap=significant(float(around.closure.gap[worst]) / mm, 3),
            turn=significant(float(around.closure.turn[worst]) / deg, 3),
        )
        yield Remark(text=text, tone="failed")
    elif len(over.special):
        listed = ", ".join(f"{float(one) / deg:.0f}°" for one in over.special[:8])
        text = _("It comes round; in or next to a special position at {angles}, where more is held too often.")
        yield Remark(text=text.format(angles=listed), tone="warning")
    else:
        text = _("It comes round, held alike at every angle.")
        yield Remark(text=text, tone="good" if not over.structural else "plain")


def _cure(thing: Drive | Mechanism, found: Mobility, cures: Sequence[Repair]) -> Iterator[Remark]:
    from cardan.questions.mobility.repair import advice

    from .answer import Remark

    if not found.redundant:
        return
    if not cures:
        text = _(
            "No bearing or pin of another kind cures it: add a link, or mount a bearing in rubber, which lowers the "
            "forces but does not take them away."
        )
        yield Remark(text=text)
    for k, repair in enumerate(cures[:3]):
        said = _("; ").join(advice(change, found.mechanism) for change in repair.changes)
        if repair.after:
            text = plural(
                "{what}: held {n} time too often still.", "{what}: held {n} times too often still.", repair.after
            )
        elif k:
            text = _("Or {what}.")
        else:
            text = _("Cure: {what}.")
            keys = _(" and ").join(_keys(thing, repair))
            said += f" ({keys})" if keys else ""
        yield Remark(text=text.format(what=said, n=repair.after), tone="next" if not k else "plain")


def _keys(thing: Drive | Mechanism, repair: Repair) -> Iterator[str]:
    """Yield what to write in a drive file for changes of its supports."""
    from cardan.drive.drive import Drive
    from cardan.questions.mobility.drive_mechanism import SUPPORT, support_name

    if not isinstance(thing, Drive):
        return
    number = {support_name(thing, k): k for k in range(len(thing.supports))}
    holds = {kind: kept for kept, kind in SUPPORT.items()}
    for change in repair.changes:
        k = number.get(change.joint)
        if k is None:
            continue
        if not change.after:
            yield _("{support} taken away").format(support=f"supports[{k}]")
            continue
        before, after = holds[change.before], holds[change.after]
        for name, was, kept in zip(("radial", "axial", "tilt"), before, after, strict=True):
            if was and not kept:
                yield f"supports[{k}].{name} = false"
