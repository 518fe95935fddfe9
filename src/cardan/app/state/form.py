"""The drive file as a form: which keys stand in it, which may, and what each one takes.

Made from the fields of the drive model, as the loader and the JSON Schema are: there is no second list of keys.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, is_dataclass
from typing import Any, Literal, TypeAlias, get_args, get_origin

from cardan.catalogue import catalogue
from cardan.drive.drive import Drive
from cardan.drive.fields.keys import KINDS, NAMED, USUAL
from cardan.drive.fields.wording import counted
from cardan.errors import InputError, Problem
from cardan.io.amend import kind_at, steps_of
from cardan.io.text import parsed
from cardan.reading.fields import WORD_OR_FLAG, Field, fields_of
from cardan.texts import _, visible

Sort: TypeAlias = Literal[
    "number", "whole", "text", "choice", "flag", "point", "numbers", "words", "named", "table", "tables", "changes"
]

LONG = ("note",)  # texts of several lines

OFFERED = {
    "type": "joint_types",
    "size": "joint_sizes",
    "bearing": "bearings",
    "seal": "shaft_seals",
    "grade": "materials",
    "norm": "angle_norms",
}
"""Field -> table of the catalogue whose rows it may name."""


GEOMETRY = {
    "angles": ("joint_angle", "plane_twist"),
    "slopes": ("side_slope", "plan_slope"),
    "points": ("centre", "point"),
}
"""Form of the geometry -> the keys that no other form has."""

OFTEN = ("yoke_angle", "outer", "inner", "wall", "grade", "mass", "size", "friction")  # keys that are offered first


@dataclass(frozen=True, eq=False, kw_only=True)
class Entry:
    """A key of a table: what it means, what it takes, what stands there."""

    name: str  # name of the field, without a unit
    path: str  # path of the table
    sort: Sort  # what it takes
    doc: str  # what it means, in the user's language
    value: Any  # what stands there, in ``unit``; None where the file does not give it
    unit: str  # unit that the file uses, or the one we prefer; empty without a dimension
    units: Mapping[str, float]  # all units that may be chosen, each with its factor to SI
    choices: tuple[str, ...]  # words that may be chosen; empty for free text
    default: Any  # what holds where the file does not give it
    required: bool  # whether it must be given
    size: int = 0  # how many numbers it takes; 0 for any, -2 for pairs
    offered: tuple[str, ...] = ()  # words of the catalogue that are likely; others may be written

    @property
    def given(self) -> bool:
        """Whether the file gives it."""
        return self.value is not None

    def key(self, unit: str = "") -> str:
        """Return the path of the key, in a unit."""
        chosen = unit or self.unit
        name = f"{self.name}_{chosen}" if chosen else self.name
        return f"{self.path}.{name}" if self.path else name


@dataclass(frozen=True, eq=False, kw_only=True)
class Section:
    """A table of the file."""

    path: str  # its path; empty for the head of the file
    title: str
    kind: str = ""  # its kind, where there are several
    kinds: tuple[str, ...] = ()  # those it may be
    entries: tuple[Entry, ...] = ()  # all keys that it may have
    removable: str = ""  # path by which it can be taken out; empty where it cannot

    @property
    def given(self) -> tuple[Entry, ...]:
        """The keys that it has, those that it needs among them."""
        return tuple(one for one in self.entries if one.given or one.required)

    @property
    def possible(self) -> tuple[Entry, ...]:
        """The keys that it may have beside those, the ones that drives have most first."""
        free = [one for one in self.entries if not one.given and not one.required]
        return tuple(sorted(free, key=lambda one: OFTEN.index(one.name) if one.name in OFTEN else len(OFTEN)))


def tree_of(text: str) -> dict[str, Any] | None:
    """Return the tables of a text; None where it is no TOML, or beyond the limits of a file."""
    try:
        return parsed(text, "toml", "file")
    except InputError:
        return None


def parts(tree: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield path and title of every table at the top, in the order of the power flow."""
    yield "", _("Drive")
    yield "input", _("Input")
    joints = tables(tree, "joints")
    for k, joint in enumerate(joints):
        yield _titled(f"shafts[{k}]", _shaft(tree, k))
        yield _titled(f"joints[{k}]", joint)
    if joints:
        yield _titled(f"shafts[{len(joints)}]", _shaft(tree, len(joints)))
    yield "output", _("Output")
    for name in ("supports", "stations"):
        yield from (_titled(f"{name}[{k}]", table) for k, table in enumerate(tables(tree, name)))
    yield "duty", _("Duty")
    yield "limits", _("Limits")
    yield "steering", _("Steering")
    yield "settings", _("Surroundings")
    yield "report", _("Title block of the report")
    for name in ("movements", "poses"):
        yield from (_titled(f"{name}[{k}]", table) for k, table in enumerate(tables(tree, name)))


