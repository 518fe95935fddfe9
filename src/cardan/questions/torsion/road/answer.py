"""What there is to say of torsional vibration along a movement: resonance, growth, reversals, the largest torque."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.movement import Random
from cardan.errors import refuse
from cardan.later import later
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.model.answer import assumptions, counted_to_first_order, left_out
from cardan.questions.torsion.model.answer import lacking as lacking_modes
from cardan.texts import _, mark
from cardan.units import hour

from .road import MULTIPLE, NEAR, SLOW, STRONG, RoadTorsion, road_torsion

drawn = later("cardan.questions.torsion.road.figure")

__all__ = ["COLUMNS", "answer", "ask", "lacking"]

LONGER = 0.02
"""Share of its length by which a shaft may telescope without a word."""


RARE = 1e-6
"""Share of the time below which a movement by its distribution is not told how seldom it is unstable."""

SEEN = 5e-3
"""Share of the largest order below which another one is not shown to people."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for torsional vibration along its movement."""
    return (
        *lacking_modes(drive),
        *absent((bool(drive.movements), "movements"), (bool(drive.duty.speed), "duty.speed")),
    )


def ask(drive: Drive, *, progress: Callable[[float], object] | None = None) -> RoadTorsion:
    """Return the torsional vibration of a drive along its movements."""
    return road_torsion(drive, progress=progress)


def answer(drive: Drive, result: RoadTorsion) -> Answer:
    """Return what there is to say of torsional vibration along a movement."""
    known = bool(result.places.found.any())
    tone = _tone(result) if known else "failed"
    return Answer(
        name="road",
        title=_("Torsion along the movement"),
        sentence=_sentence(result) if known else _("no steady motion was found anywhere on the movement."),
        tone=tone,
        figures=lambda: drawn().road_figures(result) if known else (),
        tables=(_elements(result), _orders(result), *_damages(result)) if known else (),
        remarks=tuple(_remarks(drive, result)),
        keys=tuple(_keys(result)) if known else (),
        facts=_facts(result),
        full=lambda: _course(result),
        code=1 if tone == "failed" else 0,
    )


def _tone(found: RoadTorsion) -> Tone:
    if found.mean_growth > 0.0:
        return "failed"
    if found.unstable >= RARE or found.resonance > 0.0 or np.any(_rattling(found)):
        return "warning"
    return "good"


def _rattling(found: RoadTorsion) -> Any:
    """Return which elements of the line have a mean torque that they turn about, array of bool (E,)."""
    loaded = np.abs(found.standing.averaged(found.standing.mean)) > 1e-6 * found.nominal
    inside = np.zeros(len(loaded), dtype=bool)
    inside[found.line] = True
    return (found.reversals > 0.0) & loaded & inside


def _torque(value: float) -> Quantity:
    return Quantity(float(value), "torque", 3)


def _share(value: float) -> Quantity:
    return Quantity(float(value), "share", 3)


def _time(value: float) -> Quantity:
    return Quantity(float(value), "time", 3)


def _sentence(found: RoadTorsion) -> Text:
    torque, e, time = found.peak
    names = {"torque": _torque(torque), "element": found.train.elements[e], "span": _time(found.span)}
    if math.isfinite(time):
        said = say(
            _("over {span} of the movement the torque reaches {torque} in {element}, at {time}"),
            time=_time(time),
            **names,
        )
    else:
        said = say(_("once in {span} on average the torque in {element} reaches {torque}"), **names)
    parts: list[Text] = [said]
    if math.isfinite(found.resonance):
        parts.append(say(_("in resonance {share} of the time"), share=_share(found.resonance)))
    if 0.0 < found.unstable < RARE and found.mean_growth <= 0.0:
        parts.append(say(_("unstable less than {share} of the time"), share=Quantity(RARE, "share", trim=True)))
    elif found.unstable:
        text = _("unstable {share} of the time, and growing on the whole")
        if found.mean_growth <= 0.0:
            text = _("unstable {share} of the time, and decaying on the whole")
        parts.append(say(text, share=_share(found.unstable)))
    else:
        parts.append(_("stable throughout"))
    return Joined([Joined(parts, between="; "), "."], between="")


