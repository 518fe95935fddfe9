"""What an absorber and a better design have in common when they are told: a line to lack, a band, what to mind."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from cardan.answers.answer import Column, Remark
from cardan.answers.quantity import Joined, Quantity, Say, say
from cardan.answers.question import Lacking, absent
from cardan.drive.drive import Drive
from cardan.formulas.damping import LOSS, SHAFT_SOURCE
from cardan.maths.arrays import Array
from cardan.texts import _

LITTLE = 0.9
"""What leaves more than this share of the alternating torque is hardly worth it."""

NAMED = 4
"""Speeds of instability that are named."""


def lacking_line(drive: Drive) -> Lacking:
    """Return what a drive file lacks for torsional vibration: something that twists."""
    some = bool(drive.stations) or any(shaft.stiffness is not None for shaft in drive.shafts)
    return absent((some, "stations", "shafts[1].stiffness"))


def torque(value: float) -> Quantity:
    """Return an alternating torque as it is told: with three digits."""
    return Quantity(float(value), "torque", 3)


def speed(value: float, digits: int = 3) -> Quantity:
    """Return a speed as it is told."""
    return Quantity(float(value), "angular_speed", digits)


def band(speeds: Array) -> Say:
    """Return the speeds that were looked at, as a sentence has them.

    >>> from cardan.answers.reader import USUAL
    >>> from cardan.units import rpm
    >>> band(np.asarray([300.0, 600.0]) * rpm).told(USUAL), band(np.asarray([300.0]) * rpm).told(USUAL)
    ('300 to 600 rpm', 'at 300 rpm')
    """
    if len(speeds) > 1:
        return say(_("{low:bare} to {high}"), low=speed(speeds[0]), high=speed(speeds[-1]))
    return say(_("at {low}"), low=speed(speeds[0]))


def curves(speeds: Array, named: Sequence[tuple[str, Array]]) -> list[Column]:
    """Return the columns of alternating torques over the speed, an element each.

    speeds (s,) [rad/s]; named, sequence of (str, array (s, E) [N·m]): in which state, and the torques there.
    """
    found = [Column(key="speed", values=speeds, dimension="angular_speed")]
    for word, table in named:
        for k, curve in enumerate(table.T, 1):
            found.append(Column(key=f"{word}_alternating_torque_{k}", values=curve, dimension="torque"))
    return found


def cautions(found: Any) -> Iterator[Remark]:
    """Yield what an absorber and a design have to say alike: stability, lost motions, backlash, a stop, assumptions."""
    lost = int(np.sum(~np.isfinite(found.after).all(axis=-1)))
    if lost:
        text = _(
            "Warning: at {lost} of {count} speeds no steady motion was found; they do not count in the largest "
            "alternating torque."
        )
        yield Remark(text=say(text, lost=lost, count=len(found.after)), tone="warning")
    if len(found.unstable_after):
        speeds = Joined([speed(one) for one in found.unstable_after[:NAMED]])
        text = _("Warning: parametric instability near {speeds}; see cardan torsion stability.")
        yield Remark(text=say(text, speeds=speeds), tone="warning")
    elif len(found.unstable_before):
        yield Remark(
            text=_("As built, the drive is unstable at some speeds; now it is stable at all of them."), tone="good"
        )
    if found.play:
        text = _("Backlash counts as closed here; cardan torsion response tells whether the torque changes its sign.")
        yield Remark(text=text, tone="warning")
    if found.cancelled:
        yield Remark(text=_("Warning: the search was stopped; this is the best so far."), tone="warning")
    elif not found.converged:
        yield Remark(text=_("Warning: the search had not converged; this is the best so far."), tone="warning")
    if any(path.endswith(".loss_factor") for path in found.assumed):
        text = _("Without any damping in the file shafts have η = {loss}: {source}; it sets the height of the peaks.")
        loss = Quantity(LOSS["shaft"], digits=2, trim=True)
        yield Remark(text=say(text, loss=loss, source=_(SHAFT_SOURCE)))
    undamped = [path.removesuffix(".damping") for path in found.assumed if path.endswith(".damping")]
    if undamped:
        text = _("Assumed: no damping in {paths}; give damping or loss_factor, which set the height of the peaks.")
        yield Remark(text=say(text, paths=", ".join(undamped)))
