"""CPU seconds that every metric takes for one pair of recordings.

    OPENBLAS_NUM_THREADS=1 python -m texvent_lab.measure.metrics [--events 300000] [--json F]

Both recordings hold random events on 346×260 px over 0.5 s: no pixel is quieter than another, the
worst case for metrics that look at pixels or pairs. CPU time, of one thread if NumPy is told so as
above: several would spend part of it waiting for each other. The first call is not counted. EQS
runs the backbone rvt-s with random numbers for weights, if torch is installed: the arithmetic is
the same. docs/design.md shows the table that this prints.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from texvent.errors import MissingDependencyError
from texvent.events import EventStream
from texvent.extending import require
from texvent.metrics.compare import default_metrics
from texvent.metrics.latent_similarity import EventQualityScore
from texvent.metrics.protocol import Metric
from texvent.metrics.rvt_backbone import EXTRA, LAYOUTS, RvtBackbone, RvtWeights
from texvent.sensor import SensorSize
from texvent_lab.bench.document import write_document
from texvent_lab.bench.machine import describe_environment

SCHEMA = "texvent-metric-speed-1"
SIZE = SensorSize(346, 260)
SPAN_US = 500_000
RVT_S = LAYOUTS[1]


def main() -> None:
    """Print the table, and write the document with --json."""
    parser = argparse.ArgumentParser(description="Measure how long every metric takes.")
    parser.add_argument("--events", type=int, default=300_000)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--json", type=Path, help="keep the result")
    arguments = parser.parse_args()
    pair = [random_events(seed, arguments.events) for seed in (1, 2)]
    document = {
        "schema": SCHEMA,
        "environment": describe_environment(),
        "events": arguments.events,
        "size": str(SIZE),
        "span_us": SPAN_US,
        "repeats": arguments.repeats,
        "rows": [measure(metric, pair, arguments.repeats) for metric in chosen_metrics()],
    }
    if arguments.json is not None:
        write_document(arguments.json, document, overwrite=True)
    print(speed_table(document), end="")


def chosen_metrics() -> list[Metric]:
    """All metrics whose weights are here, and EQS with random weights."""
    metrics = default_metrics()
    try:
        torch = require("torch", extra=EXTRA)
    except MissingDependencyError:
        return metrics
    torch.set_num_threads(1)
    generator = torch.Generator().manual_seed(0)
    tensors = {
        name: 0.05 * torch.randn(shape, generator=generator)
        for name, shape in RVT_S.tensor_shapes().items()
    }
    return [*metrics, EventQualityScore(backbone=RvtBackbone(RvtWeights(RVT_S, tensors)))]


def random_events(seed: int, count: int) -> EventStream:
    """Events at random places and times."""
    rng = np.random.default_rng(seed)
    x, y, p = (rng.integers(0, side, count) for side in (*SIZE, 2))
    return EventStream.from_columns(x, y, np.sort(rng.integers(0, SPAN_US, count)), p, size=SIZE)


def measure(metric: Metric, pair: list[EventStream], repeats: int) -> dict[str, Any]:
    """Least and median CPU seconds of a metric."""
    metric(*pair)
    taken = []
    for _ in range(repeats):
        begin = time.process_time()
        metric(*pair)
        taken.append(time.process_time() - begin)
    return {
        "metric": metric.name,
        "least_s": round(min(taken), 4),
        "median_s": round(float(np.median(taken)), 4),
    }


def speed_table(document: Mapping[str, Any]) -> str:
    """Markdown table of a document, the fastest first."""
    rows = sorted(document["rows"], key=lambda row: row["least_s"])
    lines = ["| metric | CPU s |", "|---|---|"]
    lines += [f"| `{row['metric']}` | {row['least_s']:.2g} |" for row in rows]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    main()
