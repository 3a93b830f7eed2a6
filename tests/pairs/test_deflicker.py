"""Flicker of the whole image goes, fades and motion stay."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent._registry import INTERPOLATORS
from texvent.config import InterpolateConfig
from texvent.errors import ConfigError
from texvent.frames import Frame, Video
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.pairs.deflicker import PASSED_SHARE, global_gain, steady_frames
from texvent.transfer import Transfer


def clip(moving_texture, gains, *, speed=1.0, dtype=np.float32):
    images = [0.6 * moving_texture(speed * i) * gain for i, gain in enumerate(gains)]
    return [Frame(one.astype(dtype), 40_000 * i) for i, one in enumerate(images)]


def levels(frames):
    """ln of the mean level of each frame, from the first one's."""
    means = np.log([float(frame.luma.mean()) for frame in frames])
    return means - means[0]


FLICKER = np.exp(0.05 * np.array([0, 1, -1, 1, 0, -1, 1, -1, 0, 1, -1, 0]))


def test_flicker_is_divided_out(moving_texture):
    frames = clip(moving_texture, FLICKER, speed=0.0)
    steady = levels(list(steady_frames(iter(frames))))
    assert np.abs(np.diff(levels(frames))).max() == pytest.approx(0.1, abs=1e-3)
    # What is left is the followed share.
    assert np.abs(np.diff(steady)).max() < 0.1 * PASSED_SHARE * 1.1


def test_a_lasting_change_is_let_through_step_by_step(moving_texture):
    frames = clip(moving_texture, [1.0] * 3 + [1.2] * 20, speed=0.0)
    steady = levels(list(steady_frames(iter(frames))))
    expected = np.log(1.2) * (1 - (1 - PASSED_SHARE) ** np.arange(1, 21))
    # float32 means, and corrections too small to be made.
    assert steady[3:] == pytest.approx(expected, abs=3e-3)


def test_a_fade_keeps_its_pace(moving_texture):
    rate = 0.02
    frames = clip(moving_texture, np.exp(-rate * np.arange(40)), speed=0.0)
    steady = levels(list(steady_frames(iter(frames))))
    assert np.diff(steady)[25:] == pytest.approx(-rate, abs=2e-3)


def test_motion_alone_is_no_gain(moving_texture):
    background = 0.3 * moving_texture(0)
    pair = []
    for left in (10, 40):
        image = background.copy()
        image[30:90, left : left + 60] = 220
        pair.append(Frame(image, left))
    assert global_gain(*pair) == 0.0


@given(st.floats(0.7, 1.4), st.integers(1, 70), st.integers(1, 70))
def test_a_pure_gain_is_measured_at_any_size(gain, height, width):
    image = np.random.default_rng(height * 71 + width).uniform(40, 160, (height, width))
    first, second = Frame(image, 0), Frame(image * gain, 1)
    assert global_gain(first, second) == pytest.approx(np.log(gain), abs=1e-5)


@pytest.mark.parametrize(
    ("transfer", "level", "is_used"),
    [(Transfer.GAMMA, 100, True), (Transfer.GAMMA, 251, False), (Transfer.GAMMA, 5, False),
     (Transfer.LINEAR, 1e4, True), (Transfer.LINEAR, 2, True), (Transfer.LINEAR, 0.3, False)],
)  # fmt: skip
def test_levels_that_are_clipped_or_noise_follow_no_gain(transfer, level, is_used):
    image = np.full((20, 30), level, np.float32)
    first, second = (Frame(one, 0, transfer=transfer) for one in (image, image * 1.01))
    assert global_gain(first, second) == pytest.approx(np.log(1.01) * is_used, abs=1e-5)


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.float32])
def test_a_cut_starts_anew_whatever_the_gain_before_it(moving_texture, dtype):
    scale = 257 if dtype == np.uint16 else 1
    other = 255 - moving_texture(3000, 900)
    images = [0.6 * moving_texture(0), 0.66 * moving_texture(0), other, other]
    frames = [Frame(np.round(scale * one).astype(dtype), k) for k, one in enumerate(images)]
    steady = list(steady_frames(iter(frames)))
    assert levels(steady[:2])[1] == pytest.approx(PASSED_SHARE * np.log(1.1), abs=3e-3)
    assert steady[2] is frames[2]
    assert steady[3] is frames[3]


def test_the_guard_acts_before_the_count(moving_texture):
    frames = clip(moving_texture, [1.0, 1.3, 1.0, 1.3], speed=0.0)
    video = Video(np.stack([frame.pixels for frame in frames]), [0, 40_000, 80_000, 120_000])
    counts = {}
    for guard in (False, True):
        config = InterpolateConfig(interpolate="blend", deflicker=guard)
        interpolator = INTERPOLATORS.load("blend")(config, video)
        policy = CountPolicy(config, video, interpolator, balance=30.0, contrast_threshold=0.1)
        pairs = pair_frames(video, interpolator, config, policy)
        counts[guard] = sum(len(pair.times_us) for pair in pairs)
    assert counts == {False: 6, True: 0}


def test_exact_frames_cannot_be_guarded():
    with pytest.raises(ConfigError, match="deflicker corrects the frames of a video"):
        InterpolateConfig(interpolate="exact", deflicker=True)
