"""Whether every joint may bend as far as it does: by its maker, its type, or the user's own limit."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from cardan.catalogue.rows import JointType
from cardan.checks.case import largest
from cardan.checks.check import Check
from cardan.checks.design import Design
from cardan.checks.moving import largest_bend
from cardan.checks.verdict import Verdict
from cardan.texts import _, mark


def _judge(design: Design) -> Iterator[Verdict]:
    own = design.value("limits.bend")
    for i, joint in enumerate(design.drive.joints):
        row = design.known.rows(JointType).get(joint.type)
        limits = [
            (own, _("limits of the drive file")),
            (design.value(f"joints[{i}].rating.max_bend"), _("rating of the joint")),
            (row.max_bend if row else None, row.source if row else ""),
        ]
        given = [(limit, source) for limit, source in limits if limit is not None]
        title = _("bend of joint {number}").format(number=i + 1)
        made = partial(Verdict, check="bend", subject=f"joints[{i}]", title=title, dimension="angle", unit="deg")
        if not given:
            yield made(missing=(f"joints[{i}].rating.max_bend",))
            continue
        limit, source = given[0]
        bends = [np.asarray(case.bend)[..., i] for case in design.cases] or [design.bend[..., i]]
        moved = largest_bend(design, i)
        note = _("while the drive moves") if np.all(moved > largest(bends)) else ""
        yield made(value=largest([*bends, moved]), limit=limit, source=source, levers=design.bends_of(i), note=note)


CHECK = Check(name="bend", doc=mark("bend of every joint against what maker, type or user allow"), judge=_judge)
