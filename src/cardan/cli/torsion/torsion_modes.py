"""``cardan torsion modes``: at which speeds does something excite the torsional modes of the drive?"""

from __future__ import annotations

from cardan.cli.shared.asked import check_options, keys_of, on_duty
from cardan.cli.shared.source import AsCsv, AsJson, DriveFile, Plot, SpeedRpm, read
from cardan.cli.shared.tell import tell
from cardan.questions.torsion.model.answer import answer, ask
from cardan.questions.torsion.stability.torsion_stability import proved_in_use

from .torsion_parts import Pieces


def torsion_modes(
    file: DriveFile,
    speed_rpm: SpeedRpm = None,
    pieces: Pieces = 1,
    json: AsJson = False,
    csv: AsCsv = False,
    plot: Plot = None,
) -> int:
    """Tell the natural frequencies and the speeds at which something excites them."""
    check_options(speed_rpm, json=json, csv=csv, plot=plot)
    drive = on_duty(read(file), speed_rpm, None)
    with keys_of(file):
        found, exact = ask(drive, pieces=pieces), proved_in_use(drive, pieces)
    return tell(answer(drive, found, exact=exact), file, drive, json=json, csv=csv, plot=plot)
