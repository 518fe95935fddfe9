"""``cardan bending``: at which speeds do the shafts whirl, and how far does the drive stay away from them?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.texts import _, plural

from .options import AsCsv, AsJson, DriveFile, Plot

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.bending.bending import CriticalSpeeds, Part
    from cardan.questions.bending.speed_map import CriticalSpeedMap

    from .answer import Answer, Remark

LONG = 1.5
"""Distance of joints [m] above which articles advise two pieces."""


def bending(
    file: DriveFile,
    modes: Annotated[int, typer.Option("--modes", metavar="N", help=_("How many critical speeds."))] = 3,
    over: Annotated[
        bool,
        typer.Option(
            "--map",
            help=_("Critical speeds over the stiffness of a support, or the length of a shaft where none gives way."),
            show_default=False,
        ),
    ] = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell at which speeds the shafts whirl, what moves there, and how far the drive stays away."""
    from .asked import keys_of
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)

    from cardan.errors import refuse
    from cardan.questions.bending.bending import MOST, bending_speeds
    from cardan.questions.bending.speed_map import critical_speed_map

    from .source import read

    if not 1 <= modes <= MOST:
        text = _("{value} is not allowed; allowed is 1 to {most}")
        raise refuse("--modes", text.format(value=modes, most=MOST))
    drive = read(file)
    with keys_of(file):
        found = bending_speeds(drive, modes=modes)
        varied = critical_speed_map(drive, modes=modes) if over else None
    return show(_answer(drive, file, found, varied), json=json, csv=csv, plot=plot)


def _answer(drive: Drive, file: Path, found: CriticalSpeeds, varied: CriticalSpeedMap | None) -> Answer:
    from cardan.questions.bending.bending import Running

    from .answer import Answer
    from .asked import figures
    from .bending_tables import map_table, mode_table, rows, shaft_table

    close = found.status in (Running.CLOSE, Running.BEYOND)
    mind = bool(found.half_crossed.any()) or bool(found.crossed.any())
    calm = "plain" if found.status == Running.UNKNOWN else "good"
    return Answer(
        sentence=_sentence(drive, file, found),
        tone="failed" if close else "warning" if mind else calm,  # type: ignore[arg-type]
        tables=lambda: (
            (mode_table(found), shaft_table(drive, found))
            if varied is None
            else (map_table(drive, varied, short=True),)
        ),
        remarks=tuple(_remarks(drive, file, found, varied)),
        content=lambda: _content(drive, file, found, varied),
        csv=lambda: rows(found) if varied is None else map_table(drive, varied),
        figure=lambda: figures(found) if varied is None else figures(found, varied),
        code=1 if close else 0,
    )


def _said(drive: Drive, part: Part) -> str:
    """Return what moves in a mode, with the names the file gives."""
    from .asked import called

    if part.kind == "support":
        where = called(part.number, drive.supports[part.number - 1].name)
        return _("support {number} bounces").format(number=where)
    where = called(part.number, drive.shafts[part.number - 1].name)
    text = plural("shaft {number} bows", "shaft {number} bows in {n} half waves", part.waves)
    return text.format(number=where, n=part.waves)


def _sentence(drive: Drive, file: Path, found: CriticalSpeeds) -> str:
    from cardan.questions.bending.bending import Running
    from cardan.units import rpm

    from .answer import significant
    from .source import title

    name = title(drive, file)
    first = _said(drive, found.part[0])
    if found.margin is None:
        text = _("{name}: the first critical speed is {speed} rpm, where {part}.")
        return text.format(name=name, speed=significant(float(found.actual[0]) / rpm), part=first)
    ratio = significant(found.margin.ratio, 3)
    speed = significant(found.margin.actual / rpm)
    part = _said(drive, found.bowing) if found.bowing else first
    text = {
        Running.CLEAR: _("{name}: {part} at {speed} rpm, {ratio} times the highest speed in use: far enough."),
        Running.CLOSE: _("{name}: {part} at {speed} rpm, only {ratio} times the highest speed in use."),
        Running.BEYOND: _("{name}: {part} at {speed} rpm, {ratio} times the highest speed in use: it is reached."),
    }[found.status]
    return text.format(name=name, part=part, speed=speed, ratio=ratio)


def _remarks(drive: Drive, file: Path, found: CriticalSpeeds, varied: CriticalSpeedMap | None) -> Iterator[Remark]:
    from cardan.figures.wording import closely

    from .answer import Remark

    yield from _judged(drive, found)
    yield from _passed(drive, found)
    if found.held:
        text = plural(
            "Joint {which} counts as held by its machine; a body and supports of its outer shaft say how softly.",
            "Joints {which} count as held by their machines; bodies and supports of the outer shafts say how softly.",
            len(found.held),
        )
        yield Remark(text=text.format(which=_(" and ").join(str(number) for number in found.held)))
    worn = [path for path in found.assumed if path.endswith("wear_factor")]
    if worn:
        text = _(
            "With a spline the real speed counts as 0.9 of the computed one; {key} says otherwise (0.7 when worn)."
        )
        yield Remark(text=text.format(key=", ".join(worn)))
    if found.used is None:
        text = _("How far the drive stays away needs duty.speed_range_rpm or duty.speed_rpm in the file.")
        yield Remark(text=text)
    text = _("Checked: finite elements and transfer matrices agree {closely}; the count of modes misses {none}.")
    none = _("none") if not found.missed else str(found.missed)
    yield Remark(
        text=text.format(closely=closely(found.residual), none=none), tone="failed" if found.missed else "plain"
    )
    if varied is None:
        yield Remark(text=_("What would move them:"), command=("cardan", "bending", str(file), "--map"), tone="next")


