"""What a check advises helps."""

from __future__ import annotations

import numpy as np
import pytest
from tests.video_check.made_clips import encode, frames, pan

import texvent
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.run.check import check_source
from texvent.sensor import SensorSize
from texvent.video_check.report import check_video

PLAIN = {"noise": "none", "interpolate": "blend", "progress": False}


def video_of(images, fps=24):
    return texvent.Video(images, [one.t_us for one in frames(images, fps)])


def test_a_smaller_sensor_averages_the_blocks_of_compression(tmp_path):
    images = pan(24, width=192, blur=40)
    path = encode(images, tmp_path / "a.mkv", codec="mpeg4", qmin="12", qmax="12")
    assert "compression blocks" in check_video(open_frames(path, CaptureConfig())).remarks

    def excess(**options):
        """Events of the compressed clip over those of the clean one."""
        made, true = (
            len(texvent.simulate(one, **PLAIN, preset="paper", **options))
            for one in (path, video_of(images))
        )
        return made / true

    assert excess() > 1.5
    assert excess(sensor="48x24") < 1.25


def test_frames_without_repeats_at_the_true_rate_are_clean(tmp_path):
    images = pan(32)
    repeated = encode(
        np.repeat(images, np.resize([1, 1, 1, 2], 32), axis=0), tmp_path / "a.mp4", fps=30, crf="18"
    )
    dropped = encode(images, tmp_path / "b.mp4", fps=30, crf="18")
    assert check_source(repeated, **PLAIN).report.remarks == ("repeated frames",)
    found = check_source(dropped, fps=24, **PLAIN).report
    assert found.remarks == ()
    assert found.measures["fps"] == pytest.approx(24)


def test_dark_clips_fire_with_less_balance_or_threshold():
    dark = video_of((0.04 * pan(12) + 1).astype(np.float32))
    rates = [
        check_source(dark, **PLAIN, **options).report.measures["rate_hz"]
        for options in ({}, {"balance": 2.0}, {"contrast_threshold": 0.05})
    ]
    assert rates[0] < 0.05
    assert min(rates[1:]) > 1


def test_a_sensor_of_the_inner_size_has_no_bars():
    images = np.pad(pan(4), [(0, 0), (12, 12), (0, 0)])
    fitted = open_frames(video_of(images), CaptureConfig(fit="cover"), size=SensorSize(128, 96))
    assert min(one.luma.min() for one in fitted) > 10
