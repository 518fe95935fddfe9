"""The keys of the drive file one by one: path, units, allowed values, default, meaning, and how examples write them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, is_dataclass
from functools import cache
from typing import Any, get_args, get_origin

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import KINDS, USUAL
from cardan.io.examples import example_names, example_text
from cardan.reading.fields import Field, fields_of
from cardan.texts import _
from cardan.units import DIMENSIONS

from .schema import default_of, kind_of


@dataclass(frozen=True, kw_only=True)
class FileKey:
    """A key of the drive file."""

    path: str  # with its unit, as ``joints[].cross.span_mm``
    kinds: tuple[str, ...]  # kinds of joints, movements or torques that have it; empty for all
    units: tuple[str, ...]  # units it may end in, the one that cardan writes first
    value: str  # what it holds and which values are allowed
    default: str  # empty where there is none
    required: bool
    meaning: str

    @property
    def name(self) -> str:
        """Its last part."""
        return self.path.rpartition(".")[2].removesuffix("[]")


def file_keys(under: str = "") -> tuple[FileKey, ...]:
    """Return the keys of the drive file, in its order, in the language spoken here.

    under: a path or a part of one, as ``joints.cross`` or ``shafts[0].spline``: only keys at it or below.

    >>> [key.path for key in file_keys("input")]
    ['input', 'input.point_mm', 'input.start_phase_deg']
    >>> file_keys("joints[1].cross.span_in")[0].path
    'joints[].cross.span_mm'
    """
    wanted = re.sub(r"\[\d*\]", "", under)
    found = [_key(path, fields) for path, fields in _paths().items()]
    named = [key for key in found if wanted in _spelled(key)]
    below = tuple(f"{key.path.replace('[]', '')}." for key in named) or (f"{wanted}.", f"{wanted}_")
    return tuple(key for key in found if not wanted or key in named or key.path.replace("[]", "").startswith(below))


def _spelled(key: FileKey) -> set[str]:
    """Return the ways to write the path of a key: without a unit, and with each that it may have."""
    path = key.path.replace("[]", "")
    stem = path.rpartition("_")[0] if key.units else path
    return {path, stem, *(f"{stem}_{unit}" for unit in key.units)}


def _key(path: str, fields: list[tuple[str, Field]]) -> FileKey:
    one = fields[0][1]
    return FileKey(
        path=path,
        kinds=() if any(not kind for kind, _one in fields) else tuple(kind for kind, _one in fields),
        units=tuple(DIMENSIONS[one.key.dimension]) if one.key.dimension else (),
        value=kind_of(one, USUAL.get(one.name, "") if one.key.dimension else "").replace("`", ""),
        default="" if one.required else default_of(one).replace("`", ""),
        required=one.required,
        meaning=_(one.key.doc),
    )


@cache
def _paths() -> dict[str, list[tuple[str, Field]]]:
    """Return every path with the fields that stand there, with the kind that has it, "" where all have it."""
    found: dict[str, list[tuple[str, Field]]] = {}
    for path, kind, one in _below(Drive, "", ""):
        found.setdefault(path, []).append((kind, one))
    return found


def _below(cls: Any, before: str, kind: str) -> Iterator[tuple[str, str, Field]]:
    """Yield path, kind and field of every key of a class and of the tables in it."""
    for one in fields_of(cls).values():
        inner, many = one.type, False
        if get_origin(inner) is tuple and is_dataclass(get_args(inner)[0]):
            inner, many = get_args(inner)[0], True
        spelling = f"{one.name}_{USUAL[one.name]}" if one.name in USUAL and one.key.dimension else one.spelling
        path = f"{before}{spelling}{'[]' if many else ''}"
        yield path, kind, one
        if inner in KINDS:
            every = KINDS[inner][0]
            for name, own in every.items():
                alone = [key for key in fields_of(own) if not all(key in fields_of(other) for other in every.values())]
                for below, _kind, field in _below(own, f"{path}.", name):
                    first = below.removeprefix(f"{path}.").partition(".")[0].removesuffix("[]")
                    yield below, name if any(fields_of(own)[key].spelling == first for key in alone) else "", field
        elif is_dataclass(inner):
            yield from _below(inner, f"{path}.", kind)


def written_in_examples(key: FileKey) -> str:
    """Return how a shipped example gives a key, as the line has it; empty where none does.

    >>> written_in_examples(file_keys("duty.speed")[0]).startswith("speed_rpm = ")
    True
    """
    pattern = re.compile(rf"(?<![\w.]){re.escape(key.name)} = (\"[^\"]*\"|\[[^\[\]]*\]|\{{[^{{}}]*\}}|[^\s,}}#]+)")
    table = key.path.replace("[]", "").split(".")[:-1]
    for name in example_names():
        text = example_text(name)
        for match in pattern.finditer(text):
            if _stands_in(text, match.start(), table):
                return match[0]
    return ""


def _stands_in(text: str, place: int, table: list[str]) -> bool:
    """Return whether the last heading or inline table before a place in a TOML text ends like the path of a table."""
    heads = re.findall(r"^\[+([\w.]+)\]+|([\w.]+) = [\[{]", text[:place], re.M)
    line = text[text.rfind("\n", 0, place) + 1 : place]
    within = re.findall(r"([\w.]+) = [\[{]", line) if "{" in line else []
    heading = next((one for one, _inline in reversed(heads) if one), "")
    return [*filter(None, heading.split(".")), *(part for one in within for part in one.split("."))] == table
