"""Run jobs in one process for a long time; memory, descriptors and threads must stay flat.

    python -m tests.soak.soak                 # an hour
    python -m tests.soak.soak --minutes 5

Each job is drawn at random: a prompt or a clip, a simulator, an interpolator and a format, or bad
input that is refused. Every minute it prints resident memory, open descriptors and threads. It ends
with 1 if, after the first third, memory rose by more than a tenth, or descriptors or threads rose.
"""

from __future__ import annotations

import argparse
import gc
import os
import random
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import texvent

PROMPTS = ("a red car drives left", "a dog runs past two trees", "a ball bounces at night")
EXTENSIONS = (".h5", ".npz", ".aedat4", ".raw", ".txt", ".csv", ".dat")
TORCH_ONLY = ("v2ce",)
SPARE_DESCRIPTORS = 2
"""Some are open for a moment while they are counted."""


@dataclass(frozen=True)
class Sample:
    """What the process holds."""

    jobs: int
    resident_mb: float
    descriptors: int
    threads: int


def measure(jobs: int) -> Sample:
    """Resident memory, MB, and counts of this process."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return Sample(
        jobs,
        pages * os.sysconf("SC_PAGE_SIZE") / 2**20,
        len(os.listdir("/proc/self/fd")),
        threading.active_count(),
    )


def run_job(folder: Path, chance: random.Random) -> None:
    """One job; bad input must be refused."""
    simulators = [name for name in texvent.simulators() if name not in TORCH_ONLY]
    options = {"simulator": chance.choice(simulators), "seed": chance.randrange(2**31)}
    kind = chance.choice(("prompt", "clip", "bad"))
    if kind == "bad":
        (folder / "bad.h5").write_bytes(chance.randbytes(chance.randrange(1, 5000)))
        try:
            texvent.load(folder / "bad.h5")
        except texvent.TexventError:
            return
        raise SystemExit("a file of random bytes was read")
    if kind == "prompt":
        events = texvent.generate(
            chance.choice(PROMPTS), duration=0.1, sensor="48x36", samples=1, **options
        )
    else:
        texture = np.random.default_rng(options["seed"]).integers(40, 200, (48, 120), np.uint8)
        clip = np.stack([np.roll(texture, step, axis=1)[:, :64] for step in range(12)])
        ways = ("none", "blend", "flow")
        events = texvent.simulate(clip, fps=60, interpolate=chance.choice(ways), **options)
    path = folder / f"events{chance.choice(EXTENSIONS)}"
    events.save(path, overwrite=True)
    if len(texvent.load(path, size=events.size)) != len(events):
        raise SystemExit(f"{path.suffix} lost events")
    if chance.random() < 0.1:
        events.show(folder / "page.html", overwrite=True)


def main() -> int:
    """Run the soak; returns 1 if something rose."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    chance, jobs, samples = random.Random(options.seed), 0, []
    started = time.monotonic()
    step_s = min(60.0, options.minutes * 60 / 12)
    with tempfile.TemporaryDirectory(prefix="texvent-soak-") as name:
        while (passed := time.monotonic() - started) < options.minutes * 60:
            run_job(Path(name), chance)
            jobs += 1
            if passed >= len(samples) * step_s:
                samples.append(measure(jobs))
                sys.stdout.write(f"{passed:6.0f} s  {samples[-1]}\n")
                sys.stdout.flush()
    first, last = samples[len(samples) // 3], samples[-1]
    is_flat = (
        last.resident_mb <= 1.1 * first.resident_mb
        and last.descriptors <= first.descriptors + SPARE_DESCRIPTORS
        and last.threads <= first.threads
    )
    sys.stdout.write("flat\n" if is_flat else f"rose from {first} to {last}\n")
    return 0 if is_flat else 1


if __name__ == "__main__":
    sys.exit(main())
