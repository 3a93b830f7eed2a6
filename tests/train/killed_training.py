"""A training that is killed after some of its epochs."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from texvent._version import full_version

START = """
import sys
from texvent import _version
known = sys.argv.pop(1)
_version.full_version = lambda: known
from texvent.cli.app import main
main()
"""
"""Runs the command as the version that this process knows: a commit on the tree, made while the
tests run, is no other version of texvent."""


def kill_after_epochs(words: list[str], folder: Path, epochs: int = 1) -> None:
    """Run `texvent WORDS` until the folder holds scores of so many epochs; end it by SIGKILL."""
    process = subprocess.Popen([sys.executable, "-c", START, full_version(), *words])
    history, deadline = folder / "history.json", time.monotonic() + 120
    while process.poll() is None and time.monotonic() < deadline:
        if history.exists() and len(json.loads(history.read_text())["epochs"]) >= epochs:
            break
        time.sleep(0.001)
    os.kill(process.pid, signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
