"""A page for every public name, and what leads to them by subject; written from the program itself."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from dataclasses import MISSING, Field, fields, is_dataclass
from typing import Any

import cardan
from cardan.units import DIMENSIONS, label

SUBJECTS = {
    "The drive and its file": ("drive", "io"),
    "Motion": ("questions.motion",),
    "Phasing and layout": ("questions.phases",),
    "Forces, losses, life and strength": (
        "questions.forces",
        "questions.losses",
        "questions.life",
        "questions.mobility",
        "checks.strength",
    ),
    "Bending, whirl and balance": ("questions.bending",),
    "Torsional vibration": ("questions.torsion", "choices.torsion_design"),
    "Tolerances and accuracy": ("questions.accuracy",),
    "Verdicts, and what to change": ("checks", "choices"),
    "Pictures, reports, single formulas": ("scene", "report", "calc"),
    "Errors": ("errors",),
}
"""What stands in `cardan` itself, by the folder that it is from; the narrowest folder counts."""


BOOK = "Kozhevnikov & Perfil'ev, *Cardan transmissions* (1978), see the [bibliography](../../../bibliography.md)."

ASIDE = "---\norphan: true\n---\n"
"""Names are found from their list and by search: beside every page they would be two thirds of its navigation."""


def pages() -> tuple[str, dict[str, str]]:
    """Return the list by subject, and the text of the page of each name by its file."""
    found, parts = {}, []
    for title, module, names in _subjects():
        parts += [title, "", "| name | what it is |", "|---|---|"]
        files = [_file(module, name) for name in names]
        for name, file in zip(names, files, strict=True):
            thing = getattr(module, name)
            parts.append(f"| [`{name}`](generated/{file}.md) | {_first(thing)} |")
            found[f"{file}.md"] = _page(f"{module.__name__}.{name}", thing)
        parts.append("")
    return "\n".join(parts), found


def _subjects() -> Iterator[tuple[str, Any, list[str]]]:
    """Yield the head of each subject, the module that holds its names, and these in the order of the module."""
    homes = {name: home for name, home in cardan._HOMES.items() if home}
    rooms = {room: title for title, some in SUBJECTS.items() for room in some}
    titled: dict[str, list[str]] = {title: [] for title in SUBJECTS}
    for name, home in homes.items():
        titled[rooms[max((one for one in rooms if f"{home}.".startswith(f"{one}.")), key=len)]].append(name)
    for title, names in titled.items():
        yield f"## {title}", cardan, names
    for name in sorted(set(cardan._HOMES) - set(homes)):
        module = getattr(cardan, name)
        text = (inspect.getdoc(module) or "").strip()
        yield f"## `cardan.{name}`\n\n{text}", module, [one for one in vars(module) if not one.startswith("_")]


def _file(module: Any, name: str) -> str:
    """Return the file of a page without its ending; no two differ by capitals alone, which some systems do not tell."""
    kind = "-class" if inspect.isclass(getattr(module, name)) else ""
    return "names/" + f"{module.__name__}.{name}".removeprefix("cardan.").lower().replace(".", "-") + kind


def _first(thing: Any) -> str:
    if not callable(thing):
        return "all there are, by name"
    return " ".join((inspect.getdoc(thing) or "").split("\n\n")[0].split()).replace("|", "\\|")


def _page(name: str, thing: Any) -> str:
    kind = "class" if inspect.isclass(thing) else "function" if callable(thing) else "data"
    if inspect.isclass(thing) and issubclass(thing, Exception):
        kind = "exception"
    parts = [
        ASIDE,
        f"# `{name.rpartition('.')[2]}`",
        "",
        "[All names by subject](../../python.md)",
        "",
        "```{eval-rst}",
        f".. auto{kind}:: {name}",
        "```",
        "",
    ]
    if callable(thing) and re.search(r"\bBook (\(|p\.)", "".join(_docstrings(thing))):
        parts += [f"*Book* is {BOOK}", ""]
    return "\n".join([*parts, *_fields(thing)])


def _docstrings(thing: Any) -> Iterator[str]:
    """Yield what a page shows of a thing and of what it has."""
    for one in [thing, *(vars(thing).values() if inspect.isclass(thing) else ())]:
        yield inspect.getdoc(one) or ""


def _fields(thing: Any) -> Iterator[str]:
    """Yield a table of the fields that are keys of the drive file, whose meaning stands with each."""
    keys = [one for one in fields(thing) if "cardan" in one.metadata] if is_dataclass(thing) else []
    if keys:
        yield "## Fields\n\nIn SI; each is a key of the drive file, whose page tells units and ranges.\n"
        yield "| field | unit | default | meaning |\n|---|---|---|---|"
        for one in keys:
            unit, doc = _unit(one.metadata["cardan"].dimension), one.metadata["cardan"].doc.replace("|", "\\|")
            yield f"| `{one.name}` | {unit} | {_default(one)} | {doc} |"
        yield ""


def _unit(dimension: str | None) -> str:
    """Return the SI unit of a dimension: the one whose factor is 1."""
    if dimension is None:
        return "–"
    return label(next(unit for unit, factor in DIMENSIONS[dimension].items() if factor == 1.0))


def _default(one: Field[Any]) -> str:
    if one.default is MISSING:
        return "needed" if one.default_factory is MISSING else "empty"
    return "–" if one.default in (None, "", ()) else f"`{one.default!r}`" if not is_dataclass(one.default) else "empty"
