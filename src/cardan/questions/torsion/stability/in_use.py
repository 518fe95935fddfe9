"""Is steady torsional vibration at the speeds in use what is counted of it, and no less than the drive has?"""

from __future__ import annotations

from collections.abc import Iterator
from functools import lru_cache

import numpy as np

from cardan.answers.answer import FILE, Remark
from cardan.drive.conditions import held_speeds, speed_ranges
from cardan.drive.drive import Drive
from cardan.drive.torsional_layout import has_torsion
from cardan.errors import InputError
from cardan.questions.torsion.steady.pendulum_swing import strikes_in_use
from cardan.questions.torsion.steady.run_stability import Verdict
from cardan.texts import _

from .torsion_stability import judged_of, proved_in_use


@lru_cache(maxsize=256)
def grows_in_use(drive: Drive) -> bool:
    """Tell whether torsional vibration is unstable at a speed in use, as far as it is known."""
    if not has_torsion(drive):
        return False
    ranges, held = speed_ranges(drive.duty), held_speeds(drive.duty)
    try:
        proof = proved_in_use(drive) if ranges else None  # which judges the speeds that are held, too
        if proof is None:
            return any(np.any(judged_of(drive, np.asarray([one])).verdict == Verdict.UNSTABLE) for one in held)
    except InputError:
        return False
    return any(proof.overlapping(*one).size for one in (*ranges, *((one, one) for one in held)))


def why_larger(drive: Drive, *, stable: bool = False) -> str:
    """Return why the torques may be larger than steady vibration at the speeds in use has them; empty where not.

    stable: whether that is taken as stable without a look, which takes seconds.
    """
    if strikes_in_use(drive):
        return _(
            "met by small oscillations of a pendulum that oscillates widely or hits its stops: the torque may be "
            "larger than counted, see torsion simulate with --settled"
        )
    if not stable and grows_in_use(drive):
        return _(
            "met by the torque of a motion that is unstable at a speed in use: it grows beyond what is counted, see "
            "torsion stability"
        )
    return ""


def larger_in_use(drive: Drive) -> Iterator[Remark]:
    """Yield what makes the torques larger than those told at the speeds in use."""
    yield from strikes_in_use(drive)
    if grows_in_use(drive):
        text = _(
            "Torsional vibration is unstable at a speed in use: it grows beyond the torques counted here, which are "
            "the least."
        )
        command = ("cardan", "torsion", "stability", FILE)
        yield Remark(text=text, command=command, tone="failed", alarm=True)
