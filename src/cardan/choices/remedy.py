"""Which change of one key makes a check pass that fails: how far each design variable has to be moved."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from cardan.catalogue import Catalogue, catalogue, completed, material, shortened
from cardan.catalogue.rows import Grade, JointSize
from cardan.checks import Verdict, check, passes
from cardan.checks.design import whole as completed_drive
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import place, with_values
from cardan.errors import InputError
from cardan.maths.arrays import Array

from .design_variable import DesignVariable, design_variables_of, graded, is_sized


def remedies(
    drive: Drive,
    verdicts: Sequence[Verdict] | None = None,
    *,
    known: Catalogue | None = None,
    progress: Callable[[float], object] | None = None,
) -> tuple[Remedy, ...]:
    """Return the smallest changes of single keys that make each failed verdict pass.

    Parameters
    ----------
    drive : Drive
    verdicts : sequence of Verdict, optional
        Of this drive; those of `cardan.check` when not given. Advice is left alone.
    known : Catalogue, optional
        The shipped one when not given.
    progress : function, optional
        Called with the share done; answering "stop" leaves the checks that come after without cures.

    Returns
    -------
    tuple of Cure
        In the order of the verdicts, for each the gentlest first: changes of the drive before lesser demands, those
        that break nothing before the others, small ones before large ones. Rounded outwards to what a drawing has, and
        tried: with the change the check passes.

    See Also
    --------
    most_helpful, apply_remedy, check

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, remedies
    >>> from cardan.parts import Limits
    >>> drive = replace(Drive.from_angles([0.1, 0.5]), limits=Limits(joint_angle=0.4))
    >>> [(remedy.path, remedy.value) for remedy in remedies(drive)]
    [('joints[1].joint_angle_deg', 22.9)]
    """
    rows = known or catalogue()
    whole = completed_drive(drive, drive.duty, rows)
    judged = check(whole, known=rows) if verdicts is None else verdicts
    failed = [one for one in judged if one.state == "failed" and not one.advice]
    found: list[Remedy] = []
    names = list(dict.fromkeys(one.check for one in failed))
    for k, name in enumerate(names, start=1):
        found += of_check(whole, name, [one for one in failed if one.check == name], rows)
        if progress is not None and progress(k / (len(names) + 1)) == "stop":
            break
    found = _with_effects(whole, found, judged, rows)
    order = {one.title: k for k, one in enumerate(failed)}
    return tuple(sorted(found, key=lambda remedy: (order[remedy.title], remedy.cost)))


def most_helpful(found: Sequence[Remedy], count: int = 3) -> tuple[Remedy, ...]:
    """Return the few changes that together make most failed verdicts pass, the most helpful first.

    Parameters
    ----------
    found : sequence of Cure
        All of a drive.
    count : int
        How many at most.

    Returns
    -------
    tuple of Cure

    See Also
    --------
    remedies, apply_remedy

    Examples
    --------
    >>> from dataclasses import replace
    >>> from cardan import Drive, most_helpful, remedies
    >>> from cardan.parts import Limits
    >>> drive = replace(Drive.from_angles([0.6, 0.5]), limits=Limits(joint_angle=0.4))
    >>> [(remedy.path, remedy.value) for remedy in most_helpful(remedies(drive))]
    [('joints[1].joint_angle_deg', 22.9), ('joints[0].joint_angle_deg', 22.9)]
    """
    left = {title for remedy in found for title in (remedy.title, *remedy.solves)}
    chosen: list[Remedy] = []
    while left and len(chosen) < count:
        helping = [remedy for remedy in found if left & {remedy.title, *remedy.solves}]
        if not helping:
            break
        best = min(
            helping, key=lambda one: (one.demand, len(one.breaks) - len(left & {one.title, *one.solves}), one.cost)
        )
        if best.demand:
            # A lesser demand that is made anyway may as well cure what changes of the drive cured before it.
            best = min(
                (one for one in helping if one.demand), key=lambda one: (len(one.breaks) - _solved(one), one.cost)
            )
        chosen.append(best)
        left -= {best.title, *best.solves}
    return tuple(sorted(chosen, key=lambda one: -_solved(one)))


def _solved(one: Remedy) -> int:
    """Return how many verdicts pass with a change that failed."""
    return len({one.title, *one.solves})


def _with_effects(drive: Drive, found: Sequence[Remedy], judged: Sequence[Verdict], known: Catalogue) -> list[Remedy]:
    """Return cures with what else they solve and break."""
    before = {one.title: one.state for one in judged if one.run and not one.advice}
    numeric = [remedy for remedy in found if not isinstance(remedy.value, str)]
    done = dict(zip(map(id, numeric), _effects(drive, numeric, known), strict=True))
    whole = []
    for remedy in found:
        after = done.get(id(remedy)) or _failing(check(apply_remedy(drive, remedy, known=known), known=known))
        failing = {title for title, bad in after.items() if bad} - {remedy.title}
        solves = (title for title, state in before.items() if state == "failed" and title not in failing)
        breaks = (title for title in failing if before.get(title) not in (None, "failed"))
        whole.append(replace(remedy, solves=tuple(solves), breaks=tuple(breaks)))
    return whole


def _effects(drive: Drive, found: Sequence[Remedy], known: Catalogue) -> list[Mapping[str, bool]]:
    """Return which verdicts fail with each remedy, all in one batch."""
    if not found:
        return []
    vary: dict[str, Array] = {}
    for k, remedy in enumerate(found):
        vary.setdefault(remedy.path, np.full(len(found), float(remedy.now)))[k] = float(remedy.value)
    try:
        with np.errstate(all="ignore"):
            verdicts = check(drive, vary=vary, known=known)
    except InputError:
        return [_failing(check(apply_remedy(drive, remedy, known=known), known=known)) for remedy in found]
    effects: list[dict[str, bool]] = [{} for _remedy in found]
    for one in verdicts:
        if one.run and not one.advice:
            for k, passed in enumerate(np.broadcast_to(np.asarray(one.passed), len(found))):
                effects[k][one.title] = not bool(passed)
    return list(effects)


def _failing(verdicts: Sequence[Verdict]) -> dict[str, bool]:
    return {one.title: one.state == "failed" for one in verdicts if one.run and not one.advice}


__all__ = ["Remedy", "apply_remedy", "most_helpful", "remedies"]


# A change of one key of a drive: what it is, and the drive with it.

_SIZE = re.compile(r"joints\[(\d+)\]\.size")


@dataclass(frozen=True, kw_only=True)
class Remedy:
    """A change of one key that makes a check pass.

    Attributes
    ----------
    check, subject, title : str
        Of the verdict that failed.
    path : str
        Key to change, with its unit: ``shafts[1].outer_mm``; or a name of the catalogue: ``joints[0].size``,
        ``shafts[1].material.grade``.
    now, value : float, int or str
        As it is and as it should be, in the unit of the path.
    unit : str
        Of both; empty for counts, ratios and sizes.
    change : float
        How much that is, over what stands there.
    solves : tuple of str
        Titles of all verdicts that failed and pass with it.
    breaks : tuple of str
        Titles of verdicts that passed and fail with it.
    effort : int
        How much has to be redone: 0 a part, 1 the place of joints between the ends, 2 that of the ends, 3 nothing: it
        asks something else of the drive (torque, speed, life).
    note : str
        What the catalogue says of the name: other names, or the grade that has a strength.
    """

    check: str
    subject: str
    title: str
    path: str
    now: float | int | str
    value: float | int | str
    unit: str = ""
    change: float = 0.0
    solves: tuple[str, ...] = ()
    breaks: tuple[str, ...] = ()
    effort: int = 0
    note: str = ""

    @property
    def demand(self) -> bool:
        """Whether it changes what is asked of the drive and leaves the drive as it is."""
        return self.effort == 3

    @property
    def cost(self) -> tuple[bool, int, int, float]:
        """What cures of one verdict are sorted by."""
        return self.demand, len(self.breaks), self.effort, self.change


def typed(value: float | int | str) -> str:
    """Return a value of a key as people would type it: to six digits, and all of a large number.

    >>> typed(15.3333333333), typed(-46.2), typed(1234567.0), typed("example-150")
    ('15.3333', '-46.2', '1234567', 'example-150')
    """
    if isinstance(value, str):
        return value
    return f"{value:.6g}" if abs(value) < 1e6 else f"{value:.10g}"


def apply_remedy(drive: Drive, remedy: Remedy, *, known: Catalogue | None = None) -> Drive:
    """Return a drive with a change put in.

    Parameters
    ----------
    drive : Drive
    remedy : Cure
    known : Catalogue, optional
        The shipped one when not given.

    Returns
    -------
    Drive
        With grades and sizes filled in.

    See Also
    --------
    remedies, most_helpful

    Examples
    --------
    >>> from cardan import Drive, Remedy, apply_remedy
    >>> path = "joints[0].joint_angle_deg"
    >>> straighter = Remedy(check="joint_angle", subject="", title="", path=path, now=20.0, value=10.0)
    >>> round(apply_remedy(Drive.from_angles([0.35]), straighter).joints[0].joint_angle, 4)
    0.1745
    """
    rows = known or catalogue()
    match = _SIZE.fullmatch(remedy.path)
    if match is not None:
        return sized(drive, int(match[1]), str(remedy.value), rows)
    if remedy.path.endswith(".material.grade"):
        return made_of(completed(drive, rows), remedy.path.removesuffix(".grade"), str(remedy.value), rows)
    return with_values(completed(drive, rows), {remedy.path: remedy.value})


def made_of(drive: Drive, path: str, grade: str, known: Catalogue) -> Drive:
    """Return a drive with a part of another grade."""
    steps = place(drive, f"{path}.grade").steps[:-1]
    made: Drive = _put(drive, steps, material(grade, known=known))
    return made


def _put(here: Any, steps: Sequence[str | int], value: Any) -> Any:
    if not steps:
        return value
    step, rest = steps[0], steps[1:]
    if isinstance(step, int):
        return (*here[:step], _put(here[step], rest, value), *here[step + 1 :])
    return replace(here, **{step: _put(getattr(here, step), rest, value)})


def sized(drive: Drive, i: int, size: str, known: Catalogue) -> Drive:
    """Return a drive with a joint of another size."""
    bare = shortened(drive, known)
    joints = [replace(one, size=size) if k == i else one for k, one in enumerate(bare.joints)]
    return completed(replace(bare, joints=tuple(joints)), known)


# How far levers have to be moved until a failed check passes, and which names of the catalogue do.

ROUNDS, FINE = 3, 16
"""Times that the places between the last that fails and the first that passes are looked at, and how many each time."""

SIZE_STEP = 0.25
"""Change that a joint of another size counts as."""


def of_check(drive: Drive, name: str, failed: Sequence[Verdict], known: Catalogue) -> Iterator[Remedy]:
    """Yield the remedies of the failed verdicts of one check: for each design variable that with the smaller change."""
    last: dict[str, float] = {}
    design_variables = list(
        design_variables_of(drive, dict.fromkeys(path for one in failed for path in one.design_variables), known)
    )
    for verdict, design_variable, values in _found(drive, name, failed, design_variables, known):
        remedy = min(
            (
                one
                for value in values
                if (one := _rounded(drive, verdict, design_variable, value, known, last)) is not None
            ),
            key=lambda one: one.change,
            default=None,
        )
        if remedy is not None:
            yield remedy
    for verdict in failed:
        yield from _by_size(drive, verdict, known, last)
        yield from _by_grade(drive, verdict, known, last)


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
            if first is not None and not design_variable.stepped:
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
    drive: Drive,
    verdict: Verdict,
    design_variable: DesignVariable,
    value: float,
    known: Catalogue,
    last: dict[str, float],
) -> Remedy | None:
    """Return the remedy by the first round figure with which the check really passes; last: as of `passes`."""

    def helps(shown: float) -> bool:
        try:
            other = with_values(drive, {design_variable.path: shown})
            return passes(other, verdict.check, verdict.title, known=known, last=last)
        except InputError:
            return False

    first, *more = list(design_variable.beyond(value)) or [design_variable.now]
    if helps(first):
        shown = first
    elif more and helps(more[-1]):  # a trial is dear: where the farthest does not help, those between are not tried
        shown = next((one for one in more[:-1] if helps(one)), more[-1])
    else:
        return None
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


def _strong(strength: float, known: Catalogue) -> str:
    """Return the weakest grade of the catalogue that has a yield strength; empty where none has."""
    strong = [row for row in known.rows(Grade).values() if row.yield_strength and row.yield_strength >= strength]
    return min(strong, key=lambda row: row.yield_strength or 0.0).id if strong else ""


def _by_grade(drive: Drive, verdict: Verdict, known: Catalogue, last: dict[str, float]) -> Iterator[Remedy]:
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
        made = partial(_graded, drive, path, known)
        strongest = max(
            others, key=lambda row: (row.yield_strength or 0.0) + (row.ultimate_strength or 0.0), default=None
        )
        if strongest is not None and _helps(verdict, made, strongest, known, last):
            yield from _replaced(verdict, f"{path}.grade", here, others, made, known, last)


def _graded(drive: Drive, path: str, known: Catalogue, row: Grade) -> Drive:
    return made_of(drive, path, row.id, known)


def _sized(drive: Drive, i: int, known: Catalogue, row: JointSize) -> Drive:
    return sized(drive, i, row.id, known)


def _by_size(drive: Drive, verdict: Verdict, known: Catalogue, last: dict[str, float]) -> Iterator[Remedy]:
    """Yield the next larger size of a joint with which a verdict on it passes."""
    match = re.fullmatch(r"joints\[(\d+)\]", verdict.subject)
    if match is None:
        return
    i = int(match[1])
    here = known.rows(JointSize).get(drive.joints[i].size)
    if here is None or not any(
        re.match(rf"joints\[{i}\]\.(cross|needles|yoke|rating)", path) for path in verdict.design_variables
    ):
        return
    larger = [row for row in known.offered(here.id) if row.type == here.type and _bulk(row) > _bulk(here)]
    better = sorted(larger, key=_bulk)
    made = partial(_sized, drive, i, known)
    yield from _replaced(verdict, f"joints[{i}].size", here, better, made, known, last)


def _replaced(
    verdict: Verdict,
    path: str,
    here: Grade | JointSize,
    rows: Sequence[Any],
    changed: Callable[[Any], Drive],
    known: Catalogue,
    last: dict[str, float],
) -> Iterator[Remedy]:
    """Yield the first of better rows of the catalogue in place of the one here with which a verdict passes."""
    for steps, row in enumerate(rows, start=1):
        if _helps(verdict, changed, row, known, last):
            yield Remedy(
                check=verdict.check,
                subject=verdict.subject,
                title=verdict.title,
                path=path,
                now=here.id,
                value=row.id,
                change=SIZE_STEP * steps,
                note=", ".join(row.names) if isinstance(row, Grade) else "",
            )
            return


def _helps(
    verdict: Verdict, changed: Callable[[Any], Drive], row: Grade | JointSize, known: Catalogue, last: dict[str, float]
) -> bool:
    """Return whether a verdict passes with a row of the catalogue; last: as of `passes`."""
    try:
        return passes(changed(row), verdict.check, verdict.title, known=known, last=last)
    except InputError:
        return False


def _bulk(row: JointSize) -> float:
    """Return how large a size is: its span, else its outer diameter."""
    if row.cross is not None and row.cross.span is not None:
        return row.cross.span
    return row.rating.outer or 0.0 if row.rating is not None else 0.0
