"""Run command lines in this process, in a folder with all that they name, each with a limit of time."""

from __future__ import annotations

import json
import os
import shlex
import signal
import tempfile
import threading
from collections.abc import Iterator
from contextlib import chdir, contextmanager, redirect_stderr, redirect_stdout
from io import BytesIO, TextIOWrapper
from pathlib import Path
from typing import Any

from .plan import BOXED, EXAMPLES, PREPARED, cases

PLAIN = {"NO_COLOR": "1", "TERM": "dumb", "COLUMNS": "80", "PYTHONUTF8": "1", "CARDAN_LANG": "en"}

LIMIT_S = 300
"""Time of the processor after which a run counts as hung and is stopped, on however busy a machine: several times what
the longest takes. How fast they are, benchmarks tell.
"""


class Slow(BaseException):
    """A run took longer than it may."""


@contextmanager
def workplace() -> Iterator[Path]:
    """Make a folder with the examples and the cases of reference, and work in it."""
    before = {name: os.environ.get(name) for name in PLAIN}
    with tempfile.TemporaryDirectory() as made:
        where = Path(made)
        (where / "examples").symlink_to(EXAMPLES)
        (where / "cases").mkdir()
        for name, case in cases().items():
            (where / "cases" / f"{name}.json").write_text(json.dumps(case["inputs"]), "utf8")
        example, copy, old, new = BOXED
        (where / copy).write_text((where / example).read_text("utf8").replace(old, new), "utf8")
        os.environ.update(PLAIN)
        try:
            with chdir(where):
                yield where
        finally:
            for name, value in before.items():
                if value is None:
                    del os.environ[name]
                else:
                    os.environ[name] = value


def answered(line: str) -> dict[str, Any]:
    """Return what a command line answers with ``--json``.

    Returns
    -------
    dict
        ``{"code", "answer"}``, ``{"code", "fields"}`` of a refusal, or ``{"skipped"}`` and why.
    """
    words = shlex.split(line)
    for folder, filling in PREPARED.items():
        if folder in words and not Path(folder).exists():
            prepared(filling)
    code, out, err = called([*words, "--json"])
    if code is None:
        return {"skipped": f"longer than {LIMIT_S} s"}
    text = out if out.strip() else err
    try:
        content = json.loads(text)
    except ValueError:
        return {"code": code, "fields": [], "text": text[:300]}
    if "error" in content:
        return {"code": code, "fields": sorted(one["field"] for one in content["error"]["problems"])}
    return {"code": code, "answer": content}


def prepared(line: str) -> None:
    """Fill a folder that other command lines read."""
    called(shlex.split(line))


def called(words: list[str]) -> tuple[int | None, str, str]:
    """Run one command line; its code is None where it took too long."""
    from cardan.cli.main import main

    late = False

    def stop(*_: object) -> None:
        nonlocal late
        late = True
        raise Slow

    limited = threading.current_thread() is threading.main_thread()
    streams = [TextIOWrapper(BytesIO(), encoding="utf-8", write_through=True) for _ in range(2)]
    if limited:
        before = signal.signal(signal.SIGPROF, stop)
        signal.setitimer(signal.ITIMER_PROF, LIMIT_S)
    try:
        with redirect_stdout(streams[0]), redirect_stderr(streams[1]):
            code = main(words)
    except Slow:
        code = 70
    finally:
        if limited:
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.signal(signal.SIGPROF, before)
    out, err = (stream.buffer.getvalue().decode() for stream in streams)  # type: ignore[attr-defined]
    return (None if late else code), out, err
