"""Repeated frames are found, with the rate that the video truly has."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.video_check.made_clips import encode, frames, pan

from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.video_check.checks import check_video
from texvent.video_check.measurements import find_pattern, find_repeats, measure_video


def shown(images, times):
    """Every image as often as its turn in `times` says."""
    counts = np.resize(times, len(images))
    return np.repeat(images, counts, axis=0)


@pytest.mark.parametrize(
    ("times", "period", "repeats", "fps", "true_fps"),
    [
        ([1, 1, 1, 2], 5, 1, 30, "24"),
        ([2], 2, 1, 24, "12"),
        ([3, 2], 5, 3, 60, "24"),
        ([5], 5, 4, 25, "5"),
    ],
)
def test_the_true_rate_of_repeated_frames(times, period, repeats, fps, true_fps):
    images = shown(pan(80), times)
    report = check_video(frames(images, fps))
    assert report.measurements["pattern_period"] == period
    assert report.measurements["pattern_repeats"] == repeats
    (finding,) = [one for one in report.findings if one.check.name == "repeated frames"]
    assert finding.is_found
    assert finding.value.endswith(f"{repeats} of {period}: true rate {true_fps} fps")
    assert "frozen" not in report.problems


def test_repeats_are_found_after_compression(tmp_path):
    path = encode(shown(pan(40), [1, 1, 1, 2]), tmp_path / "a.mp4", fps=30, crf="30")
    measures = measure_video(open_frames(path, CaptureConfig()))
    assert (measures["pattern_period"], measures["pattern_repeats"]) == (5, 1)


def test_motion_that_slows_down_and_turns_repeats_nothing():
    ground = pan(1, width=400)[0]
    places = np.rint(100 + 100 * np.cos(np.linspace(0, 12, 120))).astype(int)
    images = np.stack([ground[:, place : place + 128] for place in places])
    is_same = np.diff(places) == 0
    repeats = find_repeats(np.abs(np.diff(images, axis=0)).mean(axis=(1, 2)), is_same * False)
    assert not repeats.any()


def slow_repeats(change, exact):
    """The definition, pair by pair."""
    around = [np.percentile(change[max(0, i - 12) : i + 13], 75) for i in range(len(change))]
    low = [change[i] < 0.15 * around[i] for i in range(len(change))]
    result = []
    for i in range(len(change)):
        before, after = i, i
        while before >= 0 and low[before]:
            before -= 1
        while after < len(change) and low[after]:
            after += 1
        beside = [j for j in (before, after) if 0 <= j < len(change)]
        sudden = low[i] and all(change[j] >= 0.5 * around[j] for j in beside)
        result.append(around[i] >= 0.02 and (exact[i] or sudden))
    return result


@given(st.lists(st.sampled_from([0.0, 0.01, 0.1, 0.5, 1.0, 2.0]), min_size=1, max_size=60))
def test_repeats_are_those_of_the_definition(change):
    change = np.array(change)
    exact = change == 0
    assert find_repeats(change, exact).tolist() == slow_repeats(change, exact)


def test_patterns_by_hand():
    assert find_pattern(np.array([0, 0, 0, 0, 1] * 4, bool)) == (5, 1)
    assert find_pattern(np.array([0, 1] * 10, bool)) == (2, 1)
    assert find_pattern(np.array([0, 0, 0, 0, 1] * 2, bool)) == (0, 0), "two periods are no pattern"
    assert find_pattern(np.zeros(60, bool)) == find_pattern(np.ones(60, bool)) == (0, 0)
    irregular = np.random.default_rng(0).random(100) < 0.2
    assert find_pattern(irregular) == (0, 0)
