"""Measure, print the tables, write the JSON; see the package."""

from __future__ import annotations

import argparse
import os
import time
from pathlib import Path
from typing import Any

from texvent_lab.bench.document import describe_environment, read_document, write_document
from texvent_lab.measure.speed.kernels import FULL, QUICK, measure_definition, measure_kernels
from texvent_lab.measure.speed.peers import run_on_one_core
from texvent_lab.measure.speed.runs import measure_commands, measure_runs, measure_steps
from texvent_lab.measure.speed.tables import as_markdown


def main() -> None:
    """Measure what the options ask for, or show a result."""
    parser = argparse.ArgumentParser(prog="python -m texvent_lab.measure.speed")
    parser.add_argument(
        "--quick", action="store_true", help="ratios beside their bounds: 6 seconds"
    )
    parser.add_argument("--json", type=Path, help="write the figures here")
    parser.add_argument("--video", type=Path, help="real video; else a short excerpt")
    parser.add_argument("--show", type=Path, help="the tables of a stored result")
    chosen = parser.parse_args()
    if chosen.video is not None and not chosen.video.is_file():
        parser.error(f"no such file: {chosen.video}")
    if chosen.show is not None:
        document = read_document(chosen.show)
    else:
        document = measure(quick=chosen.quick, video=chosen.video)
    if chosen.json is not None:
        write_document(chosen.json, document, overwrite=True)
    print(as_markdown(document))


def measure(*, quick: bool, video: Path | None) -> dict[str, Any]:
    """All figures, ready for JSON.

    Args:
        quick: what the bounds need.
        video: real video; None: an excerpt that the tests have.
    """
    started, load = time.perf_counter(), os.getloadavg()[0]
    document: dict[str, Any] = {
        "schema_version": 2,
        "quick": quick,
        "environment": describe_environment(),
        "load_at_start": round(load, 2),
        "kernels": measure_kernels(QUICK if quick else FULL),
        "definition": measure_definition(),
        "peers": run_on_one_core(quick=quick, video=video),
    }
    if not quick:
        document["runs"] = measure_runs(video, pairs=20)
        document["steps"] = measure_steps(steps=100)
        document["commands"] = measure_commands(video)
    document["load_at_end"] = round(os.getloadavg()[0], 2)
    document["seconds"] = round(time.perf_counter() - started, 1)
    return document


if __name__ == "__main__":
    main()
