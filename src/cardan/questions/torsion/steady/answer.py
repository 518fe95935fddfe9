"""What there is to say of steady torsional vibration: alternating torques at a speed, order by order over many."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, KeyFigure, Remark, Table, Tone, closely
from cardan.answers.quantity import Joined, Quantity, Say, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.machine import Engine
from cardan.errors import refuse
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.assumed import yokes_estimated
from cardan.questions.motion.turning import each_shaft
from cardan.questions.torsion.model.answer import assumptions, counted, left_out, ranges, torques_left_out
from cardan.questions.torsion.model.answer import lacking as lacking_modes
from cardan.questions.torsion.model.excitation import engine_torque
from cardan.questions.torsion.model.torsional_modes import main_order
from cardan.texts import _, mark, plural

from .pendulum_swing import strikes
from .run_stability import Verdict, verdict_words
from .settling import LONGEST
from .several import Beside
from .torsion_response import COUNTED, ROUNDING, TorsionResponse, level, peak_refined, torsion_response

drawn = later("cardan.questions.torsion.steady.figure")

__all__ = ["COLUMNS", "answer", "ask", "lacking", "worst"]

SWEEP = 31
"""Speeds of the sweep over the operating range."""

SLOWEST = 0.05
"""Share of its upper end below which the sweep asks no speed."""

SHOWN = 12
"""Speeds of a sweep that people are shown."""

UNEVEN = 1e-3
"""A speed fluctuation below which yoke angles have little left to take away."""

SMALL = 1e-6
"""Share of the largest torque that a motion may miss its equations by between the points it was found from."""

BESIDE = 0.02
"""Side bands above this share of the alternating torque are named."""

STOPPED = 3
"""Status of a speed at which the work was stopped."""

JOINTS = (2.0, 4.0)
"""Orders of the joints, with a column of their own."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for the orders over its operating range."""
    return (*lacking_modes(drive), *absent((drive.duty.speed_range is not None, "duty.speed_range")))


def ask(drive: Drive, *, progress: Callable[[float], object] | None = None) -> TorsionResponse:
    """Return the steady motions over the operating range of a drive."""
    between = drive.duty.speed_range
    assert between is not None
    low, high = max(between[0], SLOWEST * between[1]), between[1]
    return peak_refined(drive, torsion_response(drive, speed=np.linspace(low, high, SWEEP), progress=progress))


def answer(drive: Drive, result: TorsionResponse) -> Answer:
    """Return what there is to say of steady torsional vibration, at one speed or over many."""
    swept = bool(result.speed.ndim)
    tone, said = _swept(result) if swept else _running(result)
    found = bool(np.any(result.steady.found))
    tables = (_sweep_table(result),) if swept else (_element_table(result), _station_table(result))
    return Answer(
        name="orders" if swept else "torsion-response",
        title=_("Orders over speed") if swept else _("Torques in steady running"),
        sentence=said,
        tone=tone,
        figures=lambda: drawn().response_figures(result) if found else (),
        tables=tables if found else (),
        remarks=tuple(_remarks(drive, result)),
        keys=() if swept or not found else (_key(result),),
        facts=_facts(result),
        full=lambda: _everything(result),
        code=1 if tone == "failed" and not swept else 0,
    )


def _running(found: TorsionResponse) -> tuple[Tone, Text]:
    """Return what the motion at one speed comes to."""
    speed = _speed(found.speed)
    if not bool(found.steady.found):
        return "failed", say(_("no steady motion was found at {speed}."), speed=speed)
    e = int(foremost(found.swing))
    first = say(
        _("at {speed} the alternating torque in {element} is ±{amplitude} about {mean}"),
        speed=speed,
        element=found.train.elements[e],
        mean=_torque(float(_means(found)[e]), 4),
        amplitude=_torque(_alternating(found)),
    )
    tone, more = _state(found)
    return tone, Joined([first, more], between="; ")


