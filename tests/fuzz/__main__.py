"""`python -m tests.fuzz`: damaged inputs for every reader, and a table of what became of them.

    python -m tests.fuzz                          # all readers, 6,000 inputs, some minutes
    python -m tests.fuzz --only "events evt" -n 500 --first 1000
    python -m tests.fuzz --table table.md

Exit code 1 if anything but a reading or one line of error came out.
"""

from __future__ import annotations

import argparse
import contextlib
import queue
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .outcomes import BAD, Outcome, table
from .readers import readers
from .supervisor import Supervisor

INPUTS = 80
"""Per reader of weight 1."""


def main() -> int:
    """Run, report, print the table."""
    options = _options()
    chosen = [one for one in readers().values() if options.only in one.name]
    if not chosen:
        sys.exit(f"no reader has {options.only!r} in its name; there are: {', '.join(readers())}")
    work = [(one.name, round(options.count * one.weight)) for one in chosen]

    waiting = queue.SimpleQueue[tuple[str, int]]()
    for job in work:
        waiting.put(job)

    def run(_: int) -> list[Outcome]:
        found = []
        with Supervisor() as supervisor, contextlib.suppress(queue.Empty):
            while True:
                name, count = waiting.get_nowait()
                for number in range(options.first, options.first + count):
                    found.append(supervisor.one(name, number))
                    if found[-1].kind in BAD:
                        sys.stdout.write(f"{found[-1]}\n")
                        sys.stdout.flush()
        return found

    with ThreadPoolExecutor(options.jobs) as pool:
        outcomes = [one for part in pool.map(run, range(options.jobs)) for one in part]
    order = list(readers())
    outcomes.sort(key=lambda one: (order.index(one.reader), one.number))
    text = table(outcomes)
    sys.stdout.write(f"\n{text}")
    if options.table is not None:
        options.table.write_text(text, encoding="utf-8")
    return int(any(one.kind in BAD for one in outcomes))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--only", default="", help="readers whose name holds this text")
    parser.add_argument("-n", "--count", type=int, default=INPUTS, help="inputs per reader")
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("-j", "--jobs", type=int, default=2, help="processes at once")
    parser.add_argument("--table", type=Path, help="Markdown file for the table")
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
