"""Work for tests of the jobs: what a worker process does with a question is told by the question's name."""

import os
import signal
import time
from dataclasses import dataclass, field

from cardan.app.state.worker import MEMORY
from cardan.errors import InputError, Problem

LONG = 60.0


@dataclass(frozen=True, kw_only=True)
class Task:
    """A question of a test: light, so that its process starts quickly."""

    name: str
    language: str = "en"
    choices: dict = field(default_factory=dict)

    @property
    def matter(self):
        return self.choices.get("matter", "")

    @property
    def key(self):
        return self.choices.get("key", repr(self))


def work(question: Task, progress):
    """Do what the name of the question says."""
    kind = question.name.partition("-")[0]
    if kind == "echo":
        return (question.language, dict(question.choices), os.getpid(), time.monotonic())
    if kind == "slow":
        end = time.monotonic() + float(question.choices.get("seconds", LONG))
        began = time.monotonic()
        while time.monotonic() < end:
            time.sleep(0.01)
            if progress((time.monotonic() - began) / (end - began)) == "stop":
                return "stopped"
        return "done"
    if kind == "deaf":
        time.sleep(LONG)
    if kind == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    if kind == "refused":
        raise InputError([Problem("joints[0]", "is none")])
    if kind == "broken":
        raise RuntimeError("what now")
    if kind == "greedy":
        return len(bytearray(2 * MEMORY))
    if kind == "unsendable":
        return lambda: None
    raise AssertionError(kind)
