"""``cardan rotor``: how does a shaft whirl with its unbalance and a crack: steadily, running up, beside a joint?"""

from __future__ import annotations

from typing import Annotated

from cardan.cli.shared.asked import check_options, keys_of
from cardan.cli.shared.options import flag, option
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, read
from cardan.cli.shared.tell import tell
from cardan.cli.torsion.torsion_parts import Speeds, values
from cardan.errors import InputError, Problem
from cardan.questions.bending.line_answer import answer as answer_of_line
from cardan.questions.bending.line_answer import answer_of_run as answer_of_line_run
from cardan.questions.bending.line_run import line_run
from cardan.questions.bending.line_whirl import line_whirl
from cardan.questions.bending.rotor import DAMPING, joined_rotors, rotor_run
from cardan.questions.bending.rotor_answer import answer, answer_of_joined, answer_of_run, ask
from cardan.texts import _
from cardan.units import rpm

NAMES = {"shaft": "--shaft", "joint": "--joint", "damping_ratio": "--damping", "speed": "--speeds"}
"""What is asked for -> the option that says it."""


def rotor(
    file: DriveFile,
    shaft: Annotated[
        int | None,
        option("--shaft", "N", _("Number of the shaft; the cracked one otherwise, else the one with most unbalance.")),
    ] = None,
    line: Annotated[
        bool,
        flag(
            "--line",
            _("The whole line: all shafts with their unbalances, joint couples, weight and cracks on its supports."),
        ),
    ] = False,
    damping: Annotated[
        float | None,
        option(
            "--damping",
            "ζ",
            _("Damping ratio of the bending; 0.02 of one shaft, loss factors of steel and rubber of the line."),
        ),
    ] = None,
    speeds: Speeds = None,
    run_up: Annotated[bool, flag("--run-up", _("In time, while the speed changes as the run_up of the duty."))] = False,
    joint: Annotated[
        int | None, option("--joint", "N", _("In time, both shafts beside this joint, at one speed."))
    ] = None,
    speed_rpm: Annotated[
        float | None, option("--speed-rpm", "RPM", _("With --joint: the speed, instead of the one in the file."))
    ] = None,
    turns: Annotated[float, option("--turns", "N", _("With --joint: how long, in turns."))] = 40.0,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how a shaft or the whole line whirls: orders over the speed, orbits, where it is unstable."""
    check_options(speed_rpm, json=json, csv=csv, plot=plot)
    problems = []
    if run_up and joint is not None:
        problems.append(Problem("--joint", _("choose --run-up or --joint, not both")))
    if line and (joint is not None or shaft is not None):
        problems.append(Problem("--line", _("goes without --shaft and --joint: it is about all shafts")))
    if run_up and speeds is not None:
        problems.append(Problem("--speeds", _("goes without --run-up, whose speeds are those of duty.run_up")))
    if joint is None and speed_rpm is not None:
        problems.append(Problem("--speed-rpm", _("belongs to --joint; --speeds says a range")))
    if not 1.0 <= turns <= 10_000.0:
        problems.append(Problem("--turns", _("{value} is not allowed; allowed is 1 to 10000").format(value=turns)))
    if problems:
        raise InputError(problems)
    at = None if speeds is None else values(speeds, "--speeds", low=0.0) * rpm
    drive = read(file)
    ratio = DAMPING if damping is None else damping
    with keys_of(file), watching(_("following the shaft")) as progress:
        try:
            if line and run_up:
                said = answer_of_line_run(drive, line_run(drive, damping_ratio=damping, progress=progress))
            elif line:
                whole = line_whirl(drive, speed=at, damping_ratio=damping, progress=progress)
                said = answer_of_line(drive, whole)
            elif joint is not None:
                speed = None if speed_rpm is None else speed_rpm * rpm
                pair = joined_rotors(drive, joint, speed=speed, turns=turns, damping_ratio=ratio, progress=progress)
                said = answer_of_joined(drive, *pair)
            elif run_up:
                run = rotor_run(drive, shaft=shaft, damping_ratio=ratio, progress=progress)
                said = answer_of_run(drive, *run)
            else:
                said = answer(drive, ask(drive, shaft=shaft, speed=at, damping_ratio=ratio, progress=progress))
        except InputError as error:
            raise error.renamed(lambda field: NAMES.get(field, field)) from error
    return tell(said, file, drive, json=json, csv=csv, plot=plot)
