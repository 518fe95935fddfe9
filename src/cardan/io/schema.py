"""JSON Schema of the drive file, generated from the fields of the model: editors complete and check with it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import is_dataclass
from typing import Any, get_args, get_origin

from cardan.drive.accuracy import Cost, Error, Inspection, Tolerance
from cardan.drive.cross import Cross
from cardan.drive.described import Input, Output
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Case, Duty, Harmonic, History, Limits, Upkeep, Vehicle
from cardan.drive.fields.keys import KINDS, NAMED, written
from cardan.drive.joint_parts import Needles, Rating, Section, Yoke
from cardan.drive.joints import JOINTS
from cardan.drive.machine import LAWS, Engine, EngineHarmonic, Event, RunUp
from cardan.drive.material import Material
from cardan.drive.movement import MOVEMENTS, Spectrum
from cardan.drive.profile_tube import Profile
from cardan.drive.settings import Pose, Settings, Steering, TitleBlock
from cardan.drive.shaft import Bond, Layup, Notch, Ply, PointMass, Segment, Shaft, ShaftCrack, Spline, Unbalance
from cardan.drive.station import Absorber, Pendulum, Station, ToNext
from cardan.drive.support import Support
from cardan.mechanism.load import LinkMass, Load
from cardan.mechanism.mechanism import Mechanism, Pair
from cardan.reading.fields import WORD_OR_FLAG, Field, fields_of
from cardan.reading.ranges import allowed
from cardan.texts import _
from cardan.units import DIMENSIONS, label

DIALECT = "https://json-schema.org/draft/2020-12/schema"


def schema() -> dict[str, Any]:
    """Return the JSON Schema (2020-12) of the drive file.

    Examples
    --------
    >>> schema()["properties"]["format"]
    {'const': 1, 'description': 'version of the file format'}
    """
    return _file(Drive, "cardan drive file")


def mechanism_schema() -> dict[str, Any]:
    """Return the JSON Schema (2020-12) of the mechanism file.

    Examples
    --------
    >>> mechanism_schema()["required"]
    ['format', 'frame', 'joints']
    """
    return _file(Mechanism, "cardan mechanism file")


def _file(cls: Any, title: str) -> dict[str, Any]:
    """Return the schema of a file; each table in it is defined once."""
    head = _table(cls)
    head["properties"] = {
        "format": {"const": cls.format, "description": _("version of the file format")},
        **head["properties"],
    }
    head["required"] = ["format", *head.get("required", [])]
    known: dict[type, None] = {}
    _gather(cls, known)
    variants = {one: (name, name == default) for kinds, default in KINDS.values() for name, one in kinds.items()}
    tables = {_name(one): _table(one, *variants.get(one, ("", False))) for one in known}
    return {"$schema": DIALECT, "title": title, **head, "$defs": tables}


def _gather(cls: Any, known: dict[type, None]) -> None:
    """Note every class of a table within a class, in the order of the file."""
    for one in fields_of(cls).values():
        for part in (one.type, *get_args(one.type)):
            for inner in KINDS[part][0].values() if part in KINDS else [part]:
                if is_dataclass(inner) and inner not in known:
                    known[inner] = None
                    _gather(inner, known)


def _name(cls: type) -> str:
    return f"{cls.__module__.rpartition('.')[2]}.{cls.__name__}"


def _defined(cls: Any) -> dict[str, Any]:
    return {"$ref": f"#/$defs/{_name(cls)}"}


def _table(cls: type, kind: str = "", by_default: bool = False) -> dict[str, Any]:
    """Return the schema of a table; one of several kinds says which it is, unless it is that by default."""
    properties: dict[str, Any] = {"kind": {"const": kind}} if kind else {}
    required = ["kind"] if kind and not by_default else []
    rules: list[dict[str, Any]] = []
    for one in fields_of(cls).values():
        for spelling, factor in one.spellings.items():
            properties[spelling] = {**_shape(one.type, one, factor), "description": _described(one, spelling)}
        names = list(one.spellings)
        if len(names) == 1 and one.required:
            required += names
        elif one.required:
            rules.append({"oneOf": [{"required": [name]} for name in names]})
        elif len(names) > 1:
            rules.append({"oneOf": [*({"required": [n]} for n in names), {"not": _any_of(names)}]})
    table: dict[str, Any] = {"type": "object", "properties": properties, "additionalProperties": False}
    if required:
        table["required"] = required
    if rules:
        table["allOf"] = rules
    return table


def _any_of(names: list[str]) -> dict[str, Any]:
    return {"anyOf": [{"required": [name]} for name in names]}


def _shape(kind: Any, one: Field, factor: float) -> dict[str, Any]:
    if one.name == "set":
        value = {"type": ["number", "array", "boolean", "string"]}
        return {"type": "object", "additionalProperties": value, "minProperties": 1}
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        if parts[-1] is Ellipsis:
            return {"type": "array", "items": _shape(parts[0], one, factor)}
        items = _shape(parts[0], one, factor)
        return {"type": "array", "items": items, "minItems": len(parts), "maxItems": len(parts)}
    if kind in KINDS:
        variants = [_defined(cls) for cls in KINDS[kind][0].values()]
        return variants[0] if len(variants) == 1 else {"oneOf": variants}
    if kind in NAMED:
        return {"anyOf": [{"type": "string"}, _defined(kind)]}
    if is_dataclass(kind):
        return _defined(kind)
    if kind == WORD_OR_FLAG:
        return {"enum": [True, False, *one.key.choices]}
    if kind is bool:
        return {"type": "boolean"}
    if kind is str:
        return {"type": "string", **({"enum": list(one.key.choices)} if one.key.choices else {})}
    return {"type": "integer" if kind is int else "number", **_range(one, factor)}


def _range(one: Field, factor: float) -> dict[str, float]:
    key = one.key
    bounds = {"minimum": key.low, "maximum": key.high, "exclusiveMinimum": key.above, "exclusiveMaximum": key.below}
    if factor < 0:
        turned = {"minimum": "maximum", "maximum": "minimum"}
        turned |= {"exclusiveMinimum": "exclusiveMaximum", "exclusiveMaximum": "exclusiveMinimum"}
        bounds = {turned[word]: bound for word, bound in bounds.items()}
    return {word: bound / factor for word, bound in bounds.items() if math.isfinite(bound)}


def _described(one: Field, spelling: str) -> str:
    unit = spelling.removeprefix(one.key.mirror if one.key.mirror and spelling.startswith(one.key.mirror) else one.name)
    opposite = " " + _("(with the opposite sign)") if one.spellings[spelling] < 0 else ""
    return f"{_(one.key.doc)}{opposite}" + (f" [{label(unit.lstrip('_'))}]" if unit else "")


# The reference of all keys of the drive file and of the mechanism file, generated from the fields of the model.


def sections() -> tuple[tuple[str, type], ...]:
    """Return title and class of every table of the drive file."""
    return (
        ("Head of the file", Drive),
        ("`[report]`", TitleBlock),
        ("`[settings]`", Settings),
        ("`input`", Input),
        ("`output`", Output),
        *((f'`[[joints]]` with `kind = "{name}"`', cls) for name, cls in JOINTS.items()),
        *_tables_of_kinds(),
        ("`cross` of a joint", Cross),
        ("`needles` of a joint", Needles),
        ("`yoke` of a joint", Yoke),
        ("`section` of a yoke", Section),
        ("`rating` of a joint", Rating),
        ("`inspection` of a joint", Inspection),
        ("`error` of a joint", Error),
        ("`tolerance` of a joint", Tolerance),
        ("`cost` of tolerances", Cost),
        ("`[[shafts]]`", Shaft),
        ("`material`", Material),
        ("`segments` of a shaft", Segment),
        ("`masses` of a shaft", PointMass),
        ("`spline` of a shaft", Spline),
        ("`profile` of a shaft", Profile),
        ("`notch` of a shaft", Notch),
        ("`layup` of a shaft", Layup),
        ("`ply` of a layup", Ply),
        ("`bond` of a layup", Bond),
        ("`unbalance` of a shaft", Unbalance),
        ("`crack` of a shaft", ShaftCrack),
        ("`[[supports]]`", Support),
        ("`[[stations]]`", Station),
        ("`to_next` of a station", ToNext),
        ("`absorber` of a station", Absorber),
        ("`pendulum` of a station", Pendulum),
        ("`[duty]`", Duty),
        ("`harmonics` of the duty", Harmonic),
        ("`[[duty.cases]]`", Case),
        ("`blocks` of the duty", Block),
        ("`torque_history` of the duty", History),
        ("`vehicle` of the duty", Vehicle),
        ("`upkeep` of the duty", Upkeep),
        ("`engine` of the duty", Engine),
        ("`harmonics` of an engine", EngineHarmonic),
        *((f'`motor`, `load` or `[[duty.torques]]` with `kind = "{name}"`', cls) for name, cls in LAWS.items()),
        ("`run_up` of the duty", RunUp),
        ("`[[duty.events]]`", Event),
        ("`[limits]`", Limits),
        ("`[steering]`", Steering),
        *((f'`[[movements]]` with `kind = "{name}"`', cls) for name, cls in MOVEMENTS.items()),
        ("`spectrum` of a random movement", Spectrum),
        ("`[[poses]]`", Pose),
    )


def _tables_of_kinds() -> Iterator[tuple[str, type]]:
    """Yield title and class of the tables that only joints of one kind have."""
    for name, kind in JOINTS.items():
        own: dict[type, list[str]] = {}
        for field, one in fields_of(kind).items():
            if (
                (field in kind.own_fields() or one.type in kind.tables().values())
                and isinstance(one.type, type)
                and is_dataclass(one.type)
            ):
                own.setdefault(one.type, []).append(f"`{field}`")
        for cls, fields in own.items():
            yield f'{" and ".join(fields)} of a joint with `kind = "{name}"`', cls


def reference() -> str:
    """Return the reference of the drive file as Markdown: a table of keys for each table of the file.

    Examples
    --------
    >>> reference().splitlines()[0]
    '## Head of the file'
    """
    return "\n".join(line for title, cls in sections() for line in _section(title, cls))


def mechanism_reference() -> str:
    """Return the reference of the mechanism file as Markdown.

    Examples
    --------
    >>> mechanism_reference().splitlines()[0]
    '## Head of the mechanism file'
    """
    sections: tuple[tuple[str, type], ...] = (
        ("Head of the mechanism file", Mechanism),
        ("`[[joints]]`", Pair),
        ("`[[masses]]`", LinkMass),
        ("`[[loads]]`", Load),
    )
    return "\n".join(line for title, cls in sections for line in _section(title, cls))


def _section(title: str, cls: type) -> Iterator[str]:
    yield f"## {title}"
    yield ""
    if cls.__doc__ and cls not in (Drive, Input, Output, Mechanism, Pair):
        yield cls.__doc__.strip().splitlines()[0]
        yield ""
    yield "| key | units | value | default | meaning |"
    yield "|---|---|---|---|---|"
    if cls in (Drive, Mechanism):
        yield "| `format` | | 1 | required | version of the file format |"
    for one in fields_of(cls).values():
        units = ", ".join(f"`_{unit}`" for unit in DIMENSIONS[one.key.dimension]) if one.key.dimension else ""
        mirror = f" or `{one.key.mirror}` (opposite sign)" if one.key.mirror else ""
        yield f"| `{one.name}`{mirror} | {units} | {kind_of(one)} | {default_of(one)} | {one.key.doc} |"
    yield ""


def kind_of(one: Field, unit: str = "") -> str:
    """Return what a field holds in words, and which values are allowed; in a unit, the preferred one when empty."""
    limits = allowed(one.key, unit)
    ending = "" if limits == _("a finite number") else f", {limits}"
    return _reference_shape(one.type, one) + ending


def _reference_shape(kind: Any, one: Field) -> str:
    if one.name == "set":
        return _("table of paths")
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        many = {float: _("numbers"), int: _("whole numbers"), str: _("texts")}
        if parts[-1] is Ellipsis:
            inner = many.get(parts[0], _("lists"))
            return _("tables") if is_dataclass(parts[0]) else _("list of {what}").format(what=inner)
        return f"{len(parts)} {many.get(parts[0]) or _('pairs of numbers')}"
    if kind in NAMED:
        return _("name or table")
    if is_dataclass(kind):
        return _("table")
    if kind == WORD_OR_FLAG:
        return _("true, false or one of ") + ", ".join(f"`{word}`" for word in one.key.choices)
    if one.key.choices:
        return _("one of ") + ", ".join(f"`{word}`" for word in one.key.choices)
    return {float: _("number"), int: _("whole number"), bool: _("true or false")}.get(kind, _("text"))


def default_of(one: Field) -> str:
    """Return the default of a field in words, empty where there is none."""
    if one.required:
        return _("required")
    value = one.default
    if value is None or is_dataclass(value) or value in ((), ""):
        return ""
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, float) and one.key.dimension is not None:
        unit, number = written(value, one.key.dimension)
        return f"{number:g} {unit}"
    if isinstance(value, tuple):
        return f"`{[0 if x == 0 else x for x in value]}`"
    return f"`{value:g}`" if isinstance(value, float) else f"`{value}`"
