"""The mechanism file: links and pairs of any mechanism, load and save as a drive."""

from __future__ import annotations

from pathlib import Path

from cardan.drive.drive import Drive
from cardan.errors import refuse
from cardan.mechanism.mechanism import Mechanism
from cardan.texts import _

from .drive_file import describes_mechanism, loads, parsed, text_of
from .reader import read_as


def load_mechanism(path: str | Path) -> Mechanism:
    """Return the mechanism a file describes.

    Parameters
    ----------
    path : str or Path
        A ``.toml`` file, or ``.json`` with the same tables.

    Returns
    -------
    Mechanism
        In SI, in its assembled position.

    Raises
    ------
    InputError
        The file cannot be read, is no TOML, or describes no mechanism; every problem at once, each with its path.

    See Also
    --------
    load, mobility

    Examples
    --------
    >>> import cardan
    >>> cardan.mechanisms.load_mechanism("slider.toml").links  # doctest: +SKIP
    ('crank', 'rod', 'piston')
    """
    where = Path(path)
    text, form = text_of(where)
    return loads_mechanism(text, form=form, name=str(where))


def loads_mechanism(text: str, *, form: str = "toml", name: str = "file") -> Mechanism:
    """Return the mechanism a text describes.

    Parameters
    ----------
    text : str
        The mechanism file.
    form : str
        ``"toml"`` or ``"json"``.
    name : str
        What messages call the text.

    Raises
    ------
    InputError
        Every problem of the text at once.

    Examples
    --------
    >>> from cardan.io import dumps
    >>> from cardan.mechanism.pair import Pair
    >>> hinge = Pair(id="hinge", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0))
    >>> text = dumps(Mechanism(frame="wall", joints=(hinge,)))
    >>> loads_mechanism(text).links
    ('door',)
    """
    tree = parsed(text, form, name)
    if not describes_mechanism(tree):
        raise refuse(name, _("describes no mechanism: it names neither a frame nor the links of its joints"))
    mechanism: Mechanism = read_as(Mechanism, tree)
    return mechanism


def load_either(path: str | Path) -> Drive | Mechanism:
    """Return the drive or the mechanism that a file describes; see `cardan.io.drive_file.load`."""
    where = Path(path)
    text, form = text_of(where)
    return loads_either(text, folder=where.parent, form=form, name=str(where))


def loads_either(text: str, *, folder: str | Path = ".", form: str = "toml", name: str = "file") -> Drive | Mechanism:
    """Return the drive or the mechanism that a text describes; see `cardan.io.drive_file.loads`."""
    if describes_mechanism(parsed(text, form, name)):
        return loads_mechanism(text, form=form, name=name)
    return loads(text, folder=folder, form=form, name=name)
