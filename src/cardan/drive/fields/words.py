"""Keys of the drive file in words: ``shafts[3].yoke_angle`` is the yoke angle of shaft 4."""

from __future__ import annotations

import re

from cardan.texts import _

from .keys import key_of, meant

CLAUSE = re.compile(r"[;,，；(\[]")
"""Where the words that name a field end and those on its sign and its form begin."""

STEP = re.compile(r"([a-z]+)(?:\[(\d+)\])?")
"""Part of a drive, with its number from 0 where there are several."""

AXES = re.compile(r"\[([012])\]$")
"""Coordinate of a point."""


def with_key(path: str) -> str:
    """Return what stands at a path in words, with the key that is typed for it.

    path: without unit.

    >>> with_key("shafts[1].outer")
    'shaft 2: outer diameter (shafts[1].outer_mm)'
    """
    return f"{in_words(path)} ({key_of(path)})"


def in_words(path: str) -> str:
    """Return what stands at a path of the drive file, in words, with parts counted as people count them.

    path: without unit.
    """
    owners = {
        "joints": _("joint {number}"),
        "shafts": _("shaft {number}"),
        "supports": _("support {number}"),
        "stations": _("station {number}"),
        "blocks": _("part {number} of the duty cycle"),
        "segments": _(", stretch {number}").lstrip(", "),
        "cross": _("cross"),
        "yoke": _("yoke"),
        "needles": _("needles"),
        "rating": _("rating"),
    }
    short = {
        "yoke_angle": _("yoke angle"),
        "joint_angle": _("joint angle"),
        "centre": _("centre"),
        "size": _("size"),
        "yield_strength": _("yield strength"),
        **({"torque": _("torque")} if path.startswith("duty.") else {}),
        "speed_range[1]": _("highest speed"),
    }
    name = path.rpartition(".")[2]
    axis = AXES.search(name) if name.startswith(("centre[", "point[")) else None
    bare = AXES.sub("", path)
    field = bare.rpartition(".")[2]
    doc = meant(bare)
    said = short.get(name) or short.get(field) or CLAUSE.split(_(doc) if doc else field.replace("_", " "))[0].strip()
    if axis:
        said += f", {'xyz'[int(axis[1])]}"
    parts = []
    for step in bare.split("."):
        found = STEP.fullmatch(step)
        if found and found[1] in owners and step != name:
            parts.append(owners[found[1]].format(number=int(found[2] or 0) + 1))
    return f"{', '.join(parts)}: {said}" if parts else said
