"""Diagnosis: what may be wrong, by the signs."""

from __future__ import annotations

from typing import Any

import numpy as np

from cardan.calc.calculation import Formulas, Problems, Values
from cardan.catalogue.rows import FLAGS
from cardan.questions.diagnosis.match import Signs, likely_causes, symptoms
from cardan.reading.given import flag, gives, positive, word
from cardan.texts import _

formula = Formulas(__doc__)

FIRST = 4
"""Causes that are told."""


def _signs(v: Values) -> Problems:
    """Yield an empty list of orders, and inputs that hold no sign at all."""
    missing: Any = object()
    if np.size(v.get("order", 0.0)) == 0:
        yield v.wrong("order", _("is empty: give the orders measured, or leave it out"), "empty")
    elif all(v.get(name, missing) is None for name in ("order", "torque_sensitive", "symptom", *FLAGS)):
        yield v.wrong(
            "order", _("missing: give at least one sign: an order, a symptom, how it takes torque"), "missing"
        )


@formula(
    "the likeliest causes of a vibration or a complaint, and how to make sure",
    "table of faults of the catalogue, each with its source; the order of likelihood is a rule of this program",
    positive("order", "measured orders, in multiples of the shaft's speed", axes=(0, 1), entries=True, default=None),
    flag("torque_sensitive", "whether it changes with the torque", default=None),
    flag("speed_dependent", "whether it changes with speed; not ranked by", default=None),
    word("symptom", "what is noticed", *symptoms(), default=None),
    flag("resonance_at_half_critical", "whether it peaks at half the critical speed", default=None),
    flag("at_critical", "whether it rises steeply near the critical speed", default=None),
    flag("transient_at_critical", "whether higher orders appear while running through a critical speed", default=None),
    flag("wheel_order", "whether it has the frequency of a wheel", default=None),
    "first_causes: the four likeliest faults, by their ids in the catalogue",
    "scores: their points",
    *(
        one
        for rank in range(1, FIRST + 1)
        for one in (gives(f"cause_{rank}", "what it is, by rank"), gives(f"inspection_{rank}", "how to make sure"))
    ),
    check=_signs,
)
def _diagnose(v: Values) -> Any:
    orders = v.order
    found = likely_causes(
        Signs(
            orders=() if orders is None else tuple(np.atleast_1d(orders).tolist()),
            torque_sensitive=v.torque_sensitive,
            symptom=v.symptom,
            flags=frozenset(flag for flag in FLAGS if v[flag]),
        )
    )[:FIRST]
    told: dict[str, Any] = {"first_causes": [one.fault.id for one in found], "scores": [one.score for one in found]}
    for rank, one in enumerate(found, 1):
        told |= {f"cause_{rank}": one.fault.fault, f"inspection_{rank}": one.fault.inspection}
    return told
