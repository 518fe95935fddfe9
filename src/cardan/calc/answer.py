"""What is said of formulas: all of them, the keys of one, what one comes to, in the units of its keys."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from cardan.answers.answer import Answer, Column, Remark, Table
from cardan.answers.quantity import Joined, Quantity, Text
from cardan.reading.given import Given, without_unit
from cardan.texts import _

from .calculation import Calculation, Formulas
from .calculations import CALCULATIONS, GROUPS

LONG = 32
"""Forms of a key longer than this are told beside its meaning."""

INLINE = 6
"""A list longer than this is summed up for people."""

SAME = 1e-9
"""What one number asked alone and among others may differ by: rounding."""

WORDY = 60
"""Where a text is longer than this, the values stand without their meanings, which `--list` tells."""


def answer_of_all() -> Answer:
    """Return the names of all formulas, each with what it answers and its source."""
    every = CALCULATIONS.values()
    groups = [group for group in GROUPS for _item in group.calculations]
    columns = (
        Column(key="capability", values=list(CALCULATIONS)),
        Column(key="group", values=[_(group.title) for group in groups]),
        Column(key="doc", values=[_(item.doc) for item in every]),
        Column(key="source", values=[_(item.source) for item in every]),
    )
    table = Table(name="capabilities", records=True, depth="data", columns=columns)
    command = ("cardan", "calc", "--list", next(iter(CALCULATIONS)))
    return Answer(
        name="calc",
        title=_("Formulas"),
        sentence=_("{count} formulas, each by name with unit keys.").format(count=len(every)),
        tables=(table, *(_group(group) for group in GROUPS)),
        remarks=(Remark(text=_("The keys of one:"), command=command, tone="next"),),
    )


def _group(group: Formulas) -> Table:
    """Return the formulas of a subject, for people."""
    names, docs = zip(*((item.name, _(item.doc)) for item in group.calculations), strict=True)
    heads = Column(key="", heading=_("formula"), values=names)
    return Table(
        title=_(group.title),
        fixed=0,
        columns=(heads, Column(key="", heading=_("what it answers"), values=docs, wrap=True)),
    )


def answer_of_keys(item: Calculation) -> Answer:
    """Return the keys that a formula takes and gives."""
    forms = [_form(one) for one in item.takes]
    needed = [_("needed") if one.required else "" for one in item.takes]
    takes = Table(
        fixed=0,
        columns=(
            Column(key="", heading=_("takes"), values=[one.key for one in item.takes]),
            Column(key="", values=[form for form, _doc in forms], left=True),
            Column(key="", values=needed, left=True),
            Column(key="", values=[doc for _form, doc in forms], wrap=True),
        ),
    )
    gives = Table(
        fixed=0,
        columns=(
            Column(key="", heading=_("gives"), values=[one.key for one in item.returns]),
            Column(key="", values=[_(one.doc) for one in item.returns], wrap=True),
        ),
    )
    none = [""] * len(item.returns)
    every = Table(
        columns=(
            Column(key="way", values=["takes"] * len(item.takes) + ["gives"] * len(item.returns)),
            Column(key="key", values=[one.key for one in item.takes] + [one.key for one in item.returns]),
            Column(key="form", values=[form for form, _doc in forms] + none),
            Column(key="needed", values=needed + none),
            Column(key="doc", values=[doc for _form, doc in forms] + [_(one.doc) for one in item.returns]),
        )
    )
    return Answer(
        name="calc",
        title=_("Formulas"),
        sentence=f"{item.name}: {_(item.doc)}",
        tables=(takes, gives),
        remarks=(_source(item),),
        facts={
            "capability": item.name,
            "source": _(item.source),
            "takes": [{"key": g.key, "form": g.shape, "required": g.required, "doc": g.doc} for g in item.takes],
            "gives": [{"key": output.key, "doc": _(output.doc)} for output in item.returns],
        },
        full=lambda: every,
    )


def answer(item: Calculation, found: Mapping[str, Any], asked: Mapping[str, Any] | None = None) -> Answer:
    """Return what a formula comes to: where lists were asked for one number each, a row for every one of them.

    found: what it gave: values in the units of their keys; asked: its inputs.
    """
    rows = _rows(item, found, asked or {})
    if rows:
        return _of_many(item, rows)
    wordy = any(isinstance(value, str) and len(value) > WORDY for value in found.values())
    meanings = () if wordy else (Column(key="", values=[item.meaning(key) for key in found], wrap=True),)
    flat = [(key, value) for name, entry in found.items() for key, value in leaves(name, entry)]
    short = [_short(value) for value in found.values()]
    outputs = Column(key="", heading=_("output"), values=list(found))
    values = Column(key="", heading=_("value"), values=short, left=True, wrap=wordy)
    keys = Column(key="key", values=[key for key, _value in flat])
    return Answer(
        name="calc",
        title=_("Formulas"),
        sentence=f"{item.name}: {_(item.doc)}",
        tables=(Table(fixed=0, columns=(outputs, values, *meanings)),),
        remarks=(_source(item),),
        facts={"capability": item.name, "source": _(item.source), "result": found},
        full=lambda: Table(columns=(keys, Column(key="value", values=[value for _key, value in flat]))),
    )


def _rows(item: Calculation, found: Mapping[str, Any], asked: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return the numbers asked together with what each of them came to; none where the lists are not taken so.

    They are where the first and the last of them, asked alone, come to the first and the last number of every output.
    """
    takes = [one for one in item.takes if one.kind == "numbers" and len(one.axes) > 1]
    lists = {
        key: value
        for key, value in asked.items()
        for one in takes
        if without_unit(key, one.meaning.dimension) == one.name and _depth(value) == max(one.axes)
    }
    counts = {len(value) for value in lists.values()}
    if len(counts) != 1 or 0 in counts or not found:
        return []
    (count,) = counts
    for k in {0, count - 1}:
        alone = item({**asked, **{key: value[k] for key, value in lists.items()}})
        for key, value in found.items():
            if not isinstance(value, list) or len(value) != count or not _alike(value[k], alone.get(key)):
                return []
    every = {**lists, **found}
    return [{key: value[k] for key, value in every.items()} for k in range(count)]


