"""What there is to say of a design for least torsional vibration: the best values, what they leave, and why."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from cardan.answers.answer import Answer, Column, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Say, Text, Written, say
from cardan.answers.question import Lacking, absent
from cardan.drive.drive import Drive
from cardan.drive.fields.wording import counted
from cardan.later import later
from cardan.maths.ties import foremost
from cardan.questions.assumed import yokes_estimated
from cardan.questions.torsion.absorber.answer import (
    LITTLE,
    band,
    cautions,
    cured,
    curves,
    proof_facts,
    speed,
    torque,
    unstable,
)
from cardan.questions.torsion.model.answer import lacking as lacking_modes
from cardan.questions.torsion.model.answer import torques_left_out
from cardan.texts import _

from .designs import Free
from .modal_excitation import NodeRule
from .optimise import OptimisedTorsion, Peak, Worst
from .spread import Spread

drawn = later("cardan.questions.torsion.optimise.figure")

AGREE = 0.02
"""Independent searches whose answers differ by no more than this share agree."""

SAME = 0.01
"""What differs by no more than this share is the same."""

NODE = 0.05
"""κ, over the largest that a joint of the mode has, below which a joint stands in the node for what it does."""

CANCELS = 0.2
"""Share of the sum of sizes below which excitations that add with their phases cancel for what they do."""

BENT = 1e-9
"""tan²(α/2) from which a joint excites anything."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks: something that twists, and the speeds in use."""
    duty = drive.duty
    speeds = duty.speed_range is not None or bool(duty.speed)
    return (*lacking_modes(drive), *absent((speeds, "duty.speed_range", "duty.speed")))


def otherwise(_drive: Drive) -> str:
    """Return why nothing can be told although nothing is missing."""
    return _("No yoke of this drive may be turned; cardan torsion optimise --free takes other keys that may change.")


def answer(drive: Drive, result: OptimisedTorsion) -> Answer:
    """Return what there is to say of a design for least torsional vibration."""
    tone, sentence = _sentence(result)
    return Answer(
        name="optimise",
        title=_("Torsional optimisation"),
        sentence=sentence,
        tone=tone,
        tables=(_values(result), _peaks(result)),
        remarks=(*_remarks(result), *torques_left_out(drive), *_elsewhere(drive), *yokes_estimated(drive)),
        figures=lambda: drawn().torsion_design_figures(result),
        facts=_facts(result),
        full=lambda: _curves(result),
    )


def _elsewhere(drive: Drive) -> Iterator[Remark]:
    """Yield what of a drive counts beside its vibration as drawn at its duty."""
    if drive.poses or drive.movements or any(joint.error is not None for joint in drive.joints):
        text = _(
            "Vibration counts for the drive as drawn at its duty; the limits of the file hold in its poses and "
            "movements, and with the errors of its joints as made."
        )
        yield Remark(text=text, code="as_drawn")


def _sentence(result: OptimisedTorsion) -> tuple[Tone, Say]:
    values = {"after": torque(result.peak_after.torque), "band": band(result.speed)}
    drawn = result.worst_after is None
    healed = cured(result)
    if drawn and len(result.unstable_before) and unstable(result):
        text = _("the best values found do not make it stable everywhere; largest alternating torque ±{after}, {band}.")
        return "warning", say(text, **values)
    if drawn and result.reduction > LITTLE and not healed:
        text = _("nothing that may change makes it vibrate much less; largest alternating torque ±{after}, {band}.")
        return "warning", say(text, **values)
    if result.worst_before is not None and result.worst_after is not None:
        before, after = (torque(one.torque) for one in (result.worst_before, result.worst_after))
        if result.worst_after.torque > LITTLE * result.worst_before.torque and not result.worst_before.unstable:
            text = _(
                "within its tolerances nothing that may change makes it vibrate much less; largest alternating torque "
                "±{after}, {band}."
            )
            return "warning", say(text, after=after, band=values["band"])
        text = _("within its tolerances the largest alternating torque falls from ±{before:bare} to ±{after}, {band}.")
        if result.worst_before.unstable:
            text = _("within its tolerances, unstable as built, the largest alternating torque is ±{after}, {band}.")
        said = say(text, before=before, after=after, band=values["band"])
        return "warning" if result.worst_after.unstable or unstable(result) else "good", said
    text = _("the largest alternating torque falls from ±{before:bare} to ±{after} ({share}), {band}.")
    if healed:
        text = _("unstable as built, no more so with the best values; largest alternating torque ±{after}, {band}.")
    share = Quantity(result.reduction, "share", 3)
    tone: Tone = "warning" if unstable(result) or (healed and result.proof is None) else "good"
    return tone, say(text, before=torque(result.peak_before.torque), share=share, **values)


