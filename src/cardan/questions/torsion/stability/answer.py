"""What there is to say of parametric stability: of steady running at a speed, over a quantity, or on a map of two."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Column, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Say, Text, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import OutputColumn, SweepQuestion
from cardan.drive.drive import Drive
from cardan.drive.models.kinematics_model import given_chain
from cardan.errors import refuse
from cardan.formulas.damping import LOSS
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.model.answer import (
    assumptions,
    counted,
    nonsynchronous,
    parts_left_out,
    ranges,
    torques_left_out,
)
from cardan.questions.torsion.model.answer import lacking as lacking_modes
from cardan.questions.torsion.model.torsional_train import torsional_train
from cardan.questions.torsion.steady.run_stability import Kind, Verdict, verdict_words
from cardan.texts import _, mark
from cardan.units import deg, rpm

from .figure import SPEED, MapAxis, map_axes, plays, stability_figures
from .proved_speeds import ProvedSpeeds
from .torsion_stability import JOINT_ANGLE, MANY, TOLD, Stability, no_smooth_motion, stability

__all__ = ["COLUMNS", "answer", "ask", "lacking", "otherwise"]

ACROSS, UP = 61, 14
"""Speeds and joint angles of a map."""

COARSE_ACROSS, COARSE_UP = 21, 7
"""The same of a drive with backlash, or with orders that do not repeat: a point takes a hundred times as long."""

LITTLE, WIDEST = math.radians(0.5), math.radians(45.0)
"""No map of drives with smaller joint angles; what stands for the angle of one with a larger one."""

NAMED = 3
"""Zones named in the sentence on a map."""

SIGNS = ("·", "~", "#", " ")
"""A point of a map in the terminal, by `Verdict`."""

WIDE, HIGH = 61, 17
"""Points of a map in the terminal at most."""

EDGE = 6
"""Digits of the edge of an unstable range."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for a map of stability."""
    return (*lacking_modes(drive), *absent((bool(drive.duty.speed), "duty.speed")))


def otherwise(_drive: Drive) -> str:
    """Return why there is no map although nothing is missing."""
    return _("The joints are all but straight: they excite no parametric vibration.")


def ask(drive: Drive, *, progress: Callable[[float], object] | None = None) -> Stability | None:
    """Return where torsional vibration is stable, about the speed and the joint angles of a drive.

    Returns Stability or None: None where all joints are all but straight.
    """
    joint_angle = float(np.max(given_chain(drive).joint_angle))
    if not drive.duty.speed or joint_angle < LITTLE:
        return None
    runs = abs(drive.duty.speed) / rpm
    loose = bool(np.any(torsional_train(drive, loaded=False).model.backlash > 0.0))
    coarse = loose or nonsynchronous(drive) is not None
    across, up = (COARSE_ACROSS, COARSE_UP) if coarse else (ACROSS, UP)
    speeds = np.linspace(0.5 * runs, 1.5 * runs, across)
    joint_angles = np.linspace(0.3, 1.6, up) * min(joint_angle, WIDEST) / deg
    return stability(drive, over={"duty.speed_rpm": speeds, JOINT_ANGLE: joint_angles}, progress=progress)


def answer(drive: Drive, result: Stability, *, signs: bool = False) -> Answer:
    """Return what there is to say of stability.

    result: of a point, over one path or over two.
    signs: draw a map in letters, for a terminal, and as a figure even where nothing is unstable.
    """
    axes = map_axes(result)
    tone, said = _mapped(result, axes) if axes else _point(result)
    if tone == "good" and np.any(result.jumped):
        tone = "warning"
    drawn = signs or not axes or bool(np.any(result.verdict != Verdict.STABLE))
    return Answer(
        name="stability",
        title=_("Parametric stability"),
        sentence=said,
        tone=tone,
        figures=lambda: stability_figures(result) if drawn else (),
        tables=(_picture(result, axes),) if signs and len(axes) == 2 else (),
        remarks=(*_remarks(drive, result, axes, signs=signs), *yokes_estimated(drive)),
        facts=_facts(drive, result),
        full=lambda: _everything(result, axes),
        code=1 if not axes and tone == "failed" else 0,
    )


def _speed(value: Any) -> Quantity:
    return Quantity(abs(float(value)), "angular_speed")


