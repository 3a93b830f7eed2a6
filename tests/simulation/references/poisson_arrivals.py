"""The definition of Poisson arrivals by gaps, in NumPy float64: all rows at once."""

import numpy as np
from numpy.typing import NDArray

from texvent.simulation.kernels.elementary import natural_log
from texvent.simulation.random.draws import Purpose, draw_uniforms
from texvent.simulation.random.poisson_noise import FIRST_DRAW, MOST_FRACTION, Arrivals


def draw_arrivals(
    cumulative_hz: NDArray[np.float64], duration_s: float, key: np.uint64, stream: int
) -> Arrivals:
    """As `random.poisson_noise.draw_arrivals`."""
    height, width = cumulative_hz.shape
    ends = cumulative_hz[:, -1]
    per_s = 1.0 / duration_s
    mean = float(ends.max()) * duration_s
    count = int(mean + 6.0 * np.sqrt(mean)) + 8
    rows = np.arange(height)[:, None]
    while True:
        chance = draw_uniforms(key, rows, stream, FIRST_DRAW + np.arange(count))
        place = np.cumsum(-natural_log(1.0 - chance) * per_s, axis=1)
        if (place[:, -1] >= ends).all():
            break
        count *= 2
    row, order = np.nonzero(place < ends[:, None])
    place = place[row, order]
    column = np.empty(len(row), np.int64)
    for y in range(height):
        own = slice(*np.searchsorted(row, [y, y + 1]))
        column[own] = np.searchsorted(cumulative_hz[y], place[own], side="right")
    start = np.where(column > 0, cumulative_hz[row, column - 1], 0.0)
    fraction = (place - start) / (cumulative_hz[row, column] - start)
    kept = draw_uniforms(key, row, stream, Purpose.NOISE_COUNT.draw(order))
    polarity = draw_uniforms(key, row, stream, Purpose.NOISE_POLARITY.draw(order))
    return Arrivals(row * width + column, np.minimum(fraction, MOST_FRACTION), kept, polarity)
