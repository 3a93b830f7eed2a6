"""A progress bar for downloads."""

from __future__ import annotations

from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import (
    BarColumn,
    DownloadColumn,
    Progress,
    TextColumn,
    TimeRemainingColumn,
    TransferSpeedColumn,
)


class DownloadBar:
    """One download's bar; a `ProgressTracker` of pypi-simple.

    Args:
        total: bytes to come, or None if unknown.
        console: where to draw; default: standard error, so that results can be piped.
    """

    def __init__(self, total: int | None, console: Console | None = None) -> None:
        self._progress = Progress(
            TextColumn("download"),
            BarColumn(),
            DownloadColumn(),
            TransferSpeedColumn(),
            TimeRemainingColumn(),
            console=console or Console(stderr=True),
        )
        self._task = self._progress.add_task("download", total=total)

    def __enter__(self) -> Self:
        self._progress.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._progress.stop()

    def update(self, increment: int) -> None:
        """Advance by so many bytes."""
        self._progress.update(self._task, advance=increment)


def show_progress(total: int | None) -> DownloadBar:
    """A bar on standard error; give it to `pull` as `progress`."""
    return DownloadBar(total)
