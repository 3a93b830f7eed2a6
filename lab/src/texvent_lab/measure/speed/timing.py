"""Times as quartiles."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np


def quartiles(values: Sequence[float], *, scale: float = 1.0) -> dict[str, Any]:
    """`median`, `q1`, `q3` and the number `n` of values, at least one, each times `scale`."""
    q1, median, q3 = np.percentile(np.asarray(values) * scale, (25, 50, 75)).tolist()
    return {"median": rounded(median), "q1": rounded(q1), "q3": rounded(q3), "n": len(values)}


def rounded(value: float) -> float:
    """Four significant digits: more would only look exact."""
    return value if isinstance(value, int) else float(f"{value:.4g}")


def seconds(call: Callable[[], Any]) -> float:
    """Wall time of one call, s."""
    start = time.perf_counter()
    call()
    return time.perf_counter() - start