def _alternating(found: TorsionResponse) -> float:
    """Return the largest alternating torque [N·m], 0 where it is nothing but rounding beside the mean torques."""
    swing = float(np.max(found.swing))
    return 0.0 if swing <= ROUNDING * float(np.max(np.abs(found.steady.torque.mean))) else swing


def _means(found: TorsionResponse) -> Array:
    """Return the mean torque of every element at one speed, 0 where it is nothing beside its swing, (E,) [N·m]."""
    loaded = found.loaded
    pairs = zip(found.steady.torque.mean, found.swing, strict=True)
    return np.asarray([level(float(mean), float(swing), loaded=loaded) for mean, swing in pairs])


def _state(found: TorsionResponse) -> tuple[Tone, Text]:
    """Return whether the motion at one speed lasts."""
    verdict = int(found.floquet.verdict)
    if verdict == Verdict.UNSTABLE:
        longer = [one.periods for one in found.beside if one.runs]
        if longer:
            text = _("it does not repeat with every {turns} of a turn, {how}.")
            turns = Quantity(found.steady.orbit.period / (2.0 * np.pi), trim=True)
            return "failed", say(text, turns=turns, how=_how(longer[0]))
        text = _("the motion is unstable and grows at a rate of {rate} ({zone}).")
        rate = Quantity(float(found.floquet.growth_rate), "rate", 3)
        return "failed", say(text, rate=rate, zone=found.floquet.zone.name())
    if verdict == Verdict.NEUTRAL:
        return "warning", _("a small disturbance neither grows nor decays.")
    if verdict == Verdict.UNKNOWN:
        return "warning", _("whether a small disturbance decays is not known: dry friction sticks and slips.")
    changing = np.sign(found.torque_lowest) * np.sign(found.torque_highest) < 0.0
    if np.any(changing & (np.abs(_means(found)) > 1e-6 * np.max(np.abs(found.torque_highest)))):
        return "warning", _("stable, but the torque changes its sign: joints and splines with backlash rattle.")
    return "good", _("stable.")


def _loose(found: TorsionResponse) -> Joined | None:
    """Return the orders that do not repeat within two turns, None where there are none."""
    return Joined([_order(one.order) for one in found.apart]) if found.apart else None


def _swept(found: TorsionResponse) -> tuple[Tone, Text]:
    """Return what the motions over many speeds come to."""
    swing = np.where(np.isfinite(found.swing), found.swing, -1.0)
    k, e = np.unravel_index(int(foremost(swing.reshape(-1))), swing.shape)
    if swing[k, e] < 0.0:
        return "failed", _("no steady motion was found.")
    first = say(
        _("of {count} speeds the alternating torque is largest at {speed}, ±{amplitude} in {element}"),
        count=len(found.speed),
        speed=_speed(found.speed[k]),
        amplitude=_torque(float(swing[k, e])),
        element=found.train.elements[int(e)],
    )
    unstable = found.floquet.verdict == Verdict.UNSTABLE
    unsure = (found.floquet.verdict == Verdict.UNKNOWN) & np.asarray(found.steady.found)
    if not np.any(unstable) and np.any(unsure):
        text = _("whether it is stable at {where} is not known: dry friction sticks and slips.")
        where = ranges(np.abs(found.speed), unsure, "angular_speed")
        return "warning", Joined([first, say(text, where=where)], between="; ")
    if not np.any(unstable):
        return "plain", Joined([first, _("stable throughout.")], between="; ")
    where = ranges(np.abs(found.speed), unstable, "angular_speed")
    return "failed", Joined([first, say(_("unstable at {where}."), where=where)], between="; ")


def _speed(value: Any) -> Quantity:
    return Quantity(abs(float(value)), "angular_speed")


def _torque(value: float, digits: int = 3) -> Quantity:
    return Quantity(value, "torque", digits)


