"""Process of a job of `texvent app`: commands come through a pipe, and its end ends the process."""

from __future__ import annotations

import json
import os
import signal
import sys
import threading
import time

from texvent.cli.app import main
from texvent.runtime.console_progress import ConsoleProgress
from texvent.web.job_page import STEP_MARK

PAUSE_S = 0.2
"""Time between two steps that are told, s."""


class _Steps:
    """Tells the page how far a stage is, and how long it will take: a line of JSON on stderr."""

    def __init__(self) -> None:
        self._stage, self._first = "", 0
        self._begun_s = self._told_s = 0.0

    def __call__(self, stage: str, done: int, total: int | None) -> None:
        now_s = time.monotonic()
        if stage != self._stage:
            # The first step does not count: it waits for what is compiled and loaded.
            self._stage, self._first, self._begun_s, self._told_s = stage, done, now_s, 0.0
        if now_s - self._told_s < PAUSE_S and done != total:
            return
        self._told_s, left_s = now_s, None
        if total is not None and done > self._first:
            left_s = (total - done) * (now_s - self._begun_s) / (done - self._first)
        step = {"stage": stage, "done": done, "total": total, "left_s": left_s}
        sys.stderr.write(f"{STEP_MARK}{json.dumps(step)}\n")
        sys.stderr.flush()


def _end_with_page() -> None:
    """Wait until the page's process has ended, however it ended."""
    while os.read(0, 1):
        pass
    os.kill(os.getpid(), signal.SIGTERM)


if __name__ == "__main__":
    commands = json.loads(sys.stdin.buffer.readline())
    threading.Thread(target=_end_with_page, daemon=True).start()
    ConsoleProgress.listener = _Steps()
    for words in commands:
        sys.argv[1:] = words
        code = main()
        if code:
            break
    sys.exit(code)
