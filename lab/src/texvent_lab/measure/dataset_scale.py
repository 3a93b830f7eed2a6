"""How a data set's making scales: one and two workers measured, a thousand simulated.

    python -m texvent_lab.measure.dataset_scale [--samples 1000] [--repeats 7] [--json FILE]

Tiny clips are simulated, 20 samples a shard. Processes and Ray (extra `ray`; a cluster for this
run) make them with one worker and with two, in turn, after shards that are not counted; the ratio
of samples per second counts. Then Ray makes shards of one clip with as many of them in its queue as
for 1,000 CPUs: what the driver's own thread computes for a shard, from submission to bookkeeping,
is its price, and so is what it keeps in memory for a sample.

From these and the measured times of shards follows the schedule of 1,000 workers: the driver hands
out one shard after the other, two per worker are at the cluster, a free worker takes the next, and
a shard takes as long as a measured one, times a factor. How busy the workers are says where the
driver's limit lies; at the end, some wait for the last shards.
"""

from __future__ import annotations

import argparse
import gc
import heapq
import json
import os
import random
import statistics
import tempfile
import time
import tracemalloc
from collections.abc import Callable, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import numpy as np

from texvent.dataset.generation.engines import Engine, ProcessEngine
from texvent.dataset.generation.make import Work, find_work, make_shards
from texvent.dataset.generation.ray_cluster import RayEngine
from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.generation.status import read_status
from texvent.dataset.specification.reading import specification_from

SEEDS = 10
WORKERS = 1000
AHEAD = 2
SHARD_SECONDS = (1, 10, 60, 600)


