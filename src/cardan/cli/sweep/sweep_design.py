"""``cardan sweep PLAN --design``: designs that choose their points themselves."""

from __future__ import annotations

from pathlib import Path

from cardan.batch.search.answer import answer
from cardan.cli.shared.failure import about
from cardan.cli.shared.progress import ended, keeping
from cardan.cli.shared.tell import tell
from cardan.io.plan_designs import design_of
from cardan.io.plan_file import Plan
from cardan.texts import _


def designed(read: Plan, file: Path, name: str, *, json: bool, csv: bool, plot: Path | None) -> int:
    """Run a design of a plan and tell what it found.

    name: table of the design; json, csv: ``--json`` and ``--csv``; plot: ``--plot``.
    """
    with about(str(file)):
        design = design_of(read, name)
    with keeping(_("choosing points")) as progress, about(str(file)):
        found = design.run(progress)
    title = read.title or read.drive.name or file.stem
    return ended(tell(answer(found), name=title, json=json, csv=csv, plot=plot), progress)
