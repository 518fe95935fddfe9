"""What the command line says when something goes wrong: one message with every problem, on stderr, and a code.

With ``--json`` the message is JSON too, still on stderr, so that stdout holds an answer or nothing:
``{"error": {"message", "problems": [{"field", "message", "code"}], "exit_code"}}``, a code of `cardan.errors.CODES`
where one fits.
"""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import cache
from typing import Any

from cardan.errors import CardanError, InputError, MissingExtraError, Problem
from cardan.files import refusal
from cardan.later import later
from cardan.texts import _, language, mark, plural, visible

words = later("cardan.cli.shared.words")

DONE, FAILED, BAD_INPUT, FAULT, INTERRUPTED = 0, 1, 2, 70, 130  # exit codes
SHOWN = 40  # more problems than this are counted, not listed; ``--json`` lists all


class RefusedError(CardanError):
    """An input error together with the file it is about, or with a headline that names no field."""

    def __init__(self, subject: str, problems: tuple[Problem, ...], *, headline: str = "") -> None:
        self.subject = subject
        self.problems = problems
        self.headline = headline
        super().__init__(subject)


@contextmanager
def about(name: str) -> Iterator[None]:
    """Name the file in whatever is wrong with its content."""
    try:
        yield
    except InputError as error:
        problems = (replace(p, field="" if p.field == name else p.field) for p in error.problems)
        raise RefusedError(name, tuple(problems)) from error
    except OSError as error:
        raise RefusedError(name, (Problem("", reason(error)),)) from error


def reason(error: OSError) -> str:
    """Return why the system refused a file, in its own words, without numbers."""
    return refusal(error).lower()


def answer(error: BaseException, arguments: Sequence[str]) -> int:
    """Say what went wrong and return the exit code.

    arguments: the command line, for ``--json`` and for the hint on help.
    """
    if _reader_gone(error):
        return _closed(DONE)
    if isinstance(error, SystemExit):
        return _closed(error.code if isinstance(error.code, int) else DONE)
    # Python 3.11 wraps what stops it while a class is made.
    if any(isinstance(one, KeyboardInterrupt) for one in (error, error.__cause__)) or type(error).__name__ == "Abort":
        return interrupted(arguments)
    if isinstance(error, RefusedError):
        return _say(error.subject, error.problems, BAD_INPUT, arguments, error.headline)
    if isinstance(error, InputError):
        return _say("", error.problems, BAD_INPUT, arguments)
    if isinstance(error, MissingExtraError):
        return _say("", (Problem("", str(error)),), BAD_INPUT, arguments)
    if isinstance(error, OSError):
        return _say("", (Problem(str(error.filename or _("standard output")), reason(error)),), BAD_INPUT, arguments)
    if hasattr(error, "format_message"):  # a usage error of typer, whichever package it keeps its click in
        return _say("", (Problem("", _usage(error)),), BAD_INPUT, arguments)
    if isinstance(error, MemoryError):
        text = _("not enough memory for this; ask for fewer positions or joints")
        return _say("", (Problem("", text),), BAD_INPUT, arguments)
    if os.environ.get("CARDAN_TRACEBACK"):
        raise error
    text = _("a fault of cardan itself, please report it: {kind}: {text}. CARDAN_TRACEBACK=1 shows where.")
    return _say("", (Problem("", text.format(kind=type(error).__name__, text=error)),), FAULT, arguments)


def interrupted(arguments: Sequence[str]) -> int:
    """Say that the user stopped it; nothing was left half-written."""
    return _say("", (Problem("", _("interrupted; nothing was written")),), INTERRUPTED, arguments)


def _reader_gone(error: BaseException | None) -> bool:
    """Tell whether standard output's reader left (``| head``), however far up that was turned into something else."""
    while error is not None:
        if isinstance(error, BrokenPipeError):
            return True
        error = error.__context__
    return False


def _usage(error: Any) -> str:
    context = getattr(error, "ctx", None)
    command = context.command_path if context is not None else "cardan"
    said = " ".join(str(error.format_message()).split()).replace("Value error, ", "")
    unknown = re.fullmatch(r"No such command '(.*)'\.", said)
    meant = words().commands_for(unknown[1]) if unknown else []
    if unknown and meant:
        said = f"No such command {unknown[1]!r}. Did you mean {', '.join(meant)}?"
    text = reworded(said)
    text = text[:1].lower() + text[1:].rstrip(".")
    return _("{text}; see {command} --help").format(text=text, command=command)


def _say(subject: str, problems: Sequence[Problem], code: int, arguments: Sequence[str], headline: str = "") -> int:
    head = headline or _headline(subject, problems)
    with suppress(OSError, ValueError):
        print(_json(head, subject, problems, code) if "--json" in arguments else _text(head, problems), file=sys.stderr)
    return _closed(code)


