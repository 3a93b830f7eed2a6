"""Results of steps kept in files that are named after all that they depend on."""

from __future__ import annotations

import hashlib
import json
import zipfile
import zlib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from texvent.io.atomic import atomic_file
from texvent_lab.bench.jobs import Progress, run_jobs


def digest_of(*values: Any) -> str:
    """A name for plain values and bytes."""
    found = hashlib.sha256()
    for value in values:
        content = value if isinstance(value, bytes) else json.dumps(value, sort_keys=True).encode()
        found.update(hashlib.sha256(content).digest())
    return _name(found)


def digest_of_file(path: Path) -> str:
    """`digest_of` the content of a file, read in pieces."""
    with path.open("rb") as file:
        return _name(hashlib.sha256(hashlib.file_digest(file, "sha256").digest()))


def _name(found: Any) -> str:
    return str(found.hexdigest()[:20])


def is_whole(path: Path) -> bool:
    """Whether a result is there and as it was written; a zip knows sums of its parts."""
    try:
        with zipfile.ZipFile(path) as archive:
            return archive.testzip() is None
    except (OSError, zipfile.BadZipFile, zlib.error):
        return False


def write_arrays(path: Path, **arrays: Any) -> None:
    """Write a result, compressed; it appears when it is complete."""
    with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
        np.savez_compressed(file, **arrays)


def make_missing(
    function: Callable[..., str],
    run: Any,
    todo: Sequence[tuple[Any, ...]],
    path: Callable[..., Path],
    *,
    jobs: int,
    progress: Progress,
) -> None:
    """Call a step for the results that are not there yet, and report each.

    Args:
        function: called with the run and a tuple; it writes the result, and returns a line.
        run: first argument of every call.
        todo: the other arguments, a tuple per result.
        path: file of the result of a tuple.
        jobs: processes to use.
        progress: told of every result.
    """
    missing = [(run, *one) for one in todo if not is_whole(path(*one))]
    for number, line in enumerate(run_jobs(function, missing, jobs), start=1):
        progress(f"{number} of {len(missing)}  {line}")
