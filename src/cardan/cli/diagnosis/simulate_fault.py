"""``cardan simulate-fault``: what should a fault of this drive show, and a recording of it to try things on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

from cardan.cli.shared.options import argument, flag, option
from cardan.cli.shared.output import check_common, check_new
from cardan.cli.shared.progress import watching
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Force, Plot, read
from cardan.cli.shared.tell import tell
from cardan.errors import InputError, Problem
from cardan.io.saving import save
from cardan.io.signals import WRITERS
from cardan.questions.diagnosis.expected import FAULTS, expected_orders
from cardan.questions.diagnosis.fault_answer import answer, answer_of_list
from cardan.questions.diagnosis.simulate import TestSchedule
from cardan.questions.diagnosis.simulate import simulate_fault as simulated
from cardan.texts import _
from cardan.units import nearest, rpm

NAMES = {
    "runs.run_up": "--run-up-s", "runs.hold": "--hold-s", "runs.rate": "--rate-hz", "runs.held": "--steady-rpm",
    "fault": "FAULT", "severity": "--severity", "shaft": "--shaft", "snr": "--snr-db",
}  # fmt: skip
"""What is asked for -> the option that says it."""


def simulate_fault(
    file: DriveFile,
    fault: Annotated[str | None, argument("FAULT", _("Name of the fault, see --list."))] = None,
    listed: Annotated[bool, flag("--list", _("List the faults, and do nothing else."))] = False,
    out: Annotated[
        Path | None,
        option("--out -o", "PATH", _("Write a recording of it into PATH: .csv, .wav, .uff, .unv or .tdms.")),
    ] = None,
    severity: Annotated[float, option("--severity", "X", _("Fault severity; 1 = typical."))] = 1.0,
    shaft: Annotated[int | None, option("--shaft", "N", _("Shaft with the fault; the heaviest otherwise."))] = None,
    snr: Annotated[float, option("--snr-db", "DB", _("Signal-to-noise ratio in decibels."))] = 10.0,
    seed: Annotated[int, option("--seed", "N", _("Random seed."))] = 0,
    run_up: Annotated[float, option("--run-up-s", "S", _("Time to run up from the lowest to the top speed."))] = 10.0,
    hold: Annotated[float, option("--hold-s", "S", _("Time at each of two torques."))] = 4.0,
    steady: Annotated[
        float | None, option("--steady-rpm", "RPM", _("Do not run up: keep this speed at both torques."))
    ] = None,
    rate: Annotated[float, option("--rate-hz", "HZ", _("Values a second."))] = 2048.0,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what a fault of the drive should show at its bearings, and write a recording of it."""
    check_common(json=json, csv=csv, plot=plot)
    if listed:
        return tell(answer_of_list(), json=json, csv=csv)
    problems = list(_refused(fault, out, seed, run_up))
    if problems or fault is None:
        raise InputError(problems)
    if out is not None:
        check_new(out, force=force, field="--out")
    drive = read(file)
    made = None
    with watching(_("making the recording")):
        try:
            found = expected_orders(drive, fault, severity=severity, shaft=shaft)
            if out is not None:
                runs = TestSchedule(run_up=run_up, hold=hold, rate=rate)
                if steady is not None:
                    runs = TestSchedule(run_up=0.0, hold=hold, rate=rate, held=steady * rpm / found.speed[1])
                made = simulated(drive, fault, severity=severity, seed=seed, snr=snr, runs=runs, shaft=shaft)
        except InputError as error:
            raise error.renamed(lambda field: NAMES.get(field, field)) from error
        if made is not None and out is not None:
            save(made, out)
    return tell(answer(found, made, out), file, drive, json=json, csv=csv, plot=plot)


def _refused(fault: str | None, out: Path | None, seed: int, run_up: float) -> Iterator[Problem]:
    """Yield what is wrong with the options before anything is read."""
    if fault is None:
        text = _("missing: one of {choices}; --list says what they are")
        yield Problem("FAULT", text.format(choices=", ".join(FAULTS)), "missing")
    elif fault not in FAULTS:
        near = nearest(fault, FAULTS)
        text = _("{value} is none of {choices}").format(value=repr(fault), choices=", ".join(FAULTS))
        yield Problem("FAULT", text + (_("; the nearest is {near}").format(near=near) if near else ""), "out_of_range")
    if out is not None and out.suffix.lower() not in WRITERS:
        text = _("{path} should end in one of {known}")
        yield Problem("--out", text.format(path=out, known=", ".join(WRITERS)), "unknown_kind")
    if seed < 0:
        yield Problem("--seed", _("{value} is negative").format(value=seed), "negative")
    if run_up == 0.0:
        yield Problem("--run-up-s", _("0 is not a run-up; --steady-rpm keeps one speed"), "not_positive")
