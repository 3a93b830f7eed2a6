"""The rules of the event filters as plain loops over rows (x, y, t, p): which events are kept."""

from collections import Counter
from itertools import product

from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from .recordings import SIZE, Rows


def background_activity(
    rows: Rows, window_us: int = 10_000, support: int = 1, radius: int = 1, polarity: bool = False
) -> list[bool]:
    kept = []
    for number, (x, y, t, p) in enumerate(rows):
        near = {
            (a, b)
            for a, b, before, q in rows[:number]
            if t - before <= window_us and (q == p or not polarity)
            if 0 < max(abs(a - x), abs(b - y)) <= radius
        }
        kept.append(len(near) >= support)
    return kept


def refractory(rows: Rows, period_us: int = 1000) -> list[bool]:
    last: dict[tuple[int, int], int] = {}
    kept = []
    for x, y, t, _ in rows:
        kept.append((x, y) not in last or t - last[x, y] >= period_us)
        if kept[-1]:
            last[x, y] = t
    return kept


def rate_limit(rows: Rows, rate_hz: float = 1e7, window_us: int = 1000) -> list[bool]:
    counts: Counter[int] = Counter()
    kept = []
    for *_, t, _ in rows:
        counts[t // window_us] += 1
        kept.append(counts[t // window_us] <= rate_hz * window_us / 1e6 + 1e-9)
    return kept


def hot_pixels(rows: Rows, factor: float = 5.0, least_events: int = 40) -> list[bool]:
    counts = Counter((x, y) for x, y, *_ in rows)

    def events_of(x: int, y: int, left_out: set[tuple[int, int]]) -> int:
        """Beyond the edge the sensor is mirrored, the second time without the hot pixels."""
        place = (
            SIZE.width - 1 - abs(SIZE.width - 1 - abs(x)),
            SIZE.height - 1 - abs(SIZE.height - 1 - abs(y)),
        )
        return 0 if place != (x, y) and place in left_out else counts[place]

    hot: set[tuple[int, int]] = set()
    for _ in range(2):
        around = {
            (x, y): sorted(
                events_of(x + dx, y + dy, hot)
                for dx, dy in product((-1, 0, 1), repeat=2)
                if (dx, dy) != (0, 0)
            )
            for x, y in counts
        }
        hot = {
            pixel
            for pixel, count in counts.items()
            if count >= least_events and count > factor * max(around[pixel][-2], 1)
        }
    return [(x, y) not in hot for x, y, *_ in rows]


def mask(rows: Rows, pixels: object) -> list[bool]:
    return [not pixels[y, x] for x, y, *_ in rows]  # type: ignore[index]


RULES = {
    "background-activity": (
        background_activity,
        {
            "window_us": st.integers(0, 20),
            "support": st.integers(1, 3),
            "radius": st.integers(1, 3),
            "polarity": st.booleans(),
        },
    ),
    "refractory": (refractory, {"period_us": st.integers(0, 20)}),
    "rate-limit": (
        rate_limit,
        {"rate_hz": st.sampled_from([2.5e5, 4e5, 1e6]), "window_us": st.integers(4, 21)},
    ),
    "hot-pixels": (hot_pixels, {"factor": st.floats(1, 3), "least_events": st.integers(1, 4)}),
    "mask": (mask, {"pixels": arrays.arrays(bool, SIZE.shape)}),
}
"""Filter → its rule, and values of each of its options."""
