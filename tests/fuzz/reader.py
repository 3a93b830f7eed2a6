"""What is fuzzed: something that makes a sound input, and the function of texvent that reads it."""

import hashlib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Reader:
    """One row of the table."""

    name: str
    make: Callable[[Path], Path]
    """Writes a sound input into an empty folder; returns the path that is read."""
    read: Callable[[Path], Any]
    """Reads all of it; what it returns is the same for the same content."""


def digest(parts: Iterable[Any]) -> str:
    """A digest of arrays and plain values."""
    found = hashlib.sha256()
    for part in parts:
        values = part if isinstance(part, np.ndarray) else repr(part).encode()
        found.update(np.ascontiguousarray(values) if isinstance(values, np.ndarray) else values)
    return found.hexdigest()
