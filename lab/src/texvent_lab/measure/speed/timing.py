"""Times as quartiles, and the least time that the machine's memory allows."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.jit import jit
from texvent.sensor import SensorSize


@dataclass(frozen=True)
class Quartiles:
    """Median, quartiles and number of the values measured, in one unit."""

    median: float
    q1: float
    q3: float
    n: int

    @classmethod
    def of(cls, values: Sequence[float], *, scale: float = 1.0) -> Quartiles:
        """Quartiles of `values`, at least one, each multiplied by `scale`."""
        q1, median, q3 = np.percentile(np.asarray(values) * scale, (25, 50, 75))
        return cls(float(median), float(q1), float(q3), len(values))

    def as_json(self) -> dict[str, Any]:
        """As JSON has it, rounded to four digits."""
        return {key: rounded(value) for key, value in asdict(self).items()}


def rounded(value: float) -> float:
    """Four significant digits: more would only look exact."""
    return value if isinstance(value, int) else float(f"{value:.4g}")


def seconds(call: Callable[[], Any]) -> float:
    """Wall time of one call, s."""
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def cpu_in_turns(calls: Mapping[str, Callable[[], Any]], *, rounds: int) -> dict[str, list[float]]:
    """CPU seconds, of all threads, of each call in each round; a round runs all once, in order."""
    times: dict[str, list[float]] = {name: [] for name in calls}
    for _ in range(rounds):
        for name, call in calls.items():
            start = time.process_time()
            call()
            times[name].append(time.process_time() - start)
    return times


DRAM_BYTES = 1 << 28
"""More than any cache holds."""
CACHE_BYTES = 1 << 21
"""About what a 720p frame, its state and its events take."""
CACHE_PASSES = 32
BYTES_PER_EVENT = 13
"""x and y in two bytes each, t in eight, p in one."""


@jit
def _read(words: NDArray[np.uint64], passes: int) -> np.uint64:
    total = np.uint64(0)
    for turn in range(passes):
        for i in range(words.size):
            total += words[i] ^ np.uint64(turn)
    return total


@dataclass(frozen=True)
class Bandwidth:
    """Bytes per second that can be read, best of several tries."""

    dram: float
    cache: float

    def floor_s(self, size: SensorSize, events: float) -> float:
        """Least time of one 8-bit frame, s.

        The frame comes from DRAM; one byte of state per pixel and the events stay in the cache.
        """
        pixels = size.width * size.height
        return pixels / self.dram + (pixels + BYTES_PER_EVENT * events) / self.cache

    def as_json(self) -> dict[str, float]:
        """In GB/s."""
        return {"dram_gb_s": round(self.dram / 1e9, 1), "cache_gb_s": round(self.cache / 1e9, 1)}


def measure_bandwidth(threads: int, *, tries: int = 7) -> Bandwidth:
    """Read speed of so many threads together, each on its own part."""
    whole = np.ones(DRAM_BYTES // 8, np.uint64)
    parts = np.array_split(whole, threads)
    pieces = [np.ones(CACHE_BYTES // 8, np.uint64) for _ in range(threads)]
    _read(pieces[0], 1)
    dram = [seconds(lambda: _together(_read, [(part, 1) for part in parts])) for _ in range(tries)]
    cache = [
        seconds(lambda: _together(_read, [(piece, CACHE_PASSES) for piece in pieces]))
        for _ in range(tries)
    ]
    read = CACHE_BYTES * CACHE_PASSES * threads
    return Bandwidth(dram=DRAM_BYTES / min(dram), cache=read / min(cache))


def _together(call: Callable[..., Any], arguments: list[tuple[Any, ...]]) -> None:
    """The call with each of the arguments, each in a thread of its own but the first."""
    others = [threading.Thread(target=call, args=one) for one in arguments[1:]]
    for thread in others:
        thread.start()
    call(*arguments[0])
    for thread in others:
        thread.join()
