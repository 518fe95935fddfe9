"""Which change of one key makes a check pass that fails: how far each design variable has to be moved."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from cardan.catalogue import Catalogue, catalogue
from cardan.checks import Verdict, check
from cardan.checks.design import whole as completed_drive
from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.maths.arrays import Array

from .change import Remedy, apply_remedy
from .remedy_search import of_check


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
    >>> from cardan.drive.duty import Limits
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
    >>> from cardan.drive.duty import Limits
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
            helping,
            key=lambda one: (one.demand, len(one.breaks) - len(left & {one.title, *one.solves}), one.cost),
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
