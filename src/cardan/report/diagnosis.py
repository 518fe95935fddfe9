"""What a recording of a drive tells: causes by likelihood with what speaks for each, and the pictures behind it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite

from cardan.figures.wording import percent, significant
from cardan.maths.ties import foremost_of
from cardan.questions.diagnosis.examination import Examination
from cardan.questions.diagnosis.expected import Expected
from cardan.questions.diagnosis.figures.examination import LIKELY, causes_figure, examined_map, verdict
from cardan.questions.diagnosis.figures.motion import orbit_figure, rotation_figure, torsional_figure
from cardan.questions.diagnosis.figures.orders import UNITS, quantity_word, spectrum_figure, tracks_figure
from cardan.questions.diagnosis.findings import Finding
from cardan.questions.diagnosis.plant import plant
from cardan.texts import _
from cardan.units import rpm

from .block import Block, Cell, Column, Page, Picture, Points, Table, Tone, Words, key, number, words

MOST = 6
"""Causes in the table."""

EXPLAINED = 3
"""Causes with their evidence, at most."""

SMALL, SERIOUS = 0.02, 0.1
"""Shares of belief below which a cause is not worth a line, and not worth its evidence."""

SURE = 0.6
"""Confidence below which the reader is warned."""


def diagnosed(found: Examination) -> Page:
    """Return the page of a diagnosis.

    Parameters
    ----------
    found : Examination
        As of `cardan.examine`.
    """
    findings = found.findings
    alarms = list(_alarms(findings))
    blocks: list[Block] = [*alarms, Picture(figure=causes_figure(findings)), causes(findings), *evidence(findings)]
    blocks += _cautions(findings)
    blocks += [Picture(figure=examined_map(found)), Picture(figure=spectrum_figure(found.spectrum))]
    blocks.append(Picture(figure=tracks_figure(found.tracks)))
    if found.orbit is not None:
        blocks.append(Picture(figure=orbit_figure(found.orbit)))
    if found.swing is not None:
        blocks.append(Picture(figure=torsional_figure(found.swing)))
    if found.expected is not None:
        blocks.append(should_appear(found.expected, found))
    blocks += [Picture(figure=rotation_figure(found.rotation)), channels(found)]
    return Page(
        name="diagnosis",
        title=_("Diagnosis of {name}").format(name=found.signal.name) if found.signal.name else _("Diagnosis"),
        answer=verdict(findings),
        blocks=blocks,
        keys=[key(_("confidence in the recording"), 100.0 * found.confidence, "%", text=_whole(found.confidence))],
        alarms=alarms,
    )


def diagnosed_by_signs(findings: Sequence[Finding]) -> Page:
    """Return the page of a diagnosis by orders and signs alone.

    Parameters
    ----------
    findings : sequence of Finding
        As of `cardan.diagnose`.
    """
    return Page(
        name="diagnosis",
        title=_("Diagnosis by signs"),
        answer=verdict(findings),
        blocks=[
            *_alarms(findings),
            Picture(figure=causes_figure(findings)),
            causes(findings),
            *evidence(findings),
            *_cautions(findings),
        ],
        alarms=list(_alarms(findings)),
    )


def _alarms(findings: Sequence[Finding]) -> Iterator[Words]:
    """Yield how little a recording can be relied on."""
    confidence = findings[0].confidence
    if confidence < SURE:
        text = _("The answer can be relied on by {share} only; the cautions say why. Check before you repair.")
        yield Words(text=text.format(share=percent(confidence, 2)), tone="warning")


def causes(findings: Sequence[Finding]) -> Table:
    """Return the table of the likeliest causes with what to check and to do.

    Parameters
    ----------
    findings : sequence of Finding
        By falling score.
    """
    shown = [one for k, one in enumerate(findings[:MOST]) if k < 2 or one.score >= SMALL]
    rows = [
        [
            number(str(k + 1)),
            words(one.fault, _tone(one, k)),
            number(_whole(one.score), 100.0 * one.score),
            words(one.check),
            words(one.repair),
        ]
        for k, one in enumerate(shown)
    ]
    note = _("Shares of belief of all causes add up to 100 %; they are calibrated on simulated recordings.")
    return Table(
        title=_("Causes, the likeliest first"),
        columns=(
            Column(heading=""),
            Column(heading=_("cause"), left=True),
            Column(heading=_("belief"), unit="%"),
            Column(heading=_("what to check"), left=True),
            Column(heading=_("how to repair"), left=True),
        ),
        rows=rows,
        note=note,
    )


def _tone(one: Finding, k: int) -> Tone:
    if k or one.score < LIKELY:
        return "plain"
    return "good" if one.cause == "healthy" else "failed" if one.confidence >= SURE else "warning"


def _whole(share: float) -> str:
    return f"{100.0 * share:.0f}"


def evidence(findings: Sequence[Finding]) -> Iterator[Points]:
    """Yield what speaks for and against each of the first causes.

    Parameters
    ----------
    findings : sequence of Finding
        By falling score.
    """
    for k, one in enumerate(findings[:EXPLAINED]):
        if k and one.score < SERIOUS:
            continue
        if one.evidence:
            yield Points(title=_("What speaks for: {fault}").format(fault=one.fault), items=one.evidence)
        if one.against:
            yield Points(title=_("What speaks against: {fault}").format(fault=one.fault), items=one.against)


def _cautions(findings: Sequence[Finding]) -> Iterator[Points]:
    cautions = findings[0].cautions
    if cautions:
        yield Points(title=_("To mind"), items=cautions)


def should_appear(expected: Expected, found: Examination) -> Table:
    """Return the orders that the likeliest cause should make where the shown channel sits, beside the measured ones.

    Parameters
    ----------
    expected : Expected
        Of the likeliest cause.
    found : Examination
        Of the recording.
    """
    unit, size = UNITS[found.channel.quantity]
    top = expected.speed[1]
    base = plant(found.drive)
    kind = (base.housing_at(found.channel.place) or base.housings[-1]).kind
    direction = "axial" if found.channel.direction in ("axial", "x") else "radial"
    lines = [one for one in expected.orders if one.direction == direction and one.kind == kind]
    rows = []
    for order in sorted({one.order for one in lines}):
        own = [one for one in lines if one.order == order]
        level = float(sum(abs(expected.value(one, top, expected.reference)) ** 2 for one in own)) ** 0.5
        per = {"acceleration": 0, "velocity": 1, "displacement": 2}.get(found.channel.quantity, 0)
        level /= (order * top) ** per * size
        seen = found.spectrum.at(order) / size
        strongest = foremost_of(own, lambda one: one.size)
        rows.append(
            [
                number(f"{order:g}", order),
                number(significant(level, 2), level),
                number(significant(seen, 3), seen) if isfinite(seen) else words("–"),
                words(grows(strongest.speed_power, amplified=strongest.amplified)),
                words(by_torque(strongest.torque)),
                words("; ".join(_(part) for part in strongest.source.split("; "))),
            ]
        )
    note = _("At the top speed of {speed} rpm and the torque of the duty; sizes are good to a factor, shapes to more.")
    return Table(
        title=_("What the likeliest cause should show at {name}").format(name=found.channel.name),
        columns=(
            Column(heading=_("order")),
            Column(heading=_("should be about"), unit=unit),
            Column(heading=_("mean of the recording"), unit=unit),
            Column(heading=_("with the speed"), left=True),
            Column(heading=_("with the torque"), left=True),
            Column(heading=_("source"), left=True),
        ),
        rows=rows,
        note=note.format(speed=significant(top / rpm)),
    )


def grows(power: float, *, amplified: bool) -> str:
    """Return how an order follows the speed, in words.

    Parameters
    ----------
    power : float
        Of the speed.
    amplified : bool
        Whether a bending mode amplifies it.

    Examples
    --------
    >>> grows(2.0, amplified=False), grows(0.0, amplified=True)
    ('square', 'stays the same, amplified near the critical speed')
    """
    plain = {0.0: _("stays the same"), 1.0: _("in proportion"), 2.0: _("square")}
    said = plain.get(power, _("power {power:g}").format(power=power))
    return _("{said}, amplified near the critical speed").format(said=said) if amplified else said


def by_torque(share: tuple[float, float, float]) -> str:
    """Return how an order follows the torque, in words.

    Parameters
    ----------
    share : (float, float, float)
        a, b, c of the factor \\|a + bτ + c\\|τ\\|\\|.

    Examples
    --------
    >>> by_torque((1.0, 0.0, 0.0)), by_torque((0.0, 0.0, 1.0)), by_torque((0.2, 0.9, 0.0))
    ('stays the same', 'in proportion', 'changes with its sense')
    """
    still, signed, sized = share
    if signed:
        return _("changes with its sense")
    if not sized:
        return _("stays the same")
    if not still:
        return _("in proportion")
    return _("grows") if sized > 0.0 else _("falls")


def channels(found: Examination) -> Table:
    """Return the table of what the recording holds.

    Parameters
    ----------
    found : Examination
        Of the recording.
    """
    signal = found.signal
    rows: list[list[Cell]] = []
    for k, one in enumerate(signal.channels):
        use = _("tells the speed") if k == signal.tacho else ""
        rows.append(
            [
                words(one.name),
                words(quantity_word(one.quantity)),
                words(one.place or "–"),
                words(one.direction or "–"),
                number(significant(one.rate), one.rate),
                number(significant(one.duration, 3), one.duration),
                number(_whole(one.trust), 100.0 * one.trust, "plain" if one.trust >= SURE else "warning"),
                words(use),
            ]
        )
    return Table(
        title=_("Channels of the recording"),
        columns=(
            Column(heading=_("channel"), left=True),
            Column(heading=_("measures"), left=True),
            Column(heading=_("sits on"), left=True),
            Column(heading=_("looks"), left=True),
            Column(heading=_("rate"), unit="Hz"),
            Column(heading=_("duration"), unit="s"),
            Column(heading=_("trust"), unit="%"),
            Column(heading="", left=True),
        ),
        rows=rows,
    )
