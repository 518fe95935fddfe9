"""What a file may hold: counted in its text before a parser sees it, for parsers are slow on texts made to be slow."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any

from cardan.errors import Problem, check
from cardan.texts import _

MAX_BYTES = 2_000_000
MAX_LEVELS = 32  # tables and lists in each other, parts of dotted keys among them: `tomllib` takes the square of these
MAX_KEYS = 20_000
MAX_JOINTS = 100  # of a drive
MAX_PAIRS = 400  # the joints of a mechanism
MAX_TABLES = 500  # of each of the other lists
LISTS = ("joints", "loads", "masses", "movements", "poses", "shafts", "stations", "supports")

VARIABLE = "CARDAN_NO_LIMITS"  # of the environment; processes started from here know it too
_lifted: ContextVar[bool] = ContextVar("cardan_limits_lifted", default=False)

_TOKEN = re.compile(
    r"""\#[^\n]*
    | \"{3} (?: [^"\\]+ | \\.? | "(?!"") )*+ (?: "{3,5} | \Z )
    | '{3} (?: [^']+ | '(?!'') )*+ (?: '{3,5} | \Z )
    | " (?: [^"\\\n]+ | \\[^\n]? )*+ "?
    | '[^'\n]*'?
    | ^[ \t]*\[\[[ \t]*(?P<list>[a-z]+)[ \t]*\]\]
    | (?P<mark>[\[\]{}.=:,\n])""",
    re.DOTALL | re.MULTILINE | re.VERBOSE,
)


def limited() -> bool:
    """Tell whether the limits hold here."""
    return not (_lifted.get() or os.environ.get(VARIABLE))


@contextmanager
def limits_hold(hold: bool) -> Iterator[None]:
    """Lift the limits within, unless they are to hold."""
    before = _lifted.set(_lifted.get() or not hold)
    try:
        yield
    finally:
        _lifted.reset(before)


def check_text(text: str, name: str, *, counts: bool = True) -> None:
    """Refuse a TOML or JSON text that is too large or too deep, or has too many keys, joints or other tables.

    name: what messages call it; counts: whether keys and tables are limited too, which they are not in a catalogue.
    """
    if not limited():
        return
    check_size(len(text.encode("utf-8", "surrogatepass")), name)
    levels, keys, tables = _counted(text)
    found = [_beyond(name, levels, _("levels of tables, lists and dotted keys"), MAX_LEVELS)]
    if counts:
        found.append(_beyond(name, keys, _("keys"), MAX_KEYS))
        found += [
            _beyond(key, tables[key], f"[[{key}]]", MAX_PAIRS if key == "joints" else MAX_TABLES) for key in LISTS
        ]
    check(one for one in found if one)


def check_size(size: int, name: str) -> None:
    """Refuse a file of more bytes than allowed."""
    if limited():
        check(one for one in [_beyond(name, size, _("bytes"), MAX_BYTES)] if one)


def check_lists(tree: Mapping[str, Any], *, mechanism: bool) -> None:
    """Refuse nested tables with too many joints or other tables, however the file writes them."""
    if not limited():
        return
    joints = MAX_PAIRS if mechanism else MAX_JOINTS
    most = {key: joints if key == "joints" else MAX_TABLES for key in LISTS}
    lists = {key: tree[key] for key in LISTS if isinstance(tree.get(key), list)}
    check(one for key, given in lists.items() if (one := _beyond(key, len(given), f"[[{key}]]", most[key])))


def _beyond(field: str, given: int, what: str, limit: int) -> Problem | None:
    if given <= limit:
        return None
    text = _(
        "{given} {what} given; the limit is {limit}. A file may have {size} MB, {levels} levels, {keys} keys, {joints}"
        " joints ({pairs} in a mechanism) and {tables} stations, supports, shafts, movements or poses; the option"
        " --no-limits, or limits=False in Python, lifts this"
    )
    most = {"size": MAX_BYTES // 10**6, "levels": MAX_LEVELS, "keys": MAX_KEYS}
    most |= {"joints": MAX_JOINTS, "pairs": MAX_PAIRS, "tables": MAX_TABLES}
    return Problem(field, text.format(given=given, what=what, limit=limit, **most), "out_of_range")


def _counted(text: str) -> tuple[int, int, Counter[str]]:
    """Return how deep a text goes, how many keys it has, and how many tables under each `[[name]]`."""
    deepest = depth = dots = keys = 0
    outer: list[int] = []  # of each open bracket, the levels that it is worth
    tables: Counter[str] = Counter()
    for token in _TOKEN.finditer(text):
        mark = token["mark"]
        if mark is None:
            if token["list"]:
                tables[token["list"]] += 1
        elif mark == ".":
            dots += 1
            deepest = max(deepest, depth + dots)
        elif mark in "[{":
            outer.append(1 + dots)
            depth, dots = depth + 1 + dots, 0
            deepest = max(deepest, depth)
        elif mark in "]}":
            depth, dots = depth - (outer.pop() if outer else 0), 0
        elif mark in "=:":
            keys += 1
        else:
            dots = 0
    return deepest, keys, tables
