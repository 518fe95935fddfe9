"""Long answers in processes of their own: they are fair, they stop, they survive a crash, and none is left behind."""

import os
import signal
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from cardan.answers.reader import USUAL, Reader
from cardan.app.state.jobs import KEPT, Jobs
from cardan.app.state.question import Question, asked
from cardan.app.state.work import REMEDIES, VERDICTS, _answers, result
from cardan.drive.drive import Drive
from cardan.io import example
from cardan.report import answers
from cardan.report.block import Page, Table
from tests.app.works import Task, work

DRIVE = Drive.from_angles([0.3, 0.3])

WAIT = 300.0
"""Seconds after which a test gives up, on however busy a machine."""


def question(name, language="en", **choices):
    return Task(name=name, language=language, choices=choices)


def about(name, drive=DRIVE, language="en", **choices):
    return Question(name=name, drive=drive, folder=Path(), language=language, choices=choices)


def until(met):
    end = time.monotonic() + WAIT
    while not met():
        assert time.monotonic() < end, "nothing came"
        time.sleep(0.005)


def ended(job):
    until(lambda: job.finished)
    return job


def gone(pid):
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return True
    return False


@pytest.fixture(scope="module")
def jobs():
    """Return two workers for all tests here: each new process takes a second."""
    made = Jobs(2, made=work)
    yield made
    made.close()


@pytest.fixture(scope="module")
def one():
    """Return a single worker."""
    made = Jobs(1, made=work)
    yield made
    made.close()


@pytest.mark.slow
def test_an_answer_comes_in_the_language_of_the_question_and_is_that_made_here():
    jobs = Jobs(1)
    try:
        pages = [ended(jobs.ask(about("motion", language=code), code)).result for code in ("en", "ru")]
        found = ended(jobs.ask(about(REMEDIES, example("truck-power-unit")), 1)).result
    finally:
        jobs.close()
    assert all(isinstance(page, Page) for page in pages)
    assert [page.title for page in pages] == ["Motion", "Движение"]
    here = result(about("motion"))
    assert here.answer == pages[0].answer
    assert here.blocks[1] == pages[0].blocks[1]
    first, plain = result(about(VERDICTS, example("truck-power-unit")))
    assert (first.value, first.tone) == ("12.5 %", "plain")
    assert [light.title for light in found] == [light.title for light in plain]
    assert any(light.remedies for light in found)
    assert not any(light.remedies for light in plain)


def test_questions_are_the_same_when_all_that_matters_is():
    assert about("motion").key == about("motion", Drive.from_angles([0.3, 0.3])).key
    others = [about("phasing"), about("motion", language="ru"), about("motion", joint=2)]
    others.append(about("motion", Drive.from_angles([0.3, 0.31])))
    assert len({one.key for one in (about("motion"), *others)}) == 5


def test_a_catalogue_that_changed_makes_another_question(tmp_path):
    drive = replace(DRIVE, settings=replace(DRIVE.settings, catalogues=("own.toml", "../secret.toml")))
    asked_before = Question(name="check", drive=drive, folder=tmp_path)
    before = asked_before.key
    (tmp_path / "own.toml").write_text("")
    assert asked_before.key != before


@pytest.mark.slow
def test_an_answer_is_kept_until_something_of_the_question_changes(jobs):
    first = ended(jobs.ask(question("echo", a=1), "x"))
    again = jobs.ask(question("echo", a=1), "y")
    assert again.state == "done"
    assert again.result == first.result
    assert jobs.ask(question("echo", a=2), "y").key != first.key
    for k in range(KEPT):
        ended(jobs.ask(question("echo", b=k), "y"))
    assert jobs.ask(question("echo", a=1), "x").state == "waiting"


@pytest.mark.slow
def test_how_far_it_is_and_how_long_it_takes_yet(jobs):
    job = jobs.ask(question("slow", seconds=1.2), "x")
    assert job.left is None
    until(lambda: job.left is not None or job.finished)
    seen = job.left
    assert 0.0 < job.share < 1.0
    assert 0.0 < seen < 2.0
    assert ended(job).result == "done"
    assert job.share == 1.0
    assert job.left is None


@pytest.mark.slow
def test_a_job_stops_when_it_is_asked_to(jobs):
    job = jobs.ask(question("slow"), "x")
    until(lambda: job.state == "running" and job.share > 0.0)
    jobs.cancel(job)
    assert ended(job).state == "cancelled"
    assert ended(jobs.ask(question("slow", seconds=0.05), "x")).result == "done"


@pytest.mark.slow
def test_a_newer_question_ends_the_older_one_of_the_same_user_only(jobs):
    first, other = jobs.ask(question("slow", n=1), "x"), jobs.ask(question("slow", n=2), "y")
    until(lambda: first.state == other.state == "running")
    second = jobs.ask(question("slow", seconds=0.05), "x")
    assert ended(first).state == "cancelled"
    assert ended(second).result == "done"
    assert other.state == "running"
    jobs.leave("y")
    assert ended(other).state == "cancelled"


@pytest.mark.slow
def test_a_worker_that_does_not_listen_is_replaced(one, monkeypatch):
    monkeypatch.setattr("cardan.app.state.jobs.PATIENCE", 0.2)
    before = ended(one.ask(question("echo", n="before"), "x")).result[2]
    job = one.ask(question("deaf"), "x")
    until(lambda: job.state == "running")
    one.cancel(job)
    assert ended(job).state == "cancelled"
    after = ended(one.ask(question("echo", n="after"), "x")).result[2]
    assert gone(before)
    assert after != before


