"""Reference of the drive file's keys, the commands and the public names, written from the program itself."""

from __future__ import annotations

import dataclasses
import inspect
import math
import types
import typing
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import cardan
from cardan.units import DIMENSIONS, KEY, Key, label, preferred

UNITLESS = {float: "number", int: "whole number", bool: "`true` or `false`", str: "text"}


def write(folder: Path) -> None:
    """Write all generated pages, touching only those that changed."""
    folder.mkdir(parents=True, exist_ok=True)
    pages = {"drive-file.md": drive_file(), "units.md": units(), "commands.md": commands(), "names.md": names()}
    for name, text in pages.items():
        file = folder / name
        if not file.exists() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")


def units() -> str:
    """Return the table of units each dimension may be written in."""
    rows = ["| dimension | key ends in (the first is what cardan writes) |", "|---|---|"]
    rows += [f"| {name.replace('_', ' ')} | {', '.join(f'`_{u}`' for u in given)} |" for name, given in DIMENSIONS.items()]
    return "\n".join(rows) + "\n"


def drive_file() -> str:
    """Return one section for each table of the drive file."""
    from cardan.drive.drive import Drive, Input, Output
    from cardan.drive.duty import Duty, Limits
    from cardan.drive.joints import JOINTS
    from cardan.drive.movement import MOVEMENTS, Spectrum
    from cardan.drive.pose import Pose
    from cardan.drive.shaft import Shaft, Spline

    parts = [("Head", Drive, "", {"input", "output", "joints", "shafts", "duty", "limits", "movements", "poses"})]
    parts += [("`[input]`", Input, "", set()), ("`[output]`", Output, "", set())]
    parts += [(f'`[[joints]]`, `kind = "{kind}"`', of, doc(of), set()) for kind, of in JOINTS.items()]
    parts += [("`[[shafts]]`", Shaft, doc(Shaft), {"spline"}), ("`spline` of a shaft", Spline, doc(Spline), set())]
    parts += [("`[duty]`", Duty, doc(Duty), set()), ("`[limits]`", Limits, doc(Limits), set())]
    hidden = {"times", "shifts"}
    parts += [(f'`[[movements]]`, `kind = "{kind}"`', of, doc(of), hidden) for kind, of in MOVEMENTS.items()]
    parts += [("`spectrum` of a random movement", Spectrum, doc(Spectrum), set()), ("`[[poses]]`", Pose, doc(Pose), set())]
    return "\n".join(_section(*part) for part in parts)


def doc(thing: Any) -> str:
    """Return the first paragraph of a docstring."""
    return " ".join((inspect.getdoc(thing) or "").split("\n\n")[0].split())


def _section(title: str, owner: Any, intro: str, left_out: set[str]) -> str:
    hints = typing.get_type_hints(owner)
    rows = [f"## {title}", "", intro, "", "| key | meaning | value | default |", "|---|---|---|---|"]
    if title == "Head":
        rows.append("| `format` | version of the file format | `1` | **needed** |")
    if "kind = " in title:
        kind = title.split('"')[1]
        rows.append(f'| `kind` | which {title[3:].split("]")[0][:-1]} this is | `"{kind}"` | '
                    + ('`"hooke"`' if kind == "hooke" else "**needed**") + " |")
    for item in dataclasses.fields(owner):
        if KEY not in item.metadata or item.name in left_out:
            continue
        key: Key = item.metadata[KEY]
        names = [item.name, *([key.mirror] if key.mirror else [])]
        shown = " or ".join(f"`{_suffixed(name, key)}`" for name in names)
        extra = f" (`{key.mirror}` is the same with the opposite sign)" if key.mirror else ""
        rows.append(f"| {shown} | {key.doc}{extra} | {_value(hints[item.name], key)} | {_default(item, key)} |")
    return "\n".join([*rows, ""])


def _suffixed(name: str, key: Key) -> str:
    return f"{name}_{preferred(key.dimension)}" if key.dimension else name


def _value(hint: Any, key: Key) -> str:
    if key.choices:
        return ", ".join(f'`"{choice}"`' for choice in key.choices)
    text = _kind(hint)
    if key.dimension:
        text = f"{key.dimension.replace('_', ' ')}" + ("" if text == "number" else f", {text}")
    limits = [(key.low, "≥"), (key.above, ">"), (key.high, "≤"), (key.below, "<")]
    kept = [f"{sign} {_number(value, key)}" for value, sign in limits if math.isfinite(value)]
    return text + (f"; {' and '.join(kept)}" if kept else "")


