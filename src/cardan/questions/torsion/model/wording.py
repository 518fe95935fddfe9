"""Words that all answers on torsional vibration share: what the model assumes, and ranges of values."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from cardan.answers.answer import Remark
from cardan.answers.quantity import Joined, Quantity, Text, listed, say
from cardan.formulas.damping import SHAFT_SOURCE
from cardan.maths.arrays import ArrayLike
from cardan.texts import _

from .torsional_train import TorsionalTrain


def assumptions(train: TorsionalTrain) -> Iterator[Remark]:
    """Yield what the model assumes, in one line a sort.

    train: whose `assumed` paths are put into words.
    """
    kinds = {
        "stiffness": _("rigid, for want of a stiffness or a body of known length: {shafts}"),
        "inertia": _("without inertia: {shafts}"),
        "material": _("of steel: {shafts}"),
        "damping": _("without damping: {shafts}"),
    }
    every = {f"shafts[{k}].{kind}": (kind, k + 1) for k in range(max(train.model.shaft) + 1) for kind in kinds}
    found: dict[str, list[int]] = {}
    for kind, number in (every[path] for path in train.assumed if path in every):
        found.setdefault(kind, []).append(number)
    texts = []
    for kind, numbers in found.items():
        word = _("shaft") if len(numbers) == 1 else _("shafts")
        texts.append(kinds[kind].format(shafts=f"{word} {listed(numbers)}"))
    if train.usual_loss:
        text = _("Without any damping in the file shafts have η = {loss}: {source}; damping or loss_factor changes it.")
        yield Remark(text=say(text, loss=Quantity(train.usual_loss, digits=2, trim=True), source=_(SHAFT_SOURCE)))
    if "duty.motor" in train.assumed:
        texts.append(_("driven by a constant torque that equals what resists at the start"))
    if texts:
        yield Remark(text=_("Assumed: {what}.").format(what="; ".join(texts)))


def ranges(values: ArrayLike, mask: ArrayLike, dimension: str = "", unit: str = "") -> Joined:
    """Return the ranges of values in which something holds; told as nothing where there is none.

    values (s,): rising, in SI; mask (s,) of bool: where it holds; dimension, unit: of the values, as of `Quantity`.
    """
    inside = np.asarray(mask, dtype=bool)
    steps = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int)))
    every = [Quantity(float(one), dimension, unit=unit, trim=True) for one in np.asarray(values, dtype=float)]
    parts: list[Text] = []
    for first, behind in zip(steps[::2].tolist(), steps[1::2].tolist(), strict=True):
        low, high = every[first], every[behind - 1]
        parts.append(low if behind - first == 1 else say(_("{low:bare} to {high}"), low=low, high=high))
    return Joined(parts)