def _judged(drive: Drive, found: CriticalSpeeds) -> Iterator[Remark]:
    """Yield the rules that are broken, and what would keep them."""
    from cardan.formulas.critical_speed import ARTICLE, CATALOGUE
    from cardan.units import mm, rpm

    from .answer import Remark, significant

    margin = found.margin
    if margin is None:
        return
    texts = {
        "article_1.6": _("Failed: the real critical speed should be 60 % above the highest speed, {limit} rpm."),
        "catalogue": _("Failed: makers allow {share} % of the computed critical speed, {limit} rpm."),
        "supercritical": _("Failed: the drive runs at or above a speed at which a shaft bows."),
    }
    share = CATALOGUE[drive.duty.application]
    limits = {"article_1.6": ARTICLE * margin.most, "catalogue": share * margin.critical}
    for rule in margin.violated:
        limit = significant(limits.get(rule, 0.0) / rpm)
        yield Remark(text=texts[rule].format(limit=limit, share=f"{100 * share:g}"), tone="failed")
    if margin.violated and found.bowing is not None:
        number = found.bowing.number
        start, end = found.shaft_span[number - 1]
        length = float(end - start) * (margin.ratio / ARTICLE) ** 0.5
        text = _("Shaft {number} at most about {length} mm long, or {share} % thicker, would keep the rules")
        text += _("; so would two pieces with a bearing between.") if end - start > LONG else "."
        thicker = f"{100.0 * (ARTICLE / margin.ratio - 1.0):.0f}"
        yield Remark(text=text.format(number=number, length=significant(length / mm, 3), share=thicker))


def _passed(drive: Drive, found: CriticalSpeeds) -> Iterator[Remark]:
    """Yield critical speeds that the drive passes, and halves of them that it runs in."""
    from cardan.units import rpm

    from .answer import Remark, significant

    for k, part in enumerate(found.part):
        if found.crossed[k]:
            text = _("Warning: the drive passes {speed} rpm, where {part}")
            text += _("; its rubber has to damp that.") if part.kind == "support" else "."
            yield Remark(
                text=text.format(speed=significant(float(found.actual[k]) / rpm), part=_said(drive, part)),
                tone="warning",
            )
    for k, part in enumerate(found.part):
        if found.half_crossed[k] and part.kind == "shaft":
            low, high = (significant(float(speed) / rpm) for speed in found.half_band[k])
            text = _(
                "Warning: from {low} to {high} rpm the joints, which push twice a turn, excite the mode in which "
                "{part}; pass this band quickly, or bend the joints less."
            )
            yield Remark(text=text.format(low=low, high=high, part=_said(drive, part)), tone="warning")


def _content(drive: Drive, file: Path, found: CriticalSpeeds, varied: CriticalSpeedMap | None) -> dict[str, Any]:
    from cardan.units import mm, rpm

    from .asked import columns_of, key_of
    from .bending_tables import map_table

    margin = found.margin
    content: dict[str, Any] = {
        "question": "bending",
        "drive": drive.name,
        "file": str(file),
        "status": found.status.name.lower(),
        "speed_range_rpm": None if found.used is None else [speed / rpm for speed in found.used],
        "modes": [
            {
                "critical_rpm": found.speed[k] / rpm,
                "wear_factor": found.wear[k],
                "actual_rpm": found.actual[k] / rpm,
                "at_rest_rpm": found.at_rest[k] / rpm,
                "half_band_rpm": found.half_band[k] / rpm,
                "crossed": bool(found.crossed[k]),
                "half_crossed": bool(found.half_crossed[k]),
                "moves": part.kind,
                "number": part.number,
                "half_waves": part.waves,
                "shaft_shares": found.shaft_share[k],
                "support_shares": found.support_share[k],
                "deflection": found.deflection[k],
            }
            for k, part in enumerate(found.part)
        ],
        "place_mm": found.place / mm,
        "joint_place_mm": found.joint_place / mm,
        "support_place_mm": found.support_place / mm,
        "shafts": [
            {
                "number": shaft.number,
                "name": shaft.name,
                "span_mm": found.shaft_span[shaft.number - 1] / mm,
                "closed_form_rpm": found.alone[shaft.number - 1] / rpm,
            }
            for shaft in drive.shafts
        ],
        "margin": None
        if margin is None
        else {
            "critical_rpm": margin.critical / rpm,
            "actual_rpm": margin.actual / rpm,
            "ratio": margin.ratio,
            "rule_60_percent_met": margin.rule_60_percent,
            "violated": list(margin.violated),
            "half_critical_band_rpm": [speed / rpm for speed in margin.band],
            "half_critical_inside": margin.half_inside,
        },
        "held_joints": found.held,
        "residual": found.residual,
        "missed": found.missed,
        "assumed": [key_of(path) for path in found.assumed],
    }
    return content if varied is None else {**content, "map": columns_of(map_table(drive, varied))}
