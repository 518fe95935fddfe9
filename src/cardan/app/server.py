"""Starts the app: a server on this machine, a page for every visitor."""

from __future__ import annotations

import hashlib
import secrets
import socket
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from cardan.errors import InputError, refuse
from cardan.files import refusal
from cardan.later import later
from cardan.texts import _, language, mark

from .guard import LOCAL, VISITOR, Guard
from .state.choices import choices_of
from .state.jobs import Jobs
from .state.recordings import close_all
from .state.session import Session
from .state.workspace import Workspace

nicegui = later("nicegui", mark("the app needs NiceGUI: pip install 'cardan[app]'"))
pages = later("cardan.app.page")

PORT = 8321
"""Port that is tried first; any free one when it is taken and none was asked for."""


RECONNECT = 30.0
"""Seconds that a busy or sleeping browser may be silent without losing its page."""


@dataclass(frozen=True, kw_only=True)
class Start:
    """How the app starts."""

    folder: Path  # folder with the drive files: nothing outside it is read or written
    file: str = ""  # name of the file in it to open; empty to offer the examples
    # address to listen at; anything but this machine asks for a token and gives each visitor a folder of their own
    host: str = "127.0.0.1"
    port: int | None = None  # port to listen at; None for the usual or any free one
    show: bool = True  # open the browser

    @property
    def shared(self) -> bool:
        """Whether others than the user of this machine can reach it."""
        return self.host not in LOCAL


def start(how: Start) -> None:
    """Run the app until it is interrupted.

    how: where and with which file.
    Raises MissingExtraError: NiceGUI is not installed.
    """
    app, ui, page = nicegui().app, nicegui().ui, pages()
    if not how.folder.is_dir():
        raise refuse(str(how.folder), _("is not a folder"))
    if how.file:
        Workspace(how.folder).read(how.file)
    port, token = _port(how), secrets.token_urlsafe(24) if how.shared else ""
    jobs = Jobs()
    app.on_shutdown(jobs.close)
    app.on_shutdown(close_all)
    page.serve_files(app)

    @ui.page("/", title="cardan", favicon=page.ICON, response_timeout=20)  # type: ignore[untyped-decorator]
    def index(client: Any) -> None:
        session = _session(how, client.request)
        with session.speaking():
            page.build(session, jobs)

    app.add_middleware(Guard, names=() if how.shared else LOCAL, token=token, apart=how.shared)
    address = f"http://{'localhost' if how.host in ('0.0.0.0', '::') else how.host}:{port}/"
    told = address + (f"?token={token}" if token else "")
    print(_("cardan is at {address} - ctrl-C ends it").format(address=told), flush=True)
    try:
        with suppress(KeyboardInterrupt):  # how it is meant to end
            ui.run(
                host=how.host,
                port=port,
                title="cardan",
                reload=False,
                show=told if how.show else False,
                show_welcome_message=False,
                uvicorn_logging_level="error",
                reconnect_timeout=RECONNECT,
                tailwind=False,  # the page has its style of its own; the compiler would look at every change of it
                ws_per_message_deflate=how.shared,  # on one machine it costs more than it saves
            )
    finally:
        jobs.close()


def _session(how: Start, request: Any) -> Session:
    """Return a session for one window of a visitor."""
    kept = pages().kept_choices(request.cookies)
    choices = choices_of({"language": language(), **kept})
    folder = how.folder
    notice = ""
    if how.shared:
        folder = folder / "visitors" / _visitor(request)
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:  # what is not to be saved can still be worked on
            notice = f"{folder.name}: {refusal(error)}"
    session = Session(Workspace(folder), choices)
    session.notice = notice
    asked = request.query_params.get("file", "") or ("" if how.shared else how.file)
    example = request.query_params.get("example", "")
    try:
        if example:
            pages().open_example(session, example)
        elif asked:
            session.open(session.workspace.read(asked), asked)
    except InputError as error:
        session.notice = str(error)
    return session


def _visitor(request: Any) -> str:
    """Return the name of a visitor's own folder."""
    return hashlib.sha256(request.cookies[VISITOR].encode()).hexdigest()[:32]


def _port(how: Start) -> int:
    """Return the port to listen at."""
    for port in (how.port,) if how.port else (PORT, 0):
        with socket.socket(socket.AF_INET6 if ":" in how.host else socket.AF_INET) as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((how.host, port))
                return int(probe.getsockname()[1])
            except OSError as error:
                why = error.strerror or str(error)
    raise refuse("port", _("{port} at {host} cannot be used: {why}").format(port=how.port, host=how.host, why=why))
