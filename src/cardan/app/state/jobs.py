"""Long answers, made in processes of their own: how far they are, when they end, how to stop them."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Hashable
from math import inf
from typing import Any, Literal, TypeAlias

from cardan.texts import _, speaking

from .work import result
from .worker import Done, Failed, Made, Share, Worker

State: TypeAlias = Literal["waiting", "running", "done", "failed", "cancelled"]

PATIENCE = 2.0  # seconds from asking for an end to forcing it
LISTEN = 0.05  # seconds that a quiet worker is listened to before looking whether its work is still wanted
KEPT = 48  # answers kept, the ones asked for last


class Job:
    """A question on its way; read it as often as you like, from any thread.

    question: a `Question` or an `Edit`; limit: seconds that work on it may take.
    state: waiting, running, done, failed or cancelled; share: how much is done, 0 to 1.
    result: the answer, once it is done; message: why it failed, in the language of the question.
    """

    def __init__(self, question: Any, owner: Hashable, limit: float = inf) -> None:
        self.question = question
        self.owner = owner
        self.limit = limit
        self.key = question.key
        self.matter: str = getattr(question, "matter", "")
        self.state: State = "waiting"
        self.share = 0.0
        self.result: Any = None
        self.message = ""
        self.unwanted = False
        self._began = 0.0

    @property
    def finished(self) -> bool:
        """Whether nothing more will come of it."""
        return self.state in ("done", "failed", "cancelled")

    @property
    def left(self) -> float | None:
        """Seconds that it will take, about; None where nobody can tell yet."""
        spent = time.monotonic() - self._began
        if self.state != "running" or self.share < 0.02 or spent < 0.5:
            return None
        return spent * (1.0 - self.share) / self.share

    @property
    def late(self) -> bool:
        """Whether work on it took longer than it may."""
        return time.monotonic() - self._began > self.limit

    def begin(self) -> None:
        """Note that work on it begins."""
        self._began = time.monotonic()
        self.state = "running"

    def fail(self, message: str) -> None:
        """Note that nothing came of it."""
        self.message, self.state = message, "failed"


class Jobs:
    """Work for all users of a server: so many processes at a time, started when they are needed first.

    workers: processes at most.
    """

    def __init__(self, workers: int = 2, *, made: Made = result) -> None:
        self._count = workers
        self._made = made
        self._change = threading.Condition()
        self._waiting: list[Job] = []
        self._running: list[Job] = []
        self._served: dict[Hashable, int] = {}
        self._turn = 0
        self._kept: OrderedDict[str, Any] = OrderedDict()
        self._homes: OrderedDict[str, int] = OrderedDict()  # matter -> the hand whose worker knows the answer
        self._busy: set[int] = set()
        self._hands: list[threading.Thread] = []
        self._closed = False

    def start(self) -> None:
        """Start the processes, so that the first question need not wait for them."""
        with self._change:
            if self._hands or self._closed:
                return
            self._hands = [
                threading.Thread(target=self._serve, args=(k,), daemon=True, name=f"cardan-jobs-{k}")
                for k in range(self._count)
            ]
            for hand in self._hands:
                hand.start()

    def ask(self, question: Any, owner: Hashable, *, limit: float = inf) -> Job:
        """Return the job that answers a question; an older one on the same question of the same owner ends.

        owner: who asks; all owners are served alike; limit: seconds that it may take.
        """
        self.start()
        job = Job(question, owner, limit)
        with self._change:
            for other in (*self._waiting, *self._running):
                if other.owner == owner and other.question.name == question.name:
                    self._drop(other)
            if job.key in self._kept:
                self._kept.move_to_end(job.key)
                job.result, job.share, job.state = self._kept[job.key], 1.0, "done"
            elif self._closed:
                job.state = "cancelled"
            else:
                self._waiting.append(job)
                self._change.notify_all()
        return job

    def cancel(self, job: Job) -> None:
        """End a job: at once where it waits; else its process is asked to, and after a while made to."""
        with self._change:
            self._drop(job)

    def leave(self, owner: Hashable) -> None:
        """End all jobs of an owner who went away."""
        with self._change:
            for job in (*self._waiting, *self._running):
                if job.owner == owner:
                    self._drop(job)
            self._served.pop(owner, None)

    def close(self) -> None:
        """End everything; no process is left."""
        with self._change:
            self._closed = True
            for job in (*self._waiting, *self._running):
                self._drop(job)
            self._change.notify_all()
        for hand in self._hands:
            hand.join()

    def _drop(self, job: Job) -> None:
        job.unwanted = True
        if job in self._waiting:
            self._waiting.remove(job)
            job.state = "cancelled"

    def _next(self, hand: int) -> Job | None:
        """Wait for the job that is next: of who has the least at work, then of who was served longest ago.

        hand: who asks; what another one knows the answer to is left to it, unless that one is busy.
        """

        def mine() -> list[Job]:
            return [one for one in self._waiting if self._homes.get(one.matter, hand) in (hand, *self._busy)]

        with self._change:
            self._change.wait_for(lambda: self._closed or mine())
            if self._closed:
                return None

            def rank(job: Job) -> tuple[int, int]:
                return sum(one.owner == job.owner for one in self._running), self._served.get(job.owner, -1)

            job = min(mine(), key=rank)
            self._turn += 1
            self._served[job.owner] = self._turn
            self._waiting.remove(job)
            self._running.append(job)
            self._busy.add(hand)
            if job.matter:
                self._homes[job.matter] = hand
                self._homes.move_to_end(job.matter)
                while len(self._homes) > KEPT:
                    self._homes.popitem(last=False)
            job.begin()
            return job

    def _serve(self, hand: int) -> None:
        """Hand one job after the other to a worker, and the next one to a new worker where the old one is no more."""
        worker: Worker | None = Worker(self._made)
        try:
            while job := self._next(hand):
                try:
                    if worker is not None and not worker.process.is_alive():
                        worker.end()
                        worker = None
                    worker = worker or Worker(self._made)
                    if not self._followed(job, worker):
                        worker.end()
                        worker = None if self._closed else Worker(self._made)
                except Exception as error:  # no worker could be started: the next job may have more luck
                    worker = None
                    job.fail(f"{type(error).__name__}: {error}")
                finally:
                    with self._change:
                        self._running.remove(job)
                        self._busy.discard(hand)
                        self._change.notify_all()
        finally:
            if worker is not None:
                worker.end()

    def _followed(self, job: Job, worker: Worker) -> bool:
        """Follow a job until it ends and return whether its worker can have another one."""
        told: float | None = None
        try:
            worker.ask(job.question)
            while True:
                word = worker.heard(LISTEN)
                if isinstance(word, Share):
                    job.share = word.share
                elif word is not None:
                    self._finish(job, word)
                    return True
                if job.unwanted and (told is None or self._closed):
                    job.state = "cancelled"
                    if self._closed:
                        return False
                    worker.stop()
                    told = time.monotonic()
                if job.late:
                    job.fail(_late(job.question.language, job.limit))
                    return False
                if told is not None and time.monotonic() - told > PATIENCE:
                    return False
        except (EOFError, OSError):
            worker.process.join()
            if job.unwanted:
                job.state = "cancelled"
            else:
                job.fail(_died(job.question.language, worker.process.exitcode))
            return False

    def _finish(self, job: Job, word: Done | Failed) -> None:
        if job.unwanted:
            job.state = "cancelled"
        elif isinstance(word, Failed):
            job.fail(own_fault(job.question.language, word.text) if word.own else word.text)
        else:
            with self._change:
                if job.key:
                    self._kept[job.key] = word.result
                while len(self._kept) > KEPT:
                    self._kept.popitem(last=False)
            job.result, job.share, job.state = word.result, 1.0, "done"


def _died(language: str, code: int | None) -> str:
    with speaking(language):
        return _(
            "The process that worked on this was ended from outside (code {code}), as happens when memory runs out. "
            "Nothing else is lost; ask again, or for less."
        ).format(code=code)


def _late(language: str, limit: float) -> str:
    with speaking(language):
        return _("This took longer than {count} s and was given up. Nothing else is lost.").format(count=round(limit))


def own_fault(language: str, error: str) -> str:
    """Return in a language that nobody but us is to blame."""
    with speaking(language):
        return _("This answer failed by a mistake in cardan itself: {error}").format(error=error)