def _depth(value: Any) -> int:
    """Return how deep a list is nested; 0 of a number."""
    return 1 + (_depth(value[0]) if value else 0) if isinstance(value, list | tuple) else 0


def _alike(one: Any, other: Any) -> bool:
    """Tell whether two values of an output are the same but for rounding."""
    if isinstance(one, list) and isinstance(other, list):
        return len(one) == len(other) and all(map(_alike, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=SAME, abs_tol=SAME)
    return bool(one == other)


def _of_many(item: Calculation, rows: list[dict[str, Any]]) -> Answer:
    """Return what a formula comes to for every number of a list."""
    flat = [dict(pair for key, value in row.items() for pair in leaves(key, value)) for row in rows]
    paths = dict.fromkeys(path for row in flat for path in row)
    return Answer(
        name="calc",
        title=_("Formulas"),
        sentence=f"{item.name}: {_(item.doc)}",
        tables=(
            Table(columns=[Column(key="", heading=key, values=[_short(row[key]) for row in rows]) for key in rows[0]]),
        ),
        remarks=(_source(item),),
        facts={"capability": item.name, "source": _(item.source), "result": rows},
        full=lambda: Table(columns=[Column(key=path, values=[row.get(path) for row in flat]) for path in paths]),
    )


def _source(item: Calculation) -> Remark:
    return Remark(text=_("Source: {source}").format(source=_(item.source)))


def _form(one: Given) -> tuple[str, str]:
    """Return form and meaning of a key; what would make the form long goes to the meaning, which wraps."""
    head, _with, columns = one.shape.partition(" with ")
    if columns:
        return head, f"{one.doc}: {columns}"
    if len(one.shape) > LONG:
        return _("a word"), f"{one.doc}: {one.shape}"
    return one.shape, one.doc


def leaves(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the single values of nested lists and tables with their paths.

    value: number, word, list or table.

    >>> list(leaves("x", [[1, 2], 3]))
    [('x[0][0]', 1), ('x[0][1]', 2), ('x[1]', 3)]
    """
    if isinstance(value, Mapping):
        for key, entry in value.items():
            yield from leaves(f"{name}.{key}", entry)
    elif isinstance(value, list):
        for k, entry in enumerate(value):
            yield from leaves(f"{name}[{k}]", entry)
    else:
        yield name, value


def _short(value: Any) -> Text:
    """Return a value for people, in the unit of its key."""
    if isinstance(value, list):
        if len(value) > INLINE:
            return _("{count} values, see --json").format(count=len(value))
        return Joined(["[", Joined([_short(entry) for entry in value]), "]"], between="")
    if isinstance(value, Mapping):
        entries = [Joined([f"{key}:", _short(entry)], between=" ") for key, entry in value.items()]
        return Joined(["{", Joined(entries), "}"], between="")
    if value is None:
        return "–"
    if isinstance(value, bool):
        return _("yes") if value else _("no")
    return Quantity(value, digits=6) if isinstance(value, float) else str(value)
