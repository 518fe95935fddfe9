"""Starts the app: a server on this machine, a page for every visitor."""

from __future__ import annotations

import asyncio
import gc
import hashlib
import logging
import secrets
import socket
from collections.abc import Hashable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias
from urllib.parse import parse_qs, parse_qsl, quote, urlencode, urlsplit

from cardan.errors import InputError, refuse
from cardan.files import refusal
from cardan.io import starter
from cardan.later import later
from cardan.texts import _, language, mark

from .state.document import Workspace
from .state.jobs import Jobs
from .state.kept import Keeper, asked_place, unpacked
from .state.recordings import close_all
from .state.session import Session, choices_of

nicegui = later("nicegui", mark("the app needs NiceGUI: pip install 'cardan[app]'"))
pages = later("cardan.app.page")

PORT = 8321  # port that is tried first; any free one when it is taken and none was asked for


RECONNECT = 300.0  # seconds that a busy or sleeping browser may be silent without losing its page
CONNECT = 60.0  # seconds that a browser may take until it shows the page


@dataclass(frozen=True, kw_only=True)
class Start:
    """How the app starts."""

    folder: Path  # folder with the drive files: nothing outside it is read or written
    file: str = ""  # name of the file in it to open; empty to offer the examples
    # address to listen at; anything but this machine gives each visitor a folder of their own
    host: str = "127.0.0.1"
    port: int | None = None  # port to listen at; None for the usual or any free one
    show: bool = True  # open the browser

    @property
    def shared(self) -> bool:
        """Whether others than the user of this machine can reach it."""
        return self.host not in LOCAL


def start(how: Start) -> None:
    """Run the app until it is interrupted."""
    app, ui, page = nicegui().app, nicegui().ui, pages()
    if not how.folder.is_dir():
        raise refuse(str(how.folder), _("is not a folder"))
    if how.file:
        Workspace(how.folder).read(how.file)
    port, token = _port(how), secrets.token_urlsafe(24)
    jobs = Jobs()
    app.on_startup(gc.freeze)  # what every page needs is looked through no more, which would hold all of them up
    app.on_shutdown(jobs.close)
    app.on_shutdown(close_all)
    page.serve_files(app)
    app.config.quasar_config["loadingBar"]["skipHijack"] = True  # a bar without a name, at whatever the page fetches

    keeper = Keeper()

    @ui.page("/", title="cardan", favicon=page.ICON, response_timeout=20)  # type: ignore[untyped-decorator]
    async def index(client: Any) -> None:
        page.dress()
        await client.connected(CONNECT)
        session, window = await _session(how, client, keeper, jobs)
        if session.empty:
            await asyncio.to_thread(page.cards)  # once for all visitors; others need not wait for it
        with session.speaking():
            page.build(session, jobs, lambda kept: keeper.keep(window, kept))

    for name in ("nicegui", "uvicorn.error"):
        logging.getLogger(name).addFilter(page.worth_telling)
    names = () if how.shared else LOCAL
    app.add_middleware(Guard, names=names, token=token, cookie=f"{COOKIE}_{port}", apart=how.shared)
    address = f"http://{'localhost' if how.host in ('0.0.0.0', '::') else how.host}:{port}/"
    told = f"{address}?token={token}"
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


async def _session(how: Start, client: Any, keeper: Keeper, jobs: Jobs) -> tuple[Session, Hashable]:
    """Return a session for one window of a visitor, and by what the window is known when it comes back."""
    request = client.request
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
    session.apart = pages().Apart(session, jobs)
    window = (folder, client.tab_id)
    left = keeper.of(window) or unpacked(await pages().stored(), session.read)
    place = asked_place(request.query_params, "" if how.shared else how.file)
    try:
        if left is not None and left.place == place:
            session.resume(left)
        else:
            _open(session, *place)
    except InputError as error:
        session.notice = str(error)
    return session, window


def _open(session: Session, what: str, name: str) -> None:
    """Open what an address names."""
    if what == "example":
        pages().open_example(session, name)
    elif what == "file":
        session.open(session.workspace.read(name), name)
    elif what:
        session.open(starter(), saved=False)


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


# Who may speak to the server: it answers to its own names, to pages of its own, and to those who know its token.

COOKIE = "cardan_token"  # cookie with the token; cookies know no ports, so that of each server has its port behind it

VISITOR = "cardan_visitor"  # cookie that tells the visitors of a shared server apart
LOCAL = ("127.0.0.1", "localhost", "::1")  # names of this machine
OWN = ("none", "same-origin")  # where a browser may say that a request comes from: the user's hand, a page of ours
LARGEST = 4_000_000  # bytes of a request at most: a drive file of the largest size and what goes with it
LARGEST_SENT = 102_000_000  # the same of a request that sends a file: a recording of the largest size
SENT = "/_nicegui/client/"  # where NiceGUI takes the files that a page is sent

POLICY = {
    "default-src": "'self'",
    # NiceGUI starts its pages by scripts within them, and Vue makes functions of templates
    "script-src": "'self' 'unsafe-inline' 'unsafe-eval'",
    "style-src": "'self' 'unsafe-inline'",
    "img-src": "'self' data: blob:",  # plotly draws a picture to be saved by way of a blob
    "font-src": "'self' data:",
    "connect-src": "'self'",
    "object-src": "'none'",
    "base-uri": "'none'",
    "form-action": "'self'",
    "frame-ancestors": "'none'",
}
"""Where a page may load from and send to: here alone, so that nothing of a drive leaves; and no page may frame it."""

HEADS = [
    (b"content-security-policy", "; ".join(f"{what} {where}" for what, where in POLICY.items()).encode()),
    (b"x-content-type-options", b"nosniff"),
    (b"referrer-policy", b"same-origin"),  # an address may hold the token
]