def _cleaned(values: Array) -> Array:
    """Return torques of an element (E, ...) with 0 for what is only rounding beside its greatest."""
    table = np.asarray(values, dtype=float)
    most = np.max(np.abs(table), axis=-1, keepdims=True, initial=0.0)
    return np.where(np.abs(table) <= 1e-9 * most, 0.0, table)


def _element_table(found: TorsionResponse) -> Table:
    """Return mean, extremes and orders of the torque of every element."""
    torque, order = found.steady.torque, found.steady.order
    second, fourth = (int(np.flatnonzero(order == one)[0]) for one in JOINTS)
    largest = float(np.max(np.abs(torque.mean)) + np.max(torque.amplitude))
    amplitude = np.where(torque.amplitude > 1e-12 * largest, torque.amplitude, 0.0)
    own = np.stack(
        [_means(found), found.torque_lowest, found.torque_highest, amplitude[:, second], amplitude[:, fourth]], -1
    )
    columns = _cleaned(own).T
    heads = (_("mean"), _("lowest"), _("highest"), _("± order 2"), _("± order 4"))
    return Table(
        title=_("Torques in steady running: mean, extremes, and amplitudes of their orders"),
        columns=(
            Column(key="", heading=_("element"), values=list(found.train.elements), left=True),
            *(
                Column(key="", heading=head, values=values, dimension="torque", digits=3)
                for head, values in zip(heads, columns, strict=True)
            ),
            Column(
                key="",
                heading=_("± other (order)"),
                values=[_other(one, order, largest) for one in amplitude],
                dimension="torque",
            ),
        ),
    )


def _other(amplitude: Array, order: Array, largest: float) -> Say | None:
    """Return the strongest order beside those of the joints."""
    others = np.where(np.isin(order, JOINTS), 0.0, amplitude)
    k = int(foremost(others))
    if not others[k] > 1e-9 * largest:
        return None
    return say("{torque:bare} ({order})", torque=_torque(float(others[k])), order=_order(order[k]))


def _order(order: float) -> Quantity:
    return Quantity(float(order), trim=True)


def _station_table(found: TorsionResponse) -> Table:
    """Return how speed and angle of every station fluctuate."""
    speed, order = found.steady.station_speed, found.steady.order
    mean = abs(float(found.speed))
    top = foremost(speed.amplitude)
    there = np.max(speed.amplitude, axis=-1) > 1e-12 * mean
    second = int(np.flatnonzero(order == 2.0)[0])
    angle = np.where(there, found.steady.angle_amplitude[:, second], 0.0)
    share = np.where(there, np.sum(speed.amplitude, axis=-1) / mean, 0.0)
    strongest = [_order(order[k]) if one else None for k, one in zip(top, there, strict=True)]
    return Table(
        title=_("Fluctuation of the stations, amplitudes"),
        columns=(
            Column(key="", heading=_("station"), values=list(found.train.station_names), left=True),
            Column(key="", heading=_("± speed"), values=share, dimension="share", digits=3),
            Column(key="", heading=_("± angle, order 2"), values=angle, dimension="angle", digits=3),
            Column(key="", heading=_("strongest order"), values=strongest),
        ),
    )


