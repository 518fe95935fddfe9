"""The words of a scene in the units and with the decimal sign that a reader likes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

from cardan.figures.conversion import Conversion, names_of

from .parts import Scene


def in_words_of(shown: Scene, units: Mapping[str, str], decimal: str = ".", *, names: Iterable[str] = ()) -> Scene:
    """Return a scene with its names, values and legends in the units of a choice; lengths in space stay in m.

    Parameters
    ----------
    shown : Scene
        As `scene` makes it, in the language it was made in.
    units : mapping of str to str
        Dimension -> unit, as in the keys of a drive file: ``{"length": "in"}``; all others stay.
    decimal : str
        Sign between whole and part: ``"."`` or ``","``.
    names : iterable of str
        Names that a user wrote: they stay as they are.

    Returns
    -------
    Scene
        The same object where there is nothing to change.

    Raises
    ------
    InputError
        There is no such dimension or unit, or the sign is none.

    Examples
    --------
    >>> from cardan.drive.drive import Drive
    >>> from .scene import scene
    >>> drive = Drive.from_points([(0, 0, 0), (0.3, 0, 0), (0.808, 0, 0), (1, 0, 0)])
    >>> inches = in_words_of(scene(drive, frames=8), {"length": "in"})
    >>> [label.text for label in inches.labels if label.group == "dimensions"]
    ['20.00 in']
    """
    how = Conversion(units=dict(units), decimal=decimal, names=names_of(names))
    if how.idle:
        return shown
    say = how.sentence
    return replace(
        shown,
        bodies=tuple(replace(one, text=say(one.text)) for one in shown.bodies),
        areas=tuple(replace(one, text=say(one.text)) for one in shown.areas),
        labels=tuple(one if one.group == "names" else replace(one, text=say(one.text)) for one in shown.labels),
        arrows=tuple(replace(one, text=say(one.text)) for one in shown.arrows),
        modes=tuple(replace(one, name=say(one.name), text=say(one.text)) for one in shown.modes),
        groups=tuple(replace(one, text=say(one.text)) for one in shown.groups),
    )
