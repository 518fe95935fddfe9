"""What ``cardan mobility`` writes as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from cardan.mechanism.partition import Partition
    from cardan.questions.mobility.finite_mobility import FiniteMobility
    from cardan.questions.mobility.mobility import Mobility
    from cardan.questions.mobility.mobility_turn import MobilityTurn
    from cardan.questions.mobility.repair import Repair


class Turned:
    """What a turn of the input shows: positions, and for a mechanism how its loops close."""

    def __init__(self, positions: MobilityTurn, closure: FiniteMobility | None) -> None:
        self.positions = positions
        self.closure = closure


def content(
    file: Path, found: Mobility, counted: Partition | None, cures: Sequence[Repair], around: Turned | None
) -> dict[str, Any]:
    """Return the answer as JSON has it, in units of the keys."""
    from cardan.questions.mobility.repair import advice, strain
    from cardan.units import deg, mm

    groups = None if counted is None or counted.groups is None else counted.groups
    told: dict[str, Any] = {
        "question": "mobility",
        "name": found.mechanism.name,
        "file": str(file),
        "moving_links": found.links,
        "loops": found.loops,
        "sum_constraints": found.constraints,
        "rank": found.rank,
        "mobility": found.mobility,
        "redundant": found.redundant,
        "formula": found.formula,
        "driven": found.driven,
        "local": found.local,
        "parasitic": found.parasitic,
        "adrift": found.adrift,
        "certain": found.certain,
        "checked_by_loops": found.agrees,
        "misfit_mm": found.misfit / mm,
        "joints": [
            {
                "joint": one.id,
                "type": one.type,
                "links": one.links,
                "axes": one.axes,
                "turning": one.turning,
                "sliding": one.sliding,
                "strained_by": strain(one) or None,
                "force_N": one.force,
                "couple_Nm": one.couple,
                "misfit_mm": one.misfit / mm,
            }
            for one in found.joints
        ],
        "repairs": [
            {
                "redundant_after": one.after,
                "changes": [
                    {
                        "joint": change.joint,
                        "before": change.before,
                        "after": change.after or None,
                        "advice": advice(change, found.mechanism),
                    }
                    for change in one.changes
                ],
            }
            for one in cures
        ],
    }
    if counted is not None:
        told["by_graph"] = {
            "mobility": counted.mobility + counted.excess,
            "redundant": counted.redundant + counted.excess,
            "overconstrained_links": counted.overconstrained,
            "groups": None if groups is None else [{"links": one.links, "mobility": one.mobility} for one in groups],
        }
    if around is not None:
        over = around.positions
        told["turn"] = {
            "comes_round": over.turns,
            "redundant_everywhere": over.structural,
            "special_deg": over.special / deg,
            "angle_deg": over.angle / deg,
            "mobility": over.mobility,
            "redundant": over.redundant,
            "residual": over.residual,
        }
    return told
