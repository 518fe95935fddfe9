"""The sentences of typer, in our language: it says most of them in English only, however it is asked."""

from __future__ import annotations

import re
from functools import cache

from cardan.texts import _, language, mark

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
"""What its help says; it asks `gettext` for these, or `cardan.cli.lazy` does."""

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
    """Return a sentence of typer in the language spoken here, as it is where it is not known.

    >>> reworded("No such option: --bogus")
    'No such option: --bogus'
    """
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
