"""A change of one key of a drive: what it is, and the drive with it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from cardan.catalogue import Catalogue, catalogue, completed, material, shortened
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import place, with_values

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
