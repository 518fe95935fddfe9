"""Which module imports which, as the source says it: those inside functions and for type checking alone too."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

import cardan

ROOT = Path(cardan.__file__).parent
"""The folder of the package."""


@cache
def modules() -> dict[str, Path]:
    """Return every module by its dotted name."""
    found = {}
    for path in sorted(ROOT.rglob("*.py")):
        parts = ("cardan", *path.relative_to(ROOT).with_suffix("").parts)
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


@cache
def imports() -> dict[str, frozenset[str]]:
    """Return the modules that each module imports itself."""
    return {name: frozenset(_imported(name, path)) - {name} for name, path in modules().items()}


def _imported(name: str, path: Path) -> Iterator[str]:
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (known for one in node.names if (known := _known(one.name)))
        elif isinstance(node, ast.ImportFrom):
            above = package.split(".")[: len(package.split(".")) + 1 - node.level] if node.level else []
            base = ".".join([*above, *filter(None, [node.module])])
            for one in node.names:
                # What a package hands on comes from the package, a module of it from the module.
                if found := _known(f"{base}.{one.name}") or _known(base):
                    yield found


def _known(name: str) -> str:
    return name if name in modules() else ""


def between(rooms: Mapping[str, str]) -> dict[str, dict[str, tuple[str, str]]]:
    """Return which room imports which, each with a pair of modules that shows it.

    Parameters
    ----------
    rooms : mapping of str to str
        Module -> its room; modules without one are left out.
    """
    found: dict[str, dict[str, tuple[str, str]]] = {}
    for name, others in imports().items():
        for other in sorted(others):
            here, there = rooms.get(name, ""), rooms.get(other, "")
            if here and there and here != there:
                found.setdefault(here, {}).setdefault(there, (name, other))
    return found


def circles(arrows: Mapping[str, Iterable[str]]) -> list[tuple[str, ...]]:
    """Return what can reach each other: every strongly connected component of more than one, sorted.

    Examples
    --------
    >>> circles({"a": ["b"], "b": ["c"], "c": ["b"], "d": []})
    [('b', 'c')]
    """
    reached = {name: _reached(name, arrows) for name in arrows}
    groups = {
        tuple(sorted(other for other in seen if name in reached.get(other, ()))) for name, seen in reached.items()
    }
    return sorted(group for group in groups if len(group) > 1)


def _reached(name: str, arrows: Mapping[str, Iterable[str]]) -> set[str]:
    seen: set[str] = set()
    ahead = list(arrows.get(name, ()))
    while ahead:
        one = ahead.pop()
        if one not in seen:
            seen.add(one)
            ahead.extend(arrows.get(one, ()))
    return seen
