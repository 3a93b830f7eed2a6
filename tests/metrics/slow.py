"""The definitions of the metrics, written as slowly and plainly as possible."""

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
