import cv2
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.sensor import SensorSize
from texvent.view.sample import (
    FIRST_BIN_US,
    RATE_BINS,
    STRIP_WIDTH,
    FrameStrip,
    RateCurve,
    UniformSample,
    rate_counts,
)

SIZE = SensorSize(100, 100)


def ramp(count: int, step_us: int = 1) -> EventStream:
    """Events whose position in the stream can be read off x and y."""
    index = np.arange(count)
    return EventStream(index % 100, index // 100 % 100, index * step_us, index % 2, SIZE)


@given(st.lists(st.integers(-5, 60), max_size=30), st.integers(0, 20), st.integers(1, 40),
       st.integers(1, 9))  # fmt: skip
@example([3, 6, 9], 0, 10, 3)
def test_an_event_is_in_the_bin_whose_share_of_the_time_it_is_in(times, start, span, bins):
    t = sorted(times)
    p = [n % 2 for n in range(len(t))]
    counts = np.zeros((2, bins), int)
    for time, on in zip(t, p, strict=True):
        if start <= time < start + span:
            counts[on, (time - start) * bins // span] += 1
    events = EventStream.from_columns([0] * len(t), [0] * len(t), t, p, size=SIZE)
    np.testing.assert_array_equal(rate_counts(events, (start, start + span), bins), counts)


@pytest.mark.parametrize("packet_events", [1, 7, 333, 5000])
def test_packet_sizes_do_not_change_the_sample(packet_events):
    events = ramp(5000)
    whole, cut = UniformSample(SIZE, limit=400), UniformSample(SIZE, limit=400)
    whole.append(events)
    for start in range(0, 5000, packet_events):
        cut.append(events[start : start + packet_events])
    assert len(cut.events()) == 400
    assert cut.events().equals(whole.events())


def test_the_sample_is_uniform_over_the_recording():
    sample = UniformSample(SIZE, limit=4000)
    for start in range(0, 200_000, 10_000):
        sample.append(ramp(200_000)[start : start + 10_000])
    per_tenth = np.bincount(sample.events().t // 20_000, minlength=10)
    # Binomial with mean 400 and deviation 19: five deviations.
    assert np.abs(per_tenth - 400).max() < 95


@given(
    gaps=st.lists(st.integers(0, 200_000), min_size=1, max_size=40),
    start_us=st.integers(0, 10**15),
    cut=st.integers(0, 40),
)
def test_the_rate_curve_counts_every_event_in_its_bin(gaps, start_us, cut):
    times = start_us + np.cumsum(gaps)
    polarity = np.arange(len(times)) % 2
    events = EventStream(times * 0, times * 0, times, polarity, SIZE)
    curve = RateCurve()
    for part in (events[:cut], events[cut:]):
        curve.append(part)
    bins = (times - times[0]) // curve.bin_us
    assert curve.start_us == times[0]
    assert curve.counts.shape == (2, bins[-1] + 1)
    assert curve.counts.shape[1] <= RATE_BINS
    for p in (0, 1):
        np.testing.assert_array_equal(
            curve.counts[p], np.bincount(bins[polarity == p], minlength=bins[-1] + 1)
        )
    assert curve.bin_us == FIRST_BIN_US or curve.counts.shape[1] > RATE_BINS // 2


def frame(index: int, width: int = 8) -> Frame:
    return Frame(np.full((6, width, 3), index % 256, dtype=np.uint8), index * 1000)


@given(count=st.integers(1, 90), limit=st.integers(2, 7))
def test_kept_frames_are_evenly_spread_and_never_too_many(count, limit):
    strip = FrameStrip(limit=limit)
    for index in range(count):
        strip.append(frame(index))
    stride = next(2**power for power in range(9) if -(-count // 2**power) <= limit)
    assert [t for t, _ in strip.images] == [1000 * index for index in range(0, count, stride)]
    assert strip.seen == count


def test_intermediate_frames_are_left_out():
    strip = FrameStrip()
    strip.append(Frame(np.zeros((6, 8)), 5, is_source=False))
    assert (strip.seen, strip.images) == (0, [])


def test_large_frames_are_made_small_and_keep_their_shape():
    strip = FrameStrip()
    strip.append(Frame(np.full((600, 2 * STRIP_WIDTH, 3), 90, dtype=np.uint8), 0))
    image = cv2.imdecode(np.frombuffer(strip.images[0][1], np.uint8), cv2.IMREAD_COLOR)
    assert image.shape == (300, STRIP_WIDTH, 3)
    assert abs(image.mean() - 90) < 2
