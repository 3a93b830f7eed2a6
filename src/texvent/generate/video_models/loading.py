"""Context of every `from_pretrained`: no progress bars, and one-line errors of damaged files."""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from pathlib import Path

from texvent._require import require
from texvent.errors import FileFormatError

EXTRA = "generate"
LIBRARIES = ("diffusers", "transformers")
DAMAGE = (OSError, ValueError, RuntimeError, AttributeError, TypeError, LookupError)
"""Exceptions of the libraries for files that do not fit, beside that of safetensors."""
LONGEST_REASON = 300


@contextlib.contextmanager
def loading(folder: Path, role: str) -> Iterator[None]:
    """Inside, a library loads `folder`; it shows no bars, and a damaged folder is refused.

    Weights that a file lacks are filled by the libraries with random numbers, which they warn of.

    Args:
        folder: what is loaded.
        role: what it is loaded as, for the message: "a decoder".

    Raises:
        FileFormatError: a file is damaged, or of another network.
        MissingDependencyError: a package is not installed.
    """
    damage = require("safetensors", extra=EXTRA).SafetensorError
    try:
        with without_bars():
            yield
    except (*DAMAGE, damage) as error:
        reason = " ".join(str(error).split())[:LONGEST_REASON]
        raise FileFormatError(f"{folder} cannot be loaded as {role}: {reason}") from error


@contextlib.contextmanager
def without_bars() -> Iterator[None]:
    """Inside, the libraries show no progress bars."""
    with contextlib.ExitStack() as stack:
        for name in LIBRARIES:
            bars = require(f"{name}.utils.logging", extra=EXTRA)
            if bars.is_progress_bar_enabled():
                bars.disable_progress_bar()
                stack.callback(bars.enable_progress_bar)
        yield
