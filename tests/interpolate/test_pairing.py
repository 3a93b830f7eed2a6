"""Source frames stay, intermediate frames come between, jumps are not smeared."""

import math
import weakref
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.interpolate.motion.scenes import bar_pair

from texvent._registry import INTERPOLATORS
from texvent.config import InterpolateConfig
from texvent.frames import Frame, MotionVectors, Video
from texvent.interpolate.count_policy import CountPolicy
from texvent.interpolate.pairing import pair_frames
from texvent.pairs import motion_interpolation
from texvent.pairs.scene_change import SceneChange
from texvent.transfer import Transfer


def pairs_of(video, options=None, *, threshold=0.2):
    options = options or InterpolateConfig(interpolate="blend")
    interpolator = INTERPOLATORS.load(options.interpolate)(options, video)
    policy = CountPolicy(options, video, interpolator, balance=30.0, contrast_threshold=threshold)
    return pair_frames(video, interpolator, options, policy)


def run(video, options=None, *, threshold=0.2):
    return [
        frame for pair in pairs_of(video, options, threshold=threshold) for frame in pair.frames
    ]


def field(levels, times_us, shape=(4, 4)):
    """Uniform frames of these levels."""
    return Video(np.stack([np.full(shape, level) for level in levels]).astype(np.float64), times_us)


@pytest.fixture
def flashing(moving_texture):
    """An image that flashes for one frame, at 20 ms, then is cut at 40 ms."""
    dim = moving_texture(0) * 0.5
    frames = [dim, dim * 2, dim, moving_texture(3000, 900)]
    return Video(np.stack(frames), [0, 20_000, 40_000, 60_000])


class Beating(Video):
    """A grey field under light that beats at 100 Hz, between 50 and 150."""

    flicker_hz = 100.0

    def at(self, t_us):
        level = 100.0 + 50.0 * math.cos(2.0 * math.pi * self.flicker_hz * t_us / 1e6)
        return Frame(np.full((4, 4), level), t_us, is_source=False)


class Vectored(Beating):
    """The same with vectors of no motion."""

    def __iter__(self):
        still = np.zeros((*self.size.shape, 2), np.float32)
        for frame in super().__iter__():
            yield replace(frame, motion=MotionVectors(still, still))


def test_a_beat_that_the_frames_miss_is_rendered_between_them():
    # Every frame meets the beat at its brightest, so Eq. 4 alone would ask for none.
    video = Beating(np.full((3, 4, 4), 150.0), [0, 20_000, 40_000])
    levels = [float(f.pixels[0, 0]) for f in run(video, InterpolateConfig(interpolate="exact"))]
    assert len(levels) == 1 + 2 * 2 * 12
    assert min(levels) == pytest.approx(50.0)
    assert sum(level > 149 for level in levels) == 5


@pytest.mark.parametrize(
    ("options", "count"),
    [
        ({"interpolate": "blend"}, 0),
        ({"fixed_count": 3}, 3),
        ({"max_intermediate": 5}, 5),
        ({}, 23),
    ],
)
def test_only_rendered_frames_follow_the_beat(options, count):
    video = Beating(np.full((2, 4, 4), 150.0), [0, 20_000])
    dense = run(video, InterpolateConfig(**{"interpolate": "exact", **options}))
    assert len(dense) - 2 == count


def test_source_frames_pass_untouched():
    pixels = np.random.default_rng(0).integers(0, 256, (3, 5, 6, 3), dtype=np.uint8)
    video = Video(pixels, [5, 1005, 3005])
    sources = [frame for frame in run(video) if frame.is_source]
    assert [frame.t_us for frame in sources] == [5, 1005, 3005]
    for frame, expected in zip(sources, pixels, strict=True):
        assert frame.pixels.dtype == np.uint8
        np.testing.assert_array_equal(frame.pixels, expected)


