"""The drive file, and what it shares with the mechanism file: load and save, TOML and JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from cardan.drive.drive import Drive
from cardan.drive.fields.keys import tree_of
from cardan.drive.fields.names import names_rows
from cardan.errors import refuse
from cardan.files import Enclosed, folder_of
from cardan.later import later
from cardan.mechanism.mechanism import Mechanism
from cardan.reading.limits import limits_hold
from cardan.texts import _

from .reader import drive_from_tree, mechanism_of, read_as
from .text import describes_mechanism, parsed, text_of

rows = later("cardan.catalogue")
"""What names in a drive stand for: many drives have none."""


def load(path: str | Path, *, catalogues: Sequence[str | Path] = (), limits: bool = True) -> Drive:
    """Return the drive a file describes.

    Parameters
    ----------
    path : str or Path
        A ``.toml`` file, or ``.json`` with the same tables.
    catalogues : sequence of str or Path
        Catalogue files beside those that the drive file names.
    limits : bool
        Refuse a file of more than 2 MB, 32 levels, 20,000 keys, 100 joints, or 500 tables of another list, before it
        is parsed. False reads it however long that takes; so does ``CARDAN_NO_LIMITS=1`` in the environment.

    Returns
    -------
    Drive
        In SI, as the file gives it.

    Raises
    ------
    InputError
        The file cannot be read, passes a limit, is no TOML, or describes no drive; every problem at once, each with
        its path.

    See Also
    --------
    save, example, load_mechanism

    Examples
    --------
    >>> import cardan
    >>> cardan.save(cardan.Drive.from_angles([0.1]), "drive.toml")  # doctest: +SKIP
    >>> cardan.load("drive.toml").form  # doctest: +SKIP
    'angles'
    """
    where = Path(path)
    with limits_hold(limits):
        text, form = text_of(where)
        return loads(text, folder=where.parent, form=form, name=str(where), catalogues=catalogues)


def loads(
    text: str,
    *,
    folder: str | Path | Enclosed = ".",
    form: str = "toml",
    name: str = "file",
    catalogues: Sequence[str | Path] = (),
) -> Drive:
    """Return the drive a text describes.

    text: the drive file; folder: where files that it names are looked for; form: ``"toml"`` or ``"json"``.
    name: what messages call the text; catalogues: catalogue files beside those that the text names.
    Raises InputError: every problem of the text at once.

    >>> from cardan.io import loads
    >>> loads('format = 1' + chr(10) + '[[joints]]' + chr(10) + 'joint_angle_deg = 20').joints[0].joint_angle
    0.3490658503988659
    """
    tree = parsed(text, form, name)
    if describes_mechanism(tree):
        raise refuse(
            name,
            _("describes a mechanism, not a drive; of mechanisms cardan tells motion, forces, mobility and a report"),
        )
    return _drive_of(tree, folder, catalogues)


def _drive_of(tree: Mapping[str, Any], folder: str | Path | Enclosed, catalogues: Sequence[str | Path]) -> Drive:
    drive = drive_from_tree(tree, folder=folder_of(folder))
    if not catalogues and not names_rows(drive):
        return drive
    whole: Drive = rows().completed(drive, rows().known_to(drive, folder, catalogues))
    return whole


def dumps(thing: Drive | Mechanism, *, form: str = "toml") -> str:
    """Return the text of a drive file, or of a mechanism file; reading it gives an equal one.

    form: ``"toml"`` or ``"json"``.
    """
    tree = tree_of(rows().shortened(thing) if isinstance(thing, Drive) else thing)
    return json.dumps(tree, ensure_ascii=False, indent=2) + "\n" if form == "json" else toml_text(tree)


# From nested tables to the text of a drive file or mechanism file.


def toml_text(tree: Mapping[str, Any]) -> str:
    """Return nested tables as TOML: values first, then tables, then lists of tables."""
    lines: list[str] = []
    _emit(tree, "", lines)
    return "\n".join(lines).strip() + "\n"


def _emit(table: Mapping[str, Any], path: str, lines: list[str]) -> None:
    for key, value in table.items():
        if isinstance(value, Mapping) and not path and key in ("input", "output"):
            lines += [f"{key}.{inner} = {_toml(item)}" for inner, item in value.items()]
        elif not path and isinstance(value, str) and "\n" in value:
            lines.append(f"{_key(key)} = {_paragraphs(value)}")
        elif path or not (isinstance(value, Mapping) or _is_tables(value)):
            lines.append(f"{_key(key)} = {_toml(value)}")
    if path:
        return
    for key, value in table.items():
        if isinstance(value, Mapping) and key not in ("input", "output"):
            lines += ["", f"[{key}]"]
            _emit(value, key, lines)
        elif _is_tables(value):
            for item in value:
                lines += ["", f"[[{key}]]"]
                _emit(item, key, lines)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], Mapping)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_toml(item)}" for key, item in value.items()) + " }"
    return repr(whole(value))


def whole(value: Any) -> Any:
    """Return a whole number without a point, all else as it is."""
    return int(value) if isinstance(value, float) and value.is_integer() and abs(value) < 1e15 else value


def _paragraphs(text: str) -> str:
    """Return a text of several lines as one that a reader of the file sees as such."""
    body = "\n".join(_toml(line)[1:-1] for line in text.split("\n"))
    return f'"""\n{body}"""'


def _key(key: str) -> str:
    plain = key and all(c.isascii() and (c.isalnum() or c in "_-") for c in key)
    return key if plain else json.dumps(key, ensure_ascii=False)


# The mechanism file: links and pairs of any mechanism, load and save as a drive.


def load_mechanism(path: str | Path, *, limits: bool = True) -> Mechanism:
    """Return the mechanism a file describes.

    Parameters
    ----------
    path : str or Path
        A ``.toml`` file, or ``.json`` with the same tables.
    limits : bool
        As in `load`; 400 joints are allowed.

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
    with limits_hold(limits):
        text, form = text_of(where)
        return loads_mechanism(text, form=form, name=str(where))


def loads_mechanism(text: str, *, form: str = "toml", name: str = "file") -> Mechanism:
    """Return the mechanism a text describes.

    text: the mechanism file; form: ``"toml"`` or ``"json"``; name: what messages call the text.
    Raises InputError: every problem of the text at once.

    >>> from cardan.io import dumps
    >>> from cardan.mechanisms import Pair
    >>> hinge = Pair(id="hinge", type="R", links=("wall", "door"), point=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0))
    >>> text = dumps(Mechanism(frame="wall", joints=(hinge,)))
    >>> loads_mechanism(text).links
    ('door',)
    """
    return mechanism_of(text, form=form, name=name)


def load_either(path: str | Path, *, catalogues: Sequence[str | Path] = ()) -> Drive | Mechanism:
    """Return the drive or the mechanism that a file describes; see `cardan.io.drive_file.load`."""
    where = Path(path)
    text, form = text_of(where)
    return loads_either(text, folder=where.parent, form=form, name=str(where), catalogues=catalogues)


def loads_either(
    text: str,
    *,
    folder: str | Path | Enclosed = ".",
    form: str = "toml",
    name: str = "file",
    catalogues: Sequence[str | Path] = (),
) -> Drive | Mechanism:
    """Return the drive or the mechanism that a text describes; see `cardan.io.drive_file.loads`."""
    tree = parsed(text, form, name)
    return read_as(Mechanism, tree) if describes_mechanism(tree) else _drive_of(tree, folder, catalogues)
