"""Keys of the drive file in words: ``shafts[3].yoke_angle`` is the yoke angle of shaft 4."""

from __future__ import annotations

import re
from collections.abc import Sequence

from cardan.answers.quantity import Joined, Say, Text, Written, say
from cardan.texts import _, mark

from .keys import key_of, meant

_FIELD = re.compile(r"([A-Za-z_][A-Za-z0-9_]*)((?:\[\d+\])*)$")
_WRITTEN = re.compile(r"([^\[\]]+)((?:\[\d+\])*)$")  # likewise, where a key may be wrong

CLAUSE = re.compile(r"[;,，；(\[]")  # where the words that name a field end and those on its sign and its form begin
STEP = re.compile(r"([a-z]+)(?:\[(\d+)\])?")  # part of a drive, with its number from 0 where there are several
AXES = re.compile(r"\[([012])\]$")  # coordinate of a point
POINTS = ("centre[", "point[", "centre_", "point_")  # how a key begins that holds one


def written(*paths: str) -> Joined:
    """Return keys as they are written, or what they mean where nobody writes them."""
    return Joined([key_text(path) for path in paths])


def needed(lacking: Sequence[Sequence[str]]) -> Say:
    """Return in a sentence what is to be added to the drive file.

    lacking: paths; of each inner tuple any one would do.
    """
    keys = Joined([Joined(written(*some).parts, between=_(" or ")) for some in lacking], between="; ")
    return say(_("This answer needs more in the drive file: {keys}."), keys=keys)


def key_text(path: str, name: Text | None = None, within: str = "{key}") -> Written:
    """Return a key as it is written, as a page counts it, or what it means where nobody writes it.

    name: what it means, with what stands about it; in_words of the path when not given.
    within: what stands about the key.
    """
    key = key_of(path)
    return Written(within.format(key=key), in_words(path) if name is None else name, within.format(key=counted(key)))


def part_number(path: str) -> int:
    """Return the number of the part to which a path leads, counted from 1.

    >>> part_number("shafts[2].unbalance")
    3
    """
    return int(re.findall(r"\d+", path)[0]) + 1


TITLES = {
    "joints": mark("Joint {number}"),
    "shafts": mark("Shaft {number}"),
    "supports": mark("Support {number}"),
    "stations": mark("Station {number}"),
    "movements": mark("Movement {number}"),
    "poses": mark("Pose {number}"),
}
"""List of tables of a drive file -> what one of them is called on a page."""


def counted(path: str) -> str:
    """Return a path as a page counts, the names of keys as the file has them; a name of something else as it is.

    >>> counted("shafts[2].parts[0].mass_kg")
    'Shaft 3 · parts 1 · mass_kg'
    >>> counted("joints[0].centre_mm[2]")
    'Joint 1 · centre_mm z'
    >>> counted("supports[0].größe")
    'Support 1 · größe'
    """
    if "[" not in path:
        return path
    words = [(_WRITTEN if k else _FIELD).fullmatch(word) for k, word in enumerate(path.split("."))]
    told: list[str] = []
    for word in words:
        if word is None:  # the name of a file, say
            return path
        name, *numbers = (word[1], *(int(k) for k in re.findall(r"\d+", word[2])))
        if name in TITLES and numbers:
            name = _(TITLES[name]).format(number=numbers.pop(0) + 1)
        places = "xyz" if name.startswith(POINTS) else "123456789"
        told.append(" ".join([name, *(places[k] if k < len(places) else str(k + 1) for k in numbers)]))
    return " · ".join(told)


def in_words(path: str, *, inside: str = "", doc: str = "") -> str:
    """Return what stands at a path of the drive file, in words, with parts counted as people count them.

    inside: the path of a part that need not be named.
    doc: what it means, not translated, where kinds of a part mean different things by one key.
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
        **({"point": _("point of the input axis")} if path.startswith("input.") else {}),
        **({"point": _("point of the output axis")} if path.startswith("output.") else {}),
        "speed_range[1]": _("highest speed"),
    }
    name = path.rpartition(".")[2]
    axis = AXES.search(name) if name.startswith(POINTS) else None
    bare = AXES.sub("", path)
    field = bare.rpartition(".")[2]
    doc = doc or meant(bare)
    said = short.get(name) or short.get(field) or CLAUSE.split(_(doc) if doc else field.replace("_", " "))[0].strip()
    if axis:
        said += f", {'xyz'[int(axis[1])]}"
    parts = []
    for step in bare.removeprefix(f"{inside}.").split("."):
        found = STEP.fullmatch(step)
        if found and found[1] in owners and step != name:
            parts.append(owners[found[1]].format(number=int(found[2] or 0) + 1))
    return f"{', '.join(parts)}: {said}" if parts else said
