"""``cardan torsion absorber``: which absorber calms the drive, on which station, and how is it to be set?"""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from cardan.cli.shared.asked import TorqueNm, check_options, on_duty
from cardan.cli.shared.options import option
from cardan.cli.shared.progress import ended, keeping
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Force, Plot, SpeedRpm, read_with_text
from cardan.cli.shared.tell import tell
from cardan.io.edit import put_station, station_text
from cardan.questions.torsion.absorber.answer import answer, ask
from cardan.texts import _
from cardan.units import mm

from .torsion_band import Element, Out, SpeedBand, asked_of, band_of, check_out, elements_of, repeated, stepped, written

OPTIONS = {
    "kind": "--kind", "inertia": "--inertia-kg-m2", "inertia_ratio": "--ratio", "station": "--at", "mode": "--mode",
    "order": "--order", "radius": "--radius-mm", "count": "--count", "speeds": "--speeds", "elements": "--element",
}  # fmt: skip
"""What the question calls by another name than the command."""


def torsion_absorber(
    file: DriveFile,
    kind: Annotated[
        str, option("--kind", "KIND", _("One of h_infinity, den_hartog, viscous, tuned (one speed), pendulum."))
    ] = "h_infinity",
    ratio: Annotated[
        float | None,
        option("--ratio", "SHARE", _("Inertia over that of the mode at the station; 0.1 where none is given.")),
    ] = None,
    inertia: Annotated[float | None, option("--inertia-kg-m2", "INERTIA", _("The inertia itself, instead."))] = None,
    at: Annotated[
        str | None,
        option(
            "--at", "STATION", _("Name or number of the station; where the mode has its largest amplitude by default.")
        ),
    ] = None,
    mode: Annotated[int | None, option("--mode", "N", _("Mode to suppress; the strongest by default."))] = None,
    order: Annotated[float | None, option("--order", "ORDER", _("Order that excites it."))] = None,
    radius: Annotated[
        float | None, option("--radius-mm", "MM", _("Pendulums: distance of the pivots from the axis."))
    ] = None,
    count: Annotated[int, option("--count", "N", _("Pendulums: how many."))] = 1,
    speeds: SpeedBand = None,
    element: Element = None,
    speed_rpm: SpeedRpm = None,
    torque: TorqueNm = None,
    out: Out = None,
    force: Force = False,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell how an absorber, damper or pendulum is to be set on the drive, and what it does."""
    check_options(speed_rpm, torque, json=json, csv=csv, plot=plot)
    check_out(out, file, force=force)
    band = band_of(speeds)
    drive, text = read_with_text(file)
    drive = on_duty(drive, speed_rpm, torque)
    with asked_of(file, OPTIONS), keeping(_("setting the absorber")) as progress:
        found = ask(
            drive,
            kind=kind,
            inertia=inertia,
            inertia_ratio=ratio,
            radius=None if radius is None else radius * mm,
            count=count,
            station=at,
            mode=mode,
            order=order,
            speeds=band,
            elements=elements_of(element),
            progress=progress,
        )
    if out is not None:
        written(file, text, out, lambda: put_station(text, found.drive, found.table, folder=file.parent), found.drive)
    given = {"--kind": kind, "--ratio": ratio, "--inertia-kg-m2": inertia, "--at": at, "--mode": mode, "--order": order}
    given |= {"--radius-mm": radius, "--count": None if count == 1 else count, "--speeds": speeds}
    given |= {"--speed-rpm": speed_rpm, "--torque-Nm": torque}
    said = answer(drive, found, chosen=band is not None)
    said = replace(said, facts={**said.facts, "station_toml": station_text(found.drive, found.table)})
    said = stepped(said, ("torsion", "absorber"), repeated(given, {"--element": element}), out)
    return ended(tell(said, file, drive, json=json, csv=csv, plot=plot), progress)