def _values(result: OptimisedTorsion) -> Table:
    free = result.free
    return Table(
        columns=(
            Column(key="path", heading=_("what may change"), values=[_key(one.path) for one in free]),
            Column(key="built", heading=_("as built"), values=[one.built for one in free], digits=5, trim=True),
            Column(
                key="best", heading=_("best"), values=[result.values[one.path] for one in free], digits=5, trim=True
            ),
            Column(key="range", heading=_("range"), values=[_range(one) for one in free], left=True),
        ),
        fixed=0,
    )


def _key(path: str) -> Written:
    """Return a key that may change, whose unit its values have, to whoever reads it."""
    return Written(path, counted(path), counted(path))


def _range(one: Free) -> Say:
    values = {
        name: None if value is None else Quantity(value, digits=6, trim=True)
        for name, value in (("low", one.low), ("high", one.high), ("step", one.step))
    }
    return say(_("{low} … {high}, step {step}") if one.step is not None else "{low} … {high}", **values)


def _peaks(result: OptimisedTorsion) -> Table:
    """Return the largest alternating torque of every element, before and after."""
    most = [
        [int(foremost(curve[:, e])) for e in range(len(result.elements))] for curve in (result.before, result.after)
    ]
    columns = []
    for word, heading, curve, places in (
        ("before", _("as built ±"), result.before, most[0]),
        ("after", _("best ±"), result.after, most[1]),
    ):
        sizes = [float(curve[k, e]) for e, k in enumerate(places)]
        columns += [
            Column(key=word, heading=heading, values=sizes, dimension="torque", digits=3),
            Column(
                key=f"{word}_at",
                heading=_("at"),
                values=[float(result.speed[k]) for k in places],
                dimension="angular_speed",
            ),
        ]
    return Table(
        title=_("Largest alternating torque of every element in the band"),
        columns=(
            Column(key="number", heading=_("no."), values=list(range(1, len(result.elements) + 1))),
            *columns,
            Column(key="element", heading=_("element"), values=list(result.elements), wrap=True),
        ),
    )


def _remarks(result: OptimisedTorsion) -> Iterator[Remark]:
    for text in reasons(result):
        yield Remark(text=text)
    for path in result.at_limits:
        yield Remark(text=say(_("{path} is at the end of its range; a wider one may do more."), path=_key(path)))
    yield from cautions(result)
    yield from _spread_remarks(result)
    if result.infeasible:
        yield Remark(text=say(_("{count} of the values tried make no drive."), count=int(result.infeasible)))
    if len(result.run_peaks) > 1:
        agrees = result.agreement <= AGREE
        text = _("Warning: of {count} designs, two independent searches end {share} apart; take more --rounds.")
        if agrees:
            text = _("Searched {count} designs on the exact equations; two independent searches end within {share}.")
        share = Quantity(max(result.agreement, 1e-3), "share", 2)
        said = say(text, count=int(result.evaluations), share=share)
        yield Remark(text=said, tone="plain" if agrees else "warning")
    else:
        text = _("Searched {count} designs on the exact equations.")
        yield Remark(text=say(text, count=int(result.evaluations)))


