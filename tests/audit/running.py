"""The audit of a drive at random."""

from __future__ import annotations

import warnings

from cardan.checks.audit.answers_agree import Compared, audit
from cardan.checks.design import design
from cardan.errors import InputError
from tests.builders.any_drive import NEVER, any_drive


def audited(seed: int, *, quick: bool = False, rare: float = NEVER) -> tuple[Compared, ...] | None:
    """Return all answers side by side of the drive of a seed, or the quick ones; None where chance makes no drive.

    rare: probability of each part that few drives carry.
    """
    try:
        drive = any_drive(seed, rare)
    except InputError:
        return None
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return audit(design(drive), quick=quick)