def _sweep_table(found: TorsionResponse) -> Table:
    """Return the worst torque at some speeds."""
    count = len(found.speed)
    worst = [int(foremost(np.where(np.isfinite(one), one, -1.0))) for one in found.swing]
    peak = int(foremost(np.nan_to_num(found.swing[np.arange(count), worst])))
    even = np.linspace(0, count - 1, min(count, SHOWN)).round().astype(int)
    rows = np.unique(np.append(even, peak))
    at = rows, [worst[k] for k in rows]
    second = int(np.flatnonzero(found.steady.order == 2.0)[0])
    names, words = found.train.elements, verdict_words()
    verdict = [int(found.floquet.verdict[k]) for k in rows]
    return Table(
        title=_("Worst torque at some speeds"),
        columns=(
            Column(key="", heading=_("speed"), values=np.abs(found.speed)[rows], dimension="angular_speed"),
            Column(key="", heading=_("lowest"), values=found.torque_lowest[at], dimension="torque", digits=3),
            Column(key="", heading=_("highest"), values=found.torque_highest[at], dimension="torque", digits=3),
            Column(
                key="",
                heading=_("± order 2"),
                values=found.steady.torque.amplitude[(*at, second)],
                dimension="torque",
                digits=3,
            ),
            Column(key="", heading=_("motion"), values=[words[one] for one in verdict], left=True),
            Column(key="", heading=_("worst in"), values=[names[worst[k]] for k in rows], left=True),
        ),
        tones=["failed" if one == Verdict.UNSTABLE else "plain" for one in verdict],
    )


def _remarks(drive: Drive, found: TorsionResponse) -> Iterator[Remark]:
    steady, swept = found.steady, bool(found.speed.ndim)
    if not swept:
        yield from _alarms(found)
    status = np.asarray(steady.status)
    lost = int(np.sum(~np.asarray(steady.found) & (status != STOPPED)))
    if lost and swept:
        text = plural(
            "Warning: no steady motion was found at {count} speed.",
            "Warning: no steady motion was found at {count} speeds.",
            lost,
        )
        yield Remark(text=text.format(count=lost), tone="warning")
    if np.any(status == STOPPED):
        text = _("Warning: stopped; {done} of {all} speeds are done.")
        yield Remark(text=text.format(done=int(np.sum(status != STOPPED)), all=status.size), tone="warning")
    for one in found.apart:
        text = _("Order {order} does not repeat within two turns (non-synchronous): at most ±{torque}{more}.")
        more: Text = "" if np.all(one.exact) else _("; by the straight line where backlash opens, without side bands")
        values = {"order": _order(one.order), "torque": _torque(float(np.max(np.abs(one.torque))))}
        yield Remark(text=say(text, more=more, **values))
    beside = found.side_orders(BESIDE)
    if beside:
        text = _("With the joints it makes the side bands {bands}, which may meet a mode of their own.")
        pair = _("{order} (±{torque})")
        bands = [say(pair, order=_order(order), torque=_torque(size)) for order, size in beside]
        yield Remark(text=say(text, bands=Joined(bands)))
    if np.any(steady.found):
        yield from counted(_loose(found), found.together, COUNTED)
    if any(one.periods == 1 for one in found.beside):
        yield _beside(found)
    if any(one.periods != 1 for one in found.beside):
        yield _longer(found)
    loose = found.train.model.backlash > 0.0
    if found.train.model.free and np.any(loose & (found.torque_lowest < 0.0) & (found.torque_highest > 0.0)):
        text = _("Nothing holds the speed of this drive: beside a motion with open backlash no other ones were sought.")
        yield Remark(text=text)
    if drive.duty.engine is not None and drive.duty.engine.mean_pressure is not None:
        yield _engine(drive.duty.engine, found)
    if found.train.model.free and not swept and bool(steady.found):
        text = _("Beside the torques of the duty the input needs {torque} to keep its speed.")
        yield Remark(text=say(text, torque=_torque(float(steady.drive_torque.mean[0]), 4)))
    if np.any(found.train.model.loss_factor):
        text = _("Structural damping counts as viscous, equal at order {order} of the speed.")
        yield Remark(text=say(text, order=_order(main_order(found.train.model))))
    yield from strikes(found)
    yield from assumptions(found.train, sprung=True)
    if drive.duty.load is not None:  # in place of the torque of every load case
        yield from torques_left_out(drive)
    yield from left_out(drive)
    yield from yokes_estimated(drive)
    if np.any(steady.found):
        yield from _checked(found)
    if _from_yokes(drive, found):
        text = _("Most of it is order 2 of the joints; other yoke angles may take that away:")
        yield Remark(text=text, command=("cardan", "phasing", FILE), tone="next")
    if not swept:
        command = ("cardan", "torsion", "response", FILE, "--speeds", "LOW:HIGH")
        yield Remark(text=_("The same over a range of speeds, in rpm:"), command=command, tone="next")


