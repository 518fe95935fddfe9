"""Entry point of ``cardan``: light enough that even an early ctrl-C finds someone to answer it.

Exit codes: 0 done; 1 a check failed or a result did not converge; 2 bad input or a missing extra; 70 a fault of
cardan itself; 130 interrupted.
"""

from __future__ import annotations

import gc
import gettext
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TextIO

from cardan.errors import refuse
from cardan.later import later
from cardan.texts import DOMAIN, FOLDER, LANGUAGES, _, language, speaking

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
"""cardan solves many small systems: threads of the linear algebra itself cost more than they gain, six times as much
on a machine that is busy. Set before numpy is loaded; what the user says counts."""

SELDOM = 100_000
"""New objects before garbage is looked for: all that loading makes stays."""

app, failure = later("cardan.cli.app"), later("cardan.cli.shared.failure")
"""The parser, and what is said when something goes wrong: they load while an early ctrl-C is answered already."""
limits = later("cardan.reading.limits")
readers = later("cardan.answers.reader")  # in what units and signs the reader is told; the help needs none


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code; nothing escapes as a traceback.

    arguments: what follows ``cardan`` on the command line; that of the process by default.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    gc.set_threshold(SELDOM)
    try:
        with speaking(os.environ.get("CARDAN_LANG", "")):
            asked, rest = _asked(given)
            with speaking(asked or language()), _all_speaking():
                return _read(rest)
    except BaseException as error:
        return int(failure().answer(error, given))


def _read(given: list[str]) -> int:
    """Run one command for the reader that ``--unit`` and ``--decimal`` describe, wherever they, or no limits, stand."""
    end = given.index("--") if "--" in given else len(given)
    if "--no-limits" in given[:end]:
        with _environment({limits().VARIABLE: "1"}):
            return _read([word for word in given[:end] if word != "--no-limits"] + given[end:])
    units, rest = _taken(given, "--unit")
    signs, rest = _taken(rest, "--decimal")
    if not units and not signs:
        return _run(rest)
    with readers().reading(readers().chosen(units, signs[-1] if signs else "")):
        return _run(rest)


def _taken(given: Sequence[str], option: str) -> tuple[list[str], list[str]]:
    """Return the values of an option that every command has, and all else; without a value the parser says so."""
    end = given.index("--") if "--" in given else len(given)
    values, rest, words = [], [], iter(given[:end])
    for word in words:
        if word == option or word.startswith(f"{option}="):
            value = word.removeprefix(f"{option}=") if "=" in word else next(words, None)
            if value is None:
                return [], list(given)
            values.append(value)
        else:
            rest.append(word)
    return values, [*rest, *given[end:]]


def _run(given: list[str]) -> int:
    """Run one command in the language spoken here; help texts are made where modules are loaded, so that comes now."""
    try:
        sys.stdout, sys.stderr = sys.stdout or _nowhere(), sys.stderr or _nowhere()
        for stream in (sys.stdout, sys.stderr):
            if hasattr(stream, "reconfigure"):
                stream.reconfigure(errors="replace")
        code = app().app(given or ["--help"], prog_name="cardan", standalone_mode=False)
        sys.stdout.flush()
    except BaseException as error:
        return int(failure().answer(error, given))
    if code == 130:
        return int(failure().interrupted(given))
    return code if isinstance(code, int) else 0


def _asked(given: Sequence[str]) -> tuple[str, list[str]]:
    """Return the language that ``--lang`` asks for, wherever it stands, empty where it does not; and all else."""
    values, rest = _taken(given, "--lang")
    return ([_known(value) for value in values] or [""])[-1], rest


def _known(given: str) -> str:
    if given in LANGUAGES:
        return given
    text = _("there is no language {given}; there are {known}")
    raise refuse("--lang", text.format(given=repr(given), known=", ".join(LANGUAGES)))


@contextmanager
def _all_speaking() -> Iterator[None]:
    """Let typer, which asks the `gettext` of the process, and processes started from here speak the language too."""
    if language() == "en":
        yield
        return
    domain = gettext.textdomain()
    gettext.bindtextdomain(DOMAIN, str(FOLDER))
    gettext.textdomain(DOMAIN)
    try:
        with _environment(dict.fromkeys(("LANGUAGE", "CARDAN_LANG"), language())):
            yield
    finally:
        gettext.textdomain(domain)


@contextmanager
def _environment(values: Mapping[str, str]) -> Iterator[None]:
    """Set variables of the environment, also for processes started from here; give back the old ones."""
    before = {name: os.environ.get(name) for name in values}
    os.environ.update(values)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


def _nowhere() -> TextIO:
    """Return where a stream writes that the caller closed (``>&-``)."""
    return open(os.devnull, "w", encoding="utf-8")
