"""What the drive file gives beside the geometry, part by part: duty, sizes, tubes, splines, supports, with sources."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, fields, is_dataclass
from typing import Any

from cardan.answers import answer
from cardan.answers.answer import Column, Value
from cardan.answers.quantity import Joined, Quantity, Text, say
from cardan.drive.drive import Drive
from cardan.drive.fields.paths import bare_path, place
from cardan.drive.fields.wording import in_words
from cardan.drive.joint_parts import Rating
from cardan.drive.joints.hooke import Hooke
from cardan.drive.movement import Movement
from cardan.drive.settings import Pose
from cardan.reading.fields import fields_of, scaled
from cardan.texts import _

from .answer import SURE
from .catalogue import Catalogue, catalogue
from .completion import filled, shortened
from .provenance import rows_behind

SHOWN = {
    "shafts": ("number", "name", "length", "side_slope", "plan_slope", "yoke_angle", "yoke_fixed", "weight"),
    "joints": ("name", "joint_angle", "plane_twist", "centre", "phase"),
    "supports": ("name",),
    "stations": ("name",),
    "cases": ("name",),
    "blocks": (),
    "duty": ("cases", "blocks"),
    "limits": (),
    "movements": ("name", "moves"),
}
"""Part of the drive -> what of it stands in other tables of the page, or above its column."""


FILLED = (
    *("type", "mass", "span", "journal", "bore", "capacity", "static_capacity", "yield_strength", "ultimate_strength"),
    *(one.name for one in fields(Rating)),
)
"""Names of the keys that are shown too where the catalogue fills them in; others only where the file gives them."""


HOURS = 7200.0
"""Time from which it is told in hours [s]."""


@dataclass(frozen=True)
class _Given:
    """What the drives says of one part."""

    head: str
    values: dict[tuple[str, str], Value] = field(default_factory=dict)  # part of it, words -> what is given


def inputs(drive: Drive, known: Catalogue | None = None) -> Iterator[answer.Table]:
    """Yield a table for each kind of part of which the file gives more than the geometry: a row each key it has.

    drive: as its file has it; known: the catalogue that fills in sizes and grades, the shipped one when not given.
    """
    whole, bare = filled(drive, known), shortened(drive, known)
    names = {
        "duty": (_("Duty"), [""]),
        "cases": (_("Load cases"), [one.name for one in whole.duty.cases]),
        "blocks": (_("Duty cycle"), [str(k) for k in range(1, len(whole.duty.blocks) + 1)]),
        "joints": (_("Sizes and ratings of the joints"), _numbered(whole.joints, _("joint {number}"))),
        "shafts": (_("Tubes, materials, splines"), _numbered(whole.shafts, _("shaft {number}"))),
        "supports": (_("Supports"), _numbered(whole.supports, _("support {number}"))),
        "stations": (_("Masses that turn with the shafts"), _numbered(whole.stations, _("station {number}"))),
        "limits": (_("Limits set in the file"), [""]),
        "movements": (_("Movements"), [_moving(one) for one in whole.movements]),
    }
    for name, (title, heads) in names.items():
        start = "duty." if name in ("cases", "blocks") else ""
        paths = [name] if name in ("duty", "limits") else [f"{start}{name}[{k}]" for k in range(len(heads))]
        parts = zip(heads, _parts(bare, name), _parts(whole, name), paths, strict=True)
        given = [_Given(head, _of(own, full, path, SHOWN[name])) for head, own, full, path in parts]
        if any(one.values for one in given):
            yield _table(title, [one for one in given if one.values])
    if drive.poses:
        yield _table(_("Poses"), [_posed(drive, one) for one in drive.poses])


def _moving(one: Movement) -> str:
    """Return what moves how."""
    numbered = re.compile(r"joints\[(\d+)\]")
    ends = {"input": _("input"), "output": _("output")}
    points = (
        ends.get(name) or numbered.sub(lambda k: _("joint {number}").format(number=int(k[1]) + 1), name)
        for name in one.moves
    )
    return f"{one.name or one.kind}: {', '.join(points)}"


def _posed(drive: Drive, pose: Pose) -> _Given:
    """Return what a pose changes, and how long the drive stands so."""
    found = _Given(pose.name)
    if pose.share is not None:
        found.values["", _("share of the whole time")] = _value(pose.share, "share", ())
    for path, value in pose.set:
        there = place(drive, path)
        key = there.field.key
        found.values["", in_words(bare_path(drive, path))] = _value(
            scaled(value, there.factor), key.dimension or "", key.choices
        )
    return found


def sources(drive: Drive, known: Catalogue | None = None) -> Iterator[Text]:
    """Yield where figures come from that the file does not give itself: rows of the catalogue, how sure they are."""
    rows, whole = known or catalogue(), filled(drive, known)
    paths = [
        *(path for k, one in enumerate(whole.joints) for path, _words, _value in _leaves(one, f"joints[{k}]")),
        *(path for k, one in enumerate(whole.shafts) for path, _words, _value in _leaves(one, f"shafts[{k}]")),
        *(path for k, one in enumerate(whole.supports) for path, _words, _value in _leaves(one, f"supports[{k}]")),
    ]
    text = _("{row}: {source}; {sure}.")
    for row in rows_behind(whole, rows, *paths):
        source, sure = row.source.rstrip("."), _(SURE[row.confidence])
        yield text.format(row=row.id, source=source, sure=sure) if source != sure else f"{row.id}: {source}."


def _parts(drive: Drive, name: str) -> Sequence[Any]:
    """Return the parts of a drive that are called so."""
    found = getattr(drive.duty if name in ("cases", "blocks") else drive, name)
    return found if isinstance(found, tuple) else (found,)


def _of(thing: Any, filled_in: Any, path: str, left_out: Sequence[str]) -> dict[tuple[str, str], Value]:
    """Return what a file gives at a path, and of what the catalogue fills in what matters most."""
    own = {below for below, _words, _value in _leaves(thing, path, left_out)}
    main = [name for name in FILLED if not path.startswith("joints") or "strength" not in name]
    return {
        words: value
        for below, words, value in _leaves(filled_in, path, left_out)
        if below in own or below.rpartition(".")[2] in main
    }


def _numbered(parts: Sequence[Any], text: str) -> list[str]:
    """Return what parts are called: their numbers, with their names where they have some."""
    heads = [text.format(number=getattr(one, "number", k)) for k, one in enumerate(parts, start=1)]
    return [f"{head} ({one.name})" if one.name else head for head, one in zip(heads, parts, strict=True)]


def _table(title: str, given: Sequence[_Given]) -> answer.Table:
    """Return a table of what parts give: parts of which all is alike share a column."""
    keys = list(dict.fromkeys(key for one in given for key in one.values))
    parts: dict[str, list[str]] = {}
    for part, words in keys:
        parts.setdefault(part, []).append(words)
    alike: list[tuple[list[str], _Given]] = []
    for one in given:
        same = next((heads for heads, other in alike if other.values == one.values), None)
        if same is None:
            alike.append(([one.head], one))
        else:
            same.append(one.head)
    rows: list[tuple[str, tuple[str, str] | None]] = []  # what stands first, and what of the parts stands beside it
    for part, own in parts.items():
        if part and len(own) > 1:
            rows += [(part, None), *((f"\u2003{words}", (part, words)) for words in own)]
        else:
            rows += [(f"{part}: {words}" if part else words, (part, words)) for words in own]
    columns = [Column(key="what", heading=_("what"), values=[words for words, _key in rows], left=True)]
    for heads, one in alike:
        values = ["" if key is None else one.values.get(key) for _words, key in rows]
        columns.append(
            Column(
                key="",
                heading=_("all") if len(heads) > 1 == len(alike) else ", ".join(heads) or _("value"),
                values=values,
                left=True,
            )
        )
    return answer.Table(title=title, columns=columns)


def _leaves(
    thing: Any, path: str, left_out: Sequence[str] = (), part: str = ""
) -> Iterator[tuple[str, tuple[str, str], Value]]:
    """Yield paths of what is given at and below a path, its part and itself in words, and its value.

    Defaults are not given.
    """
    own = fields_of(type(thing))
    usual = fields_of(Hooke) if path.startswith("joints[") and not part else own
    for name, one in own.items():
        value = getattr(thing, name)
        if name in left_out or name not in usual or value is None or value == one.default:
            continue
        below = f"{path}.{name}"
        said = in_words(below, inside=path, doc=one.key.doc)
        if is_dataclass(value):
            yield from _leaves(value, below, part=f"{part}: {said}" if part else said)
        elif isinstance(value, tuple) and value and is_dataclass(value[0]):
            for k, each in enumerate(value):
                leaves = _leaves(each, f"{below}[{k}]")
                parts = [(": ".join(filter(None, key)), inner) for _path, key, inner in leaves]
                told = Joined([say("{key} {value}", key=key, value=inner) for key, inner in parts])
                yield below, (part, f"{said}, {k + 1}"), told
        else:
            yield below, (part, said), _value(value, one.key.dimension or "", one.key.choices)


def _value(value: Any, dimension: str, choices: Sequence[str]) -> Text:
    """Return a value of the file for people; choices: the words of which it is one."""
    if isinstance(value, tuple):
        return Joined([_value(one, dimension, choices) for one in value])
    if isinstance(value, bool):
        return _("yes") if value else _("no")
    if isinstance(value, str):
        return value.replace("_", " ") if value in choices else value
    return Quantity(value, dimension, trim=True, unit="h" if dimension == "time" and value >= HOURS else "")