def _json(head: str, subject: str, problems: Sequence[Problem], code: int) -> str:
    listed = [{"field": problem.field, "message": problem.message, **_told(problem)} for problem in problems]
    error = {"message": head, "file": subject, "problems": listed, "exit_code": code}
    return json.dumps({"error": error}, ensure_ascii=False)


def _told(problem: Problem) -> dict[str, str]:
    return {key: text for key, text in (("code", problem.code), ("paste", problem.paste)) if text}


def _headline(subject: str, problems: Sequence[Problem]) -> str:
    if len(problems) == 1:
        return f"{subject}: {problems[0]}" if subject else str(problems[0])
    count = plural("{count} problem", "{count} problems", len(problems)).format(count=len(problems))
    return _("{file} has {count}").format(file=subject, count=count) if subject else count


def _text(head: str, problems: Sequence[Problem]) -> str:
    word = _("error:")
    if sys.stderr.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb":
        word = f"\033[1;31m{word}\033[0m"
    lines = [f"{word} {visible(head)}"]
    if len(problems) > 1:
        lines += [f"  {visible(str(problem))}" for problem in problems[:SHOWN]]
        if len(problems) > SHOWN:
            lines.append(_("  … and {count} more; --json lists all").format(count=len(problems) - SHOWN))
    for tables in dict.fromkeys(problem.paste for problem in problems if problem.paste):
        lines += ["", _("These tables in the file would hold it; put the bearings where they are:"), "", tables]
    return "\n".join(lines)


def _closed(code: int) -> int:
    """Leave no write for the interpreter to fail at: a reader that has gone (``| head``) is no error."""
    try:
        sys.stdout.flush()
    except (OSError, ValueError):
        with suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


# The sentences of typer, in our language: it says most of them in English only, however it is asked.

HELP = (
    mark("Usage:"),
    mark("[OPTIONS]"),
    mark("COMMAND [ARGS]..."),
    mark("Arguments"),
    mark("Options"),
    mark("Commands"),
    mark("Error"),
    mark("Aborted."),
    mark("(deprecated) "),
    mark("(dynamic)"),
    mark("[default: {}]"),
    mark("[env var: {}]"),
    mark("[required]"),
    mark("default: {default}"),
    mark("env var: {var}"),
    mark("required"),
    mark("Show this message and exit."),
    mark("Install completion for the current shell."),
    mark("Show completion for the current shell, to copy it or customize the installation."),
    mark("Install completion for the specified shell."),
    mark("Show completion for the specified shell, to copy it or customize the installation."),
)
"""What its help says; it asks `gettext` for these, or `cardan.cli.app` does."""

ERRORS = (
    mark("Missing command."),
    mark("Missing argument {name}. {why}"),
    mark("Missing argument {name}."),
    mark("Missing option {name}. {why}"),
    mark("Missing option {name}."),
    mark("No such command {name}. Did you mean {names}?"),
    mark("No such command {name}."),
    mark("No such option: {name} (Possible options: {names})"),
    mark("No such option: {name}"),
    mark("Got unexpected extra argument(s) ({names})"),
    mark("Option {name} requires an argument."),
    mark("Option {name} requires {count} arguments."),
    mark("Option {name} does not take a value."),
    mark("Argument {name} takes {count} values."),
    mark("Invalid value for {name}: {why}"),
    mark("Invalid value: {why}"),
    mark("Choose from: {names}"),
    mark("{given} is not one of {names}."),
    mark("Value {given} is not a valid {name}."),
    mark("Value must be an iterable."),
    mark("{name} {given} does not exist."),
    mark("{name} {given} is a file."),
    mark("{name} {given} is a directory."),
    mark("{name} {given} is not readable."),
    mark("{name} {given} is not writable."),
    mark("Input should be a valid number, unable to parse string as a number"),
    mark("Input should be a valid integer, unable to parse string as an integer"),
    mark("Input should be a valid boolean, unable to interpret input"),
    mark("Input should be a finite number"),
    mark("Input should be greater than or equal to {limit}"),
    mark("Input should be greater than {limit}"),
    mark("Input should be less than or equal to {limit}"),
    mark("Input should be less than {limit}"),
)
"""What it says when it cannot read a command line; the first that fits counts."""


def reworded(text: str) -> str:
    """Return a sentence of typer in the language spoken here, as it is where it is not known."""
    if language() == "en":
        return text
    for sentence in ERRORS:
        found = _pattern(sentence).fullmatch(text)
        if found:
            parts = {name: reworded(part) if name == "why" else part for name, part in found.groupdict().items()}
            return _(sentence).format(**parts)
    return text


@cache
def _pattern(sentence: str) -> re.Pattern[str]:
    """Return what matches a sentence with anything in its named places, with or without its last full stop."""
    pieces = re.split(r"\{(\w+)\}", sentence.removesuffix("."))
    return re.compile("".join(f"(?P<{p}>.+?)" if k % 2 else re.escape(p) for k, p in enumerate(pieces)) + r"\.?")
