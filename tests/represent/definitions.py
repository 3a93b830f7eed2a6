"""Every representation written as its source states it, one event at a time, in exact fractions."""

import math
from fractions import Fraction

import numpy as np
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.represent.named import WINDOW_OPTIONS
from texvent.sensor import SensorSize

SMALL = SensorSize(4, 3)


def rows(events):
    columns = (events.x, events.y, events.t, events.p)
    return [tuple(map(int, row)) for row in zip(*columns, strict=True)]


def kernel(a):
    """Zhu et al., eq. 3."""
    return max(Fraction(0), 1 - abs(Fraction(a)))


def event_volume(events, bins, *, lanes=1, place=None):
    """Zhu et al., eqs. 1 and 2, with every voxel visited for every event.

    `place` maps a pixel to where it is drawn.
    """
    width, height = events.size
    volume = np.full((lanes * bins, height, width), Fraction(0))
    listed = rows(events)
    for x, y, t, p in listed:
        start, stop = listed[0][2], listed[-1][2]
        scaled = Fraction((bins - 1) * (t - start), max(stop - start, 1))
        at_x, at_y = (x, y) if place is None else place[y][x]
        for b in range(bins):
            for row in range(height):
                for column in range(width):
                    weight = kernel(b - scaled) * kernel(row - at_y) * kernel(column - at_x)
                    lane = (1 - p) * bins if lanes == 2 else 0
                    volume[lane + b, row, column] += weight if lanes == 2 else weight * (2 * p - 1)
    return volume.astype(np.float64).astype(np.float32)


def event_frame(events, kind="signed"):
    counts = histogram_2d(events)
    off, on = counts
    return {
        "count": counts.astype(np.int32),
        "binary": ((off + on) > 0).astype(np.uint8),
        "signed": (on - off).astype(np.int32),
        "polarity": ((np.sign(on - off) + 1) / 2).astype(np.float32),
    }[kind]


def voxel_zhu(events, bins=9, split_polarity=False):
    return event_volume(events, bins, lanes=2 if split_polarity else 1)


def voxel_e2vid(events, bins=5, normalise=False):
    grid = event_volume(events, bins)
    return normalised(grid) if normalise else grid


def voxel_dsec(events, bins=15, normalise=True, rectify_map=None):
    grid = event_volume(events, bins, place=rectify_map)
    return normalised(grid) if normalise else grid


def normalised(grid):
    """Mean 0 and standard deviation 1 of the values that are not zero."""
    values = grid[grid != 0].astype(np.float64)
    result = np.zeros(grid.shape, np.float32)
    if len(values):
        deviation = values.std(ddof=1) if np.ptp(values) else 1.0
        result[grid != 0] = (values - values.mean()) / deviation
    return result


def time_surface(events, tau_us=30_000, decay="exponential", at_us=None):
    surface = np.zeros((2, *events.size.shape))
    for x, y, t, p in rows(events):
        instant = int(events.t[-1]) if at_us is None else at_us
        if t <= instant:
            age = (instant - t) / tau_us
            surface[p, y, x] = math.exp(-age) if decay == "exponential" else max(0, 1 - age)
    return surface.astype(np.float32)


def stacked_histogram(events, bins=10, cutoff=10):
    counts = np.zeros((2 * bins, *events.size.shape), dtype=np.uint8)
    listed = rows(events)
    for x, y, t, p in listed:
        span = max(listed[-1][2] - listed[0][2], 1)
        time_bin = min(math.floor(Fraction(t - listed[0][2], span) * bins), bins - 1)
        channel = p * bins + time_bin
        counts[channel, y, x] = min(int(counts[channel, y, x]) + 1, cutoff)
    return counts


def histogram_2d(events, shape=None):
    return histogram_3d(events, bins=1, shape=shape)[:, 0]


def histogram_3d(events, bins=9, start_us=None, stop_us=None, shape=None):
    width, height = events.size
    down, across = (height, width) if shape is None else shape
    counts = np.zeros((2, bins, down, across), dtype=np.float32)
    listed = rows(events)
    for x, y, t, p in listed:
        start = listed[0][2] if start_us is None else start_us
        stop = max(listed[-1][2] + 1, start + 1) if stop_us is None else stop_us
        share = Fraction(t - start, stop - start)
        if 0 <= share < 1:
            row = math.floor(Fraction(y, height) * down)
            column = math.floor(Fraction(x, width) * across)
            counts[p, math.floor(share * bins), row, column] += 1
    return counts


