import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.calibrate.noise import (
    EDGES,
    LEAK_FROM,
    measure_noise,
)
from texvent.calibrate.recording import CalibrationRecording, TimeSpan
from texvent.events import EventStream
from texvent.frames import Video

from .conftest import TRUTH, record

SPAN = TimeSpan(0, 2_000_000)


STRIPES = np.repeat([1.0, 25.0, 120.0], 20)[None, :].repeat(40, axis=0)


def still_recording(image=STRIPES, **options) -> CalibrationRecording:
    """An image, by default dark, middle and bright stripes, that stays for two seconds."""
    frames = Video(np.stack([image.astype(np.float32)] * 41), [i * 50_000 for i in range(41)])
    return record(frames, dataclasses.replace(TRUTH, **options), seed=5)


def slow_still_pixels(recording, span, gamma):
    """Each still pixel between two frames: its range, the seconds, its OFF and its ON events."""
    frames = [one for one in recording.frames if span.start_us <= one.t_us < span.stop_us]
    seen = [255 * (np.asarray(one.luma, np.float64) / 255) ** gamma for one in frames]
    padded = [np.pad(one, 1, mode="edge") for one in seen]
    height, width = seen[0].shape
    places = [(y, x) for y in range(height) for x in range(width)]
    means = [
        np.array([one[y : y + 3, x : x + 3].mean() for y, x in places]).reshape(height, width)
        for one in padded
    ]
    events = recording.events
    first = 0
    while first < len(frames) - 2:
        ends = (
            i for i in range(first, len(frames)) if frames[i].t_us >= frames[first].t_us + 10**6
        )
        last = next(ends, len(frames) - 1)
        window = slice(first, last + 1)
        mean = np.mean(means[window], axis=0)
        away = np.abs(means[window] - mean).max(axis=0) - (1.5 + 0.02 * mean)
        for i in range(first + 1, last):
            begin, end = frames[i].t_us, frames[i + 1].t_us
            for y, x in places:
                around = slice(max(y - 2, 0), y + 3), slice(max(x - 2, 0), x + 3)
                now = means[i][y, x]
                near = np.abs([one[around] - now for one in means[i - 1 : i + 2]])
                is_static = last + 1 - first >= 10 and away[around].max() <= 0
                if is_static or near.max() <= 1.5 + 0.02 * now:
                    level = np.mean([one[y, x] for one in seen[window]]) if is_static else now
                    here = (events.x == x) & (events.y == y)
                    here &= (events.t >= begin) & (events.t < end)
                    number = sum(level >= edge for edge in EDGES) - 1
                    on = int(events.p[here].sum())
                    yield number, (end - begin) / 10**6, int(here.sum()) - on, on
        first = last - 1


@given(st.integers(0, 2**32), st.sampled_from([1.0, 2.2]), st.sampled_from([0.3, 0.5]))
def test_noise_of_any_recording_is_that_of_its_still_pixels_one_by_one(seed, gamma, on_fraction):
    rng = np.random.default_rng(seed)
    times = np.cumsum(rng.integers(30_000, 160_000, 24))
    image = np.kron(rng.choice([20, 60, 120, 200], (2, 3)), np.ones((5, 5)))
    shown = []
    for _ in times:
        top, left = rng.integers(0, 9), rng.integers(0, 14)
        image[top : top + 2, left : left + 2] += rng.choice([0, 0, 3, 20]) * rng.choice([1, -1])
        shown.append(np.clip(image + rng.normal(0, 0.5, image.shape), 0, 255))
    frames = Video(np.array(shown, np.float32), times.tolist())
    t = np.sort(rng.integers(0, times[-1], 400))
    x, y = rng.integers(0, 15, 400), rng.integers(0, 10, 400)
    events = EventStream(x, y, t, rng.integers(0, 2, 400), frames.size)
    recording = dataclasses.replace(still_recording(), frames=frames, events=events)
    span = TimeSpan(int(times[1]), int(times[-1]))
    parts = np.zeros((len(EDGES) - 1, 3))
    for number, *values in slow_still_pixels(recording, span, gamma):
        parts[number] += values
    seconds, off, on = parts[known := parts[:, 0] >= 20].T
    noise = measure_noise(recording, span, gamma=gamma, on_fraction=on_fraction)
    if known.sum() < 2:
        assert noise is None
        return
    mean = max(off.sum(), 0.5) / seconds.sum()
    rates = [n / s if n else 0.5 / (s + 0.5 / mean) for n, s in zip(off, seconds, strict=True)]
    assert noise.curve.rates_hz == pytest.approx(np.array(rates) / (1 - on_fraction))
    bright = np.array(EDGES)[:-1][known] >= LEAK_FROM
    surplus = (on - on_fraction / (1 - on_fraction) * off)[bright] / seconds[bright]
    assert noise.leak_rate_hz == pytest.approx(max(np.median(surplus), 0) if any(bright) else 0)


