"""Where `physical` and a recorded sensor differ: events by intensity, polarity, delay and at rest.

    python -m texvent_lab.measure.real_pixels davis346 [--preset NAME] [--contrast-threshold 0.26]

Simulates the scored part of a recording from its frames (flow) and counts both streams by the
level of the frame at the event's pixel and time. A delay is how much later a recorded event is
than the nearest simulated one of its pixel and polarity. docs/real-data.md has the findings.
"""

from __future__ import annotations

import argparse

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent_lab.bench.fidelity.entries import Entry, simulate_video
from texvent_lab.bench.real.run import adapt_settings
from texvent_lab.bench.real.scene import RealScene, open_scene

LEVELS = (0, 3, 6, 10, 15, 20, 30, 45, 70, 100, 140, 190, 254, 256)
PAIRED_US = 15_000
"""A simulated event farther away than this is no partner."""
REST_LEVELS = 8
"""A pixel whose frames all lie within this range is at rest."""

Int64Array = NDArray[np.int64]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("recording")
    parser.add_argument("--preset")
    parser.add_argument("--contrast-threshold", type=float)
    options = parser.parse_args()
    scene = open_scene(options.recording)
    entry = Entry(simulator="physical", preset=options.preset, interpolate="flow")
    video = scene.frames_around(scene.whole)
    settings = adapt_settings(entry.settings(0), scene)
    simulated = simulate_video(video, settings, options.contrast_threshold).cut(*scene.whole)
    recorded = scene.recorded(scene.whole)
    by_level(scene, simulated, recorded)
    at_rest(scene, simulated, recorded)
    for name, events in (("recorded", recorded), ("simulated", simulated)):
        shares = np.percentile(intervals_us(events), [0.1, 1, 25, 50, 75])
        print(f"intervals, {name}, µs: " + " ".join(f"{share:.0f}" for share in shares))


def by_level(scene: RealScene, simulated: EventStream, recorded: EventStream) -> None:
    """Counts, share of ON and delays by level of the frames."""
    print("| level | recorded | simulated / recorded | ON | ON, simulated | delay ON, OFF, ms |")
    print("|---|---|---|---|---|---|")
    levels = [np.digitize(level_at(scene, one), LEVELS) - 1 for one in (recorded, simulated)]
    later_us = delay_us(recorded, simulated)
    for number in range(len(LEVELS) - 1):
        chosen, other = (level == number for level in levels)
        if not chosen.any():
            continue
        near = chosen & (np.abs(later_us) <= PAIRED_US)
        delays = [later_us[near & (recorded.p == p)] / 1000 for p in (1, 0)]
        told = ", ".join(f"{np.median(one):.1f}" if len(one) > 30 else "–" for one in delays)
        on = f"{simulated.p[other].mean():.2f}" if other.any() else "–"
        print(
            f"| {LEVELS[number]}–{LEVELS[number + 1]} | {chosen.sum():,} "
            f"| {other.sum() / chosen.sum():.2f} | {recorded.p[chosen].mean():.2f} | {on} "
            f"| {told} |"
        )


def at_rest(scene: RealScene, simulated: EventStream, recorded: EventStream) -> None:
    """Events of pixels whose light does not change."""
    video = scene.frames_around(scene.whole)
    rest = np.ptp(video.pixels, axis=0) <= REST_LEVELS
    seconds = max(int(rest.sum()), 1) * scene.whole.seconds
    for name, events in (("recorded", recorded), ("simulated", simulated)):
        p = events.p[rest[events.y, events.x]]
        print(
            f"at rest, {name}: {int(rest.sum())} pixels, {len(p) / seconds:.4f} events per second, "
            f"{int(p.sum())} ON, {len(p) - int(p.sum())} OFF"
        )


def level_at(scene: RealScene, events: EventStream) -> NDArray[np.float64]:
    """Level of the nearest frame at each event's pixel, [n]."""
    times = np.asarray(scene.video.times_us)
    number = np.searchsorted((times[1:] + times[:-1]) // 2, events.t)
    return np.asarray(scene.video.pixels[number, events.y, events.x], np.float64)


def delay_us(events: EventStream, others: EventStream) -> Int64Array:
    """How much later each event is than the nearest of its pixel and polarity, µs, [n]."""
    first_us = min(int(events.t[0]), int(others.t[0]))
    room = 2 * max(int(events.t[-1]), int(others.t[-1])) - 2 * first_us + 2
    own, sorted_keys = (
        place(one) * room + (one.t - first_us).astype(np.int64) for one in (events, others)
    )
    sorted_keys = np.sort(sorted_keys)
    after = np.searchsorted(sorted_keys, own)
    near = [sorted_keys[np.clip(after - back, 0, len(sorted_keys) - 1)] for back in (1, 0)]
    # A key of another pixel is farther away than any event of this one.
    before, behind = own - near[0], own - near[1]
    return np.where(np.abs(before) <= np.abs(behind), before, behind)


def intervals_us(events: EventStream) -> Int64Array:
    """Time between events of one pixel and polarity, µs."""
    order = np.lexsort((events.t, place(events)))
    same = np.diff(place(events)[order]) == 0
    return np.asarray(np.diff(events.t[order].astype(np.int64))[same])


def place(events: EventStream) -> Int64Array:
    """Pixel and polarity as one number, [n]."""
    pixel = events.y.astype(np.int64) * events.size.width + events.x
    return np.asarray(pixel * 2 + events.p, np.int64)


if __name__ == "__main__":
    main()
