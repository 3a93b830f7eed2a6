"""`texvent bench`: one benchmark per file, chosen by its name."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence

from texvent._registry import suggest
from texvent.errors import ConfigError

BENCHMARKS: Mapping[str, str] = {
    "classify": "how many streams does N-ImageNet's classifier recognise?",
    "fidelity": "which simulator comes closest to true events of exact scenes?",
    "page": "a result of fidelity or real as a page with tables and plots",
    "paper": "the paper's tables, ablations E1-E12, or a folder of configs",
    "real": "which simulator comes closest to a real sensor?",
    "reconstruction": "whose events give a network the best images?",
    "selftest": "20 perturbations of a recording: which does a metric see?",
    "unpaired": "do simulated streams have the statistics of recorded ones?",
}
"""Name → the question that it answers."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        sys.stdout.write(_usage())
        return 0 if arguments else 2
    name, *rest = arguments
    if name not in BENCHMARKS:
        raise ConfigError(f"unknown benchmark {name!r}; {suggest(name, tuple(BENCHMARKS))}")
    _command(name)(rest)
    return 0


def _command(name: str) -> Callable[[Sequence[str]], None]:
    """What runs a benchmark; only the chosen one is imported, and its libraries with it."""
    match name:
        case "classify":
            from texvent.cli.bench.classify import run
        case "fidelity":
            from texvent.cli.bench.fidelity import run
        case "page":
            from texvent.cli.bench.page import run
        case "paper":
            from texvent.cli.bench.paper import run
        case "real":
            from texvent.cli.bench.real import run
        case "reconstruction":
            from texvent.cli.bench.reconstruction import run
        case "selftest":
            from texvent.cli.bench.selftest import run
        case _:
            from texvent.cli.bench.unpaired import run
    return run


def _usage() -> str:
    width = max(map(len, BENCHMARKS))
    lines = [f"  {name:<{width}}  {question}" for name, question in BENCHMARKS.items()]
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
