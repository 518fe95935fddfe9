"""From signs to causes: every fault of the catalogue scored by the signs that it shares, the likeliest first."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from cardan.catalogue import Catalogue, catalogue
from cardan.catalogue.rows import FLAGS, Fault
from cardan.errors import Problem, check
from cardan.texts import _

NEAR = 0.05  # a measured order belongs to an order of a fault when it is this near
SLACK = 1e-12  # what is left of rounding in a measured order

ORDERS, TORQUE, SIGN = 2, 1, 3
"""Points for all orders explained, agreement on the torque, a symptom or a circumstance; a rule of this program."""


@dataclass(frozen=True, kw_only=True)
class Signs:
    """What is known of a vibration or a complaint; nothing has to be."""

    orders: tuple[float, ...] = ()  # measured orders, in multiples of the speed of the shaft
    torque_sensitive: bool | None = None  # whether it changes with the torque
    symptom: str | None = None  # one of `symptoms`
    flags: frozenset[str] = frozenset()  # of `cardan.catalogue.rows.FLAGS`: the circumstances that hold

    def __post_init__(self) -> None:
        check(self._problems())

    def _problems(self) -> Iterator[Problem]:
        for k, order in enumerate(self.orders):
            if not 0.0 < order < math.inf:
                code = "not_positive" if math.isfinite(order) else "not_finite"
                text = _("{value:.6g} given; a finite order above 0 is needed")
                yield Problem(f"orders[{k}]", text.format(value=order), code)
        for flag in sorted(self.flags - set(FLAGS)):
            text = _("{value} is none of {choices}")
            yield Problem("flags", text.format(value=repr(flag), choices=", ".join(FLAGS)), "out_of_range")


@dataclass(frozen=True, kw_only=True)
class Cause:
    """A fault and how well the signs fit it."""

    fault: Fault  # row of the catalogue, with how to make sure and what to do
    score: float  # sum of the points; larger is likelier. Scores rank, they are no probabilities.
    orders: tuple[float, ...]  # the measured orders that it explains


def symptoms(known: Catalogue | None = None) -> tuple[str, ...]:
    """Return every symptom that a fault of the catalogue has, in its order. known: the shipped one when not given."""
    rows = (known or catalogue()).rows(Fault).values()
    return tuple(dict.fromkeys(symptom for row in rows for symptom in row.symptoms))


def likely_causes(signs: Signs, *, known: Catalogue | None = None) -> tuple[Cause, ...]:
    """Return every fault of the catalogue with its score, the likeliest first.

    known: the shipped one when not given.
    Returns: by falling score; equal ones by their ids.
    Raises InputError: no fault has the symptom.
    score = 2 h/n + s_T + Σ s_f + s_S: h of the n measured orders lie within 0.05 of one of the fault's orders; s_T = 1
    where both say the same of the torque, −1 where they differ, 0 where either says nothing; s_f = 3 for each
    circumstance of the fault that holds, −1 for one that does not; s_S = 3 where the fault has the symptom. The faults
    are those of the table `faults`, each with its source; the points are a rule of this program.

    >>> first = likely_causes(Signs(orders=(2.0,), torque_sensitive=True))[0]
    >>> first.fault.id, first.score
    ('F10', 3.0)
    """
    if signs.symptom is not None and signs.symptom not in symptoms(known):
        text = _("{value} is none of {choices}")
        text = text.format(value=repr(signs.symptom), choices=", ".join(symptoms(known)))
        check([Problem("symptom", text, "out_of_range")])
    found = [_scored(row, signs) for row in (known or catalogue()).rows(Fault).values()]
    return tuple(sorted(found, key=lambda one: (-one.score, one.fault.id)))


def _scored(row: Fault, signs: Signs) -> Cause:
    explained = tuple(one for one in signs.orders if any(abs(one - own) <= NEAR + SLACK for own in row.orders))
    points = 0
    if signs.torque_sensitive is not None and row.torque_sensitive is not None:
        points += TORQUE if signs.torque_sensitive == row.torque_sensitive else -TORQUE
    points += sum(SIGN if flag in signs.flags else -1 for flag in row.flags)
    points += SIGN if signs.symptom in row.symptoms else 0
    count = len(signs.orders) or 1
    # One division, so that faults with the same points tie exactly.
    return Cause(fault=row, score=(ORDERS * len(explained) + points * count) / count, orders=explained)
