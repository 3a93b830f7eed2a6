"""Runs jobs in worker processes: time limit, crash, cancellation."""

from __future__ import annotations

import contextlib
import os
import queue
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator

from texvent.errors import InputError
from texvent.web.job import Answer, Job, job_line, read_answer

WORKER = (sys.executable, "-m", "texvent.web.worker")
POLL_S = 0.5
"""How often the limits are checked while a worker writes nothing."""


class Supervisor:
    """Runs jobs, each in a process of its own.

    Its time limit is the longest work on one job, seconds.
    """

    def __init__(self, *, time_limit_s: float) -> None:
        self._time_limit_s = time_limit_s
        self._running: set[subprocess.Popen[str]] = set()
        self._lock = threading.Lock()
        self._is_closed = False

    def run(self, job: Job, is_wanted: Callable[[], bool] = lambda: True) -> Iterator[Answer]:
        """Answers of a worker as they come; the last one is "done".

        Closing the iterator stops the worker.

        Args:
            job: what to do.
            is_wanted: asked while the worker works; False stops it and ends the answers.

        Raises:
            InputError: the worker refused the job, crashed, or ran out of time; the page shows the
                message.
        """
        worker = self._start()
        try:
            yield from _read_answers(worker, job, self._time_limit_s, is_wanted)
        finally:
            with self._lock:
                self._running.discard(worker)
            _end(worker)

    def close(self) -> None:
        """Stop all workers; no other job is taken."""
        with self._lock:
            self._is_closed = True
            for worker in self._running:
                worker.kill()

    def _start(self) -> subprocess.Popen[str]:
        with self._lock:
            if self._is_closed:
                raise InputError("the page is closing and takes no more jobs")
            # In a session of its own, so that Ctrl-C in the terminal ends the page, not the worker.
            worker = subprocess.Popen(
                WORKER,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                encoding="utf-8",
                env={**os.environ, "PYTHONUNBUFFERED": "1"},
                start_new_session=True,
            )
            self._running.add(worker)
        return worker


def _end(worker: subprocess.Popen[str]) -> None:
    worker.kill()
    worker.wait()
    for pipe in (worker.stdin, worker.stdout):
        if pipe is not None:
            with contextlib.suppress(BrokenPipeError):
                pipe.close()


def _read_answers(
    worker: subprocess.Popen[str], job: Job, time_limit_s: float, is_wanted: Callable[[], bool]
) -> Iterator[Answer]:
    deadline = time.monotonic() + time_limit_s
    lines: queue.Queue[str | None] = queue.Queue()
    reader = threading.Thread(target=_queue_lines, args=(worker, lines), daemon=True)
    _send(worker, job)
    reader.start()
    while is_wanted():
        try:
            line = lines.get(timeout=POLL_S)
        except queue.Empty:
            line = ""
        if line is None:
            raise InputError(
                f"the job crashed (exit code {worker.wait()}); nothing else was harmed. Its input "
                "may be damaged or too large"
            )
        answer = read_answer(line)
        if answer is not None:
            if answer.kind == "failed":
                raise InputError(answer.text)
            yield answer
            if answer.kind == "done":
                return
        if time.monotonic() > deadline:
            raise InputError(
                f"the job took longer than {time_limit_s:g} s and was stopped; try a shorter one, "
                "or a smaller sensor"
            )


def _send(worker: subprocess.Popen[str], job: Job) -> None:
    if worker.stdin is None:
        raise InputError("the worker takes no jobs")
    # A worker that died already is noticed when its answers end.
    with contextlib.suppress(BrokenPipeError):
        worker.stdin.write(job_line(job) + "\n")
        worker.stdin.flush()


def _queue_lines(worker: subprocess.Popen[str], lines: queue.Queue[str | None]) -> None:
    """Pass on lines until the worker ends, then None."""
    if worker.stdout is not None:
        for line in worker.stdout:
            lines.put(line)
    lines.put(None)