def _spread_remarks(result: OptimisedTorsion) -> Iterator[Remark]:
    """Yield what tolerances and limits make of it."""
    worst = result.worst_after
    if worst is not None:
        text = _("As drawn ±{drawn}; at worst within the tolerances ±{worst} at {speed}, with {values}.")
        pairs = [(one, side) for one, side in zip(result.off, worst.sides, strict=True) if side]
        parts: list[Text] = [
            say(
                _("{path} {sign}{size}"),
                path=_key(one.path),
                sign="+" if side > 0.0 else "−",
                size=_off(one, abs(side)),
            )
            for one, side in pairs
        ]
        values = Joined(parts) if parts else _("all values as drawn")
        drawn = torque(result.peak_after.torque)
        yield Remark(
            text=say(text, drawn=drawn, worst=torque(worst.torque), speed=speed(worst.speed, 4), values=values)
        )
        if worst.unstable:
            text = _("Warning: within the tolerances it is unstable at some speeds of the band.")
            yield Remark(text=text, tone="warning", alarm=True)
    if result.limited is not None:
        most = result.limited[1]
        text = _("The limits of the drive file are kept; {share} of the nearest is used.")
        if most > 1.0:
            text = _("Warning: no design keeps the limits of the drive file; {share} of one is used.")
        yield Remark(text=say(text, share=Quantity(most, "share", 3)), tone="plain" if most <= 1.0 else "warning")


def _off(one: Spread, part: float) -> Quantity:
    """Return so much of a tolerance, in the unit of its key."""
    return Quantity(part * one.size, "share" if one.share else "", 3, trim=True)


def reasons(result: OptimisedTorsion) -> tuple[Text, ...]:
    """Return why it vibrates less: what the joints do to each mode now, beside what they did as built."""
    found: list[Text] = []
    for rule in result.rules_after:
        found += rule_reasons(rule)
        old = next((one for one in result.rules_before if one.mode == rule.mode), None)
        if old is not None and old.push > 0.0:
            found += _as_built(old, rule)
    return tuple(found)


def _as_built(old: NodeRule, new: NodeRule) -> list[Text]:
    """Return what a mode was as built, where that was something else."""
    values = {"frequency": Quantity(old.omega, "frequency", 3), "share": Quantity(old.modulation, "share", 2)}
    if old.order != new.order:
        text = _("As built: {frequency}, order {order} excited it most, stiffness modulation of that order {share}.")
        return [say(text, order=Quantity(old.order, trim=True), **values)]
    times = old.push / new.push if new.push > 0.0 else np.inf
    if abs(times - 1.0) > SAME:
        text = _("As built: {frequency}, {times} times this excitation, stiffness modulation {share}.")
        return [say(text, times=Quantity(float(times), digits=3), **values)]
    if abs(old.omega / new.omega - 1.0) > SAME or abs(old.modulation - new.modulation) > SAME * old.modulation:
        return [say(_("As built: {frequency}, stiffness modulation {share}."), **values)]
    return []


def rule_reasons(rule: NodeRule) -> tuple[Text, ...]:
    """Return what the joints do to one mode: where each stands beside the node, and what their phases leave."""
    return tuple(_rule_reasons(rule))


def _rule_reasons(rule: NodeRule) -> Iterator[Text]:
    order = Quantity(rule.order, trim=True)
    named = {"mode": rule.mode, "frequency": Quantity(rule.omega, "frequency", 3)}
    bent = np.flatnonzero(rule.joint_angle_share > BENT)
    if not bent.size:
        yield say(_("Mode {mode} at {frequency}: no joint changes the speed, so nothing excites it."), **named)
        return
    text = _(
        "Mode {mode} at {frequency}: order {order} excites it at {speed}, and parametric resonance of that order is at "
        "{zone}."
    )
    at, zone = speed(rule.omega / rule.order, 4), speed(2.0 * rule.omega / rule.order, 4)
    yield say(text, **named, order=order, speed=at, zone=zone)
    if rule.others:
        text = _("Joints excite it at other orders too; what follows is of order {order} alone.")
        yield say(text, order=order)
    size = np.abs(rule.parametric)
    whole = float(np.sum(size))
    largest = float(np.max(np.abs(rule.kappa[bent])))
    for k in bent:
        if abs(rule.kappa[k]) <= max(NODE * largest, 1e-6):
            text = _("Joint {joint} stands in the node of the mode: it causes no parametric excitation.")
            yield say(text, joint=int(k) + 1)
            continue
        text = _("Joint {joint} stands {where} (κ = {kappa}): {share} of the parametric excitation.")
        kappa = Quantity(float(rule.kappa[k]), digits=3)
        share = Quantity(float(size[k]) / (whole or 1.0), "share", decimals=0)
        yield say(text, joint=int(k) + 1, where=_where(rule, int(k)), kappa=kappa, share=share)
    if whole > 0.0:
        text = _("Its stiffness modulation, {share}, is below the {limit} from which it is unstable.")
        if rule.grows:
            text = _("Its stiffness modulation, {share}, is above the {limit} from which it is unstable.")
        share, limit = Quantity(rule.modulation, "share", 2), Quantity(2.0 * rule.damping_ratio, "share", 2)
        yield say(text, share=share, limit=limit)
    if bent.size == 1:
        yield say(_("Its excitation of order {order} stands alone: no other joint can cancel it."), order=order)
    elif rule.left < CANCELS:
        text = _("The excitations of order {order} cancel; residual {left} of the in-phase sum.")
        yield say(text, order=order, left=Quantity(rule.left, "share", 2))
    else:
        text = _("The excitations of order {order} add up to {left} of the in-phase sum.")
        yield say(text, order=order, left=Quantity(rule.left, "share", decimals=0))
    if np.isfinite(rule.resonance_torque):
        text = _("By this mode alone the alternating torque is ±{torque} where order {order} excites it.")
        yield say(text, order=order, torque=torque(rule.resonance_torque))


