import dataclasses

import numpy as np
import pytest

from texvent.calibrate.fit import fit_sensor
from texvent.calibrate.recording import CalibrationRecording, TimeSpan, simulate_span
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig, InterpolateConfig
from texvent.data.pull import pull
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import Video
from texvent.io.files import load
from texvent.pipeline import video_to_events
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation.physical.cameras import PRESETS

from .conftest import TRUTH, moving_blobs


@pytest.mark.parametrize("frames_us", [(0, 10**6), (70_000, 10**6 + 1), (0, 700_000)])
@pytest.mark.parametrize("events_us", [(0, 10**6), (250_000, 900_001), (3, 650_000)])
def test_halves_are_what_frames_and_events_share_once_pixels_are_warm(frames_us, events_us):
    """Pixels of the model are warm 0.1 s after the first frame, those of the sensor at once."""
    frames = Video(np.zeros((2, 4, 4), np.uint8), frames_us)
    events = EventStream([0, 0], [0, 0], events_us, [0, 1], SensorSize(4, 4))
    first, second = CalibrationRecording(frames, events, InterpolateConfig()).halves()
    assert first.start_us == max(frames_us[0] + 100_000, events_us[0])
    assert second.stop_us == min(frames_us[1], events_us[1])
    assert first.stop_us == second.start_us == (first.start_us + second.stop_us) // 2


def test_the_first_seconds_of_a_span_are_at_most_the_whole(recording):
    first, _ = recording.halves()
    assert first.first(0.25) == TimeSpan(first.start_us, first.start_us + 250_000)
    assert first.first(99.0) == first
    assert first.first(0.25).seconds == 0.25


def test_a_simulated_span_holds_its_events_only(recording):
    span = TimeSpan(400_000, 600_000)
    frames = recording.dense_frames(span, TRUTH)
    assert frames[0].t_us >= 200_000
    events = simulate_span(frames, span, TRUTH)
    assert len(events) > 1000
    assert span.start_us <= events.t[0]
    assert events.t[-1] < span.stop_us
    for offset_us in (10_000, -40_000):
        moved = TimeSpan(*(one + offset_us for one in span))
        at = simulate_span(frames, moved, TRUTH, offset_us=offset_us)
        assert np.array_equal(at.t, events.t + offset_us)
    longer = simulate_span(frames, TimeSpan(300_000, 600_000), TRUTH).cut(*span)
    first = [len(one.cut(400_000, 410_000)) for one in (events, longer)]
    assert first[0] == pytest.approx(first[1], rel=0.05)


def test_unlike_sizes_are_refused(recording):
    other = EventStream.empty(SensorSize(5, 5))
    with pytest.raises(InputError, match=r"32x24.*5x5"):
        CalibrationRecording(recording.frames, other, recording.interpolate)


def test_clocks_that_do_not_meet_are_refused(recording):
    frames = moving_blobs()
    late = Video(frames.pixels, [t + 10**9 for t in frames.times_us])
    with pytest.raises(InputError, match="same clock"):
        CalibrationRecording(late, recording.events, InterpolateConfig()).halves()
    with pytest.raises(InputError, match="lacks one"):
        CalibrationRecording(frames, EventStream.empty(frames.size), InterpolateConfig()).halves()


def test_a_fit_sees_the_frames_that_a_run_of_the_model_sees(moving_texture):
    faint = np.stack([90 + moving_texture(7 * index) / 4 for index in range(9)])
    frames = Video(faint, [40_000 * index for index in range(9)])
    events = EventStream.empty(frames.size)
    settings = resolve("simulate", {"simulator": "physical", "contrast_threshold": 0.2})
    recording = CalibrationRecording(frames, events, settings.interpolate)
    dense = recording.dense_frames(TimeSpan(0, 320_000), settings.simulate)
    steps = video_to_events(frames, settings).steps()
    assert [one.t_us for one in dense] == [frame.t_us for frame, _ in steps]
    assert len(dense) > 2 * len(faint)


@pytest.mark.network
def test_a_fitted_davis_is_closer_to_the_half_it_has_not_seen():
    folder = pull("slider_depth")
    recording = CalibrationRecording(
        open_frames(folder, CaptureConfig()),
        load(folder / "events.txt", size=SensorSize(240, 180)),
        InterpolateConfig(max_intermediate=8),
    )
    start = dataclasses.replace(PRESETS["davis240c"], gamma=1.0)
    fit = fit_sensor(recording, start=start, seconds=0.3)
    before, after = (fit.distances[name][1] for name in ("start", "fitted"))
    assert after.total < 0.4 * before.total
    assert after.overlap < before.overlap - 0.1
    assert after.intervals < before.intervals
    assert fit.noise is not None
