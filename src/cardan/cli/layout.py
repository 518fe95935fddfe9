"""``cardan phases --layout``: where should the joints stand?"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.texts import _, plural

from .phasing import command, setting_content, settings_table, spread

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.phases.layout import Layout

    from .answer import Answer, Cell, Remark, Table


def answer(drive: Drive, file: Path, found: Layout, held: Mapping[int, float], goal: str) -> Answer:
    """Return what to say of a layout; see `cardan.cli.phasing.answer`."""
    from cardan.questions.phases.layout import Status

    from .answer import Answer

    yokes = [settings_table(found.drive, found.phasing.settings)] if found.phasing.settings else []
    return Answer(
        sentence=_sentence(drive, file, found),
        tables=lambda: (_table(found), *yokes),
        remarks=tuple(_remarks(file, found, held, goal)),
        content=lambda: _content(drive, file, found),
        csv=lambda: _table(found),
        figure=lambda: _figures(found),
        code=1 if found.status == Status.CANCELLED else 0,
    )


def values(found: Layout) -> dict[str, Any]:
    """Return the new joint centres as values of the drive file."""
    from cardan.units import mm

    return {
        f"joints[{k}].centre_mm": [round(float(x) / mm, 12) for x in found.points[k + 1]]
        for k, way in enumerate(found.moved)
        if way > 0.0
    }


def _figures(found: Layout) -> Any:
    from cardan.figures import for_result

    return (*for_result(found.drive), *for_result(found.phasing))


def _sentence(drive: Drive, file: Path, found: Layout) -> str:
    from math import degrees

    from cardan.questions.motion.equivalence import equivalent_joint

    from .answer import percent
    from .source import title

    if found.feasible:
        text = _("{name}: {count}, {now} irregular as built → joints moved, exactly synchronous")
    else:
        text = _("{name}: {count}, {now} irregular as built → joints moved, {least} remains")
    text += _("; largest bend {bend:.2f}° instead of {old:.2f}°")
    return text.format(
        name=title(drive, file),
        count=plural("{n} joint", "{n} joints", len(drive.joints)).format(n=len(drive.joints)),
        now=percent(float(equivalent_joint(drive).irregularity)),
        least=percent(found.irregularity),
        bend=degrees(float(found.bend.max())),
        old=degrees(float(found.bend_before.max())),
    )


def _table(found: Layout) -> Table:
    from cardan.units import deg, mm

    from .answer import Column, Table, named

    rows: list[tuple[Cell, ...]] = [
        (
            named(k + 1, joint.name),
            float(found.bend_before[k]) / deg,
            float(found.bend[k]) / deg,
            float(found.moved[k]) / mm,
            *(float(x) / mm for x in found.points[k + 1]),
        )
        for k, joint in enumerate(found.drive.joints)
    ]
    columns = (
        Column(key="joint", heading=_("joint"), left=True),
        Column(key="bend_before_deg", heading=_("bend"), unit=_("as built °"), form=".2f"),
        Column(key="bend_deg", unit=_("moved °"), form=".2f"),
        Column(key="moved_mm", heading=_("moved by"), unit="mm", form=".1f"),
        Column(key="x_mm", heading=_("to x"), unit="mm", form=".1f"),
        Column(key="y_mm", heading=_("y"), unit="mm", form=".1f"),
        Column(key="z_mm", heading=_("z"), unit="mm", form=".1f"),
    )
    return Table(columns=columns, rows=rows)


def _remarks(file: Path, found: Layout, held: Mapping[int, float], goal: str) -> Iterator[Remark]:
    from cardan.figures.wording import letters
    from cardan.questions.phases.layout import Status

    from .answer import Remark

    if found.status == Status.CANCELLED:
        yield Remark(text=_("Warning: the search was stopped; this is the best layout so far."), tone="warning")
    if not found.feasible:
        yield Remark(text=_("No place within the boxes makes the drive synchronous; wider boxes may."))
    if meaning := letters(found.phasing, nearest=goal == "nearest"):
        yield Remark(text=meaning)
    yield from spread(found.phasing)
    yield Remark(
        text=_("Write the new centres and yoke angles into a copy of the file:"),
        command=command(file, held, goal, "--layout", "-o", "better.toml"),
        tone="next",
    )


def _content(drive: Drive, file: Path, found: Layout) -> dict[str, Any]:
    from cardan.units import deg, mm

    from .show import records

    names = [(k, joint.name) for k, joint in enumerate(found.drive.joints, 1)]
    return {
        "question": "layout",
        "drive": drive.name,
        "file": str(file),
        "status": str(found.status),
        "synchronous_possible": found.feasible,
        "irregularity": found.irregularity,
        "bend_before_deg": found.bend_before / deg,
        "bend_deg": found.bend / deg,
        "length_before_mm": found.length_before / mm,
        "length_mm": found.length / mm,
        "points_mm": found.points / mm,
        "joints": records(_table(found), names),
        "settings": [setting_content(one) for one in found.phasing.settings],
    }
