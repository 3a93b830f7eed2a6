"""Bound on the silence of workers: a parallel run that hangs ends, and says what it waits for.

The time limit of a test ends with the test. Between tests, and in the scheduler of pytest-xdist,
there is none.
"""

import os
import signal
import sys
import threading
import time
from typing import Any

import pytest


class Silence:
    """Plugin of the process that hands tests to workers; `most_s` without a report end the run."""

    def __init__(self, config: pytest.Config, most_s: float) -> None:
        self._config, self._most_s = config, most_s
        self._heard_s, self._ended = time.monotonic(), threading.Event()

    def pytest_sessionstart(self) -> None:
        threading.Thread(target=self._watch, daemon=True).start()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        self._heard_s = time.monotonic()

    def pytest_sessionfinish(self) -> None:
        self._ended.set()

    def _watch(self) -> None:
        while (left_s := self._heard_s + self._most_s - time.monotonic()) > 0.0:
            if self._ended.wait(left_s):
                return
        scheduler: Any = self._config.pluginmanager.get_plugin("dsession").sched
        print(f"\nno worker reported for {self._most_s:g} s", file=sys.__stderr__, flush=True)
        for node, tests in scheduler.node2pending.items():
            names = ", ".join(scheduler.collection[one] for one in tests[:3])
            print(f"{node.gateway.id}: {len(tests)} left, {names}", file=sys.__stderr__, flush=True)
            os.kill(node.gateway._io.popen.pid, signal.SIGABRT)  # faulthandler prints its stacks
        time.sleep(1.0)
        os._exit(pytest.ExitCode.INTERNAL_ERROR)


def watch(config: pytest.Config) -> None:
    """Watch a run with workers; the limit is a little longer than that of a test."""
    if config.getoption("numprocesses", None):
        longest_s = float(config.getini("faulthandler_timeout"))
        config.pluginmanager.register(Silence(config, longest_s + 240.0), "silence")
