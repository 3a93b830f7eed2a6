"""Every representation written as its source states it, one event at a time, in exact fractions."""

import math
from fractions import Fraction

import numpy as np
from hypothesis import strategies as st

from texvent.events import EventStream
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


def time_surface(events, tau_us, decay, at_us):
    width, height = events.size
    surface = np.zeros((2, height, width))
    for x, y, t, p in rows(events):
        if t > at_us:
            continue
        age = (at_us - t) / tau_us
        surface[p, y, x] = math.exp(-age) if decay == "exponential" else max(0, 1 - age)
    return surface.astype(np.float32)


def stacked_histogram(events, bins, cutoff):
    width, height = events.size
    counts = np.zeros((2 * bins, height, width), dtype=int)
    listed = rows(events)
    for x, y, t, p in listed:
        span = max(listed[-1][2] - listed[0][2], 1)
        time_bin = min(math.floor(Fraction(t - listed[0][2], span) * bins), bins - 1)
        channel = p * bins + time_bin
        counts[channel, y, x] = min(counts[channel, y, x] + 1, cutoff)
    return counts


def histogram(events, bins, start_us, stop_us, shape):
    width, height = events.size
    counts = np.zeros((2, bins, *shape), dtype=int)
    for x, y, t, p in rows(events):
        share = Fraction(t - start_us, stop_us - start_us)
        if 0 <= share < 1:
            row = math.floor(Fraction(y, height) * shape[0])
            column = math.floor(Fraction(x, width) * shape[1])
            counts[p, math.floor(share * bins), row, column] += 1
    return counts


def binary_event_image(events, size):
    width, height = size
    image = np.zeros((2, height, width), dtype=int)
    for x, y, _, p in rows(events):
        row = math.floor(Fraction(height, events.size.height) * y)
        column = math.floor(Fraction(width, events.size.width) * x)
        image[0 if p else 1, row, column] = 1
    return image


def per_pixel(events):
    """Times of the events of each pixel: (ON, OFF) → (x, y) → list, since the first event."""
    times = ({}, {})
    for x, y, t, p in rows(events):
        times[1 - p].setdefault((x, y), []).append(t - int(events.t[0]))
    return times


def timestamp_image(events):
    image = np.zeros((2, events.size.height, events.size.width))
    for lane, pixels in enumerate(per_pixel(events)):
        for (x, y), times in pixels.items():
            image[lane, y, x] = Fraction(times[-1], max(int(events.t[-1] - events.t[0]), 1))
    return image.astype(np.float32)


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
