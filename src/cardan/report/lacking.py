"""What a drive file lacks for a part of the report: each part asks here whether it can be told at all."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from cardan.drive.drive import Drive
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


def of_forces(drive: Drive) -> Lacking:
    """Return what the forces lack."""
    return _absent((drive.duty.torque is not None, "duty.torque"), (bool(drive.supports), "supports"))


def of_torsion(drive: Drive) -> Lacking:
    """Return what torsional vibration lacks."""
    some = bool(drive.stations) or any(shaft.stiffness is not None for shaft in drive.shafts)
    return _absent((some, "stations", "shafts[1].stiffness"))


def of_orders(drive: Drive) -> Lacking:
    """Return what the orders over the speeds in use lack."""
    return (*of_torsion(drive), *_absent((drive.duty.speed_range is not None, "duty.speed_range")))


def of_stability(drive: Drive) -> Lacking:
    """Return what the map of stability lacks."""
    return (*of_torsion(drive), *_absent((bool(drive.duty.speed), "duty.speed")))


def of_run_up(drive: Drive) -> Lacking:
    """Return what a run-up lacks."""
    return (*of_torsion(drive), *_absent((drive.duty.run_up is not None, "duty.run_up")))


def of_movement(drive: Drive) -> Lacking:
    """Return what the movement lacks."""
    return _absent((bool(drive.movements), "movements"))


def of_nothing(drive: Drive) -> Lacking:
    """Return that nothing is missing."""
    return ()


Asked: TypeAlias = Callable[[Drive], Lacking]


def _absent(*conditions: tuple[bool | str, ...]) -> Lacking:
    """Return the paths of the conditions that are not met: whether it is met, then what would meet it."""
    return tuple(tuple(map(str, paths)) for met, *paths in conditions if not met and paths)


def named(paths: Sequence[str]) -> Lacking:
    """Return paths all of which are missing, each once.

    Examples
    --------
    >>> named(["duty.torque", "duty.torque"])
    (('duty.torque',),)
    """
    return tuple((path,) for path in dict.fromkeys(paths))
