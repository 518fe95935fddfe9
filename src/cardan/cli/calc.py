"""``cardan calc``: any single formula by name, with unit keys."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from cardan.errors import InputError, Problem, check, refuse
from cardan.texts import _

from .options import AsCsv, AsJson

if TYPE_CHECKING:
    from cardan.calc import Calculation
    from cardan.calc.calculation import Given

    from .answer import Answer

LONG = 32
"""Forms of a key longer than this are told beside its meaning."""

INLINE = 6
"""A list longer than this is summed up in the terminal."""

WORDY = 60
"""Where a text is longer than this, the values stand without their meanings, which `--list` tells."""


def _names(incomplete: str) -> list[tuple[str, str]]:
    """Complete the name of a capability."""
    from cardan.calc import CALCULATIONS

    return [(name, _(item.doc)) for name, item in CALCULATIONS.items() if name.startswith(incomplete)]


def calc(
    capability: Annotated[
        str | None,
        typer.Argument(metavar="NAME", help=_("Name of the formula."), show_default=False, autocompletion=_names),
    ] = None,
    values: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="KEY=VALUE",
            help=_("Inputs: alpha_deg=20, beta_deg=[1.9,-23]; lists and tables as JSON."),
            show_default=False,
        ),
    ] = None,
    input: Annotated[
        Path | None,
        typer.Option(
            "--input",
            "-i",
            metavar="FILE",
            help=_("Read the inputs from a JSON file; - reads standard input. KEY=VALUE goes before it."),
            show_default=False,
        ),
    ] = None,
    list_: Annotated[
        bool,
        typer.Option("--list", "-l", help=_("List the formulas, or the keys of one."), show_default=False),
    ] = False,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Reach any single formula by name."""
    from .failure import RefusedError
    from .show import check_common, show

    check_common(json=json, csv=csv)
    given = {} if list_ else inputs(input, values or ())

    from cardan.calc import calc as compute
    from cardan.calc import find

    if capability is None:
        if not list_:
            raise refuse("", _("which formula? cardan calc --list names them"))
        return show(_catalogue(), json=json, csv=csv)
    try:
        item = find(capability)
    except InputError as error:
        raise RefusedError("", error.problems, headline=error.problems[0].message) from error
    if list_:
        return show(_described(item), json=json, csv=csv)
    return show(_answer(item, compute(capability, given)), json=json, csv=csv)


def inputs(file: Path | None, values: Sequence[str]) -> dict[str, Any]:
    """Return the inputs of a file and those of the command line, which win.

    Examples
    --------
    >>> inputs(None, ["alpha_deg=20", "beta_deg=[1, 2]", "method=exact"])
    {'alpha_deg': 20, 'beta_deg': [1, 2], 'method': 'exact'}
    """
    from .values import value_of

    found = {} if file is None else _file(file)
    own: dict[str, Any] = {}
    problems = []
    for value in values:
        key, equals, text = value.partition("=")
        if not equals or not key:
            problems.append(Problem(value, _("inputs look like alpha_deg=20")))
        elif key in own:
            problems.append(Problem(key, _("given twice")))
        else:
            own[key] = value_of(text)
    check(problems)
    return found | own


def _file(path: Path) -> dict[str, Any]:
    import json

    from .failure import about
    from .source import STDIN, stdin_text

    with about(str(path)):
        try:
            text = stdin_text() if path == STDIN else path.read_text(encoding="utf-8")
            found = json.loads(text)
        except UnicodeDecodeError as error:
            raise refuse("", _("is not text in UTF-8")) from error
        except (ValueError, RecursionError) as error:
            raise refuse("", _("is not JSON: {reason}").format(reason=error)) from error
        if not isinstance(found, dict):
            raise refuse("", _("should hold one JSON object, key by key"))
        return found


