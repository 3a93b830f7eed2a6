"""`python -m tests.fuzz`: damaged inputs for every reader, and what became of them.

    python -m tests.fuzz                          # all readers, 6,000 inputs, some minutes
    python -m tests.fuzz --only "events evt" -n 500 --first 1000

Exit code 1 if anything but a reading or one line of error came out.
"""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

from .reader import Reader
from .worker import BAD, Worker, readers

INPUTS = 80
"""Per reader of weight 1."""


def main() -> int:
    """Run, print a line per reader."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--only", default="", help="readers whose name holds this text")
    parser.add_argument("-n", "--count", type=int, default=INPUTS, help="inputs per reader")
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("-j", "--jobs", type=int, default=2, help="processes at once")
    options = parser.parse_args()
    chosen = [one for one in readers().values() if options.only in one.name]
    if not chosen:
        sys.exit(f"no reader has {options.only!r} in its name; there are: {', '.join(readers())}")

    def run(reader: Reader) -> Counter[str]:
        counts: Counter[str] = Counter()
        worker, last = Worker(), options.first + round(options.count * reader.weight)
        for number in range(options.first, last):
            found = worker.one(reader.name, number)
            counts[found.kind] += 1
            if found.kind in BAD:
                sys.stdout.write(f"{reader.name} {number}: {found}\n")
        worker.end()
        figures = ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items()))
        sys.stdout.write(f"{reader.name}: {figures}\n")
        sys.stdout.flush()
        return counts

    with ThreadPoolExecutor(options.jobs) as pool:
        whole = sum(pool.map(run, chosen), Counter[str]())
    sys.stdout.write(f"all: {dict(whole)}\n")
    return int(any(whole[kind] for kind in BAD))


if __name__ == "__main__":
    sys.exit(main())
