"""The event rate controller on made-up events."""

import itertools
import math

import numpy as np
import pytest

from texvent.sensor import SensorSize
from texvent.simulate.packets import FrameInterval, UnsortedEvents
from texvent.simulate.physical.readout import RateLimit
from texvent.simulate.random.draws import frame_key

WIDTH = 20
SIZE = SensorSize(WIDTH, WIDTH)


def events_at(times, pixel=None) -> UnsortedEvents:
    t = np.sort(np.asarray(times, np.int64))
    pixel = np.arange(len(t)) % (WIDTH * WIDTH) if pixel is None else np.asarray(pixel, np.int64)
    return UnsortedEvents.signal(pixel, t, (np.arange(len(t)) % 2).astype(np.uint8))


def read_all(rate_hz: float, times, *, step_us: int, first_us: int = 0, stop_us: int) -> list:
    """Packets of a rate limit that gets its events interval by interval."""
    limit = RateLimit(rate_hz, 1000, first_us=first_us, width=WIDTH)
    times = np.asarray(times)
    packets = []
    for start, stop in itertools.pairwise(range(first_us, stop_us + 1, step_us)):
        interval = FrameInterval(start, stop, frame_key(0, stop - first_us))
        inside = times[(times >= start) & (times < stop)]
        packet = limit.read(events_at(inside), interval)
        assert ((packet.t >= start) & (packet.t < stop)).all()
        packets.append(packet)
    return packets


def times_of(packets) -> list[int]:
    return np.concatenate([packet.t for packet in packets]).tolist()


@pytest.mark.parametrize("step_us", [500, 1000, 4000, 100_000])
def test_a_steady_rate_above_the_limit_is_cut_to_it(step_us):
    # 50,000 events in 0.1 s are 500,000 per second.
    times = np.arange(0, 100_000, 2)
    rules = 200_000.0
    kept = len(times_of(read_all(rules, times, step_us=step_us, stop_us=100_000)))
    # The first window of 1 ms passes whole: nothing was counted before it.
    mean = 500 + 99 * 200
    assert kept == pytest.approx(mean, abs=5 * math.sqrt(50_000 * 0.4 * 0.6))


def test_a_rate_below_the_limit_passes_whole():
    times = np.arange(0, 100_000, 10)
    rules = 150_000.0
    assert len(times_of(read_all(rules, times, step_us=3000, stop_us=100_000))) == len(
        times[times < 99_000]
    )


def test_a_silent_window_lifts_the_limit():
    burst = np.arange(0, 1000, 2)
    rules = 100_000.0
    apart = read_all(rules, np.concatenate([burst, burst + 5000]), step_us=700, stop_us=7000)
    joined = read_all(rules, np.concatenate([burst, burst + 1000]), step_us=700, stop_us=7000)
    assert len(times_of(apart)) == 1000
    assert len(times_of(joined)) == pytest.approx(600, abs=5 * math.sqrt(500 * 0.2 * 0.8))


def test_the_window_of_the_limit_does_not_care_where_frames_are():
    times = np.arange(0, 20_000, 3)
    rules = 100_000.0
    rates = [
        len(times_of(read_all(rules, times, step_us=step, stop_us=20_000)))
        for step in (250, 1000, 20_000)
    ]
    assert max(rates) - min(rates) <= 10 * math.sqrt(20_000 / 3 * 0.3 * 0.7)
