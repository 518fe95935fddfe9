"""What there is to say of an absorber on a drive: how it is set, what it leaves, what it has to bear."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite, sqrt
from typing import Any

import numpy as np

from cardan.answers.answer import Answer, Column, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Say, Text, say
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import tree_of
from cardan.formulas.damping import LOSS, SHAFT_SOURCE
from cardan.later import later
from cardan.maths.arrays import Array
from cardan.maths.ties import foremost
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.model.answer import lacking, nonsynchronous, parts_left_out, torques_left_out
from cardan.questions.torsion.stability.proved_speeds import ProvedSpeeds
from cardan.texts import _
from cardan.units import deg

from .absorber import Absorber
from .absorber import absorber as ask
from .absorber_search import Setting

drawn = later("cardan.questions.torsion.absorber.figure")

__all__ = ["answer", "ask", "lacking"]

HOSTS = 12
"""Stations that people are shown."""

WIDE = 30.0 * deg
"""Amplitude of a pendulum from which its order falls by more than two percent."""

STILL = 1e-6
"""A station that moves by less than this share of the largest amplitude stands still."""


def answer(drive: Drive, result: Absorber, *, chosen: bool = False) -> Answer:
    """Return what there is to say of an absorber on a drive.

    drive: the drive without it.
    chosen: whether the band of speeds was asked for: then it may lie where the drive does not run.
    """
    away = None if chosen else _away(drive, result)
    calmer = result.reduction < LITTLE or (cured(result) and result.tuned_speed is None)
    helps = calmer and away is None and not unstable(result)
    tone: Tone = "good" if helps else "warning"
    return Answer(
        name="absorber",
        title=_("Absorber"),
        sentence=_sentence(result),
        tone=tone,
        tables=(_settings(result), _hosts(result), _station(result)),
        remarks=(*_remarks(result, away), *yokes_estimated(drive)),
        figures=lambda: drawn().absorber_figures(result),
        facts=_facts(result),
        full=lambda: _curves(result),
    )


def _away(drive: Drive, result: Absorber) -> float | None:
    """Return the speed of a drive [rad/s] where it lies outside the band; None where it does not, or none is given."""
    if drive.duty.speed is None or result.speed[0] <= abs(drive.duty.speed) <= result.speed[-1]:
        return None
    return abs(drive.duty.speed)


def _sentence(result: Absorber) -> Say:
    what = {
        "viscous": _("a viscous damper on {station}"),
        "pendulum": _("pendulums on {station}"),
        "tuned": _("an absorber without damping on {station}"),
    }.get(result.kind, _("an absorber on {station}"))
    values: dict[str, Any] = {
        "what": say(what, station=result.host.name),
        "before": torque(result.bare.peak),
        "after": torque(result.best.peak),
        "band": band(result.speed),
    }
    text = _("with {what} the largest alternating torque falls from ±{before:bare} to ±{after}, {band}.")
    if result.tuned_speed is not None:
        text = _("with {what} the alternating torque at {speed} falls from ±{before:bare} to ±{after}.")
        if result.reduction > 1.0:
            text = _("with {what} the alternating torque at {speed} rises from ±{before:bare} to ±{after}.")
        values["speed"] = speed(result.tuned_speed, 4)
    elif len(result.unstable_before):
        text = _("with {what} the largest alternating torque is ±{after}, {band}; without it vibration grows there.")
    elif result.reduction > LITTLE:
        text = _("{what} does little here: alternating torque ±{after}, ±{before} without it, {band}.")
    return say(text, **values)


def _settings(result: Absorber) -> Table:
    pendulum, viscous = result.kind == "pendulum", result.kind == "viscous"
    rows = (result.bare, result.closed_form, result.best)
    set_up = [one if one.inertia else None for one in rows]
    spring: list[float | None] = [None if one is None or viscous else one.arm or one.stiffness for one in set_up]
    ratio = [None if one is None or viscous else result.frequency_ratio(one) for one in set_up]
    damping = [None if one is None or pendulum else one.damping for one in set_up]
    share = [None if one is None or pendulum else result.damping_ratio(one) for one in set_up]
    held = Column(key="stiffness", heading=_("spring"), values=spring, dimension="turning_stiffness")
    if pendulum:
        held = Column(key="arm", heading=_("arm"), values=spring, dimension="length")
    return Table(
        title=_("Settings, and the largest alternating torque with each"),
        columns=(
            Column(key="setting", heading=_("setting"), values=[_("without"), _("closed form"), _("best")]),
            held,
            Column(key="damping", heading=_("damper"), values=damping, dimension="turning_damping"),
            Column(
                key="frequency_ratio",
                heading=_("tuning"),
                values=ratio,
                decimals=3,
            ),
            Column(key="damping_ratio", heading="ξ", values=share, decimals=3),
            Column(
                key="alternating_torque",
                heading=_("torque ±"),
                values=[one.peak for one in rows],
                dimension="torque",
                digits=3,
            ),
            Column(key="at", heading=_("at"), values=[one.peak_speed for one in rows], dimension="angular_speed"),
            Column(
                key="element",
                heading=_("element"),
                values=[result.elements[one.peak_element] for one in rows],
                wrap=True,
            ),
        ),
    )


def _hosts(result: Absorber) -> Table:
    modal = [float(one) for one in result.modal_inertia]
    least = min(modal)
    moves = [sqrt(least / one) if isfinite(one) else 0.0 for one in modal]
    most = sorted(sorted(range(len(modal)), key=lambda k: -float(f"{moves[k]:.9g}"))[:HOSTS])
    return Table(
        title=_("Mode shape and modal inertia of mode {mode}").format(mode=result.mode),
        columns=(
            Column(key="number", heading=_("no."), values=[k + 1 for k in most]),
            Column(key="name", heading=_("station"), values=[result.hosts[k].name for k in most]),
            Column(key="amplitude", heading=_("relative amplitude"), values=[moves[k] for k in most], decimals=3),
            Column(
                key="modal_inertia",
                heading=_("modal inertia"),
                values=[modal[k] if moves[k] > STILL else None for k in most],
                dimension="inertia",
            ),
            Column(key="chosen", heading=_("chosen"), values=[result.hosts[k] == result.host for k in most], left=True),
        ),
        fixed=2,
    )


def _station(result: Absorber) -> Table:
    """Return what the drive file says of the station with the absorber, key by key."""
    keys: dict[str, Any] = {}
    for key, value in tree_of(result.drive)["stations"][result.table].items():
        keys |= {f"{key}.{inner}": one for inner, one in value.items()} if isinstance(value, dict) else {key: value}
    shown = [Quantity(one, digits=6, trim=True) if isinstance(one, float) else one for one in keys.values()]
    return Table(
        title=_("The station with it, as [[stations]] of the drive file"),
        columns=(
            Column(key="", heading=_("key"), values=list(keys)),
            Column(key="", heading=_("value"), values=shown, left=True),
        ),
        depth="full",
    )


def _remarks(result: Absorber, away: float | None) -> Iterator[Remark]:
    meeting = result.omega / result.order
    text = _(
        "Absorber inertia {inertia}, {ratio} of the modal inertia of mode {mode} there ({frequency}), which order "
        "{order} excites at {speed}."
    )
    yield Remark(
        text=say(
            text,
            inertia=Quantity(result.best.inertia, "inertia", 3),
            ratio=Quantity(round(result.inertia_ratio, 5), "share"),
            mode=result.mode,
            frequency=Quantity(result.omega, "frequency", 3),
            order=Quantity(result.order, trim=True),
            speed=speed(meeting),
        )
    )
    if result.tuned_speed is None and not result.speed[0] <= meeting <= result.speed[-1]:
        yield Remark(text=_("Warning: no resonance lies in this band; this one is the nearest."), tone="warning")
    elif away is not None:
        text = _("Warning: the drive runs at {speed}, outside these speeds; --speeds LOW:HIGH names others.")
        yield Remark(text=say(text, speed=speed(away, 4)), tone="warning")
    yield from _borne(result)
    if result.tuned_speed is not None:
        worst = np.max(result.after[:, list(result.judged)], axis=-1)
        k = int(foremost(worst))
        text = _("It serves this speed alone: at {speed} it resonates itself, and the alternating torque is ±{torque}.")
        yield Remark(text=say(text, speed=speed(result.speed[k]), torque=torque(worst[k])), tone="warning")
    yield from cautions(result)
    text = _("Searched {count} settings on the exact equations; the closed form of one mode leaves ±{torque}.")
    yield Remark(text=say(text, count=int(result.evaluations), torque=torque(result.closed_form.peak)))


def _borne(result: Absorber) -> Iterator[Remark]:
    """Yield what the absorber has to bear; one that serves one speed, there."""
    rows: Any = slice(None) if result.tuned_speed is None else result.speed == result.tuned_speed
    twist = float(np.nanmax(result.twist[rows]))
    text = {
        "pendulum": _("The pendulums oscillate by ±{twist} at most and act on the shaft with ±{torque}."),
        "tuned": _("There its spring twists by ±{twist} and carries ±{torque}."),
        "viscous": _("It slips by ±{twist} and transmits ±{torque} at most; its power loss is up to {loss}."),
    }.get(
        result.kind,
        _("Its spring twists by ±{twist} and carries ±{torque} at most; the power loss of its damper is up to {loss}."),
    )
    values = {
        "twist": Quantity(twist, "angle", 3),
        "torque": torque(np.nanmax(result.torque[rows])),
        "loss": Quantity(float(np.nanmax(result.heat[rows])), "power", 3),
    }
    yield Remark(text=say(text, **values))
    if result.kind == "pendulum" and twist > WIDE:
        text = _("Warning: beyond ±{limit} the order of a pendulum on a circle falls; give it more inertia.")
        yield Remark(text=say(text, limit=Quantity(WIDE, "angle", trim=True)), tone="warning")


def _facts(result: Absorber) -> dict[str, Any]:
    return {
        "kind": result.kind,
        "station": {"number": result.host.station + 1, "name": result.host.name, "shaft": result.host.shaft},
        "mode": result.mode,
        "frequency": Quantity(result.omega, "frequency"),
        "order": result.order,
        "inertia_ratio": result.inertia_ratio,
        "tuned_speed": None if result.tuned_speed is None else Quantity(result.tuned_speed, "angular_speed"),
        "without": _peak(result.bare),
        "closed_form": _setting(result, result.closed_form),
        "best": _setting(result, result.best),
        "stations": [
            {
                "number": k + 1,
                "name": host.name,
                "modal_inertia": Quantity(inertia if isfinite(inertia) else None, "inertia"),
            }
            for k, (host, inertia) in enumerate(zip(result.hosts, result.modal_inertia.tolist(), strict=True))
        ],
        "elements": list(result.elements),
        "judged": [k + 1 for k in result.judged],
        "largest_twist": Quantity(float(max(result.twist)), "angle"),
        "largest_torque": Quantity(float(max(result.torque)), "torque"),
        "largest_power_loss": Quantity(float(max(result.heat)), "power"),
        "unstable_before": Quantity(result.unstable_before, "angular_speed"),
        "unstable_after": Quantity(result.unstable_after, "angular_speed"),
        **proof_facts(result),
        "evaluations": result.evaluations,
        "converged": result.converged,
        "cancelled": result.cancelled,
        "backlash_closed": result.play,
        "assumed": list(result.assumed),
        "station_keys": tree_of(result.drive)["stations"][result.table],
    }


def _peak(setting: Setting) -> dict[str, Any]:
    return {
        "alternating_torque": Quantity(setting.peak, "torque"),
        "at": Quantity(setting.peak_speed, "angular_speed"),
    }


def _setting(result: Absorber, setting: Setting) -> dict[str, Any]:
    own: dict[str, Any] = {"inertia": Quantity(setting.inertia, "inertia")}
    if setting.arm is None:
        own |= {
            "stiffness": Quantity(setting.stiffness, "turning_stiffness"),
            "damping": Quantity(setting.damping, "turning_damping"),
            "damping_ratio": result.damping_ratio(setting),
        }
    else:
        own["arm"] = Quantity(setting.arm, "length")
    place = {"element": result.elements[setting.peak_element]}
    return own | {"frequency_ratio": result.frequency_ratio(setting)} | _peak(setting) | place


def _curves(result: Absorber) -> Table:
    """Return everything over the speed."""
    named = [("before", result.before), ("closed_form", result.closed), ("best", result.after)]
    return Table(
        name="curves",
        columns=(
            *curves(result.speed, named),
            Column(key="absorber_torque", values=result.torque, dimension="torque"),
            Column(key="absorber_twist", values=result.twist, dimension="angle"),
            Column(key="absorber_power_loss", values=result.heat, dimension="power"),
        ),
    )


# What an absorber and a better design have in common when they are told: a line to lack, a band, what to mind.

LITTLE = 0.9
"""What leaves more than this share of the alternating torque is hardly worth it."""

NAMED = 4
"""Speeds of instability that are named."""


def torque(value: float) -> Quantity:
    """Return an alternating torque as it is told: with three digits."""
    return Quantity(float(value), "torque", 3)


def speed(value: float, digits: int = 3) -> Quantity:
    """Return a speed as it is told."""
    return Quantity(float(value), "angular_speed", digits)


def band(speeds: Array) -> Say:
    """Return the speeds that were looked at, as a sentence has them.

    >>> from cardan.answers.reader import USUAL
    >>> from cardan.units import rpm
    >>> band(np.asarray([300.0, 600.0]) * rpm).told(USUAL), band(np.asarray([300.0]) * rpm).told(USUAL)
    ('300 to 600 rpm', 'at 300 rpm')
    """
    if len(speeds) > 1:
        return say(_("{low:bare} to {high}"), low=speed(speeds[0]), high=speed(speeds[-1]))
    return say(_("at {low}"), low=speed(speeds[0]))


def curves(speeds: Array, named: Sequence[tuple[str, Array]]) -> list[Column]:
    """Return the columns of alternating torques over the speed, an element each.

    speeds (s,) [rad/s]; named, sequence of (str, array (s, E) [N·m]): in which state, and the torques there.
    """
    found = [Column(key="speed", values=speeds, dimension="angular_speed")]
    for word, table in named:
        for k, curve in enumerate(table.T, 1):
            found.append(Column(key=f"{word}_alternating_torque_{k}", values=curve, dimension="torque"))
    return found


def cautions(found: Any) -> Iterator[Remark]:
    """Yield what an absorber and a design have to say alike: stability, lost motions, backlash, a stop, assumptions."""
    lost = int(np.sum(~np.isfinite(found.after).all(axis=-1)))
    if lost:
        text = _(
            "Warning: at {lost} of {count} speeds no steady motion was found; they do not count in the largest "
            "alternating torque."
        )
        yield Remark(text=say(text, lost=lost, count=len(found.after)), tone="warning")
    yield from _stability(found)
    if found.play:
        text = _("Backlash counts as closed here; cardan torsion response tells whether the torque changes its sign.")
        yield Remark(text=text, tone="warning")
    yield from _nonsynchronous(found)
    behind = [one.to_next for one in found.drive.stations if one.to_next is not None]
    if any(one.twists or one.friction for one in behind):
        text = _(
            "Springs by a table count with their stiffness at the torque of the duty, dry friction does not; "
            "cardan torsion response has both."
        )
        yield Remark(text=text)
    yield from torques_left_out(found.drive)
    yield from parts_left_out(found.drive)
    if found.cancelled:
        yield Remark(text=_("Warning: the search was stopped; this is the best so far."), tone="warning")
    elif not found.converged:
        yield Remark(text=_("Warning: the search had not converged; this is the best so far."), tone="warning")
    if any(path.endswith(".loss_factor") for path in found.assumed):
        text = _("Without any damping in the file shafts have η = {loss}: {source}; it sets the height of the peaks.")
        loss = Quantity(LOSS["shaft"], digits=2, trim=True)
        yield Remark(text=say(text, loss=loss, source=_(SHAFT_SOURCE)))
    undamped = [path.removesuffix(".damping") for path in found.assumed if path.endswith(".damping")]
    if undamped:
        text = _("Assumed: no damping in {paths}; give damping or loss_factor, which set the height of the peaks.")
        yield Remark(text=say(text, paths=", ".join(undamped)))


def unstable(found: Any) -> bool:
    """Tell whether an absorber or a design leaves the drive unstable somewhere in the band."""
    return len(found.unstable_after) > 0 or (found.proof is not None and len(found.proof.lowest) > 0)


def cured(found: Any) -> bool:
    """Tell whether the drive is unstable somewhere in the band as built, and with an absorber or a design nowhere."""
    return len(found.unstable_before) > 0 and not unstable(found) and bool(np.all(np.isfinite(found.after)))


def proof_facts(found: Any) -> dict[str, Any]:
    """Return what a program is told of the proof of an absorber or a design, which leaves out nonsynchronous orders."""
    proof: ProvedSpeeds | None = found.proof
    if proof is None:
        return {"stability_proved": None, "unstable_from": Quantity([], "angular_speed")}
    whole = proof.proved and proof.looked_at and nonsynchronous(found.drive) is None
    return {
        "stability_proved": whole,
        "unstable_from": Quantity(proof.lowest, "angular_speed"),
        "unstable_to": Quantity(proof.highest, "angular_speed"),
    }


def _nonsynchronous(found: Any) -> Iterator[Remark]:
    """Yield how the orders count that no two turns hold a whole number of times, if there are any."""
    orders = nonsynchronous(found.drive)
    if orders is None:
        return
    text = _(
        "Orders that do not repeat within two turns ({orders}) count by the motion with them, and stability at single "
        "speeds is that of this motion."
    )
    if not found.exact:
        text = _(
            "Orders that do not repeat within two turns ({orders}) count to first order at some speeds, as no motion "
            "with them is known there; elsewhere by that motion."
        )
    yield Remark(text=say(text, orders=orders))
    if not found.together:
        text = _("Stability is judged without these orders where how disturbances of that motion grow is not known.")
        yield Remark(text=text)


def _told_apart(speeds: Array) -> Array:
    """Return speeds (k,), rising, without those that read like the one before them: curves look closely at peaks."""
    found: Array = speeds[np.diff(speeds, prepend=-np.inf) > 1e-3 * np.abs(speeds)]
    return found


def _stability(found: Any) -> Iterator[Remark]:
    """Yield where in the band the drive is unstable, and whether the rest of it is proved to be stable."""
    proof: ProvedSpeeds | None = found.proof
    proved = proof is not None and proof.proved and proof.looked_at
    if len(found.unstable_before):
        built = _told_apart(found.unstable_before)
        others = _(" and others") if len(built) > NAMED else ""
        at = Joined([Joined([speed(one, 4) for one in built[:NAMED]]), others], between="")
        text = _("As built the drive is unstable at {speeds}: vibration grows there beyond the torque told of it.")
        yield Remark(text=say(text, speeds=at))
    if unstable(found):
        where: list[Text] = [speed(one) for one in _told_apart(found.unstable_after)[:NAMED]]
        if proof is not None and len(proof.lowest):
            pairs = list(zip(proof.lowest, proof.highest, strict=True))[:NAMED]
            where = [say(_("{low:bare} to {high}"), low=speed(low, 4), high=speed(high, 4)) for low, high in pairs]
        text = _(
            "Warning: not stable everywhere in the band: parametric instability at {speeds}; see cardan torsion "
            "stability."
        )
        if proved and nonsynchronous(found.drive) is None:
            text = _(
                "Warning: not stable everywhere in the band: parametric instability at {speeds}, and proved nowhere "
                "else; see cardan torsion stability."
            )
        yield Remark(text=say(text, speeds=Joined(where)), tone="warning")
        return
    if proof is None:
        if cured(found):
            text = _("Stability was judged at {speed} alone; a little beside it the drive may be unstable.")
            yield Remark(text=say(text, speed=speed(found.speed[0], 4)), tone="warning")
        return
    orders = nonsynchronous(found.drive)
    if proved and orders is not None:
        text = _(
            "Stable throughout the band: proved without the orders that do not repeat within two turns ({orders}); "
            "with them at the speeds looked at."
        )
        yield Remark(text=say(text, orders=orders), tone="good" if found.together else "plain")
        return
    if proved:
        yield Remark(text=_("Stable throughout the band: proved."), tone="good")
        return
    if not proof.looked_at:
        text = _("Stable at the speeds looked at; a proof between them would take too long.")
        yield Remark(text=text)
        return
    pairs = list(zip(*proof.unproved.T.tolist(), strict=True))[:NAMED]
    where = [say(_("{low:bare} to {high}"), low=speed(low, 4), high=speed(high, 4)) for low, high in pairs]
    text = _(
        "Stable at the speeds looked at, but not proved at {where}: backlash opens or friction slips there, or the "
        "margin is small."
    )
    yield Remark(text=say(text, where=Joined(where)), tone="warning")
