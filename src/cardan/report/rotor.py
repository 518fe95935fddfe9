"""How a cracked shaft whirls: only where the file gives a shaft a crack."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.errors import InputError
from cardan.figures.wording import fixed, significant
from cardan.maths.ties import foremost_of
from cardan.questions.bending.figures.rotor import (
    MICRO,
    ORDERS,
    UNIT,
    orbits_figure,
    order_name,
    response_figure,
    sentence,
)
from cardan.questions.bending.rotor_response import RotorResponse, rotor_response
from cardan.texts import _
from cardan.units import rpm

from .balance import checks, refused
from .block import Block, Column, Page, Picture, Table, Words, key, number, words
from .lacking import of_bending
from .subject import Subject

ROUNDING = 1e-6
"""What power and multipliers may miss of their balance."""


def whirling_cracked(on: Subject) -> Page | None:
    """Return the page of a cracked shaft; None where there is no crack, or no bodies or bearings."""
    if not any(shaft.crack for shaft in on.drive.shafts) or of_bending(on.drive):
        return None
    title = _("Cracked shaft")
    try:
        found = rotor_response(on.drive)
    except InputError as error:
        return refused("rotor", title, error)
    alarms = list(_alarms(found))
    blocks: list[Block] = [*alarms, Picture(figure=response_figure(found)), _orders(found)]
    blocks += [Picture(figure=orbits_figure(found)), _checks(found)]
    speed, size = foremost_of((found.peak(order) for order in ORDERS), lambda one: one[1])
    text = _("largest whirling of shaft {number}, at {speed} rpm")
    name = text.format(number=found.rotor.shaft, speed=significant(speed / rpm, 3))
    return Page(
        name="rotor",
        title=title,
        answer=sentence(found),
        blocks=blocks,
        keys=[key(name, size / MICRO, UNIT)],
        alarms=alarms,
    )


def _alarms(found: RotorResponse) -> Iterator[Words]:
    """Yield the speeds in use at which whirling grows by itself."""
    for low, high in found.unstable:
        if found.used is not None and high >= found.used[0] and low <= found.used[1]:
            text = _("Warning: from {low} to {high} rpm whirling grows by itself, whatever the unbalance.")
            said = text.format(low=significant(low / rpm), high=significant(high / rpm))
            yield Words(text=said, tone="failed")


def _orders(found: RotorResponse) -> Table:
    rows = []
    for order in ORDERS:
        speed, size = found.peak(order)
        share = speed / found.rotor.critical
        rows.append(
            [
                words(order_name(order)),
                number(significant(size / MICRO, 3), size / MICRO),
                number(significant(speed / rpm), speed / rpm),
                number(fixed(share, 2), share),
            ]
        )
    xi, eta = (significant(100.0 * loss, 3) for loss in found.rotor.crack.losses)
    note = _("Its crack takes {xi} % of its stiffness along it and {eta} % across it while it is open.")
    return Table(
        title=_("Orders at the speeds in use"),
        columns=(
            Column(heading=_("order"), left=True),
            Column(heading=_("largest"), unit=UNIT),
            Column(heading=_("at"), unit="rpm"),
            Column(heading=_("over the critical speed")),
        ),
        rows=rows,
        note=note.format(xi=xi, eta=eta),
    )


def _checks(found: RotorResponse) -> Table:
    how = _("power of damping against that of unbalance and drive, and the product of the multipliers")
    return checks([(_("whirling"), how, float(np.nanmax(found.steady.residual)), ROUNDING)])
