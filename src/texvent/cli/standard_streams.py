"""Standard output and error that never stop a command: closed, full, or with no reader left."""

from __future__ import annotations

import errno
import io
import os
import sys
from typing import Any, TextIO


class _Lasting(io.FileIO):
    """A file descriptor; what the system refuses to take is lost, and the refusal kept."""

    refusal: OSError | None = None

    def write(self, data: Any) -> int:
        """Write bytes, or lose them."""
        if self.refusal is None:
            try:
                return super().write(data) or 0
            except OSError as error:
                self.refusal = error
        return memoryview(data).nbytes


def open_standard_streams() -> None:
    """Let the process write to stdout and stderr whatever becomes of them.

    Where they were closed, no file that is opened later gets their numbers.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.dup2(os.open(os.devnull, os.O_RDWR), number)
    sys.stdout, sys.stderr = _lasting(sys.stdout, 1), _lasting(sys.stderr, 2)


def allow_any_text() -> None:
    """Let output that the terminal's encoding cannot show lose a character, not the run.

    Help has Greek letters, which a plain C locale has not; a path may hold bytes that are not
    UTF-8, and those are written as they are.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            is_utf8 = stream.encoding.lower().replace("-", "") == "utf8"
            stream.reconfigure(errors="surrogateescape" if is_utf8 else "replace")


def refusal_of_output() -> str | None:
    """Why part of standard output was lost; None also where its reader (head, less) ended first."""
    sys.stdout.flush()
    raw = getattr(getattr(sys.stdout, "buffer", None), "raw", None)
    refusal = raw.refusal if isinstance(raw, _Lasting) else None
    if refusal is None or refusal.errno in (errno.EPIPE, errno.EINVAL):  # EINVAL: of Windows
        return None
    return refusal.strerror


def _lasting(stream: TextIO | None, number: int) -> TextIO:
    """The stream, unless it is a terminal, over a descriptor that lasts."""
    if stream is not None and (stream.isatty() or not isinstance(stream, io.TextIOWrapper)):
        return stream
    return io.TextIOWrapper(
        io.BufferedWriter(_Lasting(number, "w", closefd=False)),
        encoding="utf-8" if stream is None else stream.encoding,
        line_buffering=stream is None or stream.line_buffering or stream.write_through,
    )
