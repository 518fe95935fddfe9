"""What a check is: a name, a sentence, and a function from a design to verdicts."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

from cardan.drive.joints import Joint
from cardan.drive.models.laws import mixed, unmapped
from cardan.texts import _

from .design import Design
from .verdict import Verdict


@dataclass(frozen=True, kw_only=True)
class Check:
    """A check.

    Attributes
    ----------
    name : str
        Its name in `CHECKS`.
    doc : str
        One sentence on what it judges.
    judge : function
        From a design to its verdicts; a verdict that lacks data names the paths that are missing.
    crosses : str
        "each" where it judges Hooke joints only, one by one; "all" where it judges drives that have no others; "map"
        where it judges joints with tan φ' = κ tan φ; "law" where it needs that for many drives at once.
    """

    name: str
    doc: str
    judge: Callable[[Design], Iterable[Verdict]]
    crosses: str = ""

    def verdicts(self, design: Design) -> Iterator[Verdict]:
        """Yield the verdicts on a design; those on joints of a kind that the check does not judge say so."""
        joints = design.drive.joints
        if not self.crosses or not mixed(joints):
            yield from self.judge(design)
            return
        if self.crosses in ("map", "law"):
            own = unmapped(joints)
            for one in self.judge(design):
                stuck = own and (self.crosses == "map" or bool(design.varied))
                yield replace(_unfit(one, joints[own[0]].kind), unfit=_ruled(joints[own[0]])) if stuck else one
            return
        others = [i for i, joint in enumerate(joints) if not joint.single_cross]
        for one in self.judge(design):
            number = re.match(r"joints\[(\d+)\]", one.subject)
            whole = self.crosses == "all" or any(path.endswith(".kind") for path in one.missing)
            concerned = others if whole else [int(number[1])] if number else []
            kinds = [joints[i].kind for i in concerned if i in others]
            yield _unfit(one, kinds[0]) if kinds else one


def _ruled(joint: Joint) -> str:
    text = _("judges joints with tan φ' = κ tan φ, not one of kind {kind} with these sizes")
    return text.format(kind=joint.kind)


def _unfit(one: Verdict, kind: str) -> Verdict:
    why = _("judges Hooke joints, not a joint of kind {kind}").format(kind=kind)
    return replace(one, value=float("nan"), limit=float("nan"), missing=(), levers=(), note="", unfit=why)
