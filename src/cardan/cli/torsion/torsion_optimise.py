"""``cardan torsion optimise``: with which values of the drive is its torsional vibration least?"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated

from cardan.catalogue import known_to
from cardan.choices.torsion_design import answer, optimise_torsion
from cardan.cli.shared.asked import TorqueNm, check_options, on_duty
from cardan.cli.shared.options import option
from cardan.cli.shared.progress import ended, keeping
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Force, Plot, SpeedRpm, read_with_text
from cardan.cli.shared.tell import tell
from cardan.errors import Problem, check
from cardan.io.edit import edit
from cardan.maths.curves.search import Evolution
from cardan.questions.torsion.optimise.optimise import Grid
from cardan.texts import _

from .torsion_band import Element, Out, SpeedBand, asked_of, band_of, check_out, elements_of, repeated, stepped, written

ROUNDS = 40  # generations of a search

OPTIONS = {
    "free": "--free",
    "speeds": "--speeds",
    "elements": "--element",
    "method.points": "--grid",
    "tolerances": "--tolerance",
}
"""What the question calls by another name than the command."""


def torsion_optimise(
    file: DriveFile,
    free: Annotated[
        list[str] | None,
        option(
            "--free",
            "PATH=LOW:HIGH[:STEP]",
            _("Key of the file that may change, as shafts[1].yoke_angle_deg; may be repeated. Yokes by default."),
        ),
    ] = None,
    tolerance: Annotated[
        list[str] | None,
        option(
            "--tolerance",
            "PATH=SIZE",
            _("How far a key may be off to either side, as shafts[1].stiffness_Nm_per_rad=5%; may be repeated."),
        ),
    ] = None,
    speeds: SpeedBand = None,
    element: Element = None,
    grid: Annotated[
        int | None, option("--grid", "N", _("Try every combination of N values of each key instead of evolution."))
    ] = None,
    rounds: Annotated[int, option("--rounds", "N", _("Generations of the search at most."), min=1)] = ROUNDS,
    seed: Annotated[int, option("--seed", "N", _("Random seed."), min=0)] = 0,
    speed_rpm: SpeedRpm = None,
    torque: TorqueNm = None,
    out: Out = None,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell the yokes, stiffnesses, inertias or joint positions with the least alternating torque over the speeds."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    check_out(out, file, force=force)
    band, ranges, off = band_of(speeds), ranges_of(free or []), sizes_of(tolerance or [])
    drive, text = read_with_text(file)
    drive = on_duty(drive, speed_rpm, torque)
    known = known_to(drive, file.parent) if drive.settings.catalogues else None
    method = Evolution(rounds=rounds, seed=seed) if grid is None else Grid(points=grid)
    with asked_of(file, OPTIONS), keeping(_("searching designs")) as progress:
        found = optimise_torsion(
            drive,
            free=ranges,
            speeds=band,
            elements=elements_of(element),
            method=method,
            tolerances=off or None,
            known=known,
            progress=progress,
        )
    if out is not None:
        changed = {one.path: found.values[one.path] for one in found.free if found.values[one.path] != one.built}
        written(file, text, out, lambda: edit(text, changed, folder=file.parent) if changed else text, found.drive)
    given: dict[str, object] = {"--speeds": speeds, "--grid": grid, "--rounds": None if rounds == ROUNDS else rounds}
    given |= {"--seed": seed or None, "--speed-rpm": speed_rpm, "--torque-Nm": torque}
    options = repeated(given, {"--free": free, "--tolerance": tolerance, "--element": element})
    said = stepped(answer(drive, found), ("torsion", "optimise"), options, out)
    return ended(tell(said, file, drive, json=json, csv=csv, plot=plot), progress)


def sizes_of(texts: Sequence[str]) -> dict[str, float | str]:
    """Return path -> size of PATH=SIZE."""
    found: dict[str, float | str] = {}
    problems = []
    for text in texts:
        path, equals, rest = text.partition("=")
        if not equals or not rest.strip():
            problems.append(Problem("--tolerance", _("not PATH=SIZE: {text}").format(text=text)))
        elif path in found:
            problems.append(Problem("--tolerance", _("{path} is given twice").format(path=path)))
        found[path] = rest
    check(problems)
    return found


def ranges_of(texts: Sequence[str]) -> dict[str, tuple[float, ...]] | None:
    """Return path -> range of PATH=LOW:HIGH[:STEP], None where nothing is given."""
    found: dict[str, tuple[float, ...]] = {}
    problems = []
    for text in texts:
        path, _equals, rest = text.partition("=")
        try:
            values = tuple(float(one) for one in rest.split(":"))
        except ValueError:
            values = ()
        if len(values) not in (2, 3):
            problems.append(Problem("--free", _("not PATH=LOW:HIGH[:STEP]: {text}").format(text=text)))
        elif path in found:
            problems.append(Problem("--free", _("{path} is given twice").format(path=path)))
        found[path] = values
    check(problems)
    return found or None
