"""Folders of the jobs: one each, the latest few kept, all gone when the page closes.

A result is given to the visitor who asked for it alone.
"""

from __future__ import annotations

import shutil
import tempfile
import threading
import time
from pathlib import Path
from typing import Self

KEPT_JOBS = 20
UPLOADS_KEPT = 10
"""How many uploads of the largest size there is room for."""
ABANDONED_S = 60.0
"""Age of the last byte of an upload that is no longer being sent."""


class Workspace:
    """A temporary folder with a folder per job.

    Names are random, so that one visitor cannot guess another's results.
    """

    def __init__(self, *, kept: int = KEPT_JOBS) -> None:
        self._kept = kept
        self._root: Path | None = None
        self._owners: dict[Path, str] = {}
        self._lock = threading.Lock()

    def __enter__(self) -> Self:
        self._root = Path(tempfile.mkdtemp(prefix="texvent-app-"))
        self.uploads.mkdir()
        return self

    @property
    def root(self) -> Path:
        """The folder that holds everything; only inside the `with` block."""
        if self._root is None:
            raise RuntimeError("the workspace is used outside its with block")
        return self._root

    @property
    def uploads(self) -> Path:
        """Where uploaded videos lie."""
        return self.root / "uploads"

    def new_folder(self, owner: str) -> Path:
        """An empty folder for a job of that session; the oldest beyond those kept is deleted."""
        folder = Path(tempfile.mkdtemp(prefix="job-", dir=self.root))
        with self._lock:
            self._owners[folder] = owner
            while len(self._owners) > self._kept:
                oldest = next(iter(self._owners))
                del self._owners[oldest]
                shutil.rmtree(oldest, ignore_errors=True)
        return folder

    def result(self, owner: str | None, folder: str, name: str) -> Path | None:
        """The file of that name in a job's folder; None where it is not there or another's."""
        job = self.root / folder
        with self._lock:
            if owner is None or self._owners.get(job) != owner:
                return None
        path = job / name
        return path if path.resolve().parent == job.resolve() and path.is_file() else None

    def make_room(self, largest_upload: int) -> None:
        """Delete uploads that were broken off, and the oldest where they take too much room."""
        files = [(path, path.stat()) for path in self.uploads.rglob("*") if path.is_file()]
        files.sort(key=lambda one: one[1].st_mtime, reverse=True)
        total, now = 0, time.time()
        for path, facts in files:
            total += facts.st_size
            # The parser writes to tmp*; a complete upload lies in a folder of its own.
            is_broken_off = path.parent == self.uploads and now - facts.st_mtime > ABANDONED_S
            if is_broken_off or total > (UPLOADS_KEPT - 1) * largest_upload:
                path.unlink(missing_ok=True)

    def __exit__(self, *error: object) -> None:
        shutil.rmtree(self.root, ignore_errors=True)
