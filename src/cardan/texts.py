"""Every sentence a user reads passes through here, so that a translation is a file.

Write ``_("joint {number} bends {bend}")`` with named places, then ``.format(number=..., bend=...)``: translators see
the whole sentence. Keys of the drive file and field names are not translated.
"""

from __future__ import annotations

import os
from functools import cache
from gettext import NullTranslations, translation
from pathlib import Path

DOMAIN = "cardan"


@cache
def _catalogue(language: str) -> NullTranslations:
    folder = Path(__file__).parent / "locale"
    return translation(DOMAIN, folder, languages=[language] if language else None, fallback=True)


def _(text: str) -> str:
    """Return the sentence in the language of ``CARDAN_LANG``, English where there is none.

    Examples
    --------
    >>> _("speed ratio")
    'speed ratio'
    """
    language = os.environ.get("CARDAN_LANG", "en")
    return text if language == "en" else _catalogue(language).gettext(text)


def plural(one: str, many: str, count: int) -> str:
    """Return the form of a sentence that fits ``count``.

    Examples
    --------
    >>> plural("{count} joint", "{count} joints", 4).format(count=4)
    '4 joints'
    """
    return _catalogue(os.environ.get("CARDAN_LANG", "en")).ngettext(one, many, count)
