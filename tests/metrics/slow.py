"""The definitions of the metrics, written as slowly and plainly as possible."""

import itertools
import math
from collections import Counter, defaultdict

import numpy as np


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
                    cell = (
                        p,
                        inside * tau // window_us,
                        y * sigma // height,
                        x * sigma // width,
                    )
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


def nearest_ms(a, b, cap_us=10_000):
    def one_way(events, others):
        partners = trains(others)
        times = [
            min([cap_us, *(abs(t - other) for other in partners.get((x, y, p), []))])
            for t, x, y, p in rows(events)
        ]
        return sum(times) / len(times)

    return (one_way(a, b) + one_way(b, a)) / 2 / 1000


def isi(a, b):
    def logs(events):
        return sorted(
            math.log10(max(later - earlier, 1))
            for times in trains(events).values()
            for earlier, later in itertools.pairwise(times)
        )

    one, two = logs(a), logs(b)
    # Every value repeated so that both samples are equally long: then W1 pairs them in order.
    one, two = [v for v in one for _ in two], [v for v in two for _ in one]
    return sum(abs(u - v) for u, v in zip(one, two, strict=True)) / len(one)


def van_rossum(a, b, tau_us=5_000):
    """By sampling the traces finely."""
    step = tau_us / 400
    one, two = trains(a), trains(b)
    grid = np.arange(0, 120_000 + 12 * tau_us, step)

    def trace(times):
        total = np.zeros_like(grid)
        for t in times:
            after = grid >= t
            total[after] += np.exp(-(grid[after] - t) / tau_us)
        return total

    above = below = 0.0
    for key in set(one) | set(two):
        s_a, s_b = trace(one.get(key, [])), trace(two.get(key, []))
        above += ((s_a - s_b) ** 2).sum()
        below += (s_a**2).sum() + (s_b**2).sum()
    return above / below


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


def ef_mse(a, b, fps=24):
    return float(np.mean([((one - two) ** 2).mean() for one, two in frame_pairs(a, b, fps)]))


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


def voxel(a, b, fps=24, bins=5):
    def grid(events):
        sums = Counter()
        for t, x, y, p in rows(events):
            sums[t * fps * bins // 1_000_000, x, y] += 1 if p else -1
        return sums

    one, two = grid(a), grid(b)
    cells = set(one) | set(two)
    total = sum(abs(one[cell]) + abs(two[cell]) for cell in cells)
    return sum(abs(one[cell] - two[cell]) for cell in cells) / total


def kernel(a, b, bin_us=2_000, sd_us=4_000, sd_px=1.5):
    """Every pair of events of the same polarity, weighted by a Gaussian of their distance."""

    def product(first, second):
        total = 0.0
        for t, x, y, p in rows(first):
            same = second.p == p
            bins = (second.t[same] // bin_us - t // bin_us) * bin_us / sd_us
            across = second.x[same].astype(float) - x
            down = second.y[same].astype(float) - y
            total += np.exp(-(bins**2) / 2 - (across**2 + down**2) / (2 * sd_px**2)).sum()
        return total

    same = product(a, a) + product(b, b)
    return (same - 2 * product(a, b)) / same


def cheapest_edit(a, b, cost_per_us):
    """The recursion of Victor and Purpura, without a table."""
    if not a or not b:
        return len(a) + len(b)
    shifted = cheapest_edit(a[:-1], b[:-1], cost_per_us) + cost_per_us * abs(a[-1] - b[-1])
    removed = cheapest_edit(a[:-1], b, cost_per_us) + 1
    added = cheapest_edit(a, b[:-1], cost_per_us) + 1
    return min(shifted, removed, added)


def time_surface(a, b, instants=20, tau_us=20_000):
    times = [t for events in (a, b) for t, *_ in rows(events)]
    start, stop = min(times), max(times)

    def surface(events, instant):
        last = {(x, y, p): t for t, x, y, p in rows(events) if t <= instant}
        return {key: math.exp((t - instant) / tau_us) for key, t in last.items()}

    total = 0.0
    for number in range(1, instants + 1):
        instant = start + (stop - start) * number // instants
        one, two = surface(a, instant), surface(b, instant)
        total += sum(abs(one.get(key, 0) - two.get(key, 0)) for key in set(one) | set(two))
    return total / instants / (2 * a.size.width * a.size.height)


def patch_features(events):
    """The 14 features of each patch with 8 events or more, in order of (window, row, column)."""
    patches = defaultdict(list)
    for t, x, y, p in rows(events):
        if x < events.size.width // 12 * 12 and y < events.size.height // 12 * 12:
            patches[t // 50_000, y // 12, x // 12].append((t, x, y, p))
    return np.array([_features(patches[key]) for key in sorted(patches) if len(patches[key]) >= 8])


def _features(inside):
    t, x, y, p = (np.array(column, float) for column in zip(*inside, strict=True))
    counts = np.array(list(Counter(zip(x, y, strict=True)).values()), float)
    last, intervals, flips = {}, [], []
    for row in inside:
        if row[1:3] in last:
            earlier = last[row[1:3]]
            intervals.append((row[0] - earlier[0]) / 1e6)
            flips.append(row[3] != earlier[3])
        last[row[1:3]] = row
    seconds = np.array(intervals)
    histogram = np.histogram(t % 50_000, bins=10, range=(0, 50_000))[0]
    share = histogram[histogram > 0] / histogram.sum()
    centred = histogram - histogram.mean()
    power = (centred**2).sum()
    gaps = np.diff(t)
    return [
        math.log(len(inside)),
        p.mean(),
        len(counts) / 144,
        counts.std() / counts.mean(),
        math.log10(seconds.mean() + 1e-5) if len(seconds) else -1.3,
        np.log10(seconds + 1e-5).std() if len(seconds) else 0.0,
        (seconds < 2e-3).mean() if len(seconds) else 0.0,
        np.mean(flips) if flips else 0.0,
        -(share * np.log(share)).sum(),
        (centred[1:] * centred[:-1]).sum() / power if power else 0.0,
        np.hypot(np.diff(x), np.diff(y)).mean(),
        np.log10(gaps / 1e6 + 1e-6).mean(),
        np.log10(gaps / 1e6 + 1e-6).std(),
        (gaps <= 1).mean(),
    ]
