"""The readout on made-up events, and on the whole model."""

import itertools
import math

import numpy as np
import pytest

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.simulate.packets import FrameInterval, UnsortedEvents
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.physical.readout import Readout, ReadoutRules
from texvent.simulate.random.draws import frame_key
from texvent.video import Frame

from .physical_pixels import clean

WIDTH = 20
SIZE = SensorSize(WIDTH, WIDTH)


def events_at(times, pixel=None) -> UnsortedEvents:
    t = np.sort(np.asarray(times, np.int64))
    pixel = np.arange(len(t)) % (WIDTH * WIDTH) if pixel is None else np.asarray(pixel, np.int64)
    return UnsortedEvents.signal(pixel, t, (np.arange(len(t)) % 2).astype(np.uint8))


def read_all(rules: ReadoutRules, times, *, step_us: int, first_us: int = 0, stop_us: int) -> list:
    """Packets of a readout that gets its events interval by interval."""
    readout = Readout(rules, first_us=first_us, size=SIZE)
    times = np.asarray(times)
    packets = []
    for start, stop in itertools.pairwise(range(first_us, stop_us + 1, step_us)):
        interval = FrameInterval(start, stop, frame_key(0, stop - first_us))
        inside = times[(times >= start) & (times < stop)]
        packet = readout.read(events_at(inside), interval)
        assert ((packet.t >= start) & (packet.t < stop)).all()
        packets.append(packet)
    return packets


def times_of(packets) -> list[int]:
    return np.concatenate([packet.t for packet in packets]).tolist()


def test_an_ideal_readout_changes_nothing():
    fired = events_at([3, 5, 900])
    assert (
        Readout(ReadoutRules(), first_us=0, size=SIZE).read(fired, FrameInterval(0, 1000, 0))
        is fired
    )


def test_latency_moves_events_later_across_frames():
    packets = read_all(ReadoutRules(latency_us=150), [10, 90, 210], step_us=100, stop_us=400)
    assert [packet.t.tolist() for packet in packets] == [[], [160], [240], [360]]


def test_events_that_would_leave_after_the_last_frame_stay_inside():
    assert times_of(read_all(ReadoutRules(latency_us=150), [300], step_us=100, stop_us=400)) == []


def test_the_clock_rounds_up_to_its_ticks_from_the_first_frame_on():
    rules = ReadoutRules(clock_us=25)
    packets = read_all(rules, [1010, 1026, 1050, 1051], first_us=1001, step_us=100, stop_us=1201)
    assert times_of(packets) == [1026, 1026, 1051, 1051]


def test_jitter_is_uniform_up_to_its_limit():
    times = np.arange(0, 100_000, 10)
    packets = read_all(ReadoutRules(jitter_us=30), times, step_us=5000, stop_us=105_000)
    # Pixels tell the events of an interval apart: 500 per interval on 400 pixels.
    delay = np.sort(times_of(packets)) - times
    assert delay.min() >= 0
    assert delay.max() <= 30
    assert delay.mean() == pytest.approx(15, abs=5 * 9 / math.sqrt(len(times)))


@pytest.mark.parametrize("step_us", [500, 1000, 4000, 100_000])
def test_a_steady_rate_above_the_limit_is_cut_to_it(step_us):
    # 50,000 events in 0.1 s are 500,000 per second.
    times = np.arange(0, 100_000, 2)
    rules = ReadoutRules(rate_limit_hz=200_000.0)
    kept = len(times_of(read_all(rules, times, step_us=step_us, stop_us=100_000)))
    # The first window of 1 ms passes whole: nothing was counted before it.
    mean = 500 + 99 * 200
    assert kept == pytest.approx(mean, abs=5 * math.sqrt(50_000 * 0.4 * 0.6))


def test_a_rate_below_the_limit_passes_whole():
    times = np.arange(0, 100_000, 10)
    rules = ReadoutRules(rate_limit_hz=150_000.0)
    assert len(times_of(read_all(rules, times, step_us=3000, stop_us=100_000))) == len(
        times[times < 99_000]
    )


