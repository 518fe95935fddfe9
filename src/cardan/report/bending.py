"""At which speeds the shafts whirl, and how far the drive stays away."""

from __future__ import annotations

import math
from collections.abc import Iterator

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.figures.wording import fixed, significant
from cardan.formulas.critical_speed import ARTICLE, CATALOGUE
from cardan.questions.bending.bending import CriticalSpeeds, Part, Running, bending_speeds
from cardan.questions.bending.figures.bending import said, sentence, shapes_figure, speeds_figure
from cardan.texts import _
from cardan.units import mm, rpm

from .balance import checks, refused
from .block import Block, Cell, Column, Page, Picture, Table, Tone, Words, number, of_shaft, words
from .lacking import of_bending
from .subject import Subject

MESH = 2e-3
"""Share by which finite elements, a few dozen of them, may differ from the exact transfer matrices."""


def whirling(on: Subject) -> Page | None:
    """Return the page of the critical speeds; None where the file leaves out bodies of shafts or all bearings."""
    drive = on.drive
    if of_bending(drive):
        return None
    title = _("Critical speeds")
    try:
        found = bending_speeds(drive)
    except InputError as error:
        return refused("bending", title, error)
    answer = sentence(found)
    alarms = list(_alarms(found))
    blocks: list[Block] = [
        *alarms,
        Picture(figure=speeds_figure(found)),
        _modes(found),
        Picture(figure=shapes_figure(found)),
        _shafts(drive, found),
        *_held(found),
        _checks(found),
    ]
    return Page(name="bending", title=title, answer=answer, blocks=blocks, keys=list(_keys(found)), alarms=alarms)


def _alarms(found: CriticalSpeeds) -> Iterator[Words]:
    """Yield what the reader must not overlook."""
    margin = found.margin
    if margin is not None and found.bowing is not None and margin.violated:
        speed, ratio = significant(margin.actual / rpm), significant(margin.ratio, 3)
        text = _(
            "Critical speed: {part} at {speed} rpm, {ratio} times the highest speed in use; it should be 1.6 times."
        )
        if found.status == Running.BEYOND:
            text = _("Critical speed: {part} at {speed} rpm, {ratio} times the highest speed in use: it is reached.")
        yield Words(text=text.format(part=said(found.bowing), speed=speed, ratio=ratio), tone="failed")
    for k, part in enumerate(found.part):
        if found.crossed[k] and part.kind == "support":
            text = _("The drive passes {speed} rpm, where {part}: its rubber has to damp that.")
            speed = significant(float(found.actual[k]) / rpm)
            yield Words(text=text.format(speed=speed, part=said(part)), tone="warning")
        if found.half_crossed[k] and part.kind == "shaft":
            low, high = (significant(float(speed) / rpm) for speed in found.half_band[k])
            text = _("From {low} to {high} rpm, half a critical speed, the joints push twice a turn where {part}.")
            yield Words(text=text.format(low=low, high=high, part=said(part)), tone="warning")


def _keys(found: CriticalSpeeds) -> Iterator[list[Cell]]:
    if found.bowing is None:
        return
    margin = found.margin
    name = _("critical speed, {part}").format(part=said(found.bowing))
    actual = margin.actual if margin else float(found.actual[found.deciding or 0])
    if margin is None:
        yield [
            words(name),
            number(significant(actual / rpm), actual / rpm),
            words(_("rpm")),
            words("–"),
            words("–"),
            words(""),
        ]
        return
    limit = ARTICLE * margin.most
    use = limit / actual
    tone: Tone = "failed" if margin.violated else "warning" if use >= 0.9 else "good"
    verdict = {"failed": _("too low"), "warning": _("near the limit"), "good": _("passed")}[tone]
    yield [
        words(name),
        number(significant(actual / rpm), actual / rpm),
        words(_("rpm")),
        number(f"≥ {significant(limit / rpm)}", limit / rpm),
        number(fixed(use, 2), use),
        words(verdict, tone),
    ]


def _modes(found: CriticalSpeeds) -> Table:
    rows = []
    for k, part in enumerate(found.part):
        low, high = found.half_band[k] / rpm
        over = None if found.used is None else float(found.actual[k]) / found.used[1]
        rows.append(
            [
                number(str(k + 1)),
                words(said(part)),
                number(significant(float(found.speed[k]) / rpm), float(found.speed[k]) / rpm),
                number(fixed(float(found.wear[k]), 2), float(found.wear[k])),
                number(significant(float(found.actual[k]) / rpm), float(found.actual[k]) / rpm, _tone(found, k, part)),
                words("–") if over is None else number(significant(over, 3), over),
                number(f"{significant(float(low))} … {significant(float(high))}"),
                number(significant(float(found.at_rest[k]) / rpm), float(found.at_rest[k]) / rpm),
            ]
        )
    return Table(
        title=_("Critical speeds, the lowest first"),
        columns=(
            Column(heading=_("mode")),
            Column(heading=_("what moves"), left=True),
            Column(heading=_("computed"), unit="rpm"),
            Column(heading="k_n"),
            Column(heading=_("real"), unit="rpm"),
            Column(heading=_("over the highest in use")),
            Column(heading=_("half of it ± 8 %"), unit="rpm"),
            Column(heading=_("at rest"), unit="1/min"),
        ),
        rows=rows,
        note=_(
            "The real shaft whirls at k_n times the computed speed; at rest a tap shows the natural frequency. Makers "
            "allow {automotive} % of the computed critical speed in vehicles and {industrial} % in industry."
        ).format(automotive=f"{100 * CATALOGUE['automotive']:g}", industrial=f"{100 * CATALOGUE['industrial']:g}"),
    )


def _tone(found: CriticalSpeeds, k: int, part: Part) -> Tone:
    if found.crossed[k]:
        return "warning" if part.kind == "support" else "failed"
    if k == found.deciding and found.margin is not None:
        return "failed" if found.margin.violated else "good"
    return "plain"


def _shafts(drive: Drive, found: CriticalSpeeds) -> Table:
    rows = []
    for shaft, span, alone in zip(drive.shafts, found.shaft_span, found.alone, strict=True):
        if math.isnan(span[0]):
            continue
        length = float(span[1] - span[0]) / mm
        rows.append(
            [
                of_shaft(shaft.number, shaft.name),
                number(significant(length), length),
                words("–") if math.isnan(alone) else number(significant(float(alone) / rpm), float(alone) / rpm),
            ]
        )
    return Table(
        title=_("Each shaft by itself"),
        columns=(
            Column(heading=_("shaft"), left=True),
            Column(heading=_("length"), unit="mm"),
            Column(heading=_("uniform between its joints, Book (257)"), unit="rpm"),
        ),
        rows=rows,
        note=_(
            "The formula knows neither yokes and forged ends nor shear, spin and soft bearings: for comparison only."
        ),
    )


def _held(found: CriticalSpeeds) -> Iterator[Words]:
    if found.held:
        text = _("Joints held by the machines, whose own shafts are not described here: {which}.")
        yield Words(text=text.format(which=", ".join(str(number) for number in found.held)))


def _checks(found: CriticalSpeeds) -> Table:
    return checks(
        [
            (
                _("critical speeds"),
                _("finite elements against transfer matrices, over the speed"),
                found.residual,
                MESH,
            ),
            (
                _("number of modes"),
                _("count of the transfer matrices below the last one (Wittrick and Williams) less those found"),
                float(found.missed),
                0.0,
            ),
        ]
    )
