"""How well background activity filters tell noise from signal.

    python -m texvent_lab.measure.event_filters [--hot]

Events come from the embedded generator and carry labels. A filter is judged by the share of the
signal and of the noise that it keeps, over windows from 0.2 ms to 1 s: AUC is the area under that
curve, 1 for a perfect filter and 0.5 for one that guesses. Hot pixels are added to a scene.
"""

from __future__ import annotations

import argparse
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import texvent
from texvent.event_packets import EventPackets
from texvent.events import NOISE, SIGNAL, EventStream
from texvent.transform.edits import merge
from texvent.transform.filters.noise_filters import find_hot_pixels

SCENES = {
    "car": "a red car drives left past two trees, the camera follows it",
    "ball": "a red ball bounces on the grass",
    "hand": "a person waves a hand",
}
NOISE_HZ = (0.5, 2.0, 5.0)
WINDOWS_US = tuple(int(us) for us in np.geomspace(200, 1_000_000, 25))
FILTERS: dict[str, dict[str, Any]] = {
    "1 neighbour of 8 (Delbruck 2008)": {},
    "2 of 8 (STCF)": {"support": 2},
    "3 of 8 (STCF)": {"support": 3},
    "1 of 8, same polarity": {"polarity": True},
    "2 of 8, same polarity": {"support": 2, "polarity": True},
    "3 of 24": {"support": 3, "radius": 2},
}


class Curve(NamedTuple):
    """Shares kept by a filter, for every window."""

    signal: NDArray[np.float64]
    noise: NDArray[np.float64]

    @property
    def area(self) -> float:
        """Under signal kept over noise kept, from (0, 0) to (1, 1)."""
        noise = np.concatenate([[0.0], self.noise, [1.0]])
        signal = np.concatenate([[0.0], self.signal, [1.0]])
        return float(np.sum(np.diff(noise) * (signal[1:] + signal[:-1]) / 2))

    def signal_at(self, noise: float) -> float:
        """Share of the signal kept where that share of the noise is."""
        return float(np.interp(noise, [0.0, *self.noise, 1.0], [0.0, *self.signal, 1.0]))


def main() -> None:
    """Print one of the tables."""
    parser = argparse.ArgumentParser(description="Judge event filters.")
    parser.add_argument("--hot", action="store_true", help="judge hot pixels instead")
    (print_hot_pixels if parser.parse_args().hot else print_roc)()


def labelled(scene: str, noise_hz: float) -> EventStream:
    """Events of a scene with uniform noise, labelled."""
    return texvent.generate(
        SCENES[scene], seed=3, sensor="davis346", duration=1.0, noise="random",
        noise_rate_hz=noise_hz, label_noise=True,
    )  # fmt: skip


def labels_of(events: EventStream) -> NDArray[np.uint8]:
    """Signal or noise, of events that carry it."""
    if events.label is None:
        raise SystemExit("the events carry no labels")
    return events.label


def judge(events: EventStream, options: dict[str, Any]) -> Curve:
    """The curve of a filter over all windows."""
    shares = []
    label = labels_of(events)
    totals = np.array([(label == SIGNAL).sum(), (label == NOISE).sum()])
    for window_us in WINDOWS_US:
        kept = labels_of(events.filter("background-activity", window_us=window_us, **options))
        shares.append(np.array([(kept == SIGNAL).sum(), (kept == NOISE).sum()]) / totals)
    signal, noise = np.array(shares).T
    return Curve(signal, noise)


def print_roc() -> None:
    """AUC of every filter, and the signal kept with a tenth of the noise."""
    print("| filter |", " | ".join(f"{hz:g} Hz" for hz in NOISE_HZ), "|")
    print("|---|", "---|" * len(NOISE_HZ), sep="")
    recordings = {(scene, hz): labelled(scene, hz) for hz in NOISE_HZ for scene in SCENES}
    for name, options in FILTERS.items():
        cells = []
        for hz in NOISE_HZ:
            curves = [judge(recordings[scene, hz], options) for scene in SCENES]
            area = np.mean([one.area for one in curves])
            kept = np.mean([one.signal_at(0.1) for one in curves])
            cells.append(f"{area:.3f} / {kept:.2f}")
        print(f"| {name} |", " | ".join(cells), "|")
    for (scene, hz), events in recordings.items():
        share = float((labels_of(events) == NOISE).mean())
        print(f"{scene}, {hz:g} Hz: {len(events):,} events, {share:.1%} noise")


def print_hot_pixels() -> None:
    """How many of 100 hot pixels in a second of a scene are found, and how many others."""
    scene = labelled("car", 0.5)
    rng = np.random.default_rng(2)
    places = rng.choice(scene.size.width * scene.size.height, 100, replace=False)
    print("| rate of hot pixels | factor 20, 100 events | factor 5, 40 | factor 3, 20 |")
    print("|---|---|---|---|")
    for rate_hz in (50, 100, 200, 500):
        where = np.repeat(places, rng.poisson(rate_hz, len(places)))
        y, x = np.divmod(where, scene.size.width)
        t = np.sort(rng.integers(0, 1_000_000, len(where)))
        hot = EventStream.from_columns(x, y, t, np.ones_like(x), size=scene.size)
        both = merge([EventPackets([one], one.size) for one in (scene, hot)])
        cells = []
        for factor, least in ((20.0, 100), (5.0, 40), (3.0, 20)):
            found = np.flatnonzero(find_hot_pixels(both, factor=factor, least_events=least))
            right = int(np.isin(found, places).sum())
            cells.append(f"{right} % and {len(found) - right} others")
        print(f"| {rate_hz} Hz |", " | ".join(cells), "|")


if __name__ == "__main__":
    main()
