"""Blocks and key frames of compression are measured where they are."""

from __future__ import annotations

import numpy as np
import pytest
from tests.video_check.made_clips import encode, frames, pan, texture

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.video_check.compression import blockiness, find_renewals, steps_by_place
from texvent.video_check.measurer import measure_video
from texvent.video_check.report import check_video


def slow_steps(luma, axis):
    """The definition, step by step."""
    image = luma if axis == 1 else luma.T
    width = (image.shape[1] - 1) // 8 * 8
    steps = [[] for _ in range(8)]
    for row in image:
        for x in range(width):
            steps[x % 8].append(min(abs(float(row[x + 1]) - float(row[x])), 8.0))
    return [np.mean(one) for one in steps]


@pytest.mark.parametrize("axis", [0, 1])
def test_steps_by_place_are_those_of_the_definition(axis):
    luma = np.random.default_rng(0).uniform(0, 40, (21, 35)).astype(np.float32)
    assert np.allclose(steps_by_place(luma, axis), slow_steps(luma, axis), atol=1e-5)


def test_blockiness_by_hand():
    assert blockiness(np.array([1.0] * 7 + [3.0])) == 3
    assert blockiness(np.zeros(8)) == 1
    assert blockiness(np.array([0.0] * 7 + [0.5])) == 2, "of a quarter of a level at least"


def test_means_of_blocks_have_steps_at_their_edges_only():
    image = texture(96, 128, blur=20)
    means = image.reshape(12, 8, 16, 8).mean(axis=(1, 3))
    half = (image + np.kron(means, np.ones((8, 8)))) / 2
    clean, blocky = (measure_video(frames([one] * 2))["blockiness"] for one in (image, half))
    assert clean < 1.1
    assert blocky > 1.5
    cropped = measure_video(frames([half[3:, 5:].astype(np.float32)] * 2))["blockiness"]
    assert cropped == pytest.approx(blocky, rel=0.1), "wherever the grid lies"


def test_blockiness_rises_with_compression(tmp_path):
    images = pan(24, width=192, blur=4)
    found = []
    for quality in (20, 30, 40, 50):
        path = encode(images, tmp_path / f"{quality}.mp4", crf=str(quality))
        found.append(measure_video(open_frames(path, CaptureConfig()))["blockiness"])
    assert found == sorted(found)
    assert found[0] < 1.15
    assert found[-1] > 1.25


def test_strong_compression_is_found(tmp_path):
    path = encode(pan(24, width=192), tmp_path / "a.avi", codec="mpeg4", qmin="31", qmax="31")
    assert "compression blocks" in check_video(open_frames(path, CaptureConfig())).remarks


def test_key_frames_by_hand():
    resting = np.full(60, 0.4) + np.random.default_rng(0).uniform(0, 0.02, 60)
    resting[5::12] = 1.0
    period, levels, ratio = find_renewals(resting)
    assert period == 12
    assert levels == 1.0
    assert ratio == pytest.approx(1.0 / np.median(resting))


def test_changes_at_no_regular_distance_are_no_key_frames():
    resting = np.full(60, 0.2)
    resting[[3, 7, 20, 29, 55]] = 1.0
    assert find_renewals(resting) == (0, 0.0, 1.0)
    assert find_renewals(np.full(60, 0.2)) == (0, 0.0, 1.0)
    assert find_renewals(np.zeros(3)) == (0, 0.0, 1.0)


def test_key_frames_of_a_compressed_still_scene_are_found(tmp_path):
    images = np.repeat(texture(96, 192, blur=1)[None], 60, axis=0)
    moving = texture(24, 24 + 60, seed=5)
    for i, image in enumerate(images):
        image[:24, :24] = moving[:, i : i + 24]
    images += np.random.default_rng(0).normal(0, 2, images.shape)
    path = encode(
        images, tmp_path / "a.mp4", crf="38", g="12", keyint_min="12", sc_threshold="0", bf="0"
    )
    report = check_video(open_frames(path, CaptureConfig()))
    assert report.measures["key_period"] == 12
    assert "key frames" in report.remarks
