"""Give inputs to a worker process, and end it when it hangs, dies or has grown."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from .outcomes import KILL_SECONDS, Outcome

ROOT = Path(__file__).resolve().parents[2]
PREPARE_SECONDS = 120.0
"""Loading libraries and compiling kernels for a reader's sound input."""


class Supervisor:
    """One worker at a time; a new one after one that had to be ended."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._unread = b""

    def one(self, name: str, number: int, finding: Path | None = None) -> Outcome:
        """Outcome of one damaged input, or of a kept finding."""
        process = self._process = self._process or self._start()
        assert process.stdin is not None
        kept = None if finding is None else str(finding)
        process.stdin.write(json.dumps([name, number, kept]).encode() + b"\n")
        process.stdin.flush()
        state, damage = "starting", ""
        while True:
            answer = self._answer(KILL_SECONDS if state == "reading" else PREPARE_SECONDS)
            if answer is None:
                kind, detail = self._end()
                if state != "reading":
                    raise AssertionError(f"the worker of {name} failed before it read: {detail}")
                return Outcome(name, number, kind, damage, detail)
            damage = answer.get("damage", damage)
            if "broken" in answer:
                raise AssertionError(f"{name} cannot be fuzzed: {answer['broken']}")
            if "outcome" in answer:
                if answer["outcome"] in ("hang", "blow-up"):
                    self._end()
                return Outcome(name, number, answer["outcome"], damage, answer["detail"])
            state = answer["state"]

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._process is not None:
            self._end()

    def _start(self) -> subprocess.Popen[bytes]:
        return subprocess.Popen(
            [sys.executable, "-m", "tests.fuzz.worker"],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )

    def _answer(self, seconds: float) -> dict[str, Any] | None:
        """The next line, or None if there is none in time or the process has died."""
        assert self._process is not None
        assert self._process.stdout is not None
        pipe = self._process.stdout.fileno()
        stop = time.monotonic() + seconds
        while b"\n" not in self._unread:
            ready, _, _ = select.select([pipe], [], [], max(0.0, stop - time.monotonic()))
            more = os.read(pipe, 65_536) if ready else b""
            if not more:
                return None
            self._unread += more
        line, _, self._unread = self._unread.partition(b"\n")
        found: dict[str, Any] = json.loads(line)
        return found

    def _end(self) -> tuple[str, str]:
        """End the process; what had become of it."""
        process, self._process = self._process, None
        self._unread = b""
        assert process is not None
        try:
            code = process.wait(0.5)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            return "hang", f"no end after {KILL_SECONDS:g} s"
        process.communicate()
        return "signal", signal.Signals(-code).name if code < 0 else f"exit code {code}"
