"""A check reads a video once; its motion and event rate are those of the whole."""

from __future__ import annotations

import numpy as np
import pytest
from tests.video_check.made_clips import frames, pan

import texvent
from texvent.run.check import check_frames, check_source, open_source
from texvent.runtime.progress import NoProgress
from texvent.settings.resolution import resolve


@pytest.fixture(scope="module")
def images():
    """60 frames that move 3 px per frame."""
    return pan(60, step=3, blur=6)


def video_of(images, fps=25):
    times = [one.t_us for one in frames(images, fps)]
    return texvent.Video(images, times)


@pytest.fixture(scope="module")
def found(images):
    return check_source(video_of(images), noise="none", progress=False)


def test_motion_is_that_of_the_pan(found):
    assert found.report.measurements["motion_px"] == pytest.approx(3.0, abs=0.1)
    assert found.report.measurements["motion_share"] == pytest.approx(3.0 / 320, abs=0.001)


def test_motion_is_measured_at_the_sensor(images):
    small = check_source(video_of(images), sensor="64x48", noise="none", progress=False)
    assert small.size == (64, 48)
    assert small.report.measurements["motion_px"] == pytest.approx(1.5, abs=0.1)


def test_the_rate_is_that_of_the_whole_clip(images, found):
    events = texvent.simulate(video_of(images), noise="none", progress=False)
    whole = len(events) / (59 / 25) / images[0].size
    measures = found.report.measurements
    assert measures["rate_hz"] == pytest.approx(whole, rel=0.1)
    assert 0 < measures["rate_error_hz"] < 0.2 * whole


def test_the_rate_of_linear_light_is_that_of_the_whole_clip(images):
    light = 255 * (images / 255.0) ** 2.2
    options = {"noise": "none", "transfer": "linear", "progress": False}
    events = texvent.simulate(light, fps=25, **options)
    whole = len(events) / (59 / 25) / images[0].size
    measures = check_source(light, fps=25, **options).report.measurements
    assert measures["rate_hz"] == pytest.approx(whole, rel=0.1)
    assert "dark_end" not in measures


def test_the_rate_follows_the_options(images, found):
    less = check_source(
        video_of(images), noise="none", contrast_threshold=0.4, progress=False
    ).report.measurements["rate_hz"]
    assert less < 0.7 * found.report.measurements["rate_hz"]


def test_deflicker_helps_against_flicker(images):
    gain = 1 + 0.08 * (-1.0) ** np.arange(60)
    video = video_of(np.clip(0.8 * images * gain[:, None, None], 0, 255).astype(np.float32))
    plain, helped = (
        check_source(video, noise="none", deflicker=one, progress=False) for one in (False, True)
    )
    assert "flicker" in plain.report.problems
    assert helped.report.measurements["rate_hz"] < plain.report.measurements["rate_hz"]


def test_a_stream_is_read_once_and_may_be_of_unknown_length(images):
    read = []

    def live():
        for i, image in enumerate(images):
            read.append(i)
            yield image

    settings = resolve("simulate", {"fps": 25, "noise": "none"})
    video = open_source(live(), settings)
    assert video.is_live
    assert video.frame_count is None
    found = check_frames(video, settings, NoProgress())
    assert read == list(range(60))
    assert found.report.measurements["frames"] == 60
    assert found.report.measurements["motion_px"] == pytest.approx(3.0, abs=0.1)


def test_two_frames_are_enough_and_one_is_refused(images):
    found = check_source(video_of(images[:2]), noise="none", progress=False)
    assert found.report.measurements["rate_hz"] > 0
    with pytest.raises(texvent.InputError, match="only one frame"):
        check_source([images[0]], fps=25, progress=False)
