"""What there is to say of the forces in a mechanism: what drives it, what its pairs carry, what rolls or slips."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Cell, Column, KeyFigure, Remark, Table, Tone, closely
from cardan.answers.quantity import Joined, Quantity, Say, say
from cardan.answers.question import Lacking
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.mechanism.mechanism import PAIRS, Mechanism
from cardan.questions.mobility.mobility import Mobility, mobility
from cardan.questions.mobility.rounded import rounded
from cardan.texts import _, mark, plural
from cardan.units import preferred

from .forces import MechanismForces
from .forces import mechanism_forces as ask
from .motion import peak
from .motion_answer import lacking as motion_lacking
from .transfer import input_of

drawn = later("cardan.questions.mechanism.figure")

__all__ = ["COLUMNS", "answer", "ask", "lacking"]

BEYOND = 100.0
"""A force that is so many times its median over the turn grows beyond bounds near by: a dead point."""

SAFE = 2.0
"""How many times the force that just carries rolling contacts are pressed at least; Litvin (7.2)."""

ROUNDING = 1e-9
"""Share of the largest force or couple below which another one is rounding."""


def lacking(mechanism: Mechanism) -> Lacking:
    """Return what the mechanism file lacks for forces: a link that drives, and something that loads it."""
    some = ("output_torque", "output_force", "loads", "masses")
    inert = mechanism.masses and (mechanism.pace or any(mechanism.gravity))
    loaded = mechanism.loads or mechanism.output_torque or mechanism.output_force or inert
    given = motion_lacking(mechanism)
    if loaded:
        return given
    return (*given, (_pace(mechanism), "gravity") if mechanism.masses else some)


def _pace(mechanism: Mechanism) -> str:
    return "sliding_speed" if mechanism.slides else "speed"


def answer(mechanism: Mechanism, result: MechanismForces, listed: MechanismForces | None = None) -> Answer:
    """Return what there is to say of the forces in a mechanism; listed: at what positions programs are told of them."""
    held = mobility(mechanism)
    slips = [one for one in _slips(result) if one[2] < 1.0]
    return Answer(
        name="forces",
        title=_("Forces"),
        sentence=_sentence(result),
        tone="failed" if slips else "warning" if held.redundant else "plain",
        figures=lambda: drawn().forces_figures(result),
        tables=tuple(_tables(result, held)),
        remarks=(*rounded(mechanism), *_remarks(result, held)),
        keys=tuple(_keys(result)),
        facts=_facts(result, held),
        full=lambda: _trace(listed or result),
    )


def _sentence(result: MechanismForces) -> Say:
    low, high = float(np.nanmin(result.input_torque)), float(np.nanmax(result.input_torque))
    pair = result.mechanism.joints[int(foremost(result.largest))]
    values: dict[str, Any] = {"input": result.mechanism.input_link, "pair": pair.id}
    load = input_of(result.mechanism).load
    values |= {"low": Quantity(low, load), "high": Quantity(high, load)}
    values["force"] = Quantity(float(np.max(result.largest)), "force")
    text = _("{input} needs {low} to {high}; {pair} carries most, up to {force}.")
    if np.isclose(low, high, rtol=1e-6, atol=1e-9):
        text = _("{input} needs {high} all the time; {pair} carries most, up to {force}.")
    return say(text, **values)


def _tables(result: MechanismForces, held: Mobility) -> Iterator[Table]:
    angle, pairs, by = result.position, result.mechanism.joints, input_of(result.mechanism)
    rows = [
        (_("input force") if result.mechanism.slides else _("input torque"), result.input_torque),
        *(
            []
            if result.mechanism.pace is None or not result.mechanism.masses
            else [(_("without inertia"), result.still_torque)]
        ),
    ]
    yield Table(
        name="input",
        records=True,
        columns=(
            Column(key="what", heading=_("drive"), values=[name for name, _values in rows], left=True),
            Column(
                key="least", heading=_("least"), values=[float(np.nanmin(v)) for _name, v in rows], dimension=by.load
            ),
            Column(
                key="largest",
                heading=_("largest"),
                values=[float(np.nanmax(v)) for _name, v in rows],
                dimension=by.load,
            ),
            Column(key="mean", heading=_("mean"), values=[_mean(angle, v) for _name, v in rows], dimension=by.load),
        ),
    )
    forces = float(np.nanmax(result.force))
    couples = max(float(np.nanmax(result.couple)), forces * result.motion.turned.placed.size)
    tight = {one.id for one in held.joints if one.strained}
    yield Table(
        name="pairs",
        records=True,
        columns=(
            Column(key="joint", heading=_("joint"), values=[pair.id for pair in pairs], left=True),
            Column(key="kind", heading=_("kind"), values=[_(PAIRS[pair.type].name) for pair in pairs], left=True),
            Column(
                key="force",
                heading=_("largest force"),
                values=[_told(float(one), forces) for one in result.largest],
                dimension="force",
            ),
            Column(key="force_at", heading=_("at"), values=angle[result.most], dimension=by.place, decimals=0),
            Column(
                key="axial_force",
                heading=_("along its axis ±"),
                values=[
                    _told(peak(_along(result, k)), forces) if pair.axis is not None else None
                    for k, pair in enumerate(pairs)
                ],
                dimension="force",
            ),
            Column(
                key="couple",
                heading=_("largest couple"),
                values=[_told(float(one), couples) for one in np.nanmax(result.couple, axis=0)],
                dimension="torque",
            ),
            *(
                (
                    Column(
                        key="power_loss",
                        heading=_("power loss, mean"),
                        values=[float(one) if one else None for one in np.nanmean(result.loss, axis=0)],
                        dimension="power",
                    ),
                )
                if np.any(result.loss > 0.0) and result.mechanism.pace
                else ()
            ),
            *(
                (
                    Column(
                        key="determinate",
                        heading=_("determinate"),
                        values=[_("shares") if pair.id in tight else _("yes") for pair in pairs],
                    ),
                )
                if tight
                else ()
            ),
        ),
        note=_("Of the first link of each joint on the second, about its point; largest over the input path.")
        if result.mechanism.slides
        else _("Of the first link of each joint on the second, about its point; largest over the input angle."),
    )
    slips = list(_slips(result))
    if slips:
        tones: list[Tone] = [
            "failed" if safe < 1.0 else "warning" if safe < SAFE else "good" for _k, _t, safe, _n in slips
        ]
        yield Table(
            name="rolling",
            title=_("Rolling contacts"),
            records=True,
            columns=(
                Column(key="joint", heading=_("joint"), values=[pairs[k].id for k, _t, _s, _n in slips], left=True),
                Column(
                    key="traction",
                    heading=_("traction, largest"),
                    values=[t for _k, t, _s, _n in slips],
                    dimension="force",
                ),
                Column(
                    key="pressing_needed",
                    heading=_("just carried by"),
                    values=[n for _k, _t, _s, n in slips],
                    dimension="force",
                ),
                Column(
                    key="pressing_force",
                    heading=_("pressed by"),
                    values=[pairs[k].pressing_force for k, *_rest in slips],
                    dimension="force",
                ),
                Column(
                    key="safety",
                    heading=_("safety against slip"),
                    values=[Cell(value=s, tone=tone) for (_k, _t, s, _n), tone in zip(slips, tones, strict=True)],
                    digits=3,
                ),
            ),
            note=_("Pressed with two to three times the force that just carries (Litvin, 7.1 and 7.2)."),
        )


def _along(result: MechanismForces, k: int) -> Array:
    """Return the force along the axis of a pair, array (p,) [N]."""
    axis = result.motion.turned.placed.axis[:, k]
    found: Array = np.sum(result.reaction[:, k, 3:] * axis, axis=-1)
    return found


def _told(value: float, size: float) -> float:
    return 0.0 if value <= ROUNDING * size else value


def _mean(angle: Array, values: Array) -> float | None:
    if len(angle) < 2 or not np.all(np.isfinite(values)):
        return None
    return float(np.trapezoid(values, angle) / (angle[-1] - angle[0]))


def _slips(result: MechanismForces) -> Iterator[tuple[int, float, float, float]]:
    """Yield of each rolling contact that is pressed: its place, largest traction, safety, pressing force needed."""
    for k, pair in result.rolling():
        if pair.traction is not None and pair.pressing_force is not None:
            traction = float(np.nanmax(result.force[:, k]))
            needed = traction / pair.traction
            yield k, traction, pair.pressing_force / needed if needed else float("inf"), needed


def _remarks(result: MechanismForces, held: Mobility) -> Iterator[Remark]:
    mechanism, angle, place = result.mechanism, result.position, input_of(result.mechanism).place
    for k, traction, safe, needed in _slips(result):
        if safe < 1.0:
            pair = mechanism.joints[k]
            force = result.force[:, k]
            where = float(
                angle[int(np.argmax(np.nan_to_num(force) * needed > traction * (pair.pressing_force or 0.0)))]
            )
            text = _(
                "Failed: {link} slips at {pair} from {angle} on: it is to carry {force}, and {limit} is what it can."
            )
            said = say(
                text,
                link=pair.links[1],
                pair=pair.id,
                angle=Quantity(where, place, decimals=0),
                force=Quantity(traction, "force"),
                limit=Quantity((pair.traction or 0.0) * (pair.pressing_force or 0.0), "force"),
            )
            yield Remark(text=said, tone="failed", alarm=True)
    steep = np.nanmax(result.force, axis=1)
    if float(np.nanmax(steep)) > BEYOND * float(np.nanmedian(steep)) > 0.0:
        text = _("Warning: near {angle} the forces grow beyond bounds: it stands close to a dead point.")
        at = Quantity(float(angle[int(np.nanargmax(steep))]), place, decimals=0)
        yield Remark(text=say(text, angle=at), tone="warning", alarm=True)
    if held.redundant:
        text = plural(
            "Warning: {n} constraint is redundant; what joints share counts as shared by least squares, while "
            "stiffness and part errors decide.",
            "Warning: {n} constraints are redundant; what joints share counts as shared by least squares, while "
            "stiffness and part errors decide.",
            held.redundant,
        )
        yield Remark(text=say(text, n=held.redundant), tone="warning")
    missing = np.isnan(result.input_torque)
    if np.any(missing):
        text = _("Warning: at {angle} nothing holds the loads: a dead point; nothing is told there.")
        yield Remark(
            text=say(text, angle=Quantity(float(angle[int(np.argmax(missing))]), place, decimals=0)), tone="warning"
        )
    yield from _rubbing(result)
    if mechanism.masses and mechanism.pace is None:
        text = _("--speed-rpm, or speed_rpm in the file, adds inertia.")
        if mechanism.slides:
            text = _("sliding_speed_m_s in the file adds inertia.")
        yield Remark(text=text, tone="next")
    if not mechanism.masses:
        yield Remark(text=_("Without masses in the file neither weight nor inertia counts."))
    text = _("Checked: power of input, loads and inertia, and the balance of every link, close {size}.")
    yield Remark(text=say(text, size=closely(result.unbalanced)))
    yield Remark(text=_("How it moves:"), command=("cardan", "motion", FILE), tone="next")


def _rubbing(result: MechanismForces) -> Iterator[Remark]:
    """Yield what friction takes, and what of it is not known."""
    if result.efficiency is not None:
        text = _("Friction takes {lost} of what drives it: efficiency {share}, by Coulomb's law in each joint.")
        lost = Quantity(1.0 - result.efficiency, "share")
        yield Remark(text=say(text, lost=lost, share=Quantity(result.efficiency, "share")))
    most = ROUNDING * float(np.nanmax(result.force)) * result.motion.turned.placed.size
    bare = [
        pair.id
        for k, pair in enumerate(result.mechanism.joints)
        if pair.friction
        and pair.kind.turns == "axis"
        and pair.bearing_distance is None
        and peak(_tilting(result, k)) > most
    ]
    if bare:
        text = _("The couple across the pin of {pairs} rubs too: bearing_distance_mm would say how much.")
        yield Remark(text=say(text, pairs=Joined(bare, last=_(" and "))))


def _tilting(result: MechanismForces, k: int) -> Array:
    """Return the couple across the axis of a pair, array (p,) [N·m]."""
    axis = result.motion.turned.placed.axis[:, k]
    couple = result.reaction[:, k, :3]
    found: Array = np.linalg.norm(couple - np.sum(couple * axis, axis=-1, keepdims=True) * axis, axis=-1)
    return found


def _keys(result: MechanismForces) -> Iterator[KeyFigure]:
    if result.efficiency is not None:
        yield KeyFigure(name="efficiency", title=_("efficiency"), value=Quantity(result.efficiency, "share"))
    if result.mechanism.slides:
        push = Quantity(peak(result.input_torque), "force")
        yield KeyFigure(name="input_force", title=_("largest input force"), value=push)
    else:
        torque = Quantity(peak(result.input_torque), "torque")
        yield KeyFigure(name="input_torque", title=_("largest input torque"), value=torque)
    k = int(foremost(result.largest))
    force = Quantity(float(np.max(result.largest)), "force")
    yield KeyFigure(
        name="joint_force", title=_("largest force in a joint"), place=result.mechanism.joints[k].id, value=force
    )


def _facts(result: MechanismForces, held: Mobility) -> dict[str, Any]:
    return {
        "name": result.mechanism.name,
        "speed": Quantity(result.mechanism.pace, input_of(result.mechanism).pace),
        "redundant": held.redundant,
        "efficiency": result.efficiency,
        "residual": result.unbalanced,
    }


def _trace(found: MechanismForces) -> Table:
    """Return input torque and reactions at every position."""
    by = input_of(found.mechanism)
    columns = [
        Column(key=by.key, values=found.position, dimension=by.place),
        Column(key=f"input_{by.load}", values=found.input_torque, dimension=by.load),
        Column(key=f"input_{by.load}_without_inertia", values=found.still_torque, dimension=by.load),
    ]
    if np.any(found.loss > 0.0) and found.mechanism.pace:
        columns.append(Column(key="power_loss", values=np.sum(found.loss, axis=-1), dimension="power"))
    for k, pair in enumerate(found.mechanism.joints):
        name = pair.id.replace(" ", "_")
        for j, axis in enumerate("xyz"):
            columns.append(Column(key=f"{name}_couple_{axis}", values=found.reaction[:, k, j], dimension="torque"))
        for j, axis in enumerate("xyz"):
            columns.append(Column(key=f"{name}_force_{axis}", values=found.reaction[:, k, 3 + j], dimension="force"))
    return Table(name="forces", columns=columns)


def _told_of(mechanism: Mechanism) -> tuple[OutputColumn, ...]:
    """Return what a sweep may ask of the forces."""
    load = input_of(mechanism).load
    unit = preferred(load)
    text = mark("largest input force") if mechanism.slides else mark("largest input torque")
    return (
        OutputColumn(name=f"input_{load}_{unit}", dimension=load, unit=unit, text=text),
        OutputColumn.of("joint_force_N", mark("largest force in a joint")),
        OutputColumn.of("efficiency_percent", mark("efficiency")),
    )


def _numbers(found: MechanismForces) -> tuple[float, ...]:
    """Return the same in SI; the efficiency is nan where nothing rubs."""
    share = found.efficiency
    return peak(found.input_torque), float(np.max(found.largest)), float("nan") if share is None else share


COLUMNS = (
    SweepQuestion(
        name="forces",
        doc=mark("what drives the mechanism, what its joints carry, and its efficiency"),
        told=_told_of,
        of_result=_numbers,
    ),
)
"""What a sweep may ask of the forces in a mechanism."""