def _point(found: Stability) -> tuple[Tone, Text]:
    """Return what becomes of vibration at one point."""
    speed, verdict, rate = _speed(found.speed), int(found.verdict), float(found.growth_rate)
    time = Quantity(math.log(10.0) / abs(rate) if rate else math.inf, "time", 3)
    if verdict == Verdict.UNKNOWN and np.isfinite(found.spectral_radius):
        text = _("whether it is stable at {speed} is not known: dry friction sticks and slips.")
        return "warning", say(text, speed=speed)
    if verdict == Verdict.UNKNOWN:
        return "failed", say(_("no steady motion was found at {speed}."), speed=speed)
    if verdict == Verdict.UNSTABLE:
        text = _("unstable at {speed}: vibration grows tenfold in {time} ({zone}, order {order}).")
        digits = 3 if int(found.kind) == Kind.COMBINATION else 6
        order = Quantity(float(found.order), digits=digits, trim=True)
        said: Text = say(text, speed=speed, time=time, zone=found.zone.name(), order=order)
        return "failed", said
    if verdict == Verdict.NEUTRAL:
        return "warning", say(_("neutral at {speed}: vibration neither grows nor decays."), speed=speed)
    return "good", say(_("stable at {speed}: vibration decays to a tenth in {time}."), speed=speed, time=time)


def _jumped(found: Stability) -> Iterator[Remark]:
    """Yield where another steady motion grows than the one that is judged."""
    known = found.verdict != Verdict.UNKNOWN
    share = float(np.sum(found.jumped)) / max(1, int(np.sum(known)))
    if not share:
        return
    if found.over:
        text = _("Warning: at {share} of the points another steady motion grows; that judged is stable beside it.")
        yield Remark(text=say(text, share=Quantity(share, "share", 2)), tone="warning", code="jumped")
        return
    text = _("Warning: another steady motion grows here; that judged is stable beside it, and as wide as told by:")
    asked = ("--speed-rpm", f"{abs(float(found.speed)) / rpm:.6g}")
    yield Remark(text=text, tone="warning", command=("cardan", "torsion", "response", FILE, *asked), code="jumped")


def _mapped(found: Stability, axes: tuple[MapAxis, ...]) -> tuple[Tone, Text]:
    """Return what becomes of vibration over a path or two."""
    known = np.any(found.verdict != Verdict.UNKNOWN)
    proved = found.proof is not None and found.proof.looked_at and not np.any(found.together)
    if len(axes) == 1 and known and proved and found.proof is not None:
        return _followed(found, found.proof, axes[0])
    unstable = found.verdict == Verdict.UNSTABLE
    if not np.any(unstable):
        return _calm(found, axes)
    if len(axes) == 1:
        (over,) = axes
        where = ranges(over.si, unstable, over.dimension, over.unit)
        if over.key == SPEED:
            return "failed", say(_("unstable at {where}."), where=where)
        return "failed", say(_("unstable range: {what} {where}."), what=over.label, where=where)
    named = np.argwhere(unstable & (found.zone.modes[..., 0] > 0)).tolist()
    zones = sorted({found.zone.name(tuple(index)) for index in named})
    said = ", ".join(zones[:NAMED]) + (_(" and others") if len(zones) > NAMED else "")
    text = _("{share} of the map is unstable: {zones}.") if said else _("{share} of the map is unstable.")
    return "failed", say(text, share=Quantity(found.unstable_share, "share"), zones=said)


def _followed(found: Stability, proof: ProvedSpeeds, over: MapAxis) -> tuple[Tone, Text]:
    """Return what is proved over a range of speeds, with what the points tell of the rest."""
    zones = _zone_texts(proof, over)
    rest = (found.verdict == Verdict.UNSTABLE) & ~proof.shown(over.si)
    sampled = ranges(over.si, rest, over.dimension, over.unit)
    low, high = (_edge(one, over) for one in proof.looked)
    if proof.stable:
        return "good", say(_("stable from {low:bare} to {high}: proved throughout."), low=low, high=high)
    if not zones and not np.any(rest):
        text = _("no unstable range from {low:bare} to {high}; a zone up to {hidden} wide could hide.")
        hidden = Quantity(proof.hidden, over.dimension, 2, unit=over.unit)
        return "warning", say(text, low=low, high=high, hidden=hidden)
    where = Joined([*zones, sampled] if np.any(rest) else zones)
    if proof.proved:
        text = _("unstable at {where}; otherwise stable from {low:bare} to {high}, proved.")
        return "failed", say(text, where=where, low=low, high=high)
    text = _("unstable at {where}; from {low:bare} to {high} another zone up to {hidden} wide could hide.")
    hidden = Quantity(proof.hidden, over.dimension, 2, unit=over.unit)
    return "failed", say(text, where=where, low=low, high=high, hidden=hidden)


