"""Times as quartiles, measured in turns so that a slow moment of the machine hits all alike."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np


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
