"""What ``cardan strength`` says: what every part uses of its limits, what ends first, what could not be judged."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _, plural

from .answer import Answer, Column, Remark, Table, named, significant

if TYPE_CHECKING:
    from cardan.checks import Verdict
    from cardan.checks.strength.strength import Strength
    from cardan.drive.drive import Drive

    from .answer import Cell, Tone

HOUR = 3600.0

MPA = 1e6

NOTABLE = 1.02
"""Masses and friction are told of from this factor on the couples of the crosses."""

ENDLESS = 1e7
"""Factors from here on are as good as none."""


def answer(drive: Drive, file: Path, found: Strength) -> Answer:
    """Return what to say of the strength of a drive."""
    close = any(float(one.utilisation) >= 0.9 for one in found.binding)
    tone: Tone = "plain" if found.enough is None else "failed" if not found.enough else "warning" if close else "good"
    return Answer(
        sentence=_sentence(drive, file, found),
        tone=tone,
        tables=lambda: list(_tables(drive, found)),
        remarks=tuple(_remarks(drive, file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: _figures(found),
        code=1 if found.enough is False else 0,
    )


def _figures(found: Strength) -> Any:
    from .asked import figures

    return figures(found)


def _sentence(drive: Drive, file: Path, found: Strength) -> str:
    from .source import title

    name, first = title(drive, file), found.governing
    if first is None:
        return _("{name}: nothing could be judged; the keys that are missing stand below.").format(name=name)
    said = {
        "name": name,
        "rated": significant(found.rated_torque),
        "torque": significant(found.torque),
        "title": first.title,
    }
    if found.enough:
        return _("{name}: carries {torque} N·m, and up to {rated} N·m; {title} ends it first.").format(**said)
    return _("{name}: too weak for {torque} N·m; it carries {rated} N·m, then {title} ends it.").format(**said)


def _tables(drive: Drive, found: Strength) -> Iterator[Table]:
    if found.judged:
        yield _uses(found)
    yield _shafts(drive, found)
    yield _joints(drive, found)
    lacking = list(_lacking(found))
    if lacking:
        columns = (
            Column(key="title", heading=_("what it tells"), left=True),
            Column(key="missing", heading=_("key to add"), left=True, wrap=True),
        )
        yield Table(columns=columns, rows=lacking, title=_("Could not be judged"))


def _uses(found: Strength) -> Table:
    from cardan.checks.alike import alike, title_of

    from .check_answer import SIGNS, TONES, limit, shown

    words = {"passed": _("holds"), "close": _("close"), "failed": _("fails")}
    order = sorted(found.judged, key=lambda one: (one.advice, one.torque_factor))
    torque = {(one.check, one.subject, one.title): found.torque * float(one.torque_factor) for one in order}
    rows: list[list[Cell]] = []
    tones: list[Tone] = []
    for group in alike(order):
        one, said = group[0], [title_of(group)]
        if one.advice:
            said.append(_("a rule of thumb"))
        ends = torque[one.check, one.subject, one.title]
        state = "close" if one.advice and one.state == "failed" else one.state
        rows.append(
            [
                f"{SIGNS[state]} {words[state]}",
                float(one.utilisation),
                shown(one, one.value),
                limit(one),
                ends if ends < ENDLESS * found.torque else "∞",
                "; ".join(said),
            ]
        )
        tones.append(TONES[state])
    columns = (
        Column(key="state", heading=_("verdict"), left=True),
        Column(key="utilisation", heading=_("used"), form=".2f"),
        Column(key="value", heading=_("value")),
        Column(key="limit", heading=_("limit"), left=True),
        Column(key="torque_Nm", heading=_("ends at"), unit="N·m"),
        Column(key="title", heading=_("what"), left=True, wrap=True),
    )
    return Table(columns=columns, rows=rows, tones=tones)


def _shafts(drive: Drive, found: Strength) -> Table:
    rows: list[list[Cell]] = []
    for one, shaft in zip(found.shafts, drive.shafts, strict=True):
        stress = one.stress
        rows.append(
            [
                named(one.number, shaft.name),
                one.torque,
                one.bending,
                None if stress is None else float(stress.torsion) / MPA,
                None if stress is None else float(stress.bending) / MPA,
                _degrees(one.twist),
                None if one.fatigue is None else _finite(float(one.fatigue.safety)),
                _hours(one.fatigue_life),
            ]
        )
    columns = (
        Column(key="shaft", heading=_("shaft"), left=True),
        Column(key="torque_Nm", heading=_("torque"), unit="N·m"),
        Column(key="bending_Nm", heading=_("bent"), unit="N·m"),
        Column(key="torsion_MPa", heading=_("torsion"), unit="MPa"),
        Column(key="bending_MPa", heading=_("bending"), unit="MPa"),
        Column(key="twist_deg", heading=_("twist"), unit="°", form=".2f"),
        Column(key="safety", heading=_("fatigue"), unit=_("safety"), form=".2f"),
        Column(key="life_h", heading=_("lasts"), unit="h"),
    )
    return Table(columns=columns, rows=rows)


def _joints(drive: Drive, found: Strength) -> Table:
    rows: list[list[Cell]] = [
        [
            named(one.number, joint.name),
            one.torque,
            one.journal_force,
            None if one.journal is None else float(one.journal.mises) / MPA,
            None if one.yoke is None else float(one.yoke.mises) / MPA,
            None if one.contact is None else float(one.contact.pressure) / MPA,
            one.static_capacity,
        ]
        for one, joint in zip(found.joints, drive.joints, strict=True)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="torque_Nm", heading=_("torque"), unit="N·m"),
        Column(key="journal_N", heading=_("journal"), unit="N"),
        Column(key="journal_MPa", heading=_("its root"), unit="MPa"),
        Column(key="yoke_MPa", heading=_("yoke"), unit="MPa"),
        Column(key="contact_MPa", heading=_("needles"), unit="MPa"),
        Column(key="static_N", heading="C0", unit="N"),
    )
    return Table(columns=columns, rows=rows)


def _lacking(found: Strength) -> Iterator[list[Cell]]:
    """Yield keys to add and what they tell, joints and shafts alike together."""
    from cardan.choices.lever import key_of

    groups: dict[tuple[str, ...], list[Verdict]] = {}
    for one in found.verdicts:
        if not one.run:
            kind = (one.check, *(re.sub(r"\[\d+\]", "[]", path) for path in one.missing))
            groups.setdefault(kind, []).append(one)
    for members in groups.values():
        keys = ", ".join(key_of(path) for path in members[0].missing)
        several = _(" and so on") if len(members) > 1 else ""
        yield [members[0].title, keys + several]


def _remarks(drive: Drive, file: Path, found: Strength) -> Iterator[Remark]:
    first = found.governing
    if first is not None and found.enough is False:
        failed = [one for one in found.binding if float(one.utilisation) > 1.0]
        text = plural(
            "Failed: {title}, {used:.2f} of its limit.", "Failed: {count} limits, worst {title}.", len(failed)
        )
        worst = max(failed, key=lambda one: float(one.utilisation))
        yield Remark(
            text=text.format(title=worst.title, used=float(worst.utilisation), count=len(failed)), tone="failed"
        )
        part = _sizable(first)
        if part:
            command = ("cardan", "strength", str(file), "--size", part)
            yield Remark(text=_("What it would take:"), command=command, tone="next")
    left = sum(not one.run for one in found.verdicts)
    if left and found.judged:
        text = plural(
            "Warning: one limit could not be judged; the drive may carry less.",
            "Warning: {count} limits could not be judged; the drive may carry less.",
            left,
        )
        yield Remark(text=text.format(count=left), tone="warning")
    if found.shock_factor != 1.0:
        text = _("Torques and stresses are with the factor {shock:g} for shocks; twist and fatigue are without.")
        yield Remark(text=text.format(shock=found.shock_factor))
    if found.dynamic_factor > NOTABLE:
        text = _(
            "Warning: masses and friction raise the largest couple of a cross by {more:.1f} %; stresses leave them out."
        )
        if found.shock_factor >= found.dynamic_factor:
            text = _(
                "Masses and friction raise the largest couple of a cross by {more:.1f} %; the factor for shocks covers "
                "it."
            )
        low = found.shock_factor < found.dynamic_factor
        yield Remark(text=text.format(more=100.0 * (found.dynamic_factor - 1.0)), tone="warning" if low else "plain")
    if found.extrapolated:
        text = _("Warning: shafts over 254 mm are beyond the tests behind the fatigue formula; shafts {which}.")
        yield Remark(text=text.format(which=", ".join(map(str, found.extrapolated))), tone="warning")
    for one in found.shafts:
        if one.bending > 0.0 and one.weight_bending > 0.2 * one.bending:
            text = _("Warning: its own weight bends shaft {number} by {weight} N·m, which no stress here counts.")
            said = text.format(number=one.number, weight=significant(one.weight_bending, 3))
            yield Remark(text=said, tone="warning")
    if found.enough:
        text = _("Every limit on its own, with where it comes from:")
        yield Remark(text=text, command=("cardan", "strength", str(file), "--csv"), tone="next")


def _sizable(use: Verdict) -> str:
    """Return what `--size` calls the part that a use is of, "" where it sizes none."""
    number = int(use.subject.partition("[")[2].rstrip("]")) + 1 if "[" in use.subject else 0
    kinds = {
        "tube_strength": "tube",
        "tube_fatigue": "tube",
        "tube_buckling": "tube",
        "journal_strength": "journal",
        "needle_static": "needles",
        "bearing_life": "needles",
        "joint_torque": "joint",
        "rated_torque": "joint",
        "yoke_strength": "joint",
    }
    kind = kinds.get(use.check)
    return f"{kind}:{number}" if kind and number else ""


def _rows(found: Strength) -> Table:
    """Return every use of a limit, one a row."""
    from cardan.choices.lever import key_of

    from .check_answer import unit_factor

    keys = ("check", "part", "title", "advice", "value", "sense", "limit", "unit", "utilisation", "ends_at_Nm")
    rows: list[list[Cell]] = []
    for one in found.verdicts:
        told, by = one.run, unit_factor(one)
        rows.append(
            [
                *(one.check, one.subject, one.title, one.advice, float(one.value) / by if told else None, one.sense),
                *(one.bound / by if told else None, one.unit, float(one.utilisation) if told else None),
                *(_finite(found.torque * float(one.torque_factor)) if told else None, one.source, one.note),
                " ".join(key_of(path) for path in one.missing),
            ]
        )
    return Table(columns=tuple(Column(key=key) for key in (*keys, "source", "note", "missing")), rows=rows)


def _content(drive: Drive, file: Path, found: Strength) -> dict[str, Any]:
    from .show import records

    table = _rows(found)
    keys = [column.key for column in table.columns]
    first = found.governing
    return {
        "question": "strength",
        "drive": drive.name,
        "file": str(file),
        "torque_Nm": found.torque,
        "rated_torque_Nm": found.rated_torque,
        "torque_factor": found.torque_factor,
        "enough": found.enough,
        "utilisation": found.utilisation,
        "governing": None if first is None else {"check": first.check, "part": first.subject, "title": first.title},
        "shock_factor": found.shock_factor,
        "dynamic_factor": found.dynamic_factor,
        "extrapolated_shafts": found.extrapolated,
        "shafts": records(_shafts(drive, found), [(one.number, one.name) for one in drive.shafts]),
        "joints": records(_joints(drive, found), [(k, one.name) for k, one in enumerate(drive.joints, start=1)]),
        "limits": [dict(zip(keys, row, strict=True)) for row in table.rows],
    }


def _degrees(angle: float) -> float:
    from math import degrees

    return degrees(angle)


def _finite(value: float) -> float | str:
    from math import isinf

    return "∞" if isinf(value) else value


def _hours(seconds: float) -> float | str | None:
    from math import isinf, isnan

    return None if isnan(seconds) else "∞" if isinf(seconds) else seconds / HOUR
