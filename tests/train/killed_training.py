"""A training that is killed after its first epoch."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path


def kill_after_an_epoch(words: list[str], folder: Path) -> None:
    """Run `texvent WORDS` until the folder holds the scores of an epoch, then end it by SIGKILL."""
    process = subprocess.Popen([sys.executable, "-m", "texvent.cli.app", *words])
    history, deadline = folder / "history.json", time.monotonic() + 120
    while not history.exists() and process.poll() is None and time.monotonic() < deadline:
        time.sleep(0.001)
    os.kill(process.pid, signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