def _how(periods: int) -> Text:
    """Return after how many periods a motion repeats."""
    if periods:
        return say(_("but every {periods} periods"), periods=periods)
    return say(_("nor within {longest} periods"), longest=LONGEST)


def _longer(found: TorsionResponse) -> Remark:
    """Return which motions repeat after several periods only, or not at all."""
    longer = [one for one in found.beside if one.periods != 1]
    swings: list[Text] = []
    for periods in sorted({one.periods for one in longer}, reverse=True):
        own = [one for one in longer if one.periods == periods]
        text = _("one that repeats every {periods} periods (up to ±{torque}{where})")
        if not periods:
            text = _("one that does not repeat within {longest} periods (up to ±{torque} over a long run{where})")
        where: Text = ""
        if found.speed.ndim:
            rows = np.isin(np.arange(len(found.speed)), [one.row for one in own])
            where = say(_(", at {speeds}"), speeds=ranges(np.abs(found.speed), rows, "angular_speed"))
        torque = _torque(max(float(np.max(one.swing)) for one in own))
        swings.append(say(text, periods=periods, longest=LONGEST, torque=torque, where=where))
    text = _("Where backlash opens there are further motions: {how}; {counts}; orders are of the motion of one period.")
    known = _(
        "such a motion counts in lowest and highest torques where a slow run-up or run-down leads to it, else it takes "
        "a blow or an abrupt start"
    )
    dark, lost = _not_known(found, longer)
    unknown = _(
        "{where}it is not known to which motion a slow run-up or run-down leads: there such a motion counts in lowest "
        "and highest torques only where none of one period is stable"
    )
    rules: list[Text] = [] if len(dark) == len(longer) else [known]
    if dark:
        rules.append(say(unknown, where=say(_("at {speeds} "), speeds=lost) if found.speed.ndim else ""))
    return Remark(text=say(text, how=Joined(swings), counts=Joined(rules, between="; ")), tone="warning")


def _not_known(found: TorsionResponse, beside: Sequence[Beside]) -> tuple[list[Beside], Text]:
    """Return those of further motions of which it is not known whether a ramp leads there, and at which speeds."""
    dark = [one for one in beside if one.reached is None]
    speeds = np.atleast_1d(np.abs(found.speed))
    return dark, ranges(speeds, np.isin(np.arange(len(speeds)), [one.row for one in dark]), "angular_speed")


def _beside(found: TorsionResponse) -> Remark:
    """Return that there are further stable motions: at one speed their torque, over many where they are."""
    beside = [one for one in found.beside if one.periods == 1]
    if not found.speed.ndim:
        text = _(
            "Other stable motions at this speed: {torques}; told is the largest to which a slow run-up or run-down "
            "leads."
        )
        if beside[0].reached is None:
            text = _(
                "Other stable motions at this speed: {torques}; told is the largest, for it is not known to which of "
                "them a slow run-up or run-down leads."
            )
        blow = _("±{torque} after a blow or an abrupt start")
        torques = [
            say(blow if one.reached is False else "±{torque}", torque=_torque(float(np.max(one.swing))))
            for one in beside
        ]
        return Remark(text=say(text, torques=Joined(torques)), tone="warning")
    text = _(
        "Several stable motions at {where}, {torques}: the torque jumps on the way up and down; told is the largest to "
        "which a slow run-up or run-down leads{unknown}."
    )
    several = np.isin(np.arange(len(found.speed)), [one.row for one in beside])
    where = ranges(np.abs(found.speed), several, "angular_speed")
    sizes = [float(np.max(one.swing)) for one in beside]
    ends = [say("±{torque}", torque=_torque(one)) for one in sorted({min(sizes), max(sizes)})]
    dark, lost = _not_known(found, beside)
    unknown = say(_(", and the largest of all at {where}, where that is not known"), where=lost) if dark else ""
    return Remark(text=say(text, where=where, torques=Joined(ends, between=" … "), unknown=unknown), tone="warning")