def test_a_silent_window_lifts_the_limit():
    burst = np.arange(0, 1000, 2)
    rules = ReadoutRules(rate_limit_hz=100_000.0)
    apart = read_all(rules, np.concatenate([burst, burst + 5000]), step_us=700, stop_us=7000)
    joined = read_all(rules, np.concatenate([burst, burst + 1000]), step_us=700, stop_us=7000)
    assert len(times_of(apart)) == 1000
    assert len(times_of(joined)) == pytest.approx(600, abs=5 * math.sqrt(500 * 0.2 * 0.8))


def test_the_window_of_the_limit_does_not_care_where_frames_are():
    times = np.arange(0, 20_000, 3)
    rules = ReadoutRules(rate_limit_hz=100_000.0)
    rates = [
        len(times_of(read_all(rules, times, step_us=step, stop_us=20_000)))
        for step in (250, 1000, 20_000)
    ]
    assert max(rates) - min(rates) <= 10 * math.sqrt(20_000 / 3 * 0.3 * 0.7)


@pytest.mark.parametrize("step_us", [70, 1000, 4000])
def test_a_filter_of_the_readout_is_the_filter_of_recordings(step_us):
    rng = np.random.default_rng(5)
    pixel, t = rng.choice([0, 1, WIDTH, 3 * WIDTH + 7], 600), np.sort(rng.integers(0, 4000, 600))
    fired = UnsortedEvents.signal(pixel, t, rng.integers(0, 2, 600).astype(np.uint8))
    texts = ("event-trail:mode=stc-keep-trail,threshold_us=40", "refractory:period_us=9")

    def read(filters) -> UnsortedEvents:
        readout = Readout(ReadoutRules(latency_us=1, filters=filters), first_us=0, size=SIZE)
        return UnsortedEvents.concat([
            readout.read(
                fired.take((t >= start) & (t < start + step_us)),
                FrameInterval(start, start + step_us, frame_key(0, start)),
            )
            for start in range(0, 4200, step_us)
        ])  # fmt: skip

    plain, filtered = read(()), read(texts)
    y, x = np.divmod(plain.pixel, WIDTH)
    recording = EventStream.from_columns(x, y, plain.t, plain.p, size=SIZE)
    expected = recording.filter(texts[0]).filter(texts[1])
    assert 0 < len(expected) < len(recording) == 600
    assert filtered.t.tolist() == expected.t.tolist()
    assert filtered.pixel.tolist() == (expected.y.astype(int) * WIDTH + expected.x).tolist()


@pytest.mark.parametrize("first_us", [0, 130, -77])
def test_windows_of_a_filter_begin_at_the_first_frame(first_us):
    # 5 events in each window of 100 µs, of which 2 pass.
    times = np.arange(0, 400, 20) + first_us
    rules = ReadoutRules(filters=("rate-limit:rate_hz=20000,window_us=100",))
    packets = read_all(rules, times, step_us=70, first_us=first_us, stop_us=first_us + 420)
    expected = [0, 20, 100, 120, 200, 220, 300, 320]
    assert times_of(packets) == [t + first_us for t in expected]


def test_a_lamp_flickers_until_the_readout_filters_it():
    def events_of(**options):
        simulator = clean("cpu", contrast_threshold=0.3, **options)
        frames = (
            Frame(np.full((4, 4), 120.0 + 80.0 * math.sin(2 * math.pi * 0.1 * ms)), t_us=1000 * ms)
            for ms in range(200)
        )
        return np.concatenate([simulator.step(frame).t for frame in frames])

    plain = events_of()
    filtered = events_of(readout_filters=("anti-flicker:low_hz=90,high_hz=110",))
    assert plain.max() > 190_000
    # 100 Hz: the first burst and six periods pass.
    assert filtered.tolist() == plain[plain < filtered.max() + 1].tolist()
    assert 60_000 < filtered.max() < 80_000


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("hot-pixels", "'hot-pixels' is no filter of a readout; allowed: event-trail"),
        ("event-trail:threshold_us=0", "threshold_us is 0; it must be 1.."),
        ("anti-flicker:low_hz=40", "low_hz is 40; it must be 50..520"),
        ("event-trail:period=3", "event-trail has no option 'period'"),
    ],
)
def test_a_wrong_filter_of_the_readout_is_refused(text, message):
    with pytest.raises(ConfigError, match=message):
        PhysicalConfig(readout_filters=(text,))
