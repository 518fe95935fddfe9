"""How far levers have to be moved until a failed check passes, and which names of the catalogue do."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np

from cardan.catalogue import Catalogue
from cardan.catalogue.rows import Grade, JointSize
from cardan.checks import Verdict, check
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import with_values
from cardan.errors import InputError
from cardan.maths.arrays import Array

from .change import Remedy, made_of, sized
from .design_variable import DesignVariable, design_variables_of, graded, is_sized

ROUNDS, FINE = 3, 16
"""Times that the places between the last that fails and the first that passes are looked at, and how many each time."""

SIZE_STEP = 0.25
"""Change that a joint of another size counts as."""


def of_check(drive: Drive, name: str, failed: Sequence[Verdict], known: Catalogue) -> Iterator[Remedy]:
    """Yield the remedies of the failed verdicts of one check: for each design variable that with the smaller change."""
    design_variables = list(
        design_variables_of(drive, dict.fromkeys(path for one in failed for path in one.design_variables), known)
    )
    for verdict, design_variable, values in _found(drive, name, failed, design_variables, known):
        remedy = min(
            (one for value in values if (one := _rounded(drive, verdict, design_variable, value, known)) is not None),
            key=lambda one: one.change,
            default=None,
        )
        if remedy is not None:
            yield remedy
    for verdict in failed:
        yield from _by_size(drive, verdict, known)
        yield from _by_grade(drive, verdict, known)


def _found(
    drive: Drive, name: str, failed: Sequence[Verdict], design_variables: Sequence[DesignVariable], known: Catalogue
) -> Iterator[tuple[Verdict, DesignVariable, list[float]]]:
    """Yield verdicts, levers and the nearest values on either side from which the verdict passes."""
    ladders = [
        (design_variable, values)
        for design_variable in design_variables
        for side in (1.0, -1.0)
        if (values := design_variable.ladder(side)).size
    ]
    brackets = []
    for (design_variable, values), used in zip(ladders, _trial(drive, name, ladders, known), strict=True):
        for verdict in failed:
            first = _first(used.get(verdict.title))
            if design_variable.bare in verdict.design_variables and first is not None:
                fails = design_variable.now if first == 0 else float(values[first - 1])
                brackets.append((verdict, design_variable, fails, float(values[first])))
    for _round in range(ROUNDS):
        rows = [
            (design_variable, np.linspace(fails, passes, FINE + 1)[1:])
            for _verdict, design_variable, fails, passes in brackets
        ]
        for k, ((design_variable, values), used) in enumerate(zip(rows, _trial(drive, name, rows, known), strict=True)):
            verdict, _design_variable, fails, _passes = brackets[k]
            first = _first(used.get(verdict.title))
            if first is not None and not design_variable.whole:
                brackets[k] = (
                    verdict,
                    design_variable,
                    fails if first == 0 else float(values[first - 1]),
                    float(values[first]),
                )
    for verdict in failed:
        for design_variable in design_variables:
            values_of = [passes for one, its, _fails, passes in brackets if one is verdict and its is design_variable]
            if values_of:
                yield verdict, design_variable, values_of


def _first(used: Array | None) -> int | None:
    """Return the first place at which a check passes."""
    if used is None or not np.any(used <= 1.0):
        return None
    return int(np.argmax(used <= 1.0))


def _trial(
    drive: Drive, name: str, rows: Sequence[tuple[DesignVariable, Array]], known: Catalogue
) -> list[dict[str, Array]]:
    """Return the utilisations of the verdicts of a check, by their titles, for values of one design variable a row."""
    if not rows:
        return []
    ends = np.cumsum([values.size for _design_variable, values in rows])
    vary: dict[str, Array] = {}
    for (design_variable, values), end in zip(rows, ends, strict=True):
        column = vary.setdefault(
            design_variable.path, np.full(int(ends[-1]), design_variable.now / design_variable.factor)
        )
        column[end - values.size : end] = values / design_variable.factor
    try:
        with np.errstate(all="ignore"):
            verdicts = check(drive, only=[name], vary=vary, known=known)
    except InputError:
        # A row that leaves what is possible: the others go on without it.
        return [{}] if len(rows) == 1 else [one for row in rows for one in _trial(drive, name, [row], known)]
    found: list[dict[str, Array]] = [{} for _row in rows]
    for verdict in verdicts:
        if verdict.run:
            used = np.broadcast_to(np.asarray(verdict.utilisation, dtype=float), int(ends[-1]))
            for one, part in zip(found, np.split(used, ends[:-1]), strict=True):
                one[verdict.title] = part
    return found


def _rounded(
    drive: Drive, verdict: Verdict, design_variable: DesignVariable, value: float, known: Catalogue
) -> Remedy | None:
    """Return the remedy by the first round figure with which the check really passes."""
    for shown in design_variable.beyond(value):
        try:
            new = with_values(drive, {design_variable.path: shown})
            verdicts = check(new, only=[verdict.check], known=known)
        except InputError:
            continue
        after = next((one for one in verdicts if one.title == verdict.title and one.run), None)
        if after is not None and after.passed:
            step = abs(float(shown) * design_variable.factor - design_variable.now)
            scale = abs(design_variable.now) if design_variable.reach is None else design_variable.reach
            return Remedy(
                check=verdict.check,
                subject=verdict.subject,
                title=verdict.title,
                path=design_variable.path,
                now=int(design_variable.now)
                if design_variable.whole
                else round(design_variable.now / design_variable.factor, 10),
                value=shown,
                unit=design_variable.unit,
                change=step / scale,
                effort=design_variable.effort,
                note=_strong(float(shown) * design_variable.factor, known)
                if design_variable.bare.endswith("yield_strength")
                else "",
            )
    return None


def _strong(strength: float, known: Catalogue) -> str:
    """Return the weakest grade of the catalogue that has a yield strength; empty where none has."""
    strong = [row for row in known.rows(Grade).values() if row.yield_strength and row.yield_strength >= strength]
    return min(strong, key=lambda row: row.yield_strength or 0.0).id if strong else ""


def _by_grade(drive: Drive, verdict: Verdict, known: Catalogue) -> Iterator[Remedy]:
    """Yield the weakest grade with which a verdict passes, of those for such parts if there is one."""
    for bare in verdict.design_variables:
        path, _dot, name = bare.rpartition(".")
        here = graded(drive, path, known) if name in ("yield_strength", "ultimate_strength") else None
        if here is None or is_sized(drive, bare, known):
            continue
        others = [
            row for row in known.rows(Grade).values() if (row.yield_strength or 0.0) > (here.yield_strength or 0.0)
        ]
        others.sort(key=lambda row: (not set(row.parts) & set(here.parts), row.yield_strength))
        for steps, row in enumerate(others, start=1):
            new = made_of(drive, path, row.id, known)
            after = next(
                (one for one in check(new, only=[verdict.check], known=known) if one.title == verdict.title), None
            )
            if after is not None and after.run and after.passed:
                yield Remedy(
                    check=verdict.check,
                    subject=verdict.subject,
                    title=verdict.title,
                    path=f"{path}.grade",
                    now=here.id,
                    value=row.id,
                    change=SIZE_STEP * steps,
                    note=", ".join(row.names),
                )
                break


def _by_size(drive: Drive, verdict: Verdict, known: Catalogue) -> Iterator[Remedy]:
    """Yield the next larger size of a joint with which a verdict on it passes."""
    match = re.fullmatch(r"joints\[(\d+)\]", verdict.subject)
    if match is None:
        return
    i = int(match[1])
    sizes = known.rows(JointSize)
    here = sizes.get(drive.joints[i].size)
    if here is None or not any(
        re.match(rf"joints\[{i}\]\.(cross|needles|yoke|rating)", path) for path in verdict.design_variables
    ):
        return
    larger = [row for row in sizes.values() if row.type == here.type and _bulk(row) > _bulk(here)]
    for steps, row in enumerate(sorted(larger, key=_bulk), start=1):
        try:
            new = sized(drive, i, row.id, known)
            verdicts = check(new, only=[verdict.check], known=known)
        except InputError:
            continue
        after = next((one for one in verdicts if one.title == verdict.title and one.run), None)
        if after is not None and after.passed:
            yield Remedy(
                check=verdict.check,
                subject=verdict.subject,
                title=verdict.title,
                path=f"joints[{i}].size",
                now=here.id,
                value=row.id,
                change=SIZE_STEP * steps,
            )
            return


def _bulk(row: JointSize) -> float:
    """Return how large a size is: its span, else its outer diameter."""
    if row.cross is not None and row.cross.span is not None:
        return row.cross.span
    return row.rating.outer or 0.0 if row.rating is not None else 0.0
