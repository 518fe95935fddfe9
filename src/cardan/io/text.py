"""The text of a file, and the nested tables that it holds: TOML or JSON."""

from __future__ import annotations

import json
import os
import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from cardan.errors import Problem, check, refuse
from cardan.files import refusal
from cardan.reading.limits import MAX_BYTES, check_lists, check_size, check_text, limited
from cardan.texts import _

ODD = re.compile(r"""[=:]\s*([+-]?\d+(?:[,'\u2019 \u00a0\u202f]\d+)+(?:[.,]\d+)?)\s*(?:[,}#]|$)""")
"""What stands for a number elsewhere and for none in a file: 7,5 and 1 500 and 1,500.0."""


def text_of(where: Path) -> tuple[str, str]:
    """Return the text of a file, and whether it is ``"toml"`` or ``"json"``."""
    try:
        with where.open("rb") as stream:
            size = os.fstat(stream.fileno()).st_size
            check_size(size, str(where))
            content = stream.read(MAX_BYTES + 1 if limited() else -1)
        check_size(len(content), str(where))  # of a pipe, which does not say how long it is
        text = content.decode("utf-8-sig")
    except OSError as error:
        raise refuse(str(where), _("cannot be read: {why}").format(why=refusal(error))) from None
    except UnicodeDecodeError as error:
        raise refuse(str(where), _("is not UTF-8 text (byte {byte})").format(byte=error.start)) from None
    return text, where.suffix.lower().lstrip(".") or "toml"


def describes_mechanism(tree: Mapping[str, Any]) -> bool:
    """Tell whether nested tables are those of a mechanism file: it names a frame, or links of its joints."""
    joints = tree.get("joints")
    linked = isinstance(joints, list) and any(isinstance(one, dict) and "links" in one for one in joints)
    return "frame" in tree or linked


def parsed(text: str, form: str, name: str) -> dict[str, Any]:
    """Return the nested tables of a text."""
    text = text.removeprefix("\ufeff")
    check_text(text, name)
    title = "JSON" if form == "json" else "TOML"
    twice: list[str] = []
    try:
        if form == "json":
            tree = json.loads(text, object_pairs_hook=lambda pairs: _once(pairs, twice))
        else:
            tree = tomllib.loads(text)
    except RecursionError:
        raise refuse(name, _("is not {format} that can be read: too deeply nested").format(format=title)) from None
    except ValueError as error:  # that of the parser, or of Python for a number of thousands of digits
        said = _("is not {format}: {why}").format(format=title, why=error)
        raise refuse(name, said + _odd_number(text)) from None
    check(Problem(key, _("stands twice in one table")) for key in twice)
    if not isinstance(tree, dict):
        raise refuse(name, _("holds no table"))
    check_lists(tree, mechanism=describes_mechanism(tree))
    return tree


def _odd_number(text: str) -> str:
    """Return a hint at the first number with a decimal comma or a sign between its thousands; nothing where none is."""
    for number, line in enumerate(text.splitlines(), start=1):
        found = ODD.search(line)
        if found:
            hint = _("; line {line}: write {given} with a decimal point and without signs between thousands")
            return hint.format(line=number, given=found[1])
    return ""


def _once(pairs: list[tuple[str, Any]], twice: list[str]) -> dict[str, Any]:
    """Return the table of a JSON object, noting keys that it has more than once."""
    table: dict[str, Any] = {}
    for key, value in pairs:
        if key in table:
            twice.append(key)
        table[key] = value
    return table
