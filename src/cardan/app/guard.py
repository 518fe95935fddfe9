"""Who may speak to the server: it answers to its own names, and where it can be reached from outside to a token."""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias
from urllib.parse import parse_qs, urlsplit

COOKIE = "cardan_token"

VISITOR = "cardan_visitor"
"""Cookie that tells the visitors of a shared server apart."""

LOCAL = ("127.0.0.1", "localhost", "::1")
"""Names of this machine that need no token."""

LARGEST = 4_000_000
"""Bytes of a request at most: a drive file of the largest size and what goes with it."""

LARGEST_SENT = 102_000_000
"""The same of a request that sends a file: a recording of the largest size."""

SENT = "/_nicegui/client/"
"""Where NiceGUI takes the files that a page is sent."""

App: TypeAlias = Any


@dataclass(frozen=True)
class Guard:
    """A layer before the pages that turns strangers away.

    A page elsewhere could send a browser here under another name or from another origin; both are refused. Where a
    token is asked for it comes once in the address and then in a cookie that scripts cannot read.
    """

    app: App  # what answers to those let in
    names: tuple[str, ...] = LOCAL  # names under which the server may be asked; any when empty
    token: str = ""  # what a visitor must know; nothing when empty
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
        cookies = {COOKIE: self.token} if fresh else {}
        if not _small(scope, headers):
            await _refused(scope, send, 413, "This is more than a drive file or a recording.")
            return
        if self.apart and VISITOR not in cookies_of(headers):
            cookies[VISITOR] = secrets.token_urlsafe(24)
            told = "; ".join([*filter(None, [headers.get("cookie")]), f"{VISITOR}={cookies[VISITOR]}"])
            rest = [pair for pair in scope["headers"] if pair[0] != b"cookie"]
            scope = {**scope, "headers": [*rest, (b"cookie", told.encode())]}
        await self.app(scope, receive, _remembering(send, cookies) if cookies else send)

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
        held = cookies_of(headers).get(COOKIE, "")
        return secrets.compare_digest(held.encode(), self.token.encode()), False


def cookies_of(headers: Mapping[str, str]) -> dict[str, str]:
    """Return the cookies of a request; one that another server of this machine spoilt hides no other.

    >>> cookies_of({"cookie": 'odd:name={"a": 1}; cardan_token=abc'})["cardan_token"]
    'abc'
    """
    pairs = (part.partition("=") for part in headers.get("cookie", "").split(";"))
    return {name.strip(): value.strip() for name, _sign, value in pairs}


def _small(scope: Mapping[str, Any], headers: Mapping[str, str]) -> bool:
    """Tell whether a request says that it is no larger than we take."""
    if scope["type"] == "websocket" or scope.get("method") in ("GET", "HEAD", None):
        return True
    length = headers.get("content-length", "")
    sends = str(scope.get("path", "")).startswith(SENT) and "/upload/" in str(scope.get("path", ""))
    return length.isascii() and length.isdigit() and int(length[:12]) <= (LARGEST_SENT if sends else LARGEST)


def _remembering(send: Any, cookies: Mapping[str, str]) -> Any:
    """Return what sends an answer on with cookies that scripts cannot read."""

    async def sent(message: dict[str, Any]) -> None:
        if message["type"] == "http.response.start":
            lines = [f"{name}={value}; Path=/; HttpOnly; SameSite=Strict" for name, value in cookies.items()]
            added = [(b"set-cookie", line.encode()) for line in lines]
            message = {**message, "headers": [*message.get("headers", []), *added]}
        await send(message)

    return sent


async def _refused(scope: Mapping[str, Any], send: Any, status: int, text: str) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008})
        return
    head = [(b"content-type", b"text/plain; charset=utf-8")]
    await send({"type": "http.response.start", "status": status, "headers": head})
    await send({"type": "http.response.body", "body": text.encode()})
