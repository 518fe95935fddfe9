"""What ``cardan life`` says: lives side by side, parts of the duty cycle, what to mind, and what would do."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _

from .answer import Answer, Column, Remark, Table, named, percent, significant
from .life import METHODS

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.life.life import Life

    from .answer import Cell, Tone

HOUR = 3600.0

SHOWN = 12
"""Parts of a duty cycle that stand in the terminal."""


def answer(drive: Drive, file: Path, found: Life) -> Answer:
    """Return what to say of the life of a drive."""
    from .asked import figures

    tone: Tone = "plain" if found.enough is None else "good" if found.enough else "failed"
    return Answer(
        sentence=_sentence(drive, file, found),
        tone=tone,
        tables=lambda: list(_tables(drive, found)),
        remarks=tuple(_remarks(file, found)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _rows(found),
        figure=lambda: figures(found),
        code=1 if found.enough is False else 0,
    )


def _hours(seconds: float) -> float | str | None:
    """Return a life in hours, a sign for one without end, None where it is not known."""
    from math import isinf, isnan

    return None if isnan(seconds) else "∞" if isinf(seconds) else seconds / HOUR


def _sentence(drive: Drive, file: Path, found: Life) -> str:
    from math import isinf

    from .asked import called
    from .source import title

    name = title(drive, file)
    if isinf(found.drive):
        return _("{name}: nothing wears; no joint both swings and carries torque.").format(name=name)
    number = called(found.governing, drive.joints[found.governing - 1].name)
    said = {"name": name, "joint": number, "life": significant(found.drive / HOUR)}
    if found.demanded is None:
        return _("{name}: joint {joint} fails first, after {life} h.").format(**said)
    said["asked"] = significant(found.demanded / HOUR)
    if found.enough:
        return _("{name}: lasts; joint {joint} fails first, after {life} h, and {asked} h are asked for.").format(
            **said
        )
    return _("{name}: too short; joint {joint} fails after {life} h, and {asked} h are asked for.").format(**said)


def _tables(drive: Drive, found: Life) -> Iterator[Table]:
    import numpy as np

    from cardan.units import deg, rpm

    lives = {name: found.of(name) for name in METHODS}
    bend = found.share @ found.bend
    load = found.equivalent_torque
    force = np.max(found.journal_force, axis=0)
    rows: list[list[Cell]] = [
        [
            named(i + 1, joint.name),
            float(bend[i]) / deg,
            float(load[i]),
            float(force[i]),
            float(found.speed_angle[i]) / (rpm * deg),
            *(_hours(float(lives[name][i])) for name in METHODS),
        ]
        for i, joint in enumerate(drive.joints)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="bend_deg", heading=_("bend"), unit="°", form=".2f"),
        Column(key="torque_Nm", heading=_("torque"), unit="N·m"),
        Column(key="journal_N", heading=_("journal"), unit=_("max N")),
        Column(key="speed_angle_rpm_deg", heading="n·α", unit="rpm·°"),
        Column(key="iso_h", heading=_("ISO 281"), unit="h"),
        Column(key="simple_h", heading=_("mean load"), unit="h"),
        Column(key="maker_h", heading=_("maker"), unit="h"),
        Column(key="book_h", heading=_("book"), unit="h"),
    )
    yield Table(columns=columns, rows=rows)
    if 1 < len(found.parts) <= SHOWN:
        yield _part_table(found)


def _part_table(found: Life) -> Table:
    from cardan.units import rpm

    damage = 100.0 * found.damage
    joints = range(damage.shape[1])
    return Table(
        title=_("Parts of the duty cycle, and their share of the damage"),
        columns=(
            Column(key="torque_Nm", heading=_("torque"), unit="N·m"),
            Column(key="speed_rpm", heading=_("speed"), unit="rpm"),
            Column(key="share_percent", heading=_("time"), unit="%", form=".1f"),
            *(
                Column(
                    key=f"joint_{i + 1}_damage_percent",
                    heading=_("joint {number}").format(number=i + 1),
                    unit="%",
                    form=".1f",
                )
                for i in joints
            ),
        ),
        rows=[
            [part.torque, part.speed / rpm, 100.0 * float(share), *(float(damage[k, i]) for i in joints)]
            for k, (part, share) in enumerate(zip(found.parts, found.share, strict=True))
        ],
    )


def _remarks(file: Path, found: Life) -> Iterator[Remark]:
    from math import isfinite

    from .asked import key_of

    if found.enough is False:
        i = found.governing - 1
        text = _("Failed: it would last with {share} of its loads")
        said = text.format(share=percent(found.torque_margin))
        need = float(found.needed_capacity[i])
        if isfinite(need):
            said += _(", or with a capacity of {need} N instead of {now} N").format(
                need=significant(need), now=significant(float(found.bearings.capacity[i]))
            )
        yield Remark(text=said + ".", tone="failed")
    if found.history is not None and found.cycles is not None:
        levels = found.history
        text = _(
            "The measured torque runs from {low} to {high} N·m, {mean} N·m in the mean; for the bearings it is a "
            "constant one of {same} N·m. By rainflow it has {count} cycles, the largest of {most} N·m."
        )
        said = text.format(
            low=significant(levels.low),
            high=significant(levels.high),
            mean=significant(levels.mean),
            same=significant(levels.equivalent),
            count=significant(found.cycles.total).rstrip("0").rstrip("."),
            most=significant(float(max(found.cycles.range, default=0.0))),
        )
        yield Remark(text=said)
    yield from _warned(found)
    if found.uncounted:
        keys = ", ".join(key_of(one.field) for one in found.uncounted)
        text = _("Warning: some joints are not rated; the file lacks {keys}.")
        yield Remark(text=text.format(keys=keys), tone="warning")
    text = _("{share} of the joints reach these lives (a1 = {factor}); the factor for shocks is {shock}.")
    yield Remark(
        text=text.format(
            share=f"{100.0 * found.reliability:.6g} %",
            factor=f"{found.reliability_factor:.3g}",
            shock=f"{found.shock_factor:.3g}",
        )
    )
    if len(found.parts) > 1:
        text = _("Every part on its own, joint by joint:")
        yield Remark(text=text, command=("cardan", "life", str(file), "--csv"), tone="next")


def _warned(found: Life) -> Iterator[Remark]:
    """Yield cautions, joints together."""
    from .asked import listed

    groups: dict[str, list[int]] = {}
    for one in found.cautions:
        groups.setdefault(one.code, []).append(one.joint)
    alike = {
        "small_oscillation": _(
            "joints {which} bend so little that each needle wears its own patch; formulas promise too much"
        ),
        "angle_clamped_3deg": _("joints {which} bend less than 3°; book and makers count them as 3°"),
        "extrapolated": _("joints {which} are outside the book's tables, 10 to 35 000 rpm·° and 100 to 100 000 h"),
        "no_swing": _("joints {which} do not bend: needles do not roll, and ISO 281 rates no life for that"),
        "heavy_load": _("journals of joints {which} carry over half their capacity; ISO 281 ends there"),
    }
    for code, joints in groups.items():
        own = [one.message for one in found.cautions if one.code == code]
        some = [joint for joint in joints if joint]
        several = len(some) > 1
        said = [alike[code].format(which=listed([joint - 1 for joint in some]))] if several else []
        said += [message for joint, message in zip(joints, own, strict=True) if not (several and joint)]
        for message in said:
            yield Remark(text=_("Warning: {what}.").format(what=message), tone="warning")


def _rows(found: Life) -> Table:
    """Return every part and joint."""
    from cardan.units import deg, rpm

    keys = (
        "part",
        "joint",
        "share_percent",
        "torque_Nm",
        "speed_rpm",
        "joint_torque_Nm",
        "bend_deg",
        "journal_force_N",
        "iso_driving_h",
        "iso_driven_h",
        "simple_h",
        "maker_h",
        "book_h",
        "damage_percent",
    )
    lives = (found.driving, found.driven, found.simple, found.maker, found.book)
    damage = found.damage
    rows = [
        [
            k + 1,
            i + 1,
            100.0 * float(found.share[k]),
            part.torque,
            part.speed / rpm,
            float(found.torque[k, i]),
            float(found.bend[k, i]) / deg,
            float(found.journal_force[k, i]),
            *(float(one[k, i]) / HOUR for one in lives),
            100.0 * float(damage[k, i]),
        ]
        for k, part in enumerate(found.parts)
        for i in range(found.bend.shape[1])
    ]
    return Table(columns=tuple(Column(key=key) for key in keys), rows=rows)


def _content(drive: Drive, file: Path, found: Life) -> dict[str, Any]:
    from cardan.units import deg, rpm

    from .asked import columns_of, key_of

    lives = {name: found.of(name) / HOUR for name in METHODS}
    own = found.bearings
    content: dict[str, Any] = {
        "question": "life",
        "drive": drive.name,
        "file": str(file),
        "method": found.method,
        "life_h": found.drive / HOUR,
        "governing_joint": found.governing,
        "demanded_h": None if found.demanded is None else found.demanded / HOUR,
        "enough": found.enough,
        "torque_margin": found.torque_margin,
        "reliability_percent": 100.0 * found.reliability,
        "reliability_factor": found.reliability_factor,
        "shock_factor": found.shock_factor,
        "joints": [
            {
                "number": i + 1,
                "name": joint.name,
                "equivalent_torque_Nm": found.equivalent_torque[i],
                "speed_angle_rpm_deg": found.speed_angle[i] / (rpm * deg),
                "capacity_N": own.capacity[i],
                "needed_capacity_N": found.needed_capacity[i],
                "convention": own.convention[i],
                "iso_driving_h": found.combined(found.driving)[i] / HOUR,
                "iso_driven_h": found.combined(found.driven)[i] / HOUR,
                **{f"{name}_h": lives[name][i] for name in METHODS},
            }
            for i, joint in enumerate(drive.joints)
        ],
        "warnings": [{"code": one.code, "joint": one.joint, "message": one.message} for one in found.cautions],
        "not_rated": [{"field": key_of(one.field), "message": one.message} for one in found.uncounted],
        "assumed": found.assumed,
        "parts": columns_of(_rows(found)),
    }
    return content if found.history is None else {**content, "history": _history(found)}


def _history(found: Life) -> dict[str, Any]:
    levels, cycles = found.history, found.cycles
    assert levels is not None
    assert cycles is not None
    return {
        "duration_s": levels.duration,
        "mean_Nm": levels.mean,
        "low_Nm": levels.low,
        "high_Nm": levels.high,
        "equivalent_Nm": levels.equivalent,
        "edges_Nm": levels.edge,
        "share_percent": 100.0 * levels.share,
        "cycles": {"range_Nm": cycles.range, "mean_Nm": cycles.mean, "count": cycles.count},
    }
