"""Where the figures of a drive come from that it does not give itself: rows of the catalogue, and how sure they are."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from cardan.drive.drive import Drive
from cardan.errors import InputError
from cardan.texts import _

from .catalogue import Catalogue, ply
from .completion import BORNE
from .rows import UNSURE, JointSize, Lamina, Row, sureness

_STEP = re.compile(r"(\w+)((?:\[\d+\])*)")
_PART = re.compile(r"joints\[(\d+)\]\.\w+\.")
_HOLD = re.compile(r"supports\[(\d+)\]\.(\w+)$")


def rows_behind(drive: Drive, known: Catalogue, *paths: str) -> tuple[Row, ...]:
    """Return the rows of the catalogue whose figures stand at paths: sizes, bearings, seals, grades of materials.

    drive: filled in from the catalogue; a figure that differs from that of its size or its grade is its own.
    paths: without units, as ``joints[0].cross.span`` or ``shafts[1].material.yield_strength``.
    """
    found: dict[str, Row] = {}
    for path in paths:
        row = _row(drive, known, path)
        if row is not None and (row.id not in found or sureness(row.confidence) < sureness(found[row.id].confidence)):
            found[row.id] = row
    return tuple(found.values())


def unconfirmed(rows: tuple[Row, ...]) -> tuple[str, ...]:
    """Return in words the rows that nothing confirms."""
    text = _("{row} ({sure})")
    return tuple(text.format(row=row.id, sure=_(UNSURE[row.confidence])) for row in rows if row.confidence in UNSURE)


def _row(drive: Drive, known: Catalogue, path: str) -> Row | None:
    """Return the row whose figure stands at a path; None where the drive gives it itself, or nothing stands there."""
    holder, _dot, name = path.rpartition(".")
    if holder.endswith(".material"):
        material = _at(drive, holder)
        try:
            grade = known.grade(material.grade) if material is not None and material.grade else None
        except InputError:
            return None
        if grade is None or getattr(grade, name, None) != getattr(material, name):
            return None
        return grade if grade.id == material.grade else replace(grade, id=f"{material.grade} = {grade.id}")
    if holder.endswith(".ply"):
        own = _at(drive, holder)
        lamina = known.rows(Lamina).get(own.grade) if own is not None else None
        return lamina if lamina is not None and own == ply(own.grade, known=known) else None
    held = _HOLD.match(path)
    if held:
        support = drive.supports[int(held[1])]
        for naming, (kind, names) in BORNE.items():
            if held[2] in names:
                named = known.rows(kind).get(getattr(support, naming))
                usual = getattr(named, held[2], None)
                return named if usual is not None and usual == _at(drive, path) else None
        return None
    match = _PART.match(path)
    size = known.rows(JointSize).get(drive.joints[int(match[1])].size) if match else None
    if size is None:
        return None
    figure = path.partition(".")[2]
    usual = _at(size, figure)
    return size.sure(figure) if usual is not None and usual == _at(drive, path) else None


def _at(thing: Any, path: str) -> Any:
    """Return what stands at a path in a thing; None where nothing stands."""
    for name, places in _STEP.findall(path):
        thing = getattr(thing, name, None)
        for k in re.findall(r"\d+", places):
            thing = thing[int(k)] if thing is not None and int(k) < len(thing) else None
    return thing
