"""What there is to say of critical speeds: where the shafts whirl, what moves there, how far the drive stays away."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import FILE, Answer, Cell, Column, KeyFigure, Remark, Table, Tone
from cardan.answers.quantity import Joined, Quantity, Text, Written, numbered, say
from cardan.answers.question import Lacking, absent
from cardan.answers.sweepable import MODES, OutputColumn, SweepQuestion, each, first
from cardan.drive.body import pieces
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import spelled
from cardan.drive.fields.wording import key_text, part_number
from cardan.drive.yokes import unweighed
from cardan.formulas.critical_speed import CATALOGUE, PRACTICE
from cardan.formulas.damping import LOSS
from cardan.questions.assumed import yokes_estimated
from cardan.questions.mobility.drive_mechanism import unheld
from cardan.texts import _, mark, plural

from .bending import CriticalSpeedMap, CriticalSpeeds, Part, Running, over_movement
from .bending import bending_speeds as ask
from .figure import bending_figures, mode_name, speed_map_figures, tone_of_mode

__all__ = ["COLUMNS", "answer", "answer_of_map", "ask", "lacking", "over_movement"]

MESH = 2e-3
"""Share by which finite elements, a few dozen of them, may differ from the exact transfer matrices."""

EQUAL = 0.01
"""Difference of the critical speeds about the axes of a tube below which it is as stiff about both."""

LONG = 1.5
"""Distance of joints [m] above which two pieces are advised."""

SHOWN = 13
"""Values of the map that people are shown."""

CLOSE = 0.9
"""Share of a limit from which it is near."""


def lacking(drive: Drive) -> Lacking:
    """Return what the drive file lacks for its critical speeds."""
    held = {support.shaft for support in drive.supports}
    ends = [shaft for shaft in (drive.shafts[0], drive.shafts[-1]) if shaft.has_body and shaft.number in held]
    between = drive.shafts[1:-1]
    bodies = tuple(
        (f"shafts[{shaft.number - 1}].outer", f"shafts[{shaft.number - 1}].segments")
        for shaft in between
        if not shaft.has_body
    )
    if not between:
        return absent((bool(ends), "shafts[0].outer"), (bool(ends) or bool(held), "supports"))
    return (*bodies, *absent((bool(drive.supports) or len(between) == 1, "supports")))


def answer(drive: Drive, result: CriticalSpeeds) -> Answer:
    """Return what there is to say of the critical speeds of a drive."""
    broken = bool(result.margin and result.margin.violated)
    minded = broken or bool(result.half_crossed.any()) or bool(result.crossed.any())
    clear: Tone = "plain" if result.status == Running.UNKNOWN else "good"
    return Answer(
        name="bending",
        title=_("Bending critical speeds"),
        sentence=_sentence(drive, result),
        tone="failed" if result.failed else "warning" if minded else clear,
        tables=(_modes(drive, result), _shafts(drive, result)),
        remarks=(*_remarks(drive, result), _next()),
        keys=tuple(_keys(drive, result)),
        figures=lambda: bending_figures(result),
        facts=_facts(drive, result),
        full=lambda: _everything(result),
        code=int(result.failed),
    )


def answer_of_map(drive: Drive, result: CriticalSpeeds, varied: CriticalSpeedMap) -> Answer:
    """Return what there is to say of critical speeds over the stiffness of a support or the length of a shaft."""
    whole = answer(drive, result)
    step = max(1, (len(varied.value) - 1) // (SHOWN - 1))
    rows = slice(None, None, step)
    things = drive.supports if varied.over == "stiffness" else drive.shafts
    text = _("Critical speeds over the stiffness of support {which}")
    if varied.over != "stiffness":
        text = _("Critical speeds over the length of shaft {which}")
    title = text.format(which=numbered(varied.number, things[varied.number - 1].name))
    return Answer(
        name="bending",
        title=whole.title,
        sentence=whole.sentence,
        tone=whole.tone,
        tables=(_map(varied, rows, name="", title=title),),
        remarks=tuple(_remarks(drive, result)),
        keys=whole.keys,
        figures=lambda: (*bending_figures(result), *speed_map_figures(varied)),
        facts=whole.facts,
        full=lambda: _map(varied, slice(None), name="map"),
        code=whole.code,
    )


def _speed(value: float) -> Quantity:
    return Quantity(float(value), "angular_speed")


def _named(drive: Drive, part: Part) -> str:
    """Return the name of a mode, with that of the part which the file gives."""
    things: Any = drive.supports if part.kind == "support" else drive.shafts
    return mode_name(part, things[part.number - 1].name)


def _sentence(drive: Drive, result: CriticalSpeeds) -> Text:
    first, margin = _named(drive, result.part[0]), result.margin
    if margin is None:
        text = _("the first critical speed is {speed}, {part}.")
        return say(text, speed=_speed(result.actual[0]), part=first)
    if result.status == Running.NEAR:
        k, speed, half = _nearest(result)
        text = _("{held} is held at {ratio} of the critical speed {speed}, {part}: too near.")
        if half:
            text = _("{held} is held at {ratio} of half the critical speed {speed}, {part}: too near.")
        critical = float(result.actual[k])
        ratio = Quantity(speed / critical * (2.0 if half else 1.0), digits=3)
        return say(text, held=_speed(speed), ratio=ratio, speed=_speed(critical), part=_named(drive, result.part[k]))
    text = {
        Running.CLEAR: _("{part} at {speed}, {ratio} times the highest speed in use: far enough."),
        Running.CLOSE: _("{part} at {speed}, only {ratio} times the highest speed in use."),
        Running.BEYOND: _("{part} at {speed}, {ratio} times the highest speed in use: it is reached."),
    }[result.status]
    part = _named(drive, result.bowing) if result.bowing else first
    return say(text, part=part, speed=_speed(margin.actual), ratio=Quantity(margin.ratio, digits=3))


def _nearest(result: CriticalSpeeds) -> tuple[int, float, bool]:
    """Return of modes too near to a held speed the nearest, that speed, and whether half the critical one meets it."""
    found = [
        (abs(math.log(speed / middle)), k, speed, half)
        for half, near, middles in ((False, result.near, result.actual), (True, result.half_near, 0.5 * result.actual))
        for k, middle in enumerate(middles)
        if near[k]
        for speed in result.steady
    ]
    _off, k, speed, half = min(found)
    return k, speed, half


def _modes(drive: Drive, result: CriticalSpeeds) -> Table:
    actual = [Cell(value=float(speed), tone=tone_of_mode(result, k)) for k, speed in enumerate(result.actual)]
    over = [None if result.used is None else float(speed) / result.used[1] for speed in result.actual]
    band = [say("{low:bare} … {high}", low=_speed(low), high=_speed(high)) for low, high in result.half_band]
    return Table(
        title=_("Critical speeds, the lowest first"),
        columns=(
            Column(key="", heading=_("no."), values=list(range(1, len(result.part) + 1))),
            Column(key="", heading=_("mode"), values=[mode_name(part) for part in result.part]),
            Column(key="critical", heading=_("computed"), values=result.speed, dimension="angular_speed"),
            Column(key="wear_factor", heading="k_n", values=result.wear, decimals=2),
            Column(key="actual", heading=_("real"), values=actual, dimension="angular_speed"),
            Column(key="ratio", heading=_("margin n_crit/n"), values=over, digits=3),
            Column(key="half", heading=_("half-critical"), values=0.5 * result.actual, dimension="angular_speed"),
            Column(key="half_band", heading=_("half-critical band"), values=band, depth="full"),
            Column(
                key="at_rest", heading=_("not rotating"), values=result.at_rest, dimension="frequency", unit="per_min"
            ),
        ),
        note=say(
            _(
                "The real shaft whirls at k_n times the computed speed; not rotating, a tap shows the natural "
                "frequency. Makers allow {automotive} of the computed critical speed in vehicles and {industrial} in "
                "industry."
            ),
            automotive=Quantity(CATALOGUE["automotive"], "share", trim=True),
            industrial=Quantity(CATALOGUE["industrial"], "share", trim=True),
        ),
    )


def _shafts(drive: Drive, result: CriticalSpeeds) -> Table:
    """Return each shaft by itself as a plain tube, and in the line."""
    known = [shaft for shaft in drive.shafts if not math.isnan(result.shaft_span[shaft.number - 1][0])]
    spans = [result.shaft_span[shaft.number - 1] for shaft in known]
    own: list[float | None] = []
    for shaft in known:
        speeds = (
            float(result.actual[k])
            for k, part in enumerate(result.part)
            if part.kind == "shaft" and part.number == shaft.number
        )
        own.append(next(speeds, None))
    alone = [float(result.alone[shaft.number - 1]) for shaft in known]
    return Table(
        title=_("Each shaft by itself"),
        aside=True,
        columns=(
            Column(key="", heading=_("shaft"), values=[f"{shaft.number} {shaft.name}".strip() for shaft in known]),
            Column(key="", heading=_("length"), values=[float(b - a) for a, b in spans], dimension="length"),
            Column(key="", heading=_("as a plain tube"), values=alone, dimension="angular_speed"),
            Column(key="", heading=_("in the line, real"), values=own, dimension="angular_speed"),
        ),
        note=_(
            "The formula of the plain tube, Kozhevnikov & Perfil'ev (1978), eq. 257, ignores yokes, forged "
            "ends, shear, spin and soft bearings."
        ),
    )


def _map(varied: CriticalSpeedMap, rows: slice, *, name: str, title: str = "") -> Table:
    """Return the critical speeds over what varies."""
    stiff = varied.over == "stiffness"
    first = Column(
        key="stiffness" if stiff else "length",
        heading=_("stiffness") if stiff else _("length"),
        values=np.asarray(varied.value)[rows],
        dimension="stiffness" if stiff else "length",
        unit="N_per_mm" if stiff else "",
    )
    modes = (
        Column(
            key=f"critical_{k}", heading=_("mode {number}").format(number=k), values=speeds, dimension="angular_speed"
        )
        for k, speeds in enumerate(np.asarray(varied.speed)[rows].T, start=1)
    )
    return Table(name=name, title=title, columns=(first, *modes))


def _everything(result: CriticalSpeeds) -> Table:
    """Return the critical speeds with all that is known of them."""
    shares = {f"shaft_{k}_share": column for k, column in enumerate(result.shaft_share.T, start=1)}
    shares |= {f"support_{k}_share": column for k, column in enumerate(result.support_share.T, start=1)}
    parts = result.part
    return Table(
        columns=(
            Column(key="mode", values=list(range(1, len(parts) + 1))),
            Column(key="critical", values=result.speed, dimension="angular_speed"),
            Column(key="wear_factor", values=result.wear),
            Column(key="actual", values=result.actual, dimension="angular_speed"),
            Column(key="at_rest", values=result.at_rest, dimension="angular_speed"),
            Column(key="half_band_low", values=result.half_band[:, 0], dimension="angular_speed"),
            Column(key="half_band_high", values=result.half_band[:, 1], dimension="angular_speed"),
            Column(key="crossed", values=[bool(one) for one in result.crossed]),
            Column(key="half_crossed", values=[bool(one) for one in result.half_crossed]),
            Column(key="near", values=[bool(one) for one in result.near]),
            Column(key="half_near", values=[bool(one) for one in result.half_near]),
            Column(key="moves", values=[part.kind for part in parts]),
            Column(key="number", values=[part.number for part in parts]),
            Column(key="half_waves", values=[part.waves for part in parts]),
            *(Column(key=key, values=values) for key, values in shares.items()),
        )
    )


def _unheld(drive: Drive) -> Iterator[Remark]:
    """Yield the joints that do not hold a shaft across, although the calculation takes them to."""
    if found := unheld(drive):
        text = plural(
            "Warning: joint {which} does not hold its shafts in line ({kinds}), as is assumed here: each shaft needs "
            "bearings of its own.",
            "Warning: joints {which} do not hold their shafts in line ({kinds}), as is assumed here: each shaft needs "
            "bearings of its own.",
            len(found),
        )
        kinds = dict.fromkeys(drive.joints[i].in_words() for i in found)
        which = Joined([str(i + 1) for i in found], last=_(" and "))
        yield Remark(text=say(text, which=which, kinds=", ".join(kinds)), tone="warning", alarm=True)


def _unequal(drive: Drive) -> Iterator[Remark]:
    """Yield which tubes are softer about one axis than about the other."""
    for shaft in drive.shafts:
        tubes = [one.profile for one in pieces(shaft, 1.0) if one.profile is not None]
        if tubes and float(tubes[0].unequal) > EQUAL:
            text = _(
                "The tube of shaft {number} counts with the softer of its axes; about the other its critical speed is "
                "up to {share} higher, and between the two it whirls."
            )
            yield Remark(text=say(text, number=shaft.number, share=Quantity(float(tubes[0].unequal), "share", 2)))


def _remarks(drive: Drive, result: CriticalSpeeds) -> Iterator[Remark]:
    yield from _judged(drive, result)
    yield from _held(drive, result)
    yield from _passed(drive, result)
    if result.held:
        text = plural(
            "Joint {which} is assumed rigidly supported; describe its outer shaft to change that.",
            "Joints {which} are assumed rigidly supported; describe the outer shafts to change that.",
            len(result.held),
        )
        which = Joined([str(number) for number in result.held], last=_(" and "))
        yield Remark(text=say(text, which=which))
    yield from _unheld(drive)
    for k, one in enumerate(drive.supports, 1):
        if one.side_stiffness is not None:
            text = _(
                "Bending of shafts counts the stiffness of support {number} up and down, its bounce modes both; cardan "
                "rotor --line counts them together."
            )
            yield Remark(text=text.format(number=k))
    yield from _unequal(drive)
    light = unweighed(drive)
    if light:
        text = plural(
            "The yokes of joint {which} count as massless: give {key} or size of the joint, or masses of shafts.",
            "The yokes of joints {which} count as massless: give {key} or size of a joint, or masses of shafts.",
            len(light),
        )
        yield Remark(
            text=say(
                text,
                which=Joined([str(number) for number in light], last=_(" and ")),
                key=Written("mass_kg", _("mass")),
            )
        )
    yield from yokes_estimated(drive)
    worn = [path for path in result.assumed if path.endswith("wear_factor")]
    if worn:
        factor = _("the wear factor of shaft {number}")
        factors = [key_text(path, factor.format(number=part_number(path))) for path in worn]
        text = _("With a spline the real speed counts as 0.9 of the computed one; {key} changes that (0.7 when worn).")
        yield Remark(text=say(text, key=Joined(factors)))
    if result.used is None:
        text = _("How far the drive stays away needs {range} or {speed} in the file.")
        keys = {
            "range": Written("duty.speed_range_rpm", _("a range of speeds")),
            "speed": Written("duty.speed_rpm", _("a speed")),
        }
        yield Remark(text=say(text, **keys))
    bad = bool(result.missed) or result.residual > MESH
    text = _("Checked: finite elements agree with transfer matrices, and no mode is missed.")
    if bad:
        text = _("Check failed: finite elements and transfer matrices differ by {rest}; modes missed: {count}.")
    rest = Quantity(float(result.residual), "share", 2)
    yield Remark(text=say(text, rest=rest, count=int(result.missed)), tone="failed" if bad else "plain", aside=not bad)


def _next() -> Remark:
    return Remark(text=_("What would move them:"), command=("cardan", "bending", FILE, "--map"), tone="next")


def _judged(drive: Drive, result: CriticalSpeeds) -> Iterator[Remark]:
    """Yield the rules that are broken, and what would keep them."""
    margin = result.margin
    if margin is None:
        return
    texts = {
        PRACTICE: _(
            "Advice, a rule of practice of unknown source: the real critical speed should be 60 % above the highest "
            "speed, {limit}."
        ),
        "limit": _("Failed: {key} asks for a real critical speed of at least {limit}."),
        "catalogue": _("Failed: makers allow {share} of the computed critical speed, {limit}."),
        "supercritical": _("Failed: the drive runs at or above a bending critical speed of a shaft."),
    }
    share = CATALOGUE[drive.duty.application]
    limits = dict.fromkeys((PRACTICE, "limit"), margin.least * margin.most) | {"catalogue": share * margin.critical}
    gravest = next((rule for rule in ("supercritical", *margin.failed, PRACTICE) if rule in margin.violated), "")
    for rule in margin.violated:
        limit = _speed(limits.get(rule, 0.0))
        key = Written("limits.critical_speed", _("the limit of the file"))
        said = say(texts[rule], limit=limit, share=Quantity(share, "share", trim=True), key=key)
        yield Remark(text=said, tone="failed" if rule in margin.failed else "warning", alarm=rule == gravest)
    if margin.violated and result.bowing is not None:
        number = result.bowing.number
        start, end = result.shaft_span[number - 1]
        length = float(end - start) * (margin.ratio / margin.needed) ** 0.5
        text = _("Shaft {number} at most about {length} long, or {share} thicker, would keep the rules.")
        if end - start > LONG:
            text = _(
                "Shaft {number} at most about {length} long, or {share} thicker, would keep the rules; so would two "
                "pieces with a bearing between."
            )
        thicker = Quantity(margin.needed / margin.ratio - 1.0, "share", decimals=0)
        yield Remark(text=say(text, number=number, length=Quantity(length, "length", 3), share=thicker))


def _held(drive: Drive, result: CriticalSpeeds) -> Iterator[Remark]:
    """Yield modes that a held speed excites, and the band to keep out of."""
    for k, part in enumerate(result.part):
        for near, (low, high), text in (
            (
                result.near[k],
                result.band[k],
                _("Failed: hold no speed from {low:bare} to {high}, 20 % to either side of {speed}, {part}."),
            ),
            (
                result.half_near[k],
                result.half_band[k],
                _(
                    "Failed: hold no speed from {low:bare} to {high}, about half of {speed}, {part}: there the joints, "
                    "whose excitation is of 2nd order, excite it."
                ),
            ),
        ):
            if near:
                speeds = {"low": _speed(low), "high": _speed(high), "speed": _speed(result.actual[k])}
                yield Remark(text=say(text, **speeds, part=_named(drive, part)), tone="failed", alarm=True)


def _passed(drive: Drive, result: CriticalSpeeds) -> Iterator[Remark]:
    """Yield critical speeds, and bands about half of them, that the drive passes, and how fast it should."""
    for k, part in enumerate(result.part):
        if result.crossed[k] and part.kind == "support":
            text = _(
                "Warning: the drive passes {speed}, {part}, and half of it; pass each quickly: in {half_time} half of "
                "the resonance builds up, in {full_time} all of it (loss factor of rubber, {loss})."
            )
        elif result.crossed[k]:
            text = _(
                "Warning: the drive passes {speed}, {part}; pass it quickly: in {half_time} half of the resonance "
                "builds up, in {full_time} all of it (loss factor of steel shafts, {loss})."
            )
        elif result.half_crossed[k]:
            text = _(
                "Warning: from {low:bare} to {high} the joints, whose excitation is of 2nd order, excite half the "
                "critical speed: {part}; pass this band quickly ({half_time} lets half of the resonance build up, "
                "{full_time} all of it), or reduce the joint angles."
            )
        else:
            continue
        half, full = (Quantity(time, "time", 2) for time in result.passing(k, half=not result.crossed[k]))
        low, high = (_speed(speed) for speed in result.half_band[k])
        loss = Quantity(LOSS[part.kind], digits=2, trim=True)
        speed, mode = _speed(result.actual[k]), _named(drive, part)
        said = say(text, speed=speed, part=mode, low=low, high=high, half_time=half, full_time=full, loss=loss)
        yield Remark(text=said, tone="warning", alarm=part.kind == "support" or not result.crossed[k])


def _keys(drive: Drive, result: CriticalSpeeds) -> Iterator[KeyFigure]:
    if np.any(result.near | result.half_near):
        k, speed, half = _nearest(result)
        low, high = (result.half_band if half else result.band)[k]
        yield KeyFigure(
            name="speed_held",
            title=_("speed held near half a critical speed") if half else _("speed held near a critical speed"),
            place=_named(drive, result.part[k]),
            value=_speed(speed),
            limit=_speed(low),
            beyond=_speed(high),
            tone="failed",
            verdict=_("too near"),
            used=min(speed / low, high / speed),
        )
    if result.bowing is None:
        return
    margin, place = result.margin, _named(drive, result.bowing)
    title, actual = _("bending critical speed"), margin.actual if margin else result.actual[result.deciding or 0]
    if margin is None:
        yield KeyFigure(name="critical_speed", title=title, place=place, value=_speed(actual), better="more")
        return
    limit = (margin.needed if margin.failed else margin.least) * margin.most
    tone: Tone = "failed" if margin.failed else "warning" if limit / actual >= CLOSE else "good"
    verdicts = {"failed": _("too low"), "warning": _("near the limit"), "good": _("passed")}
    yield KeyFigure(
        name="critical_speed",
        title=title,
        place=place,
        value=_speed(actual),
        limit=_speed(limit),
        better="more",
        tone=tone,
        verdict=_("beyond") if margin.violated and not margin.failed else verdicts[tone],
    )


def _mode_facts(result: CriticalSpeeds) -> list[dict[str, Any]]:
    return [
        {
            "critical": _speed(result.speed[k]),
            "wear_factor": result.wear[k],
            "actual": _speed(result.actual[k]),
            "at_rest": _speed(result.at_rest[k]),
            "half_band": Quantity(result.half_band[k], "angular_speed"),
            "crossed": bool(result.crossed[k]),
            "half_crossed": bool(result.half_crossed[k]),
            "near": bool(result.near[k]),
            "half_near": bool(result.half_near[k]),
            "passing_half": Quantity(result.passing(k)[0], "time"),
            "passing_full": Quantity(result.passing(k)[1], "time"),
            "loss_factor": LOSS[part.kind],
            "moves": part.kind,
            "number": part.number,
            "half_waves": part.waves,
            "shaft_shares": result.shaft_share[k],
            "support_shares": result.support_share[k],
            "deflection": result.deflection[k],
        }
        for k, part in enumerate(result.part)
    ]


def _facts(drive: Drive, result: CriticalSpeeds) -> dict[str, Any]:
    margin = result.margin
    return {
        "status": result.status.name.lower(),
        "speeds_held": Quantity(list(result.steady), "angular_speed"),
        "speed_range": None if result.used is None else Quantity(list(result.used), "angular_speed"),
        "modes": _mode_facts(result),
        "place": Quantity(result.place, "length"),
        "joint_place": Quantity(result.joint_place, "length"),
        "support_place": Quantity(result.support_place, "length"),
        "shafts": [
            {
                "number": shaft.number,
                "name": shaft.name,
                "span": Quantity(result.shaft_span[shaft.number - 1], "length"),
                "closed_form": _speed(result.alone[shaft.number - 1]),
            }
            for shaft in drive.shafts
        ],
        "margin": None
        if margin is None
        else {
            "critical": _speed(margin.critical),
            "actual": _speed(margin.actual),
            "ratio": margin.ratio,
            "rule_60_percent_met": margin.rule_60_percent,
            "violated": list(margin.violated),
            "half_critical_band": Quantity(list(margin.band), "angular_speed"),
            "half_critical_inside": margin.half_inside,
        },
        "held_joints": result.held,
        "residual": result.residual,
        "missed": result.missed,
        "assumed": [spelled(path) for path in result.assumed],
    }


def _swept(drive: Drive) -> Sequence[float]:
    found = ask(drive, modes=MODES)
    return (*first(found.actual), found.clearance)


COLUMNS = (
    SweepQuestion(
        name="critical_speed",
        doc=mark("bending critical speeds of the real shafts, lowest first"),
        told=(
            *each("critical_speed", "angular_speed", "rpm", mark("bending critical speed")),
            OutputColumn.of(
                "critical_clearance_percent",
                mark("distance of the speeds held from the nearest critical speed or half of one, over it"),
            ),
        ),
        of_one=_swept,
    ),
)
"""What a sweep may ask of bending."""
