"""Compare what a command line answers with what is stored of it."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from difflib import SequenceMatcher, get_close_matches
from typing import Any

from . import changed, renamed, tolerances
from .columns import KEPT, Columns, columns, in_si, number, thinned, without_unit

ALIKE = 3
"""So many new paths are proposed for a missing one."""


@dataclass(frozen=True)
class Difference:
    """One thing that is no longer as stored.

    Parameters
    ----------
    line : str
        Command line of old.
    path : str
        Old path, empty where the whole answer differs.
    kind : str
        One of missing, differs, length, answer.
    said : str
        What is wrong, in one line.
    same : tuple of str
        New paths that hold the very numbers of a missing one, the likest name first.
    """

    line: str
    path: str
    kind: str
    said: str
    same: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Column:
    """A new column: its path, the same without its unit, and its numbers in SI."""

    path: str
    bare: str
    dimension: str
    values: list[float]


FAULT = 70
"""Exit code of a fault of cardan itself."""


def line_now(line: str) -> str:
    """Return how a stored command line is written now."""
    for pattern, new in renamed.COMMAND_LINES:
        line = re.sub(pattern, new, line)
    return line


def path_now(line: str, path: str) -> str:
    """Return how a stored path is called now."""
    for start, pattern, new in renamed.PATHS:
        found = re.fullmatch(pattern, path) if re.match(start, line) else None
        if found:
            return found.expand(new)
    return path


def differences(line: str, old: dict[str, Any], answer: dict[str, Any], *, exact: bool) -> list[Difference]:
    """Return all in which an answer differs from the record of it.

    Parameters
    ----------
    line : str
        The stored command line.
    old : dict
        Its record, as `tests.golden.capture` stores it.
    answer : dict
        What `tests.golden.running.answered` returns of it now.
    exact : bool
        To 1e-12, as on one machine, or as any processor must.
    """
    if "skipped" in old:
        return []
    if "skipped" in answer or "crashed" in answer:
        return [Difference(line, "", "answer", str(answer))]
    if "fields" in old:
        return _refused(line, old, answer)
    if "answer" not in answer:
        return [Difference(line, "", "answer", f"was answered, is refused with {answer['code']}: {answer['fields']}")]
    coded = [] if answer["code"] == old["code"] else [Difference(line, "", "answer", _code(old, answer))]
    return coded + _numbers(line, old["numbers"], _new(columns(answer["answer"])), exact=exact)


def _code(old: dict[str, Any], answer: dict[str, Any]) -> str:
    return f"exit code {old['code']} has become {answer['code']}"


def _refused(line: str, old: dict[str, Any], answer: dict[str, Any]) -> list[Difference]:
    if old["code"] == FAULT and answer["code"] != FAULT:
        return []  # a fault was no answer: whatever is said instead of it is none that is lost
    if "fields" not in answer:
        free = any(re.match(pattern, line) for pattern in renamed.ANSWERED)
        return [] if free else [Difference(line, "", "answer", f"was refused for {old['fields']}, is answered")]
    fields = old["fields"]
    for pattern, new in renamed.FIELDS:
        fields = [re.sub(pattern, new, field) for field in fields]
    if answer["code"] != old["code"]:
        return [Difference(line, "", "answer", _code(old, answer))]
    other = any(re.match(pattern, line) for pattern, _why in changed.REFUSED)
    if sorted(fields) != sorted(answer["fields"]) and not other:
        return [Difference(line, "", "answer", f"was refused for {sorted(fields)}, now for {answer['fields']}")]
    return []


def _new(found: Columns) -> list[_Column]:
    new = []
    for path, values in found.items():
        bare, dimension, size = without_unit(path)
        new.append(_Column(path, bare, dimension, [value * size for value in values]))
    return new


def _numbers(line: str, old: dict[str, Any], new: list[_Column], *, exact: bool) -> list[Difference]:
    scales = dict(tolerances.ORDINARY)
    for path, stored in old.items():
        _bare, dimension, size = without_unit(path)
        if dimension:
            scales[dimension] = max(scales.get(dimension, 1.0), _largest(in_si(stored, size)))
    found = []
    meant = [pattern for start, pattern, _why in changed.NUMBERS if re.match(start, line)]
    for path, stored in old.items():
        if any(re.fullmatch(pattern, path) for pattern in meant):
            continue
        bare, dimension, size = without_unit(path)
        rule = _rule(line, path, scales.get(dimension, 1.0), dimension, exact=exact)
        wanted = in_si(stored, size)
        now = without_unit(path_now(line, path))[0]
        held = [column.values for column in new if column.bare == now]
        if rule.among and held:
            held = [[value for values in held for value in values]]
        faults = [_fault(wanted, values, rule) for values in held]
        if not faults:
            same = _nearest_first(now, [column for column in new if not _fault(wanted, column.values, rule)])
            found.append(Difference(line, path, "missing", _missing(stored, now, new, same), same))
        elif all(faults):
            kind, said = faults[0]
            unit = path.removeprefix(bare).strip("_") if dimension else ""
            found.append(Difference(line, path, kind, said + (f" [SI of {unit}]" if unit and size != 1.0 else "")))
    return found


def _nearest_first(bare: str, new: list[_Column]) -> tuple[str, ...]:
    return tuple(one.path for one in sorted(new, key=lambda one: -SequenceMatcher(None, bare, one.bare).ratio()))


@dataclass(frozen=True)
class _Rule:
    """How a column is compared.

    Parameters
    ----------
    tolerance : float
        Share of its largest magnitude.
    noise : float
        All numbers below are alike.
    among : bool
        Whether its numbers may stand in any order, among others.
    least : float
        Differences that never count.
    """

    tolerance: float
    noise: float
    among: bool
    least: float = 0.0


def _rule(line: str, path: str, scale: float, dimension: str, *, exact: bool) -> _Rule:
    among = any(re.match(start, line) and re.fullmatch(pattern, path) for start, pattern in renamed.AMONG)
    tolerance = tolerances.EXACT if exact else tolerances.ANYWHERE
    noise = tolerances.NOISE[exact] * scale
    if any(re.match(start, line) and re.fullmatch(pattern, path) for start, pattern in tolerances.RESIDUALS):
        return _Rule(tolerances.RESIDUAL, tolerances.RESIDUAL * scale, among)
    if exact:
        return _Rule(tolerance, noise, among)
    fitting = (row[2] for row in tolerances.LOOSER if re.match(row[0], line) and re.fullmatch(row[1], path))
    return _Rule(next(fitting, tolerance), noise, among, noise if dimension else 0.0)


def _largest(stored: Any) -> float:
    values = stored if isinstance(stored, list) else stored["values"]
    return max((abs(value) for value in values if math.isfinite(value)), default=0.0)


def _fault(wanted: Any, got: list[float], rule: _Rule) -> tuple[str, str] | None:
    """Return kind and words of what is wrong with a new column, None where nothing is."""
    if rule.tolerance == tolerances.CLASS:
        return None
    if rule.among:
        return _absent(wanted, got, rule)
    length = len(wanted) if isinstance(wanted, list) else wanted["length"]
    if len(got) != length:
        got, wanted = _told(got), _told(wanted) if isinstance(wanted, list) else wanted
        if not isinstance(wanted, list) or len(got) != len(wanted):
            return "length", f"{length} numbers have become {len(got)}"
    now = got if isinstance(wanted, list) else [number(one) for one in thinned(got)["values"]]
    before = wanted if isinstance(wanted, list) else wanted["values"]
    scale = _largest(before)
    for k, (a, b) in enumerate(zip(before, now, strict=True)):
        if not _equal(a, b, scale, rule):
            place = f"[{k}]" if length <= KEPT else f"[{k * wanted['every']}]"
            share = f", {abs(a - b) / scale:.1e} of the largest" if scale and math.isfinite(a - b) else ""
            return "differs", f"{place if length > 1 else ''} {a!r} has become {b!r}{share}".strip()
    if not isinstance(wanted, list):
        total = math.fsum(abs(one) for one in got if math.isfinite(one))
        if not _equal(wanted["sum"] / length, total / length, scale, rule):
            return "differs", f"sum of magnitudes {wanted['sum']!r} has become {total!r}"
    return None


def _absent(wanted: Any, got: list[float], rule: _Rule) -> tuple[str, str] | None:
    before = _told(wanted if isinstance(wanted, list) else wanted["values"])
    scale = _largest(before)
    for value in before:
        if not any(_equal(value, one, scale, rule) for one in got):
            return "differs", f"{value!r} is not among the {len(got)} numbers there are now"
    return None


def _told(values: list[float]) -> list[float]:
    return [value for value in values if not math.isnan(value)]


def _equal(a: float, b: float, scale: float, rule: _Rule) -> bool:
    if not (math.isfinite(a) and math.isfinite(b)):
        return a == b or (math.isnan(a) and math.isnan(b))
    if abs(a) <= rule.noise and abs(b) <= rule.noise:
        return True
    return abs(a - b) <= max(rule.tolerance * scale, rule.least)


def _missing(stored: Any, now: str, new: list[_Column], same: tuple[str, ...]) -> str:
    length = len(stored) if isinstance(stored, list) else stored["length"]
    first = (stored if isinstance(stored, list) else stored["values"])[0]
    near = get_close_matches(now, [column.bare for column in new], n=ALIKE, cutoff=0.3)
    by_name = [next(column.path for column in new if column.bare == bare) for bare in near]
    held = f"; same numbers at {', '.join(same[:ALIKE])}" if same else ""
    like = f"; alike {', '.join(by_name)}" if by_name and not same else ""
    return f"{length} × {first}{held}{like}"
