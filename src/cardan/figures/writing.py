"""Files written whole or not at all."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from cardan.errors import refuse
from cardan.texts import _


def whole(path: Path, content: bytes) -> Path:
    """Write a file beside its place and move it there when it is complete.

    Parameters
    ----------
    path : path
        Where the file shall stand; a device or pipe is written directly.
    content : bytes
        What it shall hold.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    InputError
        It cannot be written there; nothing is left behind.
    """
    try:
        if path.exists() and not path.is_file():
            path.write_bytes(content)
            return path
        place = path.resolve()
        part = place.with_name(f".{place.name}.{os.getpid()}.part")
        try:
            part.write_bytes(content)
            os.replace(part, place)
        finally:
            with suppress(OSError):
                part.unlink()
    except OSError as error:
        reason = error.strerror or str(error)
        raise refuse("path", _("{path} cannot be written: {reason}").format(path=path, reason=reason)) from error
    return path
