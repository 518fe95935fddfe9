"""What ``cardan torsion absorber`` and ``calm`` share: the band, what is judged, and writing the better drive."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from cardan.texts import _

if TYPE_CHECKING:
    from cardan.drive.drive import Drive

    from .answer import Answer, Remark

SpeedBand: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--speeds",
        metavar="LOW:HIGH",
        help=_("Band of input speeds [rpm], instead of the speed_range of the file."),
        show_default=False,
    ),
]
Element: TypeAlias = Annotated[
    list[int] | None,
    typer.Option(
        "--element",
        metavar="N",
        help=_("Judge the torque of this element only, from 1; may be repeated. All by default."),
        show_default=False,
    ),
]
Out: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "--out",
        "-o",
        metavar="PATH",
        help=_("Write the better drive into a copy of FILE, comments kept; may be FILE."),
        show_default=False,
    ),
]


def band_of(text: str | None) -> tuple[float, float] | None:
    """Return a band of speeds [rad/s] of LOW:HIGH in rpm.

    Examples
    --------
    >>> [round(one, 3) for one in band_of("300:600")]
    [31.416, 62.832]
    """
    from cardan.errors import refuse
    from cardan.units import rpm

    from .torsion_parts import values

    if text is None:
        return None
    if text.count(":") != 1:
        raise refuse("--speeds", _("{text} is no band; write LOW:HIGH").format(text=text))
    ends = values(text, "--speeds", count=2, low=0.0)
    return float(ends[0]) * rpm, float(ends[-1]) * rpm


def elements_of(numbers: Sequence[int] | None) -> list[int] | None:
    """Return elements counted from 0 of those counted from 1; refuse numbers below."""
    from cardan.errors import refuse

    if not numbers:
        return None
    if min(numbers) < 1:
        raise refuse("--element", _("{given} given; elements count from 1").format(given=min(numbers)))
    return [one - 1 for one in numbers]


def repeated(single: Mapping[str, Any], many: Mapping[str, Sequence[Any] | None]) -> tuple[str, ...]:
    """Return options as they were given, to be typed again.

    Examples
    --------
    >>> repeated({"--kind": "tuned", "--mode": None}, {"--element": [1, 2]})
    ('--kind', 'tuned', '--element', '1', '--element', '2')
    """
    words: list[str] = []
    for option, value in single.items():
        words += [] if value is None else [option, f"{value:g}" if isinstance(value, float) else str(value)]
    for option, values in many.items():
        for value in values or ():
            words += [option, str(value)]
    return tuple(words)


def check_out(out: Path | None, file: Path, *, force: bool) -> None:
    """Refuse a file that cannot be written, before any work is done."""
    from .apply import check_copy

    if out is not None:
        check_copy(out, file, force=force)


@contextmanager
def asked_of(file: Path, options: Mapping[str, str]) -> Iterator[None]:
    """Name the options of the command, and else the file and its keys, in whatever an answer refuses or misses."""
    from cardan.errors import InputError, Problem

    from .asked import keys_of

    try:
        yield
    except InputError as error:
        named = InputError(Problem(options.get(one.field, one.field), one.message) for one in error.problems)
        if all(one.field in options for one in error.problems):
            raise named from error
        with keys_of(file):
            raise named from error


def band_remarks(found: Any) -> Iterator[Remark]:
    """Yield what an absorber and a calm design have to say alike: stability, lost motions, play, a stop, assumptions.

    Parameters
    ----------
    found : Absorber or Calm
    """
    import numpy as np

    from cardan.units import rpm

    from .answer import Remark, significant

    lost = int(np.sum(~np.isfinite(found.after).all(axis=-1)))
    if lost:
        text = _(
            "Warning: at {lost} of {count} speeds no steady motion was found; they do not count in the largest swing."
        )
        yield Remark(text=text.format(lost=lost, count=len(found.after)), tone="warning")
    if len(found.unstable_after):
        text = _("Warning: near {speeds} rpm vibration grows by itself: see cardan torsion stability.")
        said = ", ".join(significant(float(one) / rpm, 3) for one in found.unstable_after[:4])
        yield Remark(text=text.format(speeds=said), tone="warning")
    elif len(found.unstable_before):
        yield Remark(text=_("As the drive is, vibration grows by itself at some speeds; now it does not."), tone="good")
    if found.play:
        text = _("Play counts as closed here; cardan torsion response tells whether the torque changes its sign.")
        yield Remark(text=text, tone="warning")
    if found.cancelled:
        yield Remark(text=_("Warning: the search was stopped; this is the best so far."), tone="warning")
    elif not found.converged:
        yield Remark(text=_("Warning: the search had not come to its end; this is the best so far."), tone="warning")
    undamped = [path for path in found.assumed if path.endswith(".damping")]
    if undamped:
        text = _("Assumed: nothing damps {paths}; give damping or loss_factor, for peaks live by it.")
        yield Remark(text=text.format(paths=", ".join(path.removesuffix(".damping") for path in undamped)))


def written(said: Answer, file: Path, text: str, out: Path, edited: Callable[[], str], better: Drive) -> Answer:
    """Write a better drive and return the answer with a word on it.

    Parameters
    ----------
    said : Answer
        What was found; its last remark asks to write it.
    file : path
    text : str
        The file.
    out : path
        Where to write it, TOML or JSON.
    edited : callable
        Makes the new text of a TOML file.
    better : Drive
        What it is to hold.
    """
    from cardan.io import dumps, loads

    from .answer import Remark
    from .output import write_text
    from .source import form_of

    if out.suffix.lower() == ".json" or text.lstrip().startswith("{"):
        asked = loads(text, form=form_of(file, text), folder=file.parent).duty  # not the one of the command line
        content = dumps(replace(better, duty=asked), form="json" if out.suffix.lower() == ".json" else "toml")
    else:
        content = edited()
    write_text(out, content, "--out")
    done = Remark(text=_("{path}: written.").format(path=out), tone="good")
    step = Remark(text=_("See how it vibrates now:"), command=("cardan", "torsion", "response", str(out)), tone="next")
    kept = [one for one in said.remarks if one.tone != "next"]
    content_of = said.content
    return replace(said, remarks=(*kept, done, step), content=lambda: {**content_of(), "written": str(out)})