def _catalogue() -> Answer:
    from cardan.calc import CALCULATIONS

    from .answer import Answer, Column, Remark, Table

    rows = [(name, _(item.doc), _(item.source)) for name, item in CALCULATIONS.items()]
    return Answer(
        sentence=_("{count} formulas, each by name with unit keys.").format(count=len(rows)),
        tables=lambda: (
            Table(
                columns=(
                    Column(key="capability", heading=_("formula"), left=True),
                    Column(key="doc", heading=_("what it answers"), left=True, wrap=True),
                ),
                rows=[row[:2] for row in rows],
            ),
        ),
        csv=lambda: Table(columns=tuple(Column(key=key) for key in ("capability", "doc", "source")), rows=rows),
        remarks=(Remark(text=_("The keys of one:"), command=("cardan", "calc", "--list", rows[0][0]), tone="next"),),
        content=lambda: {
            "capabilities": [dict(zip(("capability", "doc", "source"), row, strict=True)) for row in rows]
        },
    )


def _described(item: Calculation) -> Answer:
    from .answer import Answer, Column, Remark, Table

    takes = [
        (one.key, form, _("needed") if one.required else "", doc) for one in item.takes for form, doc in [_form(one)]
    ]
    gives = [(output.key, "", "", _(output.doc)) for output in item.returns]
    columns = (
        Column(key="key", heading=_("takes"), left=True),
        Column(key="form", left=True),
        Column(key="needed", left=True),
        Column(key="doc", left=True, wrap=True),
    )
    return Answer(
        sentence=f"{item.name}: {_(item.doc)}",
        tables=lambda: (
            Table(columns=columns, rows=takes),
            Table(
                columns=(Column(key="key", heading=_("gives"), left=True), columns[3]),
                rows=[(row[0], row[3]) for row in gives],
            ),
        ),
        csv=lambda: Table(
            columns=(Column(key="way"), *columns),
            rows=[("takes", *row) for row in takes] + [("gives", *row) for row in gives],
        ),
        remarks=(Remark(text=_("Source: {source}").format(source=_(item.source))),),
        content=lambda: {
            "capability": item.name,
            "source": _(item.source),
            "takes": [{"key": g.key, "form": g.shape, "required": g.required, "doc": g.doc} for g in item.takes],
            "gives": [{"key": output.key, "doc": _(output.doc)} for output in item.returns],
        },
    )


def _form(one: Given) -> tuple[str, str]:
    """Return form and meaning of a key; what would make the form long goes to the meaning, which wraps."""
    head, _with, columns = one.shape.partition(" with ")
    if columns:
        return head, f"{one.doc}: {columns}"
    if len(one.shape) > LONG:
        return _("a word"), f"{one.doc}: {one.shape}"
    return one.shape, one.doc


def _answer(item: Calculation, found: dict[str, Any]) -> Answer:
    from .answer import Answer, Column, Remark, Table

    docs = {output.key: _(output.doc) for output in item.returns}
    rows = [(key, _short(value), docs.get(key, "")) for key, value in found.items()]
    wordy = any(isinstance(value, str) and len(value) > WORDY for value in found.values())
    columns = (
        Column(key="key", heading=_("output"), left=True),
        Column(key="value", heading=_("value"), left=True, wrap=wordy),
        Column(key="doc", left=True, wrap=True),
    )
    shown = Table(columns=columns[:2], rows=[row[:2] for row in rows]) if wordy else Table(columns=columns, rows=rows)
    flat = [(key, value) for name, entry in found.items() for key, value in leaves(name, entry)]
    return Answer(
        sentence=f"{item.name}: {_(item.doc)}",
        tables=lambda: (shown,),
        csv=lambda: Table(columns=columns[:2], rows=flat),
        remarks=(Remark(text=_("Source: {source}").format(source=_(item.source))),),
        content=lambda: {"capability": item.name, "source": _(item.source), "result": found},
    )


def leaves(name: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the single values of nested lists and tables with their paths.

    Examples
    --------
    >>> list(leaves("x", [[1, 2], 3]))
    [('x[0][0]', 1), ('x[0][1]', 2), ('x[1]', 3)]
    """
    if isinstance(value, dict):
        for key, entry in value.items():
            yield from leaves(f"{name}.{key}", entry)
    elif isinstance(value, list):
        for k, entry in enumerate(value):
            yield from leaves(f"{name}[{k}]", entry)
    else:
        yield name, value


def _short(value: Any) -> str:
    from .answer import printed

    if isinstance(value, list):
        if len(value) > INLINE:
            return _("{count} values, see --json").format(count=len(value))
        return "[" + ", ".join(_short(entry) for entry in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_short(entry)}" for key, entry in value.items()) + "}"
    return printed(value, "6")
