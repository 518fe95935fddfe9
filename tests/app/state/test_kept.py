"""What a window is kept by, and what saving does not write over."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from cardan.app.state.document import Workspace, heavy
from cardan.app.state.kept import LARGEST, MOST, ROOM, TOTAL, Keeper, Kept, asked_place, unpacked
from cardan.app.state.session import Session, Step
from cardan.errors import InputError
from cardan.io import example_names, example_text
from cardan.io.amend import amend

TEXT = example_text("two-piece-rear-drive")


@pytest.fixture
def session(tmp_path: Path) -> Session:
    made = Session(Workspace(tmp_path))
    made.open(TEXT, saved=False, example="two-piece-rear-drive")
    return made


def turned(session: Session, speed: float) -> None:
    session.change(lambda text: amend(text, {"duty.speed_rpm": speed}))


def test_what_is_packed_comes_back_with_history_and_variants(session: Session) -> None:
    turned(session, 1)
    turned(session, 2)
    assert session.drive is not None
    session.keep(session.variants.keeping("two", session.document.text, session.drive))
    turned(session, 3)
    session.undo()
    left = unpacked(session.kept().packed(), session.read)
    assert left is not None
    other = Session(session.workspace)
    other.resume(left)
    assert other.document.text == session.document.text
    assert other.history == session.history
    assert other.drive == session.drive
    assert [(one.name, one.text) for one in other.variants] == [(one.name, one.text) for one in session.variants]
    assert other.variants.named("two").drive == session.variants.named("two").drive
    assert (other.example, other.saved, other.losing) == ("two-piece-rear-drive", False, True)
    assert other.kept().place == ("example", "two-piece-rear-drive")


@pytest.mark.parametrize(
    "text",
    [
        "",
        "null",
        "[]",
        "{}",
        "[" * 100_000,
        '{"text": 5}',
        '{"variants": [], "text": "", "saved": 1}',
    ],
)
def test_what_makes_no_sense_is_not_taken_up(session: Session, text: str) -> None:
    assert unpacked(text, session.read) is None


def test_of_a_long_history_the_nearest_texts_go_into_the_browser(session: Session) -> None:
    long = "#" * (ROOM // 4)
    for k in range(9):
        session.rewrite(f"{TEXT}{long}{k}")
    told = json.loads(session.kept().packed())
    assert [text[-1] for text in told["before"]] == ["5", "6", "7"]
    session.rewrite("#" * (LARGEST + 1))
    assert session.kept().packed() == ""


def test_windows_used_last_are_kept() -> None:
    keeper = Keeper()
    for k in range(MOST + 5):
        keeper.keep(k, Kept(text=str(k)))
        keeper.keep(0, Kept(text="first"))
    assert keeper.of(1) is None
    assert [one.text for one in (keeper.of(0), keeper.of(MOST + 4)) if one] == ["first", str(MOST + 4)]
    keeper.keep("large", Kept(text="x" * TOTAL))
    assert keeper.of(0) is None
    assert keeper.of("large") is not None


def test_addresses_name_what_is_open() -> None:
    asked = [{}, {"file": "a.toml"}, {"file": ""}, {"example": "x"}, {"drive": "new"}]
    assert [asked_place(one, "own.toml") for one in asked] == [
        ("file", "own.toml"),
        ("file", "a.toml"),
        ("", ""),
        ("example", "x"),
        ("drive", "new"),
    ]
    assert asked_place({}, "") == ("", "")


def test_saving_writes_over_nothing_that_is_not_ours(session: Session, tmp_path: Path) -> None:
    mine = tmp_path / "mine.toml"
    mine.write_text("# another\n")
    assert session.obstacle("mine") == "another"
    with pytest.raises(InputError, match=r"mine.toml: another file"):
        session.save("mine")
    assert mine.read_text() == "# another\n"
    session.save("mine", over=True)
    assert mine.read_text("utf-8") == TEXT
    turned(session, 5)
    assert session.obstacle() == ""
    mine.write_text("# theirs\n")
    assert session.obstacle() == "changed"
    with pytest.raises(InputError):
        session.save()
    session.look()
    assert session.foreign == "# theirs\n"
    session.reload()
    assert (session.document.text, session.saved, session.foreign) == ("# theirs\n", True, None)
    session.undo()
    assert session.document.text != "# theirs\n"
    assert session.obstacle() == ""  # it is ours again: we have seen it
    session.save()
    assert session.workspace.free("mine") == "mine-2.toml"
    mine.write_bytes(b"\xff")
    assert session.obstacle() == "changed"
    mine.unlink()
    session.look()
    assert not session.saved
    assert session.obstacle() == ""


def test_a_file_that_is_touched_but_not_changed_is_ours(session: Session, tmp_path: Path) -> None:
    session.save("mine")
    heard: list[str] = []
    session.listen("file", lambda: heard.append(session.name))
    (tmp_path / "mine.toml").write_text(TEXT, "utf-8")
    session.look()
    assert (session.foreign, session.saved, heard) == (None, True, [])


def test_examples_are_light_and_what_would_keep_others_waiting_is_heavy() -> None:
    assert not any(heavy(example_text(name)) for name in example_names())
    joints = "[[joints]]\njoint_angle_deg = 5\n"
    assert heavy(f"format = 1\n{joints * 30}")
    assert heavy(f"format = 1\njoints = [{'{joint_angle_deg = 5}, ' * 30}]\n")
    assert heavy(f"format = 1\n{joints}# {'x' * 30_000}")


def test_steps_of_a_heavy_file_are_made_elsewhere_and_in_their_order(session: Session) -> None:
    class Steps(list[Step]):
        @property
        def busy(self) -> bool:
            return bool(self)

        def __call__(self, step: Step) -> None:
            self.append(step)

    session.apart = steps = Steps()
    stations = [f"[[stations]]\nshaft = 1\ninertia_kg_m2 = 0.{k + 1}\n" for k in range(40)]
    text = TEXT + "".join(stations)
    session.rewrite(text)
    turned(session, 7)
    session.undo()
    assert session.document.text == TEXT
    assert len(steps) == 3
    seen = []
    for step in steps:
        how, then = step()
        then(session.read(how(session.document.text)))
        seen.append(session.document.text)
    assert seen == [text, amend(text, {"duty.speed_rpm": 7}), text]
    assert session.history.behind == (seen[1],)
    assert session.drive is not None
    steps.clear()
    session.open(text)
    assert (session.drive, len(steps)) == (None, 1)
