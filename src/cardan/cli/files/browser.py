"""``cardan app``: the drive turning in the browser."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cardan.app.server import Start, start
from cardan.cli.shared.failure import about
from cardan.cli.shared.options import argument, flag, option
from cardan.texts import _


def browser(
    file: Annotated[Path | None, argument("[FILE]", _("Drive file to open; examples are offered without."))] = None,
    host: Annotated[
        str,
        option("--host", "ADDRESS", _("Address to listen at; at others than this machine every visitor has a folder.")),
    ] = "127.0.0.1",
    port: Annotated[
        int | None,
        option("--port", "PORT", _("Port to listen at; 8321 or any free one when not given."), min=1, max=65535),
    ] = None,
    no_browser: Annotated[bool, flag("--no-browser", _("Print the address and open nothing."))] = False,
) -> int:
    """Open the app in the browser."""
    there = (file or Path.cwd()).resolve()
    folder, name = (there, "") if there.is_dir() else (there.parent, there.name)
    with about(str(file or folder)):
        start(Start(folder=folder, file=name, host=host, port=port, show=not no_browser))
    return 0