def _alarms(found: TorsionResponse) -> Iterator[Remark]:
    """Yield what must not be overlooked on the first page; the sentence of the answer says it too."""
    if not bool(found.steady.found):
        text = _("No steady torsional motion was found at {speed}.")
        yield Remark(text=say(text, speed=_speed(found.speed)), tone="warning", depth="data", alarm=True)
    elif int(found.floquet.verdict) == Verdict.UNSTABLE:
        text = _("Torsional vibration is unstable at {speed}: {zone}.")
        said = say(text, speed=_speed(found.speed), zone=found.floquet.zone.name())
        yield Remark(text=said, tone="failed", depth="data", alarm=True)


def _checked(found: TorsionResponse) -> Iterator[Remark]:
    """Yield how closely the motions keep their equations and the account of power."""
    left = float(np.nanmax(found.steady.residual)), float(np.nanmax(np.abs(found.steady.power_residual)))
    text = _(
        "Checked: between the points of the solution the torques balance {closely}, over a period the power {power}."
    )
    rubs = any(one.friction for _e, one in found.train.springs)
    poor = (left[1] if rubs else max(left)) > SMALL
    if rubs and not poor:
        text = _(
            "Checked: torques balance {closely} where dry friction begins to slip, over a period the power {power}."
        )
    if poor:
        text = _("Warning: torques of the solution balance only {closely}, power {power}.")
    said = text.format(closely=closely(left[0]), power=closely(left[1]))
    yield Remark(text=said, tone="warning" if poor else "plain", aside=not poor)


def _engine(engine: Engine, found: TorsionResponse) -> Remark:
    """Return mean and strongest harmonics of the torque of an engine's crank drive."""
    torque = engine_torque(engine, float(np.max(np.abs(found.speed))))
    strongest = np.argsort(-torque.amplitude, kind="stable")[:3]
    parts = [
        say(
            _("±{torque} of order {order}"),
            torque=_torque(float(torque.amplitude[k])),
            order=_order(torque.order[k]),
        )
        for k in strongest
    ]
    text = _("The engine brings {mean} to the input shaft, with {orders} of its crank.")
    return Remark(text=say(text, mean=_torque(float(torque.mean or 0.0)), orders=Joined(parts)))


def _from_yokes(drive: Drive, found: TorsionResponse) -> bool:
    """Tell whether most of the vibration is order 2 of joints that are not set to cancel each other."""
    if len(drive.joints) < 2 or not np.any(found.steady.found):
        return False
    swing = np.nan_to_num(found.swing)
    at = np.unravel_index(int(foremost(swing.ravel())), swing.shape)
    second = found.steady.torque.amplitude[at][np.flatnonzero(found.steady.order == 2.0)[0]]
    return bool(second > 0.5 * swing[at]) and float(each_shaft(drive).speed_fluctuation[-1]) > UNEVEN


def _key(found: TorsionResponse) -> KeyFigure:
    verdict = int(found.floquet.verdict)
    grows, unsure = verdict == Verdict.UNSTABLE, verdict == Verdict.UNKNOWN
    return KeyFigure(
        name="alternating_torque",
        title=_("largest alternating torque, ±"),
        place=found.train.elements[int(foremost(found.swing))],
        value=Quantity(_alternating(found), "torque"),
        better="",
        verdict=_("unstable") if grows else _("unknown") if unsure else _("stable"),
        tone="failed" if grows else "warning" if unsure else "good",
    )


