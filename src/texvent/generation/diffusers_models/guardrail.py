"""NVIDIA's Cosmos guardrail: always on, and an error in it counts as a refusal.

The licence of Cosmos 1 and 2.5 ends when their guardrail is bypassed; that of Cosmos 3,
OpenMDW-1.1, has no such clause. texvent has no option to leave the guardrail out or to replace it,
for any of them. The `cosmos-guardrail` package treats an error in its text model as "safe"; here
every error that it logs stops the run before a frame is made. Its face pixelation changes frames,
and so events; it hands frames on with 8 bits.
"""

from __future__ import annotations

import logging
import sys
from collections.abc import Mapping
from importlib import metadata
from typing import Any

from texvent._require import install_command, require
from texvent.errors import InputError, TexventError

PACKAGE = "cosmos-guardrail"
MODULE = "cosmos_guardrail"
PART = "safety_checker"
GUARDRAIL_SWITCH = "enable_safety_checker"
"""Setting of Cosmos 3 that its saved index may leave off; texvent always sets it."""


def needs_guardrail(index: Mapping[str, Any]) -> bool:
    """True for pipelines of the Cosmos family and all that have a part of theirs.

    (Image models have a safety checker too: another one, for single images.)

    Args:
        index: content of `model_index.json`.
    """
    parts = [entry[1] for entry in index.values() if isinstance(entry, list) and len(entry) == 2]
    return any(str(name).startswith("Cosmos") for name in [index.get("_class_name"), *parts])


def load_guardrail() -> Any:
    """The real checker, with its own weights.

    Raises:
        MissingDependencyError: the package is not installed.
        TexventError: its weights cannot be loaded; nothing may be generated without them.
    """
    module = require(MODULE, extra="cosmos")
    try:
        return module.CosmosSafetyChecker()
    except (OSError, RuntimeError, ValueError, ImportError) as error:
        raise TexventError(
            "the Cosmos guardrail cannot be loaded, and Cosmos models must not run without it: "
            f"{str(error).splitlines()[0]}. Its weights (nvidia/Cosmos-Guardrail1, "
            "Qwen/Qwen3Guard-Gen-0.6B) are fetched from the model hub after their terms are "
            "accepted there"
        ) from error


def check_wiring(pipe: Any) -> None:
    """Refuse a pipeline that holds the guardrail but would not call it.

    diffusers decides when it is imported whether the package is there, and looks at frames only
    with a checker of the class it knows.

    Raises:
        TexventError: the pipeline does not know the class of its checker.
    """
    known = getattr(sys.modules[type(pipe).__module__], "CosmosSafetyChecker", None)
    checker = getattr(pipe, PART, None)
    if known is None or not isinstance(checker, known):
        raise TexventError(
            f"{type(pipe).__name__} does not use its guardrail, so nothing is generated; install "
            f"it before Python starts: {install_command(PACKAGE)}"
        )


def check_prompt(checker: Any, prompt: str) -> None:
    """Refuse a prompt that the guardrail blocks, or that it could not check.

    Raises:
        InputError: the prompt is blocked.
        TexventError: the guardrail itself failed.
    """
    listener = _ErrorListener()
    logger = logging.getLogger(MODULE)
    logger.addHandler(listener)
    try:
        is_safe = checker.check_text_safety(prompt)
    except (RuntimeError, ValueError, OSError, TypeError, AttributeError, LookupError) as error:
        raise TexventError(f"the Cosmos guardrail failed ({error}); no video is made") from error
    finally:
        logger.removeHandler(listener)
    if listener.first is not None and is_safe:
        raise TexventError(f"the Cosmos guardrail failed ({listener.first}); no video is made")
    if is_safe is not True:
        raise InputError(
            "the Cosmos guardrail blocks this prompt; reword it, or use another generator"
        )


def guardrail_version() -> str:
    """Version of the installed package, for the metadata of outputs."""
    try:
        return metadata.version(PACKAGE)
    except metadata.PackageNotFoundError:
        return "unknown"


class _ErrorListener(logging.Handler):
    """Remembers the first error that the package logs."""

    def __init__(self) -> None:
        super().__init__(level=logging.ERROR)
        self.first: str | None = None

    def emit(self, record: logging.LogRecord) -> None:
        if self.first is None and record.levelno == logging.ERROR:
            self.first = record.getMessage()
