"""From nested tables to the text of a drive file or mechanism file."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def toml_text(tree: Mapping[str, Any]) -> str:
    """Return nested tables as TOML: values first, then tables, then lists of tables."""
    lines: list[str] = []
    _emit(tree, "", lines)
    return "\n".join(lines).strip() + "\n"


def _emit(table: Mapping[str, Any], path: str, lines: list[str]) -> None:
    for key, value in table.items():
        if isinstance(value, Mapping) and not path and key in ("input", "output"):
            lines += [f"{key}.{inner} = {_toml(item)}" for inner, item in value.items()]
        elif not path and isinstance(value, str) and "\n" in value:
            lines.append(f"{_key(key)} = {_paragraphs(value)}")
        elif path or not (isinstance(value, Mapping) or _is_tables(value)):
            lines.append(f"{_key(key)} = {_toml(value)}")
    if path:
        return
    for key, value in table.items():
        if isinstance(value, Mapping) and key not in ("input", "output"):
            lines += ["", f"[{key}]"]
            _emit(value, key, lines)
        elif _is_tables(value):
            for item in value:
                lines += ["", f"[[{key}]]"]
                _emit(item, key, lines)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], Mapping)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_toml(item)}" for key, item in value.items()) + " }"
    return repr(whole(value))


def whole(value: Any) -> Any:
    """Return a whole number without a point, all else as it is."""
    return int(value) if isinstance(value, float) and value.is_integer() and abs(value) < 1e15 else value


def _paragraphs(text: str) -> str:
    """Return a text of several lines as one that a reader of the file sees as such."""
    body = "\n".join(_toml(line)[1:-1] for line in text.split("\n"))
    return f'"""\n{body}"""'


def _key(key: str) -> str:
    plain = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if plain else json.dumps(key, ensure_ascii=False)
