"""Every sentence a user reads passes through here, so that a translation is a file.

Write ``_("joint {number} bends {joint_angle}")`` with named places, then ``.format(number=..., joint_angle=...)``:
translators see the whole sentence. Keys of the drive file and field names are not translated. A sentence of a module,
outside of every function, is written ``mark("...")`` and translated by ``_`` where it is shown: one process may speak
several languages.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any
from unicodedata import category

DOMAIN = "cardan"
FOLDER = Path(__file__).parent / "locale"
LANGUAGES = {"en": "English", "ru": "Русский"}
"""Code of a language -> its name in that language."""


def known(name: str) -> str:
    """Return the code of a language from its name in an environment, English where we do not speak it."""
    code = name.replace("-", "_").partition("_")[0].partition(".")[0].lower()
    return code if code in LANGUAGES else "en"


_DEFAULT = known(os.environ.get("CARDAN_LANG", ""))
_spoken: ContextVar[str] = ContextVar("cardan_language", default=_DEFAULT)


def language() -> str:
    """Return the code of the language spoken here: in this thread or task, that of ``CARDAN_LANG`` by default."""
    return _spoken.get()


@contextmanager
def speaking(code: str) -> Iterator[None]:
    """Speak a language within, and the one before afterwards; English where the code is not one of `LANGUAGES`.

    Parameters
    ----------
    code : str
        One of `LANGUAGES`.

    Examples
    --------
    >>> with speaking("ru"):
    ...     print(_("joint"))
    шарнир
    """
    before = _spoken.set(known(code))
    try:
        yield
    finally:
        _spoken.reset(before)


@cache
def _catalogue(code: str) -> Any:
    """Return what translates into a language; English needs none, and loads none."""
    return import_module("gettext").translation(DOMAIN, FOLDER, languages=[code], fallback=True)


def _(text: str) -> str:
    """Return the sentence in the language spoken here, in English where it has no translation."""
    code = _spoken.get()
    return text if code == "en" or not text else str(_catalogue(code).gettext(text))


def plural(one: str, many: str, count: int) -> str:
    """Return the form of a sentence that fits ``count``."""
    code = _spoken.get()
    if code == "en":
        return one if count == 1 else many
    return str(_catalogue(code).ngettext(one, many, count))


def mark(text: str) -> str:
    """Return the sentence as it is: it is in the catalogue, and `_` translates it where it is shown.

    Examples
    --------
    >>> mark("speed ratio")
    'speed ratio'
    """
    return text


def visible(text: str) -> str:
    r"""Return a text in which signs that are obeyed, not seen, are spelled out; blanks of all widths may stay.

    >>> visible("two\u202eeno")
    'two\\u202eeno'
    """
    if text.isprintable():
        return text
    return "".join(sign if sign.isprintable() or category(sign) == "Zs" else ascii(sign)[1:-1] for sign in text)
