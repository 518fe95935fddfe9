"""What was changed of a mechanism whose file says that its numbers are rounded."""

from __future__ import annotations

from collections.abc import Iterator

from cardan.answers.answer import Remark
from cardan.answers.quantity import Quantity, say
from cardan.maths.kernel import screws
from cardan.mechanism.constraints import constraints
from cardan.mechanism.mechanism import Mechanism
from cardan.mechanism.rounding import fitted
from cardan.texts import _

NEARLY = 1e-3
"""Share of the largest singular value of what pairs hold, below which one holds next to nothing."""


def rounded(mechanism: Mechanism) -> Iterator[Remark]:
    """Yield how far the pairs of a mechanism were moved so that its loops close; nothing of one that is exact."""
    if mechanism.rounding is None:
        yield from _nearly(mechanism)
        return
    found = fitted(mechanism)
    text = _(
        "Its numbers are rounded: pairs were moved by up to {shift} and axes turned by up to {turn}, most at {pair}, "
        "so that its loops close."
    )
    values = {"shift": Quantity(found.shift, "length", 3), "turn": Quantity(found.turn, "angle", 3), "pair": found.pair}
    yield Remark(text=say(text, **values))


def _nearly(mechanism: Mechanism) -> Iterator[Remark]:
    """Yield that an input is locked by next to nothing, as axes that meet but for rounding lock it."""
    found = screws.rank(constraints(mechanism).matrix())
    if mechanism.input_link and found.value == 6 * len(mechanism.links) and found.least < NEARLY:
        text = _(
            "Warning: what locks it is next to nothing, as of axes that meet but for rounding; if its numbers are "
            "rounded, tell how much, rounding_mm."
        )
        yield Remark(text=text, tone="warning")
