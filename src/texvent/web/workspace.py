"""Folders of the jobs: one each, the latest few kept, all gone when the page closes."""

from __future__ import annotations

import shutil
import tempfile
import threading
from collections import deque
from pathlib import Path
from typing import Self

KEPT_JOBS = 20


class Workspace:
    """A temporary folder with a folder per job.

    Names are random, so that one visitor cannot guess another's results.
    """

    def __init__(self, *, kept: int = KEPT_JOBS) -> None:
        self._kept = kept
        self._root: Path | None = None
        self._folders: deque[Path] = deque()
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

    def new_folder(self) -> Path:
        """An empty folder for a job; the oldest beyond the number kept is deleted."""
        folder = Path(tempfile.mkdtemp(prefix="job-", dir=self.root))
        with self._lock:
            self._folders.append(folder)
            while len(self._folders) > self._kept:
                shutil.rmtree(self._folders.popleft(), ignore_errors=True)
        return folder

    def __exit__(self, *error: object) -> None:
        shutil.rmtree(self.root, ignore_errors=True)
