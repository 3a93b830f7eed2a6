"""Properties of recorded times that networks rely on: one at a time is replaced in recordings.

Networks learn digits from the times of N-MNIST's recordings 1 to 500 and are shown the recordings
for fitting, as they are and with one property replaced. Run it by

    python -m texvent_lab.measure.digit_times MNIST N-MNIST
"""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.run.prepare import prepare_video
from texvent.run.rate_search import find_threshold
from texvent_lab.bench.digits.data import FIRST_TEST, read_mnist, read_recordings
from texvent_lab.bench.digits.inputs import REPRESENTATIONS, represent_all, represent_recordings
from texvent_lab.bench.digits.plan import SCHEDULE, find_arm
from texvent_lab.bench.digits.sheet import WIDE, Digits, DigitSheet
from texvent_lab.bench.digits.training import predict, train_network
from texvent_lab.bench.document import markdown_table
from texvent_lab.bench.summary import mean_text
from texvent_lab.train.schedule import EXTRA

KIND = "surface"
TAU_MS = REPRESENTATIONS[KIND].options["tau_us"] / 1000
PAIRS, RECORDED, NETWORKS, STEPS = 100, 500, 4, 384
ARMS = ("texvent accurate", "display of gamma 1", "as measured", "latency of 40 Hz")
DELAYS_MS = (-30, -15, 15, 30)
SPREADS_MS = (5, 10, 20)
Surfaces = NDArray[np.float64]
"""[n, 2, 34, 34]: exp(−age / τ) of the last event, 0 where there is none."""


def moved(surfaces: Surfaces, by_ms: Any) -> Surfaces:
    """The surfaces of events that are so much later, ms; none is later than the end."""
    return np.asarray(np.minimum(surfaces * np.exp(by_ms / TAU_MS), 1.0))


def times_of(other: Surfaces, surfaces: Surfaces) -> Surfaces:
    """Surfaces with the times of others, where both have an event."""
    return np.where((other > 0) & (surfaces > 0), other, surfaces)


def simulated(images: NDArray[np.uint8], name: str, target: float) -> Surfaces:
    """Digits with the measured motion, as an arm shows and simulates them, with as many events.

    Args:
        images: [n, 28, 28].
        name: of the arm.
        target: events of the digit in the middle.
    """
    arm = find_arm(name)
    sheet = DigitSheet(Digits.as_measured(images, arm.stimulus))

    def run(threshold: float) -> tuple[dict[str, NDArray[Any]], NDArray[np.int64]]:
        settings = arm.settings("exact", threshold=threshold)
        settings = dataclasses.replace(settings, run=dataclasses.replace(settings.run, seed=1))
        return represent_all(prepare_video(sheet, settings).packets.collect())

    match = find_threshold(
        lambda threshold: float(np.median(sheet.cut(run(threshold)[1]).sum(axis=(1, 2, 3)))),
        target,
        start=0.3 if arm.stimulus.black == WIDE.black else 0.1,
    )
    return sheet.cut(run(match.threshold)[0][KIND]).astype(np.float64)


def replaced(recorded: Surfaces, counts: NDArray[np.int64]) -> Iterator[tuple[str, Surfaces]]:
    """Recordings with one property of their own changed.

    Args:
        recorded: the surfaces.
        counts: [n, 2, 34, 34] events.
    """
    chance = np.random.default_rng(0).standard_normal(recorded.shape)
    yield "nothing", recorded
    for spread in SPREADS_MS:
        yield f"times of pixels ± {spread} ms, at random", moved(recorded, spread * chance)
    for delay in DELAYS_MS:
        yield f"all times {delay:+d} ms", moved(recorded, delay)
    is_lone = counts.sum(axis=1, keepdims=True) == 1
    yield "no pixels of a single event", np.where(is_lone, 0.0, recorded)


def main(mnist: Path, nmnist: Path) -> str:
    """Accuracy of the networks on each of the recordings, as a table."""
    torch = require("torch", extra=EXTRA)
    torch.set_num_threads(1)
    images = read_mnist(mnist).images[:PAIRS]
    pairs = read_recordings(nmnist, range(FIRST_TEST + 1, FIRST_TEST + 1 + PAIRS))
    shown = represent_recordings(pairs)
    counts = np.stack([represent_all(one.events)[1] for one in pairs])
    recorded = shown.images[KIND].astype(np.float64)
    rows = dict(replaced(recorded, counts))
    for name in ARMS:
        other = simulated(images, name, shown.median_count)
        rows[f"times: {name}"] = times_of(other, recorded)
        rows[f"pixels: {name}"] = times_of(recorded, other)
        rows[f"all: {name}"] = other
    seen = represent_recordings(read_recordings(nmnist, range(1, RECORDED + 1)))
    networks = [
        train_network(seen.images[KIND], seen.labels, steps=STEPS, schedule=SCHEDULE, seed=seed)
        for seed in range(NETWORKS)
    ]
    cells = [
        [name, mean_text([float((predict(one, row) == shown.labels).mean()) for one in networks])]
        for name, row in rows.items()
    ]
    return markdown_table(["replaced", "accuracy"], cells)


if __name__ == "__main__":
    sys.stdout.write(main(Path(sys.argv[1]), Path(sys.argv[2])))
