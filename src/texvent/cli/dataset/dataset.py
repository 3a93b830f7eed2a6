"""`texvent dataset STEP`: the steps of a data set's life."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Mapping, Sequence

from texvent._registry import suggest
from texvent.errors import ConfigError, shown

STEPS: Mapping[str, str] = {
    "plan": "check a specification; counts, size and time before it runs",
    "make": "make a data set from a specification, or go on with one",
    "verify": "check every file of a data set, and every sample",
    "stats": "count what a data set holds",
    "sample": "a page with some samples",
    "export": "write the samples of a data set in another layout",
}
"""Name → what it does. `plan` and `make` have modules of their own; the others are in `stored`."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        sys.stdout.write(_usage())
        return 0 if arguments else 2
    name, *rest = arguments
    if name not in STEPS:
        raise ConfigError(f"unknown step {shown(name)}; {suggest(name, tuple(STEPS))}")
    if name in ("plan", "make"):
        module = importlib.import_module(f"texvent.cli.dataset.{name}")
    else:
        module = importlib.import_module("texvent.cli.dataset.stored")
    code: int = getattr(module, f"run_{name}")(rest)
    return code


def _usage() -> str:
    width = max(map(len, STEPS))
    lines = [f"  {name:<{width}}  {what}" for name, what in STEPS.items()]
    usage = ["usage: texvent dataset STEP [OPTIONS]", "", *lines]
    return "\n".join([*usage, "", "Help: texvent dataset STEP --help", ""])
