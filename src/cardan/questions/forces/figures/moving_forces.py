"""What a drive carries while it moves: what the supports take and what the input needs, turn by turn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.answers.palette import dash_of, shaft
from cardan.answers.quantity import Quantity, say
from cardan.figures.axes import axis, shaft_name, support_dashes, support_name
from cardan.figures.figure import Axis, Curve, Figure, Panel, Row, Rule, Series
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.forces.moving_forces import MovingForces
from cardan.texts import _
from cardan.units import preferred

FEW = 12
"""Fewer turns than this are drawn as they are; more by the largest and least of each."""

NOTHING = 1e-9
"""Share of the largest force below which a force is rounding."""

LEAST = 1e-9
"""Smallest range of an axis of forces or torques."""


def moving_forces_figures(found: MovingForces, names: Sequence[str] = ()) -> tuple[Figure, ...]:
    """Return the figures of the forces over a movement.

    found: of one drive; names: names of the supports, for the legend.
    """
    held = (moving_reactions_figure(found, names),) if found.forces.reaction is not None else ()
    return (*held, moving_torques_figure(found))


def moving_reactions_figure(found: MovingForces, names: Sequence[str] = ()) -> Figure:
    """Return the radial and axial force of every support over the movement.

    found: of one drive with supports; names: names of the supports, for the legend.
    """
    forces = found.forces
    size = found.reaction_size
    top = float(np.max(size))
    axial = np.asarray(forces.axial)
    shafts = forces.support_shaft
    kinds = list(zip(shafts, support_dashes(shafts), strict=True))

    def curves(values: Array, *, labelled: bool, both: bool) -> Iterator[Series]:
        for k, (number, dash) in enumerate(kinds):
            if both and float(np.max(np.abs(values[k]))) <= NOTHING * max(top, LEAST):
                continue
            name = support_name(k + 1, number, names[k] if k < len(names) else "") if labelled else ""
            yield from _course(found, values[k], shaft(number), dash, name, both=both)

    pushed = float(np.max(np.abs(axial))) > NOTHING * max(top, LEAST)
    rows = [
        _row(
            found, curves(np.asarray(forces.radial), labelled=True, both=False), _("Radial force"), "force", not pushed
        )
    ]
    if pushed:
        zero: list[Series] = [Rule(value=0.0, dash="solid", role="faint")]
        series = [*zero, *curves(axial, labelled=False, both=True)]
        rows.append(
            _row(found, series, _("Axial force on the shaft, along the power flow positive"), "force", named=True)
        )
    return Figure(
        name="moving-reactions",
        title=_("What the supports carry while the drive moves"),
        sentence="",
        source=_source(found),
        rows=tuple(rows),
    )


def moving_torques_figure(found: MovingForces) -> Figure:
    """Return torque and secondary couple of every shaft over the movement."""
    torque, couple = np.asarray(found.forces.shaft_torque), np.asarray(found.forces.bending_couple)
    bent = found.extreme(couple)
    worst = int(foremost(bent.high))
    count = len(torque)

    def curves(rows: Array, *, labelled: bool, both: bool) -> list[Series]:
        made: list[Series] = []
        for k in range(1, count + 1):
            name = shaft_name(k, count) if labelled else ""
            made += _course(found, rows[k - 1], shaft(k), dash_of(k), name, both=both)
        return made

    return Figure(
        name="moving-torques",
        title=_("Torque and secondary couple of every shaft while the drive moves"),
        sentence=say(
            _("The secondary couple is largest on shaft {number}, {most} at {time}."),
            number=worst + 1,
            most=Quantity(float(bent.high[worst]), "torque"),
            time=Quantity(float(bent.high_time[worst]), "time", 3),
        ),
        source=_source(found),
        rows=(
            _row(found, curves(torque, labelled=True, both=True), _("Torque that enters each shaft"), "torque"),
            _row(found, curves(couple, labelled=False, both=False), _("Secondary couple, size"), "torque", named=True),
        ),
    )


def _course(found: MovingForces, values: Array, role: str, dash: str, label: str, *, both: bool) -> tuple[Series, ...]:
    """Return a quantity over time: as it is for a few turns, else the largest of every turn, and the least if asked."""
    if found.turn_times.size < FEW:
        return (Curve(x=np.asarray(found.times), y=values, role=role, dash=dash, width=1.4, label=label),)
    low, high = found.each_turn(values)
    upper = Curve(x=found.turn_times, y=high, role=role, dash=dash, width=1.6, label=label)
    return (upper, Curve(x=found.turn_times, y=low, role=role, dash=dash, width=0.9)) if both else (upper,)


def _row(
    found: MovingForces, series: Sequence[Series] | Iterator[Series], label: str, dimension: str, named: bool = False
) -> Row:
    made = tuple(series)
    rows = [item.y for item in made if isinstance(item, Curve)]
    across = axis(_("time"), "s", [np.asarray(found.times)], dimension="time", margin=0.0, least=1e-9)
    if not named:
        across = Axis(low=across.low, high=across.high, ticks=across.ticks, texts=across.texts)
    size = max((float(np.max(np.abs(row))) for row in rows), default=0.0)
    upright = axis(label, preferred(dimension), rows, dimension=dimension, least=max(0.02 * size, LEAST), count=4)
    return Row(panels=(Panel(series=made, x=across, y=upright),), height=1.5)


def _source(found: MovingForces) -> str:
    if found.turn_times.size < FEW:
        return _("Exact at every instant, the movement of the axes counted")
    text = _("Exact at every instant, the movement of the axes counted; bold the largest of every turn, thin the least")
    if found.complete and not found.cancelled:
        return text
    return text + _(", of {some} among {all} turns").format(some=found.turn_times.size, all=f"{found.turns:.0f}")
