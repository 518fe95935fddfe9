"""What the movements of a drive and its poses make of its joints, asked once for all checks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

from cardan.analysis.articulation import Articulation, articulation
from cardan.drive.drive import Drive
from cardan.texts import _

from .design import Design
from .verdict import Verdict

WORSE = 1.0 + 1e-9
"""A pose is worse than another from here on; less is rounding."""


@lru_cache(maxsize=64)
def movement(drive: Drive) -> Articulation | None:
    """Return the articulation of a drive; None where nothing moves."""
    return articulation(drive) if drive.movements else None


def largest_bend(design: Design, i: int) -> float:
    """Return the largest bend of a joint while the drive moves, counted from 0 [rad]; 0 where nothing moves."""
    found = movement(design.drive)
    return 0.0 if found is None else float(found.envelope["bend"][1][i])


def largest_irregularity(design: Design) -> float:
    """Return the largest irregularity of the output while the drive moves; 0 where nothing moves."""
    found = movement(design.drive)
    return 0.0 if found is None else float(found.envelope["irregularity"][1])


def worst_of_poses(drawn: Sequence[Verdict], poses: Sequence[tuple[str, Sequence[Verdict]]]) -> tuple[Verdict, ...]:
    """Return for each verdict the worst of the drive as drawn and in its poses, with a word on which pose it is.

    Parameters
    ----------
    drawn : sequence of Verdict
        Of one drive as drawn.
    poses : sequence of (str, sequence of Verdict)
        Name of each pose, and the verdicts in it.
    """
    found = []
    for one in drawn:
        worst = one
        for name, verdicts in poses:
            other = next((its for its in verdicts if (its.check, its.title) == (one.check, one.title)), None)
            if one.run and other is not None and other.run and other.utilisation > worst.utilisation * WORSE:
                said = _("in the pose {name}").format(name=name)
                worst = replace(other, note=f"{other.note}; {said}" if other.note else said)
        found.append(worst)
    return tuple(found)
