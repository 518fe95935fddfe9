"""``cardan field-balance``: which masses balance a shaft in its drive, by runs with trial masses?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import numpy as np

from cardan.cli.shared.options import argument, option
from cardan.cli.shared.output import check_common
from cardan.cli.shared.progress import watching
from cardan.cli.shared.recording import Pulses, Rate, Reading, Tacho, Titles, recorded
from cardan.cli.shared.source import AsCsv, AsJson
from cardan.cli.shared.tell import tell
from cardan.errors import InputError, Problem
from cardan.questions.diagnosis.field_balance import field_balance as balanced
from cardan.questions.diagnosis.field_balance import readings_of
from cardan.questions.diagnosis.field_balance_answer import answer
from cardan.texts import _
from cardan.units import deg, mm

NAMES = {"trials": "--trial", "readings": "--trial", "runs": "--trial", "tacho": "--tacho"}
"""What is asked for -> the option that says it."""

GMM = 1e-6
"""1 g mm [kg m]."""


def field_balance(
    first: Annotated[Path, argument("SIGNAL", _("Recording of the run without trial masses."))],
    trial: Annotated[
        list[str],
        option(
            "--trial",
            "SIGNAL=MM,G_MM,DEG",
            _("Run with a trial mass: place in mm, unbalance in g·mm, angle from the mark in °; once for each mass."),
        ),
    ],
    radius_mm: Annotated[float | None, option("--radius-mm", "MM", _("Radius at which the masses go."))] = None,
    tacho: Tacho = None,
    pulses_per_turn: Pulses = 1.0,
    rate: Rate = None,
    title: Titles = None,
    json: AsJson = False,
    csv: AsCsv = False,
) -> int:
    """Tell which masses balance a shaft where it runs, by influence coefficients; the joints' orders are told apart."""
    check_common(json=json, csv=csv)
    runs, planes, added = _trials(trial)
    if radius_mm is not None and not 0.0 < radius_mm < np.inf:
        raise InputError([Problem("--radius-mm", _("{value} is not above 0").format(value=radius_mm), "not_positive")])
    how = Reading(tacho=tacho, pulses_per_turn=pulses_per_turn, rate=rate, titles=tuple(title or ()))
    with watching(_("reading the runs")) as progress:
        signals = [recorded(path, how) for path in (first, *runs)]
        try:
            readings = readings_of(signals, progress)
            result = balanced(readings.value[:, :, 0], added)
        except InputError as error:
            raise error.renamed(lambda field: NAMES.get(field, field)) from error
    return tell(answer(result, readings, planes, None if radius_mm is None else radius_mm * mm), json=json, csv=csv)


def _trials(given: list[str]) -> tuple[list[Path], list[float], np.ndarray]:
    """Return the runs, the places of the planes [m] and the unbalance of each run in each plane [kg m]."""
    masses, problems = [], []
    for one in given:
        name, _sign, values = one.rpartition("=")
        try:
            place, size, angle = (float(part) for part in values.split(","))
        except ValueError:
            text = _("{text} is not SIGNAL=MM,G_MM,DEG, as run1.csv=60,250,90")
            problems.append(Problem("--trial", text.format(text=repr(one)), "wrong_type"))
            continue
        if not name or not np.isfinite([place, size, angle]).all() or size <= 0.0:
            text = _("{text} needs a recording, a place, an unbalance above 0 and an angle")
            problems.append(Problem("--trial", text.format(text=repr(one)), "out_of_range"))
        masses.append((Path(name), place * mm, size * GMM * np.exp(1j * angle * deg)))
    if problems:
        raise InputError(problems)
    runs = list(dict.fromkeys(path for path, *_rest in masses))
    planes = sorted({place for _path, place, _vector in masses})
    added = np.zeros((len(runs), len(planes)), dtype=complex)
    for path, place, vector in masses:
        added[runs.index(path), planes.index(place)] += vector
    return runs, planes, added
