"""What a check advises helps."""

from __future__ import annotations

import numpy as np
import pytest
from tests.video_check.made_clips import encode, frames, pan

import texvent
from texvent.run.check import check_source

PLAIN = {"noise": "none", "interpolate": "blend", "progress": False}


def video_of(images, fps=24):
    return texvent.Video(images, [one.t_us for one in frames(images, fps)])


def test_frames_without_repeats_at_the_true_rate_are_clean(tmp_path):
    images = pan(32)
    repeated = encode(
        np.repeat(images, np.resize([1, 1, 1, 2], 32), axis=0), tmp_path / "a.mp4", fps=30, crf="18"
    )
    dropped = encode(images, tmp_path / "b.mp4", fps=30, crf="18")
    assert check_source(repeated, **PLAIN).report.remarks == ("repeated frames",)
    found = check_source(dropped, fps=24, **PLAIN).report
    assert found.remarks == ()
    assert found.measurements["fps"] == pytest.approx(24)


def test_dark_clips_fire_with_less_balance_or_threshold():
    dark = video_of((0.04 * pan(12) + 1).astype(np.float32))
    rates = [
        check_source(dark, **PLAIN, **options).report.measurements["rate_hz"]
        for options in ({}, {"balance": 2.0}, {"contrast_threshold": 0.05})
    ]
    assert rates[0] < 0.05
    assert min(rates[1:]) > 1
