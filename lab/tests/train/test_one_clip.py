"""Events of a whole clip with pixels as the training stream draws them."""

import numpy as np
import pytest

STEP_US = 20_000


@pytest.fixture
def streamed_events(torch):
    from texvent_lab.train.one_clip import streamed_events

    return streamed_events


def test_a_step_has_the_events_of_its_contrast_at_the_times_of_the_clip(streamed_events):
    frames = np.full((3, 6, 8), 100, np.uint8)
    frames[2, 2:4, 5] = 200
    times_us = 7_000 + STEP_US * np.arange(3)
    found = streamed_events(frames, times_us, "none", 0)
    # ln ε-shifted light: 2.2 · ln 2 = 1.52, thresholds of .2: seven events in each of two pixels.
    assert found.size == (8, 6)
    assert len(found) == 14
    assert set(zip(found.x.tolist(), found.y.tolist(), strict=True)) == {(5, 2), (5, 3)}
    assert found.p.all()
    assert times_us[1] < found.t[0] <= found.t[-1] <= times_us[2]
    assert (np.diff(found.t) >= 0).all()


def test_pixels_are_drawn_and_the_clip_is_neither_flipped_nor_paused(streamed_events):
    ramp = np.linspace(20, 240, 9).astype(np.uint8)
    frames = np.zeros((9, 6, 8), np.uint8) + 20
    frames[:, :, :2] = ramp[:, None, None]  # the left alone brightens, without a rest
    times_us = STEP_US * np.arange(9)
    counts = set()
    for seed in range(8):
        found = streamed_events(frames, times_us, "recommended", seed)
        again = streamed_events(frames, times_us, "recommended", seed)
        assert np.array_equal(found.t, again.t)
        left = found.x < 2
        assert left.mean() > 0.8  # what is left is noise
        on = found.t[left & (found.p == 1)]
        assert len(np.unique(on // STEP_US)) >= 6  # brighter from frame to frame
        counts.add(len(found))
    assert len(counts) > 4
