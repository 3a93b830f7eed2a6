"""`texvent bench`: one benchmark per file, chosen by its name."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence

from texvent._registry import load_object, suggest
from texvent.errors import ConfigError

BENCHMARKS: Mapping[str, tuple[str, str]] = {
    "classify": (
        "texvent.cli.bench.classify:run",
        "how many streams does N-ImageNet's classifier recognise?",
    ),
    "fidelity": (
        "texvent.cli.bench.fidelity:run",
        "which simulator comes closest to true events of exact scenes?",
    ),
    "page": (
        "texvent.cli.bench.page:run",
        "a result of fidelity or real as a page with tables and plots",
    ),
    "paper": (
        "texvent.cli.bench.paper:run",
        "the paper's tables, ablations E1-E12, or a folder of configs",
    ),
    "real": (
        "texvent.cli.bench.real:run",
        "which simulator comes closest to a real sensor?",
    ),
    "reconstruction": (
        "texvent.cli.bench.reconstruction:run",
        "whose events give a network the best images?",
    ),
    "selftest": (
        "texvent.cli.bench.selftest:run",
        "20 perturbations of a recording: which does a metric see?",
    ),
    "unpaired": (
        "texvent.cli.bench.unpaired:run",
        "do simulated streams have the statistics of recorded ones?",
    ),
}
"""Name → what runs it, by name so that only the chosen one loads; and what it answers."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        sys.stdout.write(_usage())
        return 0 if arguments else 2
    name, *rest = arguments
    if name not in BENCHMARKS:
        raise ConfigError(f"unknown benchmark {name!r}; {suggest(name, tuple(BENCHMARKS))}")
    load_object(BENCHMARKS[name][0])(rest)
    return 0


def _usage() -> str:
    width = max(map(len, BENCHMARKS))
    lines = [f"  {name:<{width}}  {question}" for name, (_, question) in BENCHMARKS.items()]
    return "\n".join(
        [
            "usage: texvent bench NAME [OPTIONS]",
            "",
            *lines,
            "",
            "Help: texvent bench NAME --help",
            "",
        ]
    )