def _everything(found: TorsionResponse) -> Table:
    """Return torques of every element, one speed a row."""
    one, torque = not found.speed.ndim, found.steady.torque

    def wide(values: Any) -> Array:
        return np.asarray(values)[None] if one else np.asarray(values)

    columns = [
        Column(key="speed", values=wide(found.speed), dimension="angular_speed"),
        Column(key="status", values=wide(found.steady.status)),
        Column(key="verdict", values=wide(found.floquet.verdict)),
        Column(key="growth_rate", values=wide(found.floquet.growth_rate), dimension="rate"),
    ]
    for e in range(len(found.train.model.elements)):
        parts = {"mean": torque.mean, "min": found.torque_lowest, "max": found.torque_highest}
        own = {name: wide(part)[..., e] for name, part in parts.items()}
        own |= {
            f"order_{order:g}": wide(torque.amplitude)[..., e, k] for k, order in enumerate(found.steady.order.tolist())
        }
        columns += [
            Column(key=f"element_{e + 1}_{name}", values=values, dimension="torque") for name, values in own.items()
        ]
    return Table(columns=columns)


def _facts(found: TorsionResponse) -> dict[str, Any]:
    steady = found.steady
    return {
        "speed": Quantity(np.abs(found.speed), "angular_speed"),
        "input": "free" if found.train.model.free else "uniform",
        "elements": found.train.elements,
        "stations": found.train.station_names,
        "orders": steady.order,
        "mean": Quantity(steady.torque.mean, "torque"),
        "min": Quantity(found.torque_lowest, "torque"),
        "max": Quantity(found.torque_highest, "torque"),
        "order_amplitude": Quantity(steady.torque.amplitude, "torque"),
        "station_speed_amplitude": Quantity(steady.station_speed.amplitude, "angular_speed", unit="rad_s"),
        "drive_torque": Quantity(steady.drive_torque.mean[..., 0], "torque"),
        "status": steady.status,
        "verdict": [Verdict(int(one)).name.lower() for one in found.floquet.verdict.reshape(-1)],
        "growth_rate": Quantity(found.floquet.growth_rate, "rate"),
        "stability_counts_nonsynchronous": found.together if found.apart else None,
        "spectral_radius": found.floquet.spectral_radius,
        "nonsynchronous": [
            {"order": one.order, "torque": Quantity(np.abs(one.torque), "torque"), "exact": one.exact}
            for one in found.apart
        ],
        "side_bands": [{"order": order, "torque": Quantity(size, "torque")} for order, size in found.side_orders(0.0)],
        "other_motions": [
            {
                "reached": one.reached,
                "speed": Quantity(float(np.abs(found.speed.reshape(-1)[one.row])), "angular_speed"),
                "periods": one.periods or None,
                "runs": one.runs,
                "min": Quantity(one.lowest, "torque"),
                "max": Quantity(one.highest, "torque"),
            }
            for one in found.beside
        ],
        "residual": steady.residual,
        "power_residual": steady.power_residual,
        "assumed": found.assumed,
    }


def worst(found: TorsionResponse) -> tuple[float, float]:
    """Return the largest alternating torque [N·m] and its speed [rad/s], over the speeds that were found."""
    if not np.any(found.steady.found):
        raise refuse("duty.speed", _("no steady motion was found"))
    swing = np.ravel(np.where(found.steady.found, np.max(found.swing, axis=-1), 0.0))
    k = int(foremost(swing))
    return float(swing[k]), float(np.ravel(found.speed)[k])


COLUMNS = (
    SweepQuestion(
        name="orders",
        doc=mark("largest alternating torque over the operating range, and the speed at which it is so"),
        told=(
            OutputColumn.of(
                "worst_alternating_torque_Nm", mark("largest alternating torque over the operating range, ±")
            ),
            OutputColumn.of("worst_torque_speed_rpm", mark("speed of the largest alternating torque")),
        ),
        of_result=worst,
    ),
)
"""What a sweep may ask of steady torsional vibration."""
