"""Writing a file as a whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from cardan.errors import refuse
from cardan.texts import _


def write_text(path: Path, text: str) -> None:
    """Write a text file; a failure leaves what was there before.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    write_bytes(path, text.encode("utf-8"))


def write_bytes(path: Path, content: bytes) -> None:
    """Write a file; a failure leaves what was there before.

    Raises
    ------
    InputError
        The file cannot be written.
    """
    temporary: str | None = None
    try:
        path = path.resolve()  # through a link: the file is replaced, the link stays
        if path.exists() and not path.is_file():
            with path.open("wb") as stream:  # a device such as /dev/stdout
                stream.write(content)
            return
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
        mode = path.stat().st_mode & 0o777 if path.exists() else 0o666 & ~_umask()
        os.chmod(temporary, mode)
        os.replace(temporary, path)
        temporary = None
    except OSError as error:
        raise refuse(str(path), _("cannot be written: {why}").format(why=error.strerror or error)) from None
    finally:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
