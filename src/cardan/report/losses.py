"""Where the drive turns power to heat."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.figures.palette import colour
from cardan.figures.wording import percent, significant
from cardan.questions.losses.figure import heat_figure, heat_parts
from cardan.questions.losses.losses import Losses, losses
from cardan.texts import _

from .balance import ROUNDING, checks, refused
from .block import Block, Cell, Column, Page, Picture, Points, Table, Words, key, number, words
from .lacking import of_losses
from .named import with_key
from .subject import Subject


def rubbing(on: Subject) -> Page | None:
    """Return the page of the losses; None where the file gives no torque, no speed or no friction."""
    if of_losses(on.drive):
        return None
    title = _("Losses")
    try:
        found = losses(on.drive)
    except InputError as error:
        return refused("losses", title, error)
    figure = heat_figure(found, on.drive)
    blocks: list[Block] = []
    if found.locked:
        blocks.append(Words(text=figure.sentence, tone="failed"))
    elif heat_parts(found):
        blocks += [Picture(figure=figure), _table(on.drive, found)]
    if found.uncounted:
        items = [f"{with_key(one.field)}: {one.message}" for one in found.uncounted]
        blocks.append(Points(title=_("Not counted"), items=items))
    if not found.locked:
        blocks.append(_checks(found))
    alarms = [Words(text=figure.sentence, tone="failed")] if found.locked else []
    return Page(
        name="losses", title=title, answer=figure.sentence, blocks=blocks, keys=list(_keys(found)), alarms=alarms
    )


def _keys(found: Losses) -> Iterator[list[Cell]]:
    if found.locked:
        return
    part = words(_("some heat not counted"), "warning") if found.uncounted else words("")
    if found.efficiency > 0.0:
        text = percent(found.efficiency, 4).removesuffix(" %")
        yield key(_("efficiency"), 100.0 * found.efficiency, "%", part, text)
    yield key(_("heat of all parts"), found.heat, "W", part if not found.efficiency > 0.0 else None)


def _table(drive: Drive, found: Losses) -> Table:
    rows = [
        [
            Cell(text=name, chip=colour(role)),
            number(significant(heat), heat),
            number(percent(heat / found.heat).removesuffix(" %"), 100.0 * heat / found.heat),
        ]
        for name, heat, role in heat_parts(found, drive)
    ]
    rows.append([Cell(text=_("all")), number(significant(found.heat), found.heat), number("100", 100.0)])
    return Table(
        title=_("Heat of every part"),
        columns=(
            Column(heading=_("part"), left=True),
            Column(heading=_("mean heat"), unit="W"),
            Column(heading=_("share"), unit="%"),
        ),
        rows=rows,
        note=_(
            "Efficiency {exact}; to first order and for the joints alone {first}, by the rule for small bends {small}."
        ).format(
            exact=percent(found.efficiency, 5), first=percent(found.first_order, 5), small=percent(found.small_angle, 5)
        ),
    )


def _checks(found: Losses) -> Table:
    return checks(
        [
            (
                _("power"),
                _("what enters less what leaves, all heat, resisting torques and inertia, over the larger end"),
                found.residual,
                ROUNDING,
            )
        ]
    )