def _zone_texts(proof: ProvedSpeeds, over: MapAxis) -> list[Text]:
    """Return the unstable ranges that were followed to their edges."""
    pairs = zip(proof.lowest, proof.highest, strict=True)
    text = _("{low:bare} to {high}")
    return [say(text, low=_edge(low, over), high=_edge(high, over)) for low, high in pairs]


def _edge(speed: Any, over: MapAxis) -> Quantity:
    return Quantity(float(speed), over.dimension, EDGE, unit=over.unit, trim=True)


def _unproved(found: Stability, over: MapAxis) -> Iterator[Remark]:
    """Yield how sure the ranges of speed are."""
    proof, rubs = found.proof, any(one.friction > 0.0 for _element, one in found.train.springs)
    if proof is None:
        return
    together = bool(np.any(found.together))
    if together or not proof.looked_at:
        step = over.quantity(float(np.max(np.diff(np.sort(over.values)), initial=0.0)), 2)
        text = _(
            "Only points {step} apart were judged: narrower zones may be missed, and a proof between them would take "
            "too long for a line this stiff."
        )
        if rubs:
            text = _(
                "Only points {step} apart were judged: narrower zones may be missed, as nothing is proved where dry "
                "friction sticks and slips."
            )
        if together:
            text = _(
                "Only points {step} apart were judged: narrower zones may be missed, as nothing is proved with orders "
                "that do not repeat within two turns."
            )
        yield Remark(text=say(text, step=step), tone="warning")
        return
    rest = _within(proof.unproved, proof.unsettled, inside=False)
    late = _("Not settled at {where}: the motion changes so often with the speed there that it takes too long.")
    kinds = [
        (_within(proof.unproved, proof.unsettled), late),
        (_within(rest, proof.open), _("Not proved at {where}: {why}.")),
        (_within(rest, proof.open, inside=False), _("Not proved at {where}: the margin is too small there.")),
    ]
    if rubs:
        kinds = [(proof.unproved, _("Not proved at {where}: dry friction sticks and slips."))]
    for kind, text in kinds:
        if len(kind):
            where = [say(_("{low:bare} to {high}"), low=_edge(a, over), high=_edge(b, over)) for a, b in kind[:NAMED]]
            others = _(" and others") if len(kind) > NAMED else ""
            named = Joined([Joined(where), others], between="")
            yield Remark(text=say(text, where=named, why=no_smooth_motion(found.train)), tone="warning")


def _as_drawn(found: Stability, proof: ProvedSpeeds, over: MapAxis) -> Iterator[Remark]:
    """Yield what is proved of the drive as it is, beside points of other drives or with more orders."""
    low, high = (_edge(one, over) for one in proof.looked)
    zones = _zone_texts(proof, over)
    hidden = Quantity(proof.hidden, over.dimension, 2, unit=over.unit)
    text = _("As drawn it is unstable at {where}; otherwise stable from {low:bare} to {high}, proved.")
    if not zones and proof.proved:
        text = _("As drawn it is stable from {low:bare} to {high}: proved throughout.")
    elif not zones:
        text = _("As drawn no zone wider than {hidden} can hide from {low:bare} to {high}.")
    elif not proof.proved:
        text = _("As drawn it is unstable at {where}; from {low:bare} to {high} a zone up to {hidden} wide could hide.")
    said = say(text, where=Joined(zones), low=low, high=high, hidden=hidden)
    yield Remark(text=said, tone="warning" if zones else "good")
    if np.any(found.together):
        yield Remark(text=_("What is proved leaves out the orders that do not repeat within two turns."))


def _within(stretches: Any, others: Any, *, inside: bool = True) -> Any:
    """Return the stretches in which one of the others begins, or those in which none does."""
    held = [any(one[0] <= begin < one[1] for begin, _end in others) == inside for one in stretches]
    return stretches[np.asarray(held, dtype=bool)]


def _calm(found: Stability, axes: tuple[MapAxis, ...]) -> tuple[Tone, Text]:
    """Return what is said where no point is known to be unstable."""
    if np.all(found.verdict == Verdict.STABLE):
        hit = len(axes) == 2 and found.proof is not None and len(found.proof.lowest) > 0
        text = _("stable at every point: {where}.")
        where = Joined([_ends(one) for one in axes], between="; ")
        return "failed" if hit else "good", say(text, where=where)
    if np.all(found.verdict == Verdict.UNKNOWN):
        return "failed", _("no steady motion was found.")
    neutral, lost = (int(np.sum(found.verdict == one)) for one in (Verdict.NEUTRAL, Verdict.UNKNOWN))
    text = _("no point is known to be unstable; {neutral} of {all} are neutral, {lost} not known.")
    return "warning", text.format(neutral=neutral, all=found.verdict.size, lost=lost)


