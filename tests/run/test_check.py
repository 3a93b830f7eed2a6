"""A check reads a video once; its motion is that of the whole."""

import warnings
from fractions import Fraction
from itertools import islice

import cv2
import numpy as np
import pytest
from tests.video_check.made_clips import frames, pan

import texvent
from texvent.config import CaptureConfig
from texvent.run.check import _instants, check_frames, check_source, open_source
from texvent.runtime.progress import NoProgress


@pytest.fixture(scope="module")
def images():
    """60 frames that move 3 px per frame."""
    return pan(60, step=3, blur=6)


def video_of(images, fps=25):
    times = [one.t_us for one in frames(images, fps)]
    return texvent.Video(images, times)


@pytest.mark.parametrize("times", [1, 3, 4])
def test_a_clip_of_twice_the_size_moves_by_twice_the_px(images, times):
    larger = images[:4].repeat(times, axis=1).repeat(times, axis=2)
    found = check_source(video_of(larger), progress=False).report.measurements
    assert found["motion_px"] == pytest.approx(3.0 * times, rel=0.04)
    assert found["motion_share"] == pytest.approx(3.0 * times / max(320, 128 * times), rel=0.04)


def test_motion_is_the_median_and_what_the_fastest_hundredth_exceeds():
    ground, fast = pan(2, width=300, step=1), pan(2, width=24, step=6, blur=6, seed=8)
    ground[:, 40:56, 100:124] = fast[:, 40:56]  # one of 75 pixels
    found = check_source(video_of(ground), progress=False).report.measurements
    assert found["motion_px"] == pytest.approx(1.0, abs=0.2)
    assert found["fast_px"] == pytest.approx(6.0, abs=1.0)


@pytest.mark.parametrize("scale", [1, 2, 3])
def test_motion_counts_where_it_is(scale):
    still, fast = pan(2, width=320, step=0, blur=6), pan(2, width=80, step=3, blur=6, seed=8)
    still[:, 40:, 230:310] = fast[:, 40:]  # at the lower right
    film = still.repeat(scale, axis=1).repeat(scale, axis=2)
    found = check_source(video_of(film), progress=False).report.measurements
    assert found["motion_px"] == pytest.approx(3.0 * scale, rel=0.2)


def test_motion_does_not_depend_on_linear_light(images):
    light = 255 * (images / 255.0) ** 2.2
    measured = check_source(light, fps=25, transfer="linear", progress=False).report.measurements
    assert measured["motion_px"] == pytest.approx(3.0, abs=0.1)
    assert "dark_end" not in measured


def test_a_stream_is_read_once_and_may_be_of_unknown_length(images):
    read = []

    def live():
        for i, image in enumerate(images):
            read.append(i)
            yield image

    video = open_source(live(), CaptureConfig(fps=Fraction(25)))
    assert video.is_live
    assert video.frame_count is None
    found = check_frames(video, NoProgress())
    assert read == list(range(60))
    assert found.report.measurements["frames"] == 60
    assert found.report.measurements["motion_px"] == pytest.approx(3.0, abs=0.1)


def test_motion_is_measured_all_over_a_clip_and_ever_more_seldom_in_one_without_end():
    assert list(_instants(160)) == [10, 30, 50, 70, 90, 110, 130, 150]
    assert list(_instants(2)) == [1] * 8
    assert list(islice(_instants(None), 6)) == [1, 11, 31, 71, 151, 311]


def test_two_frames_are_enough_and_one_is_refused(images):
    found = check_source(video_of(images[:2]), progress=False)
    assert found.report.measurements["motion_px"] == pytest.approx(3.0, abs=0.1)
    with pytest.raises(texvent.InputError, match="only one frame"):
        check_source([images[0]], fps=25, progress=False)


@pytest.mark.parametrize("lacking", [(), (3,), (2, 4)])
def test_images_that_are_missing_are_found(images, tmp_path, lacking):
    for number in {*range(8)} - {*lacking}:
        cv2.imwrite(str(tmp_path / f"{number}.png"), images[number])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        report = check_source(tmp_path, fps=25, progress=False).report
    assert report.measurements["missing"] == bool(lacking)
    assert any("missing" in name for name in (*report.problems, *report.remarks)) is bool(lacking)


def test_a_cut_is_no_motion(images):
    both = np.stack([images[0], images[40][::-1, ::-1]])
    found = check_source(video_of(both), progress=False)
    assert found.cut_times_us == (40_000,)
    assert found.report.measurements["motion_px"] == found.report.measurements["fast_px"] == 0
