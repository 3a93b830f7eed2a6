import numpy as np

from texvent.calibrate.events_only.stationary_blocks import find_stationary, mains_flicker
from texvent.events import EventStream
from texvent.sensor import SensorSize

SIZE = SensorSize(48, 32)


def scattered(count, seed=0, span_us=8_000_000):
    random = np.random.default_rng(seed)
    t = np.sort(random.integers(0, span_us, count))
    return EventStream(random.integers(0, 48, count), random.integers(0, 32, count), t, t % 2, SIZE)


def test_random_events_are_at_rest_and_a_burst_in_a_block_is_not():
    noise = scattered(5_000)
    assert find_stationary(noise).all()
    burst = EventStream([20] * 300, [5] * 300, range(4_000_000, 4_000_300), [1] * 300, SIZE)
    both = np.argsort(np.concatenate([noise.t, burst.t]), kind="stable")
    columns = (np.concatenate([getattr(noise, n), getattr(burst, n)])[both] for n in "xytp")
    rests = find_stationary(EventStream(*columns, SIZE))
    # Blocks of 16: the burst lies in columns 16..31 of the upper row.
    assert not rests[:16, 16:32].any()
    assert rests.sum() == 48 * 32 - 16 * 16


def test_no_events_are_at_rest():
    assert find_stationary(EventStream.empty(SIZE)).all()


def test_a_lamp_on_the_mains_is_told_from_noise():
    noise = scattered(20_000)
    assert mains_flicker(noise) is None
    assert all(mains_flicker(scattered(40, seed)) is None for seed in range(9))
    assert mains_flicker(EventStream.empty(SIZE)) is None
    lit = noise[(noise.t % 10_000 < 4_000) | (noise.t % 5 == 0)]
    assert mains_flicker(lit) == 100.0
