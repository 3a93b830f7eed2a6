"""The definitions of the metrics, written as slowly and plainly as possible."""

import math
from collections import Counter, defaultdict

import numpy as np
from tests.represent import definitions


def rows(events):
    return [
        tuple(map(int, row)) for row in zip(events.t, events.x, events.y, events.p, strict=True)
    ]


def trains(events):
    found = defaultdict(list)
    for t, x, y, p in rows(events):
        found[x, y, p].append(t)
    return found


def stpp_levels(a, b, window_us=50_000):
    width, height = a.size
    result = np.zeros((5, 6))
    for row, tau in enumerate((1, 2, 4, 8, 16)):
        for column, sigma in enumerate((1, 2, 4, 8, 16, 32)):
            windows = [defaultdict(Counter), defaultdict(Counter)]
            for events, found in zip((a, b), windows, strict=True):
                for t, x, y, p in rows(events):
                    inside = t % window_us
                    cell = (p, inside * tau // window_us, y * sigma // height, x * sigma // width)
                    found[t // window_us][cell] += 1
            score = weight = 0
            for number in set(windows[0]) | set(windows[1]):
                one, two = windows[0][number], windows[1][number]
                cells = set(one) | set(two)
                least = sum(min(one[cell], two[cell]) for cell in cells)
                most = sum(max(one[cell], two[cell]) for cell in cells)
                size = one.total() + two.total()
                score += size * least / most
                weight += size
            result[row, column] = score / weight if weight else 1
    return result


def stpp(a, b):
    return stpp_levels(a, b).mean()


def nearest_ms(a, b, cap_us=10_000):
    if not len(a) and not len(b):
        return math.nan

    def one_way(events, others):
        partners = trains(others)
        times = [
            min([cap_us, *(abs(t - other) for other in partners.get((x, y, p), []))])
            for t, x, y, p in rows(events)
        ]
        return sum(times) / len(times) if times else cap_us

    return (one_way(a, b) + one_way(b, a)) / 2 / 1000


def van_rossum(a, b, tau_us=5_000):
    """The integral of the product of two decays is τ / 2 · exp(−|Δt| / τ)."""
    one, two = trains(a), trains(b)

    def product(these, those):
        pairs = ((t, u) for key in these for t in these[key] for u in those.get(key, []))
        return sum(math.exp(-abs(t - u) / tau_us) for t, u in pairs)

    below = product(one, one) + product(two, two)
    return (below - 2 * product(one, two)) / below if below else math.nan


def frame(events):
    signed = np.zeros(events.size.shape)
    for _, x, y, p in rows(events):
        signed[y, x] += 1 if p else -1
    return (np.sign(signed) + 1) / 2


def frame_pairs(a, b, fps):
    """All frames from the first event of both to the last."""
    numbers = [t * fps // 1_000_000 for events in (a, b) for t, *_ in rows(events)]
    for number in range(min(numbers), max(numbers) + 1):
        yield tuple(
            frame(events[np.asarray(events.t * fps // 1_000_000 == number)]) for events in (a, b)
        )


def mean_of_frames(a, b, similarity, fps=24):
    if not len(a) and not len(b):
        return math.nan
    return float(np.mean([similarity(*pair) for pair in frame_pairs(a, b, fps)]))


def ef_mse(a, b):
    return mean_of_frames(a, b, lambda one, two: ((one - two) ** 2).mean())


def ef_psnr(a, b):
    error = ef_mse(a, b)
    return -10 * math.log10(error) if error else math.inf


def ssim(one, two):
    """SSIM, one window at a time."""
    offset = np.arange(-5, 6)
    weight = np.exp(-(offset[:, None] ** 2 + offset[None] ** 2) / (2 * 1.5**2))
    weight /= weight.sum()
    values = []
    for y in range(5, one.shape[0] - 5):
        for x in range(5, one.shape[1] - 5):
            u, v = one[y - 5 : y + 6, x - 5 : x + 6], two[y - 5 : y + 6, x - 5 : x + 6]
            mu, mv = (weight * u).sum(), (weight * v).sum()
            vu, vv = (weight * (u - mu) ** 2).sum(), (weight * (v - mv) ** 2).sum()
            cov = (weight * (u - mu) * (v - mv)).sum()
            c1, c2 = 0.01**2, 0.03**2
            value = (2 * mu * mv + c1) * (2 * cov + c2)
            values.append(value / ((mu**2 + mv**2 + c1) * (vu + vv + c2)))
    return float(np.mean(values))


def lfs(a, b, window_us=50_000):
    """Of the stacked histogram itself, averaged over 3×3 patches."""
    scores = []
    for number in sorted({t // window_us for events in (a, b) for t in events.t.tolist()}):
        patches = []
        for events in (a, b):
            inside = events[events.t // window_us == number]
            counts = definitions.stacked_histogram(inside).astype(float)
            _, height, width = counts.shape
            counts = np.pad(counts, ((0, 0), (0, -height % 3), (0, -width % 3)))
            rows_of = range(0, counts.shape[1], 3)
            columns = range(0, counts.shape[2], 3)
            patches.append(
                [counts[:, y : y + 3, x : x + 3].sum((1, 2)) for y in rows_of for x in columns]
            )
        cosines = []
        for one, two in zip(*patches, strict=True):
            lengths = np.linalg.norm(one), np.linalg.norm(two)
            if any(lengths):
                cosines.append(one @ two / np.prod(lengths) if all(lengths) else 0.0)
        scores.append(np.mean(cosines))
    return float(np.mean(scores)) if scores else math.nan


def count_ratio(a, b):
    return len(a) / len(b) if len(b) else math.nan


def on_difference(a, b):
    return abs(np.mean(a.p) - np.mean(b.p)) if len(a) and len(b) else math.nan


def active_iou(a, b):
    one, two = ({(x, y) for _, x, y, _ in rows(events)} for events in (a, b))
    return len(one & two) / len(one | two) if one | two else math.nan


DEFINITIONS = {
    "stpp": stpp,
    "van_rossum": van_rossum,
    "nearest": nearest_ms,
    "ef_mse": ef_mse,
    "ef_psnr": ef_psnr,
    "ef_ssim": lambda a, b: mean_of_frames(a, b, ssim),
    "lfs": lfs,
    "count_ratio": count_ratio,
    "on_difference": on_difference,
    "active_iou": active_iou,
}
"""Metric → its value of two streams."""
