"""Names in a drive and what the catalogue says of them: materials by grade, joints by size, parts of supports."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass, replace
from typing import Any

from cardan.drive.drive import Drive
from cardan.drive.fields.names import by_name, grades, names_rows
from cardan.drive.joints import Joint, other_kinds
from cardan.drive.material import Material
from cardan.drive.shaft import Ply
from cardan.drive.support import Support
from cardan.errors import InputError, Problem, check
from cardan.texts import _

from .catalogue import Catalogue, catalogue, material, ply
from .rows import Bearing, JointSize, JointType, Row, ShaftSeal

SIZED = ("mass", "cross", "needles", "yoke", "rating")
"""Fields of a joint that a size of the catalogue fills where the drive does not give them."""

BORNE: Mapping[str, tuple[type[Row], tuple[str, ...]]] = {
    "bearing": (Bearing, ("bore", "capacity", "static_capacity", "max_speed")),
    "seal": (ShaftSeal, ("seal_diameter", "max_lip_speed")),
}
"""Field of a support that names a row -> what the row is, and the fields that it fills."""


def completed(drive: Drive, known: Catalogue | None = None) -> Drive:
    """Return a drive whose grades and sizes carry the figures of the catalogue; what the drive gives itself stays.

    known: the shipped one when not given.
    Raises InputError: grades, sizes and types that the catalogue does not have, all at once, each with the nearest.

    >>> from cardan.parts import Shaft
    >>> tube = Shaft(number=2, outer=0.06, wall=0.002, length=1.0, material=Material(grade="C22"))
    >>> completed(replace(Drive.from_angles([0.1, 0.1]), shafts=(tube,))).shafts[1].material.yield_strength
    245000000.0
    """
    if not names_rows(drive):
        return drive
    rows = known or catalogue()
    problems = list(_unknown(drive, rows))
    check(problems)
    joints = tuple(_sized(joint, rows) for joint in drive.joints)
    supports = tuple(_borne(support, rows) for support in drive.supports)
    whole: Drive = _graded(replace(drive, joints=joints, supports=supports), rows)
    return whole


def filled(drive: Drive, known: Catalogue | None = None) -> Drive:
    """Return a drive completed; one that names catalogue files stays as these filled it when it was loaded.

    known: the shipped one when not given.
    Raises InputError: names that the catalogue does not have, in a drive that names no files of its own.
    """
    try:
        return completed(drive, known)
    except InputError:
        if not drive.settings.catalogues:
            raise
        return drive


def sized(drive: Drive, known: Catalogue | None = None) -> Drive:
    """Return a drive completed for a picture: one whose joints name sizes that nobody knows is drawn without them."""
    with suppress(InputError):
        named = any(joint.size for joint in drive.joints) or any(one.bearing or one.seal for one in drive.supports)
        return filled(drive, known) if named else drive
    return drive


def shortened(drive: Drive, known: Catalogue | None = None) -> Drive:
    """Return a drive without the figures that its grades and sizes stand for: what its file says.

    known: the shipped one when not given.
    """
    rows = known or catalogue()
    bare: Drive = _ungraded(drive, rows)
    return replace(
        bare,
        joints=tuple(_unsized(joint, rows) for joint in drive.joints),
        supports=tuple(_unborne(support, rows) for support in drive.supports),
    )


def _unknown(drive: Drive, rows: Catalogue) -> Iterator[Problem]:
    for path, one in grades(drive):
        try:
            _filled_in(one, rows, path)
        except InputError as error:
            yield from error.problems
    for i, joint in enumerate(drive.joints):
        for name, cls in (("size", JointSize), ("type", JointType)):
            given = getattr(joint, name)
            try:
                if given:
                    rows.row(cls, given, field=f"joints[{i}].{name}")
            except InputError as error:
                yield from error.problems
        if others := other_kinds(joint, joint.type):
            text = _("{type} is a type of kind {kinds}, and this joint is of kind {kind}")
            said = text.format(type=repr(joint.type), kinds=", ".join(others), kind=joint.in_words())
            yield Problem(f"joints[{i}].type", said, "inconsistent")
    for k, support in enumerate(drive.supports):
        for name, (kind, _filled) in BORNE.items():
            given = getattr(support, name)
            try:
                if given:
                    rows.row(kind, given, field=f"supports[{k}].{name}")
            except InputError as error:
                yield from error.problems


def _filled_in(thing: Material | Ply, rows: Catalogue, path: str = "") -> Material | Ply:
    """Return a material or a ply with the figures of its grade."""
    if isinstance(thing, Ply):
        return ply(thing.grade, known=rows, field=path)
    rows.grade(thing.grade, field=path)
    return material(thing.grade, known=rows)


def _sized(joint: Joint, rows: Catalogue) -> Joint:
    if not joint.size:
        return joint
    row = rows.row(JointSize, joint.size)
    own = [name for name in SIZED if name not in joint.foreign]
    filled = {name: _over(getattr(joint, name), getattr(row, name)) for name in own}
    return replace(joint, **filled, type=joint.type or row.type)


def _over(given: Any, usual: Any) -> Any:
    """Return a part as given, its missing fields as usual."""
    if given is None or usual is None or isinstance(given, float):
        return usual if given is None else given
    blank = {one.name: one.default for one in fields(given)}
    missing = [name for name, default in blank.items() if getattr(given, name) == default]
    return replace(given, **{name: getattr(usual, name) for name in missing})


def _borne(support: Support, rows: Catalogue) -> Support:
    found: dict[str, Any] = {}
    for naming, (kind, names) in BORNE.items():
        if given := getattr(support, naming):
            row = rows.row(kind, given)
            found |= {name: _over(getattr(support, name), getattr(row, name)) for name in names}
    return replace(support, **found) if found else support


def _unborne(support: Support, rows: Catalogue) -> Support:
    bare: dict[str, Any] = {}
    for naming, (kind, names) in BORNE.items():
        row = rows.rows(kind).get(getattr(support, naming))
        if row is not None:
            bare |= {name: _under(getattr(support, name), getattr(row, name), rows) for name in names}
    return replace(support, **bare) if bare else support


def _unsized(joint: Joint, rows: Catalogue) -> Joint:
    row = rows.rows(JointSize).get(joint.size) if joint.size else None
    if row is None:
        return joint
    kept = {name: _under(getattr(joint, name), _graded(getattr(row, name), rows), rows) for name in SIZED}
    return replace(joint, **kept, type="" if joint.type == row.type else joint.type)


def _under(given: Any, usual: Any, rows: Catalogue) -> Any:
    """Return a part without what is usual, None where nothing is left."""
    if given is None or usual is None or given == usual or isinstance(given, float):
        return None if given == usual else given
    blank = {one.name: one.default for one in fields(given)}
    same = [name for name in blank if getattr(given, name) == getattr(usual, name)]
    return _ungraded(replace(given, **{name: blank[name] for name in same}), rows)


def _graded(thing: Any, rows: Catalogue) -> Any:
    """Return a thing whose materials carry the figures of their grades."""
    if isinstance(thing, Material | Ply):
        return _filled_in(thing, rows) if by_name(thing) else thing
    return _changed(thing, lambda inner: _graded(inner, rows))


def _ungraded(thing: Any, rows: Catalogue) -> Any:
    """Return a thing whose materials are names alone where the catalogue says the rest."""
    if isinstance(thing, Material | Ply):
        try:
            same = bool(thing.grade) and thing == _filled_in(thing, rows)
        except InputError:
            return thing
        return type(thing)(grade=thing.grade) if same else thing
    return _changed(thing, lambda inner: _ungraded(inner, rows))


def _changed(thing: Any, change: Any) -> Any:
    if isinstance(thing, tuple):
        return tuple(change(item) for item in thing)
    if not is_dataclass(thing) or isinstance(thing, type):
        return thing
    new = {one.name: change(getattr(thing, one.name)) for one in fields(thing) if one.init}
    altered = {
        name: value
        for name, value in new.items()
        if value is not getattr(thing, name) and value != getattr(thing, name)
    }
    return replace(thing, **altered) if altered else thing
