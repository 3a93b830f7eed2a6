"""Context of every `from_pretrained`: library messages filtered, damage raised as an error.

diffusers and transformers fill weights that a file lacks with random numbers and mention it in
their log. Here that is an error. Their progress bars, and messages about their own insides, stay
out of the user's terminal; other warnings pass.
"""

from __future__ import annotations

import contextlib
import logging
import re
from collections.abc import Iterator
from pathlib import Path

from texvent._require import require
from texvent.errors import FileFormatError

EXTRA = "generate"
LIBRARIES = ("diffusers", "transformers")
DAMAGE = (OSError, ValueError, RuntimeError, AttributeError, TypeError, LookupError)
"""Exceptions of the libraries for files that do not fit, beside that of safetensors."""
LONGEST_REASON = 300
NOISE = re.compile(
    r"requires torchvision \(not installed\); falling back"
    r"|should be kept in float32: \[\]"
    # Said several times; it was true of former versions of torch.
    r"|Pipelines loaded with `dtype=torch.float16` cannot run with `cpu`"
)
"""Messages without use for a user."""
REPORT = re.compile(r"LOAD REPORT.* from: (?P<folder>.+)")
ROW = re.compile(r"^(?P<name>\S+)\s*\|\s*(?:\x1b\[\d+m)*(?P<status>MISSING|MISMATCH)", re.MULTILINE)
"""Of the report of transformers; its words may be coloured."""
NEWLY = re.compile(r"at\s(?P<folder>.+) and are newly initialized: \['(?P<name>[^']+)'")
"""Message of diffusers about weights that its file lacks."""


@contextlib.contextmanager
def loading(folder: Path, role: str) -> Iterator[None]:
    """Inside, a library loads `folder`; it is quiet, and a folder that does not fit is refused.

    Args:
        folder: what is loaded.
        role: what it is loaded as, for the message: "a decoder".

    Raises:
        FileFormatError: a file is damaged, or lacks weights of its network.
        MissingDependencyError: a package is not installed.
    """
    damage = require("safetensors", extra=EXTRA).SafetensorError
    losses: list[str] = []
    try:
        with quiet_libraries(losses):
            yield
    except (*DAMAGE, damage) as error:
        reason = losses[0] if losses else " ".join(str(error).split())[:LONGEST_REASON]
        raise FileFormatError(f"{folder} cannot be loaded as {role}: {reason}") from error
    if losses:
        raise FileFormatError(f"{folder} cannot be loaded as {role}: {losses[0]}")


@contextlib.contextmanager
def quiet_libraries(losses: list[str] | None = None) -> Iterator[None]:
    """Inside, the libraries show neither bars nor noise.

    Args:
        losses: receives a line for every network whose file lacks weights.
    """
    found: list[str] = [] if losses is None else losses
    with contextlib.ExitStack() as stack:
        for name in LIBRARIES:
            bars = require(f"{name}.utils.logging", extra=EXTRA)
            if bars.is_progress_bar_enabled():
                bars.disable_progress_bar()
                stack.callback(bars.enable_progress_bar)
            stack.enter_context(_sorted_messages(logging.getLogger(name), found))
        yield


@contextlib.contextmanager
def _sorted_messages(logger: logging.Logger, losses: list[str]) -> Iterator[None]:
    handlers, level = logger.handlers, logger.level
    # Losses are mentioned as warnings, which the user may have switched off.
    logger.handlers = [_Sorter(losses, handlers, level)]
    logger.setLevel(min(level, logging.WARNING))
    try:
        yield
    finally:
        logger.handlers = handlers
        logger.setLevel(level)


class _Sorter(logging.Handler):
    """Keeps losses, drops noise and hands the rest on."""

    def __init__(self, losses: list[str], handlers: list[logging.Handler], level: int) -> None:
        super().__init__()
        self._losses, self._handlers, self._shown_from = losses, handlers, level

    def emit(self, record: logging.LogRecord) -> None:
        text = record.getMessage()
        loss = _describe_loss(text)
        if loss is not None:
            self._losses.append(loss)
        elif record.levelno >= self._shown_from and not NOISE.search(text):
            for handler in self._handlers:
                handler.handle(record)


def _describe_loss(text: str) -> str | None:
    """The missing weights that a message reports, or None.

    Example:
        >>> _describe_loss("... at my/vae and are newly initialized: ['conv.bias']")
        'my/vae lacks conv.bias'
    """
    newly, report, row = NEWLY.search(text), REPORT.search(text), ROW.search(text)
    if newly is not None:
        return f"{newly['folder']} lacks {newly['name']}"
    if report is None or row is None:
        return None
    if row["status"] == "MISSING":
        return f"{report['folder']} lacks {row['name']}"
    return f"{report['folder']} has {row['name']} of another shape"
