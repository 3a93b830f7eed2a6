"""Kill the making of a data set at random moments until it is whole, and compare every shard.

    python -m tests.soak.dataset_kills                      # 2,000 samples, 10 kills of each kind
    python -m tests.soak.dataset_kills --samples 400 --kills 3

One process makes the data set undisturbed; then two processes make it again. Meanwhile the driver
and the workers get SIGKILL at random moments, and the driver is started again. In the end all
shards must have the bytes of the undisturbed run, no sample may be missing or there twice, and no
hidden file may be left. It prints a table and ends with 1 if something is wrong.
"""

from __future__ import annotations

import argparse
import contextlib
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

COMMAND = [sys.executable, "-m", "texvent.cli.app", "dataset", "make"]
PAPER_SEEDS, ESIM_SEEDS = 15, 5
SPECIFICATION = f"""
name = "tiny"
samples_per_shard = 2
previews = false
filters = {{ min_events = 1 }}
[options]
fps = 120
interpolate = "none"
contrast_threshold = {{uniform = [0.1, 0.3]}}
[[sources]]
videos = ["clips/*.npy"]
[variants.paper]
seeds = {PAPER_SEEDS}
[variants.esim]
simulator = "esim"
seeds = {ESIM_SEEDS}
"""
PATIENCE_S = 120.0


@dataclass
class Score:
    """Kills of drivers and of workers, data sets made to their end, and faults."""

    drivers: int = 0
    workers: int = 0
    runs: int = 0
    faults: list[str] = field(default_factory=list)


def make_inputs(folder: Path, samples: int) -> Path:
    """Tiny clips and the specification of a data set of so many samples."""
    (folder / "clips").mkdir(parents=True)
    random_pixels = np.random.default_rng(0)
    for number in range(-(-samples // (PAPER_SEEDS + ESIM_SEEDS))):
        clip = random_pixels.integers(0, 255, (6, 12, 16), dtype=np.uint8)
        np.save(folder / "clips" / f"{number:05d}.npy", clip)
    path = folder / "tiny.toml"
    path.write_text(SPECIFICATION)
    return path


def digests(folder: Path) -> dict[str, str]:
    """Path of every shard → sha256 of its bytes."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in sorted(folder.rglob("*.tar"))
    }


def judge(folder: Path, wanted: Path) -> list[str]:
    """Faults of a data set that should be as another one."""
    faults, keys = [], Counter[str]()
    found, right = digests(folder), digests(wanted)
    faults += [f"other bytes: {name}" for name in right if found.get(name) != right[name]]
    faults += [f"more than asked for: {name}" for name in found.keys() - right.keys()]
    for name in found:
        record = (folder / name).with_suffix(".json")
        facts = json.loads(record.read_text()) if record.exists() else {"samples": []}
        if facts.get("sha256") != found[name]:
            faults.append(f"its record does not fit: {name}")
        keys.update(sample["key"] for sample in facts["samples"])
    faults += [f"{count} times: {key}" for key, count in keys.items() if count > 1]
    faults += [f"left: {path.name}" for path in folder.rglob(".texvent-*")]
    return faults


def descendants(pid: int) -> list[int]:
    """Process ids below a process, from /proc."""
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").glob("[0-9]*/stat"):
        with contextlib.suppress(OSError):
            words = entry.read_text().rpartition(")")[2].split()
            if words[0] != "Z":
                children.setdefault(int(words[1]), []).append(int(entry.parent.name))
    found, todo = [], [pid]
    while todo:
        below = children.get(todo.pop(), [])
        found += below
        todo += below
    return found


def is_alive(pid: int) -> bool:
    """True if a process runs; one that nobody has waited for does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_for_end(pids: list[int]) -> bool:
    """Wait until processes are gone; False if some stay."""
    ends = time.monotonic() + PATIENCE_S
    while any(is_alive(pid) for pid in pids):
        if time.monotonic() > ends:
            return False
        time.sleep(0.05)
    return True


def kill_worker(driver: int, chance: random.Random) -> bool:
    """Kill a worker of a driver; False if there is none. The tracker of resources is no worker."""
    workers = []
    for pid in descendants(driver):
        with contextlib.suppress(OSError):
            if b"spawn_main" in Path(f"/proc/{pid}/cmdline").read_bytes():
                workers.append(pid)
    if workers:
        with contextlib.suppress(ProcessLookupError):
            os.kill(chance.choice(workers), signal.SIGKILL)
    return bool(workers)


def make_once(
    words: list[str], chance: random.Random, pace_s: float, score: Score, kills: int
) -> bool:
    """Start the driver, kill it or a worker after a while; returns whether it came to its end."""
    driver = subprocess.Popen(
        [*COMMAND, *words, "--workers", "2", "--quiet"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    while score.drivers < kills or score.workers < kills:
        with contextlib.suppress(subprocess.TimeoutExpired):
            driver.wait(chance.uniform(0.05, 2.0) * pace_s)
        if driver.poll() is not None:
            break
        below = descendants(driver.pid)
        left = 2 * kills - score.drivers - score.workers
        if chance.random() * left < kills - score.drivers:
            driver.kill()
            score.drivers += 1
            driver.communicate()
            if not wait_for_end(below):
                score.faults.append("processes outlive the driver")
            return False
        score.workers += kill_worker(driver.pid, chance)
    error = driver.communicate(timeout=1200)[1]
    if driver.returncode:
        score.faults.append(f"the run ended with {driver.returncode}: {error[-300:]}")
    return True


def main() -> int:
    """Run the attacks; returns 1 if something is wrong."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=2000)
    parser.add_argument("--kills", type=int, default=10, help="of the driver, and of workers")
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    chance, score = random.Random(options.seed), Score()
    with tempfile.TemporaryDirectory(prefix="texvent-dataset-kills-") as name:
        specification = make_inputs(Path(name), options.samples)
        wanted, out = Path(name) / "wanted", Path(name) / "attacked"
        started = time.monotonic()
        whole = [*COMMAND, str(specification), "-o", str(wanted), "--workers", "1", "-q"]
        subprocess.run(whole, check=True)
        pace_s = max(3.0, (time.monotonic() - started) / options.kills / 2)
        words = [str(specification), "-o", str(out)]
        while not score.faults and min(score.drivers, score.workers) < options.kills:
            if make_once(words, chance, pace_s, score, options.kills):
                score.runs += 1
                score.faults += judge(out, wanted)
                shutil.rmtree(out)
    lines = [
        f"{score.drivers} drivers and {score.workers} workers killed, {score.runs} data sets "
        f"whole, {len(score.faults)} faults",
        *score.faults[:5],
    ]
    sys.stdout.write("\n".join(lines) + "\n")
    return 1 if score.faults else 0


if __name__ == "__main__":
    sys.exit(main())