def _ends(over: MapAxis) -> Say:
    """Return an axis with the range of its values."""
    low, high = over.quantity(over.values[0], 3), over.quantity(over.values[-1], 3)
    return say(_("{what} {low:bare} to {high}"), what=over.label, low=low, high=high)


def _picture(found: Stability, axes: tuple[MapAxis, ...]) -> Table:
    """Return a map drawn with signs."""
    turned = axes[0].key == SPEED
    down, across = axes[::-1] if turned else axes
    table = found.verdict.T if turned else found.verdict
    rows, columns = down.values, across.values
    i = np.unique(np.linspace(0, len(rows) - 1, min(len(rows), HIGH)).round().astype(int))[::-1]
    j = np.unique(np.linspace(0, len(columns) - 1, min(len(columns), WIDE)).round().astype(int))
    pictured = [[SIGNS[int(table[k, n])] for n in j] for k in i]
    legend = [f"{SIGNS[state]} {verdict_words()[state]}" for state in (Verdict.UNSTABLE, Verdict.STABLE)]
    if down.here is not None and across.here is not None:
        y, x = np.abs(rows[i] - down.here), np.abs(columns[j] - across.here)
        if min(rows) <= down.here <= max(rows) and min(columns) <= across.here <= max(columns):
            pictured[int(np.argmin(y))][int(np.argmin(x))] = "O"
            legend.append(f"O {_('operating point')}")
    return Table(
        title=", ".join(legend),
        columns=(
            Column(key="", heading=down.label, values=rows[i] * down.factor, dimension=down.dimension, unit=down.unit),
            Column(key="", heading=across.label, values=["".join(line) for line in pictured], left=True),
        ),
        note=say(_("Across: {ends}."), ends=_ends(across)),
    )


def _remarks(drive: Drive, found: Stability, axes: tuple[MapAxis, ...], *, signs: bool) -> Iterator[Remark]:
    if found.cancelled:
        text = _("Warning: stopped; {done} of {all} points are done.")
        done = int(np.sum(found.verdict != Verdict.UNKNOWN))
        yield Remark(text=text.format(done=done, all=found.verdict.size), tone="warning")
    yield from _jumped(found)
    if len(axes) == 1 and found.proof is not None:
        yield from _unproved(found, axes[0])
    if (len(axes) == 2 or np.any(found.together)) and found.proof is not None and found.proof.looked_at:
        yield from _as_drawn(found, found.proof, next(one for one in axes if one.key == SPEED))
    if not axes and int(found.verdict) == Verdict.STABLE and np.isfinite(found.zone.speed):
        text = _("The nearest zone of instability is the {zone}, at {speed}.")
        yield Remark(text=say(text, zone=found.zone.name(), speed=_speed(found.zone.speed)))
    if not axes and found.least_loss > 0.0:
        text = _("Stable from a loss factor of the shafts of {least} on; steel shaft lines have {usual} and more.")
        if np.any(found.train.model.damping):
            text = _(
                "Stable from a loss factor of the shafts of {least} on, beside its dampers; steel shaft lines have "
                "{usual} and more."
            )
        if found.together:
            text = _(
                "Without the orders that do not repeat it would be stable from a loss factor of the shafts of {least} "
                "on; steel shaft lines have {usual} and more."
            )
        least, usual = (Quantity(one, "share", 2) for one in (found.least_loss, LOSS["shaft"]))
        yield Remark(text=say(text, least=least, usual=usual))
    if not axes and int(found.verdict) == Verdict.UNSTABLE:
        text = _(
            "What helps: another speed, smaller joint angles, a joint nearer to the node of the mode, more damping."
        )
        if found.zone.by_torques:
            text = _("What helps: another speed, smaller torques of that order, more damping.")
        yield Remark(text=text)
    yield from counted(nonsynchronous(drive), found.together, MANY)
    if found.train.model.free:
        yield Remark(text=_("Rigid-body rotation is left out: a free drive may shift in time."))
    yield from assumptions(found.train, sprung=True)
    if drive.duty.load is not None:  # in place of the torque of every load case
        yield from torques_left_out(drive)
    yield from parts_left_out(drive)
    if axes and found.verdict.size > TOLD and (plays(found) or found.train.springs):
        text = _(
            "Where several motions are possible the first one found is judged; asked at a single speed, that which "
            "torsion response tells."
        )
        yield Remark(text=text)
    if len(axes) == 2 and not signs and (plays(found) or np.any(found.together)):
        text = _("The map is coarse, as motions whose backlash opens take long; in full: {command}")
        if not plays(found):
            text = _("The map is coarse, as motions with orders that do not repeat take long; in full: {command}")
        yield Remark(text=text.format(command=_finer(axes)), depth="full")
    if not axes:
        text = _("A stability map over speed in rpm and largest joint angle in degrees:")
        command = ("cardan", "torsion", "stability", FILE, "--speeds", "LOW:HIGH", "--joint-angles", "LOW:HIGH")
        yield Remark(text=text, command=command, tone="next")


