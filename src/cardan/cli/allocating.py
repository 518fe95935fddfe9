"""What ``cardan tolerance --allocate`` answers: the cheapest tolerances for an error of the output."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cardan.errors import refuse
from cardan.texts import _

if TYPE_CHECKING:
    from cardan.drive.drive import Drive
    from cardan.questions.accuracy.allocation import Allocation

    from .answer import Answer, Remark, Table

DIGITS = 3
"""Digits of the tolerances that are written into a file, rounded down so that the target holds."""

MOST_ANGLES = 6
"""More angles than this at which the target is reached are counted."""


def target(text: str) -> tuple[float, bool]:
    """Return an error in SI, and whether it is a length.

    Raises
    ------
    InputError
        It is no number with a unit.

    Examples
    --------
    >>> target("0.01mm")
    (1e-05, True)
    """
    from math import inf

    from cardan.units import DIMENSIONS

    match = re.fullmatch(r"\s*([-+0-9.eE]+?)\s*([a-z]+|°|′|')?\s*", text)
    word = {"°": "deg", "′": "arcmin", "'": "arcmin"}.get((match[2] or "") if match else "", match[2] if match else "")
    for dimension in ("angle", "length"):
        units = DIMENSIONS[dimension] if dimension == "angle" else DIMENSIONS[dimension] | {"um": 1e-6}
        if match and word in units:
            try:
                value = float(match[1])
            except ValueError:
                break
            if not 0.0 < value < inf:
                raise refuse("--allocate", _("{text} is not allowed; the error must be above 0").format(text=text))
            return value * units[word], dimension == "length"
    raise refuse("--allocate", _("{text} is no error with a unit: 2arcmin, 0.05deg, or 0.01mm").format(text=text))


def answer(
    drive: Drive,
    file: Path,
    text: str,
    *,
    target: float,
    of: str,
    worst: bool,
    keep: Sequence[str],
    out: Path | None,
) -> Answer:
    """Find the cheapest tolerances, write them where asked to, and say so."""
    from cardan.errors import InputError
    from cardan.questions.accuracy.allocation import allocate
    from cardan.questions.accuracy.tolerance import Linear, WorstCase, tolerance

    from .answer import Answer
    from .asked import figures

    kept = _kept(drive, keep)
    try:
        found = allocate(drive, target, of=of, method=WorstCase() if worst else Linear(), keep=kept)
    except InputError as error:
        raise error.renamed(lambda field: {"target": "--allocate", "keep": "--keep"}.get(field, field)) from error
    values = _values(found)
    if out is not None:
        _write(drive, text, values, out)
    return Answer(
        sentence=_sentence(drive, file, found),
        tables=lambda: [_table(found)],
        remarks=tuple(_remarks(file, found, out)),
        content=lambda: _content(drive, file, found, values, out),
        csv=lambda: _table(found),
        figure=lambda: figures(tolerance(drive, found.spread, method=found.method)),
    )


def _kept(drive: Drive, keep: Sequence[str]) -> list[str]:
    """Return the paths of the tolerances to be kept; a short name is that of all joints that have it."""
    found = []
    for name in keep:
        if "[" in name:
            found.append(re.sub(r"_(arcmin|deg|rad|mm|m|cm|in|ft)$", "", name))
            continue
        short = [
            f"joints[{i}].tolerance.{name}"
            for i, joint in enumerate(drive.joints)
            if joint.tolerance is not None and getattr(joint.tolerance, name, None)
        ]
        if not short:
            raise refuse("--keep", _("no joint has a tolerance {name}").format(name=name))
        found += short
    return found


def _unit(found: Allocation) -> tuple[float, str, str]:
    """Return the unit of the answer, its suffix and its sign."""
    from cardan.questions.accuracy.allocation import Of
    from cardan.units import arcmin

    return (1e-6, "um", " µm") if found.of is Of.SHIFT else (arcmin, "arcmin", "′")


def _what(found: Allocation) -> str:
    from cardan.questions.accuracy.allocation import Of

    words = {Of.ANGLE: _("angle"), Of.CHANGE: _("angle over a turn"), Of.SHIFT: _("shift")}
    return words[found.of]


def _sentence(drive: Drive, file: Path, found: Allocation) -> str:
    from .answer import significant
    from .source import title

    unit, _suffix, sign = _unit(found)
    text = _("{name}: these tolerances keep the {what} of the output within ±{size}{sign} at the least cost")
    text = text.format(name=title(drive, file), what=_what(found), size=significant(found.target / unit, 3), sign=sign)
    saved = 1.0 - found.cost / found.equal_cost if found.equal_cost else 0.0
    if saved < 5e-4:
        return text + "."
    more = _("; equal shares would cost {more} % more.")
    return text + more.format(more=significant(100.0 * (found.equal_cost / found.cost - 1.0), 2))


def _table(found: Allocation) -> Table:
    from math import isfinite

    from .answer import Column, Table
    from .tolerance_answer import part

    unit, suffix, sign = _unit(found)
    label = f"± {sign.strip()}"
    rows = [
        (
            part(one.field),
            one.before / unit if one.before else None,
            one.tolerance / unit if isfinite(one.tolerance) else _("any"),
            _change(one.before, one.tolerance, kept=one.kept),
            one.weight,
            None if one.kept or not isfinite(one.tolerance) else 100.0 * one.cost / found.cost,
        )
        for one in found.rows
    ]
    columns = (
        Column(key="tolerance", heading=_("tolerance"), left=True),
        Column(key=f"before_{suffix}", heading=_("so far"), unit=label),
        Column(key=f"allotted_{suffix}", heading=_("allotted"), unit=label),
        Column(key="change", left=True),
        Column(key="weight", heading=_("weight"), form=".4g"),
        Column(key="cost_percent", heading=_("of the cost"), unit="%", form=".1f"),
    )
    return Table(columns=columns, rows=rows)


def _change(before: float, after: float, *, kept: bool) -> str:
    if kept:
        return _("kept")
    if not before:
        return _("new")
    return _("tighter") if after < before * (1.0 - 1e-9) else _("wider") if after > before * (1.0 + 1e-9) else ""


def _values(found: Allocation) -> dict[str, float]:
    """Return key -> value of the tolerances found, rounded down."""
    from math import floor, isfinite, log10

    from cardan.questions.accuracy.allocation import Of

    unit, suffix, _sign = _unit(found)
    if found.of is Of.SHIFT:
        unit, suffix = 1e-3, "mm"
    values = {}
    for one in found.rows:
        if one.kept or not isfinite(one.tolerance):
            continue
        size = one.tolerance / unit
        digits = DIGITS - 1 - floor(log10(size))
        values[f"{one.field}_{suffix}"] = round(floor(size * 10.0**digits) / 10.0**digits, max(digits, 0))
    return values


def _write(drive: Drive, text: str, values: dict[str, float], out: Path) -> None:
    from cardan.drive.fields.paths import with_values
    from cardan.io import dumps, edit

    from .output import write_text

    if out.suffix.lower() == ".json" or text.lstrip().startswith("{"):
        form = "json" if out.suffix.lower() == ".json" else "toml"
        written = dumps(with_values(drive, values), form=form)
    else:
        written = edit(text, values)
    write_text(out, written, "--out")


def _remarks(file: Path, found: Allocation, out: Path | None) -> Iterator[Remark]:
    from cardan.figures.wording import closely
    from cardan.questions.accuracy.tolerance import WorstCase

    from .answer import Remark
    from .asked import degrees
    from .source import STDIN

    angles = [f"{degrees(angle):.0f}°" for angle in found.binding]
    where = ", ".join(angles) if len(angles) <= MOST_ANGLES else _("{count} angles").format(count=len(angles))
    how = _("in the worst case") if isinstance(found.method, WorstCase) else _("by root of squares")
    text = _("The target is reached {how} at {where}; a tolerance t costs weight/t (joints.tolerance.cost).")
    yield Remark(text=text.format(how=how, where=where))
    text = _("No cheaper ones exist: the cost is proved to be the least {closely}.")
    yield Remark(text=text.format(closely=closely(found.optimality)))
    if out is not None:
        yield Remark(text=_("{path}: tolerances written, rounded down.").format(path=out), tone="good")
        yield Remark(text=_("Look at what they leave:"), command=("cardan", "tolerance", str(out)), tone="next")
    elif file != STDIN:
        from .tolerance_answer import goal

        asked = ("--allocate", goal(found.target, length=_unit(found)[1] == "um"), *_options(found))
        text = _("Write them into a copy of the file:")
        parts = ("cardan", "tolerance", str(file), *asked, "-o", "better.toml")
        yield Remark(text=text, command=parts, tone="next")


def _options(found: Allocation) -> list[str]:
    from cardan.questions.accuracy.allocation import Of
    from cardan.questions.accuracy.tolerance import WorstCase

    options = ["--of", "change"] if found.of is Of.CHANGE else []
    options += ["--method", "worst"] if isinstance(found.method, WorstCase) else []
    return options + [word for one in found.rows if one.kept for word in ("--keep", one.field)]


def _content(drive: Drive, file: Path, found: Allocation, values: dict[str, float], out: Path | None) -> dict[str, Any]:
    from math import isfinite

    import numpy as np

    from cardan.questions.accuracy.tolerance import WorstCase

    unit, suffix, _sign = _unit(found)
    return {
        "question": "tolerance",
        "drive": drive.name,
        "file": str(file),
        "of": str(found.of),
        "method": "worst" if isinstance(found.method, WorstCase) else "squares",
        f"target_{suffix}": found.target / unit,
        f"largest_{suffix}": found.largest / unit,
        "cost": found.cost,
        "equal_cost": found.equal_cost,
        "optimality": found.optimality,
        "binding_deg": np.rad2deg(found.binding),
        "tolerances": [
            {
                "field": one.field,
                f"before_{suffix}": one.before / unit if one.before else None,
                f"allotted_{suffix}": one.tolerance / unit if isfinite(one.tolerance) else None,
                "weight": one.weight,
                "cost": one.cost,
                "kept": one.kept,
            }
            for one in found.rows
        ],
        "values": values,
        "written": None if out is None else str(out),
    }
