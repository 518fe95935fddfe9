"""What ``cardan torsion absorber`` and ``optimise`` share: the band, what is judged, and writing the better drive."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, TypeAlias

from cardan.answers.answer import FILE, Answer, Remark
from cardan.cli.shared.apply import check_copy, is_json
from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.options import option
from cardan.cli.shared.output import write_text
from cardan.cli.shared.source import form_of
from cardan.drive.drive import Drive
from cardan.errors import InputError, refuse
from cardan.io import dumps, loads
from cardan.texts import _
from cardan.units import rpm

from .torsion_parts import values

SpeedBand: TypeAlias = Annotated[
    str | None,
    option("--speeds", "LOW:HIGH", _("Band of input speeds in rpm, instead of the speed_range of the file.")),
]
Element: TypeAlias = Annotated[
    list[int] | None,
    option("--element", "N", _("Judge the torque of this element only, from 1; may be repeated. All by default.")),
]
Out: TypeAlias = Annotated[
    Path | None,
    option("--out -o", "PATH", _("Write the better drive into a copy of FILE, comments kept; may be FILE.")),
]


def band_of(text: str | None) -> tuple[float, float] | None:
    """Return a band of speeds [rad/s] of LOW:HIGH in rpm."""
    if text is None:
        return None
    if text.count(":") != 1:
        raise refuse("--speeds", _("not a band of speeds: {text}; write LOW:HIGH").format(text=text))
    ends = values(text, "--speeds", count=2, low=0.0)
    return float(ends[0]) * rpm, float(ends[-1]) * rpm


def elements_of(numbers: Sequence[int] | None) -> list[int] | None:
    """Return elements counted from 0 of those counted from 1; refuse numbers below."""
    if not numbers:
        return None
    if min(numbers) < 1:
        raise refuse("--element", _("{given} given; elements count from 1").format(given=min(numbers)))
    return [one - 1 for one in numbers]


def repeated(single: Mapping[str, Any], many: Mapping[str, Sequence[Any] | None]) -> tuple[str, ...]:
    """Return options as they were given, to be typed again."""
    words: list[str] = []
    for name, value in single.items():
        words += [] if value is None else [name, f"{value:g}" if isinstance(value, float) else str(value)]
    for name, several in many.items():
        for value in several or ():
            words += [name, str(value)]
    return tuple(words)


def check_out(out: Path | None, file: Path, *, force: bool) -> None:
    """Refuse a file that cannot be written, before any work is done."""
    if out is not None:
        check_copy(out, file, force=force)


@contextmanager
def asked_of(file: Path, options: Mapping[str, str]) -> Iterator[None]:
    """Name the options of the command, and else the file and its keys, in whatever an answer refuses or misses."""
    try:
        yield
    except InputError as error:
        named = InputError(replace(one, field=options.get(one.field, one.field)) for one in error.problems)
        if all(one.field in options for one in error.problems):
            raise named from error
        with keys_of(file):
            raise named from error


def stepped(said: Answer, words: Sequence[str], given: Sequence[str], out: Path | None) -> Answer:
    """Return an answer with what to do next: have the better drive written, or look at the one that was.

    words, given: the command and its options, to be typed again; out: where the better drive was written.
    """
    if out is None:
        text, command = (
            _("Write the better drive into a copy of the file:"),
            ("cardan", *words, FILE, *given, "-o", "better.toml"),
        )
        return replace(said, remarks=(*said.remarks, Remark(text=text, command=command, tone="next")))
    done = Remark(text=_("{path}: written.").format(path=out), tone="good")
    look = ("cardan", "torsion", "response", str(out))
    step = Remark(text=_("See how it vibrates now:"), command=look, tone="next")
    return replace(said, remarks=(*said.remarks, done, step), facts={**said.facts, "written": str(out)})


def written(file: Path, text: str, out: Path, edited: Callable[[], str], better: Drive) -> None:
    """Write a better drive. out: where to write it, TOML or JSON; edited: makes the new text of a TOML file."""
    if is_json(out, text):
        asked = loads(text, form=form_of(file, text), folder=file.parent).duty  # not the one of the command line
        content = dumps(replace(better, duty=asked), form="json" if out.suffix.lower() == ".json" else "toml")
    else:
        content = edited()
    write_text(out, content, "--out")