def section(tree: Mapping[str, Any], path: str, title: str = "") -> Section:
    """Return a table of the file with all its keys.

    path: path of the table, which need not be there yet; ``shafts[1]`` is shaft number 2.
    """
    cls, table, base = _found(tree, path)
    kind, kinds = "", tuple[str, ...]()
    if base in KINDS:
        known, default = KINDS[base]
        kinds, kind = tuple(known), str(table.get("kind", default or ""))
    skipped = {"number", "joints", "shafts", "supports", "stations", "movements", "poses"} if path else set()
    unfit = _unfit(tree) if path.partition("[")[0] in ("input", "joints", "shafts", "output") else set()
    entries = tuple(
        _entry(one, table, path)
        for one in fields_of(cls).values()
        if not (path == "" and _holds_tables(one))
        and not (path.startswith("shafts") and one.name in skipped)
        and not (one.name in unfit and not any(key in table for key in one.spellings))
    )
    removable = path if (path.endswith("]") and not path.startswith(("joints[", "shafts["))) or "." in path else ""
    return Section(path=path, title=title, kind=kind, kinds=kinds, entries=entries, removable=removable)


def numbers_in(tree: Mapping[str, Any]) -> Iterator[str]:
    """Yield the paths of all numbers that a file gives, as it spells them."""
    todo = [path for path, _title in parts(tree)]
    while todo:
        path = todo.pop(0)
        for one in section(tree, path).entries:
            if one.sort in ("number", "whole") and isinstance(one.value, int | float):
                yield one.key()
            elif one.sort == "point" and isinstance(one.value, list):
                yield from (f"{one.key()}[{k}]" for k in range(len(one.value)))
            elif one.sort == "table" and isinstance(one.value, Mapping):
                todo.append(one.key())


def geometry_form(tree: Mapping[str, Any]) -> str:
    """Return in which form a file gives the geometry, also one that is not sound yet; empty where it gives none."""
    ends = [one for one in (tree.get("input"), tree.get("output")) if isinstance(one, Mapping)]
    given = {str(key) for one in (*ends, *tables(tree, "joints"), *tables(tree, "shafts")) for key in one}
    for form in ("angles", "slopes", "points"):
        if any(key.startswith(tuple(f"{name}_" for name in GEOMETRY[form])) for key in given):
            return form
    return ""


def _unfit(tree: Mapping[str, Any]) -> set[str]:
    """Return the keys of the other forms of geometry: a file may have those of one."""
    form = geometry_form(tree)
    return {name for other, names in GEOMETRY.items() if form and other != form for name in names}


def written(entry: Entry, text: str) -> Any:
    """Return what a user typed as a value for the file; the text itself where it is none of the sort."""
    plain = text.strip()
    if entry.sort in ("number", "whole"):
        return _number(plain)
    if entry.size == -2:
        return [[_number(part) for part in pair.split()] for pair in plain.split(";") if pair.strip()] or None
    if entry.sort in ("point", "numbers"):
        many = [_number(part) for part in plain.replace(";", " ").split()]
        return many if many else None
    if entry.sort == "words":
        return [part.strip() for part in plain.split(";") if part.strip()] or None
    return text or None


def shown(entry: Entry) -> str:
    """Return what stands there as a user would type it."""
    value = entry.value
    if value is None:
        return ""
    if isinstance(value, list):
        between = "; " if entry.sort == "words" or entry.size == -2 else " "
        return between.join(" ".join(map(str, one)) if isinstance(one, list) else str(one) for one in value)
    return str(value).lower() if isinstance(value, bool) else str(value)


def converted(entry: Entry, unit: str) -> Any:
    """Return what stands there in another of its units."""
    share = entry.units[entry.unit] / entry.units[unit]

    def turned(value: Any) -> Any:
        if isinstance(value, list):
            return [turned(one) for one in value]
        if isinstance(value, bool) or not isinstance(value, int | float):
            return value
        rounded = float(f"{value * share:.12g}")
        return int(rounded) if rounded.is_integer() and abs(rounded) < 1e15 else rounded

    return turned(entry.value)


