"""Entry point of ``cardan``: light enough that even an early ctrl-C finds someone to answer it.

Exit codes: 0 done; 1 a check failed or a result did not converge; 2 bad input or a missing extra; 70 a fault of
cardan itself; 130 interrupted.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import TextIO


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; nothing escapes as a traceback.

    Parameters
    ----------
    arguments : sequence of str, optional
        What follows ``cardan`` on the command line; that of the process by default.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        sys.stdout, sys.stderr = sys.stdout or _nowhere(), sys.stderr or _nowhere()
        from .app import app

        for stream in (sys.stdout, sys.stderr):
            if hasattr(stream, "reconfigure"):
                stream.reconfigure(errors="replace")
        code = app(given or ["--help"], prog_name="cardan", standalone_mode=False)
        sys.stdout.flush()
    except BaseException as error:
        from .failure import answer

        return answer(error, given)
    if code == 130:
        from .failure import interrupted

        return interrupted(given)
    return code if isinstance(code, int) else 0


def _nowhere() -> TextIO:
    """Return where a stream writes that the caller closed (``>&-``)."""
    return open(os.devnull, "w", encoding="utf-8")
