"""The latest job of every open page, one at a time; a job goes on while its page is reloaded."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeAlias

from texvent.errors import InputError, TexventError
from texvent.web.job import Answer, Job
from texvent.web.supervisor import Supervisor
from texvent.web.workspace import KEPT_JOBS

Page: TypeAlias = tuple[str, str]
"""The visitor's session and the browser's tab."""
ABANDONED_S = 180.0
"""Longest silence of a page whose job is not over; browsers let a hidden page ask once a minute."""
WAITING = Answer(kind="progress", text="waiting for its turn")


@dataclass
class _Entry:
    answer: Answer = WAITING
    seen_s: float = field(default_factory=time.monotonic)

    def is_wanted(self) -> bool:
        return self.answer.kind == "progress" and time.monotonic() - self.seen_s < ABANDONED_S


class PageJobs:
    """Jobs in turn; a page that asks for another one gives its former job up."""

    def __init__(self, supervisor: Supervisor, *, max_waiting: int) -> None:
        """Prepare.

        Args:
            supervisor: what runs a job.
            max_waiting: most jobs that wait for their turn.
        """
        self._supervisor = supervisor
        self._max_waiting = max_waiting
        self._entries: dict[Page, _Entry] = {}
        self._lock = threading.Lock()
        self._turns = ThreadPoolExecutor(1)

    def start(self, page: Page, make_job: Callable[[], Job]) -> None:
        """Queue a job.

        Args:
            page: whose it is.
            make_job: called when it is the job's turn.

        Raises:
            InputError: too many jobs wait already.
        """
        self.stop(page)
        with self._lock:
            self._entries.pop(page, None)
            if sum(entry.is_wanted() for entry in self._entries.values()) > self._max_waiting:
                raise InputError(f"{self._max_waiting} jobs wait already; try again in a while")
            over = [one for one, entry in self._entries.items() if not entry.is_wanted()]
            for one in over[:-KEPT_JOBS]:
                del self._entries[one]
            entry = self._entries[page] = _Entry()
        self._turns.submit(self._work, entry, make_job)

    def latest(self, page: Page) -> Answer | None:
        """The latest answer of the page's job; None where there is none or its files are gone."""
        with self._lock:
            entry = self._entries.get(page)
            if entry is None:
                return None
            entry.seen_s = time.monotonic()
        files = entry.answer.files.values()
        return entry.answer if all(Path(file).exists() for file in files) else None

    def stop(self, page: Page) -> None:
        """Give the page's job up."""
        with self._lock:
            if page in self._entries:
                _tell(self._entries[page], Answer(kind="stopped", text="Stopped."))

    def close(self) -> None:
        """Take no other job; the supervisor ends the one that runs."""
        self._turns.shutdown(wait=False, cancel_futures=True)

    def _work(self, entry: _Entry, make_job: Callable[[], Job]) -> None:
        def tell(answer: Answer) -> None:
            with self._lock:
                _tell(entry, answer)

        try:
            if entry.is_wanted():
                for answer in self._supervisor.run(make_job(), entry.is_wanted):
                    tell(answer)
        except (TexventError, OSError) as error:
            tell(Answer(kind="failed", text=str(error)))
        tell(Answer(kind="stopped", text="Stopped, as its page was closed."))


def _tell(entry: _Entry, answer: Answer) -> None:
    """Replace the answer unless the job is over."""
    if entry.answer.kind == "progress":
        entry.answer = answer
