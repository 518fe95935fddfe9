"""What there is to say of a diagnosis: causes by probability, what speaks for each, what to check and to do."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite
from typing import Any

from cardan.answers.answer import Answer, Cell, Column, KeyFigure, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.texts import _

from .drive_model import plant
from .examination import Examination
from .expected import Expected
from .fault_answer import by_torque, grows
from .figures.orders import DIMENSIONS, amplitude_of, order_text, quantity_word
from .figures.signals import LIKELY, causes_figure, examination_figures, verdict
from .findings import Finding
from .match import Signs

__all__ = ["answer", "answer_of_signs"]

SHOWN = 6  # causes in the table
LINES = 4  # orders named of a channel
EXPLAINED = 3  # causes with their evidence, at most
SMALL, SERIOUS = 0.02, 0.1  # probabilities below which a cause is not worth a line, and not worth its evidence
SURE = 0.6  # confidence below which the reader is warned


def answer(found: Examination) -> Answer:
    """Return what there is to say of a recording of a drive. found: as of `cardan.recordings.examine`."""
    findings = found.findings
    title = _("Diagnosis of {name}").format(name=found.signal.name) if found.signal.name else _("Diagnosis")
    shows = () if found.expected is None else (_should_appear(found.expected, found),)
    return Answer(
        name="diagnosis",
        title=title,
        sentence=verdict(findings),
        tone=_tone(findings),
        tables=(_causes(findings), *_evidence(findings), _orders(found), *shows, _channels(found)),
        remarks=(*_first(findings), *_recording(found), *_cautions(findings)),
        keys=(_confidence(found.confidence),),
        figures=lambda: examination_figures(found),
        facts=_facts(found),
        full=lambda: _everything(findings),
        code=1 if _tone(findings) == "failed" else 0,
    )


def answer_of_signs(signs: Signs, findings: Sequence[Finding]) -> Answer:
    """Return what there is to say of orders and symptoms alone."""
    return Answer(
        name="diagnosis",
        title=_("Diagnosis by signs"),
        sentence=verdict(findings),
        tables=(_causes(findings), *_evidence(findings)),
        remarks=(*_first(findings), *_doubt(findings), *_cautions(findings)),
        figures=lambda: (causes_figure(findings),),
        facts={
            "orders": list(signs.orders),
            "torque_sensitive": signs.torque_sensitive,
            "symptom": signs.symptom,
            **_found(findings),
        },
        full=lambda: _everything(findings),
    )


def _tone(findings: Sequence[Finding]) -> Tone:
    first = findings[0]
    if first.score < LIKELY:
        return "warning"
    return "good" if first.cause == "healthy" else "failed"


def _share(value: float) -> Quantity:
    return Quantity(value, "share", decimals=0)


def _confidence(confidence: float) -> KeyFigure:
    title = _("confidence in the recording")
    return KeyFigure(name="confidence", title=title, value=_share(confidence), better="more")


def _causes(findings: Sequence[Finding]) -> Table:
    """Return the likeliest causes with what to check and to do."""
    shown = [one for k, one in enumerate(findings[:SHOWN]) if k < 2 or one.score >= SMALL]
    faults = [Cell(value=one.fault, tone=_cause_tone(one, k)) for k, one in enumerate(shown)]
    return Table(
        title=_("Causes, the likeliest first"),
        columns=(
            Column(key="probability", heading=_("probability"), values=[one.score for one in shown],
                   dimension="share", decimals=0),
            Column(key="fault", heading=_("cause"), values=faults, left=True, wrap=True),
            Column(key="check", heading=_("what to check"), values=[one.check for one in shown], depth="full"),
            Column(key="repair", heading=_("how to repair"), values=[one.repair for one in shown], depth="full"),
        ),
        note=_("The probabilities of all causes add up to 100 %; they are calibrated on simulated recordings."),
    )  # fmt: skip


def _cause_tone(one: Finding, k: int) -> Tone:
    if k or one.score < LIKELY:
        return "plain"
    return "good" if one.cause == "healthy" else "failed" if one.confidence >= SURE else "warning"


def _everything(findings: Sequence[Finding]) -> Table:
    """Return every cause."""
    return Table(
        columns=(
            Column(key="rank", values=list(range(1, len(findings) + 1))),
            Column(key="cause", values=[one.cause for one in findings]),
            Column(key="fault", values=[one.fault for one in findings]),
            Column(key="probability", values=[one.score for one in findings], dimension="share"),
            Column(key="confidence", values=[one.confidence for one in findings], dimension="share"),
            Column(key="check", values=[one.check for one in findings]),
            Column(key="repair", values=[one.repair for one in findings]),
        )
    )


def _evidence(findings: Sequence[Finding]) -> Iterator[Table]:
    """Yield what speaks for and against each of the first causes; people at a terminal read that of the first."""
    for k, one in enumerate(findings[:EXPLAINED]):
        sides = [*((_("for"), text) for text in one.evidence), *((_("against"), text) for text in one.against)]
        if not sides or (k and one.score < SERIOUS):
            continue
        yield Table(
            title=_("What speaks for and against: {fault}").format(fault=one.fault),
            columns=(
                Column(key="", values=[side for side, _text in sides], left=True),
                Column(key="", values=[text for _side, text in sides], left=True, wrap=True),
            ),
            depth="full" if k else "brief",
        )


def _orders(found: Examination) -> Table:
    """Return the highest orders of every channel that shakes."""
    places = {one.name: one.place for one in found.signal.channels}
    lines: list[Text] = []
    for one in found.spectra:
        peaks = [
            say(_("order {order}: {amplitude}"), order=order_text(order), amplitude=amplitude_of(one.quantity, high))
            for order, high in one.peaks(count=LINES)
        ]
        lines.append(Joined(peaks, between="; ") if peaks else _("none"))
    return Table(
        title=_("Highest orders of every channel, peak amplitudes"),
        columns=(
            Column(key="channel", heading=_("channel"), values=[one.name for one in found.spectra], left=True),
            Column(
                key="place",
                heading=_("sits on"),
                values=[places.get(one.name, "") or None for one in found.spectra],
                left=True,
            ),
            Column(key="", heading=_("its highest orders"), values=lines, left=True, wrap=True),
        ),
    )


def _should_appear(expected: Expected, found: Examination) -> Table:
    """Return the orders that the likeliest cause should make where the shown channel sits, beside the measured ones."""
    quantity, top, base = found.channel.quantity, expected.speed[1], plant(found.drive)
    kind = (base.housing_at(found.channel.place) or base.housings[-1]).kind
    direction = "axial" if found.channel.direction in ("axial", "x") else "radial"
    lines = [one for one in expected.orders if one.direction == direction and one.kind == kind]
    orders = sorted({one.order for one in lines})
    own = [[one for one in lines if one.order == order] for order in orders]
    per = {"acceleration": 0, "velocity": 1, "displacement": 2}.get(quantity, 0)
    levels = [
        float(sum(abs(expected.value(one, top, expected.reference)) ** 2 for one in some)) ** 0.5 / (order * top) ** per
        for order, some in zip(orders, own, strict=True)
    ]
    seen = [float(found.spectrum.at(order)) for order in orders]
    strongest = [max(some, key=lambda one: one.size) for some in own]
    dimension, unit = DIMENSIONS[quantity]
    text = _("At the top speed of {speed} and the torque of the duty; order-of-magnitude, trends are more reliable.")
    return Table(
        title=_("What the likeliest cause should show at {name}").format(name=found.channel.name),
        columns=(
            Column(key="order", heading=_("order"), values=[f"{order:g}" for order in orders]),
            Column(key="expected", heading=_("should be about"), values=levels, dimension=dimension, unit=unit,
                   digits=2),
            Column(key="measured", heading=_("mean of the recording"),
                   values=[value if isfinite(value) else None for value in seen], dimension=dimension, unit=unit,
                   digits=3),
            Column(key="", heading=_("with the speed"), left=True,
                   values=[grows(one.speed_power, amplified=one.amplified) for one in strongest]),
            Column(key="", heading=_("with the torque"), left=True,
                   values=[by_torque(one.torque) for one in strongest]),
            Column(key="", heading=_("source"), left=True,
                   values=["; ".join(_(part) for part in one.source.split("; ")) for one in strongest]),
        ),
        note=say(text, speed=Quantity(top, "angular_speed")),
        depth="full",
    )  # fmt: skip


def _channels(found: Examination) -> Table:
    """Return what the recording holds."""
    signal = found.signal
    own = signal.channels
    trust: list[Cell] = [Cell(value=one.trust, tone="plain" if one.trust >= SURE else "warning") for one in own]
    return Table(
        title=_("Channels of the recording"),
        columns=(
            Column(key="channel", heading=_("channel"), values=[one.name for one in own], left=True),
            Column(key="", heading=_("measures"), values=[quantity_word(one.quantity) for one in own], left=True),
            Column(key="place", heading=_("sits on"), values=[one.place or None for one in own], left=True),
            Column(key="direction", heading=_("looks"), values=[one.direction or None for one in own], left=True),
            Column(key="rate", heading=_("rate"), values=[1.0 * one.rate for one in own], dimension="sampling_rate"),
            Column(key="duration", heading=_("duration"), values=[one.duration for one in own], dimension="time",
                   digits=3),
            Column(key="trust", heading=_("trust"), values=trust, dimension="share", decimals=0),
            Column(key="", left=True,
                   values=[_("tells the speed") if k == signal.tacho else "" for k in range(len(own))]),
        ),
        depth="full",
    )  # fmt: skip


def _first(findings: Sequence[Finding]) -> Iterator[Remark]:
    """Yield what to check and to do for the first cause."""
    first = findings[0]
    yield Remark(text=_("Check: {text}").format(text=_ended(first.check)))
    yield Remark(text=_("Repair, once that is proved: {text}").format(text=_ended(first.repair)))


def _ended(text: str) -> str:
    return text if text.endswith((".", "?", "!")) else f"{text}."


def _recording(found: Examination) -> Iterator[Remark]:
    """Yield how the shaft turned, and how far the recording can be relied on."""
    low, high = (Quantity(one, "angular_speed", 3) for one in found.rotation.speeds)
    texts = {
        "pulses": _("The shaft made {turns} turns from {low:bare} to {high}, by the pulses of the tacho."),
        "speed": _("The shaft made {turns} turns from {low:bare} to {high}, by a channel of the speed."),
        "angle": _("The shaft made {turns} turns from {low:bare} to {high}, by a channel of the angle."),
        "ridge": _("The shaft made {turns} turns from {low:bare} to {high}, as far as its vibration tells."),
    }
    turns = Quantity(found.rotation.turns, decimals=0)
    yield Remark(text=say(texts[found.rotation.source], turns=turns, low=low, high=high))
    if found.confidence >= SURE:
        yield Remark(text=say(_("Confidence in the recording: {share}."), share=_share(found.confidence)))
    yield from _doubt(found.findings)


def _doubt(findings: Sequence[Finding]) -> Iterator[Remark]:
    """Yield how little a recording can be relied on."""
    confidence = findings[0].confidence
    if confidence < SURE:
        text = _("The answer can be relied on by {share} only; the cautions say why; check before you repair.")
        yield Remark(text=say(text, share=_share(confidence)), tone="warning", alarm=True)


def _cautions(findings: Sequence[Finding]) -> Iterator[Remark]:
    yield from (Remark(text=one, tone="warning") for one in findings[0].cautions)


def _facts(found: Examination) -> dict[str, Any]:
    shaft = found.rotation
    return {
        "drive": found.drive.name,
        "signal": found.signal.name,
        **_found(found.findings),
        "rotation": {
            "source": shaft.source,
            "confidence": shaft.confidence,
            "turns": shaft.turns,
            "speeds": Quantity(list(shaft.speeds), "angular_speed"),
            "alternatives": [{"factor": factor, "share": share} for factor, share in shaft.alternatives],
        },
        "critical_speed": Quantity(found.critical, "angular_speed"),
        "shown": found.channel.name,
        "channels": [
            {
                "name": one.name,
                "quantity": one.quantity,
                "place": one.place,
                "direction": one.direction,
                "rate": Quantity(one.rate, "sampling_rate"),
                "duration": Quantity(one.duration, "time"),
                "trust": one.trust,
                "tacho": k == found.signal.tacho,
            }
            for k, one in enumerate(found.signal.channels)
        ],
        "orders": [
            {
                "channel": one.name,
                "quantity": one.quantity,
                "peaks": [
                    {"order": order, "amplitude": amplitude_of(one.quantity, high)} for order, high in one.peaks()
                ],
            }
            for one in found.spectra
        ],
    }


def _found(findings: Sequence[Finding]) -> dict[str, Any]:
    return {
        "confidence": findings[0].confidence,
        "cautions": list(findings[0].cautions),
        "causes": [
            {
                "cause": one.cause,
                "fault": one.fault,
                "probability": Quantity(one.score, "share"),
                "evidence": list(one.evidence),
                "against": list(one.against),
                "check": one.check,
                "repair": one.repair,
            }
            for one in findings
        ],
    }
