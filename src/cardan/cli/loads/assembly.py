"""``cardan assembly``: does misalignment load the drive?"""

from __future__ import annotations

from cardan.cli.motion.motion import check_positions, positions
from cardan.cli.shared.asked import CurveAngle, CurveStep, keys_of
from cardan.cli.shared.output import check_common
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, read
from cardan.cli.shared.tell import tell
from cardan.questions.forces.assembly import assembly as question
from cardan.questions.forces.assembly_answer import answer


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