def _elements(found: RoadTorsion) -> Table:
    """Return torques and reversals of every element of the line."""
    line, places = found.line, found.places
    low, high = (one[line] for one in found.extremes)
    names = [found.train.elements[e] for e in line]
    return Table(
        name="elements",
        title=_("Torques along the movement"),
        records=True,
        columns=(
            Column(key="element", heading=_("element"), values=names, left=True),
            Column(
                key="mean", heading=_("mean"), values=places.averaged(places.mean)[line], dimension="torque", digits=3
            ),
            Column(key="min", heading=_("lowest"), values=low, dimension="torque", digits=3),
            Column(key="max", heading=_("highest"), values=high, dimension="torque", digits=3),
            Column(key="above", heading=_("above {n} × mean").format(n=f"{MULTIPLE:g}"), values=found.above[line],
                   dimension="share", digits=3),
            Column(key="reversals_per_hour", heading=_("reversals per hour"), values=hour * found.reversals[line],
                   digits=3),
            Column(key="entries_per_hour", heading=_("spells with reversals per hour"),
                   values=hour * found.entries[line], digits=3),
        ),
        note=""
        if found.chance is None
        else say(_("Lowest and highest: passed once in {span} on average."), span=_time(found.span)),
    )  # fmt: skip


def _orders(found: RoadTorsion) -> Table:
    """Return the envelope of the spectrum of the torque, and of each order how strong it is on the mean."""
    places, line = found.standing, found.line
    amplitude, envelope = places.amplitude, found.envelope[line]
    assert amplitude is not None
    power = np.sqrt(places.averaged(amplitude[:, line] ** 2))
    worst = np.argmax(envelope, axis=0)
    rows = [k for k in range(len(found.order)) if np.max(envelope[:, k]) > SEEN * np.max(envelope)]
    top = [envelope[worst[k], k] for k in rows]
    when = [_when(found, line[worst[k]], k) for k in rows]
    instants = (
        [] if places.times is None else [Column(key="time", heading=_("at"), values=when, dimension="time", digits=3)]
    )
    return Table(
        name="orders",
        title=_("Envelope of the torque spectrum: amplitudes of the orders"),
        records=True,
        columns=(
            Column(key="order", heading=_("order"), values=[Quantity(float(found.order[k]), trim=True) for k in rows]),
            Column(key="largest", heading=_("± largest"), values=top, dimension="torque", digits=3),
            Column(key="rms", heading=_("± r.m.s. over the time"), values=[power[worst[k], k] for k in rows],
                   dimension="torque", digits=3),
            *instants,
            Column(key="element", heading=_("element"), values=[found.train.elements[line[worst[k]]] for k in rows],
                   left=True),
        ),
    )  # fmt: skip


def _when(found: RoadTorsion, e: int, k: int) -> float:
    places = found.standing
    if places.times is None or places.amplitude is None:
        return math.nan
    return float(places.times[int(np.nanargmax(places.amplitude[:, e, k]))])


def _damages(found: RoadTorsion) -> Iterator[Table]:
    """Yield what the torques cost the shafts, where their strength is told."""
    if not found.damage:
        return
    rate = np.asarray([one.rate for one in found.damage])
    with np.errstate(divide="ignore"):
        life = 1.0 / rate
    yield Table(
        name="damage",
        title=_("Fatigue of the shafts along the movement"),
        records=True,
        columns=(
            Column(key="shaft", heading=_("shaft"), values=[one.shaft for one in found.damage]),
            Column(key="damage_per_hour", heading=_("damage per hour"), values=hour * rate, digits=3),
            Column(key="life", heading=_("life"), values=life, dimension="duration", digits=3, most=1e7 * hour),
        ),
        note=_("Palmgren and Miner over the torques of every turn, with secondary couples; a damage of 1 is a crack."),
    )


def _keys(found: RoadTorsion) -> Iterator[KeyFigure]:
    torque, e, time = found.peak
    place: Text = found.train.elements[e]
    if math.isfinite(time):
        place = Joined([place, say(_("at {time}"), time=_time(time))])
    yield KeyFigure(
        name="road_torque", title=_("largest torque along the movement"), value=_torque(torque), place=place
    )
    if math.isfinite(found.resonance):
        yield KeyFigure(name="road_resonance", title=_("share of the time in resonance"), value=_share(found.resonance))
    yield KeyFigure(name="road_unstable", title=_("share of the time unstable"), value=_share(found.unstable))
    rate = float(np.max(found.reversals[found.line]))
    yield KeyFigure(
        name="road_reversals", title=_("reversals of the torque per hour"), value=Quantity(hour * rate, digits=3)
    )


