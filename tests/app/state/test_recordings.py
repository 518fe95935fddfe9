"""The recording of a user: opened, sent, told more of, judged, and seen by nobody else."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from cardan.app.state.document import Workspace
from cardan.app.state.question import asked
from cardan.app.state.recordings import DIAGNOSIS, MAX_RECORDING
from cardan.app.state.session import Session
from cardan.app.state.work import result
from cardan.errors import InputError
from cardan.io import example, example_text
from cardan.io.signals import write
from cardan.recordings import TestSchedule, simulate_fault
from cardan.report.recorded import Recorded

DRIVE = "truck-supports"
SHORT = TestSchedule(run_up=4.0, hold=1.5, rate=500.0)


@pytest.fixture(scope="module")
def content(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("made") / "made.csv"
    write(simulate_fault(example(DRIVE), "unbalance", severity=2.0, seed=4, runs=SHORT), path)
    return path.read_bytes()


@pytest.fixture
def session(tmp_path: Path) -> Session:
    made = Session(Workspace(tmp_path))
    made.open(example_text(DRIVE), saved=False)
    return made


def send(session: Session, name: str, content: bytes) -> Path:
    place = session.recordings.room(name)
    place.write_bytes(content)
    session.recordings.take(name, place)
    return place


def judged(session: Session) -> Recorded:
    question = asked(session, DIAGNOSIS, recording=session.recordings.opened)
    assert question is not None
    found = result(question)
    assert isinstance(found, Recorded)
    return found


@pytest.mark.slow
def test_a_recording_sent_is_judged_in_the_users_language_and_more_can_be_said_of_it(
    session: Session, content: bytes
) -> None:
    send(session, "run 1.csv", content)
    found = judged(session)
    assert "unbalance" in found.page.answer
    assert found.page.title == "Diagnosis of run 1.csv"
    assert found.tacho == "tacho"
    assert [one.name for one in found.sensors if one.turns] == ["tacho", "output speed"]
    first = asked(session, DIAGNOSIS, recording=session.recordings.opened)
    session.recordings.say(channel="input axial", places=(("input radial", "supports[0]", "z"),))
    more = judged(session)
    assert [(one.place, one.direction) for one in more.sensors if one.name == "input radial"] == [("supports[0]", "z")]
    second = asked(session, DIAGNOSIS, recording=session.recordings.opened)
    assert first is not None
    assert second is not None
    assert first.key != second.key
    session.choose(language="ru")
    assert "unbalance" not in judged(session).page.answer


def test_what_is_sent_is_nobody_elses_and_goes_with_its_session(
    session: Session, content: bytes, tmp_path: Path
) -> None:
    other = Session(Workspace(tmp_path))
    place = send(session, "../../run.csv", content)
    assert place.name == "run.csv"
    assert not place.is_relative_to(tmp_path)
    if os.name == "posix":
        assert place.parent.stat().st_mode & 0o077 == 0
    assert other.recordings.opened is None
    assert other.recordings.names() == ()
    later = send(session, "later.csv", content)
    assert not place.exists()
    session.recordings.close()
    assert not later.parent.exists()
    assert session.recordings.opened is None


def test_recordings_of_the_folder_are_offered_and_none_outside_of_it(
    session: Session, content: bytes, tmp_path: Path
) -> None:
    for name in ("one.csv", "two.wav", "drive.toml", ".hidden.csv"):
        (tmp_path / name).write_bytes(content)
    assert set(session.recordings.names()) == {"one.csv", "two.wav"}
    session.recordings.open("one.csv")
    before = session.recordings.opened
    for name in ("../one.csv", "gone.csv", ""):
        with pytest.raises(InputError):
            session.recordings.open(name)
    assert session.recordings.opened is before
    (tmp_path / "one.csv").write_bytes(content[:-100])
    session.recordings.open("one.csv")
    assert session.recordings.opened != before


def test_one_that_is_too_large_or_broken_leaves_the_rest_as_it_was(session: Session, content: bytes) -> None:
    sound = send(session, "sound.csv", content)
    place = session.recordings.room("huge.csv")
    with place.open("wb") as stream:
        stream.truncate(MAX_RECORDING + 1)
    with pytest.raises(InputError, match="larger than 100 MB"):
        session.recordings.take("huge.csv", place)
    assert not place.exists()
    assert sound.exists()
    for name, broken in (("empty.csv", b""), ("photo.wav", b"\x89PNG\r\n\x1a\n"), ("run.exe", content), ("x", b"x")):
        send(session, name, broken)
        with pytest.raises(InputError):
            judged(session)


def test_one_without_vibration_says_why_it_cannot_be_judged(session: Session) -> None:
    rows = ["time_s,tacho"] + [f"{k / 500},{int(k % 25 < 5)}" for k in range(2000)]
    send(session, "tacho.csv", "\n".join(rows).encode())
    found = judged(session)
    assert "cannot be judged" in found.page.answer
    assert "vibration" in found.page.alarms[0].text
    assert found.tacho == "tacho"
