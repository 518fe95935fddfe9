"""``cardan accuracy``: what do errors and tolerances do to the output, and which tolerances are the cheapest?"""

from __future__ import annotations

import re
from collections.abc import Sequence
from math import inf
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from cardan.cli.shared.apply import write_changed
from cardan.cli.shared.asked import keys_of
from cardan.cli.shared.options import option
from cardan.cli.shared.output import check_common, check_target
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, read_with_text
from cardan.cli.shared.tell import tell
from cardan.drive.drive import Drive
from cardan.errors import InputError, Problem, check, refuse
from cardan.questions.accuracy.allocation import Allocation, allocate
from cardan.questions.accuracy.answer import answer, answer_of_allocation, ask, otherwise, values_of
from cardan.questions.accuracy.sampling import MonteCarlo
from cardan.questions.accuracy.tolerance import Linear, Method, WorstCase
from cardan.texts import _
from cardan.units import DIMENSIONS

How: TypeAlias = Literal["squares", "worst", "samples"]
What: TypeAlias = Literal["angle", "change"]

MOST_SAMPLES = 10_000_000  # more drives than this are refused: they fill the memory and show nothing that fewer do not


def accuracy(
    file: DriveFile,
    method: Annotated[
        How,
        option(
            "--method", "METHOD", _("How errors add up: root of their squares, worst case, or samples of exact drives.")
        ),
    ] = "squares",
    samples: Annotated[int | None, option("--samples", "N", _("Drives that samples draws: 65536."))] = None,
    seed: Annotated[int | None, option("--seed", "N", _("The same seed draws the same drives: 1."))] = None,
    target: Annotated[
        str | None,
        option(
            "--allocate",
            "TARGET",
            _("Find the cheapest tolerances for this error of the output: 2arcmin, 0.05deg; 0.01mm for its shift."),
        ),
    ] = None,
    of: Annotated[
        What, option("--of", "WHAT", _("What --allocate limits: the angle, or only its change in a turn."))
    ] = "angle",
    keep: Annotated[
        list[str] | None,
        option(
            "--keep",
            "KEY",
            _("Tolerance that --allocate leaves as it is: joints[0].tolerance.alpha4, or alpha4; may be repeated."),
        ),
    ] = None,
    out: Annotated[
        Path | None,
        option("--out -o", "PATH", _("Write what --allocate finds into a copy of FILE, comments kept; may be FILE.")),
    ] = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what errors and tolerances of the joints do to the output, or find the cheapest tolerances."""
    check_common(json=json, csv=csv, plot=plot)
    _check(method, samples, seed, target, of, keep, out)
    goal = None if target is None else goal_of(target)
    drive, text = read_with_text(file)
    if goal is not None:
        allotted = _allotted(drive, goal, of, method, keep or ())
        if out is not None:
            write_changed(drive, text, values_of(allotted), out)
        return tell(answer_of_allocation(drive, allotted, written=out), file, drive, json=json, csv=csv, plot=plot)
    how = _method(method, samples, seed)
    with keys_of(file), watching(_("drawing drives")) as progress:
        found = ask(drive, method=how, progress=progress)
        if found is None:
            raise refuse("joints[0].tolerance", _("missing; {why}").format(why=otherwise(drive)))
    return tell(answer(drive, found), file, drive, json=json, csv=csv, plot=plot)


def _check(
    method: How,
    samples: int | None,
    seed: int | None,
    target: str | None,
    of: What,
    keep: list[str] | None,
    out: Path | None,
) -> None:
    """Refuse options that do not belong together, before any work is done."""
    problems = []
    for name, given in (("--samples", samples), ("--seed", seed)):
        if given is not None and method != "samples":
            problems.append(Problem(name, _("belongs to --method samples")))
    for name, said in (("--of", of != "angle"), ("--keep", bool(keep)), ("--out", out is not None)):
        if said and target is None:
            problems.append(Problem(name, _("belongs to --allocate TARGET")))
    if target is not None and method == "samples":
        problems.append(Problem("--method", _("--allocate adds errors up by squares or worst")))
    if samples is not None and samples > MOST_SAMPLES:
        text = _("{count} drives asked for; the limit is {limit}")
        problems.append(Problem("--samples", text.format(count=samples, limit=MOST_SAMPLES)))
    check(problems)
    if out is not None:
        check_target(out, "--out")


def _method(method: How, samples: int | None, seed: int | None) -> Method:
    if method == "squares":
        return Linear()
    if method == "worst":
        return WorstCase()
    given: dict[str, Any] = {name: value for name, value in (("samples", samples), ("seed", seed)) if value is not None}
    try:
        return MonteCarlo(**given)
    except InputError as error:
        raise error.renamed(lambda field: f"--{field}") from error


def goal_of(text: str) -> tuple[float, bool]:
    """Return an error in SI, and whether it is a length."""
    match = re.fullmatch(r"\s*([-+0-9.eE]+?)\s*([a-z]+|°|′|')?\s*", text)
    word = {"°": "deg", "′": "arcmin", "'": "arcmin"}.get((match[2] or "") if match else "", match[2] if match else "")
    for dimension in ("angle", "length", "displacement"):
        if match and word in DIMENSIONS[dimension]:
            try:
                value = float(match[1])
            except ValueError:
                break
            if not 0.0 < value < inf:
                raise refuse("--allocate", _("{text} is not allowed; the error must be above 0").format(text=text))
            return value * DIMENSIONS[dimension][word], dimension != "angle"
    raise refuse(
        "--allocate", _("not an error with a unit: {text}; write 2arcmin, 0.05deg or 0.01mm").format(text=text)
    )


def _allotted(drive: Drive, goal: tuple[float, bool], of: What, method: How, keep: Sequence[str]) -> Allocation:
    """Return the cheapest tolerances that keep a goal."""
    target, shift = goal
    how = WorstCase() if method == "worst" else Linear()
    kept = _kept(drive, keep)
    try:
        return allocate(drive, target, of="shift" if shift else of, method=how, keep=kept)
    except InputError as error:
        raise error.renamed(lambda field: {"target": "--allocate", "keep": "--keep"}.get(field, field)) from error


def _kept(drive: Drive, keep: Sequence[str]) -> list[str]:
    """Return the paths of the tolerances to be kept; a short name is that of all joints that have it."""
    found = []
    for name in keep:
        if "[" in name:
            found.append(re.sub(r"_(arcmin|deg|rad|mm|m|cm|in|ft|um)$", "", name))
            continue
        short = [
            f"joints[{i}].tolerance.{name}"
            for i, joint in enumerate(drive.joints)
            if joint.tolerance is not None and getattr(joint.tolerance, name, None)
        ]
        if not short:
            raise refuse("--keep", _("no joint has a tolerance {name}").format(name=name))
        found += short
    return found