def problems_of(path: str, problems: Sequence[Problem], units: Iterable[str] = ()) -> tuple[str, ...]:
    """Return what is wrong with the key or table at a path, without its unit, and with what it holds."""
    spelled = {path, *(f"{path}_{unit}" for unit in units)}
    return tuple(
        one.message
        for one in problems
        if any(one.field == name or one.field.startswith((f"{name}.", f"{name}[")) for name in spelled)
    )


def _number(text: str) -> float | int | str | None:
    bare = "".join(text.split()).replace(",", ".").replace("−", "-")
    if not bare:
        return None
    try:
        return int(bare)
    except ValueError:
        pass
    try:
        return float(bare)
    except ValueError:
        return text


def tables(tree: Mapping[str, Any], name: str) -> Sequence[Mapping[str, Any]]:
    """Return the tables of a list; empty ones where something else stands."""
    found = tree.get(name, [])
    return [one if isinstance(one, Mapping) else {} for one in found] if isinstance(found, list) else []


def _shaft(tree: Mapping[str, Any], k: int) -> Mapping[str, Any]:
    return next((one for one in tables(tree, "shafts") if one.get("number") == k + 1), {})


def _titled(path: str, table: Mapping[str, Any]) -> tuple[str, str]:
    """Return the path of a table, and what it is called with the name that it has."""
    title, name = counted(path), table.get("name", "")
    return path, f"{title} · {visible(name)}" if name and isinstance(name, str) else title


def _found(tree: Mapping[str, Any], path: str) -> tuple[Any, Mapping[str, Any], Any]:
    """Return class, table and base class of the table at a path."""
    if not path:
        return Drive, tree, Drive
    steps = steps_of(path)
    here: Any = tree
    for k, step in enumerate(steps):
        if isinstance(step, int):
            if steps[k - 1] == "shafts" and k == 1:
                here = _shaft(tree, step)
            else:
                here = here[step] if isinstance(here, list) and step < len(here) else {}
        else:
            here = here.get(step, {}) if isinstance(here, Mapping) else {}
    cls = kind_at(tree, steps)
    if isinstance(here, str) and cls in NAMED:
        here = {NAMED[cls]: here}
    base = next((one for one in KINDS if isinstance(cls, type) and issubclass(cls, one)), None)
    return cls, here if isinstance(here, Mapping) else {}, base


def _holds_tables(one: Field) -> bool:
    part = get_args(one.type)[0] if get_origin(one.type) is tuple else one.type
    return is_dataclass(part) or part in KINDS


def _entry(one: Field, table: Mapping[str, Any], path: str) -> Entry:
    usual = f"{one.name}_{USUAL[one.name]}" if one.name in USUAL else one.spelling
    spelling = next((key for key in one.spellings if key in table), usual if usual in one.spellings else one.spelling)
    units = {one.unit(key): abs(factor) for key, factor in one.spellings.items() if key.startswith(one.name)}
    mirrored = bool(one.key.mirror) and spelling.startswith(one.key.mirror) and not spelling.startswith(one.name)
    name = one.key.mirror if mirrored else one.name
    sort, size = _sort(one)
    return Entry(
        name=name or one.name,
        path=path,
        sort=sort,
        doc=_(one.key.doc),
        value=table.get(spelling),
        unit=one.unit(spelling),
        units=units if one.key.dimension else {},
        choices=_choices(one),
        default=one.default,
        required=one.required,
        size=size,
        offered=tuple(catalogue().tables.get(OFFERED.get(one.name, ""), {})),
    )


def _sort(one: Field) -> tuple[Sort, int]:
    kind = one.type
    if one.name == "set":
        return "changes", 0
    if get_origin(kind) is tuple:
        inner = get_args(kind)
        if is_dataclass(inner[0]) or inner[0] in KINDS:
            return "tables", 0
        if inner[0] is str:
            return "words", 0
        if inner[0] is float:
            return ("point", len(inner)) if inner[-1] is not Ellipsis else ("numbers", 0)
        return "numbers", -2
    if kind in NAMED:
        return "named", 0
    if is_dataclass(kind) or kind in KINDS:
        return "table", 0
    if kind is bool:
        return "flag", 0
    if kind == WORD_OR_FLAG or one.key.choices:
        return "choice", 0
    if kind is int:
        return "whole", 0
    return ("number", 0) if kind is float else ("text", 0)


def _choices(one: Field) -> tuple[str, ...]:
    words = tuple(str(word) for word in one.key.choices)
    return ("true", "false", *words) if one.type == WORD_OR_FLAG else words