@given(
    st.lists(st.tuples(st.integers(1, 40), st.integers(0, 255)), min_size=1, max_size=6),
    st.sampled_from([None, 64]),
)
def test_times_strictly_increase_whatever_the_intervals(steps, count):
    times_us = np.cumsum([interval for interval, _ in steps]).tolist()
    video = field([level for _, level in steps], times_us, shape=(1, 1))
    options = InterpolateConfig(interpolate="blend", fixed_count=count)
    frames = run(video, options, threshold=0.05)
    assert all(a.t_us < b.t_us for a, b in pairwise(frames))
    assert [frame.t_us for frame in frames if frame.is_source] == times_us


@pytest.mark.parametrize("name", sorted(set(INTERPOLATORS.builtin) - {"none", "exact", "rife"}))
@pytest.mark.parametrize("transfer", Transfer)
def test_frames_that_are_asked_for_together_are_those_of_their_times_alone(
    name, transfer, stream, monkeypatch
):
    """However many are drawn at once; and their light is coded as that of their pair."""
    pair = [replace(one, transfer=transfer) for one in bar_pair()]
    interpolator = INTERPOLATORS.load(name)(InterpolateConfig(interpolate=name), stream)
    times_us = list(range(30, 1000, 57))
    monkeypatch.setattr(motion_interpolation, "DRAWN_BYTES", 3 * 4 * pair[0].pixels.size)
    found = list(interpolator.between(*pair, times_us))
    facts = [(one.t_us, one.is_source, one.transfer) for one in found]
    assert facts == [(t_us, False, transfer) for t_us in times_us]
    for one in found:
        (alone,) = interpolator.between(*pair, [one.t_us])
        np.testing.assert_array_equal(one.pixels, alone.pixels)


def test_a_flash_of_one_frame_and_a_cut_are_three_jumps(flashing):
    changes = [pair.change for pair in pairs_of(flashing)]
    assert changes == [SceneChange.NONE, SceneChange.FLASH, SceneChange.FLASH, SceneChange.CUT]
    frames = run(flashing)
    assert [frame.t_us for frame in frames] == [
        0, 19_000, 20_000, 39_000, 40_000, 59_000, 60_000,
    ]  # fmt: skip
    for held, source in zip(frames[1::2], frames[0::2], strict=False):
        assert not held.is_source
        np.testing.assert_array_equal(held.pixels, source.pixels.astype(np.float32))


def test_the_old_image_is_held_for_half_of_a_short_interval(flashing):
    for interval_us, expected in ((1_500, 750), (3, 2), (2, 1)):
        video = Video(flashing.pixels[:2], [0, interval_us])
        assert [frame.t_us for frame in run(video)] == [0, expected, interval_us]
    assert len(run(Video(flashing.pixels[:2], [0, 1]))) == 2


def test_jumps_are_smeared_only_if_asked(flashing):
    options = InterpolateConfig(interpolate="blend", detect_cuts=False)
    assert {pair.change for pair in pairs_of(flashing, options)} == {SceneChange.NONE}
    assert len(run(flashing, options)) > 7


@pytest.mark.parametrize("name", sorted(set(INTERPOLATORS.builtin) - {"rife"}))
def test_what_mixes_no_frames_looks_for_no_jumps(name, flashing):
    """A rendered flash is drawn at every instant; only what would smear a jump holds it."""
    video = Vectored(flashing.pixels[:3], flashing.times_us[:3])
    found = {pair.change for pair in pairs_of(video, InterpolateConfig(interpolate=name))}
    assert (found != {SceneChange.NONE}) == (name not in ("none", "exact"))


def test_at_most_two_source_frames_are_held():
    alive = weakref.WeakSet()
    most = 0

    class Stream(Video):
        """Frames made as they are asked for."""

        def __iter__(self):
            for k in range(12):
                frame = Frame(np.full((4, 4), 20.0 * k), 1000 * k)
                alive.add(frame)
                yield frame
                del frame

    base = field([1, 2], [0, 10])
    for pair in pairs_of(Stream(base.pixels, base.times_us)):
        del pair
        most = max(most, len(alive))
    assert most == 2
