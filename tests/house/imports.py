"""Which module imports which, as the source says it: those for type checking alone and those made later too."""

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
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "later":
            yield from filter(None, [_known(ast.literal_eval(node.args[0]))])


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


def hidden() -> dict[str, set[str]]:
    """Return the modules with an import that does not stand at the top for every reader, each with where it stands."""
    found: dict[str, set[str]] = {}
    for name, path in modules().items():
        tree = ast.parse(path.read_text("utf-8"))
        open_ones = {id(node) for node in tree.body}
        for node in ast.walk(tree):
            if isinstance(node, ast.Import | ast.ImportFrom) and id(node) not in open_ones:
                found.setdefault(name, set()).add(_place(tree, node))
    return found


def _place(tree: ast.Module, wanted: ast.AST) -> str:
    """Return the name of the function around a node, or the kind of statement at the top of the module."""
    around = [node for node in ast.walk(tree) if node is not tree and any(one is wanted for one in ast.walk(node))]
    named = [node.name for node in around if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    return f"{named[-1]}()" if named else type(around[0]).__name__.lower()


def borrowed() -> list[str]:
    """Return where a module takes a private name of another one of the package: imported, or by its module."""
    found = []
    for name, path in modules().items():
        tree = ast.parse(path.read_text("utf-8"))
        taken = [node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        names = {one.asname or one.name for node in taken for one in node.names}
        found += [f"{name}: {one.name}" for node in taken for one in node.names if _is_private(one.name)]
        found += [
            f"{name}: {node.value.id}.{node.attr}"
            for node in ast.walk(tree)
            if isinstance(node, ast.Attribute)
            and isinstance(node.value, ast.Name)
            and node.value.id in names
            and _is_private(node.attr)
        ]
    return found


def _is_private(name: str) -> bool:
    return name.startswith("_") and name != "_" and not name.startswith("__")
