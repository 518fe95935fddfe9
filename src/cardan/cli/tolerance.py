"""``cardan tolerance``: what do machining tolerances do to the output, and which are the cheapest?"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, TypeAlias

import typer

from cardan.texts import _

from .options import AsCsv, AsJson, DriveFile, Plot

if TYPE_CHECKING:
    from cardan.questions.accuracy.tolerance import Method

How: TypeAlias = Literal["squares", "worst", "samples"]
What: TypeAlias = Literal["angle", "change"]

MOST_SAMPLES = 10_000_000
"""More drives than this are refused: they fill the memory and show nothing that fewer do not."""


def tolerance(
    file: DriveFile,
    method: Annotated[
        How,
        typer.Option(
            "--method",
            metavar="METHOD",
            help=_("How errors add up: root of their squares, worst case, or samples of exact drives."),
        ),
    ] = "squares",
    samples: Annotated[
        int | None,
        typer.Option("--samples", metavar="N", help=_("Drives that samples draws: 65536."), show_default=False),
    ] = None,
    seed: Annotated[
        int | None,
        typer.Option("--seed", metavar="N", help=_("The same seed draws the same drives: 1."), show_default=False),
    ] = None,
    allocate: Annotated[
        str | None,
        typer.Option(
            "--allocate",
            metavar="TARGET",
            help=_(
                "Find the cheapest tolerances for this error of the output: 2arcmin, 0.05deg; 0.01mm for its shift."
            ),
            show_default=False,
        ),
    ] = None,
    of: Annotated[
        What,
        typer.Option(
            "--of", metavar="WHAT", help=_("What --allocate limits: the angle, or only its change in a turn.")
        ),
    ] = "angle",
    keep: Annotated[
        list[str] | None,
        typer.Option(
            "--keep",
            metavar="KEY",
            help=_(
                "Tolerance that --allocate leaves as it is: joints[0].tolerance.alpha4, or alpha4; may be repeated."
            ),
            show_default=False,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="PATH",
            help=_("Write what --allocate finds into a copy of FILE, comments kept; may be FILE."),
            show_default=False,
        ),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what machining tolerances do to the output, or find the cheapest ones."""
    from .show import check_common, show

    check_common(json=json, csv=csv, plot=plot)
    _check(method, samples, seed, allocate, of, keep, out)

    from .asked import keys_of
    from .source import read_with_text

    if allocate is not None:
        from .allocating import answer as allotted
        from .allocating import target

        limit, shift = target(allocate)
        drive, text = read_with_text(file)
        found = allotted(
            drive,
            file,
            text,
            target=limit,
            of="shift" if shift else of,
            worst=method == "worst",
            keep=keep or (),
            out=out,
        )
        return show(found, json=json, csv=csv, plot=plot)

    from cardan.questions.accuracy.tolerance import tolerance as question

    from .progress import watching
    from .tolerance_answer import answer

    drive, _text = read_with_text(file)
    how = _method(method, samples, seed)
    with keys_of(file), watching(_("drawing drives")) as progress:
        band = question(drive, method=how, progress=progress)
    return show(answer(drive, file, band), json=json, csv=csv, plot=plot)


def _check(
    method: How,
    samples: int | None,
    seed: int | None,
    allocate: str | None,
    of: What,
    keep: list[str] | None,
    out: Path | None,
) -> None:
    """Refuse options that do not belong together, before any work is done."""
    from cardan.errors import Problem, check

    from .output import check_target

    problems = []
    for option, given in (("--samples", samples), ("--seed", seed)):
        if given is not None and method != "samples":
            problems.append(Problem(option, _("belongs to --method samples")))
    for option, said in (("--of", of != "angle"), ("--keep", bool(keep)), ("--out", out is not None)):
        if said and allocate is None:
            problems.append(Problem(option, _("belongs to --allocate TARGET")))
    if allocate is not None and method == "samples":
        problems.append(Problem("--method", _("--allocate adds errors up by squares or worst")))
    if samples is not None and samples > MOST_SAMPLES:
        text = _("{count} drives asked for; the limit is {limit}")
        problems.append(Problem("--samples", text.format(count=samples, limit=MOST_SAMPLES)))
    check(problems)
    if out is not None:
        check_target(out, "--out")


def _method(method: How, samples: int | None, seed: int | None) -> Method:
    from cardan.errors import InputError
    from cardan.questions.accuracy.sampling import MonteCarlo
    from cardan.questions.accuracy.tolerance import Linear, WorstCase

    if method == "squares":
        return Linear()
    if method == "worst":
        return WorstCase()
    given: dict[str, Any] = {name: value for name, value in (("samples", samples), ("seed", seed)) if value is not None}
    try:
        return MonteCarlo(**given)
    except InputError as error:
        raise error.renamed(lambda field: f"--{field}") from error
