"""Layout rules and upkeep: how many shafts a wheelbase needs, when lubrication is due."""

from __future__ import annotations

from cardan.catalogue.rows import Lubrication

ONE_SHAFT, TWO_SHAFTS = 3.4, 4.8
"""Wheelbases below which one shaft, and up to which two shafts are usual [m]: web articles on drive shafts."""

SEVERE = 0.5
"""Share of the interval in water, mud or dust; a rule of this program."""


def shaft_sections(wheelbase: float) -> int:
    """Return how many shafts a wheelbase usually has; there is one joint more, and one centre bearing fewer.

    Parameters
    ----------
    wheelbase : float [m]

    Examples
    --------
    >>> [shaft_sections(length) for length in (2.7, 3.4, 4.8, 5.6)]
    [1, 2, 2, 3]
    """
    return 1 if wheelbase < ONE_SHAFT else 2 if wheelbase <= TWO_SHAFTS else 3


def lubrication_shares(
    row: Lubrication,
    *,
    hours: float | None = None,
    distance: float | None = None,
    years: float | None = None,
    severe: bool = False,
) -> dict[str, float]:
    """Return the share of each interval that is used up; lubrication is due from 1.

    Parameters
    ----------
    row : Lubrication
        Of the catalogue.
    hours : float [s], optional
        Running time since the last lubrication.
    distance : float [m], optional
    years : float, optional
    severe : bool
        Halves the intervals.

    Returns
    -------
    dict
        "hours", "distance" and "years" -> share, those that are given and have an interval.

    Examples
    --------
    >>> from cardan.catalogue import catalogue
    >>> row = catalogue().rows(Lubrication)["needle_bearings"]
    >>> lubrication_shares(row, hours=260 * 3600.0, severe=True)
    {'hours': 1.04}
    """
    shorter = SEVERE if severe else 1.0
    used = {"hours": (hours, row.hours), "distance": (distance, row.distance), "years": (years, row.years)}
    return {
        name: given / (interval * shorter)
        for name, (given, interval) in used.items()
        if given is not None and interval is not None
    }
