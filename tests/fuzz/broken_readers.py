"""Readers that do what must never happen, to see that the fuzzer sees it."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from texvent.errors import InputError

from .array_damage import CODE_RAN
from .outcomes import LONGEST_ERROR, MAX_GROWTH_BYTES
from .reader import Reader

SOUND = "sound"


class _TwoLinesError(InputError):
    def __str__(self) -> str:
        return "one\ntwo"


def _several_lines() -> None:
    raise _TwoLinesError


def _too_long() -> None:
    raise InputError("x" * LONGEST_ERROR)


def _traceback() -> None:
    raise KeyError("x")


def _hang() -> None:
    time.sleep(60)


def _grow() -> None:
    np.ones(8 * MAX_GROWTH_BYTES, np.uint8)


def _die() -> None:
    os.kill(os.getpid(), signal.SIGBUS)


def _run_code() -> None:
    Path(CODE_RAN).mkdir()


def broken_readers() -> list[Reader]:
    """One per class of outcome."""
    faults = {
        "several lines": _several_lines,
        "too long": _too_long,
        "traceback": _traceback,
        "hang": _hang,
        "blow-up": _grow,
        "signal": _die,
        "code ran": _run_code,
    }
    return [
        Reader(f"broken {name}", _make, lambda path, fault=fault: _read(fault, path))
        for name, fault in faults.items()
    ]


def _make(folder: Path) -> Path:
    path = folder / "x"
    path.write_text(SOUND)
    return path


def _read(fault: Callable[[], None], path: Path) -> None:
    """Sound inputs are read, damaged ones are not."""
    if path.read_bytes() != SOUND.encode():
        fault()