def _remarks(drive: Drive, found: RoadTorsion) -> Iterator[Remark]:
    lost = 1.0 - float(np.sum(found.places.share[found.places.found]))
    if lost > 1e-9:
        text = _("Warning: no steady motion was found in {share} of the time; the shares leave it out.")
        yield Remark(text=say(text, share=_share(lost)), tone="warning")
    if found.unstable:
        text = _("While it is unstable, vibration grows by a factor of {factor} at most; then it decays again.")
        yields = found.mean_growth <= 0.0 and math.isfinite(found.grown)
        if yields:
            factor = Quantity(math.exp(min(found.grown, 700.0)), digits=3, most=1e9)
            yield Remark(text=say(text, factor=factor), tone="warning")
        if found.mean_growth > 0.0:
            text = _("Over the movement vibration grows by itself, {rate} on the mean: the torques told are not kept.")
            yield Remark(text=say(text, rate=Quantity(found.mean_growth, "rate", 3)), tone="failed", alarm=True)
    for order, mode, speed in found.meets:
        text = _(
            "Order {order} meets mode {mode} at {speed}, {away} away: it counts as resonance where it is above "
            "{least} of the mean torque."
        )
        said = say(
            text,
            order=Quantity(order, trim=True),
            mode=mode,
            speed=Quantity(speed, "angular_speed"),
            away=_share(abs(abs(found.speed) / speed - 1.0)),
            least=Quantity(STRONG, "share", trim=True),
        )
        yield Remark(text=said)
    if not found.nominal > 0.0:
        yield Remark(text=_("Without a mean torque nothing tells from which torque on it is a resonance."))
    else:
        text = _(
            "In resonance: the torque is above {multiple} times the largest mean torque, {torque}, or a strong "
            "order is within {near} of a mode."
        )
        values = {"multiple": Quantity(MULTIPLE, trim=True), "torque": _torque(found.nominal)}
        yield Remark(text=say(text, near=Quantity(NEAR, "share", trim=True), **values), depth="full")
    yield from _quickness(found)
    yield from _play(found)
    if any(isinstance(one, Random) for one in drive.movements):
        text = _("The random movements are taken by their distribution, crossings of a torque by Rice's formula.")
        if found.chance is None:
            text = _("The random movements are followed along their sample path.")
        yield Remark(text=text)
    yield _as_drawn(found)
    yield from counted_to_first_order(drive)
    yield from assumptions(found.train, sprung=True)
    yield from left_out(replace(drive, movements=()))
    yield from yokes_estimated(drive)
    text = _("Torques over a turn, at the speed of the duty as drawn:")
    yield Remark(text=text, command=("cardan", "torsion", "response", FILE), tone="next")


def _play(found: RoadTorsion) -> Iterator[Remark]:
    """Yield what backlash does where the torque changes its sign."""
    opened = found.opened
    if opened is None:
        if np.any(_rattling(found)):
            text = _(
                "The torque changes its sign: joints and splines with backlash rattle; backlash counts as closed here."
            )
            yield Remark(text=text, tone="warning")
        return
    largest = opened.largest[:, found.line]
    known = np.flatnonzero(np.isfinite(largest).all(axis=-1))
    count = len(opened.row)
    if not known.size:
        text = _("The torque changes its sign and backlash opens; no steady motion with open backlash was found.")
        yield Remark(text=text, tone="warning")
        return
    k = int(known[np.argmax(np.max(largest[known], axis=-1))])
    text = _(
        "The torque changes its sign and backlash opens: with its play the torque reaches {torque} where it reaches "
        "{closed} with closed backlash (the largest of {count} instants); all else counts with closed backlash."
    )
    closed = float(np.max(found.standing.largest[opened.row[k], found.line]))
    said = say(text, torque=_torque(float(np.max(largest[k]))), closed=_torque(closed), count=count)
    yield Remark(text=said, tone="warning")


def _as_drawn(found: RoadTorsion) -> Remark:
    share, shaft = found.stretched
    if share < LONGER:
        return Remark(text=_("Masses, stiffness and damping are those of the drive as drawn."), depth="full")
    text = _(
        "Masses, stiffness and damping are those of the drive as drawn, although shaft {shaft} becomes up to {share} "
        "longer or shorter."
    )
    return Remark(text=say(text, shaft=shaft, share=_share(share)))


