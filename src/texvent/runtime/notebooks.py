"""Notebooks: progress by nothing but IPython's display, and values that show themselves."""

from __future__ import annotations

import importlib
import sys
import time
from collections.abc import Collection
from typing import Any, Self

from texvent._registry import load_object
from texvent.errors import visible

PATIENCE_SECONDS = 0.5
"""Work that ends sooner shows no steps."""
REFRESH_SECONDS = 0.1


def is_notebook() -> bool:
    """Whether this process is the kernel of a notebook."""
    ipython = sys.modules.get("IPython")
    shell = None if ipython is None else ipython.get_ipython()
    return getattr(shell, "kernel", None) is not None


class NotebookProgress:
    """Lines, and one with the steps of longer work, which disappears at its end.

    Args:
        is_forced: show the steps at once.
    """

    def __init__(self, *, is_forced: bool = False) -> None:
        self._patience = 0.0 if is_forced else PATIENCE_SECONDS
        self._handle: Any = None
        self._begun = self._stage_begun = time.monotonic()
        self._shown = -REFRESH_SECONDS
        self._stage = ""

    def __enter__(self) -> Self:
        self._begun = self._stage_begun = time.monotonic()
        return self

    def __exit__(self, *error: object) -> None:
        if self._handle is not None:
            self._handle.update({"text/plain": ""}, raw=True)

    def announce(self, line: str) -> None:
        """Show a line."""
        _display({"text/plain": visible(line)}, raw=True)

    def advance(self, stage: str, done: int, total: int | None) -> None:
        """Show a step, at most ten times per second."""
        now = time.monotonic()
        if stage != self._stage:
            self._stage, self._stage_begun = stage, now
        elif now - self._shown < REFRESH_SECONDS and done != total:
            return
        if now - self._begun < self._patience:
            return
        self._shown = now
        steps = f"{done:,}" if total is None else f"{done:,}/{total:,}"
        text = {"text/plain": f"{visible(stage)}  {steps}  {now - self._stage_begun:.0f} s"}
        if self._handle is None:
            self._handle = _display(text, raw=True, display_id=True)
        else:
            self._handle.update(text, raw=True)


def _display(bundle: dict[str, str], **options: Any) -> Any:
    return importlib.import_module("IPython.display").display(bundle, **options)


class NotebookValue:
    """Base of events, frames and streams: IPython asks for what to show in place of their text."""

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> dict[str, str]:
        """Text and HTML of the value; the room of views makes the HTML, loaded when it is asked."""
        bundle: dict[str, str] = load_object("texvent.view.notebook:mime_bundle")(
            self, include, exclude
        )
        return bundle
