"""Calculations of diagnosis: what may be wrong, by the signs."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from cardan.calc.calculation import Calculation, Values, given, gives, positive
from cardan.catalogue.rows import FLAGS
from cardan.errors import Problem
from cardan.questions.diagnosis.match import Signs, likely_causes, symptoms
from cardan.texts import _, mark

FIRST = 4
"""Causes that are told."""


def _diagnose(values: Values) -> Values:
    orders = values["order"]
    found = likely_causes(
        Signs(
            orders=() if orders is None else tuple(np.atleast_1d(orders).tolist()),
            torque_sensitive=values["torque_sensitive"],
            symptom=values["symptom"],
            flags=frozenset(flag for flag in FLAGS if values[flag]),
        )
    )[:FIRST]
    told: Values = {"first_causes": [one.fault.id for one in found], "scores": [one.score for one in found]}
    for rank, one in enumerate(found, 1):
        told |= {f"cause_{rank}": one.fault.fault, f"inspection_{rank}": one.fault.inspection}
    return told


def _signs(values: Values, key: Callable[[str], str]) -> Iterator[Problem]:
    """Yield an empty list of orders, and inputs that hold no sign at all."""
    missing: Any = object()
    if np.size(values.get("order", 0.0)) == 0:
        yield Problem(key("order"), _("is empty: give the orders measured, or leave it out"), "empty")
    elif all(values.get(name, missing) is None for name in ("order", "torque_sensitive", "symptom", *FLAGS)):
        yield Problem(
            key("order"), _("missing: give at least one sign: an order, a symptom, how it takes torque"), "missing"
        )


CALCULATIONS = (
    Calculation(
        name="diagnose",
        doc=mark("the likeliest causes of a vibration or a complaint, and how to make sure"),
        source=mark(
            "table of faults of the catalogue, each with its source; the order of likelihood is a rule of this program"
        ),
        takes=(
            positive(
                "order",
                mark("measured orders, in multiples of the shaft's speed"),
                axes=(0, 1),
                entries=True,
                default=None,
            ),
            given("torque_sensitive", mark("whether it changes with the torque"), kind="flag", default=None),
            given("speed_dependent", mark("whether it changes with speed; not ranked by"), kind="flag", default=None),
            given("symptom", mark("what is noticed"), kind="word", choices=symptoms(), default=None),
            given(
                "resonance_at_half_critical",
                mark("whether it peaks at half the critical speed"),
                kind="flag",
                default=None,
            ),
            given("at_critical", mark("whether it rises steeply near the critical speed"), kind="flag", default=None),
            given(
                "transient_at_critical",
                mark("whether higher orders appear while running through a critical speed"),
                kind="flag",
                default=None,
            ),
            given("wheel_order", mark("whether it has the frequency of a wheel"), kind="flag", default=None),
        ),
        returns=(
            gives("first_causes", mark("the four likeliest faults, by their ids in the catalogue")),
            gives("scores", mark("their points")),
            *(
                one
                for rank in range(1, FIRST + 1)
                for one in (
                    gives(f"cause_{rank}", mark("what it is, by rank")),
                    gives(f"inspection_{rank}", mark("how to make sure")),
                )
            ),
        ),
        answer=_diagnose,
        check=_signs,
    ),
)
"""Calculations of this part."""
