"""What the drive carries without load, because it is held too much and its parts do not fit."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.figures.palette import colour, shaft
from cardan.figures.wording import significant
from cardan.maths.ties import foremost
from cardan.questions.forces.assembly import AssemblyForces, Peak, assembly
from cardan.questions.forces.figures.assembly import misfit_figure
from cardan.texts import _
from cardan.units import deg

from .balance import ROUNDING, checks, refused
from .block import Block, Cell, Column, Page, Picture, Table, Words, key, number, words
from .lacking import of_assembly
from .subject import Subject

NOTHING = 1e-9
"""Share of the largest force below which a force is rounding."""

EVEN_WORK = 1e-6
"""Share of the largest torque that its mean over a turn may keep: the curve is a sum of low orders, well sampled."""


def straining(on: Subject) -> Page | None:
    """Return the page of the forces of assembly; None where the file tells neither stiffness nor misalignment."""
    if of_assembly(on.drive):
        return None
    off = any(any(one.offset) for one in on.drive.supports)
    try:
        found = assembly(on.drive)
    except InputError as error:
        # A stiffness alone may be there for the bending of the shafts, in a file that leaves the other bearings out.
        return refused("assembly", _("Assembly"), error) if off else None
    figure = misfit_figure(found, [one.name for one in on.drive.supports])
    loaded = _top(found) > 0.0
    blocks: list[Block] = [Picture(figure=figure), _table(on.drive, found)] if loaded else []
    if found.degree:
        blocks.append(Words(text=_release(on.drive, found), tone="warning" if loaded else "plain"))
    if loaded:
        blocks.append(_checks(found))
    answer = _answer(found) if loaded else figure.sentence
    alarms = [Words(text=answer, tone="warning")] if loaded else []
    keys = list(_keys(found)) if loaded else []
    return Page(name="assembly", title=_("Assembly"), answer=answer, blocks=blocks, keys=keys, alarms=alarms)


def _keys(found: AssemblyForces) -> Iterator[list[Cell]]:
    joint = int(foremost([one.value for one in found.joint_peak]))
    name = _("force of misfit without load, joint {number}").format(number=joint + 1)
    yield key(name, found.joint_peak[joint].value, "N", words(_("binds"), "warning"))


def _answer(found: AssemblyForces) -> str:
    joint = int(foremost([one.value for one in found.joint_peak]))
    support = int(foremost([one.value for one in found.radial_peak]))
    return _(
        "Its parts do not fit: without any load joint {joint} carries up to {most} N, support {support} up to {radial} "
        "N sideways."
    ).format(
        joint=joint + 1,
        most=significant(found.joint_peak[joint].value),
        support=support + 1,
        radial=significant(found.radial_peak[support].value),
    )


def _top(found: AssemblyForces) -> float:
    return max(one.value for one in (*found.radial_peak, *found.axial_peak, *found.joint_peak))


def _release(drive: Drive, found: AssemblyForces) -> str:
    holds = {"radial": _("sideways"), "axial": _("lengthwise"), "tilt": _("against tilting")}
    named = []
    for spare in found.spare:
        place, _dot, hold = spare.partition("].")
        k = int(place.removeprefix("supports["))
        name = drive.supports[k].name
        named.append(f"{k + 1}{f' ({name})' if name else ''} {holds[hold]}")
    text = _("The drive is held by {degree} more than statics needs.").format(degree=found.degree)
    if not named:
        return f"{text} {_('No support can be let go without freeing a shaft.')}"
    more = _("Nothing would strain it if, for instance, these supports did not hold: {names}.")
    if found.kept:
        more = _("Without these holds {kept} would be left: {names}; no other can go without freeing a shaft.")
    return f"{text} {more.format(names=', '.join(named), kept=found.kept)}"


def _table(drive: Drive, found: AssemblyForces) -> Table:
    top = _top(found)
    rows: list[Sequence[Cell]] = [
        [
            Cell(
                text=" ".join(
                    part for part in (_("support {number}").format(number=k + 1), drive.supports[k].name) if part
                ),
                chip=colour(shaft(drive.supports[k].shaft)),
            ),
            *_peak(found.radial_peak[k], top),
            *_peak(found.axial_peak[k], top),
        ]
        for k in range(len(drive.supports))
    ]
    for k, peak in enumerate(found.joint_peak, start=1):
        rows.append(
            [Cell(text=_("joint {number}, in all").format(number=k)), *_peak(peak, top), Cell(text="–"), Cell(text="–")]
        )
    names = ", ".join(map(str, found.rigid))
    return Table(
        title=_("Greatest forces over a turn, without load"),
        columns=(
            Column(heading=_("where"), left=True),
            Column(heading=_("radial force"), unit="N"),
            Column(heading=_("at"), unit="°"),
            Column(heading=_("axial force"), unit="N"),
            Column(heading=_("at"), unit="°"),
        ),
        rows=rows,
        note=_("Taken as rigid, as their outer diameter is not given: shafts {names}.").format(names=names)
        if names
        else "",
    )


def _peak(peak: Peak, top: float) -> list[Cell]:
    if peak.value <= NOTHING * top:
        return [number("0", peak.value), Cell(text="–")]
    return [number(significant(peak.value), peak.value), number(f"{peak.angle / deg:.0f}", peak.angle / deg)]


def _checks(found: AssemblyForces) -> Table:
    rows = [
        (
            _("forces and moments"),
            _("on every shaft and on the whole drive, by plain sums, over the largest force"),
            found.residual,
            ROUNDING,
        )
    ]
    largest = found.torque_peak.value
    turn = np.asarray(found.angle)
    if largest > 0.0 and turn.size > 2 and abs(float(turn[-1] - turn[0]) - 2.0 * np.pi) < 1e-9:
        work = abs(float(np.mean(np.asarray(found.torque)[:-1])))
        rows.append(
            (
                _("work of a turn"),
                _("mean of the torque against the stored energy over a turn, over its largest value"),
                work / largest,
                EVEN_WORK,
            )
        )
    return checks(rows)