App: TypeAlias = Any


@dataclass(frozen=True)
class Guard:
    """A layer before the pages that turns strangers away.

    A page elsewhere could send a browser here under another name, from another origin or from another site; all are
    refused. The token comes once in the address, which is left at once, and then in a cookie that scripts cannot read:
    other accounts of the machine reach the port too.
    """

    app: App  # what answers to those let in
    names: tuple[str, ...] = LOCAL  # names under which the server may be asked; any when empty
    token: str = ""  # what a visitor must know; nothing when empty
    cookie: str = COOKIE  # name of the cookie that holds it
    apart: bool = False  # give every visitor a name of their own, in a cookie

    async def __call__(self, scope: Mapping[str, Any], receive: Any, send: Any) -> None:
        """Let a request through or answer it with a refusal."""
        if scope["type"] not in ("http", "websocket"):
            await self.app(scope, receive, send)
            return
        headers = {name.decode("latin-1"): value.decode("latin-1") for name, value in scope["headers"]}
        if not self._named(headers) or not self._same_origin(headers):
            await _refused(scope, send, 421, "This address does not lead to cardan.")
            return
        known, fresh = self._knows(scope, headers)
        if not known:
            await _refused(scope, send, 401, "Open cardan by the address that it printed, token included.")
            return
        across = headers.get("sec-fetch-site", "none") not in OWN
        if fresh and scope["type"] == "http" and scope["method"] in ("GET", "HEAD"):
            await _led_on(scope, _heading(send, {self.cookie: self.token}), across=across)
            return
        if across:
            await _refused(scope, send, 403, "Another site may not lead here. Open cardan by its address.")
            return
        cookies: dict[str, str] = {}
        if not _small(scope, headers):
            await _refused(scope, send, 413, "This is more than a drive file or a recording.")
            return
        if self.apart and VISITOR not in cookies_of(headers):
            cookies[VISITOR] = secrets.token_urlsafe(24)
            told = "; ".join([*filter(None, [headers.get("cookie")]), f"{VISITOR}={cookies[VISITOR]}"])
            rest = [pair for pair in scope["headers"] if pair[0] != b"cookie"]
            scope = {**scope, "headers": [*rest, (b"cookie", told.encode())]}
        await self.app(scope, receive, _heading(send, cookies))

    def _named(self, headers: Mapping[str, str]) -> bool:
        try:
            host = urlsplit(f"//{headers.get('host', '')}").hostname
        except ValueError:
            return False
        return not self.names or host in self.names

    def _same_origin(self, headers: Mapping[str, str]) -> bool:
        origin = headers.get("origin")
        return origin is None or origin.partition("://")[2] == headers.get("host")

    def _knows(self, scope: Mapping[str, Any], headers: Mapping[str, str]) -> tuple[bool, bool]:
        """Return whether the visitor knows the token, and whether it came in the address."""
        if not self.token:
            return True, False
        asked = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [""])[0]
        if secrets.compare_digest(asked.encode(), self.token.encode()):
            return True, True
        held = cookies_of(headers).get(self.cookie, "")
        return secrets.compare_digest(held.encode(), self.token.encode()), False


def cookies_of(headers: Mapping[str, str]) -> dict[str, str]:
    """Return the cookies of a request; one that another server of this machine spoilt hides no other."""
    pairs = (part.partition("=") for part in headers.get("cookie", "").split(";"))
    return {name.strip(): value.strip() for name, _sign, value in pairs}


def _small(scope: Mapping[str, Any], headers: Mapping[str, str]) -> bool:
    """Tell whether a request says that it is no larger than we take."""
    if scope["type"] == "websocket" or scope.get("method") in ("GET", "HEAD", None):
        return True
    length = headers.get("content-length", "")
    sends = str(scope.get("path", "")).startswith(SENT) and "/upload/" in str(scope.get("path", ""))
    return length.isascii() and length.isdigit() and int(length[:12]) <= (LARGEST_SENT if sends else LARGEST)


def _heading(send: Any, cookies: Mapping[str, str]) -> Any:
    """Return what sends an answer on with the heads of all answers, and cookies that scripts cannot read."""
    lines = [f"{name}={value}; Path=/; HttpOnly; SameSite=Strict" for name, value in cookies.items()]
    added = [*HEADS, *((b"set-cookie", line.encode()) for line in lines)]

    async def sent(message: dict[str, Any]) -> None:
        if message["type"] == "http.response.start":
            message = {**message, "headers": [*message.get("headers", []), *added]}
        await send(message)

    return sent


async def _led_on(scope: Mapping[str, Any], send: Any, *, across: bool) -> None:
    """Lead a visitor on to the same address without the token.

    across: whether a link of another site led here. Browsers count what it redirects to as of that site too, and send
    no strict cookie; a page of ours that goes on by itself is of our own.
    """
    asked = parse_qsl(scope.get("query_string", b"").decode("latin-1"), keep_blank_values=True)
    rest = urlencode([pair for pair in asked if pair[0] != "token"])
    there = scope["path"].lstrip("/\\")  # two slashes would lead to another server
    address = f"/{quote(there)}{'?' if rest else ''}{rest}".encode()
    lead = (b"refresh", b"0;url=" + address) if across else (b"location", address)
    head = [lead, (b"cache-control", b"no-store"), (b"content-type", b"text/html; charset=utf-8")]
    await send({"type": "http.response.start", "status": 200 if across else 303, "headers": head})
    await send({"type": "http.response.body", "body": b""})


async def _refused(scope: Mapping[str, Any], send: Any, status: int, text: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008})
        return
    head = [*HEADS, (b"content-type", b"text/plain; charset=utf-8")]
    await send({"type": "http.response.start", "status": status, "headers": head})
    await send({"type": "http.response.body", "body": text.encode()})
