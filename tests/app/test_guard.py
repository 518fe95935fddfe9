"""Who may speak to the server."""

from __future__ import annotations

import asyncio
from typing import Any

import pytest

from cardan.app.server import COOKIE, VISITOR, Guard


async def _inner(scope: Any, _receive: Any, send: Any) -> None:
    seen = dict(scope["headers"]).get(b"cookie", b"")
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": seen})


def ask(
    guard: Guard, *, query: str = "", kind: str = "http", method: str = "GET", path: str = "/", **headers: str
) -> tuple[int, list[str], str]:
    """Return status, cookies set and body of an answer."""
    given = {"host": "127.0.0.1:8321", **headers}
    scope = {
        "type": kind,
        "method": method,
        "path": path,
        "query_string": query.encode(),
        "headers": [(name.encode(), value.encode()) for name, value in given.items()],
    }
    sent: list[dict[str, Any]] = []

    async def send(message: dict[str, Any]) -> None:
        sent.append(message)

    asyncio.run(guard(scope, None, send))
    if sent[0]["type"] == "websocket.close":
        return sent[0]["code"], [], ""
    cookies = [value.decode() for name, value in sent[0]["headers"] if name == b"set-cookie"]
    return sent[0]["status"], cookies, sent[1]["body"].decode()


@pytest.mark.parametrize("host", ["127.0.0.1:8321", "localhost", "[::1]:8321"])
def test_this_machine_is_let_in(host: str) -> None:
    assert ask(Guard(_inner), host=host)[0] == 200


@pytest.mark.parametrize(
    "headers",
    [{"host": "evil.example"}, {"host": "127.0.0.1.evil.example"}, {"origin": "http://evil.example"}, {"host": ""}],
)
def test_other_names_and_other_origins_are_turned_away(headers: dict[str, str]) -> None:
    assert ask(Guard(_inner), **headers)[0] == 421
    assert ask(Guard(_inner), kind="websocket", **headers)[0] == 1008


def test_a_token_is_asked_for_and_then_remembered() -> None:
    guard = Guard(_inner, names=(), token="s3cret")
    assert ask(guard)[0] == 401
    assert ask(guard, query="token=wrong")[0] == 401
    assert ask(guard, cookie=f"{COOKIE}=wrong")[0] == 401
    assert ask(guard, kind="websocket")[0] == 1008
    status, cookies, _body = ask(guard, query="token=s3cret")
    assert status == 200
    assert cookies == [f"{COOKIE}=s3cret; Path=/; HttpOnly; SameSite=Strict"]
    assert ask(guard, cookie=f"{COOKIE}=s3cret")[0] == 200


def test_every_visitor_of_a_shared_server_gets_a_name() -> None:
    guard = Guard(_inner, names=(), token="t", apart=True)
    _status, cookies, seen = ask(guard, query="token=t")
    name = next(line for line in cookies if line.startswith(VISITOR)).partition(";")[0]
    assert name in seen
    other = ask(guard, query="token=t")[1]
    assert name not in "".join(other)
    assert ask(guard, cookie=f"{COOKIE}=t; {name}")[1] == []


def test_cookies_of_other_servers_of_the_machine_hide_no_token() -> None:
    guard = Guard(_inner, names=(), token="t", apart=True)
    assert ask(guard, cookie=f'odd:name={{"a": 1}}; {COOKIE}=t; {VISITOR}=me') == (
        200,
        [],
        f'odd:name={{"a": 1}}; {COOKIE}=t; {VISITOR}=me',
    )


@pytest.mark.parametrize(
    ("length", "status"), [("2000000", 200), ("900000000000", 413), ("9" * 5000, 413), ("-1", 413), ("", 413)]
)
def test_what_is_sent_is_limited_before_it_is_read(length: str, status: int) -> None:
    assert ask(Guard(_inner), method="POST", **{"content-length": length})[0] == status


@pytest.mark.parametrize(("length", "status"), [("100500000", 200), ("103000000", 413)])
def test_recordings_may_be_larger_where_files_are_sent(length: str, status: int) -> None:
    for path, found in (("/_nicegui/client/1/upload/2", status), ("/upload/", 413), ("/_nicegui/client/1", 413)):
        assert ask(Guard(_inner), method="POST", path=path, **{"content-length": length})[0] == found


def test_a_name_that_is_none_is_turned_away() -> None:
    assert ask(Guard(_inner), host="[::1")[0] == 421
    assert ask(Guard(_inner), origin="http://[::1")[0] == 421
