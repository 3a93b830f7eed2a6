"""Black bars, cuts, and frames that are not equally far apart."""

from __future__ import annotations

import numpy as np
import pytest
from tests.video_check.made_clips import frames, pan

from texvent.video import Frame
from texvent.video_check.borders import bars
from texvent.video_check.measurer import VideoMeasurer
from texvent.video_check.report import check_video


def test_letterbox_is_measured():
    images = np.pad(pan(8), [(0, 0), (12, 10), (0, 0)], constant_values=16)
    report = check_video(frames(images))
    widths = [report.measures[f"bar_{side}"] for side in ("top", "bottom", "left", "right")]
    assert widths == [12, 10, 0, 0]
    assert report.measures["bar_share"] == pytest.approx(22 / (96 + 22))
    assert "black bars" in report.remarks
    (finding,) = [one for one in report.findings if one.check.name == "black bars"]
    assert finding.value == "19%: top 12, bottom 10 px"


def test_a_dark_sky_with_something_in_it_is_no_bar():
    images = np.pad(pan(8), [(0, 0), (12, 0), (0, 0)], constant_values=16)
    images[4, 3, 50] = 60
    assert check_video(frames(images)).measures["bar_top"] < 12


def test_a_black_clip_has_no_bars():
    assert bars(*np.zeros((3, 20), np.float32)) == (0, 0)


def test_a_dark_background_is_no_bar():
    images = np.zeros((12, 96, 128), np.uint8)
    for i, image in enumerate(images):
        image[30:60, 40 + 3 * i : 70 + 3 * i] = 255
    assert check_video(frames(images)).measures["bar_share"] == 0


def test_one_dark_row_is_no_bar():
    rows = np.full(100, 90, np.float32)
    rows[0] = 0
    assert bars(rows, np.zeros(100, np.float32), rows / 90) == (0, 0)


def at(times_us):
    images = pan(len(times_us))
    return [Frame(image, time) for image, time in zip(images, times_us, strict=True)]


def test_dropped_frames_are_irregular_times():
    kept = [40_000 * i for i in range(20) if i not in (5, 6, 11)]
    report = check_video(at(kept))
    assert report.measures["fps"] == 25
    assert report.measures["irregular_share"] == pytest.approx(2 / 16)
    assert report.measures["longest_gap"] == 3
    assert "frame times" in report.remarks


def test_whole_milliseconds_are_regular():
    times = [1000 * round(i * 1001 / 30) for i in range(20)]
    report = check_video(at(times))
    assert report.measures["irregular_share"] == 0
    assert report.measures["fps"] == pytest.approx(29.97, rel=2e-3)


def test_cuts_have_times():
    images = pan(20)
    images[12:] = 255 - images[12:, ::-1]
    measurer = VideoMeasurer()
    for frame in frames(images, 20):
        measurer.add(frame)
    assert measurer.cut_times_us == [600_000]
    assert measurer.measures()["cuts"] == 1
