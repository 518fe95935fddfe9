"""JSON Schema of the drive file, generated from the fields of the model: editors complete and check with it."""

from __future__ import annotations

import math
from dataclasses import is_dataclass
from typing import Any, get_args, get_origin

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import KINDS, NAMED
from cardan.mechanism.mechanism import Mechanism
from cardan.reading.fields import WORD_OR_FLAG, Field, fields_of
from cardan.texts import _
from cardan.units import label

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
