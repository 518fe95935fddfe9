"""``cardan assembly``: does misalignment load the drive?"""

from __future__ import annotations

from cardan.questions.forces.assembly import assembly as question
from cardan.questions.forces.assembly_answer import answer

from .asked import CurveAngle, CurveStep, keys_of
from .motion import check_positions, positions
from .options import AsCsv, AsJson, DriveFile, Plot
from .output import check_common
from .source import read
from .tell import tell


def assembly(
    file: DriveFile,
    angle: CurveAngle = None,
    step: CurveStep = None,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell what misalignment loads, and what to release."""
    check_common(json=json, csv=csv, plot=plot)
    check_positions(angle, step)
    drive = read(file)
    with keys_of(file):
        found = question(drive)
    curves = question(drive, angle=positions(angle, step or 1.0)) if angle or step else None
    return tell(answer(drive, found, curves), file, drive, json=json, csv=csv, plot=plot)
