"""`texvent bench`: one benchmark per file, chosen by its name."""

from __future__ import annotations

import importlib
from collections.abc import Mapping, Sequence

from texvent.cli.notices import write_out
from texvent.errors import ConfigError, shown
from texvent.extending import suggest

BENCHMARKS: Mapping[str, str] = {
    "classify": "how many streams does N-ImageNet's classifier recognise?",
    "digits": "do networks trained on simulated events read recorded ones?",
    "fidelity": "which simulator comes closest to true events of exact scenes?",
    "page": "a result of fidelity, real or digits as a page with its charts",
    "paper": "the paper's tables, ablations E1-E12, or a folder of configs",
    "real": "which simulator comes closest to a real sensor?",
    "reconstruction": "whose events give a network the best images?",
    "selftest": "20 perturbations of a recording: which does a metric see?",
}
"""Name, which is its module beside this one → the question that it answers."""


def run(arguments: Sequence[str]) -> int:
    """Run the command; returns its exit code."""
    if not arguments or arguments[0] in ("-h", "--help"):
        write_out(_usage())
        return 0 if arguments else 2
    name, *rest = arguments
    if name not in BENCHMARKS:
        raise ConfigError(f"unknown benchmark {shown(name)}; {suggest(name, tuple(BENCHMARKS))}")
    importlib.import_module(f"texvent_lab.commands.bench.{name}").run(rest)
    return 0


def _usage() -> str:
    width = max(map(len, BENCHMARKS))
    lines = [f"  {name:<{width}}  {question}" for name, question in BENCHMARKS.items()]
    usage = ["usage: texvent bench NAME [OPTIONS]", "", *lines]
    return "\n".join([*usage, "", "Help: texvent bench NAME --help", ""])