def _where(rule: NodeRule, joint: int) -> str:
    """Return where a joint stands beside the nearest node."""
    if not rule.nodes:
        return _("away from the node")
    nearest = min(rule.nodes, key=lambda at: abs(at - rule.position[joint]))
    way = rule.position[joint] - nearest
    return _("behind the node") if way > 0.0 else _("before the node")


def _facts(result: OptimisedTorsion) -> dict[str, Any]:
    return {
        "free": [
            {"path": one.path, "low": one.low, "high": one.high, "step": one.step, "built": one.built}
            for one in result.free
        ],
        "values": dict(result.values),
        "before": _peak(result, result.peak_before),
        "after": _peak(result, result.peak_after),
        "reduction": result.reduction,
        "elements": list(result.elements),
        "unstable_before": Quantity(result.unstable_before, "angular_speed"),
        "unstable_after": Quantity(result.unstable_after, "angular_speed"),
        **proof_facts(result),
        "modes_before": [_rule(one) for one in result.rules_before],
        "modes_after": [_rule(one) for one in result.rules_after],
        "why": list(reasons(result)),
        "evaluations": result.evaluations,
        "infeasible": result.infeasible,
        "run_peaks": Quantity(result.run_peaks, "torque"),
        "history": Quantity([one.tolist() for one in result.history], "torque"),
        "converged": result.converged,
        "cancelled": result.cancelled,
        "backlash_closed": result.play,
        "at_limits": list(result.at_limits),
        "tolerances": [{"path": one.path, "size": one.size, "share": one.share} for one in result.off],
        "worst_before": _worst(result, result.worst_before),
        "worst_after": _worst(result, result.worst_after),
        "limits_used": None if result.limited is None else result.limited[1],
        "assumed": list(result.assumed),
    }


def _peak(result: OptimisedTorsion, one: Peak) -> dict[str, Any]:
    return {
        "alternating_torque": Quantity(one.torque, "torque"),
        "at": Quantity(one.speed, "angular_speed"),
        "element": result.elements[one.element],
    }


def _worst(result: OptimisedTorsion, one: Worst | None) -> dict[str, Any] | None:
    if one is None:
        return None
    peak = Peak(torque=one.torque, speed=one.speed, element=one.element)
    return {**_peak(result, peak), "sides": list(one.sides), "unstable": one.unstable}


def _rule(one: NodeRule) -> dict[str, Any]:
    return {
        "mode": one.mode,
        "frequency": Quantity(one.omega, "frequency"),
        "joint_weight": one.kappa,
        "modulation": one.modulation,
        "damping_ratio": one.damping_ratio,
        "excitation_left": one.left,
        "resonance_torque": Quantity(one.resonance_torque, "torque"),
    }


def _curves(result: OptimisedTorsion) -> Table:
    """Return the curves over the speed."""
    return Table(name="curves", columns=curves(result.speed, [("before", result.before), ("after", result.after)]))
