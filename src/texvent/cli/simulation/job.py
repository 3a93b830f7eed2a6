"""Process of a job of `texvent app`: words come through a pipe, and its end ends the process."""

from __future__ import annotations

import json
import os
import signal
import sys
import threading

from texvent.cli.app import main


def _end_with_page() -> None:
    """Wait until the page's process has ended, however it ended."""
    while os.read(0, 1):
        pass
    os.kill(os.getpid(), signal.SIGTERM)


if __name__ == "__main__":
    sys.argv[1:] = json.loads(sys.stdin.buffer.readline())
    threading.Thread(target=_end_with_page, daemon=True).start()
    sys.exit(main())
