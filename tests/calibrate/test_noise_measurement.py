import dataclasses

import numpy as np
import pytest

from texvent.calibrate.noise import (
    STATIC_FRAMES,
    find_static_pixels,
    find_still_pixels,
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


def test_noise_follows_from_off_events_and_the_share_of_on():
    recording = still_recording(
        noise_scale=1.0, noise_curve="1:6 25:2 120:0.5", noise_on_fraction=0.3, leak_rate_hz=0.0
    )
    noise = measure_noise(recording, SPAN, gamma=1.0, on_fraction=0.3)
    assert noise.curve.rates_hz == pytest.approx([6, 2, 0.5], rel=0.25)
    assert noise.leak_rate_hz == pytest.approx(0, abs=0.1)
    halves = measure_noise(recording, SPAN, gamma=1.0)
    assert halves.curve.rates_hz == pytest.approx(noise.curve.rates_hz * 1.4)


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


def test_pixels_are_calm_if_their_neighbourhood_keeps_its_texture():
    texture = np.random.default_rng(0).uniform(0, 200, (7, 7))
    frames = [texture.copy() for _ in range(STATIC_FRAMES)]
    assert find_static_pixels(frames).all()
    assert not find_static_pixels(frames[1:]).any()
    frames[4][:, 6] += 12.0
    assert find_static_pixels(frames)[3].tolist() == [True] * 4 + [False] * 3


def test_a_recording_without_still_pixels_says_so(recording):
    assert measure_noise(recording, TimeSpan(0, 700_000), gamma=1.0) is None


def test_noise_of_the_frames_themselves_does_not_count_as_motion():
    still = still_recording(leak_rate_hz=3.0, initial_phase="random")
    grain = np.random.default_rng(0).normal(0, 1.0, still.frames.pixels.shape)
    grainy = np.maximum(still.frames.pixels + grain, 0).astype(np.float32)
    recording = dataclasses.replace(still, frames=Video(grainy, still.frames.times_us))
    noise = measure_noise(recording, SPAN, gamma=1.0)
    assert noise.leak_rate_hz == pytest.approx(3.0, rel=0.1)


def test_a_pixel_is_still_if_its_neighbourhood_is():
    now = np.full((7, 7), 50.0)
    # 1.5 levels plus 2 % of 50 are allowed.
    assert find_still_pixels(now, [now, now + 2.5]).all()
    assert not find_still_pixels(now, [now, now + 2.6]).any()
    edge = now.copy()
    edge[:, 6] = 60.0
    assert find_still_pixels(edge, [edge])[3].tolist() == [True] * 4 + [False] * 3
    late = find_still_pixels(now, [now, edge])
    assert late[3].tolist() == [True] * 4 + [False] * 3
