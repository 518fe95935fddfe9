"""What is exported: the functions and classes that somebody outside of the package takes by name."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import cardan

from .imports import ROOT, modules

TOP = Path(__file__).parents[2]
"""The folder of the repository."""

FORMULAS = ("cardan.formulas.", "cardan.book.")
"""Where the formulas stand that a calculation calls."""


@cache
def exported() -> dict[str, str]:
    """Return every exported function and class by its dotted name, with who takes it."""
    found: dict[str, str] = {}
    for who, thing in [*_public(), *_in_pages(), *_for_additions(), *_of_calculations()]:
        if inspect.isclass(thing) or inspect.isfunction(inspect.unwrap(thing) if callable(thing) else thing):
            name = f"{thing.__module__}.{thing.__qualname__}"
            if thing.__module__ in modules():
                found.setdefault(name, who)
    return found


def _public() -> Iterator[tuple[str, Any]]:
    """Yield the public names of cardan, of the modules at its top and of its packages."""
    for name in cardan.__all__:
        thing = getattr(cardan, name)
        within = vars(thing) if inspect.ismodule(thing) else {name: thing}
        yield from (("public name", one) for own, one in within.items() if not own.startswith("_"))
    for name, path in modules().items():
        if (path.parent == ROOT or path.name == "__init__.py") and "__all__" in path.read_text("utf-8"):
            module = import_module(name)
            yield from (("__all__", getattr(module, one, None)) for one in getattr(module, "__all__", ()))


def _in_pages() -> Iterator[tuple[str, Any]]:
    """Yield what pages of the documentation import or name, decisions left out: they tell of what is inside."""
    for page in [TOP / "README.md", *(TOP / "docs").rglob("*.md")]:
        if not {"_build", "decisions", "generated"} & set(page.parts):
            text = page.read_text("utf-8")
            code = re.sub(r"^(?:>>>|\.\.\.) ", "", text, flags=re.M)
            statements = re.findall(r"^(from cardan[\w.]* import (?:\([^)]*\)|.*)|import cardan[\w.]*)$", code, re.M)
            yield from (("page", thing) for one in statements for thing in _imported(one, code))
            yield from (("page", thing) for one in re.findall(r"`(cardan(?:\.\w+)+)`", text) for thing in _named(one))


def _for_additions() -> Iterator[tuple[str, Any]]:
    """Yield what an addition is made of: what a toy imports, and what CONTRIBUTING.md names."""
    for toy in sorted((TOP / "tests" / "fixtures").glob("toy_*.py")):
        code = toy.read_text("utf-8")
        statements = re.findall(r"^from cardan[\w.]* import .*$", code, re.M)
        yield from (("addition", thing) for one in statements for thing in _imported(one, code))
    text = (TOP / "CONTRIBUTING.md").read_text("utf-8")
    yield from (("addition", thing) for one in re.findall(r"`(cardan(?:\.\w+)+)`", text) for thing in _named(one))
    classes: dict[str, list[str]] = {}
    for name, path in modules().items():
        for one in ast.parse(path.read_text("utf-8")).body:
            if isinstance(one, ast.ClassDef):
                classes.setdefault(one.name, []).append(name)
    for name in set(re.findall(r"`([A-Z][A-Za-z]+)`", text)):
        if len(classes.get(name, ())) == 1:
            yield "addition", getattr(import_module(classes[name][0]), name)
    for place in set(re.findall(r"`((?:common|drive)/\w+(?:\.py|/))`", text)):
        for name, path in modules().items():
            if f"/{place}" in path.as_posix() and "/drive/joints/" not in f"/{place}":
                yield from (("addition", one) for one in _own(name))
    yield from (("addition", one) for one in _own("cardan.drive.movement"))


def _of_calculations() -> Iterator[tuple[str, Any]]:
    """Yield the formulas that calculations call."""
    for name in modules():
        if name.startswith("cardan.calc."):
            for thing in vars(import_module(name)).values():
                if getattr(thing, "__module__", "").startswith(FORMULAS):
                    yield "calculation", thing


def _own(name: str) -> Iterator[Any]:
    """Yield what a module defines without an underscore."""
    for one, thing in vars(import_module(name)).items():
        if not one.startswith("_") and getattr(thing, "__module__", "") == name:
            yield thing


def _imported(statement: str, code: str) -> Iterator[Any]:
    """Yield what an import takes, and of a module what the code takes out of it."""
    (node,) = ast.parse(statement).body
    assert isinstance(node, ast.Import | ast.ImportFrom)
    for alias in node.names:
        whole = f"{node.module}.{alias.name}" if isinstance(node, ast.ImportFrom) else alias.name
        for thing in _named(whole):
            yield thing
            if inspect.ismodule(thing):
                known = alias.asname or alias.name
                taken = set(re.findall(rf"(?<![\w.]){re.escape(known)}\.(\w+)", code))
                yield from (getattr(thing, one) for one in sorted(taken) if hasattr(thing, one))


def _named(whole: str) -> Iterator[Any]:
    """Yield the thing of a dotted name, where there is one."""
    if whole in modules():
        yield import_module(whole)
        return
    home, _dot, name = whole.rpartition(".")
    if home in modules():
        yield from [getattr(import_module(home), name)] if hasattr(import_module(home), name) else []
