"""``cardan calc``: any single formula by name, with unit keys."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

from cardan.calc import CALCULATIONS, find
from cardan.calc import calc as compute
from cardan.calc.answer import answer, answer_of_all, answer_of_keys
from cardan.cli.shared.failure import RefusedError, about
from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import check_common
from cardan.cli.shared.source import STDIN, AsCsv, AsJson, stdin_text, value_of
from cardan.cli.shared.tell import tell
from cardan.errors import InputError, Problem, check, refuse
from cardan.texts import _


def _names(incomplete: str) -> list[tuple[str, str]]:
    """Complete the name of a capability."""
    return [(name, _(item.doc)) for name, item in CALCULATIONS.items() if name.startswith(incomplete)]


def calc(
    capability: Annotated[str | None, argument("NAME", _("Name of the formula."), autocompletion=_names)] = None,
    values: Annotated[
        list[str] | None,
        argument("KEY=VALUE", _("Inputs: alpha_deg=20, beta_deg=[1.9,-23]; lists and tables as JSON.")),
    ] = None,
    input: Annotated[
        Path | None,
        option(
            "--input -i",
            "FILE",
            _("Read the inputs from a JSON file; - reads standard input. KEY=VALUE goes before it."),
        ),
    ] = None,
    list_: Annotated[bool, flag("--list -l", _("List the formulas, or the keys of one."))] = False,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Evaluate one formula by name."""
    check_common(json=json, csv=csv)
    given = {} if list_ else inputs(input, values or ())
    if capability is None:
        if not list_:
            raise refuse("", _("which formula? cardan calc --list names them"))
        return tell(answer_of_all(), json=json, csv=csv)
    try:
        item = find(capability)
    except InputError as error:
        raise RefusedError("", error.problems, headline=error.problems[0].message) from error
    if list_:
        return tell(answer_of_keys(item), json=json, csv=csv)
    return tell(answer(item, compute(capability, given), given), json=json, csv=csv)


def inputs(file: Path | None, values: Sequence[str]) -> dict[str, Any]:
    """Return the inputs of a file and those of the command line, which win."""
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
