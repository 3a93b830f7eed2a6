from __future__ import annotations

import subprocess
import sys
import time
from pathlib import Path

import pytest

PROGRAM = """
import os, sys, time
from pathlib import Path
from texvent.batch.engines import interruptible, processes, start_pool, stop_pools
from texvent.io.atomic import hidden_file

def work(folder):
    with interruptible(), hidden_file(folder, ".part"):
        (folder / "begun").touch()
        try:
            time.sleep(60)
        finally:
            time.sleep(1)  # a second signal comes while it cleans up

if __name__ == "__main__":
    folder, how = Path(sys.argv[1]), sys.argv[2]
    pool = start_pool(2)
    pool.submit(work, folder)
    pool.submit(os.getpid).result()  # the other process waits for a task
    while not (folder / "begun").exists():
        time.sleep(0.01)
    if how == "stop":
        stop_pools(pool)
    else:
        os._exit(9)
"""


@pytest.mark.parametrize("how", ["stop", "die"])
def test_processes_of_a_pool_end_and_clean_up(tmp_path: Path, how: str) -> None:
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    folder = tmp_path / "folder"
    folder.mkdir()
    started = subprocess.run(
        [sys.executable, str(program), str(folder), how], timeout=300, capture_output=True
    )
    assert started.returncode == (0 if how == "stop" else 9), started.stderr
    ends = time.monotonic() + 300
    while time.monotonic() < ends and is_running(program):
        time.sleep(0.1)
    assert not is_running(program)
    if how == "stop":
        assert [path.name for path in folder.iterdir()] == ["begun"]


def is_running(program: Path) -> bool:
    """Whether a process of the pool is left; its main module is the program."""
    found = subprocess.run(["pgrep", "-f", str(program)], capture_output=True)
    return found.returncode == 0


STUBBORN = """
import signal, sys, time
from pathlib import Path
import texvent.batch.engines as pools

def work(begun):
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    begun.touch()
    time.sleep(600)

if __name__ == "__main__":
    begun, pool, pools.PATIENCE_S = Path(sys.argv[1]), pools.start_pool(1), 0.5
    pool.submit(work, begun)
    while not begun.exists():
        time.sleep(0.01)
    pools.stop_pools(pool)
"""


def test_a_process_that_no_signal_ends_is_killed(tmp_path: Path) -> None:
    program = tmp_path / "program.py"
    program.write_text(STUBBORN)
    subprocess.run([sys.executable, str(program), str(tmp_path / "begun")], timeout=300, check=True)
    assert not is_running(program)