def binary_event_image(events, size=None):
    width, height = size or events.size
    image = np.zeros((2, height, width), dtype=np.float32)
    for x, y, _, p in rows(events):
        row = math.floor(Fraction(height, events.size.height) * y)
        column = math.floor(Fraction(width, events.size.width) * x)
        image[1 - p, row, column] = 1
    return image


def timestamp_image(events):
    image = np.zeros((2, *events.size.shape))
    for x, y, t, p in rows(events):
        first, last = int(events.t[0]), int(events.t[-1])
        image[1 - p, y, x] = Fraction(t - first, max(last - first, 1))
    return image.astype(np.float32)


SMALL_BINS = st.integers(1, 4)
SINCE_START = st.integers(-10, 60_000)
"""An instant, µs since the first event."""
DEFINITIONS = {
    "event-frame": (
        event_frame,
        {"kind": st.sampled_from(["signed", "binary", "count", "polarity"])},
    ),
    "voxel-zhu": (voxel_zhu, {"bins": SMALL_BINS, "split_polarity": st.booleans()}),
    "voxel-e2vid": (voxel_e2vid, {"bins": SMALL_BINS, "normalise": st.booleans()}),
    "voxel-dsec": (
        voxel_dsec,
        {
            "bins": SMALL_BINS,
            "normalise": st.booleans(),
            "rectify_map": st.lists(st.floats(-2, 6, width=16), min_size=24, max_size=24).map(
                lambda values: np.reshape(values, (3, 4, 2))
            ),
        },
    ),
    "time-surface": (
        time_surface,
        {
            "tau_us": st.sampled_from([1, 20_000]),
            "decay": st.sampled_from(["exponential", "linear"]),
            "at_us": st.one_of(SINCE_START, st.sampled_from([-(10**14), 10**14])),
        },
    ),
    "stacked-histogram": (
        stacked_histogram,
        {"bins": st.integers(1, 12), "cutoff": st.integers(1, 3)},
    ),
    "binary-event-image": (
        binary_event_image,
        {"size": st.tuples(st.integers(1, 6), st.integers(1, 6))},
    ),
    "histogram-2d": (histogram_2d, {"shape": st.tuples(st.integers(1, 3), st.integers(1, 4))}),
    "histogram-3d": (
        histogram_3d,
        {
            "bins": SMALL_BINS,
            "start_us": st.integers(-10, 5),
            "stop_us": st.integers(6, 60_000),
            "shape": st.tuples(st.integers(1, 3), st.integers(1, 4)),
        },
    ),
    "timestamp-image": (timestamp_image, {}),
}
"""Name → definition, and values of each of its options; instants count from the first event."""


@st.composite
def streams(draw, least=0):
    """Short streams in which pixels and times often coincide, far from time 0 or at it."""
    count = draw(st.integers(least, 8))
    start = draw(st.sampled_from([0, 10**15, -(10**9)]))
    reach = draw(st.sampled_from([0, 3, 50_000]))
    times = st.lists(st.integers(0, reach), min_size=count, max_size=count)
    columns = [
        draw(st.lists(st.integers(0, side - 1), min_size=count, max_size=count))
        for side in (SMALL.width, SMALL.height, 2)
    ]
    t = [start + time for time in sorted(draw(times))]
    return EventStream.from_columns(columns[0], columns[1], t, columns[2], size=SMALL)


def random_events(seed, count, size, duration_us=50_000):
    rng = np.random.default_rng(seed)
    return EventStream(
        rng.integers(0, size.width, count),
        rng.integers(0, size.height, count),
        np.sort(rng.integers(0, duration_us, count)),
        rng.integers(0, 2, count),
        size,
    )


def from_first(options, events):
    """Drawn options, whose windows count from the first event."""
    first = int(events.t[0]) if len(events) else 0
    return {key: one + first if key in WINDOW_OPTIONS else one for key, one in options.items()}
