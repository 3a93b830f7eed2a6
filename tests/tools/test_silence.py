"""Bound on the silence of workers: a run that hangs between tests ends, with its tests named."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
HANGS = '''
import os, time
from tests.silence import Silence

class SilenceFromFirstReport(Silence):
    """However long a busy machine takes to begin."""

    is_begun = False

    def pytest_sessionstart(self):
        pass

    def pytest_runtest_logreport(self, report):
        super().pytest_runtest_logreport(report)
        if not self.is_begun:
            self.is_begun = True
            super().pytest_sessionstart()

def pytest_configure(config):
    if config.getoption("numprocesses", None):
        config.pluginmanager.register(SilenceFromFirstReport(config, 3.0), "silence")

def pytest_runtest_logfinish(nodeid):
    if "PYTEST_XDIST_WORKER" in os.environ and nodeid.endswith(os.environ["HANGS_AFTER"]):
        time.sleep(300)
'''
TESTS = "import pytest\n@pytest.mark.parametrize('n', range(6))\ndef test_one(n): pass\n"


def run(folder, after):
    (folder / "conftest.py").write_text(HANGS)
    (folder / "test_some.py").write_text(TESTS)
    words = [sys.executable, "-m", "pytest", "-q", "-n", "1", "-c", "/dev/null", str(folder)]
    path = {**os.environ, "PYTHONPATH": str(ROOT), "HANGS_AFTER": after}
    return subprocess.run(words, capture_output=True, text=True, env=path, cwd=folder, timeout=120)


def test_a_run_whose_worker_hangs_between_tests_ends_and_names_what_is_left(tmp_path):
    done = run(tmp_path, "[2]")
    assert done.returncode == 3
    assert "no worker reported for 3 s" in done.stderr
    assert "test_one[3]" in done.stderr
    assert "in pytest_runtest_logfinish" in done.stderr  # the worker's stack


def test_a_run_that_goes_on_is_left_alone(tmp_path):
    done = run(tmp_path, "[9]")
    assert (done.returncode, done.stderr) == (0, "")
