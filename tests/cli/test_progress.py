"""The bar: on a terminal, after two seconds, and never in the way."""

import io
import threading
from types import SimpleNamespace

import pytest

from cardan.cli.shared import progress


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def terminal(monkeypatch):
    stream = Terminal()
    monkeypatch.setattr(progress, "sys", SimpleNamespace(stderr=stream))
    return stream


def test_short_work_shows_nothing(terminal):
    with progress.watching("thinking") as tell:
        tell(0.5)
    assert terminal.getvalue() == ""


@pytest.mark.parametrize("told", [True, False])
def test_long_work_shows_a_bar(terminal, monkeypatch, told):
    shown = threading.Event()
    begin = progress._Bar.begin

    def noticed(bar):
        begin(bar)
        shown.set()

    monkeypatch.setattr(progress._Bar, "begin", noticed)
    monkeypatch.setattr(progress, "PATIENCE", 0.0)
    with progress.watching("thinking") as tell:
        if told:
            tell(0.25)
        assert shown.wait(30)
        if told:
            tell(2.0)
    assert "thinking" in terminal.getvalue()


def test_without_a_terminal_there_is_no_bar(monkeypatch):
    stream = io.StringIO()
    monkeypatch.setattr(progress, "sys", SimpleNamespace(stderr=stream))
    monkeypatch.setattr(progress, "PATIENCE", 0.0)
    with progress.watching("thinking") as tell:
        tell(0.5)
    assert stream.getvalue() == ""


def test_an_error_ends_the_bar(terminal):
    with pytest.raises(KeyError), progress.watching("thinking"):
        raise KeyError
    assert threading.active_count() < 10
