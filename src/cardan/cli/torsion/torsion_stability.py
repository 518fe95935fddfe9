"""``cardan torsion stability``: does torsional vibration decay, at a speed or over a map?"""

from __future__ import annotations

from typing import Annotated, Any

from cardan.cli.shared.asked import check_options, keys_of
from cardan.cli.shared.options import option
from cardan.cli.shared.progress import ended, keeping
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.errors import refuse
from cardan.questions.gathering import principal
from cardan.questions.torsion.stability.answer import answer
from cardan.questions.torsion.stability.torsion_stability import stability as question
from cardan.register import QUESTIONS
from cardan.texts import _

from .torsion_parts import Pieces, Speeds, at_speed, values

ALONE, ACROSS, UP = 201, 61, 31
"""Values along the axis of a map where no number is given: of the only one, of the speed beside another, of others."""


def torsion_stability(
    file: DriveFile,
    speed_rpm: SpeedRpm = None,
    speeds: Speeds = None,
    joint_angles: Annotated[
        str | None,
        option(
            "--joint-angles",
            "LOW:HIGH[:COUNT]",
            _("Joint angle of the joint with the largest, in degrees; the others in proportion."),
        ),
    ] = None,
    over: Annotated[
        list[str] | None,
        option(
            "--over",
            "PATH=LOW:HIGH[:COUNT]",
            _("Any key of the file, as shafts[1].damping_Nms_per_rad; may be repeated."),
        ),
    ] = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell whether torsional vibration decays, and how fast."""
    check_options(speed_rpm, json=json, csv=csv, plot=plot)
    axes = _axes(speeds, joint_angles, over or [])
    whole = at_speed(read(file), speed_rpm)
    drive = principal(QUESTIONS["stability"], whole)
    with keys_of(file), keeping(_("judging steady motions")) as progress:
        found = question(drive, over=axes, pieces=pieces, progress=progress)
    said = answer(drive, found, signs=True)
    return ended(tell(said, file, drive, whole=whole, json=json, csv=csv, plot=plot), progress)


def _axes(speeds: str | None, joint_angles: str | None, over: list[str]) -> dict[str, Any]:
    """Return the paths of a map with their values."""
    several = sum(one is not None for one in (speeds, joint_angles)) + len(over) > 1
    across, up = (ACROSS, UP) if several else (ALONE, ALONE)
    axes: dict[str, Any] = {}
    if speeds is not None:
        axes["duty.speed_rpm"] = values(speeds, "--speeds", count=across, low=0.0)
    if joint_angles is not None:
        axes["joint_angle_deg"] = values(joint_angles, "--joint-angles", count=up)
    for one in over:
        path, equals, text = one.partition("=")
        if not equals:
            raise refuse("--over", _("{text} is not PATH=LOW:HIGH[:COUNT]").format(text=one))
        axes[path] = values(text, "--over", count=up)
    return axes