def make_recipe(folder: Path, samples: int, *, clips_per_shard: int, seeds: int = SEEDS) -> Recipe:
    """Tiny clips in a folder, and how they become so many samples."""
    clips = folder / f"clips-{samples}-{clips_per_shard}"
    clips.mkdir(exist_ok=True)
    pixels = np.random.default_rng(0)
    for number in range(-(-samples // seeds)):
        clip = pixels.integers(0, 255, (6, 12, 16), dtype=np.uint8)
        np.save(clips / f"{number:06d}.npy", clip)
    tables = {
        "name": "tiny",
        "samples_per_shard": clips_per_shard,
        "previews": False,
        "filters": {"min_events": 1},
        "options": {"fps": 120, "interpolate": "none"},
        "sources": [{"videos": [f"{clips.name}/*.npy"]}],
        "variants": {"paper": {"seeds": seeds}},
    }
    return Recipe.of(specification_from(tables, folder=folder))


def make(recipe: Recipe, engine: Engine) -> tuple[Work, float, float]:
    """Make a data set in a folder of its own: what was made, seconds, seconds of this thread."""
    with tempfile.TemporaryDirectory(dir="/tmp") as name:
        folder = Path(name) / "set"
        recipe.begin(folder)
        work = find_work(recipe, folder)
        started, own = time.perf_counter(), time.thread_time()
        make_shards(work, engine, lambda outcome: None)
        return work, time.perf_counter() - started, time.thread_time() - own


def measure_rates(
    folder: Path, samples: int, repeats: int
) -> tuple[dict[str, list[float]], list[float]]:
    """Samples per second of every engine and number of workers, and seconds of single shards."""
    warm = make_recipe(folder, 8 * SEEDS, clips_per_shard=1)
    recipe = make_recipe(folder, samples, clips_per_shard=2)
    engines: dict[str, Callable[[int], Engine]] = {
        "processes": ProcessEngine,
        "Ray": lambda workers: RayEngine("local", workers=workers),
    }
    rates: dict[str, list[float]] = {}
    seconds: list[float] = []
    for _ in range(repeats):
        for name, start in engines.items():
            for workers in (1, 2):
                with closing(start(workers)) as engine:
                    make(warm, engine)
                    work, took, _ = make(recipe, engine)
                rates.setdefault(f"{name}, {workers}", []).append(samples / took)
                if workers == 1:
                    # The first may have started its process, which no shard does again.
                    seconds += [shard.seconds for shard in work.complete.values()][1:]
    return rates, seconds


class LongQueue(RayEngine):
    """As if the cluster had many more CPUs."""

    queue = 0

    def capacity(self, *, videos: bool) -> int:
        """What was asked for."""
        return self.queue


def measure_driver(folder: Path, queue: int) -> dict[str, float]:
    """What the driver does for a shard, with a queue as long as for many CPUs."""
    recipe = make_recipe(folder, queue, clips_per_shard=1, seeds=1)
    with closing(LongQueue("local", workers=os.cpu_count())) as engine:
        engine.queue = queue
        work, _, own = make(recipe, engine)
    return {"shards": len(work.complete), "driver_ms": 1e3 * own / len(work.complete)}


def measure_folder(folder: Path, samples: int) -> dict[str, float]:
    """What the table of progress costs, and what is kept, per sample of shards of 100 samples."""
    recipe = make_recipe(folder, samples, clips_per_shard=10)
    with closing(ProcessEngine(2)) as engine, tempfile.TemporaryDirectory(dir="/tmp") as name:
        out = Path(name) / "set"
        recipe.begin(out)
        make_shards(find_work(recipe, out), engine, lambda outcome: None)
        started = time.thread_time()
        read_status(recipe, out)
        status = time.thread_time() - started
        gc.collect()
        tracemalloc.start()
        work = find_work(recipe, out)
        kept, _ = tracemalloc.get_traced_memory()
        tracemalloc.stop()
    count = sum(record.samples for record in work.complete.values())
    return {"status_us": 1e6 * status / count, "kept_bytes": kept / count}


def simulate_schedule(
    seconds: Sequence[float], driver_s: float, *, workers: int, shards: int, seed: int = 0
) -> float:
    """How busy workers are, 0..1, when one driver hands out shards and takes them back.

    Args:
        seconds: how long shards take, to draw from.
        driver_s: what the driver does for each, one after the other.
        workers: how many there are.
        shards: how many are made.
        seed: of the draws.
    """
    draw, clock, busy = random.Random(seed), 0.0, 0.0
    free_at = [0.0] * workers
    returns: list[float] = []
    for number in range(shards):
        if number >= AHEAD * workers:
            clock = max(clock, heapq.heappop(returns))
        clock += driver_s
        length = draw.choice(seconds)
        end = max(clock, heapq.heappop(free_at)) + length
        heapq.heappush(free_at, end)
        heapq.heappush(returns, end)
        busy += length
    return busy / (workers * max(free_at))


def main() -> None:
    """Measure, simulate and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--queue", type=int, default=AHEAD * WORKERS)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    result: dict[str, Any] = {"cores": os.cpu_count(), "load": os.getloadavg()[0]}
    with tempfile.TemporaryDirectory(dir="/tmp") as name:
        rates, seconds = measure_rates(Path(name), options.samples, options.repeats)
        result["rates"] = {name: statistics.median(one) for name, one in rates.items()}
        result |= measure_driver(Path(name), options.queue)
        result |= measure_folder(Path(name), options.samples)
    print(f"{result['cores']} cores, load {result['load']:.1f}")
    for engine in ("processes", "Ray"):
        pairs = zip(rates[f"{engine}, 1"], rates[f"{engine}, 2"], strict=True)
        low, ratio, high = statistics.quantiles([two / one for one, two in pairs], n=4)
        result[f"ratio {engine}"] = [low, ratio, high]
        one, two = (result["rates"][f"{engine}, {workers}"] for workers in (1, 2))
        print(
            f"{engine:10} {one:7.0f} and {two:7.0f} samples/s with 1 and 2 workers: {ratio:.2f} × "
            f"({low:.2f} to {high:.2f})"
        )
    low, high = min(seconds) / statistics.mean(seconds), max(seconds) / statistics.mean(seconds)
    print(f"shards     took {low:.2f} to {high:.2f} times their mean")
    result["shard_times"] = [low, high]
    driver_s = result["driver_ms"] / 1e3
    print(
        f"driver     {result['driver_ms']:.2f} ms per shard, {options.queue} in its queue; "
        f"{result['kept_bytes'] / 1e3:.1f} kB kept and {result['status_us']:.0f} µs per look at "
        "the folder, per sample"
    )
    print(f"1,000 workers, {1 / driver_s:.0f} shards/s at most:")
    result["busy"] = {}
    for length in SHARD_SECONDS:
        scale = length / statistics.mean(seconds)
        busy = simulate_schedule(
            [scale * one for one in seconds], driver_s, workers=WORKERS, shards=20 * WORKERS
        )
        result["busy"][length] = busy
        print(
            f"  shards of {length:4} s: workers busy {100 * busy:.0f} %; "
            f"the driver serves {length / driver_s:,.0f} workers"
        )
    if options.json is not None:
        options.json.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
