"""Variants kept side by side."""

from __future__ import annotations

from pathlib import Path

import pytest

from cardan.app.state.document import Workspace
from cardan.app.state.session import Session
from cardan.app.state.variants import LONGEST, MOST, Variants
from cardan.errors import InputError
from cardan.io import example, example_text
from cardan.io.amend import amend

TEXT = example_text("z-arrangement")
DRIVE = example("z-arrangement")


def kept(*names: str) -> Variants:
    found = Variants()
    for name in names:
        found = found.keeping(name, f"{TEXT}# {name}", DRIVE)
    return found


def test_names_are_proposed_until_one_is_free() -> None:
    assert Variants().free_name() == "variant 1"
    assert kept("variant 2").free_name() == "variant 3"


def test_the_same_name_takes_the_place() -> None:
    found = kept("a", "b").keeping(" a ", "other", DRIVE)
    assert found.names == ("a", "b")
    assert found.named("a").text == "other"


def test_there_is_an_end_of_keeping() -> None:
    full = kept(*map(str, range(MOST)))
    assert full.full
    with pytest.raises(InputError, match="at most 12"):
        full.keeping("one more", TEXT, DRIVE)
    assert len(full.keeping("3", TEXT, DRIVE)) == MOST
    assert len(full.without("3")) == MOST - 1


@pytest.mark.parametrize(("new", "why"), [("", "needs a name"), ("x" * (LONGEST + 1), "at most"), ("b", "another")])
def test_a_name_is_refused_where_it_tells_nothing_apart(new: str, why: str) -> None:
    with pytest.raises(InputError, match=why):
        kept("a", "b").renaming("a", new)


def test_renaming_keeps_the_order() -> None:
    assert kept("a", "b", "c").renaming("b", "x  y").names == ("a", "x y", "c")
    with pytest.raises(InputError, match="no variant"):
        kept("a").renaming("z", "y")


def test_what_is_worked_on_is_compared_too_unless_it_is_kept() -> None:
    found = kept("a", "now")
    assert [name for name, _drive in found.compared(TEXT, DRIVE)] == ["now*", "a", "now"]
    assert [name for name, _drive in found.compared(f"{TEXT}# a", DRIVE)] == ["a", "now"]
    assert [name for name, _drive in found.compared("broken", None)] == ["a", "now"]


def test_a_session_keeps_them_over_files_and_tells_of_them(tmp_path: Path) -> None:
    session, heard = Session(Workspace(tmp_path)), []
    session.open(TEXT, saved=False)
    session.listen("variants", lambda: heard.append(len(session.variants)))
    session.keep(session.variants.keeping("as built", session.document.text, DRIVE))
    session.change(lambda text: amend(text, {"duty.speed_rpm": 800}))
    assert session.variants.of_text(session.document.text) is None
    session.rewrite(session.variants.named("as built").text)
    assert session.variants.of_text(session.document.text) is not None
    session.undo()
    assert "800" in session.document.text
    session.open(example_text("pto-hitch"), saved=False)
    assert session.variants.names == ("as built",)
    assert heard == [1]
    assert not Session(Workspace(tmp_path)).variants.names