@pytest.mark.slow
@pytest.mark.parametrize(("language", "said"), [("en", "was ended from outside (code -9)"), ("ru", "-9")])
def test_a_worker_that_is_killed_says_so_and_the_next_goes_on(one, language, said):
    job = ended(one.ask(question("killed", language, again=language), "x"))
    assert job.state == "failed"
    assert said in job.message
    assert ended(one.ask(question("echo", after=language), "x")).state == "done"


@pytest.mark.slow
def test_a_worker_killed_while_it_waits_is_replaced(one):
    pid = ended(one.ask(question("echo", n="idle"), "x")).result[2]
    os.kill(pid, signal.SIGKILL)
    time.sleep(0.05)
    job = ended(one.ask(question("echo", n="idle again"), "x"))
    assert job.state == "done"
    assert job.result[2] != pid


@pytest.mark.slow
def test_what_goes_wrong_is_told_and_the_worker_lives(one):
    before = ended(one.ask(question("echo", n="alive"), "x")).result[2]
    assert ended(one.ask(question("refused"), "x")).message == "joints[0]: is none"
    assert "mistake in cardan itself: RuntimeError: what now" in ended(one.ask(question("broken"), "x")).message
    assert "mistake" in ended(one.ask(question("unsendable"), "x")).message
    assert ended(one.ask(question("echo", n="still"), "x")).result[2] == before


@pytest.mark.slow
def test_a_job_that_takes_too_long_is_given_up_and_the_next_goes_on(one):
    job = ended(one.ask(question("slow", limited=True), "x", limit=0.2))
    assert job.state == "failed"
    assert job.message == "This took longer than 0 s and was given up. Nothing else is lost."
    assert ended(one.ask(question("echo", after="late"), "x")).state == "done"


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self").is_dir(), reason="only some systems limit the memory of a process")
def test_a_job_that_wants_too_much_memory_is_refused_and_the_worker_lives(one):
    before = ended(one.ask(question("echo", n="modest"), "x")).result[2]
    job = ended(one.ask(question("greedy"), "x"))
    assert job.message == "This needs more than 4 GB of memory and was given up. Nothing else is lost."
    assert ended(one.ask(question("echo", n="still modest"), "x")).result[2] == before


def test_an_answer_without_a_key_is_not_kept(one):
    first, again = (ended(one.ask(Task(name="echo", choices={"key": ""}), "x")) for _k in range(2))
    assert first.result[3] < again.result[3]


def test_a_question_in_other_words_goes_where_the_answer_is_known_unless_that_one_is_busy(jobs):
    def pid(matter, n):
        return ended(jobs.ask(question("echo", matter=matter, n=n), f"{matter}{n}")).result[2]

    homes = {matter: pid(matter, 0) for matter in "abcdef"}
    for n in range(1, 4):
        assert {matter: pid(matter, n) for matter in homes} == homes
    busy = jobs.ask(question("slow", matter="a", n="busy"), "x")
    until(lambda: busy.state == "running")
    assert pid("a", 4) != homes["a"]
    jobs.cancel(busy)
    ended(busy)


@pytest.mark.slow
def test_another_unit_calculates_nothing_again(monkeypatch):
    made = []
    real = answers.gather
    monkeypatch.setattr(answers, "gather", lambda *given: made.append(given) or real(*given))
    inch = Reader(units={"length": "in", "torque": "lbft"}, decimal=",")
    drive = example("truck-power-unit")
    pages = [
        result(Question(name="torsion", drive=drive, folder=Path(), language=code, reader=who))
        for code, who in (("en", USUAL), ("en", inch), ("ru", inch), ("en", USUAL))
    ]
    assert len(made) == 2  # once a language
    assert pages[0].answer == pages[3].answer
    assert pages[2].title == "Крутильные колебания"
    tables = [next(one for one in page.blocks if isinstance(one, Table)) for page in pages]
    cells = [[cell.text for row in one.rows for cell in row] for one in tables]
    assert cells[0] == cells[3] != cells[1]


def test_half_an_answer_is_not_kept(monkeypatch):
    monkeypatch.setattr(answers, "found_page", lambda question, on, progress, *_more: progress(0.5))
    asked = Question(name="torsion", drive=example("truck-power-unit"), folder=Path())
    result(asked, lambda _share: "stop")
    assert asked.matter not in _answers


def test_users_are_served_in_turn(one):
    """One who asks much does not keep the others waiting."""
    first = one.ask(question("slow", seconds=0.2), "many")
    until(lambda: first.state == "running")
    many = [one.ask(question(f"echo-{k}"), "many") for k in range(3)]
    few = one.ask(question("echo-few"), "few")
    when = [ended(job).result[3] for job in (few, *many)]
    assert when == sorted(when)


@pytest.mark.slow
def test_no_process_is_left_after_the_end():
    jobs = Jobs(1, made=work)
    pid = ended(jobs.ask(question("echo"), "x")).result[2]
    deaf, waiting = jobs.ask(question("deaf"), "x"), jobs.ask(question("echo", later=True), "x")
    until(lambda: deaf.state == "running")
    jobs.close()
    assert gone(pid)
    assert deaf.state == waiting.state == "cancelled"
    assert jobs.ask(question("echo", after="the end"), "x").state == "cancelled"
    jobs.close()


def test_nothing_starts_before_it_is_needed():
    jobs = Jobs(2, made=work)
    assert not jobs._hands
    jobs.close()


def test_no_drive_no_question():
    class Empty:
        drive = None
        document = SimpleNamespace(of_mechanism=False)

    assert asked(Empty(), "motion") is None
