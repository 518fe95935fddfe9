"""What a drive file lacks for a part of the report: each part asks here whether it can be told at all."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from cardan.drive.fields.keys import key_of
from cardan.texts import _

Lacking: TypeAlias = tuple[tuple[str, ...], ...]
"""Paths that are missing; of each inner tuple any one would do. Empty where nothing is missing."""


def told(lacking: Lacking) -> str:
    """Return in a sentence what is to be added to the drive file.

    Parameters
    ----------
    lacking : tuple of tuple of str
        Paths; of each inner tuple any one would do.

    Examples
    --------
    >>> told((("duty.torque",), ("joints[0].friction", "supports[0].friction")))
    'This answer needs more in the drive file: duty.torque_Nm; joints[0].friction or supports[0].friction.'
    """
    either = _(" or ")
    keys = "; ".join(either.join(map(key_of, some)) for some in lacking)
    return _("This answer needs more in the drive file: {keys}.").format(keys=keys)


def named(paths: Sequence[str]) -> Lacking:
    """Return paths all of which are missing, each once.

    Examples
    --------
    >>> named(["duty.torque", "duty.torque"])
    (('duty.torque',),)
    """
    return tuple((path,) for path in dict.fromkeys(paths))
