"""`texvent app` as a process, for tests that visit it."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

OPTIONS = ("--no-browser", "--max-seconds", "0.2", "--max-upload-mb", "1", "--port", "0")


@contextlib.contextmanager
def served(temporary: Path) -> Iterator[str]:
    """The address of a running page; afterwards it must leave, cleanly and without files."""
    server = subprocess.Popen(
        [sys.executable, "-m", "texvent.cli.app", "app", *OPTIONS],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
        env={**os.environ, "TMPDIR": str(temporary)},
    )
    try:
        line = server.stdout.readline().strip()
        assert line.startswith("http://127.0.0.1:")
        assert list(temporary.glob("texvent-app-*"))
        yield line
        server.send_signal(signal.SIGTERM)
        assert server.wait(timeout=300) == 0
        assert not list(temporary.glob("texvent-app-*"))
    finally:
        server.kill()
        server.wait()
        server.stdout.close()
