"""Compute every case of a case file from its inputs alone: ``python -m tests.reference CASES.json OUT.json``."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from cardan import InputError, calc
from cardan.calc import CALCULATIONS


def result_of(case: dict[str, Any]) -> dict[str, Any] | None:
    """Return what cardan computes for one case, None where it does not know the capability."""
    name = case["capability"]
    if name not in CALCULATIONS:
        return None
    try:
        return {"id": case["id"], "computed": calc(name, case["inputs"])}
    except InputError as error:
        code = {"code": error.problems[0].code} if error.problems[0].code else {}
        return {"id": case["id"], "error": {"field": error.field, "message": str(error), **code}}


def main(source: str, target: str) -> None:
    """Write the results of a case file."""
    cases = json.loads(Path(source).read_text(encoding="utf8"))["cases"]
    results = [result for result in map(result_of, cases) if result is not None]
    text = json.dumps({"results": results}, indent=1, ensure_ascii=False)
    Path(target).write_text(text + "\n", encoding="utf8")
    print(f"{len(results)} of {len(cases)} cases computed")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: python -m tests.reference CASES.json OUT.json")
    main(*sys.argv[1:])
