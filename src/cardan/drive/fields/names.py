"""Names in a drive that the catalogue knows: grades of materials, sizes and types of joints, bearings of supports."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import Any

from cardan.drive.described import Described
from cardan.drive.material import Material
from cardan.drive.shaft import Ply


def names_rows(drive: Described) -> bool:
    """Tell whether a drive names anything of the catalogue, or catalogue files of its own."""
    return (
        bool(drive.settings.catalogues)
        or any(joint.size or joint.type for joint in drive.joints)
        or any(support.bearing or support.seal for support in drive.supports)
        or any(True for _named in grades(drive))
    )


def by_name(thing: Material | Ply) -> bool:
    """Tell whether a material or a ply is given by its name alone."""
    return bool(thing.grade) and thing == type(thing)(grade=thing.grade)


def grades(thing: Any, path: str = "") -> Iterator[tuple[str, Material | Ply]]:
    """Yield path and thing of every material and ply that is given by its name alone."""
    if isinstance(thing, Material | Ply):
        if by_name(thing):
            yield path, thing
    elif isinstance(thing, tuple):
        for k, item in enumerate(thing):
            if is_dataclass(item):
                yield from grades(item, f"{path}[{k}]")
    elif is_dataclass(thing):
        for one in fields(thing):
            yield from grades(getattr(thing, one.name), f"{path}.{one.name}" if path else one.name)
