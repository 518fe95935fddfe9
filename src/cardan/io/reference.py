"""The reference of all keys of the drive file and of the mechanism file, generated from the fields of the model."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import is_dataclass
from typing import Any, get_args, get_origin

from cardan.drive.accuracy import Cost, Error, Tolerance
from cardan.drive.crack import ShaftCrack
from cardan.drive.cross import Cross
from cardan.drive.described import Input, Output
from cardan.drive.drive import Drive
from cardan.drive.duty import Block, Case, Duty, Harmonic, History, Limits, Upkeep, Vehicle
from cardan.drive.fields.keys import NAMED
from cardan.drive.fields.tables import written
from cardan.drive.inspection import Inspection
from cardan.drive.joint_parts import Needles, Rating, Section, Yoke
from cardan.drive.joints import JOINTS
from cardan.drive.machine import LAWS, Engine, EngineHarmonic, RunUp
from cardan.drive.material import Material
from cardan.drive.movement import MOVEMENTS, Spectrum
from cardan.drive.pose import Pose
from cardan.drive.settings import Settings
from cardan.drive.shaft import Layup, Lump, Notch, Ply, Segment, Shaft, Spline, Unbalance
from cardan.drive.station import Absorber, Pendulum, Station, ToNext
from cardan.drive.support import Support
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.pair import Pair
from cardan.reading.fields import WORD_OR_FLAG, Field, fields_of
from cardan.reading.ranges import allowed
from cardan.units import DIMENSIONS


def sections() -> tuple[tuple[str, type], ...]:
    """Return title and class of every table of the drive file."""
    return (
        ("Head of the file", Drive),
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
        ("`masses` of a shaft", Lump),
        ("`spline` of a shaft", Spline),
        ("`notch` of a shaft", Notch),
        ("`layup` of a shaft", Layup),
        ("`ply` of a layup", Ply),
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
        ("`[limits]`", Limits),
        *((f'`[[movements]]` with `kind = "{name}"`', cls) for name, cls in MOVEMENTS.items()),
        ("`spectrum` of a random movement", Spectrum),
        ("`[[poses]]`", Pose),
    )


def _tables_of_kinds() -> Iterator[tuple[str, type]]:
    """Yield title and class of the tables that only joints of one kind have."""
    for name, kind in JOINTS.items():
        own: dict[type, list[str]] = {}
        for field, one in fields_of(kind).items():
            if field in kind.own_fields() and isinstance(one.type, type) and is_dataclass(one.type):
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
    sections: tuple[tuple[str, type], ...] = (("Head of the mechanism file", Mechanism), ("`[[joints]]`", Pair))
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
        yield f"| `{one.name}`{mirror} | {units} | {_kind(one)} | {_default(one)} | {one.key.doc} |"
    yield ""


def _kind(one: Field) -> str:
    limits = allowed(one.key)
    ending = "" if limits == "a finite number" else f", {limits}"
    return _shape(one.type, one) + ending


def _shape(kind: Any, one: Field) -> str:
    if one.name == "set":
        return "table of paths"
    if get_origin(kind) is tuple:
        parts = get_args(kind)
        if parts[-1] is Ellipsis:
            return "tables" if is_dataclass(parts[0]) else f"list of {_shape(parts[0], one)}s"
        inner = _shape(parts[0], one)
        return f"{len(parts)} {inner}s" if inner in ("number", "text") else f"{len(parts)} pairs of numbers"
    if kind in NAMED:
        return "name or table"
    if is_dataclass(kind):
        return "table"
    if kind == WORD_OR_FLAG:
        return "true, false or one of " + ", ".join(f"`{word}`" for word in one.key.choices)
    if one.key.choices:
        return "one of " + ", ".join(f"`{word}`" for word in one.key.choices)
    return {float: "number", int: "whole number", bool: "true or false"}.get(kind, "text")


def _default(one: Field) -> str:
    if one.required:
        return "required"
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
