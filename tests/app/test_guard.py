"""Who may speak to the server."""

from __future__ import annotations

import asyncio
import logging
from typing import Any

import pytest
from anyio import EndOfStream

from cardan.app.server import COOKIE, HEADS, VISITOR, Guard


async def _inner(scope: Any, _receive: Any, send: Any) -> None:
    seen = dict(scope["headers"]).get(b"cookie", b"")
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": seen})


def sent_by(
    guard: Guard, *, query: str = "", kind: str = "http", method: str = "GET", path: str = "/", **headers: str
) -> list[dict[str, Any]]:
    """Return the messages of an answer."""
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
    return sent


def started(guard: Guard, **how: str) -> dict[str, Any]:
    """Return the start of an answer."""
    return sent_by(guard, **how)[0]


def ask(guard: Guard, **how: str) -> tuple[int, list[str], str]:
    """Return status, cookies set and body of an answer."""
    sent = sent_by(guard, **how)
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
    assert status == 303
    assert cookies == [f"{COOKIE}=s3cret; Path=/; HttpOnly; SameSite=Strict"]
    assert ask(guard, cookie=f"{COOKIE}=s3cret")[0] == 200


@pytest.mark.parametrize(
    ("path", "query", "there"),
    [
        ("/", "token=t", "/"),
        ("/", "token=t&file=a%26b.toml&example=", "/?file=a%26b.toml&example="),
        ("//evil.example", "token=t", "/evil.example"),
        ("/\\evil.example\r\nx: y", "token=t", "/evil.example%0D%0Ax%3A%20y"),
    ],
)
def test_the_token_is_taken_out_of_the_address_at_once(path: str, query: str, there: str) -> None:
    guard = Guard(_inner, token="t")
    heads = dict(started(guard, path=path, query=query)["headers"])
    assert heads[b"location"].decode() == there
    assert b"refresh" not in heads
    across = started(guard, path=path, query=query, **{"sec-fetch-site": "cross-site"})
    heads = dict(across["headers"])  # a link elsewhere: the browser goes on from a page of ours, with its cookie
    assert across["status"] == 200
    assert heads[b"refresh"].decode() == f"0;url={there}"
    assert b"t" not in heads[b"refresh"].partition(b"=")[2].split(b"&")


@pytest.mark.parametrize(
    ("site", "status"), [("none", 200), ("same-origin", 200), ("same-site", 403), ("cross-site", 403)]
)
def test_other_sites_are_turned_away_whatever_they_know(site: str, status: int) -> None:
    guard = Guard(_inner, token="t", cookie="mine")
    for method in ("GET", "POST"):
        heads = {"cookie": "mine=t", "sec-fetch-site": site, "content-length": "1"}
        assert ask(guard, method=method, **heads)[0] == status
    assert ask(Guard(_inner), **{"sec-fetch-site": site})[0] == status
    if status == 403:
        assert ask(guard, kind="websocket", **{"cookie": "mine=t", "sec-fetch-site": site})[0] == 1008


def test_two_servers_of_a_machine_keep_their_cookies_apart() -> None:
    one, two = Guard(_inner, token="a", cookie="cardan_token_1"), Guard(_inner, token="b", cookie="cardan_token_2")
    both = "; ".join(ask(guard, query=f"token={guard.token}")[1][0].partition(";")[0] for guard in (one, two))
    assert [ask(guard, cookie=both)[0] for guard in (one, two)] == [200, 200]


def test_every_visitor_of_a_shared_server_gets_a_name() -> None:
    guard = Guard(_inner, names=(), token="t", apart=True)
    _status, cookies, seen = ask(guard, cookie=f"{COOKIE}=t")
    name = next(line for line in cookies if line.startswith(VISITOR)).partition(";")[0]
    assert name in seen
    other = ask(guard, cookie=f"{COOKIE}=t")[1]
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


@pytest.mark.parametrize(("host", "status"), [("localhost", 200), ("evil.example", 421)])
def test_every_answer_says_where_a_page_may_load_from_and_that_none_may_frame_it(host: str, status: int) -> None:
    start = started(Guard(_inner), host=host)
    assert start["status"] == status
    heads = dict(start["headers"])
    assert heads.items() >= dict(HEADS).items()
    policy = dict(part.split(" ", 1) for part in heads[b"content-security-policy"].decode().split("; "))
    assert policy["default-src"] == policy["connect-src"] == "'self'"
    assert policy["frame-ancestors"] == policy["object-src"] == policy["base-uri"] == "'none'"
    assert not any("*" in where or "http" in where for where in policy.values())
    assert heads[b"x-content-type-options"] == b"nosniff"
    assert heads[b"referrer-policy"] == b"same-origin"


@pytest.mark.parametrize("kept", ["[" * 100_000, '{"units":' * 50_000, "1" * 5000, "%ff", '"text"', "null"])
def test_a_cookie_that_makes_no_sense_is_left_at_the_defaults(kept: str) -> None:
    page = pytest.importorskip("cardan.app.page")
    assert page.kept_choices({page.CHOSEN: kept}) == {}


def _because(error: Exception, why: Exception) -> Exception:
    """Return an error with its reason, as where it is raised from that."""
    error.__cause__ = why
    return error


@pytest.mark.parametrize(
    ("message", "error", "told"),
    [
        ("http://127.0.0.1:8321/nowhere not found", None, False),
        ("Exception in ASGI application", ConnectionResetError(), False),
        (BrokenPipeError(), None, False),
        ("Exception in ASGI application", _because(RuntimeError("No response returned."), EndOfStream()), False),
        ("Exception in ASGI application", ValueError(), True),
        (ValueError("of ours"), None, True),
    ],
)
def test_the_log_tells_faults_but_no_browser_that_left(message: Any, error: Any, told: bool) -> None:
    page = pytest.importorskip("cardan.app.page")
    info = (type(error), error, None) if error else None
    record = logging.LogRecord("nicegui", logging.ERROR, __file__, 1, message, (), info)
    assert page.worth_telling(record) is told