def _quickness(found: RoadTorsion) -> Iterator[Remark]:
    """Yield by what right every instant counts as if the drive stood, or what was done instead."""
    lag = found.lag
    values = {
        "rate": Quantity(lag.rate, "frequency", 3),
        "mode": lag.mode,
        "rest": Quantity(lag.rest, "frequency", 3),
        "share": _share(lag.share),
        "least": Quantity(SLOW, "share", trim=True),
    }
    if lag.share <= SLOW:
        text = _(
            "The movement ({rate}) is slow beside the {rest} at which mode {mode} comes to rest: at every "
            "instant the drive vibrates as if it stood, but for about {share}."
        )
        yield Remark(text=say(text, **values))
    elif not found.why:
        text = _(
            "The movement ({rate}) is quick beside the {rest} at which mode {mode} comes to rest: the torques "
            "are followed in time; orders and stability are those of every instant as if the drive stood."
        )
        yield Remark(text=say(text, **values))
    else:
        text = _(
            "Warning: the movement ({rate}) is quick beside the {rest} at which mode {mode} comes to rest, and "
            "the torques stay behind it; they are told as if the drive stood at every instant, and it was not "
            "followed in time: {why}."
        )
        yield Remark(text=say(text, why=found.why, **values), tone="warning")


def _facts(found: RoadTorsion) -> dict[str, Any]:
    torque, e, time = found.peak
    return {
        "speed": Quantity(abs(found.speed), "angular_speed"),
        "span": Quantity(found.span, "time"),
        "method": "in_time" if found.moving is not None else "distribution" if found.chance is not None else "standing",
        "largest_torque": Quantity(torque, "torque"),
        "largest_torque_element": e + 1,
        "largest_torque_time": Quantity(time, "time"),
        "mean_torque": Quantity(found.nominal, "torque"),
        "resonance": Quantity(found.resonance, "share"),
        "unstable": Quantity(found.unstable, "share"),
        "mean_growth": Quantity(found.mean_growth, "rate"),
        "largest_growth": found.grown,
        "reversals_per_hour": hour * found.reversals,
        "largest_torque_open_backlash": Quantity(
            math.nan if found.opened is None else float(np.max(np.nan_to_num(found.opened.largest[:, found.line]))),
            "torque",
        ),
        "lag": found.lag.share,
        "slow_enough": bool(found.lag.share <= SLOW),
        "why_not_in_time": found.why,
    }


def _course(found: RoadTorsion) -> Table:
    """Return angles and torques of every instant or place."""
    places = found.places
    columns = [] if places.times is None else [Column(key="time", values=places.times, dimension="time")]
    columns += [Column(key="share", values=places.share, dimension="share")]
    for i, angle in enumerate(places.joint_angle.T, start=1):
        columns.append(Column(key=f"joint_{i}_angle", values=angle, dimension="angle"))
    if places.growth is not None:
        columns.append(Column(key="growth_rate", values=places.growth, dimension="rate"))
    for e in range(len(found.train.elements)):
        own = {"mean": places.mean, "min": places.low, "max": places.high}
        columns += [
            Column(key=f"element_{e + 1}_{name}", values=values[:, e], dimension="torque")
            for name, values in own.items()
        ]
    return Table(columns=columns)


def _column_values(found: RoadTorsion) -> tuple[float, float, float, float]:
    if not found.places.found.any():
        raise refuse("movements", _("no steady motion was found"))
    return found.peak[0], found.resonance, found.unstable, hour * float(np.max(found.reversals[found.line]))


COLUMNS = (
    SweepQuestion(
        name="road",
        doc=mark("torsional vibration along the movement: largest torque, time in resonance, unstable time, reversals"),
        told=(
            OutputColumn.of("road_torque_Nm", mark("largest torque along the movement")),
            OutputColumn.of("road_resonance_percent", mark("share of the time in resonance")),
            OutputColumn.of("road_unstable_percent", mark("share of the time unstable")),
            OutputColumn(name="road_reversals_per_hour", text=mark("reversals of the torque per hour")),
        ),
        of_result=_column_values,
        counts=("movement",),
        needs_speed=True,
    ),
)
"""What a sweep may ask of torsional vibration along a movement."""
