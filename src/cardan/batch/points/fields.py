"""Fields of a drive by their paths: what a column of points means, and which drives its values make."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, get_args

import numpy as np

from cardan.batch.work import Column
from cardan.catalogue import Catalogue, catalogue, completed, shortened
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import Place, bare_path, place, read, with_values
from cardan.errors import InputError, Problem, check
from cardan.maths.arrays import Array
from cardan.mechanism.mechanism import Mechanism
from cardan.reading.fields import WORD_OR_FLAG
from cardan.reading.ranges import in_range
from cardan.texts import _, mark

_MOTION = re.compile(
    r"joints\[\d+\]\.(joint_angle|plane_twist|centre\[\d\])|(input|output)\.point\[\d\]|input\.start_phase"
    r"|shafts\[\d+\]\.(yoke_angle|side_slope|plan_slope|length)|duty\.(speed|acceleration|torque)"
)


@dataclass(frozen=True, kw_only=True)
class VaryingField:
    """A field that varies."""

    path: str  # with its unit, as in the drive file
    bare: str  # as Python writes it, without
    there: Place  # where it leads in the drive

    @property
    def unit(self) -> str:
        """Unit of its values, empty for counts, ratios, flags and words."""
        return self.there.field.unit(self.there.spelling)

    @property
    def whole(self) -> bool:
        """Whether the field holds whole numbers."""
        return self.there.field.type is int

    @property
    def moves(self) -> bool:
        """Whether it is a place or an angle that motion depends on, or speed or torque of the duty."""
        return _MOTION.fullmatch(self.bare) is not None

    @property
    def column(self) -> Column:
        """Its column in the table."""
        return Column(name=self.path, unit=self.unit, role="point", text=self.there.field.key.doc)

    def si(self, values: Array) -> Array:
        """Return values in SI."""
        return values * self.there.factor + 0.0

    def fits(self, values: Array) -> Array:
        """Tell which values in SI lie in the range of the field, array of bool (n,)."""
        key = self.there.field.key
        low, high = float(np.min(values)), float(np.max(values))
        if in_range(key, low) and in_range(key, high):  # the range is an interval
            return np.ones(values.shape, dtype=bool)
        return np.asarray([in_range(key, one) for one in values.tolist()], dtype=bool)

    def problem(self, values: Array) -> Problem | None:
        """Return why a column (n,) cannot vary this field: words where numbers stand, and the like."""
        kind = self.there.field.type
        for _step in range(self.there.inside):
            kind = get_args(kind)[0]
        wanted = {
            float: ("f", _("a number")),
            int: ("f", _("a whole number")),
            bool: ("b", _("true or false")),
            str: ("U", _("a text")),
            WORD_OR_FLAG: ("bU", _("true, false or a word")),
        }
        signs, told = wanted.get(kind, ("fbU", ""))
        if values.dtype.kind in signs:
            return None
        text = _("{value} does not fit this field, which holds {wanted}")
        return Problem(self.path, text.format(value=repr(values[0].item())[:40], wanted=told))

    def plain(self, value: Any) -> Any:
        """Return one value of its column as the drive file would hold it."""
        one = value.item() if hasattr(value, "item") else value
        if isinstance(one, float) and one.is_integer() and self.whole:
            return int(one)
        if self.there.field.type == WORD_OR_FLAG and one in ("True", "False"):
            return one == "True"
        return one


def spots_of(drive: Drive | Mechanism, paths: Iterable[str]) -> tuple[VaryingField, ...]:
    """Return where paths lead in a drive or a mechanism."""
    problems: list[Problem] = []
    spots: list[VaryingField] = []
    for path in paths:
        try:
            there = place(drive, path)
            if there.steps[-1] == "file":
                problems.append(Problem(path, _("names a file that is read with the drive; it cannot vary")))
            elif not there.inside and isinstance(there.field.type, type(tuple[int, ...])):
                problems.append(
                    Problem(path, _("holds a list; vary one of its numbers, as in {path}[0]").format(path=path))
                )
            spots.append(VaryingField(path=path, bare=bare_path(drive, path), there=there))
        except InputError as error:
            problems += error.problems
    bare = [one.bare for one in spots]
    problems += [Problem(one.path, _("varies twice")) for k, one in enumerate(spots) if one.bare in bare[:k]]
    check(problems)
    return tuple(spots)


def spread_out(path: str, values: Sequence[Any]) -> tuple[tuple[str, ...], list[tuple[Any, ...]]]:
    """Return the paths of the single numbers of a path with lists of them, and their values row by row."""
    if not any(isinstance(one, list | tuple) for one in values):
        return (path,), [(one,) for one in values]
    sizes = {len(one) if isinstance(one, list | tuple) else 0 for one in values}
    if len(sizes) != 1 or 0 in sizes:
        check([Problem(path, _("its values are lists of different lengths"))])
    return tuple(f"{path}[{k}]" for k in range(sizes.pop())), [tuple(one) for one in values]


def present(drive: Drive | Mechanism, path: str) -> float | None:
    """Return the number at a path of a drive, in the path's unit; None where there is none."""
    value = read(drive, path)
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else None


@dataclass(frozen=True, kw_only=True)
class Maker:
    """Makes the drive of a point: the given one with other values, checked as a file would be."""

    drive: Drive | Mechanism  # the drive that everything else stands in
    spots: tuple[VaryingField, ...]
    known: Catalogue = field(default_factory=catalogue)  # where grades and sizes are looked up anew

    @cached_property
    def _bare(self) -> Drive | Mechanism:
        """The drive as its file says it, so that a size that varies brings its own figures."""
        if isinstance(self.drive, Mechanism):
            return self.drive
        named = any(one.bare.endswith((".size", ".type", ".grade", ".bearing", ".seal")) for one in self.spots)
        return shortened(self.drive, self.known) if named else self.drive

    def drive_at(self, values: Mapping[str, Any]) -> Drive | Mechanism:
        """Return the drive of one point."""
        given = {one.path: one.plain(values[one.path]) for one in self.spots}
        made = with_values(self._bare, given)
        return made if self._bare is self.drive or isinstance(made, Mechanism) else completed(made, self.known)


TEXT_STATUS = mark("0 where the point is answered, 1 where it makes no drive, 2 where a question has no answer")
"""What the column of states means."""

TEXT_FEASIBLE = mark("whether the point is answered and keeps every constraint")  # what the column of constraints means