def _finer(axes: tuple[MapAxis, ...]) -> str:
    """Return the command that draws a map in full."""
    speeds, joint_angles = (one.values for one in axes)
    asked = "--speeds {:.4g}:{:.4g}:{} --joint-angles {:.3g}:{:.3g}:{}"
    asked = asked.format(speeds[0], speeds[-1], ACROSS, joint_angles[0], joint_angles[-1], UP)
    return f"cardan torsion stability FILE {asked}"


def _everything(found: Stability, axes: tuple[MapAxis, ...]) -> Table:
    """Return the map, one point a row."""
    grid = np.meshgrid(*(one.si for one in axes), indexing="ij") if axes else []
    own = [
        Column(key=one.key, values=values.reshape(-1), dimension=one.dimension, unit=one.unit)
        for one, values in zip(axes, grid, strict=True)
    ]
    speed = np.broadcast_to(np.abs(found.speed), found.verdict.shape).reshape(-1)
    return Table(
        columns=(
            *own,
            Column(key="input_speed", values=speed, dimension="angular_speed"),
            Column(key="verdict", values=found.verdict.reshape(-1)),
            Column(key="spectral_radius", values=np.asarray(found.spectral_radius).reshape(-1)),
            Column(key="growth_rate", values=np.asarray(found.growth_rate).reshape(-1), dimension="rate"),
            Column(key="order", values=np.asarray(found.order).reshape(-1)),
        )
    )


def _facts(drive: Drive, found: Stability) -> dict[str, Any]:
    names = np.asarray([one.name.lower() for one in Verdict])
    return {
        "over": dict(found.over),
        "speed": Quantity(np.abs(found.speed), "angular_speed"),
        "verdict": names[found.verdict],
        "stable": found.stable,
        **({"another_motion_grows": found.jumped} if np.any(found.jumped) else {}),
        "counts_nonsynchronous": found.together if nonsynchronous(drive) is not None else None,
        "spectral_radius": found.spectral_radius,
        "growth_rate": Quantity(found.growth_rate, "rate"),
        "order": found.order,
        "nearest_zone": [found.zone.name(index) for index in np.ndindex(found.verdict.shape)],
        "nearest_zone_speed": Quantity(found.zone.speed, "angular_speed"),
        "least_loss_factor": found.least_loss,
        "proof": None if found.proof is None else _proof_facts(found.proof),
        "cancelled": found.cancelled,
        "assumed": found.train.assumed,
    }


def _proof_facts(proof: ProvedSpeeds) -> dict[str, Any]:
    return {
        "speeds": Quantity(np.asarray(proof.looked), "angular_speed"),
        "proved": proof.proved,
        "stable": proof.stable,
        "unstable": [
            {
                "speeds": Quantity(np.asarray([proof.lowest[k], proof.highest[k]]), "angular_speed"),
                "worst": Quantity(float(proof.worst[k]), "angular_speed"),
                "growth_rate": Quantity(float(proof.growth_rate[k]), "rate"),
                "zone": proof.zone.name((k,)),
            }
            for k in range(len(proof.lowest))
        ],
        "unproved": Quantity(proof.unproved, "angular_speed"),
        "unsettled": Quantity(proof.unsettled, "angular_speed"),
        "widest_zone_hidden": Quantity(proof.hidden, "angular_speed"),
    }


def _column_values(drive: Drive) -> tuple[float, float, float]:
    found = stability(drive)
    if int(found.verdict) == Verdict.UNKNOWN:
        raise refuse("", _("no steady motion was found"))
    return (float(found.growth_rate), float(found.spectral_radius), float(found.verdict == Verdict.UNSTABLE))


COLUMNS = (
    SweepQuestion(
        name="stability",
        doc=mark("whether a small torsional disturbance grows, and how fast"),
        told=(
            OutputColumn(name="growth_rate", text=mark("growth rate of the disturbance slowest to decay, 1/s")),
            OutputColumn(name="spectral_radius", text=mark("largest modulus of the Floquet multipliers")),
            OutputColumn(name="unstable", text=mark("1 where a disturbance grows, else 0")),
        ),
        of_one=_column_values,
    ),
)
"""What a sweep may ask of stability."""
