"""Write ``answers.json.xz``: what all command lines of `plan` answer now. ``python -m tests.golden.capture``.

Only of use where an answer is meant to become another one: read what `tests.golden.check` tells first. With words
behind it, only the command lines that begin with them are asked anew.
"""

from __future__ import annotations

import json
import lzma
import sys
import time
from pathlib import Path
from typing import Any

from .columns import columns, thinned
from .plan import plan
from .running import answered, workplace

STORE = Path(__file__).parent / "answers.json.xz"


def record(answer: dict[str, Any]) -> dict[str, Any]:
    """Return what is stored of an answer: its code, and its numbers or the fields that it refuses."""
    if "answer" not in answer:
        return {key: answer[key] for key in ("skipped", "code", "fields") if key in answer}
    return {
        "code": answer["code"],
        "numbers": {path: thinned(values) for path, values in sorted(columns(answer["answer"]).items())},
    }


def stored() -> dict[str, dict[str, Any]]:
    """Return what is stored, by command line."""
    found: dict[str, dict[str, Any]] = json.loads(lzma.decompress(STORE.read_bytes()))
    return found


def write(records: dict[str, dict[str, Any]]) -> None:
    """Store records, the same bytes for the same records."""
    text = "{\n" + ",\n".join(f"{_json(line)}:{_json(one)}" for line, one in records.items()) + "\n}\n"
    STORE.write_bytes(lzma.compress(text.encode(), preset=9 | lzma.PRESET_EXTREME))


def _json(content: Any) -> str:
    return json.dumps(content, ensure_ascii=False, separators=(",", ":"), allow_nan=False)


def main(words: list[str]) -> None:
    """Ask all command lines, or those that begin with some words, and store what they answer."""
    lines = list(plan())
    wanted = [line for line in lines if line.startswith(" ".join(words))]
    known = stored() if words else {}
    begun = time.monotonic()
    with workplace():
        for k, line in enumerate(wanted):
            known[line] = record(answered(line))
            if k % 50 == 0:
                print(f"{k} of {len(wanted)} after {time.monotonic() - begun:.0f} s: {line}", file=sys.stderr)
    write({line: known[line] for line in lines if line in known})
    print(f"{len(wanted)} answers, {STORE.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main(sys.argv[1:])