def test_the_noise_of_a_still_recording_is_found_again():
    recording = still_recording(
        noise_scale=1.0, noise_curve="1:6 25:2 120:0.5", noise_on_fraction=0.5, leak_rate_hz=0.0
    )
    noise = measure_noise(recording, SPAN, gamma=1.0)
    assert noise.curve.levels.tolist() == [1.0, 25.0, 120.0]
    # 1,000 pixel-seconds a stripe; pixels differ by 0.63 of the mean, and OFF is half of all.
    assert noise.curve.rates_hz == pytest.approx([6, 2, 0.5], rel=0.25)
    assert noise.leak_rate_hz == pytest.approx(0, abs=0.1)


def test_noise_is_counted_from_a_still_frame_to_the_next():
    still = still_recording()
    y, x = np.mgrid[:40, :60].reshape(2, -1)
    # An OFF event of every pixel between the last two frames of the span, 1.9 and 1.95 s; the first
    # frame that has two neighbours comes at 0.05 s. For each OFF event there is one of ON.
    late = EventStream(x, y, np.full(2400, 1_925_000), np.zeros(2400, int), still.events.size)
    noise = measure_noise(dataclasses.replace(still, events=late), SPAN, gamma=1.0)
    assert noise.curve.rates_hz == pytest.approx([2 / 1.9] * 3)
    # Of 800 pixels without an event, 3 OFF events would have been seen 95 times of 100.
    none = measure_noise(dataclasses.replace(still, events=late[:0]), SPAN, gamma=1.0)
    assert [one.high for one in none.estimates()[:3]] == pytest.approx([2 * 3 / (800 * 1.9)] * 3)


def test_on_events_without_off_events_are_leak():
    recording = still_recording(leak_rate_hz=3.0, initial_phase="random")
    noise = measure_noise(recording, SPAN, gamma=1.0)
    assert noise.leak_rate_hz == pytest.approx(3.0, rel=0.1)
    assert (noise.curve.rates_hz < 0.01).all()
    *rates, leak = noise.estimates()
    # No OFF event in 1,560 pixel-seconds of each stripe and more: 3 would be seen 95 times of 100.
    assert all(one.low == 0 and 1e-3 < one.high < 0.01 for one in rates)
    assert 2.5 < leak.low < leak.value < leak.high < 3.5


def test_a_textured_scene_at_rest_is_measured_pixel_by_pixel():
    random = np.random.default_rng(1)
    image = random.choice([3.0, 60.0], size=(40, 60))
    curve = {"noise_scale": 1.0, "noise_curve": "3:4 60:0.5", "noise_on_fraction": 0.5}
    noise = measure_noise(still_recording(image, **curve), SPAN, gamma=1.0)
    assert noise.curve.levels.tolist() == [3.5, 57.5]
    assert noise.curve.rates_hz == pytest.approx([4, 0.5], rel=0.2)


def test_a_recording_without_still_pixels_says_so(recording):
    assert measure_noise(recording, TimeSpan(0, 700_000), gamma=1.0) is None