def _kind(hint: Any) -> str:
    given = typing.get_args(hint)
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return _kind(next(one for one in given if one is not type(None)))
    if typing.get_origin(hint) is tuple:
        if given[-1] is Ellipsis:
            return "list"
        if typing.get_origin(given[0]) is tuple:
            return "`[[x0, x1], [y0, y1], [z0, z1]]`"
        return "`[x, y, z]`" if len(given) == 3 else "list"
    return UNITLESS.get(hint, "table")


def _number(value: float, key: Key) -> str:
    if key.dimension is None:
        return f"{value:g}"
    unit = preferred(key.dimension)
    return f"{value / DIMENSIONS[key.dimension][unit]:.4g} {label(unit)}".replace(" °", "°")


def _default(item: Any, key: Key) -> str:
    value = item.default
    if value is dataclasses.MISSING:
        return "**needed**"
    if value is None or value in ("", ()):
        return "–"
    if isinstance(value, bool):
        return f"`{str(value).lower()}`"
    if isinstance(value, int | float):
        return _number(value, key)
    return "`[0, 0, 0]`" if isinstance(value, tuple) else "–"


def commands() -> str:
    """Return one section for each command."""
    import typer.main
    from cardan.cli.app import app

    return "\n".join(_commands(typer.main.get_command(app), "cardan"))


def _commands(group: Any, path: str) -> Iterator[str]:
    import click

    context = click.Context(group, info_name=path)
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        if command.hidden:
            continue
        if hasattr(command, "list_commands"):
            yield from _commands(command, f"{path} {name}")
            continue
        yield f"## `{path} {name}`\n\n{_plain(command.help)}\n"
        inner = click.Context(command, info_name=f"{path} {name}")
        usage = " ".join(command.collect_usage_pieces(inner))
        yield f"```text\n{path} {name} {usage}\n```\n"
        rows = ["| argument or option | meaning | default |", "|---|---|---|"]
        for parameter in command.params:
            if getattr(parameter, "hidden", False) or not getattr(parameter, "help", None):
                continue
            rows.append(f"| {_spelling(parameter)} | {_plain(parameter.help)} | {_given(parameter)} |")
        if len(rows) > 2:
            yield "\n".join(rows) + "\n"
        if command.epilog:
            lines = [line.strip() for line in _plain(command.epilog).splitlines() if line.strip()]
            yield "```text\n" + "\n".join(line for line in lines if line.startswith("cardan")) + "\n```\n"


def _plain(text: str | None) -> str:
    return (text or "").replace("\b", "").replace("|", "\\|").strip()


def _spelling(parameter: Any) -> str:
    if parameter.param_type_name == "argument":
        return f"`{(parameter.metavar or parameter.name).upper()}`"
    takes = "" if parameter.is_flag or parameter.count else f" {parameter.metavar or parameter.type.name.upper()}"
    return ", ".join(f"`{name}{takes}`".replace("|", "\\|") for name in (*parameter.opts, *parameter.secondary_opts))


def _given(parameter: Any) -> str:
    value = parameter.default
    if value in (None, False, ()) or callable(value) or value == [] or "Sentinel" in type(value).__name__:
        return "**needed**" if parameter.required else "–"
    return f"`{value}`"


GROUPS = {
    "The drive": ("drive", "io"),
    "Questions": ("analysis",),
    "Choices": ("synthesis",),
    "Results on paper": ("figures", "report", "calc"),
    "Errors": ("errors",),
}


def names() -> str:
    """Return the public names, each with its docstring, in the order of the work."""
    homes: dict[str, str] = cardan._HOMES
    parts = []
    for title, rooms in GROUPS.items():
        found = [(name, home) for name, home in homes.items() if home.split(".")[0] in rooms]
        if not found:
            continue
        parts.append(f"## {title}\n\n```{{eval-rst}}")
        for name, home in found:
            thing = getattr(__import__(f"cardan.{home}", fromlist=[name]), name)
            kind = "autoclass" if inspect.isclass(thing) else "autofunction" if callable(thing) else "autodata"
            if issubclass(thing, Exception) if inspect.isclass(thing) else False:
                kind = "autoexception"
            parts.append(f".. {kind}:: cardan.{home}.{name}")
        parts.append("```\n")
    return "\n".join(parts)
