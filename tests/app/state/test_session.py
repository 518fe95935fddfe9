"""What a user works on: text and drive in step, undo, files, two users apart."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from cardan.app.state.document import DEPTH, History, Workspace, read
from cardan.app.state.session import Choices, Session, choices_of
from cardan.errors import InputError
from cardan.files import Enclosed
from cardan.io import dumps, example, example_text
from cardan.io.amend import amend
from cardan.reading.limits import MAX_BYTES
from cardan.texts import language, speaking


@pytest.fixture
def session(tmp_path: Path) -> Session:
    made = Session(Workspace(tmp_path))
    made.open(example_text("two-piece-rear-drive"), saved=False)
    return made


def test_an_edit_reaches_text_and_drive_and_all_who_listen(session: Session) -> None:
    heard: list[str] = []
    for change in ("text", "drive", "file"):
        session.listen(change, lambda change=change: heard.append(change))  # type: ignore[misc]
    session.change(lambda text: amend(text, {"joints[1].centre_mm": [650, 1, -30]}))
    assert heard == ["text", "drive", "file"]
    assert session.drive is not None
    assert session.drive.joints[1].centre == pytest.approx((0.65, 0.001, -0.03))
    assert not session.saved


def test_what_the_user_waits_for_comes_first_and_the_rest_once_for_several_edits(session: Session) -> None:
    heard: list[str] = []
    waiting: list[Callable[[], None]] = []
    session.later = waiting.append
    session.listen("text", lambda: heard.append("form"))
    session.listen("drive", lambda: heard.append("scene"))
    session.listen("drive", lambda: heard.append("curves"), first=True)
    for y in (1, 2):
        session.change(lambda text, y=y: amend(text, {"joints[1].centre_mm": [650, y, -30]}))  # type: ignore[misc]
    session.change(lambda text: text.replace("[650, 2, -30]", "[650, 2]"))
    assert not session.document.valid
    assert heard == ["curves", "curves"]
    assert len(waiting) == 1
    waiting.pop()()
    assert heard == ["curves", "curves", "form", "scene"]
    session.undo()
    assert len(waiting) == 1


def test_a_wrong_edit_keeps_the_last_sound_drive_and_tells_the_loaders_words(session: Session) -> None:
    before = session.drive
    session.change(lambda text: amend(text, {"joints[1].centre_mm": "far"}))
    assert session.drive is before
    assert not session.document.valid
    assert session.document.problems[0].field == "joints[1].centre_mm"
    session.undo()
    assert session.document.valid
    assert session.drive == before


def test_what_is_wrong_is_told_in_the_users_language_whatever_brought_it(session: Session) -> None:
    session.choose(language="ru")
    session.change(lambda text: amend(text, {"joints[1].centre_mm": "far"}))
    with speaking("ru"):
        told = read(session.document.text, session.workspace.enclosed).problems
    assert session.document.problems == told
    assert told != read(session.document.text, session.workspace.enclosed).problems
    session.undo()
    session.redo()
    assert session.document.problems == told
    session.open(session.document.text)
    assert session.document.problems == told
    session.choose(language="en")
    assert session.document.problems == read(session.document.text, session.workspace.enclosed).problems


def test_undo_and_redo_walk_through_every_text(session: Session) -> None:
    first = session.document.text
    texts = [first]
    for y in range(5):
        session.change(lambda text, y=y: amend(text, {"joints[1].centre_mm": [600, y + 1, -30]}))  # type: ignore[misc]
        texts.append(session.document.text)
    for text in reversed(texts[:-1]):
        session.undo()
        assert session.document.text == text
    session.undo()
    assert session.document.text == first
    for text in texts[1:]:
        session.redo()
        assert session.document.text == text
    session.redo()
    assert session.document.text == texts[-1]


def test_a_gesture_is_one_step(session: Session) -> None:
    first = session.document.text
    for y in range(9):
        change = lambda text, y=y: amend(text, {"joints[1].centre_mm": [600, y, -30]})  # noqa: E731
        session.change(change, gesture="drag joints[1]")
    session.end_gesture()
    session.change(lambda text: amend(text, {"joints[1].centre_mm": [600, 50, -30]}), gesture="drag joints[1]")
    session.undo()
    assert "[600, 8, -30]" in session.document.text
    session.undo()
    assert session.document.text == first


def test_history_forgets_the_oldest_and_what_was_undone() -> None:
    history = History()
    for k in range(DEPTH + 10):
        history = history.after(str(k))
    assert len(history.before) == DEPTH
    text, history = history.undone("now")
    assert history.behind == ("now",)
    assert history.after(text).behind == ()


def test_history_of_long_texts_keeps_within_its_room() -> None:
    history = History()
    for _step in range(50):
        history = history.after("x" * 1_900_000)
    assert 1 <= len(history.before) <= 10


def test_saving_writes_into_the_workspace_alone(session: Session, tmp_path: Path) -> None:
    session.save("mine")
    assert (tmp_path / "mine.toml").read_text("utf-8") == session.document.text
    assert session.saved
    assert session.name == "mine.toml"
    for name in ("../out", "/tmp/out", ".hidden", "a/b", "a\\b", "", "x\x00y", "con:1"):
        with pytest.raises(InputError):
            Session(session.workspace).save(name)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["mine.toml"]


def test_links_out_of_the_workspace_are_not_followed(tmp_path: Path) -> None:
    (tmp_path / "secret.toml").write_text("format = 1")
    inner = tmp_path / "inner"
    inner.mkdir()
    (inner / "link.toml").symlink_to(tmp_path / "secret.toml")
    with pytest.raises(InputError, match="leads out"):
        Workspace(inner).read("link.toml")
    with pytest.raises(InputError, match="leads out"):
        Workspace(inner).write("link.toml", "x")


def test_files_of_the_folder_come_newest_first(tmp_path: Path) -> None:
    import os

    for k, name in enumerate(("old.toml", "new.toml", "note.txt", ".hidden.toml")):
        (tmp_path / name).write_text("x")
        os.utime(tmp_path / name, (k, k))
    assert Workspace(tmp_path).names() == ("new.toml", "old.toml")


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.toml", b"x" * (MAX_BYTES + 1), "2000001 bytes given; the limit is 2000000"),
        ("a.toml", b"\xff\xfe\x00", "not UTF-8"),
        ("a.toml", b"[[joints]\n", "TOML"),
        ("a.json", b"{", "JSON"),
        ("a.json", b'{"format": 1}', "joints"),
    ],
)
def test_bad_uploads_are_refused_and_leave_the_drive(session: Session, name: str, content: bytes, words: str) -> None:
    before = session.document
    with pytest.raises(InputError, match=words):
        session.take(name, content)
    assert session.document is before


def test_a_drive_in_json_is_taken_as_toml(session: Session) -> None:
    drive = example("z-arrangement")
    session.take("z.json", dumps(drive, form="json").encode())
    assert session.drive == drive
    assert session.document.text.startswith("format = 1")


def test_a_file_with_faults_is_taken_with_its_faults_told(session: Session) -> None:
    session.take("a.toml", b"format = 1\n[[joints]]\njoint_angle_deg = 95\nspeed = 3\n")
    assert session.drive is None
    assert len(session.document.problems) == 2


def test_files_beside_the_workspace_are_not_read(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text("secret")
    inner = tmp_path / "inner"
    inner.mkdir()
    found = read(
        'format = 1\nsettings.catalogues = ["../own.toml"]\n[[joints]]\njoint_angle_deg = 20\n', Enclosed(inner)
    )
    assert "leads out" in found.problems[0].message
    assert "secret" not in str(found.problems)


def test_two_users_do_not_see_each_other(tmp_path: Path) -> None:
    one, two = Session(Workspace(tmp_path)), Session(Workspace(tmp_path))
    one.open(example_text("z-arrangement"), saved=False)
    two.open(example_text("w-arrangement"), saved=False)
    one.choose(language="ru")
    one.change(lambda text: amend(text, {"duty.speed_rpm": 777}))
    assert "777" not in two.document.text
    assert two.choices.language == "en"
    heard: list[str] = []
    one.listen("drive", lambda: heard.append(language()))
    two.listen("drive", lambda: heard.append(language()))
    one.undo()
    two.change(lambda text: amend(text, {"duty.speed_rpm": 778}))
    assert heard == ["ru", "en"]


def test_choices_survive_as_plain_data_and_nonsense_is_dropped() -> None:
    chosen = Choices(language="ru", units={"length": "in"}, decimal=",", theme="dark")
    assert choices_of(json.loads(json.dumps(chosen.kept()))) == chosen
    assert choices_of({"language": "xx", "units": {"length": "deg", 1: 2}, "decimal": ";", "more": 1}) == Choices()
    assert choices_of({"units": 5, "theme": []}) == Choices()


def test_nonsense_kept_by_a_browser_is_dropped_whatever_its_sort() -> None:
    assert choices_of({"language": [], "units": {"length": []}, "decimal": {}}) == Choices()


def test_names_of_files_that_no_system_takes_are_told(tmp_path: Path) -> None:
    (tmp_path / "circle").symlink_to(tmp_path / "circle")
    for name in ("a\\u0000b", "circle"):
        text = f'format = 1\nsettings.catalogues = ["{name}"]\n[[joints]]\njoint_angle_deg = 20\n'
        assert not read(text, Enclosed(tmp_path)).valid


def test_undo_ends_a_gesture(session: Session) -> None:
    def dragged(y: int) -> None:
        session.change(lambda text: amend(text, {"joints[1].centre_mm": [600, y, -30]}), gesture="drag")

    first = session.document.text
    dragged(1)
    dragged(2)
    session.undo()
    dragged(3)
    assert session.history.behind == ()
    session.undo()
    assert session.document.text == first


def test_a_text_all_deleted_can_be_undone(session: Session) -> None:
    first = session.document.text
    session.rewrite("")
    assert not session.empty
    session.undo()
    assert session.document.text == first
    session.open("", saved=False)
    assert session.empty


def test_a_part_that_fails_keeps_nothing_from_the_others(session: Session) -> None:
    heard: list[str] = []

    def failing() -> None:
        raise ZeroDivisionError

    session.listen("text", failing)
    session.listen("text", lambda: heard.append("text"))
    with pytest.raises(ZeroDivisionError):
        session.change(lambda text: amend(text, {"duty.speed_rpm": 777}))
    assert heard == ["text"]
